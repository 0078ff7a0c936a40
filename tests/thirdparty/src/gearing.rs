//! Gearing: a direction of the second node follows one of the first by a ratio.
//!
//! ```text
//!   u₂ = r u₁
//! ```
//!
//! Gears, levers and ropes over pulleys, whose other parts are no part of the model. The shaft of the gears carries what
//! the two forces lack in equilibrium, so a gearing does not move freely as a rigid body.

use serde::Deserialize;
use trilith_element::{
    Card, Category, Constraint, Described, Dof, Equation, Exercise, NodalOutline, NodeCount,
    ParameterError, Parameters, Vector3, norm, sub,
};

const NAMES: &[&str] = &["Ux", "Uy", "Uz", "Rx", "Ry", "Rz"];

/// One direction of two nodes, coupled by a ratio. The fields are the parameters of model files.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Gearing {
    /// which direction
    #[parameter(choices = NAMES)]
    pub dof: String,
    /// motion of the second node over that of the first
    #[parameter("r", unit = "1")]
    pub ratio: f64,
}

impl Described for Gearing {
    const CARD: Card = Card::new(
        "Gearing",
        Category::Constraint,
        "A direction of the second node follows that of the first by a ratio.",
    )
    .nodes(NodeCount::exactly(2))
    .parameters(Self::PARAMETERS)
    .law("u₂ = r u₁")
    .source("kinematics of a lever")
    .example(r#""gears": Gearing(nodes: ("motor", "wheel"), dof: Rx, ratio: -0.25)"#)
    .exercise(Exercise::NONE);

    fn check(&self) -> Result<(), ParameterError> {
        if self.ratio == 0.0 {
            let message = "a `ratio` of 0 holds the second node: write a support";
            return Err(ParameterError::inconsistent("ratio", message));
        }
        Ok(())
    }
}

impl Constraint for Gearing {
    fn equations(&self, _: &[Vector3]) -> Result<Vec<Equation>, ParameterError> {
        let at = NAMES.iter().position(|name| *name == self.dof).unwrap_or(0);
        let dof = Dof::ALL[at];
        Ok(vec![Equation::new((1, dof), vec![((0, dof), self.ratio)])])
    }

    /// Two wheels that touch, for rotations about an axis square to the line between their nodes.
    fn outline(&self, nodes: &[Vector3]) -> Option<NodalOutline> {
        let [first, second] = nodes else { return None };
        let axis = NAMES.iter().position(|name| *name == self.dof)?.checked_sub(3)?;
        let apart = sub(*second, *first);
        let distance = norm(apart);
        if distance == 0.0 || apart[axis].abs() > 1e-9 * distance {
            return None;
        }
        // r₁ θ₁ = r₂ |θ₂|.
        let share = self.ratio.abs() / (1.0 + self.ratio.abs());
        let wheel = |radius: f64| -> Vec<Vector3> {
            let corner = |i: u32| {
                let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 24.0).sin_cos();
                let mut at = [0.0; 3];
                (at[(axis + 1) % 3], at[(axis + 2) % 3]) = (radius * cos, radius * sin);
                at
            };
            (0..24).map(corner).collect()
        };
        let wheels = [wheel(share * distance), wheel((1.0 - share) * distance)];
        Some(NodalOutline::default().and_face(0, &wheels[0]).and_face(1, &wheels[1]))
    }
}
