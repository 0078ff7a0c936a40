//! Models of other programs as model files, with a report of every loss.
//!
//! [`sap2000::import`] reads the text models of SAP2000. Every table of a file is read, knowingly ignored, or named as
//! lost; of the tables that are read every field is used, knowingly ignored, or named where it departs from its default.
//! [`etabs::import`] reads those of ETABS by the same tables, with every section, line and field accounted for.
//! [`opensees::import`] runs scripts of OpenSees and does the same for their commands and arguments.
//!
//! ```
//! use trilith_exchange::{Options, sap2000};
//!
//! let text = r#"
//! TABLE:  "PROGRAM CONTROL"
//!    ProgramName=SAP2000   CurrUnits="KN, m, C"
//!
//! TABLE:  "JOINT COORDINATES"
//!    Joint=1   CoordSys=GLOBAL   CoordType=Cartesian   XorR=0   Y=0   Z=0
//!
//! TABLE:  "JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED"
//!    Joint=1   CoordSys=GLOBAL   U1=100   U2=100   U3=100   R1=5   R2=5   R3=5
//!
//! END TABLE DATA
//! "#;
//! let import = sap2000::import(text.as_bytes(), &Options::default()).expect("a model");
//! assert_eq!(import.report.losses(), 0);
//! assert!(import.draft.to_ron().contains("\"1\": (0, 0, 0)"));
//! ```

mod draft;
pub mod etabs;
pub mod opensees;
mod report;
pub mod sap2000;

pub use draft::{DOFS, Draft, Section};
pub use report::{Fate, Note, Report, TableReport, Things};
use std::path::PathBuf;
use trilith_model::Diagnostic;
pub use trilith_model::ron_value as ron;

/// What an import is told.
#[derive(Clone, Debug)]
pub struct Options {
    /// The file, for messages and the title.
    pub path: PathBuf,
    /// Folder that records lie in.
    pub folder: Option<PathBuf>,
    /// Beginning of the names of files that go beside the model.
    pub stem: String,
    /// The only case that is written, with those that it continues.
    pub case: Option<String>,
    /// Units of length and force of a file that does not say its own; none: m and N.
    pub units: Option<(String, String)>,
    /// Most commands that a script may run.
    pub budget: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            path: "model.s2k".into(),
            folder: None,
            stem: "model".into(),
            case: None,
            units: None,
            budget: 2_000_000,
        }
    }
}

/// A model and what was lost on the way.
#[derive(Clone, Debug)]
pub struct Import {
    /// The model.
    pub draft: Draft,
    /// What became of every table and field.
    pub report: Report,
    /// Files that go beside the model: names and contents.
    pub files: Vec<(String, String)>,
}

impl Import {
    /// With the head of the report: the file, its program, its units, and what the model has.
    fn new(
        draft: Draft,
        mut report: Report,
        files: Vec<(String, String)>,
        options: &Options,
        program: &str,
    ) -> Self {
        let name = options.path.file_name().unwrap_or_default().to_string_lossy();
        report.file = format!("{name}: {program}, {}, {}", draft.units.1, draft.units.0);
        let counts = [
            ("nodes", draft.nodes.len()),
            ("elements, constraints and links", draft.elements.len()),
            ("patterns of loads", draft.loads.len()),
            ("functions", draft.functions.len()),
            ("cases", draft.cases.len()),
            ("outputs", draft.outputs.len()),
        ];
        report.written = counts.map(|(what, n)| (what.into(), n)).to_vec();
        Self { draft, report, files }
    }

    /// False where nothing but masses is left: no model that runs.
    #[must_use]
    pub fn is_model(&self) -> bool {
        self.draft.elements.iter().any(|(_, e)| e.name() != "Mass")
    }
}

/// All errors of a file that is refused.
#[derive(Clone, Debug)]
pub struct Refused(pub Vec<Diagnostic>);

impl std::fmt::Display for Refused {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (i, error) in self.0.iter().enumerate() {
            write!(f, "{}{error}", if i == 0 { "" } else { "\n" })?;
        }
        Ok(())
    }
}

impl std::error::Error for Refused {}
