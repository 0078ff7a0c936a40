//! Coefficients of modal steps.
//!
//! Static shapes (places without mass) follow the loads, c q̇ + q = s: exactly where the structure damps
//! them, at the mean rate of the step where it does not.

use super::bit;
use crate::single_mode;
use trilith_linalg::{Dense, DenseLu, OwnModes, add_products, combine, dot, expm, weighted_square};

/// The linear structure on a basis: modes first, static shapes (without mass, of stiffness one) behind them.
#[derive(Clone)]
pub(super) struct Structure {
    /// Number of modes.
    pub modes: usize,
    /// ω², and 1 of the static shapes.
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
    pub(super) fn acceleration(&self, s: &[f64], q: &[f64], v: &[f64], a: &mut [f64]) {
        a.copy_from_slice(s);
        match &self.damping {
            Some(damping) => damping.mul_add(-1.0, v, a),
            None => add_products(-1.0, &self.rates, v, a),
        }
        add_products(-1.0, &self.omega2, q, a);
        a[self.modes..].fill(0.0);
    }

    /// ½ q̇ᵀ q̇ of the modes and ½ qᵀ Ω² q of all.
    pub(super) fn energy(&self, x: &[f64]) -> (f64, f64) {
        let m = self.omega2.len();
        let (q, v) = (&x[..m], &x[m..m + self.modes]);
        (0.5 * dot(v, v), 0.5 * weighted_square(&self.omega2, q))
    }

    /// True where something damps.
    pub(super) fn is_damped(&self) -> bool {
        self.damping.is_some() || self.rates.iter().any(|c| *c != 0.0)
    }
}

/// Coefficients of one step size: rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
pub(super) struct Rule {
    /// Of modes that damping couples; these come first.
    coupled: Option<Box<[[Dense; 4]; 3]>>,
    /// Of all that move on their own.
    own: [[Vec<f64>; 4]; 3],
    /// The same once more, where these are all.
    modes: Option<OwnModes>,
}

impl Rule {
    /// Exact for loads linear in the step.
    pub(super) fn exact(structure: &Structure, dt: f64) -> Self {
        Self::new(structure, dt, |_| false)
    }

    /// Average acceleration of the modes whose bit is set, exact for the others; of all where damping
    /// couples them.
    pub(super) fn mixed(structure: &Structure, dt: f64, average: u64) -> Self {
        Self::new(structure, dt, |mode| average & bit(mode) != 0)
    }

