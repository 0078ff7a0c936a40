//! What cross-sections look like from outside.

use std::f64::consts::TAU;

/// The outer shape of a cross-section, m; it enters no computation, only pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Two flanges and a web; fillets are left out.
    I {
        /// Along local 2.
        depth: f64,
        /// Of the flanges, along local 3.
        width: f64,
        /// Thickness of the web.
        web: f64,
        /// Thickness of the flanges.
        flange: f64,
    },
    /// A rectangle, solid or hollow.
    Rectangle {
        /// Along local 3.
        width: f64,
        /// Along local 2.
        depth: f64,
    },
    /// A circle, solid or hollow.
    Round {
        /// Outer diameter.
        diameter: f64,
    },
}

/// Corners of a circle.
const ROUND: usize = 12;

impl Shape {
    /// Corners in order, along local 2 and local 3 from the centre, m.
    #[must_use]
    pub fn outline(self) -> Vec<[f64; 2]> {
        match self {
            Self::I { depth, width, web, flange } => {
                let (h, b, w, f) = (0.5 * depth, 0.5 * width, 0.5 * web, 0.5 * depth - flange);
                let right = [[-h, b], [-f, b], [-f, w], [f, w], [f, b], [h, b]];
                let left = right.iter().rev().map(|[y, z]| [*y, -z]);
                right.iter().copied().chain(left).collect()
            }
            Self::Rectangle { width, depth } => {
                let (h, b) = (0.5 * depth, 0.5 * width);
                vec![[-h, b], [h, b], [h, -b], [-h, -b]]
            }
            Self::Round { diameter } => {
                let at = |i: usize| (TAU * i as f64 / ROUND as f64).sin_cos();
                let corner = |(s, c): (f64, f64)| [0.5 * diameter * c, 0.5 * diameter * s];
                (0..ROUND).map(|i| corner(at(i))).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the shoelace formula.
    fn area(corners: &[[f64; 2]]) -> f64 {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| 0.5 * (a[0] * b[1] - b[0] * a[1])).sum::<f64>().abs()
    }

    #[test]
    fn an_outline_holds_the_area_of_its_section() {
        let i = Shape::I { depth: 0.3, width: 0.2, web: 0.01, flange: 0.02 };
        assert!((area(&i.outline()) - (2.0 * 0.2 * 0.02 + 0.26 * 0.01)).abs() < 1e-15);
        let r = Shape::Rectangle { width: 0.2, depth: 0.5 }.outline();
        assert!((area(&r) - 0.1).abs() < 1e-15);
        assert!(
            r.iter().all(|c| c[0].abs() == 0.25 && c[1].abs() == 0.1),
            "depth is along local 2"
        );
        let round = area(&Shape::Round { diameter: 2.0 }.outline());
        assert!((0.94..1.0).contains(&(round / std::f64::consts::PI)), "{round}");
    }
}
