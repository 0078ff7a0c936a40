//! `histories.npz` for NumPy: float64 arrays `t`, one per output, `energy_…`.

use crate::quiet::Quiet;
use crate::recorder::ENERGIES;
use crate::{FileError, Recorder};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use trilith_model::Model;
use zip::write::SimpleFileOptions;

/// A one-dimensional array as the bytes of an `.npy` file, format 1.0.
#[must_use]
pub fn npy(values: &[f64]) -> Vec<u8> {
    let fields =
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}", values.len());
    // Magic, version and length take 10 bytes; the whole head is a multiple of 64 and ends a line.
    let head = (10 + fields.len() + 1).next_multiple_of(64);
    let mut bytes = Vec::with_capacity(head + 8 * values.len());
    bytes.extend(b"\x93NUMPY\x01\x00");
    // The head has at most 128 bytes: the shape is one number.
    bytes.extend(((head - 10) as u16).to_le_bytes());
    bytes.extend(fields.as_bytes());
    bytes.resize(head - 1, b' ');
    bytes.push(b'\n');
    bytes.extend(values.iter().flat_map(|x| x.to_le_bytes()));
    bytes
}

/// Writes all histories.
pub(crate) fn write(path: &Path, model: &Model, record: &Recorder) -> Result<(), FileError> {
    let file = File::create(path).map_err(FileError::at(path))?;
    // An archive that is dropped unfinished is ended by the crate, which tells errors on stderr.
    let mut zip = zip::ZipWriter::new(Quiet::new(BufWriter::new(file)));
    let energies = ENERGIES.map(|e| format!("energy_{e}"));
    let fixed = std::iter::once("t").chain(energies.iter().map(String::as_str));
    let names = unique(fixed, model.shown().map(|(_, o)| o.name.as_str()));
    let arrays = std::iter::once(record.time())
        .chain(record.energy().iter().map(Vec::as_slice))
        .chain(model.shown().filter_map(|(i, _)| record.history(i)));
    for (name, values) in names.iter().zip(arrays) {
        let array = npy(values);
        // Not compressed, as `numpy.savez` has it: histories of a frame lose a twentieth, and it took longer than their run.
        let options = SimpleFileOptions::default()
            .compression_method(zip::CompressionMethod::Stored)
            .large_file(array.len() > u32::MAX as usize)
            .last_modified_time(zip::DateTime::default());
        zip.start_file(format!("{name}.npy"), options).map_err(FileError::at(path))?;
        zip.write_all(&array).map_err(FileError::at(path))?;
    }
    let mut file = zip.finish().map_err(FileError::at(path))?;
    file.flush().map_err(FileError::at(path))
}

/// The fixed names, then the others with all but letters, digits and `_` replaced; all different.
fn unique<'a>(
    fixed: impl Iterator<Item = &'a str>,
    others: impl Iterator<Item = &'a str>,
) -> Vec<String> {
    let mut names: Vec<String> = fixed.map(str::to_owned).collect();
    // Names that differ in case only would be one file where a zip is unpacked on some systems.
    let mut taken: BTreeSet<String> = names.iter().map(|n| n.to_lowercase()).collect();
    for other in others {
        let clean: String =
            other.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        let clean = if clean.is_empty() { "_".to_owned() } else { clean };
        let mut name = clean.clone();
        let mut count = 1;
        while !taken.insert(name.to_lowercase()) {
            count += 1;
            name = format!("{clean}_{count}");
        }
        names.push(name);
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_npy_file_has_exactly_the_bytes_of_format_1_0() {
        let bytes = npy(&[1.0, -0.5]);
        let head =
            b"\x93NUMPY\x01\x00\x76\x00{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }";
        assert_eq!(&bytes[..head.len()], head);
        assert!(bytes[head.len()..127].iter().all(|b| *b == b' '));
        assert_eq!(bytes[127], b'\n');
        assert_eq!(
            bytes[128..],
            [[0, 0, 0, 0, 0, 0, 0xf0, 0x3f], [0, 0, 0, 0, 0, 0, 0xe0, 0xbf]].concat()
        );
    }

    #[test]
    fn names_of_arrays_are_clean_and_unique() {
        let names = unique(["t"].into_iter(), ["t", "a b", "a/b", "A_b", "", "µ"].into_iter());
        assert_eq!(names, ["t", "t_2", "a_b", "a_b_2", "A_b_3", "_", "µ"]);
    }
}
