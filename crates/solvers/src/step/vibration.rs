//! What vibrations do to links inside the steps of FNA.
//!
//! A step is as long as it likes for the structure: modes are exact. Links are evaluated at its ends only. Where a mode
//! swings faster than the steps, link forces that follow it are anybody's guess between them, and a step of about a
//! whole number of periods looks smooth, in one as in halves. So links are evaluated inside:
//!
//! ```text
//! A_j = |q − s/ω², (q̇ − ṡ/ω²)/ω|    swing of mode j about what moves it slowly, of energy ½ ω_j² A_j², at either end
//! δ(t) = f̃(d(t), ḋ(t)) − (f̃₀ + (f̃₁ − f̃₀) t/Δt)      d(t) = B q(t) in closed form
//! E = ½ Σ_j |∫ (B Φ)ⱼᵀ δ e^{−iω_j t} dt|²             energy of the motion that δ would have added
//! ```
//!
//! In this order, each only where the one before says that it may matter: the energy of what swings too fast; the laws at
//! the ends of that swing; the integral.

use super::state::State;
use crate::kernel::LawResponse;
use crate::modal::ClosedForm;
use crate::structure::ReducedSystem;
use trilith_element::{Kinematics, Link};
use trilith_system::{Laws, LinkInstance, LinkSet};

/// ω Δt up to which the ends of a step show how a mode swings.
const SHORT: f64 = 0.78;
/// Evaluations inside a step, at least and at most; an odd number, which no period divides.
const FEWEST: usize = 5;
const MOST: usize = 31;
/// Share of the energy of all that swings below which a mode need not be followed.
const FEW: f64 = 1e-3;
/// ω Δt of a part up to which an integral over parts is one.
const RESOLVED: f64 = 2.0;

/// A step that was made.
pub(super) struct Made<'a> {
    pub laws: &'a Laws<'a>,
    pub links: &'a LinkSet,
    pub space: &'a ReducedSystem,
    /// Flat link coordinates with an effective stiffness, and that.
    pub effective: &'a [(usize, f64)],
    /// Deformations that moving supports give the links at both ends, flat.
    pub supports: Option<[&'a [f64]; 2]>,
    pub from: &'a State,
    pub to: &'a State,
    /// Its length, s.
    pub dt: f64,
}

/// Evaluates links inside the steps of FNA.
pub(super) struct Vibration {
    form: ClosedForm,
    fastest: f64,
    /// (mode, swing) of those that swing too fast, and their energy, J.
    swing: Vec<(usize, f64)>,
    energy: f64,
    answer: LawResponse,
}

impl Vibration {
    pub(crate) fn new(form: ClosedForm) -> Self {
        let fastest = form.omega.iter().copied().fold(0.0, f64::max);
        Self { form, fastest, swing: Vec::new(), energy: 0.0, answer: LawResponse::default() }
    }

    /// Energy of what the link forces of a step miss inside it, J; nothing where that cannot be more than `notable`.
    pub(crate) fn missed(&mut self, step: &Made<'_>, notable: f64) -> f64 {
        if self.fastest * step.dt <= SHORT
            || !self.swings(step, notable)
            || !self.laws_notice(step, notable)
        {
            return 0.0;
        }
        self.integral(step)
    }

    /// True where what swings too fast is notable.
    fn swings(&mut self, step: &Made<'_>, notable: f64) -> bool {
        let Made { from, to, dt, .. } = step;
        self.energy = 0.0;
        self.swing.clear();
        for (j, w) in self.form.omega.iter().enumerate().filter(|(_, w)| **w * dt > SHORT) {
            let swing = self.form.swing_square(j, &from.motion, &to.motion, *dt).sqrt();
            self.energy += 0.5 * (w * swing).powi(2);
            self.swing.push((j, swing));
        }
        self.energy > notable
    }

    /// True where the laws, at either end of the swing about where either end of the step would be without it, do work on
    /// it that is notable: what moves slowly may carry a link away within the step.
    fn laws_notice(&mut self, step: &Made<'_>, notable: f64) -> bool {
        let Made { laws, links, space, from, to, dt, .. } = step;
        let mut reach = vec![[0.0; 2]; links.len()];
        // What the swing itself is at both ends of the step.
        let mut own = [vec![[0.0; 2]; links.len()], vec![[0.0; 2]; links.len()]];
        for (a, flat) in links.active.iter().enumerate() {
            let [d, v] = &mut reach[*flat];
            let row = space.links.row(a).collect::<Vec<_>>();
            for (j, swing) in &self.swing {
                let share = row[*j].1;
                let by = share.abs() * swing;
                *d += by;
                *v += by * self.form.omega[*j];
                let ends = self.form.swinging(*j, &from.motion, &to.motion, *dt);
                for (own, [q, p]) in own.iter_mut().zip(ends) {
                    own[*flat][0] += share * q;
                    own[*flat][1] += share * p;
                }
            }
        }
        let noticed = |(law, link): (&dyn Link, &LinkInstance)| {
            let r = link.range.clone();
            let reach = &reach[r.clone()];
            if reach.iter().all(|[d, _]| *d == 0.0) {
                return false;
            }
            let sides = [(*from, 0, -1.0), (*from, 0, 1.0), (*to, 1, -1.0), (*to, 1, 1.0)];
            sides.into_iter().any(|(state, end, side)| {
                let (d0, v0) = (&state.d[r.clone()], &state.v[r.clone()]);
                let there = |x: &[f64], kind: usize| -> Vec<f64> {
                    let swings = reach.iter().zip(&own[end][r.clone()]);
                    let moved = x.iter().zip(swings);
                    moved.map(|(x, (most, own))| x - own[kind] + side * most[kind]).collect()
                };
                let (d, v) = (there(d0, 0), there(v0, 1));
                let at = Kinematics::new([&d, &v], [d0, v0], 0.0);
                self.answer.of((law, link), &at, &state.history[link.history.clone()]);
                let work = (0..r.len()).map(|i| {
                    let change = self.answer.f[i] - state.f[r.start + i];
                    let of_effective = step.effective_k(r.start + i) * (d[i] - d0[i]);
                    (change - of_effective).abs() * reach[i][0]
                });
                work.sum::<f64>() > notable
            })
        };
        let mut laws = laws.iter().filter(|(law, _)| law.damping_constant().is_none());
        laws.any(noticed)
    }

