//! What lies where results are to go.

use super::made::{Made, frames};
use super::{FolderError, Writer};
use crate::vtk;
use std::fs;
use std::path::{Path, PathBuf};

/// A folder as a writer finds it.
#[derive(Debug)]
pub(super) struct Place {
    pub dir: PathBuf,
    pub writer: Writer,
    pub made: Made,
}

impl Place {
    pub fn new(dir: PathBuf, writer: Writer) -> Self {
        let made = Made::read(&dir);
        Self { dir, writer, made }
    }

    /// Reads again what the folder says of itself.
    pub fn read(&mut self) {
        self.made = Made::read(&self.dir);
    }

    /// Looks at all that is known to be replaced or taken out.
    pub fn look(&self) -> Result<(), FolderError> {
        self.writer.own.iter().try_for_each(|name| self.no_input(name))?;
        for name in &self.writer.writes {
            // Of the others in it none is replaced.
            if name == vtk::FRAMES && self.dir.join(name).is_dir() {
                frames(&self.dir).iter().try_for_each(|name| self.free(name))?;
            } else {
                self.free(name)?;
            }
        }
        Ok(())
    }

    /// Holds that a file may be written.
    pub fn free(&self, name: &str) -> Result<(), FolderError> {
        self.no_input(name)?;
        let in_the_way = |path| Err(FolderError::InTheWay { path, by: self.writer.name });
        for above in Path::new(name).ancestors().skip(1).filter(|above| *above != Path::new("")) {
            let above = self.dir.join(above);
            if is_there(&above) && !above.is_dir() {
                return in_the_way(above);
            }
        }
        let there = self.dir.join(name);
        let own = self.made.has(self.writer.name, name) && !there.is_dir();
        if is_there(&there) && !own { in_the_way(there) } else { Ok(()) }
    }

    /// What the writer takes out, in so far as it has made it.
    pub fn outdated(&self) -> Vec<String> {
        let own = |name: &&String| {
            let top = name.split('/').next().unwrap_or(name);
            self.writer.own.contains(&top) && !self.dir.join(name).is_dir()
        };
        self.made.of(self.writer.name).filter(own).cloned().collect()
    }

    fn no_input(&self, name: &str) -> Result<(), FolderError> {
        let there = self.dir.join(name);
        let same = |input: &&PathBuf| {
            let both = (fs::canonicalize(input), fs::canonicalize(&there));
            matches!(both, (Ok(a), Ok(b)) if a == b)
        };
        match self.writer.inputs.iter().find(same) {
            Some(input) => Err(FolderError::Input(input.clone())),
            None => Ok(()),
        }
    }
}

/// True of links that lead nowhere as well.
fn is_there(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}
