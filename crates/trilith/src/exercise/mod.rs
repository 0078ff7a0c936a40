//! What a link does: a cyclic deformation imposed on its law alone, without a structure.
//!
//! ```
//! use trilith::exercise::Specimen;
//!
//! let stiffer = [("k".to_owned(), "1 MN/m".to_owned())];
//! let specimen = Specimen::new(&trilith::registry(), "Gap", &stiffer)?;
//! let record = specimen.exercise(&specimen.motion()?)?;
//! assert!(record.energy_error() < 1e-3);
//! assert!(record.figures()[0].svg().starts_with("<svg"));
//! # Ok::<(), trilith::exercise::ExerciseError>(())
//! ```
//!
//! The parameters are those of the example on the card of the kind, the motion is that of its
//! [`Exercise`](crate::element::Exercise); both can be changed. A measured [`History`] takes the place of the motion.

mod draw;
mod error;
mod example;
mod history;
mod motion;
mod record;
mod specimen;
mod table;

pub use error::ExerciseError;
pub use history::{History, HistoryError};
pub use motion::Motion;
pub use record::{LastCycle, Record};
pub use specimen::{Coordinate, Specimen};
