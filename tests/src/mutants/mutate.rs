//! Ways to spoil a file.

use super::rng::Rng;
use std::ops::Range;

/// Numbers that hurt.
const NUMBERS: [&str; 22] = [
    "0",
    "-0.0",
    "-1",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e200",
    "1e18",
    "1e9",
    "1000000007",
    "18446744073709551616",
    "4294967296",
    "NaN",
    "inf",
    "-inf",
    "1,5",
    "0.1.2",
    "٣",
    "1e",
    "0x1p3",
    "\"1e5 s\"",
];
/// Words and signs of the formats.
const WORDS: [&str; 30] = [
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    "\"",
    "'",
    ",",
    ":",
    "//",
    "/*",
    "*/",
    "\u{1b}[31m",
    "\0",
    "\u{feff}",
    "\r\n",
    "None",
    "true",
    "Some(1)",
    "r#\"",
    " kN/m",
    "e",
    "=1+1",
    "@",
    "NPTS=",
    "DT=",
    "\t",
    "Fixed",
    "\"n0\": (0, 0, 0),",
];
/// How deep a nest is.
const DEEP: usize = 3_000;

/// Some changes of a file; `other` is one of the same kind.
pub fn mutate(file: &[u8], other: &[u8], rng: &mut Rng) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..=rng.below(4) {
        change(&mut bytes, other, rng);
    }
    bytes
}

fn change(bytes: &mut Vec<u8>, other: &[u8], rng: &mut Rng) {
    let at = rng.below(bytes.len() + 1);
    match rng.below(12) {
        0 => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= 1 << rng.below(8);
            }
        }
        1 => drop(bytes.drain(range(bytes.len(), rng))),
        2 => {
            let part = bytes[range(bytes.len(), rng)].to_vec();
            insert(bytes, at, &part);
        }
        3 => insert(bytes, at, rng.pick(&WORDS).as_bytes()),
        4 => insert(bytes, at, &other[range(other.len(), rng)]),
        5 => bytes.truncate(at),
        6 => {
            let sign = *rng.pick(b"([{-\n");
            insert(bytes, at, &vec![sign; rng.below(DEEP)]);
        }
        7 => {
            // A line or a part of it many times.
            let part = bytes[range(bytes.len(), rng)].to_vec();
            let times = rng.length(2_000).min(100_000 / part.len().max(1));
            insert(bytes, at, &part.repeat(times));
        }
        _ => {
            if let Some(number) = number(bytes, at) {
                drop(bytes.splice(number, rng.pick(&NUMBERS).bytes()));
            }
        }
    }
}

/// A part of a file of this many bytes.
fn range(len: usize, rng: &mut Rng) -> Range<usize> {
    let start = rng.below(len);
    start..(start + rng.length(len)).min(len)
}

fn insert(bytes: &mut Vec<u8>, at: usize, part: &[u8]) {
    drop(bytes.splice(at..at, part.iter().copied()));
}

/// The first number from a place on.
fn number(bytes: &[u8], at: usize) -> Option<Range<usize>> {
    let start = at + bytes[at..].iter().position(u8::is_ascii_digit)?;
    let of_number = |b: &u8| b.is_ascii_digit() || matches!(b, b'.' | b'e' | b'E' | b'-' | b'+');
    let len = bytes[start..].iter().take_while(|b| of_number(b)).count();
    Some(start..start + len)
}
