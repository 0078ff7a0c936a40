//! A bar on the terminal for runs that take a while.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

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
        Self { start: Instant::now(), terminal, name: name.to_owned(), bar: None }
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
