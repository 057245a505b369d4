//! Filters of distributions.

mod deferred;
mod means;
mod normal_map;
mod projected;
