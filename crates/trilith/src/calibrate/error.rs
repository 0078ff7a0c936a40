//! Why a model cannot be calibrated.

/// Why a model cannot be calibrated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// Nothing to calibrate.
    #[error(
        "no contact with a dashpot carries the structure upwards: calibration needs links such as NLink under a body"
    )]
    NoFeet,
    /// The structure is held by more than its contacts.
    #[error(
        "the structure does not stand free on its contacts: supports or springs hold it against {motion}"
    )]
    Held {
        /// The rigid motion that something resists.
        motion: &'static str,
    },
    /// A body that cannot be put down as a rigid one.
    #[error(
        "the body is made of matrices with rows of their own, which cannot be placed one by one: calibrate a rigid body of the same mass"
    )]
    InnerRows,
    /// A body that rests on one line.
    #[error("rocking needs feet at two places along {along}, these stand at one")]
    OneFoot {
        /// The horizontal direction.
        along: &'static str,
    },
    /// A body whose weight is not between its feet.
    #[error(
        "the centre of gravity at {center} m is not between the outer feet at {from} m and {to} m: the body does not stand"
    )]
    Falls {
        /// Position of the centre of gravity, m.
        center: f64,
        /// Position of the first foot, m.
        from: f64,
        /// Position of the last foot, m.
        to: f64,
    },
    /// Feet that cannot be struck at once.
    #[error("the feet cannot all be struck at once, so there is no flat drop")]
    NoFlatDrop,
    /// A value that makes no sense.
    #[error("{what} = {value} is out of range")]
    Range {
        /// What it is.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// No dashpot gives what is wanted.
    #[error(
        "{what} {wanted} is out of reach: it is {without} without a dashpot, and a dashpot can only lower it"
    )]
    Unreachable {
        /// What is wanted.
        what: &'static str,
        /// The value wanted.
        wanted: f64,
        /// The value without dashpot.
        without: f64,
    },
    /// An experiment that stopped.
    #[error("an experiment did not come to its end: {reason}")]
    Run {
        /// What the solver said.
        reason: String,
    },
}
