//! The link kernel: forces of all links at the end of a step.
//!
//! Every linear step is affine in the pseudo-forces f̃ = f − k_e d at its end:
//!
//! ```text
//! d = d* − G f̃        ḋ = v* − H f̃        f = law(d, ḋ)
//! ```
//!
//! `Newton` solves `R(f̃) = law(d, ḋ) − k_e d − f̃ = 0` with the full tangents of the laws,
//! `J = I + (k − k_e) G + c H`; coordinates whose row of tangents is zero or weak need no equation. It starts
//! from what the tangents at the start of the step foresee, and what such guesses lacked in the steps before.
//! `FixedPoint` is Wilson's constant-stiffness iteration, f̃ ← law − k_e d; it converges only
//! while |k − k_e| G < 1. Neither touches a matrix of the structure.

mod factors;
mod foresee;
mod measure;
mod search;
mod unforeseen;

pub(crate) use factors::Remembered;
pub(crate) use unforeseen::Unforeseen;

use crate::propagator::{StepKey, Wanted};
use crate::vector::{add, largest, residual};
use factors::{Equations, Factors};
use search::Search;
use trilith_element::{Energy, Kinematics};
use trilith_linalg::Dense;
use trilith_model::{Kernel, Model, Solution};
use trilith_system::{LinkBlocks, LinkSet, StepLaws, Tangents};

/// What the linear step gives the kernel.
pub(crate) struct Affine<'a> {
    /// Deformation and rate that supports add, flat, where they move.
    pub support: Option<[&'a [f64]; 2]>,
    /// Compliances, active × active, symmetric.
    pub g: &'a Dense,
    pub h: &'a Dense,
    /// Identity of the compliances: a factor made with others is not used again.
    pub key: StepKey,
}

/// The committed side of a step, flat.
pub(crate) struct Committed<'a> {
    pub d: &'a [f64],
    pub v: &'a [f64],
    pub f: &'a [f64],
    pub history: &'a [f64],
    pub tangents: &'a Tangents,
    pub unforeseen: &'a Unforeseen,
    pub dt: f64,
}

/// Where the converged values go, flat; `pseudo` is f̃ of the active coordinates. What is zero in the tangents of a
/// law at all times is zero in `tangents` before.
pub(crate) struct Converged<'a> {
    pub d: &'a mut [f64],
    pub v: &'a mut [f64],
    pub f: &'a mut [f64],
    pub history: &'a mut [f64],
    pub tangents: &'a mut Tangents,
    pub energy: &'a mut [Energy],
    pub pseudo: &'a mut [f64],
    pub unforeseen: &'a mut Unforeseen,
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
/// Iterations before the first look at what rounding leaves.
const ROUNDING_FROM: usize = 2;
const NEWTON_ITERATIONS: usize = 60;
const FIXED_POINT_ITERATIONS: usize = 200;
/// From this many active coordinates on, a factor is kept while it still contracts well.
const CHORD_FROM: usize = 8;
/// How well that is: share of the residual that one iteration leaves.
const CONTRACTS: f64 = 0.2;

/// Workspace and settings of the link equations.
pub(crate) struct LinkKernel<'a> {
    kind: Kernel,
    /// Share of the largest force so far by which a link may be out of equilibrium.
    tolerance: f64,
    links: &'a LinkSet,
    laws: StepLaws<'a>,
    /// Dummy stiffness of the active coordinates.
    dummy_k: Vec<f64>,
    /// Active coordinates of laws that look at rates, and the others with their flat index.
    rated: Vec<usize>,
    unrated: Vec<(usize, usize)>,
    /// Blocks of all links, and of those whose laws look at rates.
    blocks: LinkBlocks,
    rated_blocks: LinkBlocks,
    /// Forces that follow from deformations and rates along the tangents, flat.
    pull: Vec<f64>,
    /// Active index of each flat coordinate.
    place: Vec<usize>,
    /// True where all coordinates are active.
    complete: bool,
    /// True where in addition no support moves: the own deformations and rates are those of all coordinates.
    plain: bool,
    /// Index of the link of each active coordinate.
    owner: Vec<usize>,
    /// Own deformations and rates of the active coordinates, without moving supports.
    d: Vec<f64>,
    v: Vec<f64>,
    residual: Vec<f64>,
    /// Largest residual, force and pseudo-force.
    sizes: [f64; 3],
    /// What a factor gives.
    correction: Vec<f64>,
    /// True where the first guess of this step holds what the steps before left unforeseen.
    expected: bool,
    /// True where deformations and rates have followed the last change of f̃ already.
    followed: bool,
    search: Search,
    /// Iterations in this step, and the size of the residual before the last one.
    iteration: usize,
    size_before: f64,
    factors: Factors,
    iterations: usize,
}

