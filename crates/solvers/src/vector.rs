//! Sums over vectors.

pub(crate) use trilith_linalg::{dot, largest, residual};
