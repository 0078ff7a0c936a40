//! Figures as files, in the formats asked for.

use crate::Failure;
use clap::ValueEnum;
use std::path::{Path, PathBuf};
use trilith::report::{Drawing, PngError, png_is_built_in};

/// What a figure is written as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Lines and letters, sharp at any size
    #[default]
    Svg,
    /// Pixels, 192 to the inch
    Png,
}

impl Format {
    /// The ending of its files.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }
}

/// Refuses PNG before anything runs where this build has none.
pub(crate) fn check(formats: &[Format]) -> Result<(), Failure> {
    match formats.contains(&Format::Png) && !png_is_built_in() {
        true => Err(failure(&PngError::NotBuiltIn)),
        false => Ok(()),
    }
}

/// Writes a figure into a folder, once for each format.
pub(crate) fn write(
    dir: &Path,
    name: &str,
    drawing: &Drawing,
    formats: &[Format],
) -> Result<Vec<PathBuf>, Failure> {
    // The same format twice is written once.
    let all = [Format::Svg, Format::Png];
    let mut written = Vec::new();
    for format in all.into_iter().filter(|f| formats.contains(f)) {
        let bytes = match format {
            Format::Svg => drawing.svg().as_bytes().to_vec(),
            Format::Png => drawing.png().map_err(|e| failure(&e))?,
        };
        let path = dir.join(format!("{name}.{}", format.ending()));
        std::fs::write(&path, bytes).map_err(|e| Failure::unwritable(&path, &e))?;
        written.push(path);
    }
    Ok(written)
}

fn failure(error: &PngError) -> Failure {
    let help = match error {
        PngError::NotBuiltIn => Some(
            "`cargo build --release --features png` builds a program that does; `--figure-format svg` needs nothing",
        ),
        _ => None,
    };
    Failure::input(&error.to_string(), help)
}
