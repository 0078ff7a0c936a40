//! Radau IIA on the whole structure, step by step.
//!
//! ```text
//!   X = U − 1 uₙ over the three stages, Ã = A⁻¹/h:   V = Ã X,   V̇ = Ã (V − 1 vₙ)
//!   M Ã² X + C Ã X + (K + Bᵀ k B) X = P − K uₙ + M Ã 1 vₙ − Bᵀ (F − k (D − dₙ))
//! ```
//!
//! Rows without mass are algebraic or of first order and need nothing special: the rule ends in a stage.
//! The structure is solved by one real and one complex dense factor for a step size; what is left are the
//! deformations and own unknowns of the links at the stages, by Newton's method with a line search. Every
//! step is made whole and in halves; their distance is the error, and the halves are kept.

use super::laws::At;
use super::number::Dual;
use super::problem::{Probe, Problem};
use super::radau::{C64, Radau};
use nalgebra::{DMatrix, DVector, Dyn, LU};
use std::collections::HashMap;

/// Displacements, velocities (of what has mass) and own unknowns of the links.
#[derive(Clone, Debug)]
pub struct State {
    /// Displacements.
    pub u: DVector<f64>,
    /// Velocities.
    pub v: DVector<f64>,
    /// Own unknowns.
    pub z: DVector<f64>,
}

/// Largest values so far: what errors are measured against.
#[derive(Clone, Debug)]
pub struct Scale {
    u: DVector<f64>,
    v: DVector<f64>,
    z: DVector<f64>,
    d: DVector<f64>,
}

impl Scale {
    fn largest(p: &Problem, of: &DVector<f64>, turns: bool) -> f64 {
        let on = |j: &usize| {
            let column = p.a.t.column(*j);
            (0..column.len()).any(|i| column[i] != 0.0 && (i % 6 > 2) == turns)
        };
        (0..of.len()).filter(on).map(|j| of[j]).fold(0.0, f64::max)
    }

    /// Largest displacement, or rotation, of any direction.
    #[must_use]
    pub fn displacement(&self, p: &Problem, turns: bool) -> f64 {
        Self::largest(p, &self.u, turns)
    }

    /// Largest velocity of any direction.
    #[must_use]
    pub fn velocity(&self, p: &Problem, turns: bool) -> f64 {
        Self::largest(p, &self.v, turns)
    }
}

/// Values of the probes over a step: at its start and its three stages.
#[derive(Clone, Debug)]
struct Piece {
    t: f64,
    h: f64,
    values: Vec<[f64; 4]>,
}

/// What a march leaves.
#[derive(Clone, Debug)]
pub struct Course {
    pieces: Vec<Piece>,
    /// State at the end.
    pub end: State,
    /// Largest values.
    pub scale: Scale,
    /// Steps made.
    pub steps: usize,
}

/// What a step size needs.
struct Factors {
    real: LU<f64, Dyn, Dyn>,
    complex: LU<C64, Dyn, Dyn>,
    /// Response of the structure to link forces.
    image: (DMatrix<f64>, DMatrix<C64>),
    /// Deformations of that response.
    g: (DMatrix<f64>, DMatrix<C64>),
}

struct Solved {
    state: State,
    /// Link deformations, their rates and forces at the stages; displacements and velocities.
    d: [DVector<f64>; 3],
    f: [DVector<f64>; 3],
    u: [DVector<f64>; 3],
    v: [DVector<f64>; 3],
}

/// Share of the size of an unknown of the links within which Newton's method stops.
const ACCURACY: f64 = 1e-11;

/// How finely, and how much work at most.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Error of a step, as share of the largest value so far.
    pub tolerance: f64,
    /// Work at most, in multiplications or so.
    pub work: f64,
}

struct March<'a> {
    p: &'a Problem,
    rule: Radau,
    factors: HashMap<u64, Factors>,
    scale: Scale,
    heavy: Vec<bool>,
    /// Work so far without factors, and number of factors made.
    work: f64,
    made: usize,
}

