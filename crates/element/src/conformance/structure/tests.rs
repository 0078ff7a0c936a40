//! The kits pass what is sound, and catch each way to spoil it.

use super::{ConstraintKit, ElementKit, StructureError as Broken};
use crate::{
    Constraint, Dof, ElementFault, ElementMatrices, Equation, Geometry, LinearElement,
    ParameterError, Vector3, sub,
};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

#[derive(Clone, Copy, Debug, PartialEq)]
enum Spoil {
    Nothing,
    Unsymmetric,
    Negative,
    Grounded,
    Axes,
    Place,
    Length,
    Purity,
}

/// A rod with an area and a mass.
#[derive(Debug)]
struct Rod(Spoil, AtomicUsize);

impl LinearElement for Rod {
    fn matrices(&self, at: &Geometry<'_>) -> Result<ElementMatrices, ParameterError> {
        let all = [Dof::Ux, Dof::Uy, Dof::Uz];
        let mut m = ElementMatrices::zeros((0..2).flat_map(|n| all.map(|d| (n, d))).collect());
        let axis = if self.0 == Spoil::Axes { [0.6, 0.8, 0.0] } else { at.frame.0[0] };
        let b: Vec<f64> = [-1.0, 1.0].iter().flat_map(|s| axis.map(|c| s * c)).collect();
        let k = 1e6 / if self.0 == Spoil::Length { 2.0 } else { at.length() };
        for i in 0..6 {
            for j in 0..6 {
                m.stiffness[(i, j)] = k * b[i] * b[j];
            }
            m.mass[(i, i)] = 5.0 * at.length();
        }
        match self.0 {
            Spoil::Unsymmetric => m.stiffness[(0, 1)] += 1e3,
            Spoil::Negative => m.mass[(2, 2)] = -1.0,
            Spoil::Grounded => m.stiffness[(0, 0)] += 1e3,
            Spoil::Place => m.mass[(0, 0)] += at.nodes[0][0].abs(),
            Spoil::Purity => m.mass[(0, 0)] += self.1.fetch_add(1, Relaxed) as f64,
            _ => {}
        }
        Ok(m)
    }
}

fn examine(spoil: Spoil) -> Result<(), Broken> {
    ElementKit::new(&[[0.0; 3], [3.0, 1.0, 2.0]])
        .divisible()
        .check(&Rod(spoil, AtomicUsize::new(0)))
}

#[test]
fn a_sound_element_passes_and_every_spoiled_one_is_caught() {
    assert_eq!(examine(Spoil::Nothing), Ok(()));
    let of = |spoil| examine(spoil).expect_err("it is spoiled");
    let fault = |e: &Broken| matches!(e, Broken::Fault(ElementFault::NotSymmetric { .. }));
    assert!(fault(&of(Spoil::Unsymmetric)));
    assert!(matches!(of(Spoil::Negative), Broken::Fault(ElementFault::Diagonal { .. })));
    assert_eq!(
        of(Spoil::Grounded).to_string(),
        "a translation along X as a rigid body meets stiffness: 1e3 at node 1 Ux"
    );
    assert!(matches!(of(Spoil::Axes), Broken::Rigid { motion: "a rotation about X", .. }));
    assert!(matches!(of(Spoil::Place), Broken::Place { how: "moved", what: "mass", .. }));
    assert!(matches!(of(Spoil::Length), Broken::Halves { .. }));
    assert!(matches!(of(Spoil::Purity), Broken::Impure { what: "mass" }));
}

/// The second node follows the first as on a rigid arm.
#[derive(Debug)]
struct Arm(fn(&mut Vec<Equation>));

impl Constraint for Arm {
    fn equations(&self, nodes: &[Vector3]) -> Result<Vec<Equation>, ParameterError> {
        let r = sub(nodes[1], nodes[0]);
        let terms = vec![((0, Dof::Ux), 1.0), ((0, Dof::Ry), r[2]), ((0, Dof::Rz), -r[1])];
        let mut all = vec![Equation { dependent: (1, Dof::Ux), terms }];
        (self.0)(&mut all);
        Ok(all)
    }
}

#[test]
fn a_sound_constraint_passes_and_every_spoiled_one_is_caught() {
    let of = |spoil| ConstraintKit::new(&[[0.0; 3], [1.0, 2.0, 3.0]]).check(&Arm(spoil));
    assert_eq!(of(|_| {}), Ok(()));
    let short = of(|all| all[0].terms[1].1 *= 0.9).expect_err("a short arm");
    assert_eq!(
        short.to_string().split(':').next(),
        Some("a rotation about Y as a rigid body meets an equation that it breaks")
    );
    let only = ConstraintKit::new(&[[0.0; 3], [1.0, 2.0, 3.0]]).only_translations();
    assert_eq!(only.check(&Arm(|all| all[0].terms[1].1 *= 0.9)), Ok(()));
    let twice = of(|all| all.push(all[0].clone())).expect_err("twice");
    assert_eq!(twice.to_string(), "node 2 Ux goes by two equations");
    let own = of(|all| all[0].terms.push(((1, Dof::Ux), 0.5))).expect_err("its own");
    assert!(matches!(own, Broken::Dependent { .. }), "{own}");
    let nan = of(|all| all[0].terms[0].1 = f64::NAN).expect_err("no number");
    assert!(matches!(nan, Broken::Fault(ElementFault::Coefficient { .. })), "{nan}");
}
