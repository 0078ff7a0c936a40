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
    /// A motion of more steps than a model file can hold.
    #[error(
        "a motion of {steps:.3e} steps is too long: at most {max} are made; shorten `duration` or lengthen `dt`",
        max = super::frame::MOST_STEPS
    )]
    TooLong {
        /// Duration over step.
        steps: f64,
    },
    /// A step that is longer than the motion.
    #[error("`dt` is {dt} s: must be at most the duration, {duration} s")]
    NoStep {
        /// s.
        dt: f64,
        /// s.
        duration: f64,
    },
    /// More vectors of the basis than the frame has directions.
    #[error("`vectors` is {vectors}: a frame of {nodes} nodes has {directions} directions")]
    Vectors {
        /// As asked for.
        vectors: usize,
        /// Of the frame.
        nodes: usize,
        /// Six to a node.
        directions: usize,
    },
    /// Something that follows from the numbers is no number that a model could have.
    #[error("{what} comes out as {value:e} {unit}: must be above 0 and at most {most:e} {unit}")]
    OutOfReach {
        /// What, such as `the length along X`.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Largest value.
        most: f64,
        /// SI unit of both.
        unit: &'static str,
    },
}
