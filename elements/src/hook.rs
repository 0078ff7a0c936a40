//! Hook: a tension-only cable that engages after a slack.
//!
//! ```text
//!   i ●──/\/\/──⊂ g ⊃──● j      f = k (d − g)   where d − g > 0   (engaged)
//!          k                     f = 0           otherwise         (slack)
//! ```
//!
//! `d` is the deformation along the axis (extension along U1). No energy is lost; for restitution use
//! an `NLink` with `damping`, or a `Dashpot` in contact beside it.
//!
//! Reference: \[Wilson 2002, ch. 21\].

use crate::shared::written::Written;
use serde::Deserialize;
use trilith_element::lanes::{LaneAt, LaneForce, LaneForm, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Kinematics, Link, NodeCount,
    Parameters, Response, Stroke,
};

/// Tension-only cable with a slack.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Hook {
    /// stiffness
    #[parameter("k", unit = "N/m", range = Positive)]
    pub k: f64,
    /// clearance at rest (negative: prestressed by k g)
    #[parameter("g", unit = "m", default = 0.0)]
    pub opening: f64,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U1")]
    pub axis: Axis,
}

impl Described for Hook {
    const CARD: Card = Card::new("Hook", Category::Link, "Tension-only cable with a slack.")
        .nodes(NodeCount::GROUND_OR_TWO)
        .parameters(Self::PARAMETERS)
        .law("f = k (d − g) where d − g > 0, else 0")
        .source("Wilson, Static and Dynamic Analysis of Structures, 2002, ch. 21")
        .example(r#""cable": Hook(nodes: ("a", "b"), k: "20 MN/m", opening: "5 mm")"#)
        .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.01)]));
}

/// The law over lanes; parameters k, g.
struct HookLaw;

impl LaneLaw for HookLaw {
    const COORDINATES: usize = 1;
    const HISTORY: usize = 0;
    const PARAMETERS: usize = 2;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        _: &mut [R],
    ) -> LaneStep<R> {
        let (k, stretch) = (at.parameters[0], at.d[0] - at.parameters[1]);
        let taut = k.of(0.0).lt(stretch);
        out.f[0] = (k * stretch).only(taut);
        out.k[0] = k.only(taut);
        out.c[0] = k.of(0.0);
        LaneStep::elastic((k.of(0.5) * k * stretch * stretch).only(taut))
    }
}

const LAW: Written = Written::of::<HookLaw>();

impl Link for Hook {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn uses_rates(&self) -> bool {
        false
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }

    fn respond(&self, at: &Kinematics<'_>, _: &[f64], _: &mut [f64], out: &mut Response<'_>) {
        LAW.respond(&[self.k, self.opening], (at, &[]), &mut [], out);
    }

    fn lanes(&self, _: &[bool]) -> Option<LaneForm> {
        Some(LAW.lanes(&[self.k, self.opening]).without_rate())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::{numbers, read};
    use approx::assert_relative_eq;
    use trilith_element::conformance::Kit;
    use trilith_element::{Driver, ParameterError};

    fn law(opening: f64) -> Result<Hook, ParameterError> {
        read(&numbers(&[("k", 2e8), ("opening", opening)]))
    }

    fn force(law: &Hook, d: f64) -> f64 {
        Driver::new(law).to(&[d])[0]
    }

    #[test]
    fn conforms_with_clearance_without_and_prestressed() {
        for opening in [0.0, 0.02, -0.01] {
            Kit::new(&[0.05], 1.0).rate_independent().assert(&law(opening).unwrap());
        }
    }

    #[test]
    fn is_open_up_to_the_clearance_and_linear_beyond() {
        let law = law(0.05).unwrap();
        for d in [-1.0, 0.0, 0.05] {
            assert_eq!(force(&law, d), 0.0);
        }
        assert_relative_eq!(force(&law, 0.06), 2e6, max_relative = 1e-12);
    }

    #[test]
    fn rejects_an_unknown_parameter() {
        assert!(read::<Hook>(&numbers(&[("k", 1.0), ("gap", 1.0)])).is_err());
        assert!(read::<Hook>(&numbers(&[("opening", 1.0)])).is_err());
    }
}
