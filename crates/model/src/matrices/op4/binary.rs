//! Unformatted files of Fortran: records of words of four bytes, in either order of bytes.

use super::super::Entries;
use super::{Column, Found, follows, head};

/// The order of the bytes of a number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    Little,
    Big,
}

impl Order {
    fn whole(self, bytes: [u8; 4]) -> i64 {
        i64::from(match self {
            Self::Little => i32::from_le_bytes(bytes),
            Self::Big => i32::from_be_bytes(bytes),
        })
    }

    fn single(self, bytes: [u8; 4]) -> f64 {
        f64::from(match self {
            Self::Little => f32::from_le_bytes(bytes),
            Self::Big => f32::from_be_bytes(bytes),
        })
    }

    fn double(self, bytes: [u8; 8]) -> f64 {
        match self {
            Self::Little => f64::from_le_bytes(bytes),
            Self::Big => f64::from_be_bytes(bytes),
        }
    }
}

/// Bytes of a head: four words and a name of eight characters. Those of words of eight bytes, which are not read.
const HEAD: i64 = 24;
const LONG_HEAD: i64 = 48;

/// The order of bytes of an unformatted file; none of a formatted one.
pub(super) fn order(bytes: &[u8]) -> Option<Order> {
    let first: [u8; 4] = bytes.get(..4)?.try_into().ok()?;
    [Order::Little, Order::Big].into_iter().find(|o| [HEAD, LONG_HEAD].contains(&o.whole(first)))
}

/// Records one after the other.
struct Records<'a> {
    rest: &'a [u8],
    order: Order,
}

impl<'a> Records<'a> {
    /// The bytes of the next record; none at the end of the file.
    fn next(&mut self) -> Result<Option<&'a [u8]>, String> {
        if self.rest.is_empty() {
            return Ok(None);
        }
        let cut = || "a record does not end: the file has been cut off, or is damaged".to_owned();
        let (length, rest) = self.rest.split_first_chunk::<4>().ok_or_else(cut)?;
        let size = usize::try_from(self.order.whole(*length)).map_err(|_| cut())?;
        let (record, rest) = rest.split_at_checked(size).ok_or_else(cut)?;
        let (again, rest) = rest.split_first_chunk::<4>().ok_or_else(cut)?;
        if length != again {
            return Err(cut());
        }
        self.rest = rest;
        Ok(Some(record))
    }
}

/// All matrices of a file.
pub(super) fn read(bytes: &[u8], order: Order) -> Result<Vec<Found>, String> {
    let mut records = Records { rest: bytes, order };
    let mut found = Vec::new();
    while let Some(record) = records.next()? {
        found.push(matrix(record, &mut records)?);
    }
    Ok(found)
}

/// The words of a record as whole numbers.
fn word(record: &[u8], i: usize, order: Order) -> Option<i64> {
    let bytes = record.get(4 * i..4 * i + 4)?.try_into().ok()?;
    Some(order.whole(bytes))
}

fn matrix(record: &[u8], records: &mut Records<'_>) -> Result<Found, String> {
    let order = records.order;
    if record.len() as i64 == LONG_HEAD {
        return Err(
            "its words have eight bytes: those of four are read, or a formatted file".into()
        );
    }
    let Some([a, b, c, d]) = (record.len() as i64 == HEAD)
        .then(|| [0, 1, 2, 3].map(|i| word(record, i, order).unwrap_or_default()))
    else {
        return Err(format!(
            "a record of {} bytes where a matrix should begin, whose first one has {HEAD}: the file is damaged",
            record.len()
        ));
    };
    let name = String::from_utf8_lossy(&record[16..]).trim().to_owned();
    let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.bytes().all(|b| b.is_ascii_alphanumeric());
    if !is_name {
        return Err("a matrix begins without a name: the file is damaged".into());
    }
    let head = head([a, b, c, d], &name);
    let own = name.to_ascii_uppercase();
    let mut entries = Entries::new();
    let mut before = 0;
    loop {
        let Some(record) = records.next()? else {
            return Err(format!(
                "matrix {own} ends before its last record: the file has been cut off"
            ));
        };
        let three = [0, 1, 2].map(|i| word(record, i, order));
        let [Some(column), Some(row), Some(words)] = three else {
            return Err(format!("a record of matrix {own} is too short: the file is damaged"));
        };
        let data = &record[12..];
        follows(before, column, "column", &own)?;
        before = column;
        if column == a.saturating_add(1) {
            break;
        }
        if column > a {
            return Err(format!("matrix {own} has {a} columns, and no column {column}"));
        }
        if data.len() as i64 != words.saturating_mul(4) {
            return Err(format!(
                "column {column} of matrix {own} has {} bytes, and counts {words} words of four",
                data.len()
            ));
        }
        let Ok(head) = &head else { continue };
        let values = |data: &[u8]| -> Result<Vec<f64>, String> {
            let size = 4 * head.words;
            if !data.len().is_multiple_of(size) {
                return Err(format!("column {column} of matrix {own} ends within a number"));
            }
            Ok(match head.words {
                1 => data.as_chunks::<4>().0.iter().map(|b| order.single(*b)).collect(),
                _ => data.as_chunks::<8>().0.iter().map(|b| order.double(*b)).collect(),
            })
        };
        let mut into = Column { head, column, entries: &mut entries };
        if row > 0 {
            into.put(row, &values(data)?)?;
            continue;
        }
        let (mut at, mut last) = (0, 0);
        while at < data.len() / 4 {
            let first = word(data, at, order).unwrap_or_default();
            let (row, length, wide) = match head.big {
                true => (word(data, at + 1, order).unwrap_or_default(), first, 2),
                false => (first % 65536, first / 65536, 1),
            };
            follows(last, row, "row", &own)?;
            let length = usize::try_from(length).unwrap_or_default().saturating_sub(1);
            let end = (at + wide).saturating_add(length).saturating_mul(4);
            let Some(data) = data.get(4 * (at + wide)..end).filter(|_| length > 0) else {
                return Err(format!(
                    "a string of column {column} of matrix {own} does not end within its column: the file is damaged"
                ));
            };
            let found = values(data)?;
            into.put(row, &found)?;
            (at, last) = (at + wide + length, row + found.len() as i64 - 1);
        }
    }
    Ok(Found { name: own, line: None, matrix: head.map(|head| (head.size, entries)) })
}
