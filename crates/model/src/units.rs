//! Units of measurement and what bare numbers of a file mean.

use crate::expression::{NoNames, evaluate};
use trilith_element::Dimension;
use trilith_element::dimension as d;

/// Standard gravity, m/s².
pub const STANDARD_GRAVITY: f64 = 9.806_65;
const POUND: f64 = 0.453_592_37;
const POUND_FORCE: f64 = POUND * STANDARD_GRAVITY;
const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;

/// A unit that may follow a number.
pub(crate) struct Unit {
    pub name: &'static str,
    /// In SI.
    pub factor: f64,
    pub dimension: Dimension,
}

const fn unit(name: &'static str, factor: f64, dimension: Dimension) -> Unit {
    Unit { name, factor, dimension }
}

/// All units. `g` is standard gravity, an acceleration; `Hz` and `rpm` are cycles per time; angles,
/// `%` and kelvins are pure numbers.
pub(crate) const UNITS: &[Unit] = &[
    unit("m", 1.0, d::LENGTH),
    unit("mm", 1e-3, d::LENGTH),
    unit("cm", 1e-2, d::LENGTH),
    unit("km", 1e3, d::LENGTH),
    unit("um", 1e-6, d::LENGTH),
    unit("µm", 1e-6, d::LENGTH),
    unit("in", INCH, d::LENGTH),
    unit("ft", FOOT, d::LENGTH),
    unit("kg", 1.0, d::MASS),
    unit("t", 1e3, d::MASS),
    unit("tonne", 1e3, d::MASS),
    unit("lbm", POUND, d::MASS),
    unit("slug", POUND_FORCE / FOOT, d::MASS),
    unit("g", STANDARD_GRAVITY, d::ACCELERATION),
    unit("N", 1.0, d::FORCE),
    unit("kN", 1e3, d::FORCE),
    unit("MN", 1e6, d::FORCE),
    unit("GN", 1e9, d::FORCE),
    unit("lbf", POUND_FORCE, d::FORCE),
    unit("kip", 1e3 * POUND_FORCE, d::FORCE),
    unit("kgf", STANDARD_GRAVITY, d::FORCE),
    unit("tonf", 1e3 * STANDARD_GRAVITY, d::FORCE),
    unit("Pa", 1.0, d::STRESS),
    unit("kPa", 1e3, d::STRESS),
    unit("MPa", 1e6, d::STRESS),
    unit("GPa", 1e9, d::STRESS),
    unit("psi", POUND_FORCE / (INCH * INCH), d::STRESS),
    unit("ksi", 1e3 * POUND_FORCE / (INCH * INCH), d::STRESS),
    unit("s", 1.0, d::TIME),
    unit("ms", 1e-3, d::TIME),
    unit("min", 60.0, d::TIME),
    unit("h", 3600.0, d::TIME),
    unit("Hz", 1.0, d::FREQUENCY),
    unit("rpm", 1.0 / 60.0, d::FREQUENCY),
    unit("J", 1.0, d::MOMENT),
    unit("kJ", 1e3, d::MOMENT),
    unit("MJ", 1e6, d::MOMENT),
    unit("rad", 1.0, d::NONE),
    unit("deg", std::f64::consts::PI / 180.0, d::NONE),
    unit("%", 0.01, d::NONE),
    unit("K", 1.0, d::NONE),
];

/// The unit of that name.
pub(crate) fn find(name: &str) -> Option<&'static Unit> {
    UNITS.iter().find(|u| u.name == name)
}

/// The dimension of a unit as [`Dimension::unit`] writes it.
pub(crate) fn dimension(text: &str) -> Option<Dimension> {
    if text == "1" {
        return Some(d::NONE);
    }
    evaluate(&format!("1 {text}"), &mut NoNames).ok().map(|q| q.dimension)
}

/// The dimension of a unit of SI without a factor, such as `N/m`, `kg*m^2` or `1`; none for any other text, such as `kN`.
#[must_use]
pub fn si_dimension(unit: &str) -> Option<Dimension> {
    if unit == "1" {
        return Some(d::NONE);
    }
    let whole = evaluate(&format!("1 {unit}"), &mut NoNames).ok()?;
    (whole.measured && whole.value == 1.0).then_some(whole.dimension)
}

/// What bare numbers of a file are measured in, as SI factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FileUnits {
    pub length: f64,
    pub mass: f64,
    pub time: f64,
}

impl Default for FileUnits {
    fn default() -> Self {
        Self { length: 1.0, mass: 1.0, time: 1.0 }
    }
}

impl FileUnits {
    /// SI value of a bare 1 of this dimension.
    pub fn scale(self, of: Dimension) -> f64 {
        // Powers of exactly one stay exact, so SI files see their numbers unchanged.
        let power =
            |base: f64, e: f64| if e == e.trunc() { base.powi(e as i32) } else { base.powf(e) };
        power(self.length, of.length) * power(self.mass, of.mass) * power(self.time, of.time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inch_and_kip_files_have_consistent_masses() {
        let kip = 4_448.221_615_260_5;
        let mass = kip / INCH; // kip s²/in
        let units = FileUnits { length: INCH, mass, time: 1.0 };
        assert!((units.scale(d::FORCE) / kip - 1.0).abs() < 1e-14);
        assert!((units.scale(d::STIFFNESS) / (kip / INCH) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_unit_of_si_has_no_factor() {
        for (unit, dimension) in [
            ("N/m", d::STIFFNESS),
            ("N*s/m", d::DAMPING),
            ("N·m", d::MOMENT),
            ("kg*m^2", d::INERTIA),
            ("rad", d::NONE),
            ("1", d::NONE),
            ("m/s^2", d::ACCELERATION),
        ] {
            assert_eq!(si_dimension(unit), Some(dimension), "{unit}");
        }
        for none in ["kN/m", "mm", "%", "deg", "", "2", "furlong", "N/", "1 m + 1 m", "-1 m"] {
            assert_eq!(si_dimension(none), None, "{none}");
        }
    }

    #[test]
    fn a_slug_is_a_pound_force_second_squared_per_foot() {
        assert!((find("slug").unwrap().factor - 14.593_903).abs() < 1e-6);
    }
}
