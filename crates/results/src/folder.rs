//! A folder of results of which nothing is seen before all of it is there.

use crate::FileError;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

/// What a run leaves in its folder; a later run without one of them takes it out. The first stands for all: where it is,
/// the others are of the same run, and where it is not, they are somebody else's.
pub const OF_RUN: [&str; 11] = [
    "summary.json",
    "made_by.json",
    "peaks.csv",
    "histories.csv",
    "histories.npz",
    "spectra.csv",
    "model.resolved.ron",
    "report.json",
    "report.html",
    "model.pvd",
    "frames",
];

const LOCK: &str = ".trilith.lock";
const STAGING: &str = ".trilith.new";

/// A folder that results cannot go to.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FolderError {
    /// There is a file of that name.
    #[error("{} is a file, no folder", .0.display())]
    NotAFolder(PathBuf),
    /// Somebody else writes there now.
    #[error("another run is writing to {}", .0.display())]
    Taken(PathBuf),
    /// A file that is read.
    #[error("{} is an input, and would be overwritten", .0.display())]
    Input(PathBuf),
    /// A file or folder that cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}

/// A folder that is held by this run until it is dropped. Files are written to a [place](Self::path) inside it that
/// nobody else looks at, and [published](Self::publish) together; an end before that leaves what was there before.
#[derive(Debug)]
pub struct Folder {
    dir: PathBuf,
    staging: PathBuf,
    own: Vec<String>,
    inputs: Vec<PathBuf>,
    /// Held until the end.
    _lock: File,
}

impl Folder {
    /// Takes a folder, which is made where it does not exist. `own`: names that publishing replaces or takes out, the
    /// one that stands for all first. `inputs`: files that nothing may overwrite.
    ///
    /// # Errors
    /// What is in the way, before anything is written.
    pub fn open(
        dir: impl AsRef<Path>,
        own: &[&str],
        inputs: &[PathBuf],
    ) -> Result<Self, FolderError> {
        let dir = dir.as_ref().to_owned();
        if dir.exists() && !dir.is_dir() {
            return Err(FolderError::NotAFolder(dir));
        }
        fs::create_dir_all(&dir).map_err(FileError::at(&dir))?;
        let path = dir.join(LOCK);
        let lock = File::options().create(true).append(true).open(&path);
        let lock = lock.map_err(FileError::at(&path))?;
        match lock.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(FolderError::Taken(dir)),
            // Some network folders know no locks.
            Err(TryLockError::Error(e)) if e.kind() != std::io::ErrorKind::Unsupported => {
                return Err(FileError::at(&path)(e).into());
            }
            _ => {}
        }
        let staging = dir.join(STAGING);
        // Of a run that was killed.
        if staging.exists() {
            fs::remove_dir_all(&staging).map_err(FileError::at(&staging))?;
        }
        fs::create_dir(&staging).map_err(FileError::at(&staging))?;
        let own = own.iter().map(|name| (*name).to_owned()).collect();
        let it = Self { dir, staging, own, inputs: inputs.to_vec(), _lock: lock };
        it.own.iter().try_for_each(|name| it.check(name))?;
        Ok(it)
    }

    /// Where to write.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.staging
    }

    /// Where a file that was written to [`path`](Self::path) will be.
    #[must_use]
    pub fn published(&self, written: &Path) -> PathBuf {
        match written.strip_prefix(&self.staging) {
            Ok(inside) if inside.as_os_str().is_empty() => self.dir.clone(),
            Ok(inside) => self.dir.join(inside),
            Err(_) => written.to_owned(),
        }
    }

    /// Puts all that was written in its place.
    ///
    /// # Errors
    /// An input that would be overwritten, before anything is replaced; a file that cannot be replaced.
    pub fn publish(self) -> Result<(), FolderError> {
        let mut names = Vec::new();
        let all = fs::read_dir(&self.staging).map_err(FileError::at(&self.staging))?;
        for entry in all {
            let entry = entry.map_err(FileError::at(&self.staging))?;
            names.push(entry.file_name().to_string_lossy().into_owned());
        }
        names.iter().try_for_each(|name| self.check(name))?;
        // What stands for all goes before anything is replaced, and comes last.
        let first = self.own.first();
        names.sort_by_key(|name| (Some(name) == first, name.clone()));
        if first.is_some_and(|name| self.dir.join(name).exists()) {
            for name in self.own.iter().rev() {
                remove(&self.dir.join(name))?;
            }
        }
        for name in &names {
            let to = self.dir.join(name);
            if to.is_dir() {
                remove(&to)?;
            }
            fs::rename(self.staging.join(name), &to).map_err(FileError::at(&to))?;
        }
        Ok(())
    }

    /// A name in the folder is no input.
    fn check(&self, name: &str) -> Result<(), FolderError> {
        let there = self.dir.join(name);
        let same = |input: &&PathBuf| {
            let both = (fs::canonicalize(input), fs::canonicalize(&there));
            matches!(both, (Ok(a), Ok(b)) if a == b)
        };
        match self.inputs.iter().find(same) {
            Some(input) => Err(FolderError::Input(input.clone())),
            None => Ok(()),
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What stays is taken out by the next run.
        let _ = fs::remove_dir_all(&self.staging);
    }
}

