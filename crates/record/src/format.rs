//! Formats of files, and how they are told apart.

use std::path::Path;

/// A format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// PEER NGA and its forerunners: `NPTS=`, `DT=`, values in g.
    At2,
    /// COSMOS strong motion format, volumes 1 and 2 (and raw counts).
    Cosmos,
    /// CSMIP (California) volumes 1 and 2.
    Csmip,
    /// K-NET and KiK-net ASCII: counts and a scale factor.
    Knet,
    /// ESM and ITACA ASCII: `KEY: value` lines, one value a line.
    Esm,
    /// Columns: CSV, or separated by blanks, tabs or semicolons.
    Columns,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::At2, Self::Cosmos, Self::Csmip, Self::Knet, Self::Esm, Self::Columns];

    /// Its name in model files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::At2 => "AT2",
            Self::Cosmos => "COSMOS",
            Self::Csmip => "CSMIP",
            Self::Knet => "KNET",
            Self::Esm => "ESM",
            Self::Columns => "Columns",
        }
    }

    /// The format of a text. The ending of the file decides only where the text leaves it open.
    #[must_use]
    pub(crate) fn of(lines: &[&str], path: &Path) -> Option<Self> {
        let head = |n: usize| lines.iter().take(n).map(|l| l.to_lowercase());
        if head(20).any(|l| l.contains("(format v") && l.contains("text lines"))
            || head(40).any(|l| l.contains("integer-header values follow"))
        {
            return Some(Self::Cosmos);
        }
        let first = head(1).next().unwrap_or_default();
        if first.starts_with("corrected accelerogram")
            || first.starts_with("uncorrected accelerogram")
        {
            return Some(Self::Csmip);
        }
        if head(17).any(|l| l.starts_with("scale factor"))
            && head(17).any(|l| l.starts_with("sampling freq"))
        {
            return Some(Self::Knet);
        }
        if head(60).any(|l| l.starts_with("sampling_interval_s"))
            || head(60).any(|l| l.starts_with("event_name:"))
        {
            return Some(Self::Esm);
        }
        if head(15).any(|l| l.contains("npts")) {
            return Some(Self::At2);
        }
        if head(5).any(|l| l.contains("points at equal spacing of")) {
            return Some(Self::At2);
        }
        let numbers = |l: &&str| {
            let mut cells = l.split([',', ';', ' ', '\t']).filter(|c| !c.is_empty()).peekable();
            cells.peek().is_some() && cells.all(|c| c.trim().parse::<f64>().is_ok())
        };
        if lines.iter().take(60).any(numbers) {
            // A file that calls itself AT2 and lost its header should say so.
            let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
            return Some(match ending.to_lowercase().as_str() {
                "at2" => Self::At2,
                _ => Self::Columns,
            });
        }
        None
    }
}
