//! Which rule an analysis takes for a step of adaptive length: the exact one, or average acceleration for the modes
//! that hang on links too stiff for it, as the ordinary engine does (see [`modal`](crate::modal)).
//!
//! ```text
//! average acceleration of a mode, with D = 1 + c h/2 + ω² h²/4:
//! A = a₀ + a₁ = (s₀ + s₁ − (2 c + ω² h) q̇₀ − 2 ω² q₀)/D
//! q₁ = q₀ + h q̇₀ + h²/4 A      q̇₁ = q̇₀ + h/2 A      ∫q = h/2 (q₀ + q₁)
//! ```

use super::adaptive::MOST;
use super::coefficients::{Numbers, Rule};
use super::plan::Plan;
use super::sizes::Size;
use super::state::State;
use crate::fna::{FREE, LONGEST};
use crate::modal::Mode;
use std::ops::Range;
use trilith_element::lanes::{Arithmetic, Real};

/// The rules of a step of one length for each analysis.
pub(super) struct Rules<R: Real, const M: usize, const L: usize> {
    numbers: Numbers<M>,
    /// Largest eigenvalue of G k where all links are engaged: where that is small, nobody asks how stiff they are.
    ratios: [f64; MOST],
    exact: Rule<R, M, L>,
    ratio: R,
    is_stiff: bool,
    /// With average acceleration of some modes, and of which, once somebody needed it.
    mixed: Option<(Rule<R, M, L>, [R::Mask; M])>,
}

impl<R: Real, const M: usize, const L: usize> Rules<R, M, L> {
    /// Of no length yet.
    pub fn new(zero: R) -> Self {
        Self {
            numbers: Numbers::new(),
            ratios: [0.0; MOST],
            exact: Rule::nothing(zero),
            ratio: zero,
            is_stiff: false,
            mixed: None,
        }
    }

    /// Gives lanes another size.
    pub fn set(&mut self, lanes: Range<usize>, size: &Size) {
        self.ratios[lanes.clone()].iter_mut().for_each(|ratio| *ratio = size.ratio);
        self.numbers.set(lanes, size.length, &size.modes);
    }

    /// Makes the rule of the sizes as they are now.
    #[inline(always)]
    pub fn renew<A: Arithmetic<Real = R>, const N: usize>(
        &mut self,
        with: A,
        plan: &Plan<R, M, L, N>,
    ) {
        let Self { numbers, ratios, exact, ratio, is_stiff, mixed } = self;
        exact.renew(with, plan, numbers);
        *ratio = with.load(ratios);
        *is_stiff = with.splat(0.0).any(with.splat(LONGEST).lt(*ratio));
        *mixed = None;
    }

    /// The exact rule: any tells the length.
    pub fn exact(&self) -> &Rule<R, M, L> {
        &self.exact
    }

    /// The rule of a step from a state.
    #[inline(always)]
    pub fn choose<const N: usize>(
        &mut self,
        plan: &Plan<R, M, L, N>,
        from: &State<R, M, L, N>,
    ) -> &Rule<R, M, L> {
        let Self { exact, ratio, is_stiff, mixed, .. } = self;
        if !*is_stiff {
            return exact;
        }
        let longest = ratio.of(LONGEST);
        let average = longest.lt(*ratio) & longest.lt(bound(plan, exact, from));
        if !ratio.any(average) {
            return exact;
        }
        let held = held(plan, exact.dt, average, from);
        let mut stands = mixed.is_some();
        if let Some((_, of)) = mixed {
            for j in 0..plan.modes() {
                stands &= !ratio.any((held[j] & !of[j]) | (!held[j] & of[j]));
            }
        }
        if !stands {
            let (rule, of) = mixed.get_or_insert((*exact, held));
            *of = held;
            rule.average(exact, plan, &held);
        }
        mixed.as_ref().map_or(exact, |(rule, _)| rule)
    }
}

