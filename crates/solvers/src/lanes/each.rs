//! A law that is asked for one lane after the other.

use super::form::{Form, Law};
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use trilith_element::lanes::{Arithmetic, LaneContact, LaneLinks, LaneStep};
use trilith_element::{Answer, Contact, Energy, Kinematics, Link, Response};

/// Lanes at most.
const LANES: usize = super::adaptive::MOST;

/// A number of each lane.
type Lanes = [f64; LANES];

/// Questions between two that are asked twice: seldom enough to cost nothing.
const ASK_EVERY: usize = 4096;

/// A link of each lane. An analysis whose law has no answer is given numbers that are none, so that it is given up: the
/// ordinary engine then says what is wrong with it.
#[derive(Debug)]
pub(super) struct Each {
    links: Vec<Arc<dyn Link>>,
    /// The coordinates that matter.
    coordinates: Vec<usize>,
    room: RefCell<Room>,
}

/// Room for the numbers of all lanes, and for a question to a link and its answer.
#[derive(Debug)]
struct Room {
    /// Deformations and rates at the end and at the start, history, and the step.
    asked: Vec<Lanes>,
    /// Force, tangents, history and energies.
    answered: Vec<Lanes>,
    question: Question,
    answer: Answer,
    contacts: Vec<Contact>,
    questions: usize,
    /// Whose law has panicked: it is not asked again.
    panicked: [bool; LANES],
}

/// What one link is asked about.
#[derive(Debug)]
struct Question {
    /// Deformations and rates at the end and at the start.
    at: [Vec<f64>; 4],
    history: Vec<f64>,
    dt: f64,
}

impl Each {
    pub fn of(forms: &[&Form]) -> Self {
        let law = |form: &&Form| match &form.law {
            Law::One(law) => Some(Arc::clone(law)),
            Law::Over(_) => None,
        };
        let links: Vec<Arc<dyn Link>> = forms.iter().filter_map(law).collect();
        let coordinates = forms[0].coordinates.clone();
        let (n, h, all) = (coordinates.len(), forms[0].extent.history, forms[0].extent.whole);
        let none = |count: usize| vec![0.0; count];
        let room = Room {
            asked: vec![[0.0; LANES]; 4 * n + h + 1],
            answered: vec![[0.0; LANES]; n + 2 * n * n + h + 3],
            question: Question { at: [0; 4].map(|_| none(all)), history: none(h), dt: 0.0 },
            answer: Answer {
                f: none(all),
                k: none(all * all),
                c: none(all * all),
                energy: Energy::default(),
                trial: none(h),
            },
            contacts: Vec::new(),
            questions: 0,
            panicked: [false; LANES],
        };
        Self { links, coordinates, room: RefCell::new(room) }
    }

    /// The lanes, and the link of each; lanes without an analysis repeat the last.
    fn lanes(&self) -> impl Iterator<Item = (usize, usize)> {
        let last = self.links.len() - 1;
        (0..LANES).map(move |lane| (lane, lane.min(last)))
    }

    /// All of the answer.
    #[inline(never)]
    pub fn respond<A: Arithmetic>(
        &self,
        with: A,
        links: &mut LaneLinks<'_, A::Real>,
        step: &mut LaneStep<A::Real>,
    ) {
        let room = &mut *self.room.borrow_mut();
        room.take(with, links);
        room.questions += 1;
        let is_again = room.questions.is_multiple_of(ASK_EVERY);
        for (lane, law) in self.links.iter().enumerate() {
            room.question.of_lane(&self.coordinates, &room.asked, lane, law.uses_rates());
            let Room { question, answer, panicked, .. } = &mut *room;
            let law = law.as_ref();
            let asked =
                || question.ask(law, answer) && (!is_again || question.holds(law, &answer.f));
            let is_sound = guarded(&mut panicked[lane], asked).unwrap_or(false);
            room.give(&self.coordinates, lane, is_sound);
        }
        let last = self.links.len() - 1;
        for all in &mut room.answered {
            let repeated = all[last];
            all[last..].fill(repeated);
        }
        let LaneLinks { f, k, c, trial, .. } = links;
        let to = f.iter_mut().chain(k.iter_mut()).chain(c.iter_mut()).chain(trial.iter_mut());
        let to = to.chain([&mut step.stored, &mut step.hysteretic, &mut step.viscous]);
        for (to, from) in to.zip(&room.answered) {
            *to = with.load(from);
        }
    }