impl<'a> LinkKernel<'a> {
    pub(crate) fn new(
        model: &'a Model,
        links: &'a LinkSet,
        solution: &Solution,
        dummy_k: Vec<f64>,
    ) -> Self {
        let n = links.active.len();
        let mut place = vec![usize::MAX; links.len()];
        for (a, flat) in links.active.iter().enumerate() {
            place[*flat] = a;
        }
        let laws = links.laws(model);
        let (mut owner, mut rated, mut unrated) = (vec![0; n], Vec::new(), Vec::new());
        for (l, (law, link)) in laws.iter().enumerate() {
            for a in link.range.clone().map(|flat| place[flat]).filter(|a| *a != usize::MAX) {
                owner[a] = l;
                if law.uses_rates() { rated.push(a) } else { unrated.push((a, links.active[a])) }
            }
        }
        let blocks = LinkBlocks::of(laws.iter().map(|(_, link)| link));
        let rate_dependent = laws.iter().filter(|(law, _)| law.uses_rates());
        let rated_blocks = LinkBlocks::of(rate_dependent.map(|(_, link)| link));
        Self {
            kind: solution.kernel,
            blocks,
            rated_blocks,
            pull: Vec::new(),
            tolerance: solution.link_tolerance,
            links,
            laws: StepLaws::new(laws),
            dummy_k,
            rated,
            unrated,
            place,
            complete: n == links.len(),
            plain: false,
            owner,
            d: vec![0.0; n],
            v: vec![0.0; n],
            residual: vec![0.0; n],
            sizes: [0.0; 3],
            correction: Vec::new(),
            expected: false,
            followed: false,
            search: Search::default(),
            iteration: 0,
            size_before: f64::INFINITY,
            factors: Factors::default(),
            iterations: 0,
        }
    }

    /// Iterations made so far.
    pub(crate) fn iterations(&self) -> usize {
        self.iterations
    }

    /// Largest of the forces of the last iteration, N or N·m.
    pub(crate) fn largest_force(&self) -> f64 {
        self.sizes[1]
    }

