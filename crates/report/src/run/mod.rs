//! The report of a run: its data as a file of its own, and the page made from it.

mod collect;
mod data;
mod drawing;
mod figures;
mod loops;
mod page;
mod picture;
mod reduce;
mod script;
mod settings;
mod thin_frame;
mod units;
pub use units::short;

pub use collect::Collect;
pub use data::{
    FaceMark, Family, Frames, History, LineKind, LineMark, LinkMark, Loop, Mode, NodeMark, Numbers,
    Picture, RunData, Shown,
};
pub use figures::{ENERGY, named_figures};
pub use page::run_page;
