//! Coefficients of a step size for all lanes.

use super::plan::Plan;
use super::setup::LaneSetup;
use super::small::Aligned;
use crate::single_mode::{self, Mode};
use trilith_element::lanes::{Arithmetic, Real};

/// Coefficients of a step size.
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
    /// Of the usual step, or of a length for each analysis.
    pub fn new<A: Arithmetic<Real = R>, const N: usize>(
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
        lengths: Option<&[f64]>,
    ) -> Self {
        let zero = with.splat(0.0);
        let grid = setups[0].shape.grid;
        let part = grid.dt / grid.substeps as f64;
        let rules: Vec<Vec<Mode>> = setups
            .iter()
            .enumerate()
            .map(|(i, s)| match lengths {
                None => s.rule.clone(),
                Some(t) => s
                    .omega2
                    .iter()
                    .zip(&s.damping)
                    .map(|(w, c)| single_mode::exact(*w, *c, t[i]))
                    .collect(),
            })
            .collect();
        let last = setups.len() - 1;
        let mut c = [[[zero; M]; 4]; 3];
        for (row, c) in c.iter_mut().enumerate() {
            for (column, c) in c.iter_mut().enumerate() {
                for (j, c) in c.iter_mut().enumerate().take(setups[0].shape.modes) {
                    *c = with.gather(|i| rules[i.min(last)][j][row][column]);
                }
            }
        }
        let compliance = |row: usize| -> [[R; L]; L] {
            let mut g = [[zero; L]; L];
            for a in 0..L {
                for b in 0..L {
                    for j in 0..M {
                        g[b][a] = g[b][a] - plan.b[a][j] * c[row][3][j] * plan.b[b][j];
                    }
                }
            }
            g
        };
        let dt = match lengths {
            None => with.splat(part),
            Some(t) => with.gather(|i| t[i.min(last)]),
        };
        let (per_dt, third) = (with.splat(1.0) / dt, dt * with.splat(1.0 / 3.0));
        let [g, h] = [1, 2].map(|row| Aligned(compliance(row)));
        Self { dt, per_dt, third, c: Aligned(c), g, h }
    }
}
