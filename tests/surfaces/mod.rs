//! The distributions of the crate, a row each. Every test crate and the benchmarks go through these
//! rows: a new distribution needs one more here, and nothing else in them.

use core::fmt;

use microsurface::batch::{Material, StagedVndf};
use microsurface::beckmann::BeckmannTo1e6;
use microsurface::profile::{SampleProfile, SampleVisibleProfile};
use microsurface::{
    AxisAligned, Beckmann, Error, Ggx, Gtr, Isotropic, Linear, Microsurface, Real, SampleNdf,
};

/// The properties of a distribution.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Columns {
    /// As in the benchmarks, and in the tables of 50-digit values for those of one γ.
    pub(crate) name: &'static str,
    /// Whether the profile has a width α ≤ 1 of its own, below that of its map.
    pub(crate) own_width: bool,
    /// The exponents γ of the tail that lists go through: 2 of GGX, ∞ where it is Gaussian.
    pub(crate) gammas: &'static [f64],
    /// The smallest and the largest γ.
    pub(crate) range: [f64; 2],
    pub(crate) mask: Mask,
    /// The row that has the same density and mask, and is sampled otherwise.
    pub(crate) sampling_of: Option<Row>,
    /// The roundings of D at an exact normal: so many, and so many times γ.
    pub(crate) roundings: [f64; 2],
    /// How often random tests take it.
    pub(crate) share: u8,
}

/// How near σ is to that of D.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mask {
    /// To rounding.
    Exact,
    /// To the error of eight nodes.
    Nodes,
    /// To that of the spline of the paper.
    Spline,
}

/// A profile without parameters, with an exact mask.
const PLAIN: Columns = Columns {
    name: "",
    own_width: false,
    gammas: &[2.0],
    range: [2.0; 2],
    mask: Mask::Exact,
    sampling_of: None,
    roundings: [5.0, 0.0],
    share: 9,
};
const BECKMANN: Columns = Columns {
    name: "beckmann",
    gammas: &[f64::INFINITY],
    range: [f64::INFINITY; 2],
    roundings: [4.0, 0.0],
    ..PLAIN
};
/// GTR of any γ.
const GTR: Columns = Columns {
    name: "gtr-8-nodes",
    own_width: true,
    gammas: &[0.3, 1.2, 1.5, 2.01, 2.5, 3.9, 7.3],
    range: [0.0, 10.0],
    mask: Mask::Nodes,
    roundings: [8.0, 0.8],
    share: 6,
    ..PLAIN
};
/// GTR of an integer γ.
const CLOSED: Columns = Columns { mask: Mask::Exact, roundings: [6.0, 0.0], share: 1, ..GTR };

