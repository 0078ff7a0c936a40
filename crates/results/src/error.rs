//! A file that cannot be written.

use std::path::{Path, PathBuf};

/// A file that cannot be written, and why.
#[derive(Debug, thiserror::Error)]
#[error("{} cannot be written: {cause}", .path.display())]
pub struct FileError {
    /// The file or folder.
    pub path: PathBuf,
    /// Why.
    pub cause: std::io::Error,
}

impl FileError {
    /// Puts the path to an error of writing.
    pub(crate) fn at<E: Into<std::io::Error>>(path: &Path) -> impl FnOnce(E) -> Self {
        move |cause| Self { path: path.to_owned(), cause: cause.into() }
    }
}
