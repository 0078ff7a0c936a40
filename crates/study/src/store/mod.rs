//! A store of finished runs, which any study may take from.
//!
//! A folder of segments to which lines are added and never changed: `0001.segment`, beside it `0001.index`, which only
//! saves reading and is made again where it is missing or old, and `0001.lock`. Every process that writes has a segment of its own for as
//! long as it does, so there are as many as ever wrote at once, however many runs they hold. A line is a CRC-32, a blank
//! and JSON, as in a journal; the line that a killed process leaves torn counts as not written, and the next one that
//! writes there cuts it off. A whole line with a wrong sum is damage, and told as such.

mod index;
mod key;
mod segment;

pub use key::machine;
pub(crate) use key::{Key, Keys};

use crate::StudyError;
use crate::finished::Finished;
use index::Index;
use segment::{Segment, Writer};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// What a line holds.
#[derive(Serialize, Deserialize)]
struct Entry<R> {
    key: String,
    run: R,
}

/// An open store.
#[derive(Debug)]
pub(crate) struct Store {
    folder: PathBuf,
    segments: Vec<Segment>,
    index: Index,
    /// None until something is added.
    writer: Option<Writer>,
}

impl Store {
    /// Opens a store, or begins one.
    ///
    /// # Errors
    /// [`StudyError`] where it cannot be read, or a segment is damaged.
    pub fn open(folder: &Path) -> Result<Self, StudyError> {
        std::fs::create_dir_all(folder).map_err(StudyError::at(folder))?;
        let mut index = Index::default();
        let mut segments = Vec::new();
        for path in segment::all(folder)? {
            let number = segments.len();
            segments.push(Segment::open(&path, number, &mut index)?);
        }
        Ok(Self { folder: folder.to_owned(), segments, index, writer: None })
    }

    /// What a run came to, where it was kept.
    ///
    /// # Errors
    /// [`StudyError`] where its segment cannot be read or is damaged.
    pub fn find(&mut self, key: &Key) -> Result<Option<Finished>, StudyError> {
        let Some(place) = self.index.find(key) else { return Ok(None) };
        let segment = &mut self.segments[place.segment as usize];
        let json = segment.line(place)?;
        match serde_json::from_str::<Entry<Finished>>(&json) {
            Ok(entry) if entry.key == hexadecimal(key) => Ok(Some(entry.run)),
            _ => Err(segment.damaged(place.offset)),
        }
    }

    /// Keeps what a run came to; it is on disk when this returns.
    ///
    /// # Errors
    /// [`StudyError::File`].
    pub fn add(&mut self, key: &Key, run: &Finished) -> Result<(), StudyError> {
        if self.writer.is_none() {
            self.writer = Some(Writer::open(&self.folder, &mut self.segments, &mut self.index)?);
        }
        let Some(writer) = &mut self.writer else { return Ok(()) };
        let place = writer.write(&Entry { key: hexadecimal(key), run })?;
        self.index.add(key, place);
        Ok(())
    }

    /// Forces everything to the disk, and writes the index of what was added.
    ///
    /// # Errors
    /// [`StudyError::File`].
    pub fn close(mut self) -> Result<(), StudyError> {
        match self.writer.take() {
            Some(writer) => writer.close(&self.segments, &self.index),
            None => Ok(()),
        }
    }
}

fn hexadecimal(key: &Key) -> String {
    key.iter().map(|b| format!("{b:02x}")).collect()
}

#[cfg(test)]
mod tests;
