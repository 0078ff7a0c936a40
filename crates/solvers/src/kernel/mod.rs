//! The link kernel: forces of all links at the end of a step.
//!
//! Newton's method on the link equations, its predictor, kept factors, line search, and the measure of equilibrium.
//! May use `structure`, for the modes by which it tells steps from each other; it knows no structure but compliances G and H.
//!
//! Every linear step is affine in the pseudo-forces f̃ = f − k_e d at its end:
//!
//! ```text
//! d = d* − G f̃        ḋ = v* − H f̃        f = law(d, ḋ)
//! ```
//!
//! `Newton` solves `R(f̃) = law(d, ḋ) − k_e d − f̃ = 0` with the full tangents of the laws,
//! `J = I + (k − k_e) G + c H`; coordinates whose row of tangents is zero or weak need no equation. It starts
//! from a predictor: the tangents at the start of the step, and the residual that such predictions left in the steps
//! before, extrapolated.
//! `FixedPoint` is Wilson's constant-stiffness iteration, f̃ ← law − k_e d; it converges only
//! while |k − k_e| G < 1. Neither touches a matrix of the structure.

mod affine;
mod compliance;
mod extrapolation;
mod factors;
mod jacobian;
mod law_response;
mod layout;
mod measure;
mod modal_jacobian;
mod predictor;
mod search;

pub(crate) use affine::{Affine, Committed, Converged, Guess, StepKey, Wanted};
pub(crate) use compliance::{Compliance, ComplianceMatrix, ModalCompliance};
pub(crate) use extrapolation::Extrapolation;
pub(crate) use factors::Remembered;
pub(crate) use jacobian::Jacobian;
pub(crate) use law_response::LawResponse;

