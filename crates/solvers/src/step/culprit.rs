//! The law that is to blame: whose answer is no finite number, or changes when it is asked again.

use super::state::State;
use crate::error::{LawFault, SolveError};
use crate::kernel::ForceScale;
use trilith_element::{Answer, Energy, Kinematics, Link};
use trilith_model::Model;
use trilith_system::{Laws, LinkInstance, LinkSet, Panicked, System, blaming, catch};

/// A part of the answer of a law; coordinates and variables are counted in the link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Force(usize),
    Stiffness(usize, usize),
    Damping(usize, usize),
    History(usize),
    Stored,
    Hysteretic,
    Viscous,
}

/// What is wrong with a law.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Wrong {
    NotFinite { quantity: Quantity, value: f64, question: Box<Question> },
    Energies { since: Option<f64>, work: f64, accounted: f64 },
    Changes { coordinate: usize, first: f64, again: f64 },
    Jumps { coordinate: usize, end: f64, start: f64 },
    Panicked(String),
    Failed(String),
}

/// What a law was asked when it had no finite answer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Question {
    d: Vec<f64>,
    v: Vec<f64>,
    d0: Vec<f64>,
    v0: Vec<f64>,
    committed: Vec<f64>,
    dt: f64,
}

impl Question {
    fn of(link: &LinkInstance, from: &State, to: &State, dt: f64) -> Self {
        let own = |x: &[f64]| x[link.range.clone()].to_vec();
        Self {
            d: own(&to.d),
            v: own(&to.v),
            d0: own(&from.d),
            v0: own(&from.v),
            committed: from.history[link.history.clone()].to_vec(),
            dt,
        }
    }

    /// What the law says of it; nothing where that panics.
    fn refusal(&self, element: usize, law: &dyn Link) -> Option<String> {
        let Self { d, v, d0, v0, committed, dt } = self;
        let at = Kinematics::new([d, v], [d0, v0], *dt);
        catch(|| blaming(element, || Answer::refusal(law, &at, committed))).ok().flatten()
    }
}

/// A law with what is wrong with it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Culprit {
    /// Index of the element.
    pub element: usize,
    pub wrong: Wrong,
}

impl From<Panicked> for Culprit {
    fn from(Panicked { element, message, told }: Panicked) -> Self {
        let wrong = if told { Wrong::Failed(message) } else { Wrong::Panicked(message) };
        Self { element, wrong }
    }
}

/// Share of the largest force so far by which a law may answer otherwise when it is asked again: forms of it agree up to
/// rounding.
const SAME: f64 = 1e-6;

/// True where every answer in a state is a finite number: forces, tangents, history, and the energies of the step that
/// led there.
#[inline]
pub(crate) fn is_sound(state: &State, energy: &[Energy]) -> bool {
    let State { f, history, tangents, .. } = state;
    let mut sum = 0.0;
    for all in [f, history, &tangents.k, &tangents.c] {
        sum += sum_of(all);
    }
    for Energy { stored, hysteretic, viscous, .. } in energy {
        sum += stored + hysteretic + viscous;
    }
    // A sum of finite numbers may be too large to be one.
    sum.is_finite() || all_are_finite(state, energy)
}

/// A sum that is a number where all parts are; four parts at a time.
#[inline(always)]
fn sum_of(x: &[f64]) -> f64 {
    let (four, rest) = x.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for x in four {
        for i in 0..4 {
            sums[i] += x[i];
        }
    }
    let [a, b, c, d] = sums;
    rest.iter().sum::<f64>() + ((a + b) + (c + d))
}

#[inline(never)]
fn all_are_finite(state: &State, energy: &[Energy]) -> bool {
    let State { f, history, tangents, .. } = state;
    let arrays = [f, history, &tangents.k, &tangents.c];
    let energies = energy.iter().flat_map(|e| [e.stored, e.hysteretic, e.viscous]);
    arrays.into_iter().flatten().copied().chain(energies).all(f64::is_finite)
}

