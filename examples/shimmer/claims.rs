//! What is claimed of the filters, checked with the numbers of the tables.

use crate::effort::SIXTEEN;
use crate::methods::{
    ANALYTIC_BOX, ANALYTIC_PARALLELOGRAM, ANALYTIC_SLOPES, BOX, DEFERRED, GAUSSIAN, PARALLELOGRAM, PROJECTED,
    PROJECTED_2021, RECTANGLE, SLOPES, UNFILTERED,
};
use crate::study::{Row, Study};

/// Prints each claim with its numbers. Returns whether all hold.
pub(crate) fn check(studies: &[Study]) -> bool {
    let mut claims = Claims { all_hold: true };
    println!("Claims:");
    for study in studies {
        println!("{} of {}:", study.scene, study.material);
        claims.of_study(study);
    }
    claims.all_hold
}

struct Claims {
    all_hold: bool,
}

impl Claims {
    /// Prints a claim that `left` is below `right`.
    fn below(&mut self, claim: &str, left: f64, right: f64) {
        // NaN holds nothing.
        let holds = left < right;
        println!("- {}: {claim}: {left:.4} < {right:.4}", if holds { "holds" } else { "FAILS" });
        self.all_hold &= holds;
    }

    fn of_study(&mut self, study: &Study) {
        let row = |name: &str| -> &Row {
            study
                .rows
                .iter()
                .find(|row| row.name == name)
                .expect("the methods of the claims are in the table")
        };
        let faults = study.rows.iter().map(|row| row.errors.faults).sum::<usize>();
        self.below("NaN, infinite and negative pixels are fewer than one", faults as f64, 1.0);

        let ggx = study.material == "GGX";
        let rmse = |name| row(name).errors.rmse;
        // The mean over the parallelogram has a closed form for GGX, the convolution with a
        // Gaussian for Beckmann.
        let (analytic, quad) =
            if ggx { (ANALYTIC_PARALLELOGRAM, PARALLELOGRAM) } else { (ANALYTIC_BOX, BOX) };
        let claim = format!("RMSE of one sample by {analytic:?} is below that of 16 samples");
        self.below(&claim, rmse(analytic), rmse(SIXTEEN));
        let claim = format!(
            "RMSE of one sample by {quad:?}, of differences in quads, is below half of that unfiltered"
        );
        self.below(&claim, rmse(quad), 0.5 * rmse(UNFILTERED));

        let flicker = |name| row(name).flicker.change();
        self.below(
            "unfiltered, pixels change more than 1.5 times as much as they should",
            1.5,
            flicker(UNFILTERED),
        );
        let claim = format!("by {quad:?} the change is wrong by less than a fifth");
        self.below(&claim, (flicker(quad) - 1.0).abs(), 0.2);
        let claim = format!("by {quad:?} the energy is wrong by less than a tenth");
        self.below(&claim, (row(quad).errors.energy - 1.0).abs(), 0.1);
        // Steady, and no highlight any more.
        let claim = format!("by {DEFERRED:?} they change less than 0.6 times as much as they should");
        self.below(&claim, flicker(DEFERRED), 0.6);
        let claim =
            format!("for it blurs highlights away: none of {DEFERRED:?} is half as bright as it should be");
        self.below(&claim, row(DEFERRED).flicker.peaks()[1], 0.5);

        if ggx {
            let toned = |name| row(name).errors.toned;
            let claim = format!(
                "by {SLOPES:?} the picture as a whole is worse than unfiltered: twice the toned RMSE"
            );
            self.below(&claim, 2.0 * toned(UNFILTERED), toned(SLOPES));
            let claim = format!("by {quad:?} it is less than half");
            self.below(&claim, toned(quad), 0.5 * toned(UNFILTERED));
            let grazing = |name| row(name).errors.grazing;
            let claim = format!("by {SLOPES:?}, pixels of grazing half vectors are wrong by more than 0.3");
            self.below(&claim, 0.3, grazing(SLOPES));
            for name in [PROJECTED, PROJECTED_2021, RECTANGLE, PARALLELOGRAM, GAUSSIAN] {
                let claim = format!("by {name:?} they are wrong by less than a tenth of that");
                self.below(&claim, grazing(name), 0.1 * grazing(SLOPES));
            }
            self.below(
                "it is not for want of better derivatives: with analytic ones the former are wrong by more than 0.3 too",
                0.3,
                grazing(ANALYTIC_SLOPES),
            );
        }
    }
}
