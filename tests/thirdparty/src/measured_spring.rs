//! Measured spring: force over deformation as a test has given it, from a file beside the model.
//!
//! ```text
//!   f = sgn(d) F(|d|)         F straight between the points (dᵢ, Fᵢ) of the file, from (0, 0) on
//!   |d| > d_n                 no answer: nobody has pulled it farther
//! ```
//!
//! It is elastic: the same curve up and down, and the same both ways. Stored energy is the area below it.

use serde::Deserialize;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, FileError, FileText, Kinematics, Link,
    NodeCount, Parameters, Response, Stroke,
};

/// A spring with a measured curve. The fields are the parameters of model files.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct MeasuredSpring {
    /// rows of deformation in m, rising from 0, and force in N
    #[parameter(form = File)]
    pub curve: Curve,
    /// what was pulled, for what the law says where the curve ends
    #[parameter(default = "the specimen")]
    pub specimen: String,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U1")]
    pub axis: Axis,
}

/// Force over deformation: points joined by straight lines.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "FileText")]
pub struct Curve {
    /// Deformation (m) and force (N) of each, from (0, 0) on.
    points: Vec<[f64; 2]>,
    /// Area up to each, J.
    energy: Vec<f64>,
    /// Name of the file.
    file: String,
}

impl TryFrom<FileText> for Curve {
    type Error = FileError;

    fn try_from(file: FileText) -> Result<Self, FileError> {
        let rows = file.numbered_rows::<2>()?;
        let (line, first) = rows[0];
        if first != [0.0, 0.0] {
            return Err(file.error(line, "the curve must begin with 0, 0"));
        }
        let mut energy = vec![0.0];
        for two in rows.windows(2) {
            let [(_, [d0, f0]), (line, [d1, f1])] = [two[0], two[1]];
            if d1 <= d0 {
                let message = format!("deformations must rise: {d1} m comes after {d0} m");
                return Err(file.error(line, message));
            }
            energy.push(energy[energy.len() - 1] + 0.5 * (f0 + f1) * (d1 - d0));
        }
        if rows.len() < 2 || rows[1].1[1] <= 0.0 {
            let line = rows.get(1).map_or(line, |row| row.0);
            return Err(file.error(line, "the curve must rise from 0, 0 to a second point"));
        }
        let points = rows.into_iter().map(|(_, row)| row).collect();
        Ok(Self { points, energy, file: file.name })
    }
}

impl Curve {
    /// Force, stiffness and energy at a deformation (m, ≥ 0); none beyond its end.
    fn at(&self, d: f64) -> Option<[f64; 3]> {
        let next = self.points.partition_point(|p| p[0] < d).max(1);
        let ([d0, f0], [d1, f1]) = (self.points[next - 1], *self.points.get(next)?);
        let k = (f1 - f0) / (d1 - d0);
        let f = f0 + k * (d - d0);
        Some([f, k, self.energy[next - 1] + 0.5 * (f0 + f) * (d - d0)])
    }

    fn end(&self) -> f64 {
        self.points[self.points.len() - 1][0]
    }
}

impl Described for MeasuredSpring {
    const CARD: Card = Card::new(
        "MeasuredSpring",
        Category::Link,
        "Spring with a measured curve, from a file.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = sgn(d) F(|d|),  F straight between the points of the file; beyond the last no answer")
    .source("a test")
    .example(r#""mount": MeasuredSpring(node: "a", curve: Contents("pull.csv", "0, 0\n0.02, 8e3\n0.05, 11e3"), specimen: "mount 3")"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.015)]));
}

impl Link for MeasuredSpring {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn uses_rates(&self) -> bool {
        false
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.curve.points[1][1] / self.curve.points[1][0];
    }

    fn respond(&self, at: &Kinematics<'_>, _: &[f64], _: &mut [f64], out: &mut Response<'_>) {
        let d = at.d[0];
        let [f, k, energy] = self.curve.at(d.abs()).unwrap_or([f64::NAN; 3]);
        out.f[0] = f.copysign(d);
        out.k[0] = k;
        out.energy.stored = energy;
    }

    fn refusal(&self, at: &Kinematics<'_>, _: &[f64]) -> Option<String> {
        let (Curve { file, .. }, end) = (&self.curve, 1e3 * self.curve.end());
        let beyond = at.d[0].abs() > self.curve.end();
        beyond.then(|| format!("{} was pulled to {end} mm only (`{file}`)", self.specimen))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_element::Driver;
    use trilith_element::conformance::Kit;

    fn curve(text: &str) -> Result<Curve, FileError> {
        FileText { name: "pull.csv".into(), text: text.into() }.try_into()
    }

    fn law() -> MeasuredSpring {
        let curve = curve("0 0\n0.02 8e3\n0.05 11e3\n").unwrap();
        MeasuredSpring { curve, specimen: "mount 3".into(), axis: Axis::U1 }
    }

    #[test]
    fn conforms_as_far_as_the_curve_goes() {
        Kit::new(&[0.02], 1.0).rate_independent().assert(&law());
    }

    #[test]
    fn follows_the_points_and_stores_the_area() {
        let law = law();
        let mut driver = Driver::new(&law);
        assert_eq!(driver.to(&[0.02])[0], 8e3);
        assert!((driver.to(&[-0.03])[0] + 9e3).abs() < 1e-9);
        assert!((driver.energy.stored - (80.0 + 85.0)).abs() < 1e-9, "{}", driver.energy.stored);
        let beyond = driver.toward(&[0.051], &[0.0], 0.0);
        assert!(driver.ask(&beyond).f[0].is_nan());
        assert_eq!(
            driver.refusal(&beyond).unwrap(),
            "mount 3 was pulled to 50 mm only (`pull.csv`)"
        );
    }

    #[test]
    fn a_curve_that_is_none_is_told_with_its_line() {
        let told = |text: &str| curve(text).unwrap_err().to_string();
        assert_eq!(told("0.01 0\n0.02 1\n"), "pull.csv, line 1: the curve must begin with 0, 0");
        let back = told("d f\n0 0\n0.02 8e3\n0.01 9e3\n");
        assert_eq!(back, "pull.csv, line 4: deformations must rise: 0.01 m comes after 0.02 m");
        assert!(told("0 0\n0.02 0\n").contains("line 2: the curve must rise"));
        assert!(told("0 0\n").contains("line 1: the curve must rise"));
    }
}
