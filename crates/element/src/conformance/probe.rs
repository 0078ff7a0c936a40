//! Questions to a law and its answers.

use super::path::Path;
use crate::{Energy, Kinematics, Link, Response};

/// Everything that a law answered.
#[derive(Clone)]
pub(super) struct Answer {
    pub(super) f: Vec<f64>,
    pub(super) k: Vec<f64>,
    pub(super) c: Vec<f64>,
    pub(super) energy: Energy,
    pub(super) trial: Vec<f64>,
}

impl Answer {
    /// Its parts by name.
    pub(super) fn parts(&self) -> [(&'static str, Vec<f64>); 5] {
        let e = self.energy;
        [
            ("f", self.f.clone()),
            ("k", self.k.clone()),
            ("c", self.c.clone()),
            ("energy", vec![e.stored, e.hysteretic, e.viscous]),
            ("trial", self.trial.clone()),
        ]
    }
}

/// Asks once. The trial is full of NaN before, so that what was not written shows.
pub(super) fn ask(link: &dyn Link, at: &Kinematics<'_>, committed: &[f64]) -> Answer {
    let n = at.d.len();
    let mut answer = Answer {
        f: vec![0.0; n],
        k: vec![0.0; n * n],
        c: vec![0.0; n * n],
        energy: Energy::default(),
        trial: vec![f64::NAN; committed.len()],
    };
    let mut out = Response {
        f: &mut answer.f,
        k: &mut answer.k,
        c: &mut answer.c,
        energy: &mut answer.energy,
    };
    link.respond(at, committed, &mut answer.trial, &mut out);
    answer
}

/// History of a link before anything has happened.
pub(super) fn rest(link: &dyn Link) -> Vec<f64> {
    let mut history = vec![0.0; link.history().len()];
    link.at_rest(&mut history);
    history
}

/// One step of a march.
pub(super) struct Step<'a> {
    pub(super) time: f64,
    pub(super) at: Kinematics<'a>,
    pub(super) committed: &'a [f64],
    pub(super) answer: &'a Answer,
    /// Answer at the end of the step before.
    pub(super) before: &'a Answer,
}

/// Leads a law along a path, `steps` a cycle, and shows every step to `look`.
pub(super) fn march<E>(
    link: &dyn Link,
    path: &Path,
    cycles: usize,
    steps: usize,
    mut look: impl FnMut(&Step<'_>) -> Result<(), E>,
) -> Result<(), E> {
    let dt = path.period() / steps as f64;
    let mut history = rest(link);
    let (mut d0, mut v0) = path.at(0.0);
    let start = Kinematics { d: &d0, v: &v0, d0: &d0, v0: &v0, dt: 0.0 };
    let mut before = ask(link, &start, &history);
    for number in 0..cycles * steps {
        let time = (number + 1) as f64 * dt;
        let (d, v) = path.at(time);
        let at = Kinematics { d: &d, v: &v, d0: &d0, v0: &v0, dt };
        let answer = ask(link, &at, &history);
        look(&Step { time, at, committed: &history, answer: &answer, before: &before })?;
        history.clone_from(&answer.trial);
        before = answer;
        (d0, v0) = (d, v);
    }
    Ok(())
}