/// Spectral radius of G k: the exact rule is stable below 2.
pub(super) fn stiffness_ratio(rows: &[Vec<f64>], modes: &[Mode], engaged: &[f64]) -> f64 {
    let mut x = vec![1.0; rows.len()];
    let mut ratio = 0.0;
    for _ in 0..50 {
        let mut s = vec![0.0; modes.len()];
        for (row, (x, k)) in rows.iter().zip(x.iter().zip(engaged)) {
            for (s, b) in s.iter_mut().zip(row) {
                *s += b * x * k;
            }
        }
        for (s, c) in s.iter_mut().zip(modes) {
            *s *= c[1][3];
        }
        let y: Vec<f64> =
            rows.iter().map(|row| row.iter().zip(&s).map(|(b, s)| b * s).sum()).collect();
        let size = y.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        if size == 0.0 || !size.is_finite() {
            return size;
        }
        let settled = (size - ratio).abs() <= 1e-3 * size;
        ratio = size;
        x = y.into_iter().map(|v| v / size).collect();
        if settled {
            break;
        }
    }
    ratio
}

/// A bound of the largest eigenvalue of G k as the links are: the row sums of √k G √k.
#[inline(always)]
fn bound<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    rule: &Rule<R, M, L>,
    from: &State<R, M, L, N>,
) -> R {
    let zero = rule.dt.of(0.0);
    let mut root = [zero; L];
    for a in 0..plan.coordinates() {
        root[a] = from.k.own(plan.block(), a).max(zero).sqrt();
    }
    let mut most = zero;
    for b in 0..plan.coordinates() {
        let mut sum = zero;
        for a in 0..plan.coordinates() {
            sum = rule.g[b][a].abs().mul_add(root[a], sum);
        }
        most = most.max(sum * root[b]);
    }
    most
}

/// The modes that hang on links which are or have been stiff, of the analyses in a mask: one that slips now may stick
/// within the step.
#[inline(always)]
fn held<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    dt: R,
    who: R::Mask,
    from: &State<R, M, L, N>,
) -> [R::Mask; M] {
    let (zero, per) = (dt.of(0.0), dt * dt * dt.of(1.0 / 6.0));
    let mut held = [who; M];
    for j in 0..plan.modes() {
        let mut k = zero;
        for a in 0..plan.coordinates() {
            k = (from.stiffest[a] * plan.b[a][j]).mul_add(plan.b[a][j], k);
        }
        held[j] = who & dt.of(FREE).lt(k * per);
    }
    held
}

impl<R: Real, const M: usize, const L: usize> Rule<R, M, L> {
    /// Makes it that of another, with average acceleration of these modes.
    #[inline(always)]
    fn average<const N: usize>(
        &mut self,
        exact: &Self,
        plan: &Plan<R, M, L, N>,
        modes: &[R::Mask; M],
    ) {
        let h = exact.dt;
        let (zero, one) = (h.of(0.0), h.of(1.0));
        let (half, quarter) = (h.of(0.5) * h, h.of(0.25) * h * h);
        for j in 0..plan.modes() {
            let (w, rate) = (plan.omega2[j], plan.damping[j]);
            let per = one / quarter.mul_add(w, half.mul_add(rate, one));
            // A and its shares of q₀, q̇₀, s₀, s₁.
            let sum = [h.of(-2.0) * w * per, -(h.mul_add(w, rate + rate) * per), per, per];
            let (of_q, of_p) = ([one, h, zero, zero], [zero, one, zero, zero]);
            for i in 0..4 {
                let q = quarter.mul_add(sum[i], of_q[i]);
                let p = half.mul_add(sum[i], of_p[i]);
                let both = if i == 0 { one + q } else { q };
                let values = [half * both, q, p];
                for row in 0..3 {
                    self.c[row][i][j] = R::select(modes[j], values[row], exact.c[row][i][j]);
                }
            }
        }
        self.of_length(plan, h);
    }
}
