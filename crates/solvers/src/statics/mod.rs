//! Nonlinear static analysis by the link kernel, and initial values of massless directions.
//!
//! Equilibrium along a path of growing loads or displacements, and rates in balance with dashpots.
//! May use `kernel` and `step`.
//!
//! ```text
//! K̂ = K + Bᵀ k_e B      d = B K̂⁻¹ p − G f̃,  G = B K̂⁻¹ Bᵀ      f̃ = f − k_e d
//! ```
//!
//! with the stiffness of the engaged links as effective stiffnesses, so that a structure that stands is a linear solve.
//! The load grows in steps, halved where the links find no equilibrium, and where the whole step and its halves do not
//! end alike: laws whose force turns on the way, and links that engage on it, are followed. The halves are kept. Link
//! history is carried on.
//!
//! Joints without mass are led the same way to where initial displacements of the others put them: with N their
//! directions and A = Nᵀ K̂ N,
//!
//! ```text
//! u = u₀ + λ (I − N A⁻¹ Nᵀ K̂) Δu − N A⁻¹ Nᵀ Bᵀ (f̃ − f̃₀)
//! ```

mod joints;
mod rates;

pub(crate) use joints::{follow, lead};
pub(crate) use rates::rates;

use crate::error::SolveError;
use crate::kernel::{
    Affine, Committed, Compliance, Converged, Extrapolation, Guess, LinkKernel, NoEquilibrium,
    StepKey, Wanted,
};
use crate::step::{Culprit, State, Suspicion, is_sound, leaves_out, not_finite};
use trilith_element::Energy;
use trilith_linalg::{Dense, Ldlt};
use trilith_model::{Model, Solution};
use trilith_system::{Answers, Laws, LinkSet, System};

const SMALLEST: f64 = 1e-4;

/// Share of the largest by which the whole steps of a path and their halves may be apart at its end; a step of this
/// share of the path is not halved for that.
const ALIKE: f64 = 2e-5;
const SHORT: f64 = 1.0 / 4096.0;

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
    /// The law that answers with no finite number, where one does.
    pub culprit: Option<Culprit>,
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
    let Path { image, from, by, .. } = path;
    let links = &system.links;
    let mut walk = Walk::new(model, system, path);
    let mut here = walk.start(start);
    let longest = 1.0 / steps.max(1) as f64;
    let (mut reached, mut step, mut made, mut rejected) = (0.0, longest, 0, 0);
    while reached < 1.0 {
        let next = if reached + 1.0001 * step >= 1.0 { 1.0 } else { reached + step };
        let length = next - reached;
        let tried = walk.to(&here, next).and_then(|whole| {
            if is_straight(&here.state, &whole.state) {
                return Ok((0.0, whole));
            }
            let middle = walk.to(&here, reached + 0.5 * length)?;
            let end = walk.to(&middle, next)?;
            Ok((apart(links, &whole.state, &end.state), end))
        });
        match tried {
            // What rounding leaves of short steps says nothing.
            Ok((off, _)) if off > ALIKE * length && length > SHORT => {
                rejected += 1;
                step = 0.5 * length;
            }
            Ok((off, end)) => {
                if off < 0.25 * ALIKE * length {
                    step = (2.0 * step).min(longest);
                }
                here = end;
                reached = next;
                made += 1;
            }
            Err(NoEquilibrium { worst, residual }) => {
                rejected += 1;
                step *= 0.5;
                if step < SMALLEST || walk.blamed {
                    let culprit = walk.culprit.take();
                    return Err(Unbalanced { reached, worst, residual, culprit });
                }
            }
        }
    }
    let mut u: Vec<f64> = from.iter().zip(by).map(|(a, b)| a + b).collect();
    image.mul_add(-1.0, &here.pseudo, &mut u);
    let iterations = walk.kernel.iterations();
    Ok(Equilibrium { u, state: here.state, iterations, steps: made, rejected })
}

/// A place on a path: the links, and their forces beyond those of the effective stiffnesses.
struct Place {
    state: State,
    pseudo: Vec<f64>,
}

/// The links on a path.
struct Walk<'a> {
    links: &'a LinkSet,
    kernel: LinkKernel<'a>,
    /// Their deformations under forces of theirs.
    compliance: Compliance,
    /// Their deformations at the start, and what the path adds.
    before: Vec<f64>,
    added: Vec<f64>,
    zero: Vec<f64>,
    laws: Laws<'a>,
    suspicion: Suspicion,
    /// The law that had no finite answer in the last step that failed, ...
    culprit: Option<Culprit>,
    /// ... or that shorter steps do not help, as it does not account for its work.
    blamed: bool,
}