/// The first link that answers with no finite number although it was asked at one, in a step of `dt` from one state to
/// another; where no energies are given, history and energies are not there yet.
pub(crate) fn not_finite(
    links: &LinkSet,
    (from, state): (&State, &State),
    dt: f64,
    energy: Option<&[Energy]>,
) -> Option<Culprit> {
    links.links.iter().enumerate().find_map(|(i, link)| {
        let asked = |x: &[f64]| x[link.range.clone()].iter().all(|x| x.is_finite());
        // A state that no step has led to has no room for answers.
        if state.d.len() != links.len() || !asked(&state.d) || !asked(&state.v) {
            return None;
        }
        let (quantity, value) = first_in(link, state, energy.map(|energy| &energy[i]))?;
        let question = Box::new(Question::of(link, from, state, dt));
        let wrong = Wrong::NotFinite { quantity, value, question };
        Some(Culprit { element: link.element, wrong })
    })
}

fn first_in(
    link: &LinkInstance,
    state: &State,
    energy: Option<&Energy>,
) -> Option<(Quantity, f64)> {
    let n = link.range.len();
    let bad = |x: &[f64]| -> Option<(usize, f64)> {
        x.iter().copied().enumerate().find(|(_, x)| !x.is_finite())
    };
    let State { f, history, tangents, .. } = state;
    let square = |of: fn(usize, usize) -> Quantity, x: &[f64]| {
        bad(&x[link.block.clone()]).map(|(i, x)| (of(i / n, i % n), x))
    };
    let of_step = |Energy { stored, hysteretic, viscous, .. }: &Energy| {
        let energies = [
            (Quantity::Stored, *stored),
            (Quantity::Hysteretic, *hysteretic),
            (Quantity::Viscous, *viscous),
        ];
        let history = bad(&history[link.history.clone()]).map(|(i, x)| (Quantity::History(i), x));
        history.or_else(|| energies.into_iter().find(|(_, x)| !x.is_finite()))
    };
    bad(&f[link.range.clone()])
        .map(|(i, x)| (Quantity::Force(i), x))
        .or_else(|| square(Quantity::Stiffness, &tangents.k))
        .or_else(|| square(Quantity::Damping, &tangents.c))
        .or_else(|| energy.and_then(of_step))
}

/// Forces of all laws for a question.
fn forces(laws: &Laws<'_>, links: &LinkSet, at: Kinematics<'_>, history: &[f64]) -> Vec<f64> {
    let (mut f, mut tangents) = (vec![0.0; links.len()], links.tangents());
    let mut trial = vec![f64::NAN; links.history_len];
    let mut energy = vec![Energy::default(); links.links.len()];
    laws.respond(at, history, &mut trial, &mut f, &mut tangents, &mut energy);
    f
}

/// Asks all laws again what they answered in a step from one state to another of `dt`, and what they answer right after
/// the start of the next: the first that differs by more than what forms of a law differ by.
pub(crate) fn asked_again(
    laws: &Laws<'_>,
    links: &LinkSet,
    from: &State,
    to: &State,
    dt: f64,
) -> Option<Culprit> {
    let State { d, v, .. } = to;
    look_away(laws, links, from);
    let at = Kinematics::new([d, v], [&from.d, &from.v], dt);
    let again = forces(laws, links, at, &from.history);
    let changed = other(links, &to.scale, &to.f, &again, changes);
    changed.or_else(|| {
        let at = Kinematics::still(d, v);
        let start = forces(laws, links, at, &to.history);
        let jumps = |coordinate, end, start| Wrong::Jumps { coordinate, end, start };
        other(links, &to.scale, &to.f, &start, jumps)
    })
}

/// The first law that answers otherwise when it is asked the same twice, where steps find no equilibrium or no end.
pub(crate) fn asked_twice(laws: &Laws<'_>, links: &LinkSet, at: &State) -> Option<Culprit> {
    let State { d, v, history, scale, .. } = at;
    let ask = || forces(laws, links, Kinematics::still(d, v), history);
    let once = ask();
    look_away(laws, links, at);
    other(links, scale, &once, &ask(), changes)
}

