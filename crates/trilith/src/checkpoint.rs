//! Checkpoints as files.

use crate::{BUILD, VERSION};
use serde_json::Value;
use std::path::{Path, PathBuf};
use trilith_results::{FileError, sha256_of_json};
use trilith_solvers::EndState;

/// The format written here.
const FORMAT: u64 = 2;
/// Key of the sum of all others.
const SUM: &str = "sha256";

/// Where a run stopped, and what made it.
///
/// The file is JSON: `format`, `version`, `build`, `state`, and `sha256`, the sum of these four
/// ([`trilith_results::sha256_of_json`]). Numbers read back to the bit.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// Version of the program that ran.
    pub version: String,
    /// Its build.
    pub build: String,
    /// The state, for `from` of [`RunOptions`](crate::RunOptions).
    pub state: EndState,
}

/// A checkpoint that cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// A file that is not there or is no text.
    #[error("the checkpoint {} cannot be read: {cause}", .path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// A file that is no checkpoint, or a damaged one.
    #[error("the checkpoint {} cannot be read: {cause}", .path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// Where it differs.
        cause: serde_json::Error,
    },
    /// A file that does not say what it is.
    #[error(
        "the checkpoint {} states no format: it is none, or was written before checkpoints had sums",
        .path.display()
    )]
    NoFormat {
        /// The file.
        path: PathBuf,
    },
    /// A checkpoint of another program.
    #[error("the checkpoint {} has format {found}, this program reads format {known}", .path.display())]
    OtherFormat {
        /// The file.
        path: PathBuf,
        /// Its format.
        found: u64,
        /// The format that is read here.
        known: u64,
    },
    /// Something in it was changed after it was written.
    #[error(
        "the checkpoint {} is not as it was written: its `sha256` is {stated}, that of its content {found}",
        .path.display()
    )]
    Altered {
        /// The file.
        path: PathBuf,
        /// The sum that it states.
        stated: String,
        /// The sum that its content has.
        found: String,
    },
}

impl Checkpoint {
    /// Of a run of this program.
    #[must_use]
    pub fn new(state: EndState) -> Self {
        Self { version: VERSION.to_owned(), build: BUILD.to_owned(), state }
    }

    /// Reads a checkpoint and sees that nothing in it has changed.
    ///
    /// # Errors
    /// [`CheckpointError`] with the path and what is wrong.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, CheckpointError> {
        let path = path.as_ref();
        let at = || path.to_owned();
        let foreign = |cause| CheckpointError::Foreign { path: at(), cause };
        let text = trilith_record::file::read_text(path)
            .map_err(|cause| CheckpointError::Unreadable { path: at(), cause })?;
        let mut file: Value = serde_json::from_str(&text).map_err(foreign)?;
        match file["format"].as_u64() {
            Some(FORMAT) => {}
            Some(found) => {
                return Err(CheckpointError::OtherFormat { path: at(), found, known: FORMAT });
            }
            None => return Err(CheckpointError::NoFormat { path: at() }),
        }
        let stated = text_of(&file, SUM);
        let found = sha256_of_json(&file, &[SUM]);
        if stated != found {
            return Err(CheckpointError::Altered { path: at(), stated, found });
        }
        let (version, build) = (text_of(&file, "version"), text_of(&file, "build"));
        let state = serde_json::from_value(file["state"].take()).map_err(foreign)?;
        Ok(Self { version, build, state })
    }

    /// Writes it.
    ///
    /// # Errors
    /// [`FileError`] with the path.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        let path = path.as_ref();
        let text = self.text().map_err(std::io::Error::from);
        text.and_then(|text| std::fs::write(path, text))
            .map_err(|cause| FileError { path: path.to_owned(), cause })
    }

    /// What a user should know who goes on from it with this program.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        (self.version != VERSION || self.build != BUILD).then(|| {
            format!(
                "the checkpoint was written by trilith {} (build {}), this is {VERSION} (build {BUILD}): the run may differ from one in one piece",
                self.version, self.build
            )
        })
    }

    fn text(&self) -> Result<String, serde_json::Error> {
        let (version, build) = (Value::from(&*self.version), Value::from(&*self.build));
        let head = format!("\"format\":{FORMAT},\"version\":{version},\"build\":{build}");
        let state = serde_json::to_string(&self.state)?;
        let all: Value = serde_json::from_str(&format!("{{{head},\"state\":{state}}}"))?;
        let sum = sha256_of_json(&all, &[SUM]);
        Ok(format!("{{{head},\"{SUM}\":\"{sum}\",\"state\":{state}}}\n"))
    }
}

fn text_of(file: &Value, key: &str) -> String {
    file[key].as_str().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checkpoint() -> Checkpoint {
        let mut it = Checkpoint::new(EndState::default());
        it.state.case = "swing".into();
        it.state.time = 0.1 + 0.2;
        it.state.displacement = vec![-0.0, 1e-310, std::f64::consts::PI];
        it
    }

    /// What is said of a checkpoint with this text.
    fn told(text: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.json");
        std::fs::write(&path, text).unwrap();
        Checkpoint::read(&path).unwrap_err().to_string()
    }

    #[test]
    fn a_checkpoint_comes_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.json");
        checkpoint().write(&path).unwrap();
        let read = Checkpoint::read(&path).unwrap();
        assert_eq!(read, checkpoint());
        assert_eq!(read.state.displacement[0].to_bits(), (-0.0_f64).to_bits());
        assert_eq!(read.warning(), None);
        let other = Checkpoint { build: "0".into(), ..read };
        assert!(other.warning().is_some_and(|w| w.contains("build 0") && w.contains(BUILD)));
    }

    #[test]
    fn what_was_altered_or_is_of_another_format_is_refused_and_told() {
        let text = checkpoint().text().unwrap();
        for (from, to) in [
            ("3.141592653589793", "3.141592653589794"),
            ("\"case\":\"swing\"", "\"case\":\"drop\""),
            ("\"step\":0", "\"step\":1"),
            ("\"build\":\"", "\"build\":\"0"),
            ("\"state\":{", "\"state\":{\"more\":1,"),
            ("\"sha256\":\"", "\"sha256\":\"0"),
            ("\"sha256\":", "\"sha512\":"),
            ("-0.0", "0.0"),
        ] {
            let altered = text.replacen(from, to, 1);
            assert_ne!(altered, text, "{from}");
            let told = told(&altered);
            assert!(told.contains("is not as it was written"), "{from}: {told}");
        }
        let other = text.replacen("\"format\":2", "\"format\":7", 1);
        assert!(told(&other).contains("has format 7, this program reads format 2"));
        let bare = serde_json::to_string(&checkpoint().state).unwrap();
        assert!(told(&bare).contains("states no format"));
        assert!(told("[1]").contains("states no format") && told("7").contains("no format"));
        assert!(told(&text[..text.len() / 2]).contains("cannot be read: EOF"));
    }
}
