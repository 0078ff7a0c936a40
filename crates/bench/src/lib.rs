//! What a run of Trilith costs.
//!
//! `cargo benchmark` measures the frames of [`trilith::generate`] in up to six sizes under FNA and under
//! direct integration, each in a process of its own: CPU time of reading, assembly, set-up and one step, the
//! whole run, memory, iterations, and how near the peaks are to those of another program. It shows how
//! the cost grows, lets a model run for an hour of record, sweeps a block through many parameters, and runs other
//! programs beside it.
//!
//! All times are CPU times of the process. The table is printed and written with its figures to
//! `report.html` and `results.json` under `target/benchmark/`.

mod block;
pub mod child;
pub mod clock;
mod command;
mod endurance;
mod export;
pub mod fit;
mod gauge;
mod growth;
mod measure;
mod peers;
pub mod report;
mod size;
mod subject;
mod table;
mod threads;

pub use block::{BlockPair, BlockSweep, block_beside, block_ratios, sweep_block};
pub use command::{Commands, Ran, Swept, commands, program};
pub use endurance::{Endurance, Moment, endure};
pub use export::export;
pub use gauge::Gauge;
pub use growth::{Curve, Growth, grow};
pub use measure::{Accuracy, Effort, Measurement, WHOLE, measure};
pub use peers::{OpenSees, Pair, Programs, SideBySide, side_by_side};
pub use size::{Peaks, SIZES, SOURCE, Size, find};
pub use subject::{Subject, Task};
pub use threads::Threads;
