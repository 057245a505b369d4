//! Filtering.

mod footprints;
