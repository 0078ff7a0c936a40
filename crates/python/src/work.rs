//! Long work for Python: beside the interpreter, to be interrupted, and never the end of the process.

use crate::failure::Failure;
use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread::Builder;
use std::time::Duration;
use trilith::element::LawFailed;

/// How often signals are looked at, and how long an interrupted worker is waited for: both together are below the tenth of
/// a second in which Ctrl-C is answered.
const TICK: Duration = Duration::from_millis(20);
const GRACE: Duration = Duration::from_millis(40);
/// As much as the main thread of a program has on most systems; threads have less where nobody asks.
const STACK: usize = 8 << 20;

/// What a worker is told, and tells.
#[derive(Default)]
pub(crate) struct Watch {
    /// Somebody wants an end.
    pub interrupt: Arc<AtomicBool>,
    /// The finished share, as the bits of a number.
    share: AtomicU64,
}

impl Watch {
    /// Tells the finished share, 0 … 1.
    pub fn tell(&self, share: f64) {
        self.share.store(share.to_bits(), Ordering::Relaxed);
    }
}

/// Does a job in a thread of its own, without the interpreter's lock.
///
/// # Errors
/// The exception that the failure of the job is; that of a signal, such as `KeyboardInterrupt`: the job is told, and left
/// behind where it does not end at once; `trilith.InternalError` for a panic.
pub(crate) fn run<T, J>(py: Python<'_>, job: J) -> PyResult<T>
where
    T: Send + 'static,
    J: FnOnce(&Watch) -> Result<T, Failure> + Send + 'static,
{
    with_progress(py, None, job)
}

/// The same; `progress` is called with the finished share every now and then, in the thread that waits.
///
/// # Errors
/// As [`run`], and what `progress` raises, which ends the job as well.
pub(crate) fn with_progress<T, J>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    job: J,
) -> PyResult<T>
where
    T: Send + 'static,
    J: FnOnce(&Watch) -> Result<T, Failure> + Send + 'static,
{
    let watch = Arc::new(Watch::default());
    let inside = Arc::clone(&watch);
    let (sender, mut receiver) = sync_channel(1);
    let thread = Builder::new().name("trilith".into()).stack_size(STACK).spawn(move || {
        let done = catch_unwind(AssertUnwindSafe(|| job(&inside)));
        // Nobody listens where it was interrupted.
        let _ = sender.send(done);
    })?;
    let mut told = f64::NAN;
    loop {
        let (waited, back) = py.detach(move || (receiver.recv_timeout(TICK), receiver));
        receiver = back;
        match waited {
            Ok(done) => {
                // It has nothing left to do, and no thread of it is left when this returns.
                let _ = py.detach(|| thread.join());
                return match done {
                    Ok(Ok(found)) => Ok(found),
                    Ok(Err(failure)) => Err(failure.into_exception(py)),
                    Err(panic) => Err(failure(&*panic).into_exception(py)),
                };
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Failure::Internal("a worker is gone".into()).into_exception(py));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        let share = f64::from_bits(watch.share.load(Ordering::Relaxed));
        let mut heard = py.check_signals();
        if let (Ok(()), Some(progress)) = (&heard, progress)
            && share != told
        {
            told = share;
            heard = progress.call1((share,)).map(drop);
        }
        if let Err(raised) = heard {
            watch.interrupt.store(true, Ordering::Relaxed);
            py.detach(move || drop(receiver.recv_timeout(GRACE)));
            return Err(raised);
        }
    }
}

/// What a panic is: that of a law which has told what is wrong with it, or a defect.
fn failure(panic: &(dyn Any + Send)) -> Failure {
    match panic.downcast_ref::<LawFailed>() {
        Some(LawFailed(message)) => Failure::Law(message.clone()),
        None => Failure::Internal(text(panic)),
    }
}

/// What a panic says.
fn text(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    text.unwrap_or_else(|| "a part of Trilith gave up without a word".into())
}
