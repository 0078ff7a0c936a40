//! Coefficients of a step size for all lanes.

use super::plan::Plan;
use super::setup::LaneSetup;
use super::small::Aligned;
use crate::modal::Mode;
use trilith_element::lanes::{Arithmetic, Real};

/// Coefficients of a step size.
#[derive(Clone, Copy)]
pub(super) struct Rule<R, const M: usize, const L: usize> {
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

impl<R: Real, const M: usize, const L: usize> Rule<R, M, L> {
    /// Of a step size of each analysis, and what its modes make of it.
    #[inline(never)]
    pub fn new<A: Arithmetic<Real = R>, const N: usize>(
        with: A,
        plan: &Plan<R, M, L, N>,
        sizes: &[(f64, &[Mode])],
    ) -> Self {
        let last = sizes.len() - 1;
        let mut rule = Self::nothing(with.splat(0.0));
        for (row, c) in rule.c.iter_mut().enumerate() {
            for (column, c) in c.iter_mut().enumerate() {
                for (j, c) in c.iter_mut().enumerate().take(sizes[0].1.len()) {
                    *c = with.gather(|i| sizes[i.min(last)].1[j][row][column]);
                }
            }
        }
        rule.of_length(plan, with.gather(|i| sizes[i.min(last)].0));
        rule
    }

    /// Of no step yet.
    pub fn nothing(zero: R) -> Self {
        let none = Aligned([[zero; L]; L]);
        let c = Aligned([[[zero; M]; 4]; 3]);
        Self { dt: zero, per_dt: zero, third: zero, c, g: none, h: none }
    }

    /// What follows from a length, and the coefficients that belong to it.
    #[inline(always)]
    pub fn of_length<const N: usize>(&mut self, plan: &Plan<R, M, L, N>, dt: R) {
        (self.dt, self.per_dt, self.third) = (dt, dt.of(1.0) / dt, dt * dt.of(1.0 / 3.0));
        compliance(plan, &self.c, (1, true), &mut self.g);
        compliance(plan, &self.c, (2, plan.rate), &mut self.h);
    }

    /// Of the usual step.
    pub fn usual<A: Arithmetic<Real = R>, const N: usize>(
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
    ) -> Self {
        let sizes: Vec<(f64, &[Mode])> =
            setups.iter().map(|s| (s.shape.grid.step(), &s.rule[..])).collect();
        Self::new(with, plan, &sizes)
    }

    /// Of a length for each analysis.
    pub fn of_lengths<A: Arithmetic<Real = R>, const N: usize>(
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
        lengths: impl Fn(usize) -> f64,
    ) -> Self {
        let modes: Vec<Vec<Mode>> =
            setups.iter().enumerate().map(|(i, s)| s.modes_of(lengths(i))).collect();
        let sizes: Vec<(f64, &[Mode])> =
            modes.iter().enumerate().map(|(i, modes)| (lengths(i), &modes[..])).collect();
        Self::new(with, plan, &sizes)
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
