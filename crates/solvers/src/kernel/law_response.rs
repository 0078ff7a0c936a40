//! The response of one law, evaluated beside the march.

use trilith_element::{Energy, Kinematics, Link, Response};
use trilith_system::{LinkInstance, blaming};

/// Forces, tangents, history and energies of one link, kept so that an evaluation allocates nothing.
#[derive(Default)]
pub(crate) struct LawResponse {
    pub f: Vec<f64>,
    pub k: Vec<f64>,
    pub c: Vec<f64>,
    pub history: Vec<f64>,
    pub energy: Energy,
    /// What a law that does not look at rates gets for them.
    none: Vec<f64>,
}

impl LawResponse {
    /// Evaluates a law at a motion, from a committed history.
    pub(crate) fn of(
        &mut self,
        (law, link): (&dyn Link, &LinkInstance),
        at: &Kinematics<'_>,
        committed: &[f64],
    ) {
        let n = at.d.len();
        let Self { f, k, c, history, energy, none } = self;
        *energy = Energy::default();
        for (x, n) in [(&mut *f, n), (&mut *k, n * n), (&mut *c, n * n)] {
            x.clear();
            x.resize(n, 0.0);
        }
        history.clear();
        history.extend_from_slice(committed);
        let mut at = *at;
        if !law.uses_rates() {
            none.clear();
            none.resize(n, f64::NAN);
            (at.v, at.v0) = (&none[..], &none[..]);
        }
        let out = &mut Response::new(f, k, c, energy);
        blaming(link.element, || law.respond(&at, committed, history, out));
    }
}
