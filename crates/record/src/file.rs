//! Reading files that the user names: regular ones only, up to a size.
//!
//! A pipe would keep the program waiting and a device would fill the memory; both are refused before they are
//! opened.

use std::fs::{File, FileType};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

/// Size of the largest file that is read, bytes: 256 MiB.
pub const MOST_BYTES: u64 = 256 << 20;

/// Why a file is not read though it is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// It is something else.
    #[error("it is {0}, not a regular file")]
    NotRegular(&'static str),
    /// It is too large.
    #[error("it is larger than {mebibytes} MiB, the most that is read")]
    TooLarge {
        /// Size of the largest file that is read, MiB.
        mebibytes: u64,
    },
}

impl From<Refusal> for Error {
    fn from(refusal: Refusal) -> Self {
        Self::new(ErrorKind::InvalidInput, refusal)
    }
}

/// The content of a regular file of up to [`MOST_BYTES`].
///
/// # Errors
/// Those of the system, and a [`Refusal`].
pub fn read(path: impl AsRef<Path>) -> Result<Vec<u8>> {
    up_to(path.as_ref(), MOST_BYTES)
}

/// The same as text.
///
/// # Errors
/// As [`read`], and [`ErrorKind::InvalidData`] for what is no UTF-8.
pub fn read_text(path: impl AsRef<Path>) -> Result<String> {
    String::from_utf8(read(path)?).map_err(|e| {
        let line = 1 + e.as_bytes()[..e.utf8_error().valid_up_to()]
            .iter()
            .filter(|b| **b == b'\n')
            .count();
        Error::new(ErrorKind::InvalidData, format!("line {line} is no text in UTF-8"))
    })
}

fn up_to(path: &Path, most: u64) -> Result<Vec<u8>> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_regular_file_is_read_up_to_its_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "12345").unwrap();
        assert_eq!(read(&path).unwrap(), b"12345");
        assert_eq!(read_text(&path).unwrap(), "12345");
        assert_eq!(up_to(&path, 5).unwrap(), b"12345");
        let error = up_to(&path, 4).unwrap_err();
        assert!(error.to_string().contains("the most that is read"), "{error}");
        std::fs::write(&path, b"a\nb\n\xff").unwrap();
        assert_eq!(read_text(&path).unwrap_err().to_string(), "line 3 is no text in UTF-8");
    }

    #[test]
    fn a_file_above_the_limit_is_told_with_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("large");
        // A hole: it takes no room on the disk.
        File::create(&path).unwrap().set_len(MOST_BYTES + 1).unwrap();
        let error = read(&path).unwrap_err().to_string();
        assert_eq!(error, "it is larger than 256 MiB, the most that is read");
    }

    #[test]
    fn what_is_no_regular_file_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let error = read(folder.path()).unwrap_err();
        assert_eq!(error.to_string(), "it is a folder, not a regular file");
        assert_eq!(read(folder.path().join("b")).unwrap_err().kind(), ErrorKind::NotFound);
    }

    #[cfg(unix)]
    #[test]
    fn pipes_sockets_and_devices_are_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let socket = folder.path().join("socket");
        let _kept = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        let said = |path: &Path| read(path).unwrap_err().to_string();
        assert_eq!(said(&socket), "it is a socket, not a regular file");
        assert_eq!(said(Path::new("/dev/zero")), "it is a device, not a regular file");
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        if made.is_ok_and(|s| s.success()) {
            assert_eq!(said(&pipe), "it is a pipe, not a regular file");
        }
    }
}
