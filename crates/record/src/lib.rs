//! Ground motion records: files of all common formats, processing, intensity measures, response spectra, and
//! synthetic motions.
//!
//! Accelerations in m/s², times in s, frequencies in Hz, damping as a share of critical. Between samples an
//! acceleration runs straight; velocity, displacement, intensities and the response of an oscillator follow
//! from that without further error.
//!
//! ```
//! use trilith_record::{ReadOptions, parse, measure};
//!
//! let text = "# unit: g\nt,a\n0.0,0\n0.1,0.2\n0.2,-0.1\n0.3,0\n";
//! let records = parse(text.as_bytes(), "made_up.csv", &ReadOptions::default()).expect("a record");
//! assert_eq!(records[0].dt, 0.1);
//! assert!((measure::peak(&records[0].acceleration) - 0.2 * 9.80665).abs() < 1e-12);
//! ```

mod cell;
pub mod design;
mod error;
pub mod file;
mod finite;
mod format;
pub mod measure;
pub mod process;
mod read;
mod record;
pub mod synthetic;
mod unit;
mod visible;

pub use cell::cell;
pub use error::{Problem, ReadError};
pub use finite::{MOST_SAMPLES, NotFinite};
pub use format::Format;
pub use read::{Column, Columns, Component, ReadOptions, parse, read, select};
pub use record::{Direction, Record};
pub use unit::{STANDARD_GRAVITY, acceleration_unit};
pub use visible::{visible, visible_line};
