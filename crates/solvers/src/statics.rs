//! Nonlinear static analysis by the link kernel.
//!
//! ```text
//! K̂ = K + Bᵀ k_e B      d = B K̂⁻¹ p − G f̃,  G = B K̂⁻¹ Bᵀ      f̃ = f − k_e d
//! ```
//!
//! with the stiffness of the engaged links as dummies, so that a structure that stands is a linear solve.
//! The load grows in steps, halved where the links find no equilibrium; link history is carried on.
//!
//! Joints without mass are led the same way to where initial displacements of the others put them: with N their
//! directions and A = Nᵀ K̂ N,
//!
//! ```text
//! u = u₀ + λ (I − N A⁻¹ Nᵀ K̂) Δu − N A⁻¹ Nᵀ Bᵀ (f̃ − f̃₀)
//! ```

use crate::error::SolveError;
use crate::kernel::{Affine, Committed, Converged, LinkKernel, NoEquilibrium, Unforeseen};
use crate::propagator::{StepKey, Wanted};
use crate::stepper::State;
use trilith_element::Energy;
use trilith_linalg::{Dense, Ldlt};
use trilith_model::{Model, Solution};
use trilith_system::{Answers, System};

const SMALLEST: f64 = 1e-4;

/// What a static case leaves: displacements of the free DOFs and the link history.
#[derive(Clone, Debug)]
pub(crate) struct Equilibrium {
    pub u: Vec<f64>,
    pub state: State,
    pub iterations: usize,
    pub steps: usize,
    pub rejected: usize,
}

/// Ends where no equilibrium is: share of the load reached, worst coordinate, residual.
pub(crate) struct Unbalanced {
    pub reached: f64,
    pub worst: usize,
    pub residual: f64,
}

/// What links move, and the way of the linear structure with engaged links: `u = from + λ by − image f̃`.
pub(crate) struct Path {
    /// Stiffness of engaged links, flat.
    pub engaged: Vec<f64>,
    /// Displacements by unit forces of the active link coordinates, order × active.
    pub image: Dense,
    pub from: Vec<f64>,
    pub by: Vec<f64>,
    /// Share of the largest link force by which a link may be out of equilibrium.
    pub tolerance: f64,
}

/// Rows of the active link coordinates as columns, order × active.
pub(crate) fn columns_of_links(system: &System) -> Dense {
    let links = &system.links;
    let mut columns = Dense::zeros(system.order(), links.active.len());
    for (j, flat) in links.active.iter().enumerate() {
        for (i, c) in &links.rows[*flat] {
            columns[(*i, j)] += c;
        }
    }
    columns
}

/// From a history and constant loads `before` to `before + added`.
pub(crate) fn equilibrium(
    model: &Model,
    system: &System,
    start: State,
    before: &[f64],
    added: &[f64],
    steps: usize,
) -> Result<Result<Equilibrium, Unbalanced>, SolveError> {
    system.check_supported(model, false)?;
    let engaged = system.links.engaged(model);
    let mut factor = Ldlt::new(&system.stiffness_with(&engaged))?;
    let mut image = columns_of_links(system);
    factor.solve(image.values_mut());
    let mut solve = |p: &[f64]| {
        let mut u = p.to_vec();
        factor.solve(&mut u);
        u
    };
    let (from, by) = (solve(before), solve(added));
    let tolerance = Solution::default().link_tolerance;
    Ok(along(model, system, start, &Path { engaged, image, from, by, tolerance }, steps))
}

/// Along a path, from λ = 0 to 1.
pub(crate) fn along(
    model: &Model,
    system: &System,
    start: State,
    path: &Path,
    steps: usize,
) -> Result<Equilibrium, Unbalanced> {
    let Path { engaged, image, from, by, tolerance } = path;
    let solution = Solution { link_tolerance: *tolerance, ..Solution::default() };
    let links = &system.links;
    let deform = |u: &[f64]| -> Vec<f64> {
        links.active.iter().map(|i| links.rows[*i].iter().map(|(j, c)| c * u[*j]).sum()).collect()
    };
    let mut g = Dense::zeros(links.active.len(), links.active.len());
    for j in 0..links.active.len() {
        let d = deform(image.column(j));
        g.column_mut(j).copy_from_slice(&d);
    }
    let none = Dense::zeros(links.active.len(), links.active.len());
    let (d_before, d_added) = (deform(from), deform(by));
    let dummy: Vec<f64> = links.active.iter().map(|i| engaged[*i]).collect();
    let zero = vec![0.0; links.len()];
    let mut kernel = LinkKernel::new(model, links, &solution, dummy.clone());
    let mut state = start;
    let mut pseudo = vec![0.0; dummy.len()];
    kernel.pseudo(&state.f, &state.d, &zero, &mut pseudo);
    let (mut reached, mut step, mut made, mut rejected) = (0.0, 1.0 / steps.max(1) as f64, 0, 0);
    while reached < 1.0 {
        let next = if reached + 1.0001 * step >= 1.0 { 1.0 } else { reached + step };
        let Wanted { d, v, .. } = kernel.wanted();
        for (d, (a, b)) in d.iter_mut().zip(d_before.iter().zip(&d_added)) {
            *d = a + next * b;
        }
        g.mul_add(-1.0, &pseudo, d);
        v.fill(0.0);
        let mut trial = state.clone();
        trial.v.fill(0.0);
        let mut attempt = vec![0.0; pseudo.len()];
        let mut energy = vec![Energy::default(); links.links.len()];
        let committed = Committed {
            d: &state.d,
            v: &zero,
            f: &state.f,
            history: &state.history,
            tangents: &state.tangents,
            unforeseen: &Unforeseen::default(),
            dt: 0.0,
        };
        let mut out = Converged {
            d: &mut trial.d,
            v: &mut trial.v,
            laws: Answers {
                history: &mut trial.history,
                f: &mut trial.f,
                tangents: &mut trial.tangents,
                energy: &mut energy,
            },
            pseudo: &mut attempt,
            unforeseen: &mut Unforeseen::default(),
        };
        let affine = Affine { support: None, g: &g, h: &none, key: StepKey::default() };
        kernel.begin(&pseudo, &committed);
        match kernel.settle(&affine, &committed, &state.scale, &mut out) {
            Ok(()) => {
                trial.settle(links, &energy, kernel.largest_force());
                state = trial;
                pseudo = attempt;
                reached = next;
                made += 1;
                step = (2.0 * step).min(1.0 / steps.max(1) as f64);
            }
            Err(NoEquilibrium { worst, residual }) => {
                rejected += 1;
                step *= 0.5;
                if step < SMALLEST {
                    return Err(Unbalanced { reached, worst, residual });
                }
            }
        }
    }
    let mut u: Vec<f64> = from.iter().zip(by).map(|(a, b)| a + b).collect();
    image.mul_add(-1.0, &pseudo, &mut u);
    Ok(Equilibrium { u, state, iterations: kernel.iterations(), steps: made, rejected })
}
