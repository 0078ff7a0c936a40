//! Watches a run: how long a block stands on one corner alone, which no output tells.
//!
//! ```console
//! cargo run --release -p trilith --example own_observer
//! ```

use std::error::Error;
use trilith::solvers::{Observer, Sample};
use trilith::{Analysis, registry};

const MODEL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/rigid_block.ron");

/// Adds up the time in which exactly one of two outputs is above zero: an observer is shown every accepted substep.
struct OnOneCorner {
    /// Indices of the outputs.
    uplifts: [usize; 2],
    /// Time of the sample before, s.
    before: f64,
    /// What it has found, s.
    time: f64,
}

impl Observer for OnOneCorner {
    fn sample(&mut self, sample: &Sample<'_>) {
        let [left, right] = self.uplifts.map(|i| sample.values[i] > 0.0);
        if left != right {
            self.time += sample.t - self.before;
        }
        self.before = sample.t;
    }

    fn wants_rates(&self) -> bool {
        false
    }
}

/// Runs the block under the eyes of the observer.
pub fn main() -> Result<(), Box<dyn Error>> {
    let model = trilith::read(MODEL, &registry(), &[])?;
    let output = |name: &str| model.output(name).ok_or(format!("no output {name}"));
    let uplifts = [output("uplift_left")?, output("uplift_right")?];
    let mut watch = OnOneCorner { uplifts, before: 0.0, time: 0.0 };

    // Assembled once, run as often as one likes.
    let analysis = Analysis::new(&model)?;
    analysis.last_case()?.observer(&mut watch).run()?;

    println!("the block stands on one corner for {:.3} s", watch.time);
    Ok(())
}