use crate::vector::{add, largest, sized_residual};
use factors::{Equations, Factor, Factors};
pub(crate) use layout::Layout;
use layout::Unknowns;
pub(crate) use measure::DIGIT;
pub(crate) use search::{CROSSES, ENOUGH, SEARCH_FROM, Search, TRIED};
use trilith_element::Kinematics;
use trilith_model::{Kernel, Model, Solution};
use trilith_system::{LinkBlocks, LinkSet, StepLaws, Tangents};

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
pub(crate) const ROUNDING: f64 = 1e3;
/// A correction below this share of the tolerance changes nothing any more.
pub(crate) const SETTLED: f64 = 1e-4;
/// Iterations before the first comparison with what rounding leaves.
pub(crate) const ROUNDING_FROM: usize = 2;
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
    laws: StepLaws<'a>,
    layout: Layout<'a>,
    unknowns: Unknowns,
    /// Blocks of all links but dashpots, and of those whose laws depend on rates.
    blocks: LinkBlocks,
    rate_blocks: LinkBlocks,
    /// Forces that follow from deformations and rates along the tangents, flat.
    pull: Vec<f64>,
    /// True where all coordinates are active and no support moves: the own deformations and rates are those of all
    /// coordinates.
    plain: bool,
    residual: Vec<f64>,
    /// Largest residual, force and pseudo-force.
    sizes: [f64; 3],
    /// What a factor gives.
    correction: Vec<f64>,
    /// True where the predictor of this step holds the extrapolated residual of the steps before.
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
        effective_k: Vec<f64>,
    ) -> Self {
        let laws = links.laws(model);
        let stiff = laws.iter().filter(|(law, _)| law.damping_constant().is_none());
        let blocks = LinkBlocks::of(stiff.map(|(_, link)| link));
        let rate_dependent = laws.iter().filter(|(law, _)| law.uses_rates());
        let rate_blocks = LinkBlocks::of(rate_dependent.map(|(_, link)| link));
        let layout = Layout::new(links, &laws, effective_k);
        let n = links.active.len();
        Self {
            kind: solution.kernel,
            tolerance: solution.link_tolerance,
            unknowns: Unknowns::new(n, layout.rate_dependent.len()),
            layout,
            blocks,
            rate_blocks,
            pull: Vec::new(),
            laws: StepLaws::new(laws),
            plain: false,
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
        let [d, v, _] = self.unknowns.parts();
        Wanted { d, v, rate_dependent: &self.layout.rate_dependent }
    }

    /// Which coordinates there are.
    pub(crate) fn layout(&self) -> &Layout<'a> {
        &self.layout
    }

    /// The kept factors, to be recalled after a restart: a kept factor decides the last bits of an
    /// iteration.
    pub(crate) fn memory(&self) -> Vec<Remembered> {
        self.factors.memory()
    }

    /// Makes a factor again, with the compliances of its step size.
    pub(crate) fn recall(&mut self, memory: Remembered, compliance: &Compliance) {
        let Compliance { g, h, .. } = compliance;
        let Remembered { key, k, c } = memory;
        let of = Equations { layout: &self.layout, g, h, key: &key };
        self.factors.make(of, Tangents { k, c });
    }

    /// Pseudo-force of forces that act at a deformation; `support` is what moving supports have in it.
    pub(crate) fn pseudo(&self, f: &[f64], d: &[f64], support: &[f64], to: &mut [f64]) {
        let Layout { links, effective_k, .. } = &self.layout;
        for (a, flat) in links.active.iter().enumerate() {
            to[a] = f[*flat] - effective_k[a] * (d[*flat] - support[*flat]);
        }
    }

    /// Solves the link equations of a step at what was [wanted](Self::wanted), predicted with these pseudo-forces:
    /// f̃ = law(d* − G f̃, v* − H f̃) − k_e d. The rates of coordinates whose law does not depend on them are left to the
    /// caller.
    ///
    /// Motions in lock step, whose products with G are made together, make the same calls one by one:
    /// [`begin`](Self::begin), [`predict`](Self::predict), then [`advance`](Self::advance) until it is true, with what
    /// [`change`](Self::change) says in between.
    #[inline]
    pub(crate) fn solve(
        &mut self,
        affine: &Affine<'_>,
        pseudo: &[f64],
        guess: Guess,
        from: &Committed<'_>,
        scale: &ForceScale,
        out: &mut Converged<'_>,
    ) -> Result<(), NoEquilibrium> {
        self.begin(pseudo, from);
        if guess == Guess::Tangents && self.predict(affine, from, out) {
            self.follow(affine);
        }
        while !self.advance(affine, from, scale, out)? {
            self.follow(affine);
        }
        Ok(())
    }

    /// Takes up the link equations of a step at what was [wanted](Self::wanted), from these pseudo-forces, at which that
    /// was predicted.
    #[inline]
    pub(crate) fn begin(&mut self, pseudo: &[f64], from: &Committed<'_>) {
        self.search.reset();
        self.unknowns.parts()[2].copy_from_slice(pseudo);
        (self.iteration, self.size_before, self.expected) = (0, f64::INFINITY, false);
        let Committed { d, v, .. } = *from;
        self.laws.start(&Kinematics::new([d, v], [d, v], from.dt), from.history);
    }

    /// Lets deformations and rates follow the last change of f̃.
    #[inline]
    fn follow(&mut self, affine: &Affine<'_>) {
        if let Some((change, d)) = self.change(affine.h) {
            affine.g.mul_add(-1.0, change, d);
        }
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
        // r = law(d, ḋ) − k_e d − f̃, and what of it the next predictors may expect.
        self.iterations += 1;
        self.evaluate(affine, from, out);
        if self.iteration == 0 && self.kind == Kernel::Newton {
            out.extrapolation.note(from.extrapolation, affine.key, &self.residual, self.expected);
        }
        // Converged: |r| ≤ tolerance · largest force.
        let (size, worst) = self.measure(out, scale);
        if size <= 1.0 {
            self.end(from, out);
            return Ok(true);
        }
        self.iteration += 1;
        let limit = match self.kind {
            Kernel::Newton => NEWTON_ITERATIONS,
            Kernel::FixedPoint => FIXED_POINT_ITERATIONS,
        };
        if !size.is_finite() || self.iteration == limit {
            self.factors.forget(affine.key);
            return Err(worst);
        }
        self.followed = false;
        // Wilson's iteration: f̃ ← f̃ + r = law − k_e d.
        if self.kind == Kernel::FixedPoint {
            self.take();
            return Ok(false);
        }
        // Line search: another part of the last correction, where it has brought no less residual.
        let before = self.sizes[0];
        let moves = |step: &[f64], way: &mut Vec<f64>| {
            way.clear();
            way.resize(step.len(), 0.0);
            affine.g.mul_add(1.0, step, way);
        };
        let Self { search, residual, iteration, .. } = self;
        if let Some(more) = search.goes_on(*iteration - 1, residual, before, moves) {
            for (x, step) in self.residual.iter_mut().zip(&self.search.step) {
                *x = more * step;
            }
            self.take();
            return Ok(false);
        }
        // Newton: J Δf̃ = r, with a new factor of J where the kept one contracts badly.
        let slow = size > CONTRACTS * self.size_before;
        self.size_before = size;
        if self.iteration == 1 {
            // The tangents of the first evaluation serve a new factor alone.
            if slow || !self.keeps(affine.key) {
                self.laws.tangents(out.laws.tangents);
            }
            // The first correction is made in full.
            let goes = self.go(affine, out.laws.tangents, slow);
            return if goes { Ok(false) } else { Err(self.farthest()) };
        }
        self.search.before(&self.residual);
        if !self.correct(affine, out.laws.tangents, slow) {
            self.factors.forget(affine.key);
            return Err(self.farthest());
        }
        let Self { followed, unknowns, correction, residual, search, .. } = self;
        let step = if *followed { unknowns.pseudo_of(correction) } else { residual };
        // Converged as well: what is left is rounding of a steep law, and the correction changes nothing.
        if size <= ROUNDING && size * largest(step) <= SETTLED * before {
            self.end(from, out);
            return Ok(true);
        }
        search.goes(step);
        self.take();
        Ok(false)
    }

    /// The laws end the step where they were evaluated last.
    #[inline]
    fn end(&mut self, from: &Committed<'_>, out: &mut Converged<'_>) {
        if self.plain {
            out.d.copy_from_slice(self.unknowns.d());
        }
        out.pseudo.copy_from_slice(self.unknowns.pseudo());
        let at = Kinematics::new([out.d, out.v], [from.d, from.v], from.dt);
        self.laws.end(&at, &mut out.laws);
    }

    /// Where the laws were asked last, for who looks for the one that is to blame.
    pub(crate) fn show(&self, out: &mut Converged<'_>) {
        if self.plain {
            out.d.copy_from_slice(self.unknowns.d());
        }
    }

    /// f̃ takes the step, and what follows it already.
    fn take(&mut self) {
        if self.followed {
            self.unknowns.add(&self.correction);
        } else {
            add(self.unknowns.parts()[2], &self.residual);
        }
    }

    /// The last change of f̃, and the deformations of the active coordinates, which must follow it by Δd = −G Δf̃; none where
    /// they have done so already. The rates of rate-dependent laws have followed: Δḋ = −H Δf̃.
    #[inline]
    pub(crate) fn change(&mut self, h: &ComplianceMatrix) -> Option<(&[f64], &mut [f64])> {
        if self.followed {
            return None;
        }
        let Self { unknowns, residual, layout, .. } = self;
        let [d, v, _] = unknowns.parts();
        h.less_some(residual, &layout.rate_dependent, v);
        Some((residual, d))
    }

    /// Deformations and rates of all coordinates: those of the active ones and, where supports move, what these add.
    #[inline(always)]
    fn deform(&mut self, affine: &Affine<'_>, out: &mut Converged<'_>) {
        self.plain = self.layout.complete && affine.support.is_none();
        if !self.plain {
            return self.deform_all(affine, out);
        }
        for (a, v) in self.layout.rate_dependent.iter().zip(self.unknowns.v()) {
            out.v[*a] = *v;
        }
    }

    /// Those of the active coordinates, and what supports do.
    fn deform_all(&mut self, affine: &Affine<'_>, out: &mut Converged<'_>) {
        let links = self.layout.links;
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
        for (flat, d) in links.active.iter().zip(self.unknowns.d()) {
            out.d[*flat] += d;
        }
        for (a, v) in self.layout.rate_dependent.iter().zip(self.unknowns.v()) {
            out.v[links.active[*a]] += v;
        }
    }

    /// Laws and residual r = law(d, ḋ) − k_e d − f̃ at the present deformations.
    fn evaluate(&mut self, affine: &Affine<'_>, from: &Committed<'_>, out: &mut Converged<'_>) {
        self.deform(affine, out);
        let (d, v) = (choose(self.plain, &self.unknowns, out.d), &*out.v);
        let at = Kinematics::new([d, v], [from.d, from.v], from.dt);
        let last = self.iteration > 0;
        self.laws.respond(&at, last, from.history, &mut out.laws);
        let Self { layout, unknowns, residual: r, correction, sizes, .. } = self;
        let of_active = active(layout, out.laws.f, correction);
        sized_residual(of_active, &layout.effective_k, unknowns.d(), unknowns.pseudo(), r, sizes);
        if !layout.complete {
            sizes[1] = largest(out.laws.f);
        }
    }

    /// True where a factor is kept while it contracts.
    fn is_large(&self) -> bool {
        self.layout.links.active.len() >= CHORD_FROM
    }

    /// True where the factor of a rule is there and serves whatever the tangents are.
    fn keeps(&self, key: &StepKey) -> bool {
        self.is_large() && self.factors.have(key)
    }

    /// The factor for a step from the start or from the last iteration; `slow`: that the last one brought little.
    fn factor(&mut self, affine: &Affine<'_>, tangents: &Tangents, slow: bool) -> Parts<'_> {
        let chord = self.is_large() && !slow;
        let Self { layout, factors, residual, correction, unknowns, .. } = self;
        let Affine { g, h, key, .. } = affine;
        let of = Equations { layout, g, h, key };
        let factor = factors.take(of, tangents, |kept| chord || kept.tangents == *tangents);
        Parts { factor, residual, correction, unknowns }
    }

    /// From the residual to the Newton correction of f̃: Δf̃ = J⁻¹ r; false where the equations are singular.
    fn correct(&mut self, affine: &Affine<'_>, tangents: &Tangents, slow: bool) -> bool {
        let Parts { factor, residual, correction, .. } = self.factor(affine, tangents, slow);
        if !factor.is_sound() {
            return false;
        }
        self.followed = factor.correct(residual, correction);
        true
    }

    /// The same, and f̃ takes it at once; false where the equations are singular.
    #[inline]
    fn go(&mut self, affine: &Affine<'_>, tangents: &Tangents, slow: bool) -> bool {
        let Parts { factor, residual, correction, unknowns } = self.factor(affine, tangents, slow);
        if !factor.is_sound() {
            self.factors.forget(affine.key);
            return false;
        }
        self.followed = factor.go(residual, correction, unknowns);
        true
    }
}

/// What a correction needs of a kernel.
struct Parts<'a> {
    factor: &'a Factor,
    residual: &'a mut Vec<f64>,
    correction: &'a mut Vec<f64>,
    unknowns: &'a mut Unknowns,
}

/// Deformations of all coordinates: the own ones where those are `plain`.
fn choose<'a>(plain: bool, own: &'a Unknowns, all: &'a [f64]) -> &'a [f64] {
    if plain { own.d() } else { all }
}

/// Forces of the active coordinates out of flat ones, in `space` unless those are all.
fn active<'a>(layout: &Layout<'_>, f: &'a [f64], space: &'a mut Vec<f64>) -> &'a [f64] {
    if layout.complete {
        return f;
    }
    space.clear();
    space.extend(layout.links.active.iter().map(|flat| f[*flat]));
    space
}