/// Defines [`Row`] and what each is made of: its columns, whether its visible normals can be drawn,
/// and the profile of an α and a γ. The rows of the first block stand for all where every one is
/// compiled dozens of times.
macro_rules! rows {
    (@visible visible) => { true };
    (@visible all_normals) => { false };
    (@visit $visitor:ident, $row:ident; $($name:ident $normals:ident $profile:expr;)*) => {
        match $row {
            $(Row::$name => Some($visitor.$normals($profile)),)*
            #[allow(unreachable_patterns, reason = "of the rows that stand for all, not of all")]
            _ => None,
        }
    };
    (
        some {
            $($(#[$doc:meta])* $row:ident = $columns:expr => $normals:ident($profile:expr);)*
        }
        others {
            $($(#[$other_doc:meta])* $other:ident = $other_columns:expr => $other_normals:ident($other_profile:expr);)*
        }
    ) => {
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(crate) enum Row {
            $($(#[$doc])* $row,)*
            $($(#[$other_doc])* $other,)*
        }

        impl Row {
            pub(crate) const ALL: &[Self] = &[$(Self::$row,)* $(Self::$other,)*];
            /// Those that stand for all.
            pub(crate) const SOME: &[Self] = &[$(Self::$row,)*];

            pub(crate) const fn columns(self) -> Columns {
                match self {
                    $(Self::$row => $columns,)*
                    $(Self::$other => $other_columns,)*
                }
            }

            /// Whether visible normals can be drawn.
            pub(crate) const fn samples_visible(self) -> bool {
                match self {
                    $(Self::$row => rows!(@visible $normals),)*
                    $(Self::$other => rows!(@visible $other_normals),)*
                }
            }

            /// Shows to `visitor` how a profile is made.
            pub(crate) fn visit<T: Real, V: Visitor<T>>(self, visitor: V) -> V::Output {
                let output = rows!(@visit visitor, self;
                    $($row $normals $profile;)* $($other $other_normals $other_profile;)*);
                output.expect("one of all")
            }

            /// Shows the same for a row that stands for all.
            pub(crate) fn visit_some<T: Real, V: Visitor<T>>(self, visitor: V) -> V::Output {
                let output = rows!(@visit visitor, self; $($row $normals $profile;)*);
                output.expect("one that stands for all")
            }
        }
    };
}

rows! {
    some {
        Ggx = Columns { name: "ggx", ..PLAIN } => visible(|_, _| Ok(Ggx));
        Beckmann = BECKMANN => visible(|_, _| Ok(Beckmann));
        BeckmannTo1e6 = Columns { name: "beckmann-to-1e-6", sampling_of: Some(Row::Beckmann), share: 2, ..BECKMANN }
            => visible(|_, _| Ok(BeckmannTo1e6));
        /// The mask of eight nodes.
        Gtr = GTR => visible(|alpha, gamma| Ok(*Gtr::isotropic(alpha, gamma)?.profile()));
        HeavyGtr = Columns { name: "gtr-heavy-8-nodes", gammas: &[0.3, 1.2, 1.5, 2.0], range: [0.0, 2.0], share: 3, ..GTR }
            => visible(|alpha, gamma| Ok(*Gtr::heavy_tailed::<8>(alpha, gamma)?.profile()));
        SplineGtr = Columns {
                name: "gtr-spline",
                gammas: &[0.3, 1.5, 2.5, 3.9],
                range: [0.0, 4.0],
                mask: Mask::Spline,
                roundings: [6.0, 0.0],
                ..GTR
            } => all_normals(|alpha, gamma| Ok(*Gtr::spline(alpha, gamma)?.profile()));
        Gtr1 = Columns { name: "gtr-closed-1", gammas: &[1.0], range: [1.0; 2], ..CLOSED }
            => visible(|alpha, _| Ok(*Gtr::closed::<1>(alpha)?.profile()));
        Gtr3 = Columns { name: "gtr-closed-3", gammas: &[3.0], range: [3.0; 2], ..CLOSED }
            => visible(|alpha, _| Ok(*Gtr::closed::<3>(alpha)?.profile()));
    }
    others {
        Gtr0 = Columns { name: "gtr-closed-0", gammas: &[0.0], range: [0.0; 2], ..CLOSED }
            => visible(|alpha, _| Ok(*Gtr::closed::<0>(alpha)?.profile()));
        Gtr2 = Columns { name: "gtr-closed-2", gammas: &[2.0], range: [2.0; 2], ..CLOSED }
            => visible(|alpha, _| Ok(*Gtr::closed::<2>(alpha)?.profile()));
        Gtr4 = Columns { name: "gtr-closed-4", gammas: &[4.0], range: [4.0; 2], ..CLOSED }
            => visible(|alpha, _| Ok(*Gtr::closed::<4>(alpha)?.profile()));
        Gtr6 = Columns { name: "gtr-closed-6", gammas: &[6.0], range: [6.0; 2], ..CLOSED }
            => visible(|alpha, _| Ok(*Gtr::closed::<6>(alpha)?.profile()));
        Gtr10 = Columns { name: "gtr-closed-10", gammas: &[10.0], range: [10.0; 2], ..CLOSED }
            => visible(|alpha, _| Ok(*Gtr::closed::<10>(alpha)?.profile()));
    }
}

impl Row {
    /// The distribution of an own width and a tail; where there are none, they do not count.
    pub(crate) const fn with(self, alpha: f64, gamma: f64) -> Distribution {
        let columns = self.columns();
        Distribution {
            row: self,
            alpha: if columns.own_width { alpha } else { 1.0 },
            gamma: gamma.clamp(columns.range[0], columns.range[1]),
        }
    }

    /// The distributions of an own width, of every tail that lists go through.
    pub(crate) fn of_width(self, alpha: f64) -> impl Iterator<Item = Distribution> {
        self.columns().gammas.iter().map(move |&gamma| self.with(alpha, gamma))
    }

    /// The row by its share of a number in [0, 1).
    pub(crate) fn drawn(u: f64) -> Self {
        let total: u32 = Self::ALL.iter().map(|row| u32::from(row.columns().share)).sum();
        let mut left = u * f64::from(total);
        let mut rows = Self::ALL.iter().copied();
        let found = rows.find(|row| {
            left -= f64::from(row.columns().share);
            left < 0.0
        });
        found.expect("a number below 1")
    }

    /// The rows whose density and mask no other has.
    pub(crate) fn with_own_density() -> impl Iterator<Item = Self> {
        Self::ALL.iter().copied().filter(|row| row.columns().sampling_of.is_none())
    }
}

/// A distribution before its map, as plain data.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Distribution {
    pub(crate) row: Row,
    /// The own width, 1 where there is none.
    pub(crate) alpha: f64,
    /// The exponent of the tail, ∞ where it is Gaussian.
    pub(crate) gamma: f64,
}

impl Distribution {
    pub(crate) const GGX: Self = Row::Ggx.with(1.0, 2.0);
    pub(crate) const BECKMANN: Self = Row::Beckmann.with(1.0, f64::INFINITY);
}

impl Distribution {
    /// The profile.
    pub(crate) fn profile<T: Real, P>(&self, profile: impl Fn(T, T) -> Result<P, Error>) -> Result<P, Error> {
        profile(T::lit(self.alpha), T::lit(self.gamma))
    }
}

impl fmt::Debug for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Columns { own_width, range: [low, high], .. } = self.row.columns();
        write!(f, "{:?}", self.row)?;
        if own_width {
            write!(f, " α {}", self.alpha)?;
        }
        if low < high { write!(f, " γ {}", self.gamma) } else { Ok(()) }
    }
}

/// A surface that batches take as it is.
pub(crate) trait Batched<T>: SampleNdf<Scalar = T> + Material<Local = Self> {}
impl<T, N: SampleNdf<Scalar = T> + Material<Local = N>> Batched<T> for N {}

/// A use of the profiles of a row, of whichever type. They are made of an α and a γ.
pub(crate) trait Visitor<T: Real> {
    type Output;

    /// Profiles whose visible normals can be drawn.
    fn visible<P>(self, profile: impl Fn(T, T) -> Result<P, Error>) -> Self::Output
    where
        P: SampleProfile<T> + SampleVisibleProfile<T> + 'static,
        Microsurface<P, Isotropic<T>>: Batched<T> + StagedVndf,
        Microsurface<P, AxisAligned<T>>: Batched<T> + StagedVndf,
        Microsurface<P, Linear<T>>: Batched<T> + StagedVndf;

    /// Profiles of which all normals can be drawn and no more.
    fn all_normals<P>(self, profile: impl Fn(T, T) -> Result<P, Error>) -> Self::Output
    where
        P: SampleProfile<T> + 'static,
        Microsurface<P, Isotropic<T>>: Batched<T>,
        Microsurface<P, AxisAligned<T>>: Batched<T>,
        Microsurface<P, Linear<T>>: Batched<T>;
}
