//! Reading files that the user names: regular ones only, up to a size.
//!
//! A pipe would keep the program waiting and a device would fill the memory; both are refused before they are
//! opened. A browser has no files: there they come from `memory`.

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
#[path = "file/disk.rs"]
mod source;

#[cfg(any(test, all(target_family = "wasm", target_os = "unknown")))]
pub mod memory;
#[cfg(all(target_family = "wasm", target_os = "unknown"))]
use memory as source;

use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};

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
    source::read(path.as_ref(), MOST_BYTES)
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

/// The one path of a file, links followed.
///
/// # Errors
/// Those of the system.
pub fn canonical(path: impl AsRef<Path>) -> Result<PathBuf> {
    source::canonical(path.as_ref())
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
        assert_eq!(source::read(&path, 5).unwrap(), b"12345");
        let error = source::read(&path, 4).unwrap_err();
        assert!(error.to_string().contains("the most that is read"), "{error}");
        std::fs::write(&path, b"a\nb\n\xff").unwrap();
        assert_eq!(read_text(&path).unwrap_err().to_string(), "line 3 is no text in UTF-8");
    }

    #[test]
    fn a_file_above_the_limit_is_told_with_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("large");
        // A hole: it takes no room on the disk.
        std::fs::File::create(&path).unwrap().set_len(MOST_BYTES + 1).unwrap();
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
