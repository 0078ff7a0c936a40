//! Sums over vectors.

pub(crate) use trilith_linalg::{add, dot, largest, residual, sized_residual};
