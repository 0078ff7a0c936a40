//! Files of the system.

use super::Refusal;
use std::fs::{File, FileType};
use std::io::{Error, Read, Result};
use std::path::{Path, PathBuf};

pub(super) fn canonical(path: &Path) -> Result<PathBuf> {
    path.canonicalize()
}

pub(super) fn read(path: &Path, most: u64) -> Result<Vec<u8>> {
    // Before it is opened: to open a pipe is to wait for its writer.
    regular(std::fs::metadata(path)?.file_type())?;
    let file = File::open(path)?;
    let about = file.metadata()?;
    regular(about.file_type())?;
    let too_large = || Error::from(Refusal::TooLarge { mebibytes: most >> 20 });
    if about.len() > most {
        return Err(too_large());
    }
    let mut bytes = Vec::with_capacity(usize::try_from(about.len()).unwrap_or(0));
    // A file may grow, and some say that they are empty.
    file.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(too_large());
    }
    Ok(bytes)
}

fn regular(kind: FileType) -> Result<()> {
    if kind.is_file() {
        return Ok(());
    }
    Err(Refusal::NotRegular(if kind.is_dir() { "a folder" } else { special(kind) }).into())
}

#[cfg(unix)]
fn special(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    if kind.is_fifo() {
        "a pipe"
    } else if kind.is_socket() {
        "a socket"
    } else {
        "a device"
    }
}

#[cfg(not(unix))]
fn special(_: FileType) -> &'static str {
    "something else"
}
