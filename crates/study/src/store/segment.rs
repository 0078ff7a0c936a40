//! A segment of a store: lines that are added and never changed.

use super::index::{Index, Place};
use crate::StudyError;
use crate::journal::{Journal, content, line};
use serde::{Deserialize, Serialize};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

/// Most segments of a store: as many as write at once.
const MOST: usize = 100_000;

/// The first line of a segment.
#[derive(Serialize, Deserialize)]
struct First {
    /// Form of what follows.
    trilith_store: u32,
    /// Tells it from another one of the same name, which an index may be left of.
    begun: String,
}

/// A segment that is read.
#[derive(Debug)]
pub(super) struct Segment {
    path: PathBuf,
    file: File,
    /// CRC-32 of its first line; none where that is not whole yet.
    first: Option<u32>,
    /// Bytes of whole lines that are in the index.
    known: u64,
}

/// The segments in a folder, in the order of their names.
pub(super) fn all(folder: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let fail = StudyError::at(folder);
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(&fail)? {
        let path = entry.map_err(&fail)?.path();
        if path.extension().is_some_and(|e| e == "segment") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

impl Segment {
    /// Opens a segment and takes its runs into the index.
    pub fn open(path: &Path, number: usize, index: &mut Index) -> Result<Self, StudyError> {
        let file = File::open(path).map_err(StudyError::at(path))?;
        let mut segment = Self { path: path.to_owned(), file, first: None, known: 0 };
        segment.look(number as u32, index)?;
        Ok(segment)
    }

    /// Takes what has come since into the index. A torn line at the end, or one that is being written, is left out.
    fn look(&mut self, number: u32, index: &mut Index) -> Result<(), StudyError> {
        let fail = StudyError::at(&self.path);
        if self.first.is_none() {
            self.file.rewind().map_err(&fail)?;
            let mut text = Vec::new();
            BufReader::new(&self.file).read_until(b'\n', &mut text).map_err(&fail)?;
            if text.last() != Some(&b'\n') {
                return Ok(());
            }
            let json = std::str::from_utf8(&text).ok().and_then(content);
            let first = json.and_then(|json| serde_json::from_str::<First>(json).ok());
            if first.is_none_or(|first| first.trilith_store != 1) {
                return Err(StudyError::NoSegment { path: self.path.clone() });
            }
            let sum = crc32fast::hash(&text);
            self.first = Some(sum);
            self.known = index.take(&self.path.with_extension("index"), number, sum);
            let size = self.file.metadata().map_err(&fail)?.len();
            if self.known > size {
                return Err(self.damaged(size));
            }
            self.known = self.known.max(text.len() as u64);
        }
        self.file.seek(SeekFrom::Start(self.known)).map_err(&fail)?;
        let mut lines = BufReader::new(&self.file);
        let mut text = Vec::new();
        loop {
            text.clear();
            lines.read_until(b'\n', &mut text).map_err(&fail)?;
            if text.last() != Some(&b'\n') {
                return Ok(());
            }
            let json = std::str::from_utf8(&text).ok().and_then(content);
            let (Some(key), Ok(length)) = (json.and_then(key_of), text.len().try_into()) else {
                return Err(self.damaged(self.known));
            };
            index.add(&key, Place { segment: number, offset: self.known, length });
            self.known += u64::from(length);
        }
    }

    /// The JSON of a line.
    pub fn line(&mut self, place: Place) -> Result<String, StudyError> {
        let mut bytes = vec![0; place.length as usize];
        let read = self
            .file
            .seek(SeekFrom::Start(place.offset))
            .and_then(|_| self.file.read_exact(&mut bytes));
        match read {
            Err(e) if e.kind() == ErrorKind::UnexpectedEof => Err(self.damaged(place.offset)),
            Err(e) => Err(StudyError::at(&self.path)(e)),
            Ok(()) => {
                let json = std::str::from_utf8(&bytes).ok().and_then(content);
                json.map(str::to_owned).ok_or_else(|| self.damaged(place.offset))
            }
        }
    }

    pub fn damaged(&self, offset: u64) -> StudyError {
        StudyError::Damaged { path: self.path.clone(), offset }
    }
}

/// The key that an entry begins with.
fn key_of(json: &str) -> Option<super::Key> {
    let text = json.strip_prefix("{\"key\":\"")?.get(..64)?;
    let mut key = [0; 32];
    for (byte, two) in key.iter_mut().zip(text.as_bytes().chunks_exact(2)) {
        *byte = u8::from_str_radix(std::str::from_utf8(two).ok()?, 16).ok()?;
    }
    Some(key)
}

/// The segment that this process adds to.
#[derive(Debug)]
pub(super) struct Writer {
    lines: Journal,
    /// Number of the segment.
    number: u32,
    /// Keeps other processes out for as long as it is open; none where the system has no locks.
    _lock: Option<File>,
}

/// The lock of a segment, in a file of its own, so that others may read the segment in the meantime. An error of kind
/// `WouldBlock` where another process has it.
fn lock(segment: &Path) -> Result<File, TryLockError> {
    let path = segment.with_extension("lock");
    let file = OpenOptions::new().write(true).create(true).truncate(false).open(path);
    let file = file.map_err(TryLockError::Error)?;
    file.try_lock().map(|()| file)
}

impl Writer {
    /// Takes a segment that nobody writes, or begins one.
    pub fn open(
        folder: &Path,
        segments: &mut Vec<Segment>,
        index: &mut Index,
    ) -> Result<Self, StudyError> {
        for number in 0..segments.len() {
            let path = segments[number].path.clone();
            let Ok(lock) = lock(&path) else { continue };
            // One that may only be read is as good as one that another process writes.
            let file = OpenOptions::new().read(true).write(true).open(&path);
            if let Ok(file) = file {
                return Self::on(file, Some(lock), number, segments, index);
            }
        }
        for name in segments.len() + 1..MOST {
            let path = folder.join(format!("{name:04}.segment"));
            let lock = match lock(&path) {
                Ok(lock) => Some(lock),
                Err(TryLockError::WouldBlock) => continue,
                // Without locks a new segment still is nobody else's.
                Err(TryLockError::Error(_)) => None,
            };
            let new = OpenOptions::new().read(true).write(true).create_new(true).open(&path);
            let file = match new {
                Err(e) if e.kind() == ErrorKind::AlreadyExists => continue,
                other => other.map_err(StudyError::at(&path))?,
            };
            let number = segments.len();
            segments.push(Segment::open(&path, number, index)?);
            return Self::on(file, lock, number, segments, index);
        }
        let cause = std::io::Error::other(format!("there are {MOST} segments already"));
        Err(StudyError::at(folder)(cause))
    }

    fn on(
        file: File,
        lock: Option<File>,
        number: usize,
        segments: &mut [Segment],
        index: &mut Index,
    ) -> Result<Self, StudyError> {
        let segment = &mut segments[number];
        // What the process before has added since, and without what it left torn.
        segment.look(number as u32, index)?;
        let mut lines = Journal::at(file, &segment.path, segment.known)?;
        if segment.first.is_none() {
            let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
            let begun = format!("{}-{}", since.as_nanos(), std::process::id());
            let first = First { trilith_store: 1, begun };
            lines.write(&first)?;
            let text = line(&first).map_err(|e| StudyError::at(&segment.path)(e.into()))?;
            segment.first = Some(crc32fast::hash(text.as_bytes()));
            segment.known = lines.length();
        }
        Ok(Self { lines, number: number as u32, _lock: lock })
    }

    pub fn write(&mut self, entry: &impl Serialize) -> Result<Place, StudyError> {
        let offset = self.lines.length();
        self.lines.write(entry)?;
        let length = (self.lines.length() - offset) as u32;
        Ok(Place { segment: self.number, offset, length })
    }

    pub fn close(mut self, segments: &[Segment], index: &Index) -> Result<(), StudyError> {
        self.lines.sync()?;
        let segment = &segments[self.number as usize];
        let Some(first) = segment.first else { return Ok(()) };
        let path = segment.path.with_extension("index");
        index.write(&path, self.number, first, self.lines.length())
    }
}
