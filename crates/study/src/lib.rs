//! Studies: one model with many values of its parameters, run on all cores into one table.
//!
//! A study is a RON file that names a model and says which parameters take which values: grids, lists, random
//! draws, records × scales, ensembles about every point. [`Study::read`] checks it, [`execute()`] runs it. Every
//! finished run is on disk at once; a study that was killed goes on where it was and ends with the same table
//! to the bit, whatever the number of threads, and of [parts](Shard) that ran on other machines. Small models go side by side in vector lanes.
//! Runs that a [store](How::store) has are taken from there, whichever study made them.
//!
//! | file | what |
//! |---|---|
//! | `table.parquet`, `table.csv` | a row for each run |
//! | `statistics.csv` | medians, dispersions and probabilities of each point with several runs |
//! | `study.html` | figures |
//! | `runs.journal` | finished runs while the study goes on |
//! | `runs.I-of-N.journal` | the same of a part that was run on its own |
//! | `runs/NNNNNN/` | histories of the runs that the study asks for |

mod column;
mod condition;
mod distribution;
mod draw;
mod error;
mod execute;
mod figure;
mod files;
mod finished;
mod fragility;
mod journal;
mod number;
mod page;
mod parcel;
mod plan;
mod read;
mod records;
mod run;
pub mod schema;
mod shape;
mod shard;
mod statistics;
mod status;
mod store;
mod study;
mod table;

pub use column::{Column, Measure};
pub use condition::Condition;
pub use distribution::{Distribution, phi, phi_inverse};
pub use error::{Identity, StudyError};
pub use execute::{How, Progress, Results, execute};
pub use figure::{Drawing, figures};
pub use fragility::{Band, Capacity, Fragility, FragilityError};
pub use journal::{Cell, Record};
pub use page::charts;
pub use plan::{Axis, Ensemble, Place, Plan, Samples};
pub use records::{Records, Row};
pub use shard::{Part, Shard, is_study_folder};
pub use statistics::{Spread, wilson};
pub use status::{PartStatus, status};
pub use store::machine;
pub use study::Study;
pub use table::{Data, Table, Values};