    /// What the next step must know before it begins: where deformations and rates of the active coordinates go
    /// at the start value of f̃.
    pub(crate) fn wanted(&mut self) -> Wanted<'_> {
        Wanted { d: &mut self.d, v: &mut self.v, rated: &self.rated }
    }

    /// Active coordinates whose rates their law looks at.
    pub(crate) fn rated(&self) -> &[usize] {
        &self.rated
    }

    /// Active and flat index of coordinates whose rates no law looks at: [`solve`](Self::solve) leaves them to
    /// the caller.
    pub(crate) fn unrated(&self) -> &[(usize, usize)] {
        &self.unrated
    }

    /// The kept factors, to be recalled after a restart: a kept factor decides the last bits of an
    /// iteration.
    pub(crate) fn memory(&self) -> Vec<Remembered> {
        self.factors.memory()
    }

    /// Makes a factor again, with the compliances of its step size.
    pub(crate) fn recall(&mut self, memory: Remembered, g: &Dense, h: &Dense) {
        let Remembered { key, k, c } = memory;
        let mut factors = std::mem::take(&mut self.factors);
        factors.make(self.equations(g, h, key), Tangents { k, c });
        self.factors = factors;
    }

    /// True where all coordinates are active.
    pub(crate) fn is_complete(&self) -> bool {
        self.complete
    }

    /// Pseudo-force of forces that act at a deformation; `support` is what moving supports have in it.
    pub(crate) fn pseudo(&self, f: &[f64], d: &[f64], support: &[f64], to: &mut [f64]) {
        if self.complete {
            let own = d.iter().zip(support).zip(&self.dummy_k);
            let forces = to.iter_mut().zip(f).zip(own);
            forces.for_each(|((to, f), ((d, support), k))| *to = f - k * (d - support));
            return;
        }
        for (a, flat) in self.links.active.iter().enumerate() {
            to[a] = f[*flat] - self.dummy_k[a] * (d[*flat] - support[*flat]);
        }
    }

    /// Solves the link equations at what was [wanted](Self::wanted); `out.pseudo` holds the start value on entry.
    /// The rates of coordinates whose law does not look at them stay as they are predicted.
    pub(crate) fn solve(
        &mut self,
        affine: &Affine<'_>,
        from: &Committed<'_>,
        scale: &ForceScale,
        out: &mut Converged<'_>,
    ) -> Result<(), NoEquilibrium> {
        self.begin();
        while !self.advance(affine, from, scale, out)? {
            if let Some((change, d)) = self.change(affine.h) {
                affine.g.mul_add(-1.0, change, d);
            }
        }
        Ok(())
    }

    /// Takes up the link equations of a step.
    pub(crate) fn begin(&mut self) {
        self.search.reset();
        (self.iteration, self.size_before, self.expected) = (0, f64::INFINITY, false);
    }

    /// One iteration: true where the links are in equilibrium; else f̃ has changed by what
    /// [`change`](Self::change) says, and deformations and rates must follow.
    pub(crate) fn advance(
        &mut self,
        affine: &Affine<'_>,
        from: &Committed<'_>,
        scale: &ForceScale,
        out: &mut Converged<'_>,
    ) -> Result<bool, NoEquilibrium> {
        let limit = match self.kind {
            Kernel::Newton => NEWTON_ITERATIONS,
            Kernel::FixedPoint => FIXED_POINT_ITERATIONS,
        };
        self.iterations += 1;
        self.evaluate(affine, from, out);
        if self.iteration == 0 && self.kind == Kernel::Newton {
            out.unforeseen.note(from.unforeseen, affine.key, &self.residual, self.expected);
        }
        let (size, worst) = self.measure(out, scale, self.iteration);
        if size <= 1.0 {
            self.end(from, out);
            return Ok(true);
        }
        self.iteration += 1;
        if !size.is_finite() || self.iteration == limit {
            self.factors.forget(affine.key);
            return Err(worst);
        }
        self.followed = false;
        if self.kind == Kernel::Newton {
            let before = self.sizes[0];
            if let Some(back) = self.search.shortens(self.iteration - 1, before) {
                for (x, step) in self.residual.iter_mut().zip(&self.search.step) {
                    *x = -back * step;
                }
                self.take(out);
                return Ok(false);
            }
            self.newton_correction(affine, out.tangents, size > CONTRACTS * self.size_before);
            let may_settle = self.iteration >= ROUNDING_FROM && size <= ROUNDING;
            let step = step(self.followed, &self.correction, &self.residual);
            if may_settle && size * largest(step) <= SETTLED * before {
                self.end(from, out);
                return Ok(true);
            }
        }
        self.size_before = size;
        if self.iteration > 1 {
            self.search.goes(step(self.followed, &self.correction, &self.residual));
        }
        self.take(out);
        Ok(false)
    }

    /// The laws end the step where they were asked last.
    fn end(&mut self, from: &Committed<'_>, out: &mut Converged<'_>) {
        if self.plain {
            out.d.copy_from_slice(&self.d);
            out.v.copy_from_slice(&self.v);
        }
        let at = Kinematics { d: out.d, v: out.v, d0: from.d, v0: from.v, dt: from.dt };
        self.laws.end(at, out.history, out.energy);
    }

    /// f̃ takes the step, and what follows it already.
    fn take(&mut self, out: &mut Converged<'_>) {
        if !self.followed {
            return add(out.pseudo, &self.residual);
        }
        let (step, follows) = self.correction.split_at(self.residual.len());
        let (d, v) = follows.split_at(self.d.len());
        add(out.pseudo, step);
        add(&mut self.d, d);
        self.rated.iter().zip(v).for_each(|(a, change)| self.v[*a] += change);
    }

    /// The last change of f̃, and the deformations of the active coordinates, which must follow it by
    /// −G times it; none where they have done so already. The rates that laws look at have followed.
    pub(crate) fn change(&mut self, h: &Dense) -> Option<(&[f64], &mut [f64])> {
        if self.followed {
            return None;
        }
        self.change_rates(h);
        Some((&self.residual, &mut self.d))
    }

    fn change_rates(&mut self, h: &Dense) {
        if self.rated.len() == self.v.len() {
            h.mul_add(-1.0, &self.residual, &mut self.v);
        } else {
            // The compliances are symmetric.
            for a in &self.rated {
                self.v[*a] -= h.column_dot(*a, &self.residual);
            }
        }
    }

    /// Deformations and rates of all coordinates, where the own ones are not those.
    fn deform(&mut self, affine: &Affine<'_>, out: &mut Converged<'_>) {
        self.plain = self.complete && affine.support.is_none();
        if self.plain {
            return;
        }
        match affine.support {
            Some([d, v]) => {
                out.d.copy_from_slice(d);
                out.v.copy_from_slice(v);
            }
            None => {
                out.d.fill(0.0);
                out.v.fill(0.0);
            }
        }
        for ((flat, d), v) in self.links.active.iter().zip(&self.d).zip(&self.v) {
            out.d[*flat] += d;
            out.v[*flat] += v;
        }
    }

    /// Laws and residual at the present deformations.
    fn evaluate(&mut self, affine: &Affine<'_>, from: &Committed<'_>, out: &mut Converged<'_>) {
        self.deform(affine, out);
        let [d, v] = choose(self.plain, [&self.d, &self.v], [out.d, out.v]);
        let at = Kinematics { d, v, d0: from.d, v0: from.v, dt: from.dt };
        if self.iteration == 0 {
            self.laws.start(at, from.history);
        }
        self.laws.respond(at, from.history, out.history, out.f, out.tangents, out.energy);
        self.sizes = self.leave(out.f, out.pseudo);
    }

    /// The residual of forces, flat, against pseudo-forces at the present deformations, and the largest of all
    /// three.
    fn leave(&mut self, f: &[f64], pseudo: &[f64]) -> [f64; 3] {
        let Self { dummy_k, d, residual: r, correction: own, .. } = self;
        if self.complete {
            return residual(f, dummy_k, d, pseudo, r);
        }
        own.clear();
        own.extend(self.links.active.iter().map(|flat| f[*flat]));
        let [left, _, pseudo] = residual(own, dummy_k, d, pseudo, r);
        [left, largest(f), pseudo]
    }

    /// From the residual to the Newton correction of f̃.
    fn newton_correction(&mut self, affine: &Affine<'_>, tangents: &Tangents, slow: bool) {
        let chord = self.links.active.len() >= CHORD_FROM && !slow;
        let mut factors = std::mem::take(&mut self.factors);
        let of = self.equations(affine.g, affine.h, affine.key);
        let factor = factors.take(of, tangents, |kept| chord || kept.tangents == *tangents);
        self.followed = factor.correct(&mut self.residual, &mut self.correction);
        self.factors = factors;
    }

    fn equations<'e>(&'e self, g: &'e Dense, h: &'e Dense, key: StepKey) -> Equations<'e> {
        let Self { links, place, dummy_k, rated, .. } = self;
        Equations { links, place, dummy_k, rated, g, h, key }
    }
}

/// Deformations and rates of all coordinates: the own ones where those are `plain`.
fn choose<'a>(plain: bool, own: [&'a [f64]; 2], all: [&'a [f64]; 2]) -> [&'a [f64]; 2] {
    if plain { own } else { all }
}

/// The last change of f̃: at the front of what a factor gave where deformations follow it already, else in place of the
/// residual.
fn step<'a>(followed: bool, correction: &'a [f64], residual: &'a [f64]) -> &'a [f64] {
    if followed { &correction[..residual.len()] } else { residual }
}
