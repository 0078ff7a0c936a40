//! Damping of what moves against moving supports.
//!
//! ```text
//! u = ι u_s + v        ι = −K⁻¹ K_fs        C v̇ = C u̇ − C ι u̇_s,   C = α M + M Φ diag(2 ζ ω) Φᵀ M
//! ```
//!
//! Displacements are absolute where supports move, and the structure follows them; damping by modes and by mass is
//! meant for what it does beside that. In proportion to K it is so by itself, K ι + K_fs being zero. What only links
//! hold follows the supports as these hold it; what nothing holds does not.
//!
//! Reference: \[Chopra, Dynamics of Structures, sect. 9.7\].

use super::damping::ModalDamping;
use super::held;
use crate::error::SolveError;
use trilith_linalg::{Sparse, StagedLdlt, Triplets};
use trilith_model::Model;
use trilith_system::{LoadSet, System};

/// Share of the stiffness of engaged links beside that of a structure that does not stand without them: they say how those
/// parts follow that nothing else holds, and next to nothing of the others, where a gap may be open.
const SHARE: f64 = 1e-6;
/// Share of the mean stiffness that holds what nothing else does.
const HOLD: f64 = 1e-10;

/// Adds C ι u̇_s to the loads of moving supports; `reduced` on a basis, where nothing is beyond its modes.
pub(crate) fn follow_supports(
    model: &Model,
    system: &System,
    modal: Option<&ModalDamping>,
    reduced: bool,
    loads: &mut LoadSet,
) -> Result<(), SolveError> {
    let of_mass = system.rayleigh[0];
    if loads.supports.is_empty() || (of_mass == 0.0 && modal.is_none()) {
        return Ok(());
    }
    let n = system.order();
    let mut forces = Vec::new();
    for follows in pseudo_static(model, system, loads)? {
        let mut force = vec![0.0; n];
        system.mass.mul_add(of_mass, &follows, &mut force);
        if let Some(modal) = modal {
            modal.push(system, reduced, &follows, &mut force);
        }
        forces.push(force);
    }
    loads.add_to_rates(&forces);
    Ok(())
}

/// How the structure follows each moving support by itself: −K⁻¹ K_fs, a column for each.
fn pseudo_static(
    model: &Model,
    system: &System,
    loads: &LoadSet,
) -> Result<Vec<Vec<f64>>, SolveError> {
    let links = &system.links;
    let mut springs = vec![0.0; links.len()];
    let factor = match held(&[(1.0, &system.stiffness)])? {
        Some(factor) => factor,
        None => {
            springs = links.engaged(model).iter().map(|k| SHARE * k).collect();
            let stiffness = system.stiffness_with(&springs);
            match held(&[(1.0, &stiffness)])? {
                Some(factor) => factor,
                None => loose(&stiffness)?,
            }
        }
    };
    let column = |s: usize| {
        let mut p = vec![0.0; system.order()];
        let (rows, values) = system.stiffness_support.column(s);
        rows.iter().zip(values).for_each(|(i, k)| p[*i] -= k);
        for ((row, of_support), k) in links.rows.iter().zip(&links.support_rows).zip(&springs) {
            let moved: f64 = of_support.iter().filter(|(j, _)| *j == s).map(|(_, c)| c).sum();
            if moved != 0.0 {
                row.iter().for_each(|(i, c)| p[*i] -= c * k * moved);
            }
        }
        factor.solve(&mut p);
        p
    };
    Ok(loads.supports.iter().map(|(s, _, _)| column(*s)).collect())
}

/// The factor of a stiffness that does not hold everything.
fn loose(stiffness: &Sparse) -> Result<StagedLdlt, SolveError> {
    let n = stiffness.rows();
    let mean = stiffness.diagonal().iter().sum::<f64>() / n as f64;
    let mut all = Triplets::new(n, n);
    (0..n).for_each(|i| all.add(i, i, 1.0));
    let hold = if mean > 0.0 { HOLD * mean } else { 1.0 };
    Ok(StagedLdlt::alone(&[(1.0, stiffness), (hold, &all.build())])?)
}
