//! Searches for the worst error over a whole domain, where a table has chosen points only.

pub(crate) mod climb;