    /// What the contacts do; 1 where a link has overturned, else 0.
    #[inline(never)]
    pub fn contacts<A: Arithmetic>(
        &self,
        with: A,
        links: &LaneLinks<'_, A::Real>,
        out: &mut [LaneContact<A::Real>],
    ) -> A::Real {
        let room = &mut *self.room.borrow_mut();
        room.take(with, links);
        let forces: Vec<Lanes> = links.f.iter().map(|x| lanes_of(with, *x)).collect();
        let mut seen = vec![[Contact::default(); LANES]; out.len()];
        let mut fallen = [0.0; LANES];
        for (lane, link) in self.lanes() {
            let law = self.links[link].as_ref();
            let Room { asked, question, answer, contacts, panicked, .. } = &mut *room;
            question.of_lane(&self.coordinates, asked, link, law.uses_rates());
            answer.f.fill(0.0);
            for (i, all) in self.coordinates.iter().zip(&forces) {
                answer.f[*i] = all[link];
            }
            let at = Kinematics::still(&question.at[0], &question.at[1]);
            contacts.clear();
            let asked = || {
                law.contacts(&at, &question.history, &answer.f, contacts);
                law.overturned(&at, &question.history)
            };
            let has_fallen = guarded(&mut panicked[link], asked).unwrap_or(false);
            fallen[lane] = f64::from(u8::from(has_fallen));
            for (to, contact) in seen.iter_mut().zip(contacts) {
                to[lane] = *contact;
            }
        }
        for (to, seen) in out.iter_mut().zip(&seen) {
            let of = |of: fn(&Contact) -> f64| with.load(&seen.each_ref().map(of));
            *to = LaneContact {
                gap: of(|c| c.gap),
                normal: of(|c| c.normal),
                position: [of(|c| c.position[0]), of(|c| c.position[1])],
                slipping: of(|c| f64::from(u8::from(c.slipping))),
            };
        }
        with.load(&fallen)
    }
}

/// What a law answers; nothing where it panics, now or before.
fn guarded<T>(panicked: &mut bool, ask: impl FnOnce() -> T) -> Option<T> {
    if *panicked {
        return None;
    }
    let answer = catch_unwind(AssertUnwindSafe(ask)).ok();
    *panicked = answer.is_none();
    answer
}

fn lanes_of<A: Arithmetic>(with: A, x: A::Real) -> Lanes {
    let mut all = [0.0; LANES];
    with.store(x, &mut all);
    all
}

impl Room {
    /// Takes the question of all lanes.
    fn take<A: Arithmetic>(&mut self, with: A, links: &LaneLinks<'_, A::Real>) {
        let LaneLinks { d, v, d0, v0, history, dt, .. } = links;
        let asked = [d, v, d0, v0, history, std::slice::from_ref(dt)];
        for (to, from) in self.asked.iter_mut().zip(asked.into_iter().flatten()) {
            with.store(*from, to);
        }
    }

    /// Gives the answer to a lane; where it is not sound, numbers that are none.
    fn give(&mut self, coordinates: &[usize], lane: usize, is_sound: bool) {
        let Answer { f, k, c, energy, trial } = &self.answer;
        let all = f.len();
        let mut places = self.answered.iter_mut();
        let mut put = |x: f64| {
            if let Some(to) = places.next() {
                to[lane] = if is_sound { x } else { f64::NAN };
            }
        };
        coordinates.iter().for_each(|i| put(f[*i]));
        for block in [k, c] {
            for row in coordinates {
                coordinates.iter().for_each(|column| put(block[row * all + column]));
            }
        }
        trial.iter().for_each(|x| put(*x));
        [energy.stored, energy.hysteretic, energy.viscous].into_iter().for_each(put);
    }
}

impl Question {
    /// That of a lane; laws that do not look at rates get none.
    fn of_lane(&mut self, coordinates: &[usize], asked: &[Lanes], lane: usize, rates: bool) {
        let n = coordinates.len();
        for (kind, to) in self.at.iter_mut().enumerate() {
            let is_told = rates || kind % 2 == 0;
            to.fill(if is_told { 0.0 } else { f64::NAN });
            for (i, all) in coordinates.iter().zip(&asked[kind * n..]).filter(|_| is_told) {
                to[*i] = all[lane];
            }
        }
        let rest = &asked[4 * n..];
        for (to, all) in self.history.iter_mut().zip(rest) {
            *to = all[lane];
        }
        self.dt = rest[self.history.len()][lane];
    }

    fn kinematics(&self) -> Kinematics<'_> {
        let [d, v, d0, v0] = &self.at;
        Kinematics::new([d, v], [d0, v0], self.dt)
    }

    /// Asks it of a law; false where something of the answer is no finite number.
    fn ask(&self, law: &dyn Link, answer: &mut Answer) -> bool {
        let Answer { f, k, c, energy, trial } = answer;
        [&mut *f, &mut *k, &mut *c].into_iter().for_each(|x| x.fill(0.0));
        trial.fill(f64::NAN);
        *energy = Energy::default();
        let mut out = Response::new(f, k, c, energy);
        law.respond(&self.kinematics(), &self.history, trial, &mut out);
        let ends = [energy.stored, energy.hysteretic, energy.viscous];
        let mut all = f.iter().chain(&*k).chain(&*c).chain(&*trial).chain(&ends);
        all.all(|x| x.is_finite())
    }

    /// Whether a law answers the same force again, though it was asked something else between.
    fn holds(&self, law: &dyn Link, f: &[f64]) -> bool {
        let Self { at: [d, v, d0, v0], history, dt } = self;
        let ask =
            |d: &[f64], dt: f64| Answer::of(law, &Kinematics::new([d, v], [d0, v0], dt), history);
        let away: Vec<f64> = d.iter().map(|d| -d).collect();
        ask(&away, 0.0);
        ask(d, *dt).f == f
    }
}
