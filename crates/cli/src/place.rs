//! Folders that a command writes a few files into.

use crate::Failure;
use crate::text::shown;
use std::path::Path;
use trilith::results::{Folder, Writer};

/// Takes a folder.
pub(crate) fn open(dir: &Path, writer: Writer) -> Result<Folder, Failure> {
    Folder::open(dir, writer).map_err(|e| Failure::folder(&e))
}

/// Writes files, by name and content, and shows where they are.
pub(crate) fn write(
    folder: Folder,
    files: &[(String, impl AsRef<[u8]>)],
) -> Result<Vec<String>, Failure> {
    let mut written = Vec::new();
    for (name, content) in files {
        let path = folder.path().join(name);
        std::fs::write(&path, content).map_err(|e| Failure::unwritable(&path, &e))?;
        written.push(shown(&folder.published(&path)));
    }
    folder.publish().map_err(|e| Failure::folder(&e))?;
    Ok(written)
}
