//! What the checks have found.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::float::within;

/// The outcome of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing is wrong that the check could see.
    Passed,
    /// Something is wrong.
    Failed,
    /// The kit could not tell: its quadrature did not reach the precision that it needs.
    Undecided,
}

/// One check.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// The statement that must hold.
    pub name: &'static str,
    /// Whether it does.
    pub verdict: Verdict,
    /// The largest deviation that was seen, in the unit of `bound`.
    pub worst: f64,
    /// The largest deviation that is allowed; for statistical checks the smallest p-value.
    pub bound: f64,
    /// The p-value of a statistical check.
    pub p_value: Option<f64>,
    /// Where the worst was seen: the input, in decimal and in bits.
    pub at: String,
    /// More than a line: the cells of a χ² test, and where the excess lies.
    pub details: String,
}

/// The outcome of a set of checks. [`Display`](fmt::Display) prints a table.
#[derive(Debug, Clone, PartialEq)]
#[must_use = "a report says nothing until it is read: call `assert`"]
pub struct Report {
    /// The checks, in the order in which they were made.
    pub checks: Vec<Check>,
    /// The probability that a right subject fails one of the statistical checks.
    false_alarms: f64,
}

impl Report {
    pub(super) fn new(false_alarms: f64) -> Self {
        Self { checks: Vec::new(), false_alarms }
    }

    /// A check against a bound.
    pub(super) fn push(&mut self, name: &'static str, seen: Seen, bound: f64) {
        let Seen { worst, uncertain, at, count } = seen;
        let verdict = if count == 0 || uncertain && worst <= bound {
            Verdict::Undecided
        } else if worst <= bound {
            Verdict::Passed
        } else {
            Verdict::Failed
        };
        self.checks.push(Check { name, verdict, worst, bound, p_value: None, at, details: String::new() });
    }

    /// A statistical check; the verdict is that of [`judge`](Self::judge).
    pub(super) fn push_p_value(&mut self, name: &'static str, p_value: f64, at: String, details: String) {
        let check = Check {
            name,
            verdict: Verdict::Passed,
            worst: p_value,
            bound: 0.0,
            p_value: Some(p_value),
            at,
            details,
        };
        self.checks.push(check);
    }

    /// A check that has a verdict already.
    pub(super) fn push_verdict(&mut self, name: &'static str, verdict: Verdict, at: String) {
        let (worst, bound) = (f64::from(u8::from(verdict != Verdict::Passed)), 0.0);
        self.checks.push(Check { name, verdict, worst, bound, p_value: None, at, details: String::new() });
    }

    /// Judges the statistical checks together: each at 1 − (1 − a)^{1/n} (Šidák 1967), so that a
    /// right subject passes all n with a probability of 1 − a.
    pub(super) fn judge(mut self) -> Self {
        let n = self.checks.iter().filter(|check| check.p_value.is_some()).count().max(1);
        #[expect(clippy::cast_precision_loss, reason = "a few checks")]
        let least = -((-self.false_alarms).ln_1p() / n as f64).exp_m1();
        for check in &mut self.checks {
            if let Some(p) = check.p_value {
                check.bound = least;
                if check.verdict != Verdict::Undecided {
                    check.verdict = if p >= least { Verdict::Passed } else { Verdict::Failed };
                }
            }
        }
        self
    }

    /// Both reports in one; the probabilities of a false alarm add up.
    pub fn and(mut self, other: Self) -> Self {
        self.checks.extend(other.checks);
        self.false_alarms += other.false_alarms;
        self
    }

    /// The check of this name, the first of several.
    #[must_use]
    pub fn check(&self, name: &str) -> Option<&Check> {
        self.checks.iter().find(|check| check.name == name)
    }

    /// Whether every check has passed.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.checks.iter().all(|check| check.verdict == Verdict::Passed)
    }

    /// The worst check of each name and verdict, and how many views it is the worst of.
    fn worst_of_each(&self) -> impl Iterator<Item = (&Check, usize)> {
        let same = |a: &Check, b: &Check| a.name == b.name && a.verdict == b.verdict;
        // By p, or by the deviation; the first of equals.
        let rank = |check: &Check| check.p_value.unwrap_or(-check.worst);
        self.checks.iter().enumerate().filter_map(move |(i, check)| {
            let others = || self.checks.iter().enumerate().filter(|(_, other)| same(other, check));
            let beaten =
                |(j, other): (usize, &Check)| rank(other).total_cmp(&rank(check)).then(j.cmp(&i)).is_lt();
            (!others().any(beaten)).then(|| (check, others().count()))
        })
    }

    /// The checks that have failed.
    pub fn failures(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| check.verdict == Verdict::Failed)
    }

    /// Nothing, if every check has passed.
    ///
    /// # Panics
    /// With the table, if one has failed or is undecided.
    #[track_caller]
    pub fn assert(&self) {
        assert!(self.passed(), "\n{self}");
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<10} {:<46} {:>11} {:>11}  at", "verdict", "check", "worst", "bound")?;
        for (check, same) in self.worst_of_each() {
            let verdict = match check.verdict {
                Verdict::Passed => "passed",
                Verdict::Failed => "FAILED",
                Verdict::Undecided => "undecided",
            };
            let number =
                |x: f64| if check.p_value.is_some() { format!("p {x:.2e}") } else { format!("{x:.2e}") };
            writeln!(
                f,
                "{verdict:<10} {:<46} {:>11} {:>11}  {}{}",
                check.name,
                number(check.worst),
                number(check.bound),
                if same > 1 { format!("worst of {same}: ") } else { String::new() },
                check.at
            )?;
        }
        for (check, _) in self.worst_of_each() {
            if check.verdict != Verdict::Passed && !check.details.is_empty() {
                writeln!(f, "\n{}, {}\n{}", check.name, check.at, check.details)?;
            }
        }
        Ok(())
    }
}

/// The worst that one check has seen.
#[derive(Debug, Clone, Default)]
pub(super) struct Seen {
    pub(super) worst: f64,
    /// Whether some of what was seen was not known precisely enough to be judged.
    uncertain: bool,
    at: String,
    count: usize,
}

impl Seen {
    /// Takes in a deviation; NaN is ∞.
    pub(super) fn see(&mut self, deviation: f64, at: impl FnOnce() -> String) {
        let deviation = if deviation.is_nan() { f64::INFINITY } else { deviation };
        self.count += 1;
        if self.count == 1 || deviation > self.worst {
            (self.worst, self.at) = (deviation, at());
        }
    }

    /// Takes in the relative deviation of an integral from what it must be. It has failed where the
    /// deviation without the integral's own bound is above `allowed`, and passed where it is below
    /// with the bound; between them nothing is known.
    pub(super) fn see_integral(
        &mut self,
        [value, bound]: [f64; 2],
        expected: f64,
        allowed: f64,
        at: impl FnOnce() -> String,
    ) {
        let (deviation, bound) = ((value / expected - 1.0).abs(), (bound / expected).abs());
        self.uncertain |= !within(deviation + bound, allowed);
        self.see(if deviation.is_nan() { deviation } else { (deviation - bound).max(0.0) }, at);
    }
}