/// Marches from a state over all of the problem.
///
/// # Errors
/// Where no step is short enough, or work ran out.
pub fn march(
    p: &Problem,
    start: State,
    known: Option<Scale>,
    effort: Effort,
) -> Result<Course, String> {
    let (n, l, nz) = (p.a.k.nrows(), p.a.b.nrows(), p.unknowns());
    let none = |n| DVector::zeros(n);
    let scale = known.unwrap_or(Scale { u: none(n), v: none(n), z: none(nz), d: none(l) });
    let heavy = (0..n).map(|i| p.a.m[(i, i)] > 0.0).collect();
    let mut it =
        March { p, rule: Radau::new(), factors: HashMap::new(), scale, heavy, work: 0.0, made: 0 };
    it.grow(&start);
    let mut state = start;
    let (mut pieces, mut steps) = (Vec::new(), 0_usize);
    let of_factors = 4.0 * (n as f64).powi(3);
    let mut next = p.breaks[p.breaks.len() - 1] / 1024.0;
    for pair in p.breaks.windows(2) {
        let (from, length) = (pair[0], pair[1] - pair[0]);
        // A step is length / 2^level and starts at a multiple of its own length.
        let mut level = (length / next).log2().ceil().max(0.0) as u32;
        let (mut at, mut deep) = (0_u64, 40_u32);
        deep = deep.max(level);
        while at < 1 << deep {
            steps += 1;
            if it.work + of_factors * it.made as f64 > effort.work {
                return Err(format!("{steps} steps were too much work"));
            }
            let unit = 1_u64 << (deep - level);
            let (t, h) = (
                from + length * at as f64 / (1_u64 << deep) as f64,
                length / (1_u64 << level) as f64,
            );
            let tried = it.try_step(t, h, &state);
            let rise = match tried {
                Some((error, halves)) if error <= effort.tolerance => {
                    for (i, half) in halves.iter().enumerate() {
                        let before = if i == 0 { &state } else { &halves[0].state };
                        pieces.push(it.piece(t + 0.5 * h * i as f64, 0.5 * h, before, half));
                    }
                    let [_, last] = halves;
                    state = last.state;
                    it.grow(&state);
                    at += unit;
                    next = h;
                    if error < effort.tolerance / 100.0 && level > 0 && at.is_multiple_of(2 * unit)
                    {
                        level -= 1;
                        next = 2.0 * h;
                    }
                    continue;
                }
                Some((error, _)) => {
                    ((error / effort.tolerance).log2() / 4.0).clamp(1.0, 4.0) as u32
                }
                None => 1,
            };
            level += rise;
            if level >= deep {
                return Err(format!("no step is short enough at t = {t:e}"));
            }
        }
    }
    Ok(Course { pieces, end: state, scale: it.scale, steps })
}

