//! Filters of distributions.

mod deferred;
mod footprints;
mod means;
mod normal_map;
mod projected;
