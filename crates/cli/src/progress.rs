//! A bar on the terminal for runs that take a while.

use crate::output;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};
use trilith::model::visible_line;

const PATIENCE: Duration = Duration::from_millis(500);
const PARTS: f64 = 1000.0;

/// A bar that appears when a run has lasted half a second, and only on a terminal.
pub(crate) struct Progress {
    start: Instant,
    terminal: bool,
    name: String,
    bar: Option<ProgressBar>,
}

impl Progress {
    pub fn new(name: &str) -> Self {
        let terminal = std::io::stderr().is_terminal();
        Self { start: Instant::now(), terminal, name: visible_line(name).into_owned(), bar: None }
    }

    /// Shows the finished share.
    pub fn show(&mut self, share: f64) {
        if !self.terminal || self.start.elapsed() < PATIENCE {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::new(PARTS as u64).with_elapsed(self.start.elapsed());
            let template = "{msg} {bar:40} {percent:>3} % {eta:>4} left";
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style);
            }
            bar.set_message(self.name.clone());
            bar
        });
        bar.set_position((PARTS * share.clamp(0.0, 1.0)) as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// How often a study that writes to a file, not a terminal, says how far it is.
const LINE: Duration = Duration::from_secs(30);

/// Progress of many runs: a bar with the time left on a terminal, a line now and then elsewhere. Studies that last say
/// first how they go on after a stop: an end by force leaves no time for that.
pub(crate) struct Steps {
    start: Instant,
    said: Instant,
    /// Runs that were done when the first one was shown.
    first: Option<usize>,
    terminal: bool,
    name: String,
    /// How it goes on, until that is said.
    again: Option<String>,
    bar: Option<ProgressBar>,
}

impl Steps {
    /// `again`: how the study goes on after a stop.
    pub fn new(name: &str, again: String) -> Self {
        let now = Instant::now();
        let terminal = std::io::stderr().is_terminal();
        let name = visible_line(name).into_owned();
        let again = Some(again);
        Self { start: now, said: now, first: None, terminal, name, again, bar: None }
    }

    /// Shows how many are done.
    pub fn show(&mut self, done: usize, total: usize, failed: usize) {
        let first = *self.first.get_or_insert(done.saturating_sub(1));
        if done < total
            && self.start.elapsed() > PATIENCE
            && let Some(again) = self.again.take()
        {
            output::tell(&format!("{again}\n"));
        }
        let failures = if failed > 0 { format!(", {failed} failed") } else { String::new() };
        if !self.terminal {
            if self.said.elapsed() > LINE {
                self.said = Instant::now();
                let new = done.saturating_sub(first).max(1) as f64;
                let left = self.start.elapsed().as_secs_f64() / new * (total - done) as f64;
                output::tell(&format!("{done} of {total} runs{failures}, {left:.0} s left\n"));
            }
            return;
        }
        if self.start.elapsed() < PATIENCE {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::new(total as u64).with_elapsed(self.start.elapsed());
            let template = "{msg} {bar:40} {pos}/{len} {per_sec} {eta} left{prefix}";
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style);
            }
            bar.set_message(self.name.clone());
            bar
        });
        bar.set_prefix(failures);
        bar.set_position(done as u64);
    }
}

impl Drop for Steps {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
