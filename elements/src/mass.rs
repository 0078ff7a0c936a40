//! Mass: point mass and rotary inertia at one node.
//!
//! ```text
//!   M = diag(m, m, m)  and  J = | Ix  Pxy Pxz |        (kg, kg·m²)
//!                               | Pxy Iy  Pyz |
//!                               | Pxz Pyz Iz  |
//! ```
//!
//! Masses are along, and inertia about, **global X, Y, Z**. With `inertia_local: true` the inertia is
//! about local 1, 2, 3, which for a node without given axes are +Z, +X, +Y. Only DOFs with mass are used.

use crate::shared::dense::{is_semi_definite, rotation, used};
use crate::shared::parameters::none_negative;
use nalgebra::{DMatrix, Matrix3};
use serde::Deserialize;
use trilith_element::{
    Card, Category, Described, ElementMatrices, Exercise, Geometry, LinearElement, NodeCount,
    ParameterError, Parameters,
};

/// Point mass with rotary inertia.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Mass {
    /// mass, the same in all directions
    #[parameter("m", unit = "kg", range = NonNegative)]
    pub mass: Option<f64>,
    /// instead of `mass`: masses along X, Y, Z
    #[parameter("mx, my, mz", unit = "kg", range = NonNegative)]
    pub masses: Option<[f64; 3]>,
    /// moments of inertia about X, Y, Z
    #[parameter("Ix, Iy, Iz", unit = "kg·m²", range = NonNegative)]
    pub inertia: Option<[f64; 3]>,
    /// off-diagonal entries of the inertia matrix, Pxy = −∫xy dm
    #[parameter("Pxy, Pxz, Pyz", unit = "kg·m²")]
    pub products: Option<[f64; 3]>,
    /// inertia is about local 1, 2, 3 instead of X, Y, Z
    #[parameter]
    pub inertia_local: bool,
}

impl Described for Mass {
    const CARD: Card =
        Card::new("Mass", Category::Linear, "Point mass and rotary inertia at a node.")
            .nodes(NodeCount::exactly(1))
            .parameters(Self::PARAMETERS)
            .law("M = diag(mx, my, mz)\nJ = [Ix Pxy Pxz; Pxy Iy Pyz; Pxz Pyz Iz]")
            .source("Newton–Euler equations at small rotations")
            .example(r#""body": Mass(node: "cg", mass: "10 t", inertia: (0, 16667, 0))"#)
            .exercise(Exercise::NONE);

    fn check(&self) -> Result<(), ParameterError> {
        if self.mass.is_some() && self.masses.is_some() {
            let message = "`mass` and `masses` exclude each other: give one of them";
            return Err(ParameterError::inconsistent("masses", message));
        }
        if self.mass.is_none() && self.masses.is_none() && self.inertia.is_none() {
            let message = "a mass needs `mass`, `masses` or `inertia`";
            return Err(ParameterError::inconsistent("mass", message));
        }
        none_negative("masses", &self.masses.unwrap_or_default(), "kg")?;
        none_negative("inertia", &self.inertia.unwrap_or_default(), "kg·m²")?;
        if self.products.is_some()
            && !is_semi_definite(&DMatrix::from_fn(3, 3, |i, j| self.inertia_matrix()[(i, j)]))
        {
            let message =
                "`inertia` with these `products` is no possible inertia (negative about some axis)";
            return Err(ParameterError::inconsistent("products", message));
        }
        Ok(())
    }
}

impl Mass {
    fn inertia_matrix(&self) -> Matrix3<f64> {
        let [a, b, c] = self.inertia.unwrap_or_default();
        let [xy, xz, yz] = self.products.unwrap_or_default();
        Matrix3::new(a, xy, xz, xy, b, yz, xz, yz, c)
    }
}

impl LinearElement for Mass {
    fn matrices(&self, at: &Geometry<'_>) -> Result<ElementMatrices, ParameterError> {
        let masses = self.masses.unwrap_or([self.mass.unwrap_or(0.0); 3]);
        let mut inertia = self.inertia_matrix();
        if self.inertia_local {
            let r = rotation(&at.frame);
            inertia = r.transpose() * inertia * r;
        }
        let mut m = DMatrix::zeros(6, 6);
        for i in 0..3 {
            m[(i, i)] = masses[i];
        }
        m.view_mut((3, 3), (3, 3)).copy_from(&inertia);
        let none = DMatrix::zeros(6, 6);
        Ok(used(&none, &m, &none))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::{numbers, read};
    use trilith_element::{Dof, Frame, Value};

    fn matrices(mass: &Mass) -> ElementMatrices {
        let nodes = [[0.0; 3]];
        let frame = Frame::of_nodes(&nodes, None, None).unwrap();
        mass.matrices(&Geometry::new(&nodes, frame)).unwrap()
    }

    #[test]
    fn uses_only_the_dofs_that_have_mass() {
        let inertia = Value::List([0.0, 5.0, 0.0].map(Value::Number).to_vec());
        let m: Mass = read(&[("mass", Value::Number(2.0)), ("inertia", inertia)]).unwrap();
        let got = matrices(&m);
        assert_eq!(got.dofs, [(0, Dof::Ux), (0, Dof::Uy), (0, Dof::Uz), (0, Dof::Ry)]);
        assert_eq!(got.mass[(3, 3)], 5.0);
        assert!(got.stiffness.is_zero() && got.damping.is_zero());
    }

    #[test]
    fn local_inertia_of_an_upright_frame_turns_1_into_z() {
        let m = Mass {
            mass: None,
            masses: None,
            inertia: Some([7.0, 8.0, 9.0]),
            products: Some([0.5, 0.0, 0.0]),
            inertia_local: true,
        };
        let got = matrices(&m);
        assert_eq!([got.mass[(0, 0)], got.mass[(1, 1)], got.mass[(2, 2)]], [8.0, 9.0, 7.0]);
        assert_eq!(got.mass[(0, 2)], 0.5, "local 1 2 is Z X");
    }

    #[test]
    fn refuses_two_statements_of_mass_and_impossible_products() {
        let masses = Value::List([1.0, 1.0, 1.0].map(Value::Number).to_vec());
        assert!(read::<Mass>(&[("mass", Value::Number(2.0)), ("masses", masses.clone())]).is_err());
        assert!(read::<Mass>(&[]).is_err());
        let products = Value::List([3.0, 0.0, 0.0].map(Value::Number).to_vec());
        let err = read::<Mass>(&[("inertia", masses), ("products", products)]).unwrap_err();
        assert_eq!(err.parameter(), Some("products"));
        assert!(read::<Mass>(&numbers(&[("mass", 1.0)])).is_ok());
    }
}
