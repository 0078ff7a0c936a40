//! What stops a study.

use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// What stops a study. Runs that are finished stay on disk.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// A file cannot be written or read.
    #[error("{} cannot be written: {cause}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// Another process writes the same folder.
    #[error("another process is running a study in {}", .folder.display())]
    Locked {
        /// The folder.
        folder: PathBuf,
    },
    /// Somebody wanted an end.
    #[error("interrupted: {done} of {total} runs are kept in {}", .folder.display())]
    Interrupted {
        /// Runs that are done.
        done: usize,
        /// All runs.
        total: usize,
        /// The folder.
        folder: PathBuf,
    },
    /// Runs are to be gathered that nobody has made.
    #[error("at least {missing} runs are missing in {}, where there are {done}", .folder.display())]
    Missing {
        /// Runs that are missing, of each series the first.
        missing: usize,
        /// Runs that are there.
        done: usize,
        /// The folder.
        folder: PathBuf,
    },
    /// The folder has runs of something else.
    #[error("{} has runs of another study: {} changed since", .folder.display(), .changed.join(", "))]
    OtherStudy {
        /// The folder.
        folder: PathBuf,
        /// What is not the same.
        changed: Vec<&'static str>,
    },
    /// The file in the place of the journal is none.
    #[error("{} is no journal of a study", .path.display())]
    NoJournal {
        /// The file.
        path: PathBuf,
    },
    /// A file of that name in a store is no segment of one.
    #[error("{} is no segment of a store, or of one of a newer version", .path.display())]
    NoSegment {
        /// The file.
        path: PathBuf,
    },
    /// A segment of a store does not hold what was written.
    #[error("{} is damaged: the line at byte {offset} is not what was written there", .path.display())]
    Damaged {
        /// The segment.
        path: PathBuf,
        /// Bytes before that line.
        offset: u64,
    },
    /// A program with kinds of its own is to use a store.
    #[error(
        "this program has a kind of its own, `{kind}`, whose code no store can tell from a later one"
    )]
    OwnKinds {
        /// The first one.
        kind: String,
    },
}

impl StudyError {
    pub(crate) fn at(path: &Path) -> impl Fn(std::io::Error) -> Self {
        let path = path.to_owned();
        move |cause| Self::File { path: path.clone(), cause }
    }

    /// What would be right.
    #[must_use]
    pub fn help(&self) -> &'static str {
        match self {
            Self::File { cause, .. } if cause.kind() == std::io::ErrorKind::StorageFull => {
                "make room and start the same study again: it goes on where it was"
            }
            Self::File { .. } => "every finished run is kept; the same study started again goes on",
            Self::Interrupted { .. } => {
                "the same command goes on, and writes the tables at its end"
            }
            Self::Missing { .. } => {
                "`--status` says of which parts; without `--gather` the same command makes them here"
            }
            Self::Locked { .. } => "wait for it, or give another folder with `--out`",
            Self::NoSegment { .. } => "give another folder with `--store`",
            Self::Damaged { .. } => {
                "put it back from a copy, or take it and its index out of the store: its runs are made again"
            }
            Self::OwnKinds { .. } => {
                "leave out `--store`: journals keep what is finished all the same"
            }
            Self::OtherStudy { .. } | Self::NoJournal { .. } => {
                "give another folder with `--out`, or remove this one"
            }
        }
    }
}

/// What a study is, so that the runs of one are not taken for those of another.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    /// Version of the program.
    pub version: String,
    /// Its build; empty in journals from before builds were told apart.
    #[serde(default)]
    pub build: String,
    /// SHA-256 of what is run and kept.
    pub study: String,
    /// SHA-256 of the model file; where it includes others, of the list of the sums of all.
    pub model: String,
    /// SHA-256 of the time functions of the model, records included.
    pub motions: String,
    /// Number of runs.
    pub runs: usize,
}

impl Identity {
    /// Refuses a journal of something else.
    pub(crate) fn same(&self, found: &Self, journal: &Path) -> Result<(), StudyError> {
        let mut changed = Vec::new();
        let parts = [
            (self.model != found.model, "the model"),
            (self.study != found.study || self.runs != found.runs, "the runs of the study"),
            (
                self.motions != found.motions,
                "a ground motion, or another file that the model names,",
            ),
            (self.version != found.version, "the version of the program"),
            (self.build != found.build, "the build of the program"),
        ];
        changed.extend(parts.into_iter().filter(|(differs, _)| *differs).map(|(_, what)| what));
        // A change of the model changes its time functions, too, as a rule.
        if changed.first() == Some(&"the model") {
            changed
                .retain(|what| *what != "a ground motion, or another file that the model names,");
        }
        // Another version is another build.
        if self.version != found.version {
            changed.retain(|what| *what != "the build of the program");
        }
        if changed.is_empty() {
            return Ok(());
        }
        let folder = journal.parent().unwrap_or(journal).to_owned();
        Err(StudyError::OtherStudy { folder, changed })
    }
}
