//! The link kernel: forces of all links at the end of a step.
//!
//! Every linear step is affine in the pseudo-forces f̃ = f − k_e d at its end:
//!
//! ```text
//! d = d* − G f̃        ḋ = v* − H f̃        f = law(d, ḋ)
//! ```
//!
//! `Newton` solves `R(f̃) = law(d, ḋ) − k_e d − f̃ = 0` with the full tangents of the laws,
//! `J = I + (k − k_e) G + c H`; coordinates whose row of tangents is zero need no equation.
//! `FixedPoint` is Wilson's constant-stiffness iteration, f̃ ← law − k_e d; it converges only
//! while |k − k_e| G < 1. Neither touches a matrix of the structure.

use crate::vector::largest;
use serde::{Deserialize, Serialize};
use trilith_element::{Energy, Kinematics};
use trilith_linalg::{Dense, DenseLu};
use trilith_model::{Kernel, Model};
use trilith_system::{LinkSet, Tangents};

/// What the linear step gives the kernel.
pub(crate) struct Affine<'a> {
    /// d* and v* of the active coordinates.
    pub d: &'a [f64],
    pub v: &'a [f64],
    /// Deformation and rate that moving supports add, flat.
    pub support_d: &'a [f64],
    pub support_v: &'a [f64],
    /// Compliances, active × active, symmetric.
    pub g: &'a Dense,
    pub h: &'a Dense,
    /// Identity of the compliances: a factor made with others is not used again.
    pub key: u64,
}

/// The committed side of a step, flat.
pub(crate) struct Committed<'a> {
    pub d: &'a [f64],
    pub v: &'a [f64],
    pub history: &'a [f64],
    pub dt: f64,
}

/// Where the converged values go, flat; `pseudo` is f̃ of the active coordinates.
pub(crate) struct Converged<'a> {
    pub d: &'a mut [f64],
    pub v: &'a mut [f64],
    pub f: &'a mut [f64],
    pub history: &'a mut [f64],
    pub energy: &'a mut [Energy],
    pub pseudo: &'a mut [f64],
}

/// No equilibrium: the worst flat coordinate and its residual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NoEquilibrium {
    pub worst: usize,
    pub residual: f64,
}

/// Largest force seen so far: of translations and of rotations, N and N·m.
pub(crate) type ForceScale = [f64; 2];

/// A force that depends steeply on a rate which is a difference of larger ones is known no better than
/// this many tolerances; up to there it counts as found once the correction has [`SETTLED`].
const ROUNDING: f64 = 1e3;
/// A correction below this share of the tolerance changes nothing any more.
const SETTLED: f64 = 1e-4;
/// A pseudo-force counts as a force only by its rounding: with stiff dummies on a sliding contact it may
/// be millions of times any force there is.
const PSEUDO_SHARE: f64 = 1e-5;
/// Plain Newton iterations before the first line search.
const SEARCH_FROM: usize = 2;
/// Halvings of a correction at most.
const HALVINGS: usize = 6;
/// A correction that leaves more than this share of the residual went too far.
const ENOUGH: f64 = 0.9;
const NEWTON_ITERATIONS: usize = 60;
const FIXED_POINT_ITERATIONS: usize = 200;
const TOLERANCE: f64 = 1e-9;
/// Added to J's diagonal: a direction that nothing holds but its dummy, such as that of an open contact
/// under a weight, is singular in a static analysis; held by this, it goes far until something stops it.
const HOLD: f64 = 1e-12;
/// Two units in the last place.
const DIGIT: f64 = 2.0 * f64::EPSILON;
/// Step sizes whose factors are kept.
const KEPT: usize = 6;
/// From this many equations on, a factor is kept while it still contracts well.
const CHORD_FROM: usize = 24;

/// Workspace and settings of the link equations.
pub(crate) struct LinkKernel {
    kind: Kernel,
    /// Dummy stiffness of the active coordinates.
    dummy_k: Vec<f64>,
    tangents: Tangents,
    /// Active index of each flat coordinate.
    place: Vec<usize>,
    residual: Vec<f64>,
    /// Kept factors, one a step size, the one used last at the end.
    factors: Vec<Factor>,
    iterations: usize,
}

/// A kept factor as a checkpoint holds it: the step size and the tangents it was made with.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Remembered {
    pub dt: f64,
    pub k: Vec<f64>,
    pub c: Vec<f64>,
}

struct Factor {
    key: u64,
    tangents: Tangents,
    equations: Vec<usize>,
    /// J of the chosen equations against the others, column-wise.
    coupling: Dense,
    lu: DenseLu,
}

/// Line search of a Newton iteration that does not settle: a force like |v|^α with α < ½ throws Newton's
/// method to the other side of zero, farther than it came from.
#[derive(Default)]
struct Search {
    /// The last correction.
    step: Vec<f64>,
    /// Part of it that is taken back next.
    share: f64,
    /// Largest residual before the last correction.
    before: f64,
    /// Halvings of the last correction.
    halvings: usize,
}