    /// Energy of what the link forces between the ends add to those that are linear in the step, J.
    fn integral(&mut self, step: &Made<'_>) -> f64 {
        let Made { laws, links, space, from, to, dt, .. } = step;
        let swinging = self.swing.iter().map(|(j, swing)| (self.form.omega[*j], swing));
        let swinging = swinging.filter(|(w, x)| 0.5 * (w * *x).powi(2) > FEW * self.energy);
        let fastest = swinging.map(|(w, _)| w).fold(0.0, f64::max);
        let parts = ((fastest * dt / SHORT).ceil() as usize).max(FEWEST) | 1;
        if parts > MOST {
            // A touch may lie between the looks: shorter steps will show it.
            return self.energy;
        }
        let inside = self.form.inside(&from.motion, &to.motion, *dt, parts);
        if inside.is_empty() {
            // Nobody knows what is inside.
            return self.energy;
        }
        let part = dt / parts as f64;
        let (n, active) = (space.order(), space.links.len());
        let mut history = from.history.clone();
        let (mut d0, mut v0) = (from.d.clone(), from.v.clone());
        let (mut d, mut v) = (d0.clone(), v0.clone());
        let (mut of_motion, mut of_rates) = (vec![0.0; active], vec![0.0; active]);
        let (mut missed, mut spread) = (vec![0.0; active], vec![0.0; n]);
        let mut kicks = vec![[0.0; 2]; self.form.omega.len()];
        for (i, motion) in inside.iter().enumerate() {
            let share = (i + 1) as f64 / parts as f64;
            step.of_supports(share, &mut d, &mut v);
            space.links.deform(&motion[..n], &mut of_motion);
            space.links.deform(&motion[n..2 * n], &mut of_rates);
            for (a, flat) in links.active.iter().enumerate() {
                d[*flat] += of_motion[a];
                v[*flat] += of_rates[a];
            }
            missed.fill(0.0);
            for (law, link) in laws.iter().filter(|(law, _)| law.damping_constant().is_none()) {
                let r = link.range.clone();
                let at = Kinematics::new(
                    [&d[r.clone()], &v[r.clone()]],
                    [&d0[r.clone()], &v0[r.clone()]],
                    part,
                );
                self.answer.of((law, link), &at, &history[link.history.clone()]);
                history[link.history.clone()].copy_from_slice(&self.answer.history);
                for (i, f) in r.zip(&self.answer.f) {
                    let way = d[i] - (from.d[i] + share * (to.d[i] - from.d[i]));
                    let linear = from.f[i] + share * (to.f[i] - from.f[i]);
                    if let Ok(a) = links.active.binary_search(&i) {
                        missed[a] = f - linear - step.effective_k(i) * way;
                    }
                }
            }
            space.links.spread_into(&missed, &mut spread);
            let t = share * dt;
            for ((kick, s), w) in kicks.iter_mut().zip(&spread).zip(&self.form.omega) {
                if w * part < RESOLVED {
                    let (sine, cosine) = (w * t).sin_cos();
                    kick[0] += part * s * cosine;
                    kick[1] += part * s * sine;
                }
            }
            std::mem::swap(&mut d0, &mut d);
            std::mem::swap(&mut v0, &mut v);
        }
        kicks.iter().map(|[a, b]| 0.5 * (a * a + b * b)).sum()
    }
}

impl Made<'_> {
    /// Effective stiffness of a flat link coordinate.
    fn effective_k(&self, flat: usize) -> f64 {
        self.effective.iter().find(|(i, _)| *i == flat).map_or(0.0, |(_, k)| *k)
    }

    /// What moving supports give the links after a share of the step.
    fn of_supports(&self, share: f64, d: &mut [f64], v: &mut [f64]) {
        let Some([start, end]) = self.supports else {
            d.fill(0.0);
            v.fill(0.0);
            return;
        };
        for (i, (a, b)) in start.iter().zip(end).enumerate() {
            d[i] = a + share * (b - a);
            v[i] = (b - a) / self.dt;
        }
    }
}
