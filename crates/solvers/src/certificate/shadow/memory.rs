//! Links with a memory on the wider structure.
//!
//! What such a link answers to e = d₂ − d is not K e: a damper behind a spring lets go of what the spring took up, and a
//! bearing that yields in the run alone does not. Each keeps a history of its own along d₂, and is linear about the
//! run and what was beyond it a step ago:
//!
//! ```text
//! f₂ = f(d + e₀, ḋ + ė₀; own history) + K (e − e₀) + C (ė − ė₀)
//! ```

use crate::kernel::LawResponse;
use crate::step::State;
use trilith_element::Kinematics;
use trilith_model::Model;
use trilith_system::{Laws, LinkSet, Tangents};

/// The links that have a history.
pub(super) struct Memory<'a> {
    laws: Laws<'a>,
    history: Vec<f64>,
    /// Deformations and rates of the wider structure at the end of the last step, flat, and how far beyond the run.
    at: [Vec<f64>; 2],
    beyond: [Vec<f64>; 2],
    /// Forces there; those of other links are of no use.
    f: Vec<f64>,
    answer: LawResponse,
}

impl<'a> Memory<'a> {
    /// Beside a run that starts from this state.
    pub fn new(model: &'a Model, links: &'a LinkSet, state: &State) -> Self {
        let none = || vec![0.0; state.d.len()];
        Self {
            laws: links.laws(model),
            history: state.history.clone(),
            at: [state.d.clone(), state.v.clone()],
            beyond: [none(), none()],
            f: state.f.clone(),
            answer: LawResponse::default(),
        }
    }

    /// Tangents at the end of a step of the run that ends with these deformations and rates, and the forces there for
    /// e = 0.
    pub fn linear(&mut self, [d, v]: [&[f64]; 2], dt: f64, tangents: &mut Tangents, f: &mut [f64]) {
        let Self { laws, history, at: [d0, v0], beyond: [e, rate], answer, .. } = self;
        for (law, link) in laws.iter().filter(|(_, link)| !link.history.is_empty()) {
            let (r, n) = (link.range.clone(), link.range.len());
            let sum = |x: &[f64], e: &[f64]| -> Vec<f64> {
                x[r.clone()].iter().zip(&e[r.clone()]).map(|(x, e)| x + e).collect()
            };
            let (d, v) = (sum(d, e), sum(v, rate));
            let (d0, v0) = (&d0[r.clone()], &v0[r.clone()]);
            let end = Kinematics::new([&d, &v], [d0, v0], dt);
            answer.of((law, link), &end, &history[link.history.clone()]);
            for (i, flat) in r.clone().enumerate() {
                let row = |x: &[f64], e: &[f64]| -> f64 {
                    x[i * n..][..n].iter().zip(&e[r.clone()]).map(|(x, e)| x * e).sum()
                };
                f[flat] = answer.f[i] - row(&answer.k, e) - row(&answer.c, rate);
            }
            let block = link.block.start..link.block.start + n * n;
            tangents.k[block.clone()].copy_from_slice(&answer.k);
            tangents.c[block].copy_from_slice(&answer.c);
        }
    }

    /// Goes to the end of that step, where the wider structure has these deformations and rates.
    pub fn go_on(&mut self, run: [&[f64]; 2], to: [Vec<f64>; 2], dt: f64) {
        let Self { laws, history, at: [d0, v0], beyond, f, answer } = self;
        for (law, link) in laws.iter().filter(|(_, link)| !link.history.is_empty()) {
            let r = link.range.clone();
            let (d, v) = (&to[0][r.clone()], &to[1][r.clone()]);
            let end = Kinematics::new([d, v], [&d0[r.clone()], &v0[r.clone()]], dt);
            let own = &mut history[link.history.clone()];
            answer.of((law, link), &end, own);
            own.copy_from_slice(&answer.history);
            f[r].copy_from_slice(&answer.f);
        }
        for (beyond, (to, run)) in beyond.iter_mut().zip(to.iter().zip(run)) {
            beyond.iter_mut().zip(to.iter().zip(run)).for_each(|(e, (x2, x))| *e = x2 - x);
        }
        self.at = to;
    }

    /// Puts their forces in the place of those that are there.
    pub fn put(&self, f: &mut [f64]) {
        for (_, link) in self.laws.iter().filter(|(_, link)| !link.history.is_empty()) {
            f[link.range.clone()].copy_from_slice(&self.f[link.range.clone()]);
        }
    }
}