impl<'a> Walk<'a> {
    fn new(model: &'a Model, system: &'a System, path: &Path) -> Self {
        let Path { engaged, image, from, by, tolerance } = path;
        let solution = Solution { link_tolerance: *tolerance, ..Solution::default() };
        let links = &system.links;
        let deform = |u: &[f64]| -> Vec<f64> {
            let row = |flat: &usize| links.rows[*flat].iter().map(|(j, c)| c * u[*j]).sum();
            links.active.iter().map(row).collect()
        };
        let active = links.active.len();
        let mut g = Dense::zeros(active, active);
        for j in 0..active {
            let d = deform(image.column(j));
            g.column_mut(j).copy_from_slice(&d);
        }
        let effective_k = links.active.iter().map(|i| engaged[*i]).collect();
        Self {
            links,
            kernel: LinkKernel::new(model, links, &solution, effective_k),
            compliance: Compliance::full(g, Dense::zeros(active, active), StepKey::default()),
            before: deform(from),
            added: deform(by),
            zero: vec![0.0; links.len()],
            laws: links.laws(model),
            suspicion: Suspicion::default(),
            culprit: None,
            blamed: false,
        }
    }

    fn start(&mut self, state: State) -> Place {
        let mut pseudo = vec![0.0; self.before.len()];
        self.kernel.pseudo(&state.f, &state.d, &self.zero, &mut pseudo);
        Place { state, pseudo }
    }

    /// From a place straight to a share of the path.
    fn to(&mut self, from: &Place, share: f64) -> Result<Place, NoEquilibrium> {
        let Self {
            links, kernel, compliance: Compliance { g, h, key }, before, added, zero, ..
        } = self;
        let Place { state, pseudo } = from;
        let Wanted { d, v, .. } = kernel.wanted();
        for (d, (a, b)) in d.iter_mut().zip(before.iter().zip(&*added)) {
            *d = a + share * b;
        }
        g.mul_add(-1.0, pseudo, d);
        v.fill(0.0);
        let mut trial = state.clone();
        trial.v.fill(0.0);
        trial.history.fill(f64::NAN);
        let mut attempt = vec![0.0; pseudo.len()];
        let mut energy = vec![Energy::default(); links.links.len()];
        let committed = Committed {
            d: &state.d,
            v: zero,
            f: &state.f,
            history: &state.history,
            tangents: &state.tangents,
            extrapolation: &Extrapolation::default(),
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
            extrapolation: &mut Extrapolation::default(),
        };
        let affine = Affine { support: None, g, h, key };
        let solved =
            kernel.solve(&affine, pseudo, Guess::Unchanged, &committed, &state.scale, &mut out);
        if let Err(failed) = solved {
            kernel.show(&mut out);
            self.culprit = not_finite(links, (state, &trial), 0.0, None);
            return Err(failed);
        }
        if !is_sound(&trial, &energy) {
            self.culprit = not_finite(links, (state, &trial), 0.0, Some(&energy));
            if self.culprit.is_some() {
                return Err(NoEquilibrium { worst: usize::MAX, residual: f64::NAN });
            }
        }
        trial.record_converged(links, &energy, kernel.largest_force());
        let Self { links, laws, suspicion, .. } = self;
        let suspects = suspicion.look(links, (state, &trial), &energy);
        let blamed = leaves_out(&suspects, laws, (state, &trial), 0.0, None);
        if blamed.is_some() {
            (self.culprit, self.blamed) = (blamed, true);
            return Err(NoEquilibrium { worst: usize::MAX, residual: f64::NAN });
        }
        Ok(Place { state: trial, pseudo: attempt })
    }
}

/// True where no law has bent between two places: halves of the way would end alike.
fn is_straight(a: &State, b: &State) -> bool {
    let (before, after) = (&a.tangents.k, &b.tangents.k);
    let most = after.iter().fold(0.0_f64, |most, k| most.max(k.abs()));
    before.iter().zip(after).all(|(a, b)| (a - b).abs() <= 1e-9 * most)
}

/// How far two ends of a step are apart: forces, and deformations of the links that carry some, as share of the
/// largest of their kind.
fn apart(links: &LinkSet, a: &State, b: &State) -> f64 {
    let mut most = [[0.0_f64; 2]; 2];
    let mut off = [[0.0_f64; 2]; 2];
    for i in 0..links.len() {
        let kind = usize::from(links.rotational[i]);
        let mut compare = |of: usize, x: f64, y: f64| {
            most[of][kind] = most[of][kind].max(x.abs()).max(y.abs());
            off[of][kind] = off[of][kind].max((x - y).abs());
        };
        compare(0, a.f[i], b.f[i]);
        if a.f[i] != 0.0 && b.f[i] != 0.0 {
            compare(1, a.d[i], b.d[i]);
        }
    }
    let shares = off.iter().flatten().zip(most.iter().flatten());
    shares.filter(|(_, most)| **most > 0.0).map(|(off, most)| off / most).fold(0.0, f64::max)
}
