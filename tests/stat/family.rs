//! Families of tests: what many p-values say together.

use crate::special::count;
use crate::{chi_square, ks};

/// The probability that a family of correct samplers is rejected.
const SIGNIFICANCE: f64 = 0.01;

/// The tests of one family. Each is judged at 1 − (1 − 1 %)^{1/n} (Šidák 1967), so that n correct
/// samplers pass together with a probability of 99 %; seeds are fixed, so that a family that passes
/// does so always.
///
/// The p-values of correct tests are uniform. That is tested too: it finds what is wrong a little
/// everywhere, and statistics that are better than random.
#[derive(Default)]
pub(crate) struct Family {
    name: &'static str,
    p_values: Vec<(f64, String)>,
    outcomes: Vec<chi_square::Outcome>,
    verbose: bool,
}

impl Family {
    pub(crate) fn new(name: &'static str) -> Self {
        Self { name, ..Self::default() }
    }

    /// A family of the long tests, which says on stderr how far it is.
    pub(crate) fn long(name: &'static str) -> Self {
        Self { name, verbose: true, ..Self::default() }
    }

    /// A test that gives no more than a p-value.
    pub(crate) fn add(&mut self, p_value: f64, label: String) {
        if self.verbose {
            eprintln!("{} {:>5}  p = {p_value:.4}  {label}", self.name, self.p_values.len() + 1);
        }
        self.p_values.push((p_value, label));
    }

    pub(crate) fn add_outcome(&mut self, outcome: chi_square::Outcome) {
        self.add(outcome.p_value, outcome.label.clone());
        self.outcomes.push(outcome);
    }

    /// The significance of one test.
    pub(crate) fn threshold(&self) -> f64 {
        -((-SIGNIFICANCE).ln_1p() / count(self.p_values.len())).exp_m1()
    }

    /// Panics with every rejected test of the family.
    pub(crate) fn assert_accepted(mut self) {
        let threshold = self.threshold();
        let mut failures: Vec<String> =
            self.outcomes.iter().filter_map(|outcome| outcome.rejection(threshold)).collect();
        let statistics_only = |label: &String| self.outcomes.iter().all(|outcome| outcome.label != *label);
        for (p, label) in &self.p_values {
            if statistics_only(label) && (*p < threshold || p.is_nan()) {
                failures.push(format!("{label}: p = {p:.3e} < {threshold:.3e}"));
            }
        }
        self.p_values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut sorted: Vec<f64> = self.p_values.iter().map(|(p, _)| *p).collect();
        let uniformity = ks::p_value_of(&mut sorted);
        let smallest = self.p_values.first().expect("a family has tests");
        eprintln!(
            "{}: {} tests, smallest p = {:.2e} (rejected below {threshold:.2e}) at {}; p-values uniform: p = {uniformity:.3}",
            self.name,
            self.p_values.len(),
            smallest.0,
            smallest.1
        );
        if uniformity < 1e-3 {
            failures.push(format!("the p-values are not uniform: p = {uniformity:.2e}"));
        }
        assert!(failures.is_empty(), "{}: {} rejected\n{}", self.name, failures.len(), failures.join("\n"));
    }
}

/// Asserts that the statistic alone rejects a wrong pairing, at the significance a family of a
/// thousand tests has.
pub(crate) fn assert_rejected(outcome: &chi_square::Outcome) {
    eprintln!("negative control {}: p = {:.1e} {:?}", outcome.label, outcome.p_value, outcome.impossible);
    assert!(outcome.p_value < 1e-5, "accepted: {} with p = {:.3e}", outcome.label, outcome.p_value);
    assert!(outcome.rejection(1e-5).is_some());
}

/// Asserts that a density which does not integrate to 1 is rejected whatever the statistic is.
pub(crate) fn assert_impossible(outcome: &chi_square::Outcome) {
    eprintln!("negative control {}: p = {:.1e} {:?}", outcome.label, outcome.p_value, outcome.impossible);
    assert!(outcome.impossible.is_some() && outcome.rejection(0.0).is_some(), "accepted: {}", outcome.label);
}