impl March<'_> {
    fn grow(&mut self, s: &State) {
        let up = |to: &mut DVector<f64>, x: &DVector<f64>| {
            to.iter_mut().zip(x.iter()).for_each(|(a, b)| *a = a.max(b.abs()));
        };
        up(&mut self.scale.u, &s.u);
        up(&mut self.scale.v, &s.v);
        up(&mut self.scale.z, &s.z);
        let d = &self.p.a.b * &s.u;
        up(&mut self.scale.d, &d);
    }

    fn factors(&mut self, h: f64) -> Option<()> {
        let key = h.to_bits() >> 12;
        if self.factors.contains_key(&key) {
            return Some(());
        }
        let a = &self.p.a;
        let beside = &a.b.transpose() * DMatrix::from_diagonal(&self.p.beside) * &a.b;
        let k = &a.k + beside;
        let x = self.rule.real / h;
        let real = (&a.m * (x * x) + &a.c * x + &k).lu();
        let y = self.rule.complex / h;
        let wide = |m: &DMatrix<f64>, s: C64| m.map(|v| s * v);
        let complex = (wide(&a.m, y * y) + wide(&a.c, y) + wide(&k, C64::new(1.0, 0.0))).lu();
        let bt = a.b.transpose();
        let image = (real.solve(&bt)?, complex.solve(&bt.map(|v| C64::new(v, 0.0)))?);
        let g = (&a.b * &image.0, a.b.map(|v| C64::new(v, 0.0)) * &image.1);
        if self.factors.len() > 60 {
            self.factors.clear();
        }
        self.made += 1;
        self.factors.insert(key, Factors { real, complex, image, g });
        Some(())
    }

    /// Error, as share of the largest values, and the two halves.
    fn try_step(&mut self, t: f64, h: f64, s: &State) -> Option<(f64, [Solved; 2])> {
        let whole = self.step(t, h, s)?;
        let first = self.step(t, 0.5 * h, s)?;
        let second = self.step(t + 0.5 * h, 0.5 * h, &first.state)?;
        let error = self.distance(&whole.state, &second.state);
        Some((error, [first, second]))
    }

    fn distance(&self, a: &State, b: &State) -> f64 {
        let share = |x: &DVector<f64>,
                     y: &DVector<f64>,
                     scale: &DVector<f64>,
                     floor: f64,
                     on: &dyn Fn(usize) -> bool| {
            let mut worst = 0.0_f64;
            let all =
                (0..x.len()).map(|i| scale[i].max(x[i].abs()).max(y[i].abs())).fold(0.0, f64::max);
            for i in (0..x.len()).filter(|i| on(*i)) {
                let size = scale[i].max(x[i].abs()).max(y[i].abs()).max(1e-4 * all).max(floor);
                let e = (x[i] - y[i]).abs() / size;
                worst = if e.is_nan() { f64::INFINITY } else { worst.max(e) };
            }
            worst
        };
        let any = |_: usize| true;
        let u = share(&a.u, &b.u, &self.scale.u, 1e-12, &any);
        let v = share(&a.v, &b.v, &self.scale.v, 1e-11, &|i| self.heavy[i]);
        let z = share(&a.z, &b.z, &self.scale.z, 1e-12, &any);
        u.max(v).max(z)
    }

    fn step(&mut self, t: f64, h: f64, s: &State) -> Option<Solved> {
        self.factors(h)?;
        self.work += 15.0 * (s.u.len() as f64).powi(2) + 2000.0;
        let (p, r) = (self.p, &self.rule);
        let a = &p.a;
        let fac = &self.factors[&(h.to_bits() >> 12)];
        let (l, nz) = (a.b.nrows(), s.z.len());
        let tilde = r.inverse / h;
        let ones = [0, 1, 2].map(|i| tilde.row(i).sum());
        let own = -(&a.k * &s.u);
        let mv = &a.m * &s.v;
        let times = r.c.map(|c| if c == 1.0 { t + h } else { t + c * h });
        let rhs = [0, 1, 2].map(|i| p.load(times[i]) + &own + &mv * ones[i]);
        // Into eigenvectors, solved, and back.
        let w0 = fac
            .real
            .solve(&(&rhs[0] * r.from.0[0] + &rhs[1] * r.from.0[1] + &rhs[2] * r.from.0[2]))?;
        let mixed = DVector::from_fn(own.len(), |i, _| {
            (0..3).map(|j| r.from.1[j] * rhs[j][i]).sum::<C64>()
        });
        let w1 = fac.complex.solve(&mixed)?;
        let back = |w0: &DVector<f64>, w1: &DVector<C64>, i: usize| {
            DVector::from_fn(w0.len(), |j, _| r.to.0[i] * w0[j] + 2.0 * (r.to.1[i] * w1[j]).re)
        };
        let linear = [0, 1, 2].map(|i| back(&w0, &w1, i));
        let moved = times.map(|t| p.supports(t, false));
        let d0 = &a.b * &s.u;
        let mut x = linear.clone();
        let mut solved_d = [0, 1, 2].map(|i| &d0 + &a.b * &linear[i] + &a.b_s * &moved[i][0]);
        let mut f = [0, 1, 2].map(|_| DVector::zeros(l));
        let mut z_end = s.z.clone();
        if l > 0 {
            let y_linear = linear.each_ref().map(|x| &a.b * x);
            // Compliance between stages.
            let g = |i: usize, j: usize, c: usize, e: usize| {
                r.to.0[i] * fac.g.0[(c, e)] * r.from.0[j]
                    + 2.0 * (r.to.1[i] * fac.g.1[(c, e)] * r.from.1[j]).re
            };
            let mut big = DMatrix::zeros(3 * l, 3 * l);
            for (i, j) in (0..9).map(|x| (x / 3, x % 3)) {
                for (c, e) in (0..l * l).map(|x| (x / l, x % l)) {
                    big[(i * l + c, j * l + e)] = g(i, j, c, e);
                }
            }
            let stage = Stages {
                p,
                tilde: &tilde,
                big: &big,
                y_linear: &y_linear,
                d0: &d0,
                moved: &moved,
                z0: &s.z,
            };
            let start = self.guess(s, h, &y_linear);
            let (solved, tries) = stage.newton(start, &self.sizes(&d0));
            self.work += tries as f64 * (3.0 * (l + nz) as f64).powi(3);
            let (unknown, forces) = solved?;
            // F̃ at the stages, and the structure under them.
            let mut tilde_f = DMatrix::zeros(l, 3);
            for i in 0..3 {
                for c in 0..l {
                    tilde_f[(c, i)] = forces[i][c] - p.beside[c] * unknown[i * l + c];
                }
            }
            let f0 = &tilde_f * r.from.0;
            let f1 = tilde_f.map(|v| C64::new(v, 0.0)) * r.from.1;
            let (w0, w1) = (&fac.image.0 * f0, &fac.image.1 * f1);
            for i in 0..3 {
                x[i] -= back(&w0, &w1, i);
                solved_d[i] = &d0 + &a.b * &x[i] + &a.b_s * &moved[i][0];
            }
            for i in 0..nz {
                z_end[i] = unknown[3 * l + 2 * nz + i];
            }
            f = forces;
        }
        let v = [0, 1, 2]
            .map(|i| &x[0] * tilde[(i, 0)] + &x[1] * tilde[(i, 1)] + &x[2] * tilde[(i, 2)]);
        let u = x.map(|x| x + &s.u);
        let state = State { u: u[2].clone(), v: v[2].clone(), z: z_end };
        Some(Solved { state, d: solved_d, f, u, v })
    }

    /// First guess of the stages: the linear structure with its springs beside, unknowns as they are.
    fn guess(&self, s: &State, _h: f64, y_linear: &[DVector<f64>; 3]) -> DVector<f64> {
        let (l, nz) = (y_linear[0].len(), s.z.len());
        let mut x = DVector::zeros(3 * (l + nz));
        for i in 0..3 {
            let v = &self.p.a.b * &s.v;
            for c in 0..l {
                x[i * l + c] = self.rule.c[i] * _h * v[c];
            }
            for c in 0..nz {
                x[3 * l + i * nz + c] = s.z[c];
            }
        }
        x
    }

    /// Sizes of the unknowns of the links that their accuracy is measured against.
    fn sizes(&self, d0: &DVector<f64>) -> Vec<f64> {
        let l = d0.len();
        let of_d: Vec<f64> = (0..l).map(|i| self.scale.d[i].max(d0[i].abs())).collect();
        let mut of_z = Vec::with_capacity(self.scale.z.len());
        for link in &self.p.a.links {
            let size = (0..link.axes.len()).map(|c| of_d[link.first + c]).fold(0.0, f64::max);
            let size = if link.law.in_metres() { size } else { 1.0 };
            of_z.extend((0..link.law.unknowns()).map(|_| size));
        }
        [&of_d, &of_d, &of_d, &of_z, &of_z, &of_z].into_iter().flatten().copied().collect()
    }

    fn piece(&self, t: f64, h: f64, before: &State, s: &Solved) -> Piece {
        let p = self.p;
        let times = [t, t + self.rule.c[0] * h, t + self.rule.c[1] * h, t + h];
        let values = p
            .probes
            .iter()
            .map(|probe| {
                let mut values = [f64::NAN; 4];
                for (i, t) in times.iter().enumerate() {
                    let moved = || p.supports(*t, i == 0);
                    values[i] = match (probe, i) {
                        (Probe::Displacement(q, m), 0) => q.dot(&before.u) + m.dot(&moved()[0]),
                        (Probe::Displacement(q, m), _) => q.dot(&s.u[i - 1]) + m.dot(&moved()[0]),
                        (Probe::Velocity(q, m), 1..) => q.dot(&s.v[i - 1]) + m.dot(&moved()[1]),
                        (Probe::Force(c), 1..) => s.f[i - 1][*c],
                        (Probe::Deformation(c), 1..) => s.d[i - 1][*c],
                        _ => f64::NAN,
                    };
                }
                values
            })
            .collect();
        Piece { t, h, values }
    }
}

