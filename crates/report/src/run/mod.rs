//! The report of a run: its data as a file of its own, and the page made from it.

mod answers;
mod choice;
mod collect;
mod data;
mod drawing;
mod extruded;
mod figures;
mod legible;
mod loops;
mod members;
mod page;
mod picture;
mod places;
mod reduce;
mod script;
mod sections;
mod settings;
mod shaking;
mod texts;
mod thin_frame;
mod tints;
mod units;
pub use units::short;

pub use collect::Collect;
pub use data::{
    Answer, FaceMark, Family, Frames, Ground, GroupMark, History, LineKind, LineMark, LinkMark,
    Loop, MemberCurve, Mode, NodeMark, Numbers, Orbit, Picture, Profile, ProfileCurve, RunData,
    RunIdentity, Shown, SpectrumChart, SpectrumCurve, Tint, Tinted,
};
pub use figures::{ENERGY, GROUND, MODEL, SPECTRA, named_figures};
pub use page::{run_page, run_update};
pub use sections::Sections;
