//! The wider structure beside a run, in a thread of its own.
//!
//! It moves under the link forces of the run, and what these would answer to it, and gives nothing back, so the run
//! reports its steps to it, many at a time, and reads at the end what it has found. On two processors the run waits for
//! nothing.

use super::shadow::Shadow;
use crate::platform::HAS_THREADS;
use crate::step::State;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};

/// Steps that are reported at a time, and how often more are reported before the shadow has come to them.
const AT_A_TIME: usize = 64;
const AHEAD: usize = 64;

/// What happens in a run.
enum Event {
    /// A step ends at this time, s; what its links say is among the values of its batch.
    Step(f64),
    /// The loads jump at this time, s.
    Jump(f64),
    /// The outputs have these values in this state.
    Outputs(Vec<f64>, Box<State>),
}

/// What happens in a run one after the other.
#[derive(Default)]
struct Batch {
    events: Vec<Event>,
    /// Pseudo-forces of the steps, and where links answer what they answer by, one after the other.
    links: Vec<f64>,
}

/// How reports go from the run to the shadow.
enum Way {
    /// To a thread beside the run, which waits where the shadow falls behind.
    Beside(SyncSender<Batch>),
    /// All are kept until the run has ended.
    After(Sender<Batch>),
}

/// The end that the run holds.
pub(crate) struct Reporter {
    batch: Batch,
    to: Way,
    /// True where links answer in the shadow.
    answers: bool,
}

/// The end that the shadow holds.
pub(crate) struct Listener<'a> {
    shadow: Shadow<'a>,
    from: Receiver<Batch>,
}

/// Both ends.
pub(crate) fn beside(shadow: Shadow<'_>) -> (Reporter, Listener<'_>) {
    let (to, from) = if HAS_THREADS {
        let (to, from) = sync_channel(AHEAD);
        (Way::Beside(to), from)
    } else {
        let (to, from) = channel();
        (Way::After(to), from)
    };
    let answers = shadow.answers();
    (Reporter { batch: Batch::default(), to, answers }, Listener { shadow, from })
}

impl Reporter {
    /// A step was accepted.
    pub(crate) fn step(&mut self, t: f64, state: &State) {
        let links = &mut self.batch.links;
        links.extend_from_slice(&state.pseudo);
        if self.answers {
            let State { d, v, f, tangents, .. } = state;
            for part in [d, v, f, &tangents.k, &tangents.c] {
                links.extend_from_slice(part);
            }
        }
        self.report(Event::Step(t));
    }

    /// The loads jump.
    pub(crate) fn jump(&mut self, t: f64) {
        self.report(Event::Jump(t));
    }

    /// The outputs of the run are to be compared at the step reported last.
    pub(crate) fn outputs(&mut self, values: &[f64], state: &State) {
        self.report(Event::Outputs(values.to_vec(), Box::new(state.clone())));
    }

    fn report(&mut self, event: Event) {
        self.batch.events.push(event);
        if self.batch.events.len() >= AT_A_TIME {
            self.send();
        }
    }

    fn send(&mut self) {
        // Nobody listens any more where the shadow has broken off: that is seen at the end.
        let batch = std::mem::take(&mut self.batch);
        let _ = match &self.to {
            Way::Beside(to) => to.send(batch),
            Way::After(to) => to.send(batch),
        };
    }
}

impl Drop for Reporter {
    fn drop(&mut self) {
        self.send();
    }
}

impl Listener<'_> {
    /// Follows the run to its end: the largest difference of every output.
    pub(crate) fn follow(mut self, outputs: usize) -> Vec<f64> {
        let mut errors = vec![0.0; outputs];
        for Batch { events, links } in self.from {
            let mut rest = &links[..];
            for event in events {
                match event {
                    Event::Step(t) => {
                        let (links, others) = rest.split_at(self.shadow.report_len());
                        rest = others;
                        self.shadow.follow(t, links);
                    }
                    Event::Jump(t) => self.shadow.jump(t),
                    Event::Outputs(values, state) => {
                        self.shadow.compare(&values, &state, &mut errors);
                    }
                }
            }
        }
        errors
    }
}
