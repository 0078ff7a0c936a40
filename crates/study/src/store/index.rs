//! Where in a store each run is.
//!
//! The file beside a segment: `TRILIDX1`, CRC-32 of the first line of the segment, bytes that it covers, number of entries,
//! entries of 16 bytes of the key, offset and length, and the CRC-32 of all before. Numbers are little-endian.

use super::Key;
use crate::StudyError;
use crate::table::replaced;
use std::collections::HashMap;
use std::io::Write;
use std::path::Path;

const MAGIC: &[u8; 8] = b"TRILIDX1";
/// Bytes before the entries, and of an entry.
const HEAD: usize = 28;
const ENTRY: usize = 28;

/// A line of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    /// Number of the segment.
    pub segment: u32,
    /// Bytes before the line.
    pub offset: u64,
    /// Bytes of the line, its end included.
    pub length: u32,
}

/// Places by the first half of their keys: what lies there is compared with the whole key.
#[derive(Debug, Default)]
pub(super) struct Index(HashMap<u128, Place>);

fn half(key: &[u8]) -> u128 {
    let mut bytes = [0; 16];
    bytes.copy_from_slice(&key[..16]);
    u128::from_le_bytes(bytes)
}

impl Index {
    pub fn find(&self, key: &Key) -> Option<Place> {
        self.0.get(&half(key)).copied()
    }

    /// A run that was kept twice counts as it was kept last.
    pub fn add(&mut self, key: &Key, place: Place) {
        self.0.insert(half(key), place);
    }

    /// Takes over what the file beside a segment says, where that is of this segment and whole; returns how many bytes of
    /// the segment it covers.
    pub fn take(&mut self, path: &Path, segment: u32, first_line: u32) -> u64 {
        let Ok(bytes) = std::fs::read(path) else { return 0 };
        let Some((body, sum)) = bytes.split_last_chunk::<4>() else { return 0 };
        let good = body.len() >= HEAD
            && (body.len() - HEAD).is_multiple_of(ENTRY)
            && body.starts_with(MAGIC)
            && u32::from_le_bytes(*sum) == crc32fast::hash(body);
        if !good || four(&body[8..]) != first_line {
            return 0;
        }
        for entry in body[HEAD..].chunks_exact(ENTRY) {
            let place = Place { segment, offset: eight(&entry[16..]), length: four(&entry[24..]) };
            self.0.insert(half(entry), place);
        }
        eight(&body[12..])
    }

    /// Writes the file beside a segment.
    pub fn write(
        &self,
        path: &Path,
        segment: u32,
        first_line: u32,
        covered: u64,
    ) -> Result<(), StudyError> {
        let own = self.0.iter().filter(|(_, place)| place.segment == segment);
        let mut body = Vec::with_capacity(HEAD + ENTRY * self.0.len());
        body.extend(MAGIC);
        body.extend(first_line.to_le_bytes());
        body.extend(covered.to_le_bytes());
        body.extend((own.clone().count() as u64).to_le_bytes());
        for (key, place) in own {
            body.extend(key.to_le_bytes());
            body.extend(place.offset.to_le_bytes());
            body.extend(place.length.to_le_bytes());
        }
        body.extend(crc32fast::hash(&body).to_le_bytes());
        replaced(path, |file| file.write_all(&body))
    }
}

fn four(bytes: &[u8]) -> u32 {
    bytes.first_chunk().map_or(0, |b| u32::from_le_bytes(*b))
}

fn eight(bytes: &[u8]) -> u64 {
    bytes.first_chunk().map_or(0, |b| u64::from_le_bytes(*b))
}
