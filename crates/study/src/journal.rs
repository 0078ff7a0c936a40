//! The journal: a line for each finished run, on disk as soon as the run is.
//!
//! A line is the CRC-32 of the rest in hexadecimal, a blank, and a [`Record`] as JSON. The first line is the
//! [`Identity`] of the study in the same form. A line whose sum is wrong, torn by a stop or a full disk, counts
//! as not written.

use crate::{Identity, Records, StudyError};
use serde::{Deserialize, Serialize};
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How often lines are forced from the system to the disk. A killed process loses none in any case; this is
/// what a power cut may cost.
const SYNC: Duration = Duration::from_secs(2);

/// What is kept of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Its number, from 0.
    pub run: usize,
    /// `converged`, `overturned`, or what failed.
    pub status: String,
    /// True for a result to be trusted.
    pub good: bool,
    /// What failed in a sentence; empty for a good run.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub message: String,
    /// What the run warned of.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// True where a body has fallen over.
    pub overturned: bool,
    /// Mode in which the body leaves rest.
    pub initial_mode: Option<String>,
    /// Mode over the whole run.
    pub mode: Option<String>,
    /// Values of the varied parameters, SI.
    pub parameters: Vec<Cell>,
    /// Values of the columns, SI.
    pub values: Vec<Option<f64>>,
}

/// A value in a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Cell {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// Nothing.
    Nothing,
}

/// The open journal of a study.
#[derive(Debug)]
pub(crate) struct Journal<W = File> {
    file: W,
    path: PathBuf,
    /// Bytes that are whole lines.
    length: u64,
    synced: Instant,
}

/// What a file of the journal has to offer beyond writing.
pub(crate) trait Storage: Write + Seek {
    fn cut(&mut self, length: u64) -> std::io::Result<()>;
    fn sync(&mut self) -> std::io::Result<()>;
}

impl Storage for File {
    fn cut(&mut self, length: u64) -> std::io::Result<()> {
        self.set_len(length)
    }
    fn sync(&mut self) -> std::io::Result<()> {
        self.sync_data()
    }
}

pub(crate) fn line(value: &impl Serialize) -> Result<String, serde_json::Error> {
    let json = serde_json::to_string(value)?;
    Ok(format!("{:08x} {json}\n", crc32fast::hash(json.as_bytes())))
}

/// The JSON of a whole line.
pub(crate) fn content(line: &str) -> Option<&str> {
    let (sum, json) = line.strip_suffix('\n')?.split_once(' ')?;
    let sum = (sum.len() == 8).then(|| u32::from_str_radix(sum, 16).ok()).flatten()?;
    (sum == crc32fast::hash(json.as_bytes())).then_some(json)
}

/// What a journal held.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    pub records: Records,
    /// Lines that were torn.
    pub torn: usize,
}

/// What a journal holds on disk.
pub(crate) struct Read {
    pub kept: Kept,
    /// Bytes up to the end of the last whole line.
    length: u64,
    /// True where not even the identity is whole: it was stopped while it began.
    empty: bool,
}

/// Reads what a journal holds; refuses one of another study.
fn read(path: &Path, identity: &Identity) -> Result<Read, StudyError> {
    let file = File::open(path).map_err(StudyError::at(path))?;
    parse(BufReader::new(file), path, identity)
}

/// The same of its bytes; `path`: where they are from.
pub(crate) fn parse(
    mut bytes: impl BufRead,
    path: &Path,
    identity: &Identity,
) -> Result<Read, StudyError> {
    let mut found = Read { kept: Kept::default(), length: 0, empty: true };
    let (mut at, mut part) = (0, Vec::new());
    loop {
        part.clear();
        let read = bytes.read_until(b'\n', &mut part).map_err(StudyError::at(path))?;
        if read == 0 {
            break;
        }
        at += read as u64;
        let json = std::str::from_utf8(&part).ok().and_then(content);
        if found.empty {
            let Some(json) = json else {
                // Stopped while the very first line was written: nothing is lost. Only the last line has no end.
                if !part.ends_with(b"\n") {
                    break;
                }
                return Err(StudyError::NoJournal { path: path.to_owned() });
            };
            let own: Identity = serde_json::from_str(json)
                .map_err(|_| StudyError::NoJournal { path: path.to_owned() })?;
            identity.same(&own, path)?;
            found.empty = false;
            found.length = at;
            continue;
        }
        match json.and_then(|j| serde_json::from_str::<Record>(j).ok()) {
            // A run that was made again counts as it was made last.
            Some(record) => {
                found.kept.records.insert(record);
                found.length = at;
            }
            None => found.kept.torn += 1,
        }
    }
    Ok(found)
}

impl Kept {
    /// What a journal holds that another process may be writing.
    pub fn of(path: &Path, identity: &Identity) -> Result<Self, StudyError> {
        read(path, identity).map(|found| found.kept)
    }
}

impl Journal {
    /// Opens the journal of a folder, or begins it.
    pub fn open(path: &Path, identity: &Identity) -> Result<(Self, Kept), StudyError> {
        let fail = StudyError::at(path);
        let open =
            OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
        let file = open.map_err(&fail)?;
        if !file.metadata().map_err(&fail)?.is_file() {
            return Err(StudyError::NoJournal { path: path.to_owned() });
        }
        let Read { kept, length, empty } = read(path, identity)?;
        let mut journal = Self::at(file, path, length)?;
        if empty {
            journal.write(identity)?;
            journal.file.sync().map_err(&fail)?;
        }
        Ok((journal, kept))
    }

    /// Goes on behind the whole lines of a file.
    pub fn at(file: File, path: &Path, length: u64) -> Result<Self, StudyError> {
        let mut journal = Self { file, path: path.to_owned(), length, synced: Instant::now() };
        // A torn line at the end goes, so that the next one begins a line.
        journal.file.cut(length).map_err(StudyError::at(path))?;
        journal.file.seek(SeekFrom::Start(length)).map_err(StudyError::at(path))?;
        Ok(journal)
    }
}

impl<W: Storage> Journal<W> {
    /// Writes a line at once.
    pub fn write(&mut self, value: &impl Serialize) -> Result<(), StudyError> {
        let text = line(value).map_err(|e| StudyError::at(&self.path)(e.into()))?;
        if let Err(e) = self.file.write_all(text.as_bytes()) {
            // Without the half line the rest stays readable; if that fails too, its sum tells.
            let _ = self.file.cut(self.length);
            let _ = self.file.seek(SeekFrom::Start(self.length));
            return Err(StudyError::at(&self.path)(e));
        }
        self.length += text.len() as u64;
        if self.synced.elapsed() > SYNC {
            self.sync()?;
        }
        Ok(())
    }

    /// Bytes that are whole lines.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Forces everything to the disk.
    pub fn sync(&mut self) -> Result<(), StudyError> {
        self.synced = Instant::now();
        self.file.sync().map_err(StudyError::at(&self.path))
    }
}

#[cfg(test)]
mod tests;
