//! A hierarchy of boxes around shapes.

use microsurface::glam::Vec3;

use crate::camera::Ray;
use crate::shape::{Hit, Shape};

const LEAF_SIZE: usize = 4;

struct Node {
    low: Vec3,
    high: Vec3,
    /// The first shape of a leaf, or the second child of an inner node; the first child comes right
    /// after its parent.
    index: usize,
    /// 0 for an inner node.
    count: usize,
}

pub(crate) struct Bvh {
    nodes: Vec<Node>,
    shapes: Vec<Shape>,
}

impl Bvh {
    pub(crate) fn new(mut shapes: Vec<Shape>) -> Self {
        let mut nodes = Vec::new();
        if !shapes.is_empty() {
            build(&mut nodes, &mut shapes, 0);
        }
        Self { nodes, shapes }
    }

    /// The nearest surface beyond `nearest`.
    pub(crate) fn hit(&self, ray: &Ray, nearest: f32) -> Option<Hit> {
        let mut found = None;
        let mut furthest = f32::INFINITY;
        self.visit(ray, nearest, |shape, _| {
            if let Some((distance, place)) = shape.distance(ray, nearest, furthest) {
                furthest = distance;
                found = Some((shape, place));
            }
            Some(furthest)
        });
        found.map(|(shape, place)| shape.hit(ray, furthest, place))
    }

    /// Is there anything beyond `nearest`?
    pub(crate) fn occludes(&self, ray: &Ray, nearest: f32) -> bool {
        let mut found = false;
        self.visit(ray, nearest, |shape, furthest| {
            found = shape.distance(ray, nearest, furthest).is_some();
            (!found).then_some(furthest)
        });
        found
    }

    /// Calls `f` with the shapes near the ray; it returns how far to look from then on, or None to
    /// stop.
    fn visit<'a>(&'a self, ray: &Ray, nearest: f32, mut f: impl FnMut(&'a Shape, f32) -> Option<f32>) {
        let inverse = ray.direction.recip();
        let mut furthest = f32::INFINITY;
        // Halving at each level, 48 levels hold any mesh.
        let mut stack = [0_usize; 48];
        let mut depth = usize::from(!self.nodes.is_empty());
        while depth > 0 {
            depth -= 1;
            let at = stack[depth];
            let node = &self.nodes[at];
            if !node.meets(ray.origin, inverse, nearest, furthest) {
                continue;
            }
            if node.count == 0 {
                stack[depth] = node.index;
                stack[depth + 1] = at + 1;
                depth += 2;
                continue;
            }
            for shape in &self.shapes[node.index..node.index + node.count] {
                match f(shape, furthest) {
                    Some(limit) => furthest = limit,
                    None => return,
                }
            }
        }
    }
}

impl Node {
    fn meets(&self, origin: Vec3, inverse: Vec3, nearest: f32, furthest: f32) -> bool {
        let (a, b) = ((self.low - origin) * inverse, (self.high - origin) * inverse);
        let entry = a.min(b).max_element().max(nearest);
        let exit = a.max(b).min_element().min(furthest);
        entry <= exit
    }
}

/// Appends the nodes of `shapes`, which start at `first`, split at the median of the longest axis.
fn build(nodes: &mut Vec<Node>, shapes: &mut [Shape], first: usize) {
    let empty = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let bound = |(low, high): (Vec3, Vec3), [a, b]: [Vec3; 2]| (low.min(a), high.max(b));
    let (low, high) = shapes.iter().map(Shape::bounds).fold(empty, bound);
    let at = nodes.len();
    nodes.push(Node { low, high, index: first, count: shapes.len() });
    if shapes.len() <= LEAF_SIZE {
        return;
    }
    let axis = (high - low).max_position();
    let middle = shapes.len() / 2;
    let centre = |shape: &Shape| {
        let [a, b] = shape.bounds();
        a[axis] + b[axis]
    };
    shapes.select_nth_unstable_by(middle, |a, b| centre(a).total_cmp(&centre(b)));
    let (left, right) = shapes.split_at_mut(middle);
    build(nodes, left, first);
    nodes[at] = Node { low, high, index: nodes.len(), count: 0 };
    build(nodes, right, first + middle);
}
