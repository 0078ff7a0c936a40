//! Figures as SVG and pages as one self-contained HTML file, without network. What is drawn is drawn once: still, for paper
//! and for readers without scripts, and as data from which the script of the page draws the same to be zoomed and asked.
//!
//! ```
//! use trilith_report::{Block, Figure, Page, Section};
//!
//! let wave = (0..100).map(|i| (0.01 * i as f64, (0.1 * i as f64).sin()));
//! let figure = Figure::new("A wave", "time [s]", "displacement [m]").line("computed", wave);
//! let section = Section::new("wave", "Waves").block(Block::text("One wave.")).block(figure);
//! let html = Page::new("Report").section(section).html();
//! assert!(html.contains("<svg") && !html.contains("http://localhost"));
//! ```

mod chart;
mod draw;
mod drawing;
mod entries;
mod figure;
mod page;
mod png;
mod run;
mod thin;

pub use drawing::Drawing;
pub use entries::{Entries, Entry};
pub use figure::{Axis, Color, Figure, Series, Stroke};
pub use page::{Block, Charts, Page, Section};
pub use png::{PngError, png_is_built_in};
pub use run::{
    Answer, Collect, ENERGY, FaceMark, Family, Frames, GROUND, Ground, GroupMark, History,
    LineKind, LineMark, LinkMark, Loop, MODEL, MemberCurve, Mode, NodeMark, Numbers, Orbit,
    Picture, Profile, ProfileCurve, RunData, RunIdentity, SPECTRA, Sections, Shown, SpectrumChart,
    SpectrumCurve, Tint, Tinted, named_figures, run_page, run_update, short,
};