/// Asks about deformations the other way: a law that remembers what it was asked is another one then.
fn look_away(laws: &Laws<'_>, links: &LinkSet, at: &State) {
    let State { d, v, history, .. } = at;
    let away: Vec<f64> = d.iter().map(|d| -d).collect();
    forces(laws, links, Kinematics::new([&away, v], [d, v], 0.0), history);
}

fn changes(coordinate: usize, first: f64, again: f64) -> Wrong {
    Wrong::Changes { coordinate, first, again }
}

/// The first link whose forces are others than before.
fn other(
    links: &LinkSet,
    scale: &ForceScale,
    before: &[f64],
    now: &[f64],
    wrong: impl Fn(usize, f64, f64) -> Wrong,
) -> Option<Culprit> {
    let differ = |i: &usize| {
        let size = scale[usize::from(links.rotational[*i] && links.turns)];
        (before[*i] - now[*i]).abs() > SAME * size.max(before[*i].abs())
    };
    links.links.iter().find_map(|link| {
        let i = link.range.clone().find(differ)?;
        let wrong = wrong(i - link.range.start, before[i], now[i]);
        Some(Culprit { element: link.element, wrong })
    })
}

impl Culprit {
    /// Name of the link, and what is wrong, in words.
    pub(crate) fn named(&self, model: &Model, system: &System) -> (String, LawFault) {
        let Self { element, wrong } = self;
        let links = &system.links;
        let link = links.links.iter().find(|link| link.element == *element);
        let law = link.and_then(|link| links.law(model, link));
        let axis = |i: &usize| link.map_or_else(String::new, |l| links.coordinate(model, l, *i));
        let force = |i: &usize| format!("force of {}", axis(i));
        let tangent = |by: &str, i: &usize, j: &usize| {
            format!("tangent ∂f/∂{by} of {} by {}", axis(i), axis(j))
        };
        let fault = match wrong {
            Wrong::NotFinite { quantity, value, question } => {
                let quantity = match quantity {
                    Quantity::Force(i) => force(i),
                    Quantity::Stiffness(i, j) => tangent("d", i, j),
                    Quantity::Damping(i, j) => tangent("ḋ", i, j),
                    Quantity::History(i) => {
                        let fields = law.map(|law| law.history().into_owned()).unwrap_or_default();
                        let name = fields.get(*i).map(|field| field.name.clone());
                        format!("history `{}`, if it was written,", name.unwrap_or_default())
                    }
                    Quantity::Stored => "stored energy".into(),
                    Quantity::Hysteretic => "hysteretic energy".into(),
                    Quantity::Viscous => "viscous energy".into(),
                };
                let blind = law.is_some_and(|law| !law.uses_rates()) && value.is_nan();
                match law.and_then(|law| question.refusal(*element, law)) {
                    Some(why) => LawFault::Refuses { quantity, why },
                    None => LawFault::NotFinite { quantity, value: *value, without_rates: blind },
                }
            }
            Wrong::Energies { since, work, accounted } => {
                LawFault::Energies { since: *since, work: *work, accounted: *accounted }
            }
            Wrong::Changes { coordinate, first, again } => {
                LawFault::Changes { quantity: force(coordinate), first: *first, again: *again }
            }
            Wrong::Jumps { coordinate, end, start } => {
                LawFault::Jumps { quantity: force(coordinate), end: *end, start: *start }
            }
            Wrong::Panicked(message) => LawFault::Panicked { message: message.clone() },
            Wrong::Failed(message) => LawFault::Failed { message: message.clone() },
        };
        (model.elements[*element].name.clone(), fault)
    }

    /// An error where no time goes on; `when`: such as `at the start of case "shake"`.
    pub(crate) fn error(&self, model: &Model, system: &System, when: String) -> SolveError {
        let (link, fault) = self.named(model, system);
        SolveError::Law { link, fault, when, span: model.elements[self.element].span.clone() }
    }
}
