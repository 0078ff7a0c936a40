//! The march of a dynamic case through its output steps, and what goes on beside it in threads of its own.

use super::companion::Companion;
use super::start::Start;
use crate::certificate::{Certificate, Listener, OutputError, Samples};
use crate::error::SolveError;
use crate::march::{March, Moment, Moving, Stop, Timeline, output_step};
use crate::platform::HAS_THREADS;
use crate::record::{Ledger, Viewer};
use crate::step::{State, Stepper};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use trilith_model::Model;
use trilith_system::catch;

/// The output steps of a run.
pub(super) struct Course<'a> {
    pub timeline: &'a Timeline,
    pub steps: Range<usize>,
    /// Constant loads in the coordinates of the solver.
    pub constant: &'a [f64],
}

/// What is told of a run while it goes on, and may end it.
pub(super) struct Watch<'w, 'a, 'b, 'c, 'p> {
    pub viewer: &'w mut Viewer<'a, 'b>,
    pub certificate: Option<&'w mut Certificate<'c>>,
    /// Receives the finished share of the run.
    pub progress: Option<&'p mut dyn FnMut(f64)>,
    pub interrupt: Option<&'p AtomicBool>,
}

/// What goes on in threads of its own.
pub(super) struct Beside<'w, 'a> {
    pub companion: Option<&'w Companion<'a>>,
    /// The wider structure.
    pub listener: Option<Listener<'w>>,
    /// Number of outputs.
    pub outputs: usize,
}

/// How a march ended.
pub(super) struct Ended {
    pub stop: Option<Stop>,
    /// Index of the element of a body that has fallen over.
    pub fallen: Option<usize>,
    pub interrupted: bool,
    /// Output steps made since the start of the case.
    pub made: usize,
}

/// Marches through the output steps. A law that panics ends it.
fn march_through(
    course: &Course<'_>,
    march: &mut March<'_>,
    moving: &mut Moving,
    watch: &mut Watch<'_, '_, '_, '_, '_>,
) -> Ended {
    let first = course.steps.start;
    let mut ended = Ended { stop: None, fallen: None, interrupted: false, made: first };
    let whole = catch(|| march_on(course, march, moving, watch, &mut ended));
    if let Err(panicked) = whole {
        ended.stop = Some(Stop::Law { t: march.at, culprit: panicked.into() });
    }
    ended
}

/// The same, as far as laws answer.
fn march_on(
    course: &Course<'_>,
    march: &mut March<'_>,
    moving: &mut Moving,
    watch: &mut Watch<'_, '_, '_, '_, '_>,
    ended: &mut Ended,
) {
    let Course { timeline, steps, constant } = course;
    let Watch { viewer, certificate, progress, interrupt } = watch;
    let (first, last) = (steps.start, steps.end);
    for step in steps.clone() {
        let end = timeline.time(step + 1) - 1e-12 * timeline.dt;
        let mut report = |moment: Moment, t: f64, s: &State, l: &Ledger| match moment {
            Moment::Jump => {
                if let Some(certificate) = certificate {
                    certificate.jump(t, s);
                }
                viewer.show_behind(t, s, l);
            }
            Moment::Substep(segment) => {
                if let Some(certificate) = certificate {
                    certificate.follow(segment, t, s);
                }
                if t < end {
                    viewer.show(t, None, s, l);
                }
            }
        };
        let made = output_step(timeline, step, march, constant, moving, &mut report);
        let Moving { state, ledger, .. } = &*moving;
        let asked = made.and_then(|()| {
            let t = timeline.time(step + 1);
            if (step + 1 - first).is_power_of_two() {
                march.ask_again(state, t)?;
            }
            march.look(state, t)
        });
        if let Err(stop) = asked {
            ended.stop = Some(stop);
            break;
        }
        ended.made = step + 1;
        viewer.show(timeline.time(ended.made), Some(ended.made), state, ledger);
        if let Some(report) = progress.as_deref_mut() {
            report((ended.made - first) as f64 / (last - first) as f64);
        }
        ended.fallen = viewer.overturned(state);
        ended.interrupted =
            ended.made < last && interrupt.is_some_and(|i| i.load(Ordering::Relaxed));
        if ended.fallen.is_some() || ended.interrupted {
            break;
        }
    }
}

/// The march, and beside it, in threads of their own, its companion and the wider structure. Returns what the companion
/// has come to.
pub(super) fn march_beside<'a>(
    course: Course<'_>,
    march: &mut March<'_>,
    moving: &mut Moving,
    mut watch: Watch<'_, '_, '_, '_, '_>,
    beside: Beside<'_, 'a>,
    set_out: &(impl Fn(&mut dyn Stepper) -> Result<Start, SolveError> + Sync),
) -> (Ended, Option<Samples<'a>>) {
    let Beside { companion, listener, outputs } = beside;
    let mut through = || {
        let ended = march_through(&course, march, moving, &mut watch);
        if let Some(companion) = companion {
            companion.end(ended.made);
        }
        if let Some(certificate) = &mut watch.certificate {
            certificate.end();
        }
        ended
    };
    let (ended, found, reduction) = if HAS_THREADS {
        std::thread::scope(|scope| {
            let found = companion.map(|companion| scope.spawn(|| companion.march(set_out)));
            let shadow = listener.map(|listener| scope.spawn(move || listener.follow(outputs)));
            let ended = through();
            let found = found.and_then(|thread| thread.join().ok());
            (ended, found, shadow.map(|thread| thread.join().ok()))
        })
    } else {
        let ended = through();
        let found = companion.map(|companion| companion.march(set_out));
        (ended, found, listener.map(|listener| Some(listener.follow(outputs))))
    };
    // Where the companion finds no start, the run finds none either.
    let found = found.and_then(Result::ok);
    if let (Some(certificate), Some(reduction)) = (watch.certificate, reduction) {
        certificate.reduce(reduction);
    }
    (ended, found)
}

/// The errors of the outputs by what a companion has found. One that may have come out near by chance is followed by a
/// second one.
pub(super) fn output_errors(
    certificate: &Certificate<'_>,
    companion: Option<&Companion<'_>>,
    found: Option<Samples<'_>>,
    model: &Model,
    duration: f64,
    set_out: &dyn Fn(&mut dyn Stepper) -> Result<Start, SolveError>,
) -> Vec<OutputError> {
    let mut found: Vec<Samples<'_>> = found.into_iter().collect();
    let errors = certificate.errors(model, &found, duration);
    if let Some(companion) = companion
        && certificate.is_unsure(model, &errors)
        && let Ok(second) = companion.second().march(set_out)
        // One that has broken off says nothing.
        && found.iter().all(|first| second.reach(first))
    {
        found.push(second);
        return certificate.errors(model, &found, duration);
    }
    errors
}