impl Search {
    /// Takes back half of the last correction where the residual did not fall; true where it took back.
    fn shortens(&mut self, iteration: usize, residual: &[f64], pseudo: &mut [f64]) -> bool {
        let size = largest(residual);
        let grew =
            iteration >= SEARCH_FROM && size > ENOUGH * self.before && self.halvings < HALVINGS;
        if grew {
            self.share *= 0.5;
            self.halvings += 1;
            for (x, r) in pseudo.iter_mut().zip(&self.step) {
                *x -= self.share * r;
            }
        } else {
            self.before = size;
        }
        grew
    }

    /// Takes note of a correction about to be made.
    fn goes(&mut self, step: &[f64]) {
        self.step.clear();
        self.step.extend_from_slice(step);
        (self.share, self.halvings) = (1.0, 0);
    }
}

impl LinkKernel {
    pub(crate) fn new(links: &LinkSet, kind: Kernel, dummy_k: Vec<f64>) -> Self {
        let mut place = vec![usize::MAX; links.len()];
        for (a, flat) in links.active.iter().enumerate() {
            place[*flat] = a;
        }
        Self {
            kind,
            dummy_k,
            tangents: links.tangents(),
            place,
            residual: vec![0.0; links.active.len()],
            factors: Vec::new(),
            iterations: 0,
        }
    }

    /// Iterations made so far.
    pub(crate) fn iterations(&self) -> usize {
        self.iterations
    }

    /// The kept factors, to be recalled after a restart: a kept factor decides the last bits of an
    /// iteration.
    pub(crate) fn memory(&self) -> Vec<Remembered> {
        self.factors
            .iter()
            .map(|f| Remembered {
                dt: f64::from_bits(f.key),
                k: f.tangents.k.clone(),
                c: f.tangents.c.clone(),
            })
            .collect()
    }

    /// Makes a factor again, with the compliances of its step size.
    pub(crate) fn recall(&mut self, links: &LinkSet, memory: Remembered, g: &Dense, h: &Dense) {
        let tangents = Tangents { k: memory.k, c: memory.c };
        let factor = self.factorise(links, tangents, memory.dt.to_bits(), g, h);
        self.factors.push(factor);
    }

    /// Pseudo-force of forces that act at a deformation (flat arrays, moving supports taken off the deformation).
    pub(crate) fn pseudo(&self, links: &LinkSet, f: &[f64], d: &[f64], to: &mut [f64]) {
        for (a, flat) in links.active.iter().enumerate() {
            to[a] = f[*flat] - self.dummy_k[a] * d[*flat];
        }
    }

    /// Solves the link equations; `out.pseudo` holds the start value on entry.
    pub(crate) fn solve(
        &mut self,
        model: &Model,
        links: &LinkSet,
        affine: &Affine<'_>,
        from: &Committed<'_>,
        scale: &ForceScale,
        out: &mut Converged<'_>,
    ) -> Result<(), NoEquilibrium> {
        let limit = match self.kind {
            Kernel::Newton => NEWTON_ITERATIONS,
            Kernel::FixedPoint => FIXED_POINT_ITERATIONS,
        };
        let mut size_before = f64::INFINITY;
        let mut search = Search::default();
        let mut worst = NoEquilibrium { worst: 0, residual: f64::INFINITY };
        for iteration in 0..limit {
            self.iterations += 1;
            self.evaluate(model, links, affine, from, out);
            let (size, at) = self.measure(links, out, scale);
            worst = at;
            if size <= 1.0 {
                return Ok(());
            }
            if !size.is_finite() {
                break;
            }
            if self.kind == Kernel::Newton {
                if search.shortens(iteration, &self.residual, out.pseudo) {
                    continue;
                }
                let before = largest(&self.residual);
                self.newton_correction(links, affine, size > 0.2 * size_before);
                let moves = size * largest(&self.residual) / before;
                if size <= ROUNDING && moves <= SETTLED {
                    return Ok(());
                }
            }
            size_before = size;
            search.goes(&self.residual);
            for (x, r) in out.pseudo.iter_mut().zip(&self.residual) {
                *x += r;
            }
        }
        self.factors.retain(|f| f.key != affine.key);
        Err(worst)
    }

    /// Deformations from f̃, laws, residual.
    fn evaluate(
        &mut self,
        model: &Model,
        links: &LinkSet,
        affine: &Affine<'_>,
        from: &Committed<'_>,
        out: &mut Converged<'_>,
    ) {
        let n = links.active.len();
        let (mut d, mut v) = (affine.d.to_vec(), affine.v.to_vec());
        affine.g.mul_add(-1.0, out.pseudo, &mut d);
        affine.h.mul_add(-1.0, out.pseudo, &mut v);
        out.d.copy_from_slice(affine.support_d);
        out.v.copy_from_slice(affine.support_v);
        for a in 0..n {
            out.d[links.active[a]] += d[a];
            out.v[links.active[a]] += v[a];
        }
        let at = Kinematics { d: out.d, v: out.v, d0: from.d, v0: from.v, dt: from.dt };
        links.respond(model, at, from.history, out.history, out.f, &mut self.tangents, out.energy);
        for a in 0..n {
            self.residual[a] = out.f[links.active[a]] - self.dummy_k[a] * d[a] - out.pseudo[a];
        }
    }

