//! Coefficients of a step size for all lanes.

use super::adaptive::MOST;
use super::plan::Plan;
use super::setup::LaneSetup;
use super::small::Aligned;
use crate::modal::Mode;
use std::ops::Range;
use trilith_element::lanes::{Arithmetic, Real, Task};

/// Coefficients of a step size.
#[derive(Clone, Copy)]
pub(super) struct Rule<R: Real, const M: usize, const L: usize> {
    pub dt: R,
    pub per_dt: R,
    /// A third of the step.
    pub third: R,
    /// What ∫q, q and q̇ at the end take from q, q̇ and the loads at the start and at the end: of all modes side by side.
    pub c: Aligned<[[[R; M]; 4]; 3]>,
    /// −G and −H, column by column.
    pub g: Aligned<[[R; L]; L]>,
    pub h: Aligned<[[R; L]; L]>,
}

/// Coefficients of a step for each lane, number by number.
pub(super) struct Numbers<const M: usize> {
    /// As in [`Rule::c`], lane by lane.
    c: Box<[[[[f64; MOST]; M]; 4]; 3]>,
    lengths: [f64; MOST],
}

impl<const M: usize> Numbers<M> {
    /// Of no length yet.
    pub fn new() -> Self {
        Self { c: Box::new([[[[0.0; MOST]; M]; 4]; 3]), lengths: [0.0; MOST] }
    }

    /// Gives lanes a step of another length, and what the modes make of it.
    pub fn set(&mut self, lanes: Range<usize>, length: f64, modes: &[Mode]) {
        // As a rule it is one lane: numbers are put there one by one, without a call to fill a slice.
        for lane in lanes {
            self.lengths[lane] = length;
            for (j, mode) in modes.iter().enumerate().take(M) {
                for row in 0..3 {
                    for input in 0..4 {
                        self.c[row][input][j][lane] = mode[row][input];
                    }
                }
            }
        }
    }
}

impl<R: Real, const M: usize, const L: usize> Rule<R, M, L> {
    /// Of no step yet.
    pub fn nothing(zero: R) -> Self {
        let none = Aligned::full_of(zero);
        let c = Aligned([Aligned::full_of(zero).0; 3]);
        Self { dt: zero, per_dt: zero, third: zero, c, g: none, h: none }
    }

    /// Of the usual step.
    pub fn usual<A: Arithmetic<Real = R>, const N: usize>(
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
    ) -> Self {
        let all = setups.iter().map(|s| (s.shape.grid.step(), s.rule.clone()));
        Self::of_sizes(with, plan, &all.collect::<Vec<_>>())
    }

    /// Of a length for each analysis.
    pub fn of_lengths<A: Arithmetic<Real = R>, const N: usize>(
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
        lengths: &dyn Fn(usize) -> f64,
    ) -> Self {
        let all = setups.iter().enumerate();
        let all = all.map(|(i, s)| (lengths(i), s.modes_of(lengths(i))));
        Self::of_sizes(with, plan, &all.collect::<Vec<_>>())
    }

    /// Of a length for each analysis, and what its modes make of it; lanes without an analysis repeat the last.
    fn of_sizes<A: Arithmetic<Real = R>, const N: usize>(
        with: A,
        plan: &Plan<R, M, L, N>,
        sizes: &[(f64, Vec<Mode>)],
    ) -> Self {
        let mut numbers = Numbers::new();
        for (i, (length, modes)) in sizes.iter().enumerate() {
            let until = if i + 1 == sizes.len() { A::WIDTH } else { i + 1 };
            numbers.set(i..until, *length, modes);
        }
        let mut rule = Self::nothing(with.splat(0.0));
        rule.renew(with, plan, &numbers);
        rule
    }

    /// Makes it that of these numbers.
    #[inline(never)]
    pub fn renew<A: Arithmetic<Real = R>, const N: usize>(
        &mut self,
        with: A,
        plan: &Plan<R, M, L, N>,
        numbers: &Numbers<M>,
    ) {
        with.run(Renew { rule: self, plan, numbers });
    }

    /// What follows from a length, and the coefficients that belong to it.
    #[inline(always)]
    pub fn of_length<const N: usize>(&mut self, plan: &Plan<R, M, L, N>, dt: R) {
        (self.dt, self.per_dt, self.third) = (dt, dt.of(1.0) / dt, dt * dt.of(1.0 / 3.0));
        compliance(plan, &self.c, (1, true), &mut self.g);
        compliance(plan, &self.c, (2, plan.rate), &mut self.h);
    }
}

/// What [`Rule::renew`] does, as a task.
struct Renew<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    rule: &'a mut Rule<R, M, L>,
    plan: &'a Plan<R, M, L, N>,
    numbers: &'a Numbers<M>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Renew<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { rule, plan, numbers } = self;
        for row in 0..3 {
            for input in 0..4 {
                for j in 0..plan.modes() {
                    rule.c[row][input][j] = with.load(&numbers.c[row][input][j]);
                }
            }
        }
        rule.of_length(plan, with.load(&numbers.lengths));
    }
}

/// What coordinates do under forces at others, by a row of the coefficients: minus that, which is symmetric; of all, or
/// each under its own alone.
#[inline(always)]
fn compliance<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    c: &[[[R; M]; 4]; 3],
    (row, of_all): (usize, bool),
    g: &mut [[R; L]; L],
) {
    let zero = plan.b[0][0].of(0.0);
    let (l, m) = (plan.coordinates(), plan.modes());
    let mut load = [zero; M];
    for a in 0..l {
        for j in 0..m {
            load[j] = -(plan.b[a][j] * c[row][3][j]);
        }
        g[a][a] = product(m, &load, &plan.b[a]);
        if of_all {
            for b in a + 1..l {
                g[a][b] = product(m, &load, &plan.b[b]);
                g[b][a] = g[a][b];
            }
        }
    }
}

#[inline(always)]
fn product<R: Real, const M: usize>(n: usize, x: &[R; M], y: &[R; M]) -> R {
    let mut sum = x[0] * y[0];
    for j in 1..n {
        sum = x[j].mul_add(y[j], sum);
    }
    sum
}
