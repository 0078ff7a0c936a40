//! Models made from a few numbers: for measurements of speed, for comparisons with other programs, and
//! as a start for models of one's own.
//!
//! ```
//! use trilith::generate::Frame;
//! let frame = Frame { storeys: 4, ..Frame::default() };
//! let model = trilith::read_text(&frame.to_ron(), "frame.ron", &trilith::registry(), &[]).expect("a model");
//! assert_eq!(model.nodes.len(), frame.nodes());
//! ```

mod error;
mod frame;
mod grid;
mod motion;
mod ron;

pub use error::FrameError;
pub use frame::{Frame, Section};
pub use motion::synthetic;
