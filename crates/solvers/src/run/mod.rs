//! Cases from start to end: static ones, dynamic ones, and chains of them.
//!
//! Start state or checkpoint, basis and solver of a case, its march with what watches it, and the result.
//! May use all rooms but `together` and `lanes`, which stand on this one.

mod arrival;
mod case;
mod checkpoint;
mod clock;
mod companion;
mod dynamic;
mod end_state;
mod equations;
mod marching;
mod p_delta;
mod prepared;
mod result;
mod start;
mod warnings;

pub(crate) use arrival::Arrival;
pub use case::{RunOptions, modes, run};
pub(crate) use case::{before, end_at};
pub(crate) use clock::{Clock, peak_rss_mb};
pub(crate) use end_state::Initial;
pub use end_state::{EndState, SoFar};
pub(crate) use equations::{Equations, bases, fna_modes, link_equations};
pub use p_delta::assemble;
pub(crate) use prepared::{Prepared, Setup, held_load};
pub use result::{CaseResult, Status, Work};
pub(crate) use start::{peak, start};
pub use warnings::of_outputs;
