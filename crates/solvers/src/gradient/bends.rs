//! Where laws are bent: at a value that a parameter moves to both sides of, there is no derivative but one to each.
//!
//! ```text
//! |f(s + ε) − 2 f(s) + f(s − ε)|  against  |f(s + ε) − f(s)| + |f(s) − f(s − ε)|        ε: a millionth of the parameters
//! ```
//!
//! of the state s at the end of a substep, along the derivatives by all parameters at once, with signs in turn: a smooth law makes the left side as
//! small as ε². Substeps that bracket an event are too short to matter and are not looked at.

use super::laws::Made;
use crate::kernel::LawResponse;
use crate::step::State;
use trilith_element::Kinematics;
use trilith_model::Model;
use trilith_system::LinkSet;

/// Share of the parameters by which states are moved.
const MOVED: f64 = 1e-6;
/// Change of the slope, as share of it, that is a bend.
const BENT: f64 = 1e-2;
/// Forces below this share of the largest of a link are rounding.
const ROUNDING: f64 = 1e-11;
/// Shortest substeps that matter, as share of the output step.
const SHORT: f64 = 1e-3;

/// A link whose law bends where substeps have ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Bend {
    /// Name of the link.
    pub link: String,
    /// When first, s.
    pub t: f64,
    /// At the ends of how many substeps.
    pub count: usize,
}

/// Looks for them.
#[derive(Default)]
pub(super) struct Bends {
    /// Of each link: when first, and how often.
    found: Vec<(f64, usize)>,
    most: Vec<f64>,
    response: LawResponse,
}

impl Bends {
    /// Looks at a substep to `t`; `moves` and `next`: derivatives at both its ends, `values`: those of the parameters.
    pub(super) fn look(
        &mut self,
        model: &Model,
        links: &LinkSet,
        (made, t): (Made<'_>, f64),
        [moves, next]: [&[State]; 2],
        values: &[f64],
    ) {
        let Self { found, most, response } = self;
        found.resize(links.links.len(), (0.0, 0));
        most.resize(links.links.len(), 0.0);
        let Made { from, to, dt } = made;
        let all = links.laws(model);
        for (l, (law, link)) in all.iter().enumerate() {
            let (r, h) = (link.range.clone(), link.history.clone());
            let along = |of: &[State], x: fn(&State) -> &[f64], at: usize| -> f64 {
                let signed = of.iter().zip(values).enumerate();
                let part = |(j, (s, value)): (usize, (&State, &f64))| {
                    let own = x(s)[at] * value;
                    if j % 2 == 0 { own } else { -own }
                };
                signed.map(part).sum()
            };
            let mut at = |s: f64| {
                let part = |x: &[f64], of: &[State], get: fn(&State) -> &[f64], at| {
                    let by = along(of, get, at);
                    // What does not move stays to the bit, marks of regimes among it.
                    if by == 0.0 { x[at] } else { x[at] + s * by }
                };
                let d: Vec<f64> = r.clone().map(|i| part(&to.d, next, |s| &s.d, i)).collect();
                let v: Vec<f64> = r.clone().map(|i| part(&to.v, next, |s| &s.v, i)).collect();
                let d0: Vec<f64> = r.clone().map(|i| part(&from.d, moves, |s| &s.d, i)).collect();
                let v0: Vec<f64> = r.clone().map(|i| part(&from.v, moves, |s| &s.v, i)).collect();
                let before = h.clone().map(|i| part(&from.history, moves, |s| &s.history, i));
                let history: Vec<f64> = before.collect();
                let at = Kinematics::new([&d, &v], [&d0, &v0], dt);
                response.of((law, link), &at, &history);
                response.f.clone()
            };
            let [low, here, high] = [at(-MOVED), at(0.0), at(MOVED)];
            let mut bent = [0.0_f64; 2];
            for i in 0..here.len() {
                most[l] = most[l].max(here[i].abs());
                bent[0] = bent[0].max((high[i] - 2.0 * here[i] + low[i]).abs());
                bent[1] = bent[1].max((high[i] - here[i]).abs() + (here[i] - low[i]).abs());
            }
            if bent[0] > BENT * bent[1] && bent[0] > ROUNDING * most[l] {
                let (first, count) = &mut found[l];
                if *count == 0 {
                    *first = t;
                }
                *count += 1;
            }
        }
    }

    /// True for a substep that is long enough to matter in an output step.
    pub(super) fn matters(dt: f64, output: f64) -> bool {
        dt >= SHORT * output
    }

    /// What was found.
    pub(super) fn told(&self, model: &Model, links: &LinkSet) -> Vec<Bend> {
        let all = links.links.iter().zip(&self.found).filter(|(_, (_, count))| *count > 0);
        let told = |(link, (t, count)): (&trilith_system::LinkInstance, &(f64, usize))| Bend {
            link: model.elements[link.element].name.clone(),
            t: *t,
            count: *count,
        };
        all.map(told).collect()
    }
}