    fn new(structure: &Structure, dt: f64, is_average: impl Fn(usize) -> bool) -> Self {
        let modes = structure.modes;
        let coupled = structure.damping.as_ref().map(|all| {
            let mut damping = Dense::zeros(modes, modes);
            for j in 0..modes {
                damping.column_mut(j).copy_from_slice(&all.column(j)[..modes]);
            }
            let rule = if is_average(0) { average_rule } else { exact_rule };
            Box::new(rule(&structure.omega2[..modes], &damping, dt))
        });
        let mut own: [[Vec<f64>; 4]; 3] = Default::default();
        let first = if coupled.is_some() { modes } else { 0 };
        for i in first..structure.omega2.len() {
            let rate = structure.rates[i];
            let omega2 = structure.omega2[i];
            let one = if i >= modes {
                static_rule(rate, dt)
            } else if is_average(i) {
                let damping = Dense::from_columns(1, 1, vec![rate]);
                average_rule(&[omega2], &damping, dt).map(|row| row.map(|b| b[(0, 0)]))
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
    pub(super) fn own(&self) -> Option<&OwnModes> {
        self.modes.as_ref()
    }

    /// Σ over the four inputs of one row.
    pub(super) fn apply(&self, row: usize, inputs: [&[f64]; 4], y: &mut [f64]) {
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

    /// What a source at the end of the step alone does.
    pub(super) fn answer(&self, row: usize, s: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        self.add_answer(row, s, y);
    }

    /// The same, added.
    pub(super) fn add_answer(&self, row: usize, s: &[f64], y: &mut [f64]) {
        let end = &self.own[row][3];
        let first = y.len() - end.len();
        if let Some(blocks) = &self.coupled {
            blocks[row][3].mul_add(1.0, &s[..first], &mut y[..first]);
        }
        add_products(1.0, end, &s[first..], &mut y[first..]);
    }
}

/// Average acceleration as blocks: q̇₁ = q̇₀ + Δt (q̈₀ + q̈₁)/2, q₁ = q₀ + Δt (q̇₀ + q̇₁)/2, ∫q = Δt (q₀ + q₁)/2.
fn average_rule(omega2: &[f64], damping: &Dense, dt: f64) -> [[Dense; 4]; 3] {
    let m = omega2.len();
    let mut left = Dense::zeros(m, m);
    let mut rate = Dense::zeros(m, m);
    let mut force = Dense::zeros(m, m);
    let mut spring = Dense::zeros(m, m);
    for i in 0..m {
        let held = 0.25 * dt * dt * omega2[i];
        for j in 0..m {
            let share = 0.5 * dt * damping[(i, j)];
            left[(i, j)] = share;
            rate[(i, j)] = -share;
        }
        left[(i, i)] += 1.0 + held;
        rate[(i, i)] += 1.0 - held;
        force[(i, i)] = 0.5 * dt;
        spring[(i, i)] = -dt * omega2[i];
    }
    let left = DenseLu::new(&left);
    let v = [spring, rate, force.clone(), force].map(|mut right| {
        left.solve_columns(&mut right);
        right
    });
    // Half a step of another row, and the part that is there at the start.
    let half = |x: &Dense, start: f64| {
        let mut y = x.clone();
        y.values_mut().iter_mut().for_each(|x| *x *= 0.5 * dt);
        for i in 0..m {
            y[(i, i)] += start;
        }
        y
    };
    let q = [half(&v[0], 1.0), half(&v[1], 0.5 * dt), half(&v[2], 0.0), half(&v[3], 0.0)];
    let sum = [half(&q[0], 0.5 * dt), half(&q[1], 0.0), half(&q[2], 0.0), half(&q[3], 0.0)];
    [sum, q, v]
}

/// c q̇ + q = s with s linear in the step: rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁. Without damping q = s,
/// at the mean rate of the step, whatever q was before: a load may have jumped.
fn static_rule(c: f64, dt: f64) -> [[f64; 4]; 3] {
    let x = dt / c;
    if !x.is_finite() || x > 1e9 {
        return [
            [0.5 * dt, 0.0, 0.0, 0.5 * dt],
            [0.0, 0.0, 0.0, 1.0],
            [-dt.recip(), 0.0, 0.0, dt.recip()],
        ];
    }
    let decay = (-x).exp();
    let mean = -(-x).exp_m1() / x;
    let q = [decay, 0.0, mean - decay, 1.0 - mean];
    let v = [-decay / c, 0.0, -(mean - decay) / c, mean / c];
    // ∫q = ∫s − c (q₁ − q₀)
    let integral = [c * (1.0 - decay), 0.0, 0.5 * dt - c * q[2], 0.5 * dt - c * q[3]];
    [integral, q, v]
}

/// exp of the augmented system, as blocks: rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
fn exact_rule(omega2: &[f64], damping: &Dense, dt: f64) -> [[Dense; 4]; 3] {
    let m = omega2.len();
    // States: ∫q, q, q̇, s, ṡ·dt.
    let mut a = Dense::zeros(5 * m, 5 * m);
    for i in 0..m {
        a[(i, m + i)] = dt;
        a[(m + i, 2 * m + i)] = dt;
        a[(2 * m + i, m + i)] = -omega2[i] * dt;
        a[(2 * m + i, 3 * m + i)] = dt;
        a[(3 * m + i, 4 * m + i)] = 1.0;
        for j in 0..m {
            a[(2 * m + i, 2 * m + j)] = -damping[(i, j)] * dt;
        }
    }
    let e = expm(&a);
    let block = |row: usize, column: usize| {
        let mut b = Dense::zeros(m, m);
        for j in 0..m {
            for i in 0..m {
                b[(i, j)] = e[(row * m + i, column * m + j)];
            }
        }
        b
    };
    [0, 1, 2].map(|row| {
        let end = block(row, 4);
        let mut start = block(row, 3);
        for (x, y) in start.values_mut().iter_mut().zip(end.values()) {
            *x -= y;
        }
        [block(row, 1), block(row, 2), start, end]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// u = p/k (1 − cos ωt) under a constant load; (p/k)(t/t₁ − sin ωt / ωt₁) under a ramp.
    #[test]
    fn constant_and_linear_loads_are_exact() {
        let (w, dt) = (3.0, 0.7);
        let c = exact_rule(&[w * w], &Dense::zeros(1, 1), dt);
        let x = w * dt;
        let both = c[1][2][(0, 0)] + c[1][3][(0, 0)];
        assert!((both - (1.0 - x.cos()) / (w * w)).abs() < 1e-15);
        assert!((c[1][3][(0, 0)] - (1.0 - x.sin() / x) / (w * w)).abs() < 1e-15);
        assert!((c[1][0][(0, 0)] - x.cos()).abs() < 1e-14);
    }

    /// c q̇ + q = s: q = 1 − e^(−t/c) under a constant load, t − c (1 − e^(−t/c)) under a rising one.
    #[test]
    fn a_damped_static_shape_follows_constant_and_rising_loads() {
        let (c, dt) = (0.3, 0.7);
        let [integral, q, v] = static_rule(c, dt);
        let decay = f64::exp(-dt / c);
        assert!((q[2] + q[3] - (1.0 - decay)).abs() < 1e-15);
        assert!((q[3] * dt - (dt - c * (1.0 - decay))).abs() < 1e-15);
        assert!((v[2] + v[3] - decay / c).abs() < 1e-14);
        assert!((integral[2] + integral[3] - (dt - c * (1.0 - decay))).abs() < 1e-15);
        // Little damping and none are the same for a load that did not jump.
        let (little, none) = (static_rule(1e-8 * dt, dt), static_rule(0.0, dt));
        for (a, b) in little.iter().zip(&none) {
            let at = |r: &[f64; 4]| [r[0] + r[2], r[3]];
            for (x, y) in at(a).iter().zip(at(b)) {
                assert!((x - y).abs() < 1e-6, "{little:?} {none:?}");
            }
        }
    }

    #[test]
    fn a_free_mass_moves_as_under_constant_and_rising_force() {
        let c = exact_rule(&[0.0], &Dense::zeros(1, 1), 2.0);
        assert!((c[1][2][(0, 0)] - 4.0 / 3.0).abs() < 1e-14);
        assert!((c[1][3][(0, 0)] - 4.0 / 6.0).abs() < 1e-14);
        assert!((c[2][3][(0, 0)] - 1.0).abs() < 1e-14);
    }

    /// With constant acceleration both rules are exact; with a spring the average one keeps the energy.
    #[test]
    fn average_acceleration_keeps_the_energy_of_a_free_oscillator() {
        let (w, dt) = (3.0, 0.9);
        let [sum, q, v] = average_rule(&[w * w], &Dense::zeros(1, 1), dt);
        let at = |b: &Dense| b[(0, 0)];
        let (q1, v1) = (at(&q[0]) * 0.3 + at(&q[1]) * 1.1, at(&v[0]) * 0.3 + at(&v[1]) * 1.1);
        let energy = |q: f64, v: f64| v * v + w * w * q * q;
        assert!((energy(q1, v1) / energy(0.3, 1.1) - 1.0).abs() < 1e-14);
        assert!((at(&sum[0]) * 0.3 + at(&sum[1]) * 1.1 - 0.5 * dt * (0.3 + q1)).abs() < 1e-15);
        let free = average_rule(&[0.0], &Dense::zeros(1, 1), dt);
        assert!((at(&free[1][2]) + at(&free[1][3]) - 0.5 * dt * dt).abs() < 1e-15);
        assert!((at(&free[2][2]) + at(&free[2][3]) - dt).abs() < 1e-15);
    }
}
