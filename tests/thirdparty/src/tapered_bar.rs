//! Tapered bar: axial force only, an area that goes linearly from one end to the other.
//!
//! ```text
//!   k = E (A₂ − A₁)/(L ln(A₂/A₁))      along the bar; E A/L for A₁ = A₂
//! ```
//!
//! The flexibility ∫ dx/(E A(x)) is exact, so a bar is as stiff as any number of bars in a row.
//!
//! Reference: \[Gere & Goodno, Mechanics of Materials, 2013, §2.3\].

use serde::Deserialize;
use trilith_element::{
    Card, Category, Described, Dof, ElementMatrices, Exercise, Geometry, LinearElement,
    NodalOutline, NodeCount, ParameterError, Parameters, Vector3,
};

/// Bar with axial force only. The fields are the parameters of model files.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct TaperedBar {
    /// Young's modulus
    #[parameter("E", unit = "Pa", range = Positive)]
    pub modulus: f64,
    /// area at the first node
    #[parameter("A₁", unit = "m²", range = Positive)]
    pub area1: f64,
    /// area at the second node
    #[parameter("A₂", unit = "m²", range = Positive)]
    pub area2: f64,
}

impl Described for TaperedBar {
    const CARD: Card = Card::new(
        "TaperedBar",
        Category::Linear,
        "Two-node bar whose area goes linearly from end to end.",
    )
    .nodes(NodeCount::exactly(2))
    .parameters(Self::PARAMETERS)
    .law("k = E (A₂ − A₁)/(L ln(A₂/A₁)) along the bar")
    .source("Gere & Goodno, Mechanics of Materials, 2013, §2.3")
    .example(r#""strut": TaperedBar(nodes: ("a", "b"), modulus: "210 GPa", area1: "12 cm^2", area2: "20 cm^2")"#)
    .exercise(Exercise::NONE);
}

impl TaperedBar {
    /// Stiffness along a length, N/m.
    fn stiffness(&self, length: f64) -> f64 {
        // (A₂ − A₁)/ln(A₂/A₁), without cancellation where both are nearly alike.
        let more = (self.area2 - self.area1) / self.area1;
        let mean = if more == 0.0 { self.area1 } else { self.area1 * more / more.ln_1p() };
        self.modulus * mean / length
    }
}

impl LinearElement for TaperedBar {
    fn matrices(&self, at: &Geometry<'_>) -> Result<ElementMatrices, ParameterError> {
        let length = at.length();
        if length <= 0.0 {
            return Err(ParameterError::geometry("a tapered bar needs two nodes apart"));
        }
        let along = at.frame.0[0];
        // A direction that the bar does not reach is not listed.
        let reached = |i: &usize| along[*i].abs() > 1e-12;
        let rows: Vec<(usize, usize)> =
            (0..2).flat_map(|node| (0..3).filter(reached).map(move |i| (node, i))).collect();
        let mut out =
            ElementMatrices::zeros(rows.iter().map(|(n, i)| (*n, Dof::ALL[*i])).collect());
        let k = self.stiffness(length);
        for (p, (m, i)) in rows.iter().enumerate() {
            for (q, (n, j)) in rows.iter().enumerate() {
                let sign = if m == n { 1.0 } else { -1.0 };
                out.stiffness[(p, q)] = sign * k * along[*i] * along[*j];
            }
        }
        Ok(out)
    }

    /// True to scale, as if its sections were squares.
    fn outline(&self, at: &Geometry<'_>) -> Option<NodalOutline> {
        let [_, second, third] = at.frame.0;
        let square = |area: f64| -> [Vector3; 4] {
            let half = 0.5 * area.sqrt();
            [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
                .map(|(a, b)| [0, 1, 2].map(|i| half * (a * second[i] + b * third[i])))
        };
        let ends = [square(self.area1), square(self.area2)];
        Some(NodalOutline::default().and_prism([0, 1], [&ends[0], &ends[1]]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_element::conformance::ElementKit;

    #[test]
    fn moves_freely_as_a_rigid_body_and_is_the_same_everywhere() {
        let bar = TaperedBar { modulus: 2.1e11, area1: 1.2e-3, area2: 2e-3 };
        ElementKit::new(&[[0.0; 3], [3.0, 1.0, 2.0]]).assert(&bar);
    }
}