    /// Largest residual over its tolerance, and where.
    fn measure(
        &self,
        links: &LinkSet,
        out: &Converged<'_>,
        scale: &ForceScale,
    ) -> (f64, NoEquilibrium) {
        let mut now = *scale;
        for (a, flat) in links.active.iter().enumerate() {
            let kind = usize::from(links.rotational[*flat]);
            // The residual counts as a force: before the first link is touched there is no other.
            now[kind] = now[kind]
                .max(out.f[*flat].abs())
                .max(PSEUDO_SHARE * out.pseudo[a].abs())
                .max(self.residual[a].abs());
        }
        let rounding = self.rounding(links, out);
        let mut size = 0.0;
        let mut worst = NoEquilibrium { worst: 0, residual: 0.0 };
        for (a, r) in self.residual.iter().enumerate() {
            let flat = links.active[a];
            let scale = now[usize::from(links.rotational[flat])];
            let allowed = (TOLERANCE * scale).max(rounding[a]);
            let share = if *r == 0.0 { 0.0 } else { r.abs() / allowed.max(f64::MIN_POSITIVE) };
            if share > size || !share.is_finite() {
                size = share;
                worst = NoEquilibrium { worst: flat, residual: r.abs() };
            }
        }
        (size, worst)
    }

    /// What the last digits of deformations and rates make of the forces of the active coordinates: a
    /// stiff contact under a body that has gone far.
    fn rounding(&self, links: &LinkSet, out: &Converged<'_>) -> Vec<f64> {
        let mut forces = vec![0.0; links.active.len()];
        for link in &links.links {
            let n = link.range.len();
            for i in 0..n {
                let a = self.place[link.range.start + i];
                if a == usize::MAX {
                    continue;
                }
                let row = link.block.start + i * n;
                for (j, flat) in link.range.clone().enumerate() {
                    let (k, c) = (self.tangents.k[row + j], self.tangents.c[row + j]);
                    forces[a] += DIGIT * ((k * out.d[flat]).abs() + (c * out.v[flat]).abs());
                }
            }
        }
        forces
    }

    /// Replaces the residual by the Newton correction of f̃.
    fn newton_correction(&mut self, links: &LinkSet, affine: &Affine<'_>, slow: bool) {
        let kept = self.factors.iter().position(|f| f.key == affine.key);
        let factor = kept
            .map(|at| self.factors.remove(at))
            .filter(|f| f.tangents == self.tangents || (f.equations.len() >= CHORD_FROM && !slow));
        let factor = factor.unwrap_or_else(|| {
            self.factorise(links, self.tangents.clone(), affine.key, affine.g, affine.h)
        });
        let mut x: Vec<f64> = factor.equations.iter().map(|a| self.residual[*a]).collect();
        factor.coupling.mul_add(-1.0, &self.residual, &mut x);
        factor.lu.solve(&mut x);
        for (a, value) in factor.equations.iter().zip(x) {
            self.residual[*a] = value;
        }
        if self.factors.len() >= KEPT {
            self.factors.remove(0);
        }
        self.factors.push(factor);
    }

    fn factorise(
        &self,
        links: &LinkSet,
        tangents: Tangents,
        key: u64,
        g: &Dense,
        h: &Dense,
    ) -> Factor {
        let n = links.active.len();
        // Rows of k − k_e and c per active coordinate: (other active, stiffness, damping).
        let mut rows: Vec<Vec<(usize, f64, f64)>> = vec![Vec::new(); n];
        for link in &links.links {
            let size = link.range.len();
            for i in 0..size {
                let a = self.place[link.range.start + i];
                if a == usize::MAX {
                    continue;
                }
                for j in 0..size {
                    let b = self.place[link.range.start + j];
                    if b == usize::MAX {
                        continue;
                    }
                    let at = link.block.start + i * size + j;
                    let own = f64::from(u8::from(i == j));
                    let k = tangents.k[at] - own * self.dummy_k[a];
                    let c = tangents.c[at];
                    if k != 0.0 || c != 0.0 {
                        rows[a].push((b, k, c));
                    }
                }
            }
        }
        let equations: Vec<usize> = (0..n).filter(|a| !rows[*a].is_empty()).collect();
        let mut chosen = vec![usize::MAX; n];
        for (e, a) in equations.iter().enumerate() {
            chosen[*a] = e;
        }
        let mut j = Dense::zeros(equations.len(), equations.len());
        let mut coupling = Dense::zeros(equations.len(), n);
        let mut line = vec![0.0; n];
        for (e, a) in equations.iter().enumerate() {
            line.fill(0.0);
            for (b, k, c) in &rows[*a] {
                for (x, (g, h)) in line.iter_mut().zip(g.column(*b).iter().zip(h.column(*b))) {
                    *x += k * g + c * h;
                }
            }
            line[*a] += 1.0 + HOLD;
            for (b, x) in line.iter().enumerate() {
                match chosen[b] {
                    usize::MAX => coupling[(e, b)] = *x,
                    column => j[(e, column)] = *x,
                }
            }
        }
        Factor { key, tangents, lu: DenseLu::new(&j), equations, coupling }
    }
}
