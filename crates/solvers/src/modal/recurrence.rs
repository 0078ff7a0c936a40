//! Coefficients of modal steps.
//!
//! Shapes of directions without mass follow the loads, c q̇ + κ q = s: exactly where the structure damps
//! them, at the mean rate of the step where it does not. Those that dashpots tie to the modes are unknowns of first
//! order of one system with them:
//!
//! ```text
//! q̈ = s_q − Ω² q − D q̇ − Eᵀ ẏ        G ẏ = s_y − κ y − E q̇
//! ```

use super::single_mode;
use crate::structure::JUMPED;
use trilith_linalg::{Dense, DenseLu, OwnModes, add_products, combine, dot, expm, weighted_square};

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

    /// Accelerations of the modes that a force on the structure at rest causes: a dashpot on a direction without mass
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
    coupled: Option<Box<[[Dense; 4]; 3]>>,
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

    /// Average acceleration of the modes whose bit is set, exact for the others; of all where damping
    /// couples them.
    pub(crate) fn mixed(structure: &Structure, dt: f64, average: u64) -> Self {
        Self::new(structure, dt, |mode| average & bit(mode) != 0)
    }

    fn new(structure: &Structure, dt: f64, is_average: impl Fn(usize) -> bool) -> Self {
        let modes = structure.modes;
        let coupled = structure.damping.as_ref().map(|all| {
            let both = modes + structure.tied;
            let mut damping = Dense::zeros(both, both);
            for j in 0..both {
                damping.column_mut(j).copy_from_slice(&all.column(j)[..both]);
            }
            let system = Coupled { modes, omega2: &structure.omega2[..both], damping };
            Box::new(if is_average(0) { system.average(dt) } else { system.exact(dt) })
        });
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

    /// Σ over the four inputs of one row.
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

    /// What a source at the end of the step alone does.
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

/// Modes and, behind them, first-order unknowns that damping couples.
struct Coupled<'a> {
    modes: usize,
    /// ω² and κ.
    omega2: &'a [f64],
    /// D, E and G; G is diagonal and positive.
    damping: Dense,
}

/// Rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
type Blocks = [[Dense; 4]; 3];

/// A first-order unknown that settles in less than this share of a step is taken as one that does in so much: what
/// it has to do is done at once.
const AT_ONCE: f64 = 1e-7;