fn remove(path: &Path) -> Result<(), FileError> {
    let done = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
    match done {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(FileError::at(path)(e)),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(folder: &Folder, name: &str, text: &str) {
        fs::write(folder.path().join(name), text).unwrap();
    }

    #[test]
    fn results_are_seen_together_and_replace_those_before() {
        let at = tempfile::tempdir().unwrap();
        let dir = at.path().join("a/b");
        let own = ["summary", "peaks", "frames"];
        let folder = Folder::open(&dir, &own, &[]).unwrap();
        write(&folder, "peaks", "1");
        write(&folder, "summary", "1");
        fs::create_dir(folder.path().join("frames")).unwrap();
        write(&folder, "frames/0", "1");
        assert!(!dir.join("peaks").exists());
        assert_eq!(folder.published(&folder.path().join("peaks")), dir.join("peaks"));
        folder.publish().unwrap();
        fs::write(dir.join("notes"), "mine").unwrap();
        assert_eq!(fs::read_to_string(dir.join("frames/0")).unwrap(), "1");

        // One that ends early changes nothing.
        let folder = Folder::open(&dir, &own, &[]).unwrap();
        write(&folder, "peaks", "2");
        drop(folder);
        assert_eq!(fs::read_to_string(dir.join("peaks")).unwrap(), "1");

        let folder = Folder::open(&dir, &own, &[]).unwrap();
        write(&folder, "summary", "3");
        folder.publish().unwrap();
        assert!(!dir.join("peaks").exists() && !dir.join("frames").exists());
        assert_eq!(fs::read_to_string(dir.join("summary")).unwrap(), "3");
        assert_eq!(fs::read_to_string(dir.join("notes")).unwrap(), "mine");
    }

    #[test]
    fn what_no_run_has_left_stays() {
        let at = tempfile::tempdir().unwrap();
        fs::write(at.path().join("spectra.csv"), "of a record").unwrap();
        let folder = Folder::open(at.path(), &OF_RUN, &[]).unwrap();
        write(&folder, "summary.json", "1");
        folder.publish().unwrap();
        assert!(at.path().join("spectra.csv").exists());
    }

    #[test]
    fn a_folder_has_one_writer() {
        let at = tempfile::tempdir().unwrap();
        let first = Folder::open(at.path(), &[], &[]).unwrap();
        assert!(matches!(Folder::open(at.path(), &[], &[]), Err(FolderError::Taken(_))));
        drop(first);
        assert!(Folder::open(at.path(), &[], &[]).is_ok());
    }

    #[test]
    fn what_is_in_the_way_is_told_before_anything_is_written() {
        let at = tempfile::tempdir().unwrap();
        let file = at.path().join("peaks.csv");
        fs::write(&file, "t,a").unwrap();
        assert!(matches!(Folder::open(&file, &[], &[]), Err(FolderError::NotAFolder(_))));
        let inputs = [at.path().join("./peaks.csv")];
        let taken = Folder::open(at.path(), &OF_RUN, &inputs);
        assert!(matches!(taken, Err(FolderError::Input(_))));
        // A name that is known at the end only.
        let folder = Folder::open(at.path(), &[], &inputs).unwrap();
        write(&folder, "peaks.csv", "");
        assert!(matches!(folder.publish(), Err(FolderError::Input(_))));
        assert_eq!(fs::read_to_string(&file).unwrap(), "t,a");
    }
}
