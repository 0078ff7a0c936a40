//! What a frame cannot be.

/// Why there is no such frame.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FrameError {
    /// A count that must be at least 1.
    #[error("`{0}` must be at least 1")]
    None(&'static str),
    /// A number that must be above zero.
    #[error("`{name}` is {value}: must be above 0 and finite")]
    NotPositive {
        /// Which.
        name: &'static str,
        /// What it is.
        value: f64,
    },
    /// More nodes than can be numbered by hand or machine.
    #[error("a frame of {0} nodes is too large: at most {max} are made", max = super::frame::MOST_NODES)]
    TooLarge(f64),
}
