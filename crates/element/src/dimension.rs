//! Physical dimensions as exponents of mass, length and time.

use std::fmt;
use std::ops::{Div, Mul};

/// Exponents of mass, length and time. Angles count as pure numbers.
///
/// Exponents are real, because a power-law dashpot has the dimension N·(s/m)^α.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimension {
    /// Exponent of mass.
    pub mass: f64,
    /// Exponent of length.
    pub length: f64,
    /// Exponent of time.
    pub time: f64,
}

const fn dim(mass: f64, length: f64, time: f64) -> Dimension {
    Dimension { mass, length, time }
}

/// A pure number.
pub const NONE: Dimension = dim(0.0, 0.0, 0.0);
/// m.
pub const LENGTH: Dimension = dim(0.0, 1.0, 0.0);
/// m².
pub const AREA: Dimension = dim(0.0, 2.0, 0.0);
/// m⁴, second moment of area.
pub const SECOND_MOMENT: Dimension = dim(0.0, 4.0, 0.0);
/// s.
pub const TIME: Dimension = dim(0.0, 0.0, 1.0);
/// 1/s: frequency in Hz, or rad/s.
pub const FREQUENCY: Dimension = dim(0.0, 0.0, -1.0);
/// kg.
pub const MASS: Dimension = dim(1.0, 0.0, 0.0);
/// kg/m.
pub const MASS_PER_LENGTH: Dimension = dim(1.0, -1.0, 0.0);
/// kg/m³.
pub const DENSITY: Dimension = dim(1.0, -3.0, 0.0);
/// kg·m², rotary inertia.
pub const INERTIA: Dimension = dim(1.0, 2.0, 0.0);
/// m/s.
pub const VELOCITY: Dimension = dim(0.0, 1.0, -1.0);
/// s/m, rate constant of velocity-dependent friction.
pub const INVERSE_VELOCITY: Dimension = dim(0.0, -1.0, 1.0);
/// m/s².
pub const ACCELERATION: Dimension = dim(0.0, 1.0, -2.0);
/// N.
pub const FORCE: Dimension = dim(1.0, 1.0, -2.0);
/// N·m, moment, energy.
pub const MOMENT: Dimension = dim(1.0, 2.0, -2.0);
/// N/m².
pub const STRESS: Dimension = dim(1.0, -1.0, -2.0);
/// N/m.
pub const STIFFNESS: Dimension = dim(1.0, 0.0, -2.0);
/// N·m/rad.
pub const ROTATIONAL_STIFFNESS: Dimension = MOMENT;
/// N·s/m.
pub const DAMPING: Dimension = dim(1.0, 0.0, -1.0);
/// N·m·s/rad.
pub const ROTATIONAL_DAMPING: Dimension = dim(1.0, 2.0, -1.0);

impl Dimension {
    /// The dimension raised to a power.
    #[must_use]
    pub fn powf(self, exponent: f64) -> Self {
        dim(self.mass * exponent, self.length * exponent, self.time * exponent)
    }

    /// Equal up to rounding of real exponents.
    #[must_use]
    pub fn matches(self, other: Self) -> bool {
        let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
        close(self.mass, other.mass)
            && close(self.length, other.length)
            && close(self.time, other.time)
    }

    /// True for a pure number.
    #[must_use]
    pub fn is_none(self) -> bool {
        self.matches(NONE)
    }

    /// The usual SI unit of the dimension, such as `N/m`, or a product of powers where there is none.
    #[must_use]
    pub fn unit(self) -> String {
        const NAMED: [(Dimension, &str); 19] = [
            (NONE, "1"),
            (LENGTH, "m"),
            (AREA, "m²"),
            (SECOND_MOMENT, "m⁴"),
            (TIME, "s"),
            (FREQUENCY, "1/s"),
            (MASS, "kg"),
            (MASS_PER_LENGTH, "kg/m"),
            (DENSITY, "kg/m³"),
            (INERTIA, "kg·m²"),
            (VELOCITY, "m/s"),
            (INVERSE_VELOCITY, "s/m"),
            (ACCELERATION, "m/s²"),
            (FORCE, "N"),
            (MOMENT, "N·m"),
            (STRESS, "N/m²"),
            (STIFFNESS, "N/m"),
            (DAMPING, "N·s/m"),
            (ROTATIONAL_DAMPING, "N·m·s"),
        ];
        if let Some((_, unit)) = NAMED.iter().find(|(d, _)| d.matches(self)) {
            return (*unit).to_owned();
        }
        [("kg", self.mass), ("m", self.length), ("s", self.time)]
            .iter()
            .filter(|(_, e)| *e != 0.0)
            .map(|(u, e)| if *e == 1.0 { (*u).to_owned() } else { format!("{u}^{e}") })
            .collect::<Vec<_>>()
            .join("·")
    }
}

impl Mul for Dimension {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        dim(self.mass + o.mass, self.length + o.length, self.time + o.time)
    }
}

impl Div for Dimension {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        dim(self.mass - o.mass, self.length - o.length, self.time - o.time)
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.unit())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_find_their_usual_unit() {
        assert_eq!((STIFFNESS * LENGTH).unit(), "N");
        assert_eq!((FORCE / VELOCITY).unit(), "N·s/m");
        assert_eq!((FORCE / VELOCITY.powf(0.5)).unit(), "kg·m^0.5·s^-1.5");
    }
}
