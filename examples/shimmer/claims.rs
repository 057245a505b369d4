//! What is claimed of the filters, checked.

use crate::study::Study;

pub(crate) fn check(studies: &[Study]) -> bool {
    studies.iter().flat_map(|study| &study.rows).all(|row| row.errors.faults == 0)
}
