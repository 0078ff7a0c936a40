//! The recurrence of modal equations over a step of a length.
//!
//! ```text
//! (∫q, q, q̇)₁ = R (q₀, q̇₀, s₀, s₁)        s linear in the step, or average acceleration of some modes
//! ```
//!
//! Shapes of massless directions follow the loads, c q̇ + κ q = s: exactly where the structure damps
//! them, at the mean rate of the step where it does not. Those that dashpots tie to the modes are unknowns of first
//! order of one system with them:
//!
//! ```text
//! q̈ = s_q − Ω² q − D q̇ − Eᵀ ẏ        G ẏ = s_y − κ y − E q̇
//! ```

use super::coupled::{Blocks, Coupled};
use super::single_mode;
use crate::structure::{JUMPED, ModeSet};
use trilith_linalg::{Dense, OwnModes, add_products, combine, dot, weighted_square};

/// The linear structure on a basis: modes first, static shapes (without mass) behind them.
#[derive(Clone)]
pub(crate) struct Structure {
    /// Number of modes.
    pub modes: usize,
    /// Number of static shapes, the first ones, that dashpots tie to the modes.
    pub tied: usize,
    /// The static shapes whose rate is the mean one of a step.
    pub undamped: Vec<usize>,
    /// ω², and the stiffness of the static shapes.
    pub omega2: Vec<f64>,
    /// Diagonal of the damping.
    pub rates: Vec<f64>,
    /// 1 of the modes, 0 of the static shapes.
    pub mass: Vec<f64>,
    /// All of it, where it couples the modes.
    pub damping: Option<Dense>,
}

impl Structure {
    /// a = s − D q̇ − Ω² q of the modes; static shapes have none.
    pub(crate) fn acceleration(&self, s: &[f64], q: &[f64], v: &[f64], a: &mut [f64]) {
        a.copy_from_slice(s);
        match &self.damping {
            Some(damping) => damping.mul_add(-1.0, v, a),
            None => add_products(-1.0, &self.rates, v, a),
        }
        add_products(-1.0, &self.omega2, q, a);
        a[self.modes..].fill(0.0);
    }

    /// Accelerations of the modes that a force on the structure at rest causes: a dashpot on a massless direction
    /// takes its share at once.
    pub(crate) fn free_acceleration(&self, force: &[f64]) -> Vec<f64> {
        let mut a = force.to_vec();
        if let Some(damping) = self.damping.as_ref().filter(|_| self.tied > 0) {
            for y in self.modes..self.modes + self.tied {
                let rate = force[y] / damping[(y, y)];
                a.iter_mut().zip(damping.column(y)).for_each(|(a, e)| *a -= e * rate);
            }
        }
        // What has no mass may jump with its load: how it moved before says nothing of how it goes on.
        a[self.modes..].fill(JUMPED);
        a
    }

    /// ½ q̇ᵀ q̇ of the modes and ½ qᵀ Ω² q of all.
    pub(crate) fn energy(&self, x: &[f64]) -> (f64, f64) {
        let m = self.omega2.len();
        let (q, v) = (&x[..m], &x[m..m + self.modes]);
        (0.5 * dot(v, v), 0.5 * weighted_square(&self.omega2, q))
    }

    /// True where something damps.
    pub(crate) fn is_damped(&self) -> bool {
        self.damping.is_some() || self.rates.iter().any(|c| *c != 0.0)
    }
}

/// Coefficients of one step size: rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
pub(crate) struct Recurrence {
    /// Of modes that damping couples; these come first.
    coupled: Option<Box<Blocks>>,
    /// Of all that move on their own.
    own: [[Vec<f64>; 4]; 3],
    /// The same once more, where these are all.
    modes: Option<OwnModes>,
}

impl Recurrence {
    /// Exact for loads linear in the step.
    pub(crate) fn exact(structure: &Structure, dt: f64) -> Self {
        Self::new(structure, dt, |_| false)
    }

    /// Average acceleration of some modes, exact for the others; of all where damping couples them.
    pub(crate) fn mixed(structure: &Structure, dt: f64, average: &ModeSet) -> Self {
        Self::new(structure, dt, |mode| average.has(mode))
    }

