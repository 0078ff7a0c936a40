//! Dimensions and units of motions.

use trilith_element::Dimension;
use trilith_element::dimension::{ACCELERATION, FREQUENCY, LENGTH, NONE, TIME, VELOCITY};

/// Dimensions of displacement, velocity and acceleration of a direction.
pub(crate) fn nodal_dimension(order: usize, rotation: bool) -> Dimension {
    match (order, rotation) {
        (0, false) => LENGTH,
        (1, false) => VELOCITY,
        (_, false) => ACCELERATION,
        (0, true) => NONE,
        (1, true) => FREQUENCY,
        (_, true) => FREQUENCY / TIME,
    }
}

/// The unit of a recorded quantity; angles are told from pure numbers.
pub(super) fn unit(dimension: Dimension, angle: bool) -> String {
    if !angle {
        return dimension.unit();
    }
    match -dimension.time {
        0.0 => "rad".into(),
        1.0 => "rad/s".into(),
        _ => "rad/s²".into(),
    }
}
