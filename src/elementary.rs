//! Elementary functions, branch-free.
pub mod kernel;
