//! The units in which a quantity may be given.

use crate::units::UNITS;
use trilith_element::Dimension;
use trilith_element::dimension as d;

/// Units of a dimension as a file writes them: that of SI first, then single ones, then the products and quotients that the SI
/// unit is made of with other units of its parts. Times in them stay seconds.
///
/// ```
/// use trilith_element::dimension::STIFFNESS;
/// let all = trilith_model::schema::units_of(STIFFNESS);
/// assert_eq!(all[0], "N/m");
/// assert!(all.iter().any(|unit| unit == "kip/in"));
/// ```
#[must_use]
pub fn units_of(dimension: Dimension) -> Vec<String> {
    let single = UNITS.iter().filter(|u| u.dimension.matches(dimension));
    let single = single.map(|u| u.name.to_owned());
    if dimension.is_none() {
        return single.collect();
    }
    let parts = parts(&dimension.unit());
    let mut made = vec![String::new()];
    for (sign, unit, power) in &parts {
        let all: Vec<&str> = alternatives(unit).collect();
        // The first part runs fastest: `kN/m` comes before `N/mm`.
        let one =
            |name: &&str| made.iter().map(|m| join(m, *sign, name, power)).collect::<Vec<_>>();
        made = all.iter().flat_map(one).collect();
    }
    let mut found: Vec<String> = Vec::new();
    let of_si = made.first().cloned();
    for unit in of_si.into_iter().chain(single).chain(made) {
        // The same twice: micrometres.
        if !unit.is_empty() && !found.contains(&unit) {
            found.push(unit);
        }
    }
    found
}

/// The parts of a unit as [`Dimension::unit`] writes it: the sign before each, its unit and its power as the file writes it.
fn parts(unit: &str) -> Vec<(char, String, String)> {
    let mut found = Vec::new();
    let mut sign = '*';
    for piece in unit.split_inclusive(['·', '/']) {
        let next = piece.chars().last().filter(|c| "·/".contains(*c));
        let part = piece.trim_end_matches(['·', '/']);
        let name: String =
            part.chars().take_while(|c| c.is_alphanumeric() && !"²³⁴".contains(*c)).collect();
        let power = match &part[name.len()..] {
            "²" => "^2".to_owned(),
            "³" => "^3".to_owned(),
            "⁴" => "^4".to_owned(),
            other => other.to_owned(),
        };
        found.push((sign, name, power));
        sign = if next == Some('/') { '/' } else { '*' };
    }
    found
}

/// The unit itself, and others of its dimension where they are usual in products.
fn alternatives(unit: &str) -> impl Iterator<Item = &str> {
    let of = UNITS.iter().find(|u| u.name == unit).map(|u| u.dimension);
    let varied = of.filter(|of| !of.matches(d::TIME));
    let others = UNITS.iter().filter(move |u| varied.is_some_and(|of| u.dimension.matches(of)));
    std::iter::once(unit).chain(others.map(|u| u.name).filter(move |name| *name != unit))
}

fn join(before: &str, sign: char, name: &str, power: &str) -> String {
    match before {
        "" => format!("{name}{power}"),
        before => format!("{before}{sign}{name}{power}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_that_is_told_has_the_dimension() {
        let odd = Dimension { mass: 1.0, length: 0.5, time: -1.5 };
        for of in [
            d::NONE,
            d::LENGTH,
            d::AREA,
            d::SECOND_MOMENT,
            d::TIME,
            d::FREQUENCY,
            d::MASS,
            d::MASS_PER_LENGTH,
            d::DENSITY,
            d::INERTIA,
            d::VELOCITY,
            d::INVERSE_VELOCITY,
            d::ACCELERATION,
            d::FORCE,
            d::MOMENT,
            d::STRESS,
            d::STIFFNESS,
            d::DAMPING,
            d::ROTATIONAL_DAMPING,
            odd,
        ] {
            let all = units_of(of);
            assert!(all.len() > 2 && all.len() < 200, "{of}: {all:?}");
            for unit in &all {
                let found = crate::units::dimension(unit);
                assert!(found.is_some_and(|found| found.matches(of)), "{unit} is not in {of}");
            }
        }
    }

    #[test]
    fn usual_units_come_first() {
        assert_eq!(units_of(d::STIFFNESS)[..3], ["N/m", "kN/m", "MN/m"]);
        assert_eq!(units_of(d::ACCELERATION)[..2], ["m/s^2", "g"]);
        assert_eq!(units_of(d::LENGTH)[..3], ["m", "mm", "cm"]);
        assert!(units_of(d::DAMPING).contains(&"kN*s/m".to_owned()));
    }
}
