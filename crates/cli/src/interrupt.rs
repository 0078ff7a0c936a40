//! Ctrl-C and SIGTERM: a run or a study that can end in good order does so; a second one ends the program at once, as
//! the first does everywhere else.

use crate::output;
use std::sync::atomic::{AtomicBool, Ordering};

/// Somebody wants an end.
static WANTED: AtomicBool = AtomicBool::new(false);
/// Somebody looks at it.
static HEARD: AtomicBool = AtomicBool::new(false);
/// Exit status of what was interrupted, as shells have it for Ctrl-C.
pub(crate) const INTERRUPTED: i32 = 130;

/// Whether somebody wants an end.
#[must_use]
pub(crate) fn is_wanted() -> bool {
    WANTED.load(Ordering::SeqCst)
}

/// While it lives, the first signal sets a flag instead of ending the program.
pub(crate) struct Ear;

impl Ear {
    /// `what` ends at the next opportunity.
    pub(crate) fn open(what: &'static str) -> Self {
        HEARD.store(true, Ordering::SeqCst);
        let on_signal = move || {
            if !HEARD.load(Ordering::SeqCst) || WANTED.swap(true, Ordering::SeqCst) {
                std::process::exit(INTERRUPTED);
            }
            output::tell(&format!("{what}; once more: at once\n"));
        };
        // Where no handler can be had, signals end the program as they always did.
        let _ = ctrlc::set_handler(on_signal);
        Self
    }

    /// True once an end is wanted.
    #[must_use]
    pub(crate) fn flag(&self) -> &'static AtomicBool {
        &WANTED
    }
}

impl Drop for Ear {
    fn drop(&mut self) {
        HEARD.store(false, Ordering::SeqCst);
    }
}
