//! The program `trilith` with a link of my own.

use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Kinematics, Link,
    NodeCount, Parameters, Register, Response, Stroke, history,
};

/// A rod that takes tension only and yields. The fields are the parameters of model files, in SI.
#[derive(Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct YieldingRod {
    /// axial stiffness
    #[parameter("k", unit = "N/m", range = Positive)]
    pub k: f64,
    /// yield force
    #[parameter("F_y", unit = "N", range = Positive)]
    pub fy: f64,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U1")]
    pub axis: Axis,
}

history! {
    /// What the rod remembers.
    struct RodHistory {
        /// Permanent elongation p.
        elongation: "m",
    }
}

impl Described for YieldingRod {
    const CARD: Card =
        Card::new("YieldingRod", Category::Link, "Rod that takes tension only and yields.")
            .nodes(NodeCount::GROUND_OR_TWO)
            .parameters(Self::PARAMETERS)
            .law("f = k max(d − p, 0), at most F_y: there p grows")
            .source("elementary plasticity")
            .example(r#""rod": YieldingRod(node: "mass", k: "10 MN/m", fy: "50 kN")"#)
            .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.02)]));
}

impl Link for YieldingRod {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        RodHistory::FIELDS.into()
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let mut elongation = RodHistory::load(committed).elongation;
        let stretch = at.d[0] - elongation;
        if self.k * stretch > self.fy {
            // Yields: the elongation grows until the force is F_y; a tangent of zero.
            let more = stretch - self.fy / self.k;
            elongation += more;
            out.f[0] = self.fy;
            out.energy.hysteretic = self.fy * more;
        } else if stretch > 0.0 {
            out.f[0] = self.k * stretch;
            out.k[0] = self.k;
        }
        out.energy.stored = 0.5 * out.f[0] * out.f[0] / self.k;
        RodHistory { elongation }.store(trial);
    }
}

fn main() {
    let mut kinds = trilith::registry();
    kinds.link::<YieldingRod>();
    trilith_cli::main_with(kinds)
}

#[test]
fn the_rod_keeps_the_contract() {
    let rod = YieldingRod { k: 1e7, fy: 5e4, axis: Axis::U1 };
    // Deformations of about 20 mm, one cycle in a second.
    trilith_element::conformance::Kit::new(&[0.02], 1.0).rate_independent().assert(&rod);
}

/// Yields at 5 mm: 10 mm turn F_y · 5 mm into heat, and on the way back the rod is loose below 5 mm.
#[test]
fn the_rod_yields_and_stays_longer() {
    let rod = YieldingRod { k: 1e7, fy: 5e4, axis: Axis::U1 };
    let mut driver = trilith_element::Driver::new(&rod);
    assert_eq!(driver.to(&[0.01])[0], 5e4);
    assert!((driver.heat() - 5e4 * 0.005).abs() < 1e-9);
    assert!((driver.to(&[0.008])[0] - 1e7 * 0.003).abs() < 1e-6);
    assert_eq!(driver.to(&[0.004])[0], 0.0);
    assert_eq!(driver.history, [0.005]);
}
