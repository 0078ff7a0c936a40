//! CPU time and memory of the process, for the work report.

use crate::platform::HAS_CLOCK;
use std::time::Instant;
#[cfg(unix)]
use trilith_linalg::threads::{helped, thread_seconds};

/// Measures CPU time of this thread and of those that help it where the system tells it, wall-clock time elsewhere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    /// None where the system has no clock: WebAssembly alone.
    wall: Option<Instant>,
    #[cfg(unix)]
    cpu: f64,
}

impl Clock {
    pub(crate) fn start() -> Self {
        Self {
            wall: HAS_CLOCK.then(Instant::now),
            #[cfg(unix)]
            cpu: thread_seconds() + helped(),
        }
    }

    pub(crate) fn wall(&self) -> f64 {
        self.wall.map_or(0.0, |wall| wall.elapsed().as_secs_f64())
    }

    pub(crate) fn cpu(&self) -> f64 {
        #[cfg(unix)]
        return thread_seconds() + helped() - self.cpu;
        #[cfg(not(unix))]
        self.wall()
    }
}

/// Largest resident memory so far, MB; 0 where the system does not tell.
pub(crate) fn peak_rss_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    status
        .lines()
        .find_map(|l| l.strip_prefix("VmHWM:"))
        .and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok())
        .map_or(0.0, |kb| kb / 1024.0)
}