    fn new(structure: &Structure, dt: f64, is_average: impl Fn(usize) -> bool) -> Self {
        let modes = structure.modes;
        // Modes that damping couples, and what dashpots tie to them: full blocks.
        let coupled = structure.damping.as_ref().map(|all| {
            let both = modes + structure.tied;
            let mut damping = Dense::zeros(both, both);
            for j in 0..both {
                damping.column_mut(j).copy_from_slice(&all.column(j)[..both]);
            }
            let system = Coupled { modes, omega2: &structure.omega2[..both], damping };
            Box::new(if is_average(0) { system.average(dt) } else { system.exact(dt) })
        });
        // All others on their own: q̈ + 2ζω q̇ + ω² q = s, or c q̇ + κ q = s of a static shape.
        let mut own: [[Vec<f64>; 4]; 3] = Default::default();
        let first = if coupled.is_some() { modes + structure.tied } else { 0 };
        for i in first..structure.omega2.len() {
            let rate = structure.rates[i];
            let omega2 = structure.omega2[i];
            let one = if i >= modes {
                static_rule(rate, omega2, dt)
            } else if is_average(i) {
                let damping = Dense::from_columns(1, 1, vec![rate]);
                let single = Coupled { modes: 1, omega2: &[omega2], damping };
                single.average(dt).map(|row| row.map(|b| b[(0, 0)]))
            } else {
                single_mode::exact(omega2, rate, dt)
            };
            for (row, values) in own.iter_mut().zip(one) {
                for (column, value) in row.iter_mut().zip(values) {
                    column.push(value);
                }
            }
        }
        let Structure { omega2, rates, mass, .. } = structure;
        let modes = coupled.is_none().then(|| OwnModes::new(&own, omega2, rates, mass));
        Self { coupled, own, modes }
    }

    /// The modes of a structure, where each moves on its own.
    pub(crate) fn own(&self) -> Option<&OwnModes> {
        self.modes.as_ref()
    }

    /// One row of R times (q₀, q̇₀, s₀, s₁): ∫q, q or q̇ at the end.
    pub(crate) fn apply(&self, row: usize, inputs: [&[f64]; 4], y: &mut [f64]) {
        let [a, b, c, d] = &self.own[row];
        let n = a.len();
        let first = y.len() - n;
        if let Some(blocks) = &self.coupled {
            y[..first].fill(0.0);
            for (block, x) in blocks[row].iter().zip(inputs) {
                block.mul_add(1.0, &x[..first], &mut y[..first]);
            }
        }
        let inputs = inputs.map(|x| &x[first..first + n]);
        combine([a, b, c, d], inputs, &mut y[first..]);
    }

    /// What s₁ alone does to one row.
    pub(crate) fn answer(&self, row: usize, s: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        self.add_answer(row, s, y);
    }

    /// The same, added.
    pub(crate) fn add_answer(&self, row: usize, s: &[f64], y: &mut [f64]) {
        let end = &self.own[row][3];
        let first = y.len() - end.len();
        if let Some(blocks) = &self.coupled {
            blocks[row][3].mul_add(1.0, &s[..first], &mut y[..first]);
        }
        add_products(1.0, end, &s[first..], &mut y[first..]);
    }
}

/// c q̇ + κ q = s with s linear in the step and κ > 0: rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁. Without damping κ q = s,
/// at the mean rate of the step, whatever q was before: a load may have jumped.
fn static_rule(c: f64, stiffness: f64, dt: f64) -> [[f64; 4]; 3] {
    let per = stiffness.recip();
    let x = dt / (c * per);
    if !x.is_finite() || x > 1e9 {
        return [
            [0.5 * dt * per, 0.0, 0.0, 0.5 * dt * per],
            [0.0, 0.0, 0.0, per],
            [-dt.recip(), 0.0, 0.0, per / dt],
        ];
    }
    let c = c * per;
    let decay = (-x).exp();
    let mean = -(-x).exp_m1() / x;
    let q = [decay, 0.0, mean - decay, 1.0 - mean];
    let v = [-decay / c, 0.0, -(mean - decay) / c, mean / c];
    // ∫q = ∫s − c (q₁ − q₀)
    let integral = [c * (1.0 - decay), 0.0, 0.5 * dt - c * q[2], 0.5 * dt - c * q[3]];
    [integral, q, v].map(|[of_q, of_v, s0, s1]| [of_q, of_v, per * s0, per * s1])
}

#[cfg(test)]
mod tests;