/// The link equations of a step at its stages.
struct Stages<'a> {
    p: &'a Problem,
    tilde: &'a nalgebra::Matrix3<f64>,
    big: &'a DMatrix<f64>,
    y_linear: &'a [DVector<f64>; 3],
    d0: &'a DVector<f64>,
    moved: &'a [[DVector<f64>; 2]; 3],
    z0: &'a DVector<f64>,
}

/// Unknowns and forces at the stages.
type Settled = (DVector<f64>, [DVector<f64>; 3]);

/// Forces, residuals, and the tangents of both by d, ḋ, z, ż at each stage.
struct Local {
    f: [DVector<f64>; 3],
    g: [DVector<f64>; 3],
    f_by: [[DMatrix<f64>; 4]; 3],
    g_by: [[DMatrix<f64>; 4]; 3],
}

impl Stages<'_> {
    fn laws(&self, x: &DVector<f64>, tangents: bool) -> Local {
        let p = self.p;
        let (l, nz) = (self.d0.len(), self.z0.len());
        let sizes = [l, l, nz, nz];
        let blank = |rows: usize| {
            [0, 1, 2].map(|_| sizes.map(|n| DMatrix::zeros(if tangents { rows } else { 0 }, n)))
        };
        let mut out = Local {
            f: [0, 1, 2].map(|_| DVector::zeros(l)),
            g: [0, 1, 2].map(|_| DVector::zeros(nz)),
            f_by: blank(l),
            g_by: blank(nz),
        };
        for i in 0..3 {
            let offset = &p.a.b_s * &self.moved[i][0];
            let offset_v = &p.a.b_s * &self.moved[i][1];
            let rate = |c: usize| (0..3).map(|j| self.tilde[(i, j)] * x[j * l + c]).sum::<f64>();
            let own_rate = |c: usize| {
                (0..3)
                    .map(|j| self.tilde[(i, j)] * (x[3 * l + j * nz + c] - self.z0[c]))
                    .sum::<f64>()
            };
            let mut first = 0;
            for link in &p.a.links {
                let (m, k) = (link.axes.len(), link.law.unknowns());
                let mut input: Vec<Dual> = Vec::with_capacity(2 * (m + k));
                input.extend((0..m).map(|c| {
                    Dual(
                        self.d0[link.first + c]
                            + x[i * l + link.first + c]
                            + offset[link.first + c],
                        0.0,
                    )
                }));
                input.extend(
                    (0..m).map(|c| Dual(rate(link.first + c) + offset_v[link.first + c], 0.0)),
                );
                input.extend((0..k).map(|c| Dual(x[3 * l + i * nz + first + c], 0.0)));
                input.extend((0..k).map(|c| Dual(own_rate(first + c), 0.0)));
                let (mut f, mut g) = (vec![Dual::default(); m], vec![Dual::default(); k]);
                let count = if tangents { input.len() } else { 1 };
                for seed in 0..count {
                    if tangents {
                        input.iter_mut().for_each(|x| x.1 = 0.0);
                        input[seed].1 = 1.0;
                    }
                    let (d, rest) = input.split_at(m);
                    let (v, rest) = rest.split_at(m);
                    let (z, w) = rest.split_at(k);
                    link.law.answer(
                        &At { d, v, z, w, still: p.still, creep: p.creep },
                        &mut f,
                        &mut g,
                    );
                    if tangents {
                        let (kind, place) = match seed {
                            s if s < m => (0, link.first + s),
                            s if s < 2 * m => (1, link.first + s - m),
                            s if s < 2 * m + k => (2, first + s - 2 * m),
                            s => (3, first + s - 2 * m - k),
                        };
                        for c in 0..m {
                            out.f_by[i][kind][(link.first + c, place)] = f[c].1;
                        }
                        for c in 0..k {
                            out.g_by[i][kind][(first + c, place)] = g[c].1;
                        }
                    }
                }
                for c in 0..m {
                    out.f[i][link.first + c] = f[c].0;
                }
                for c in 0..k {
                    out.g[i][first + c] = g[c].0;
                }
                first += k;
            }
        }
        out
    }

    fn residual(&self, x: &DVector<f64>, it: &Local) -> DVector<f64> {
        let (l, nz) = (self.d0.len(), self.z0.len());
        let mut extra = DVector::zeros(3 * l);
        for i in 0..3 {
            for c in 0..l {
                extra[i * l + c] = it.f[i][c] - self.p.beside[c] * x[i * l + c];
            }
        }
        let answer = self.big * extra;
        let mut r = DVector::zeros(3 * (l + nz));
        for i in 0..3 {
            for c in 0..l {
                r[i * l + c] = x[i * l + c] - self.y_linear[i][c] + answer[i * l + c];
            }
            for c in 0..nz {
                r[3 * l + i * nz + c] = it.g[i][c];
            }
        }
        r
    }

    fn jacobian(&self, it: &Local) -> DMatrix<f64> {
        let (l, nz) = (self.d0.len(), self.z0.len());
        let n = 3 * (l + nz);
        // Tangents of forces and residuals at all stages by all unknowns.
        let mut by = DMatrix::zeros(n, n);
        for i in 0..3 {
            for j in 0..3 {
                let a = self.tilde[(i, j)];
                let same = if i == j { 1.0 } else { 0.0 };
                let (fd, gd) = (&it.f_by[i], &it.g_by[i]);
                by.view_mut((i * l, j * l), (l, l)).copy_from(&(&fd[0] * same + &fd[1] * a));
                by.view_mut((i * l, 3 * l + j * nz), (l, nz))
                    .copy_from(&(&fd[2] * same + &fd[3] * a));
                by.view_mut((3 * l + i * nz, j * l), (nz, l))
                    .copy_from(&(&gd[0] * same + &gd[1] * a));
                by.view_mut((3 * l + i * nz, 3 * l + j * nz), (nz, nz))
                    .copy_from(&(&gd[2] * same + &gd[3] * a));
            }
        }
        for i in 0..3 {
            for c in 0..l {
                by[(i * l + c, i * l + c)] -= self.p.beside[c];
            }
        }
        let top = self.big * by.rows(0, 3 * l);
        by.rows_mut(0, 3 * l).copy_from(&top);
        for i in 0..3 * l {
            by[(i, i)] += 1.0;
        }
        by
    }

    fn newton(&self, start: DVector<f64>, sizes: &[f64]) -> (Option<Settled>, usize) {
        let l = self.d0.len();
        let mut x = start;
        let mut it = self.laws(&x, true);
        let mut r = self.residual(&x, &it);
        // Residuals of links against deformations, own ones against what they were.
        let mut weight = vec![0.0; x.len()];
        let mut refine = 0;
        for tries in 1..=40 {
            let largest = (0..3 * l).map(|i| sizes[i].max(x[i].abs())).fold(1e-300, f64::max);
            let tolerance: Vec<f64> = (0..x.len())
                .map(|i| ACCURACY * sizes[i].max(x[i].abs()).max(1e-4 * largest))
                .collect();
            let mut j = self.jacobian(&it);
            for i in 0..j.nrows() {
                let size = j.row(i).amax();
                weight[i] = if size > 0.0 { size.recip() } else { 1.0 };
                if i < 3 * l {
                    weight[i] = weight[i].min(1.0);
                }
                j.row_mut(i).scale_mut(weight[i]);
            }
            let b = DVector::from_fn(r.len(), |i, _| -r[i] * weight[i]);
            // Open contacts may leave nothing: the springs beside them hold then.
            let solved = j.lu().solve(&b).filter(|x| x.iter().all(|v| v.is_finite()));
            let step = solved.unwrap_or_else(|| {
                DVector::from_fn(r.len(), |i, _| if i < 3 * l { -r[i] } else { 0.0 })
            });
            let size = |r: &DVector<f64>| {
                (0..r.len()).map(|i| (r[i] * weight[i] / tolerance[i]).powi(2)).sum::<f64>().sqrt()
            };
            let before = size(&r);
            let mut share = 1.0;
            let done = (0..step.len()).all(|i| step[i].abs() <= tolerance[i]);
            loop {
                let next = &x + &step * share;
                let trial = self.laws(&next, true);
                let rest = self.residual(&next, &trial);
                let after = size(&rest);
                if done || after <= before * (1.0 - 0.1 * share) || share < 0.02 || after < 1.0 {
                    (x, it, r) = (next, trial, rest);
                    break;
                }
                share *= 0.5;
            }
            if !x.iter().all(|v| v.is_finite()) {
                return (None, tries);
            }
            if done {
                return (Some((x, it.f)), tries);
            }
            // Rounding: steps that no longer shrink but are small.
            refine += usize::from((0..step.len()).all(|i| step[i].abs() <= 1e3 * tolerance[i]));
            if refine > 4 {
                return (Some((x, it.f)), tries);
            }
        }
        (None, 40)
    }
}

