//! Files where no system keeps any: in a browser, whose page hands them over.

use super::Refusal;
use std::collections::BTreeMap;
use std::io::{Error, ErrorKind, Result};
use std::path::{Component, Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

static FILES: Mutex<BTreeMap<PathBuf, Vec<u8>>> = Mutex::new(BTreeMap::new());

fn files() -> MutexGuard<'static, BTreeMap<PathBuf, Vec<u8>>> {
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps a file; one of the same path is no more.
pub fn keep(path: impl AsRef<Path>, content: Vec<u8>) {
    files().insert(plain(path.as_ref()), content);
}

/// Forgets all files.
pub fn forget() {
    files().clear();
}

/// The path without `.` and `a/..`: there are no links to follow.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if plain.file_name().is_some() => _ = plain.pop(),
            part => plain.push(part),
        }
    }
    plain
}

#[cfg_attr(not(target_family = "wasm"), allow(dead_code, reason = "only tests look at it here"))]
pub(super) fn canonical(path: &Path) -> Result<PathBuf> {
    let path = plain(path);
    let files = files();
    let known = path.as_os_str().is_empty() || files.keys().any(|file| file.starts_with(&path));
    if known { Ok(path) } else { Err(ErrorKind::NotFound.into()) }
}

#[cfg_attr(not(target_family = "wasm"), allow(dead_code, reason = "only tests look at it here"))]
pub(super) fn read(path: &Path, most: u64) -> Result<Vec<u8>> {
    let files = files();
    let content = files.get(&plain(path)).ok_or_else(|| Error::from(ErrorKind::NotFound))?;
    if content.len() as u64 > most {
        return Err(Refusal::TooLarge { mebibytes: most >> 20 }.into());
    }
    Ok(content.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kept_file_is_found_by_every_way_to_it() {
        keep("a/b.ron", b"()".to_vec());
        assert_eq!(read(Path::new("./a/../a/b.ron"), 10).unwrap(), b"()");
        assert_eq!(canonical(Path::new("a/./b.ron")).unwrap(), Path::new("a/b.ron"));
        assert_eq!(canonical(Path::new("a")).unwrap(), Path::new("a"));
        assert_eq!(canonical(Path::new("a/c.ron")).unwrap_err().kind(), ErrorKind::NotFound);
        assert!(read(Path::new("a/b.ron"), 1).unwrap_err().to_string().contains("larger"));
        forget();
        assert_eq!(read(Path::new("a/b.ron"), 10).unwrap_err().kind(), ErrorKind::NotFound);
    }
}
