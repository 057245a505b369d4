//! The coefficient tables of the elementary functions, a file for each scalar.

mod double;
mod single;