impl Course {
    /// Value of a probe at a time.
    #[must_use]
    pub fn at(&self, probe: usize, t: f64) -> f64 {
        let i = self.pieces.partition_point(|p| p.t + p.h < t).min(self.pieces.len() - 1);
        let p = &self.pieces[i];
        let s = ((t - p.t) / p.h).clamp(0.0, 1.0);
        let q = 6.0_f64.sqrt();
        let nodes = [0.0, (4.0 - q) / 10.0, (4.0 + q) / 10.0, 1.0];
        let values = p.values[probe];
        let from = usize::from(values[0].is_nan());
        let mut sum = 0.0;
        for i in from..4 {
            let mut share = 1.0;
            for j in (from..4).filter(|j| *j != i) {
                share *= (s - nodes[j]) / (nodes[i] - nodes[j]);
            }
            sum += share * values[i];
        }
        sum
    }

    /// Smallest and largest value of a probe between two times.
    #[must_use]
    pub fn span(&self, probe: usize, from: f64, to: f64) -> (f64, f64) {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut add = |x: f64| (low, high) = (low.min(x), high.max(x));
        add(self.at(probe, from));
        add(self.at(probe, to));
        let first = self.pieces.partition_point(|p| p.t + p.h < from);
        for p in self.pieces[first..].iter().take_while(|p| p.t <= to) {
            let q = 6.0_f64.sqrt();
            for (c, x) in [0.0, (4.0 - q) / 10.0, (4.0 + q) / 10.0, 1.0].iter().zip(p.values[probe])
            {
                let t = p.t + c * p.h;
                if (from..=to).contains(&t) && !x.is_nan() {
                    add(x);
                }
            }
        }
        (low, high)
    }
}

impl State {
    /// The start of a problem from rest, or thrown there.
    #[must_use]
    pub fn start(p: &Problem) -> Self {
        let d = &p.a.b * &p.u0;
        let at = |first: usize, count: usize| d.as_slice()[first..first + count].to_vec();
        let links = p.a.links.iter();
        let z: Vec<f64> = links.flat_map(|l| l.law.thrown(&at(l.first, l.axes.len()))).collect();
        Self { u: p.u0.clone(), v: p.v0.clone(), z: z.into() }
    }
}
