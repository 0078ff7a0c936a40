//! Modes and first-order unknowns that damping couples, over one step.
//!
//! ```text
//! q̈ = s_q − Ω² q − D q̇ − Eᵀ ẏ        G ẏ = s_y − κ y − E q̇
//! ```

use trilith_linalg::{Dense, DenseLu, phi_functions};

/// Modes and, behind them, first-order unknowns that damping couples.
pub(super) struct Coupled<'a> {
    pub modes: usize,
    /// ω² and κ.
    pub omega2: &'a [f64],
    /// D, E and G; G is diagonal and positive.
    pub damping: Dense,
}

/// Rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
pub(super) type Blocks = [[Dense; 4]; 3];

/// A first-order unknown that decays in less than this share of a step is taken as one that does in so much: what
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
    pub(super) fn average(&self, dt: f64) -> Blocks {
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

    /// Exact for sources linear in the step: of x = (q, q̇), with x' = A x + B s and h the step,
    ///
    /// ```text
    /// x₁ = φ₀ x₀ + φ₁ B h s₀ + φ₂ B h (s₁ − s₀)        ∫x/h = φ₁ x₀ + φ₂ B h s₀ + φ₃ B h (s₁ − s₀)        φ of A h
    /// ```
    ///
    /// States are measured so that each is a displacement: ∫q/Δt, q, q̇/√κ, s/κ with κ = ω², no less than 1/Δt²; of a
    /// first-order unknown no less than G/Δt. As they are, one fast mode makes a matrix of size ω²Δt, and what a power
    /// series of that rounds away sets the structure in motion that stands still.
    pub(super) fn exact(&self, dt: f64) -> Blocks {
        let (n, m) = (self.size(), self.modes);
        let scales = Scales::new(self, dt);
        let (of_states, of_sources) = self.system(dt, &scales);
        let [flow, mean, ramp, ramp_mean] = phi_functions(&of_states);
        let [constant, rising, risen] =
            [&mean, &ramp, &ramp_mean].map(|phi| phi.times(&of_sources));
        // Columns q₀, q̇₀, and what constant and rising sources make, of some rows.
        let row = |first: usize,
                   of_row: &dyn Fn(usize) -> f64,
                   [of_start, of_constant, of_rising]: [&Dense; 3],
                   rows: usize,
                   rest: f64| {
            let block =
                |from: &Dense, column: usize, columns: usize, per: &dyn Fn(usize) -> f64| {
                    let mut b = Dense::zeros(n, n);
                    for j in 0..columns {
                        for i in 0..rows {
                            b[(i, j)] = from[(first + i, column + j)] * (of_row(i) * per(j));
                        }
                    }
                    b
                };
            let per_source = |j: usize| scales.source[j].recip();
            let of_position = block(of_start, 0, n, &|_| 1.0);
            let of_rate = block(of_start, n, m, &|j| scales.rate[j].recip());
            let end = block(of_rising, 0, n, &per_source);
            let mut start = block(of_constant, 0, n, &per_source);
            for j in 0..n {
                // What stands under a constant source goes on standing, to the last digit.
                if scales.source[j] == self.omega2[j] {
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
            [of_position, of_rate, start, end]
        };
        let sum = row(0, &|_| dt, [&mean, &rising, &risen], n, dt);
        let q = row(0, &|_| 1.0, [&flow, &constant, &rising], n, 1.0);
        let mut v = row(n, &|i| scales.rate[i], [&flow, &constant, &rising], m, 0.0);
        self.end_rates(dt, &q, &mut v);
        [sum, q, v]
    }

    /// A Δt and B Δt in scaled states: q and y, q̇; sources.
    fn system(&self, dt: f64, scales: &Scales) -> (Dense, Dense) {
        let (n, m) = (self.size(), self.modes);
        let w = &scales.rate;
        let (mut a, mut b) = (Dense::zeros(n + m, n + m), Dense::zeros(n + m, n));
        // Rates of y, as rows over (y, q̇, s).
        for y in m..n {
            let per = dt / self.own(y, dt);
            a[(y, y)] = -self.omega2[y] * per;
            b[(y, y)] = scales.source[y] * per;
            for j in 0..m {
                a[(y, n + j)] = -self.damping[(y, j)] * w[j] * per;
            }
        }
        for i in 0..m {
            a[(i, n + i)] = w[i] * dt;
            a[(n + i, i)] = -self.omega2[i] / w[i] * dt;
            b[(n + i, i)] = w[i] * dt;
            for j in 0..m {
                a[(n + i, n + j)] = -self.damping[(i, j)] * (w[j] / w[i]) * dt;
            }
            for y in m..n {
                let tie = self.damping[(i, y)] / w[i];
                if tie == 0.0 {
                    continue;
                }
                a[(n + i, y)] -= tie * a[(y, y)];
                b[(n + i, y)] -= tie * b[(y, y)];
                for j in 0..m {
                    a[(n + i, n + j)] -= tie * a[(y, n + j)];
                }
            }
        }
        (a, b)
    }
}

/// Weight of the end of a step with which y' = −y, x = Δt, is exact.
fn fitted(x: f64) -> f64 {
    if x < 1e-3 { 0.5 + x / 12.0 } else { -(-x).exp_m1().recip() - x.recip() }
}

/// What makes a displacement of each state of the augmented system.
struct Scales {
    /// κ of sources: ω², no less than 1/Δt²; of a first-order unknown no less than G/Δt.
    source: Vec<f64>,
    /// √κ of the rates of modes.
    rate: Vec<f64>,
}

impl Scales {
    fn new(of: &Coupled<'_>, dt: f64) -> Self {
        let source = |j: usize| {
            let least = if j < of.modes { (dt * dt).recip() } else { of.own(j, dt) / dt };
            of.omega2[j].max(least)
        };
        let source: Vec<f64> = (0..of.size()).map(source).collect();
        let rate = source[..of.modes].iter().map(|k| k.sqrt()).collect();
        Self { source, rate }
    }
}