impl Coupled<'_> {
    fn size(&self) -> usize {
        self.omega2.len()
    }

    /// G of a first-order unknown.
    fn own(&self, y: usize, dt: f64) -> f64 {
        self.damping[(y, y)].max(AT_ONCE * dt * self.omega2[y])
    }

    /// Rates of the first-order unknowns at the end: G ẏ₁ = s₁ − κ y₁ − E q̇₁, from the rows of both.
    fn end_rates(&self, dt: f64, q: &[Dense; 4], v: &mut [Dense; 4]) {
        let n = self.size();
        for (column, (q, v)) in q.iter().zip(v).enumerate() {
            for j in 0..n {
                for y in self.modes..n {
                    let own = f64::from(u8::from(column == 3 && j == y));
                    let tie: f64 = (0..self.modes).map(|i| self.damping[(y, i)] * v[(i, j)]).sum();
                    v[(y, j)] = (own - self.omega2[y] * q[(y, j)] - tie) / self.own(y, dt);
                }
            }
        }
    }

    /// Average acceleration of the modes, q̇₁ = q̇₀ + Δt (q̈₀ + q̈₁)/2, q₁ = q₀ + Δt (q̇₀ + q̇₁)/2, as balances of
    /// momentum over the step; the first-order unknowns by
    ///
    /// ```text
    /// G (y₁ − y₀) + E (q₁ − q₀) + κ Δt [(1−θ) y₀ + θ y₁] = Δt [(1−θ) s₀ + θ s₁],   θ = 1/(1 − e⁻ˣ) − 1/x,  x = κ Δt/G
    /// ```
    ///
    /// exact for one that decays on its own, without ringing however fast \[Liniger & Willoughby 1970\].
    /// ∫q = Δt (q₀ + q₁)/2.
    fn average(&self, dt: f64) -> Blocks {
        let (n, m) = (self.size(), self.modes);
        // Unknowns q̇₁ and y₁; inputs q₀ (y₀ with it), q̇₀, s₀, s₁.
        let mut left = Dense::zeros(n, n);
        let mut right = [(); 4].map(|()| Dense::zeros(n, n));
        for i in 0..m {
            let held = 0.25 * dt * dt * self.omega2[i];
            for j in 0..m {
                let share = 0.5 * dt * self.damping[(i, j)];
                left[(i, j)] = share;
                right[1][(i, j)] = -share;
            }
            for y in m..n {
                left[(i, y)] = self.damping[(i, y)];
                right[0][(i, y)] = self.damping[(i, y)];
            }
            left[(i, i)] += 1.0 + held;
            right[1][(i, i)] += 1.0 - held;
            right[0][(i, i)] = -dt * self.omega2[i];
            right[2][(i, i)] = 0.5 * dt;
            right[3][(i, i)] = 0.5 * dt;
        }
        for y in m..n {
            let own = self.own(y, dt);
            let end = fitted(self.omega2[y] * dt / own);
            for j in 0..m {
                let share = 0.5 * dt * self.damping[(y, j)];
                left[(y, j)] = share;
                right[1][(y, j)] = -share;
            }
            left[(y, y)] = own + self.omega2[y] * dt * end;
            right[0][(y, y)] = own - self.omega2[y] * dt * (1.0 - end);
            right[2][(y, y)] = dt * (1.0 - end);
            right[3][(y, y)] = dt * end;
        }
        let left = DenseLu::new(&left);
        let mut v = right.map(|mut right| {
            left.solve_columns(&mut right);
            right
        });
        // Half a step of another row, and the part that is there at the start.
        let half = |x: &Dense, start: f64, rows: std::ops::Range<usize>, y: &mut Dense| {
            for i in rows {
                for j in 0..n {
                    y[(i, j)] = 0.5 * dt * x[(i, j)];
                }
                y[(i, i)] += start;
            }
        };
        let zeros = || [(); 4].map(|()| Dense::zeros(n, n));
        let (mut q, mut sum) = (zeros(), zeros());
        for (column, start) in [1.0, 0.5 * dt, 0.0, 0.0].into_iter().enumerate() {
            half(&v[column], start, 0..m, &mut q[column]);
            for y in m..n {
                (0..n).for_each(|j| q[column][(y, j)] = v[column][(y, j)]);
            }
            let start = if column == 0 { 0.5 * dt } else { 0.0 };
            half(&q[column].clone(), start, 0..n, &mut sum[column]);
        }
        self.end_rates(dt, &q, &mut v);
        [sum, q, v]
    }

    /// exp of the augmented system: exact for sources linear in the step.
    ///
    /// Its states are measured so that each is a displacement: ∫q/Δt, q, q̇/√κ, s/κ with κ = ω², no less than 1/Δt²; of a
    /// first-order unknown no less than G/Δt. As they are, one fast mode makes a matrix of size ω²Δt, and what a power
    /// series of that rounds away sets the structure in motion that stands still.
    fn exact(&self, dt: f64) -> Blocks {
        let (n, m) = (self.size(), self.modes);
        let of_source = |j: usize| {
            let least = if j < m { (dt * dt).recip() } else { self.own(j, dt) / dt };
            self.omega2[j].max(least)
        };
        let of_rate = |j: usize| of_source(j).sqrt();
        let w: Vec<f64> = (0..m).map(of_rate).collect();
        // States: ∫q and ∫y, q and y, q̇, s, ṡ·Δt.
        let (position, rate, source) = (n, 2 * n, 2 * n + m);
        let size = source + 2 * n;
        let mut a = Dense::zeros(size, size);
        for i in 0..n {
            a[(i, position + i)] = 1.0;
            a[(source + i, source + n + i)] = 1.0;
        }
        // Rates of y, as rows over (y, q̇, s).
        for y in m..n {
            let per = dt / self.own(y, dt);
            a[(position + y, position + y)] = -self.omega2[y] * per;
            a[(position + y, source + y)] = of_source(y) * per;
            for j in 0..m {
                a[(position + y, rate + j)] = -self.damping[(y, j)] * w[j] * per;
            }
        }
        for i in 0..m {
            a[(position + i, rate + i)] = w[i] * dt;
            a[(rate + i, position + i)] = -self.omega2[i] / w[i] * dt;
            a[(rate + i, source + i)] = w[i] * dt;
            for j in 0..m {
                a[(rate + i, rate + j)] = -self.damping[(i, j)] * (w[j] / w[i]) * dt;
            }
            for y in m..n {
                let tie = self.damping[(i, y)] / w[i];
                if tie == 0.0 {
                    continue;
                }
                a[(rate + i, position + y)] -= tie * a[(position + y, position + y)];
                a[(rate + i, source + y)] -= tie * a[(position + y, source + y)];
                for j in 0..m {
                    a[(rate + i, rate + j)] -= tie * a[(position + y, rate + j)];
                }
            }
        }
        let e = expm(&a);
        let block = |row: usize, of_row: &dyn Fn(usize) -> f64, rows: usize, column: usize| {
            let per_column = |j: usize| match column {
                c if c == rate => of_rate(j).recip(),
                c if c >= source => of_source(j).recip(),
                _ => 1.0,
            };
            let mut b = Dense::zeros(n, n);
            for j in 0..if column == rate { m } else { n } {
                for i in 0..rows {
                    b[(i, j)] = e[(row + i, column + j)] * (of_row(i) * per_column(j));
                }
            }
            b
        };
        let row = |row: usize, of_row: &dyn Fn(usize) -> f64, rows: usize, rest: f64| {
            let of_position = block(row, of_row, rows, position);
            let end = block(row, of_row, rows, source + n);
            let mut start = block(row, of_row, rows, source);
            for j in 0..n {
                // What stands under a constant source goes on standing, to the last digit.
                if of_source(j) == self.omega2[j] {
                    let per = self.omega2[j].recip();
                    for i in 0..rows {
                        let stood = if i == j { rest } else { 0.0 };
                        start[(i, j)] = (stood - of_position[(i, j)]) * per;
                    }
                }
                for i in 0..rows {
                    start[(i, j)] -= end[(i, j)];
                }
            }
            [of_position, block(row, of_row, rows, rate), start, end]
        };
        let (sum, q) = (row(0, &|_| dt, n, dt), row(position, &|_| 1.0, n, 1.0));
        let mut v = row(rate, &of_rate, m, 0.0);
        self.end_rates(dt, &q, &mut v);
        [sum, q, v]
    }
}

/// Weight of the end of a step with which y' = −y, x = Δt, is exact.
fn fitted(x: f64) -> f64 {
    if x < 1e-3 { 0.5 + x / 12.0 } else { -(-x).exp_m1().recip() - x.recip() }
}

/// The bit of a mode.
pub(crate) fn bit(mode: usize) -> u64 {
    1 << mode.min(63)
}

#[cfg(test)]
mod tests;
