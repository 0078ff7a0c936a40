//! A folder of results of which nothing is seen before all of it is there, and in which nothing is lost that somebody
//! else has put there.

mod made;
mod place;
#[cfg(test)]
mod tests;

use crate::FileError;
use place::Place;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

/// What a run leaves in its folder; a later run without one of them takes it out. The first stands for all: where it is,
/// the others are of the same run.
pub const OF_RUN: [&str; 12] = [
    "summary.json",
    "made_by.json",
    "peaks.csv",
    "histories.csv",
    "histories.npz",
    "spectra.csv",
    "envelopes.csv",
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
    /// Something that is not of the same writer.
    #[error("{} is in the way: no earlier `trilith {by}` has made it", .path.display())]
    InTheWay {
        /// What is there.
        path: PathBuf,
        /// Whose results would replace it.
        by: &'static str,
    },
    /// A file or folder that cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}

/// Who writes into a folder, and what.
#[derive(Clone, Debug, Default)]
pub struct Writer {
    /// The command. A folder keeps in mind which files are whose, and nobody replaces those of others.
    pub name: &'static str,
    /// Names of which it takes out what it has made before; the one that stands for all first.
    pub own: &'static [&'static str],
    /// Names that it will write, as far as they are known beforehand.
    pub writes: Vec<String>,
    /// Files that nothing may overwrite.
    pub inputs: Vec<PathBuf>,
}

/// A folder that is held by this run until it is dropped. Files are written to a [place](Self::path) inside it that
/// nobody else looks at, and [published](Self::publish) together; an end before that leaves what was there before.
#[derive(Debug)]
pub struct Folder {
    place: Place,
    staging: PathBuf,
    /// Held until the end.
    _lock: File,
}

impl Folder {
    /// Takes a folder, which is made where it does not exist.
    ///
    /// # Errors
    /// What is in the way, before anything is written.
    pub fn open(dir: impl AsRef<Path>, writer: Writer) -> Result<Self, FolderError> {
        let dir = dir.as_ref().to_owned();
        if dir.exists() && !dir.is_dir() {
            return Err(FolderError::NotAFolder(dir));
        }
        let mut place = Place::new(dir.clone(), writer);
        place.look()?;
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
        // Somebody may have ended in the meantime.
        place.read();
        let staging = dir.join(STAGING);
        // Of a run that was killed.
        if staging.exists() {
            fs::remove_dir_all(&staging).map_err(FileError::at(&staging))?;
        }
        fs::create_dir(&staging).map_err(FileError::at(&staging))?;
        Ok(Self { place, staging, _lock: lock })
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
            Ok(inside) if inside.as_os_str().is_empty() => self.place.dir.clone(),
            Ok(inside) => self.place.dir.join(inside),
            Err(_) => written.to_owned(),
        }
    }

    /// Puts all that was written in its place.
    ///
    /// # Errors
    /// What is in the way, before anything is replaced; a file that cannot be replaced.
    pub fn publish(mut self) -> Result<(), FolderError> {
        let mut new = Vec::new();
        files(&self.staging, "", &mut new)?;
        new.iter().try_for_each(|name| self.place.free(name))?;
        let first = self.place.writer.own.first().copied();
        let mut old = self.place.outdated();
        // Known before it is there: wherever this stops, the next run finds nothing of nobody.
        self.place.made.add(self.place.writer.name, &new);
        self.place.made.write(&self.staging)?;
        // What stands for all goes before anything is replaced, and comes last.
        old.sort_by_key(|name| Some(name.as_str()) != first);
        for name in &old {
            remove(&self.place.dir.join(name))?;
        }
        new.sort_by_key(|name| (Some(name.as_str()) == first, name.clone()));
        for name in &new {
            let to = self.place.dir.join(name);
            if let Some(above) = to.parent() {
                fs::create_dir_all(above).map_err(FileError::at(above))?;
            }
            fs::rename(self.staging.join(name), &to).map_err(FileError::at(&to))?;
        }
        old.retain(|name| !new.contains(name));
        if old.is_empty() {
            return Ok(());
        }
        for above in old.iter().filter_map(|name| Path::new(name).parent()) {
            if above != Path::new("") {
                // One that holds something else stays.
                let _ = fs::remove_dir(self.place.dir.join(above));
            }
        }
        self.place.made.forget(&old);
        Ok(self.place.made.write(&self.staging)?)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What stays is taken out by the next run.
        let _ = fs::remove_dir_all(&self.staging);
    }
}

/// The files in a folder and in those below it, `/` between the names.
fn files(dir: &Path, above: &str, found: &mut Vec<String>) -> Result<(), FileError> {
    for entry in fs::read_dir(dir).map_err(FileError::at(dir))? {
        let entry = entry.map_err(FileError::at(dir))?;
        let name = format!("{above}{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            files(&entry.path(), &format!("{name}/"), found)?;
        } else {
            found.push(name);
        }
    }
    Ok(())
}

fn remove(path: &Path) -> Result<(), FileError> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(FileError::at(path)(e)),
        _ => Ok(()),
    }
}
