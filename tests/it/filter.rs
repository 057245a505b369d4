//! Filters of distributions.

mod means;
