use super::*;
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

const ROD: [(u32, u32, f64); 4] = [(0, 0, 2.0), (0, 1, -2.5), (1, 0, -2.5), (1, 1, 4.0)];

fn market(text: &str) -> Result<SparseMatrix, String> {
    read(text.as_bytes(), "k.mtx", "").map_err(|e| e.to_string())
}

fn told(lines: &str) -> String {
    market(&format!("%%MatrixMarket matrix coordinate real symmetric\n{lines}")).unwrap_err()
}

/// Every beginning of a text and every text with one byte changed is read, or refused; those beginnings that end within a line
/// of a file without a count are refused.
pub(super) fn damaged(text: &str, name: &str, size: usize) {
    let whole = text.as_bytes();
    let sane = |bytes: &[u8]| {
        let Ok(it) = read(bytes, name, "") else { return false };
        let within = |(i, j, v): &(u32, u32, f64)| {
            (*i as usize) < it.size && (*j as usize) < it.size && v.is_finite()
        };
        assert!(it.size > 0 && it.size <= size && it.entries.iter().all(within));
        true
    };
    assert!(sane(whole));
    for end in 0..whole.len() {
        let good = sane(&whole[..end]);
        let last = text[..end].rsplit('\n').next().unwrap_or_default();
        assert!(!good || last.trim().is_empty(), "{:?}", &text[..end]);
    }
    for at in 0..whole.len() {
        let mut bytes = whole.to_vec();
        for other in 0..=255 {
            bytes[at] = other;
            sane(&bytes);
        }
    }
}

#[test]
fn symmetric_and_general_files_of_matrix_market_are_read() {
    let symmetric = "%%MatrixMarket matrix coordinate real symmetric\n% by hand\n\n2 2 3\n2 1 -2.5\n1 1 2\n2 2 4e0\n";
    let it = market(symmetric).unwrap();
    assert_eq!((it.size, &it.entries[..]), (2, &ROD[..]));
    assert_eq!(it.sha256.len(), 64);
    // Windows ends lines otherwise; entries at one place add up.
    let general = "%%matrixmarket MATRIX coordinate integer general\r\n2 2 5\r\n1 1 1\r\n1 1 1\r\n1 2 -3\r\n2 1 -3\r\n2 2 4\r\n";
    let it = market(general).unwrap();
    assert_eq!(it.entries, [(0, 0, 2.0), (0, 1, -3.0), (1, 0, -3.0), (1, 1, 4.0)]);
}

#[test]
fn what_is_written_is_read_again() {
    let of = |entries: &[(u32, u32, f64)]| {
        let it = SparseMatrix { size: 2, entries: entries.to_vec(), ..SparseMatrix::default() };
        let text = written(&it);
        (market(&text).unwrap().entries, text.contains("symmetric"))
    };
    assert_eq!(of(&ROD), (ROD.to_vec(), true));
    let mut uneven = ROD;
    uneven[1].2 = -2.5000000000000004;
    assert_eq!(of(&uneven), (uneven.to_vec(), false));
}

#[test]
fn what_is_wrong_with_a_matrix_market_file_is_told_with_its_line() {
    assert_eq!(
        told("2 3 1\n1 1 1\n"),
        "k.mtx, line 2: the matrix has 2 rows and 3 columns: must be square"
    );
    assert_eq!(
        told("2 2 3\n1 1 1\n2 1 -1\n"),
        "k.mtx, line 4: the file ends after 2 of 3 entries: it has been cut off"
    );
    assert_eq!(told(""), "k.mtx, line 1: no line with the size follows: the file is cut off");
    assert_eq!(
        told("2 2 1\n1 1 1\n2 2 1\n"),
        "k.mtx, line 4: more than the 1 entries that the size names"
    );
    assert_eq!(
        told("2 2 1\n1 2 1\n"),
        "k.mtx, line 3: entry (1, 2) lies above the diagonal: a symmetric file holds the lower triangle"
    );
    assert_eq!(
        told("2 2 1\n3 1 1\n"),
        "k.mtx, line 3: there is no row 3: the matrix has 2, counted from 1"
    );
    assert_eq!(
        told("2 2 1\n2 0 1\n"),
        "k.mtx, line 3: there is no column 0: the matrix has 2, counted from 1"
    );
    assert_eq!(
        told("2 2 1\n2 1 nan\n"),
        "k.mtx, line 3: entry (2, 1) is NaN: must be a finite number"
    );
    assert_eq!(
        told("2 2 2\n1 1 1\n2 1\n"),
        "k.mtx, line 4: `2 1` is no entry: row, column and value are wanted"
    );
    assert_eq!(
        told("two 2 1\n"),
        "k.mtx, line 2: `two 2 1` is no size: rows, columns and number of entries are wanted"
    );
    // No memory is asked for on the word of a file.
    assert!(told("2 2 9000000000000000000\n1 1 1\n").contains("after 1 of 9000000000000000000"));
    assert_eq!(
        told("4000000000 4000000000 1\n1 1 1\n"),
        "k.mtx, line 2: the matrix has 4000000000 rows: at most 10000000 are read"
    );
    let wanted = "`%%MatrixMarket matrix coordinate real symmetric` (or `general`) is wanted";
    let heading = |text: &str| market(text).unwrap_err();
    assert_eq!(
        heading("row,node\n"),
        format!(
            "k.mtx, line 1: this is none of Matrix Market, `.npz`, CalculiX and DMIG: a first line {wanted}"
        )
    );
    assert!(heading("%%MatrixMarket matrix array real general\n").contains("the matrix is dense"));
    assert!(
        heading("%%MatrixMarket matrix coordinate complex general\n").contains("are `complex`")
    );
    assert!(
        heading("%%MatrixMarket matrix coordinate real skew-symmetric\n")
            .contains("is `skew-symmetric`")
    );
}

/// An array as NumPy writes it, format 1.0.
fn npy(kind: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let mut heading =
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
    while (10 + heading.len() + 1) % 64 != 0 {
        heading.push(' ');
    }
    heading.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((heading.len() as u16).to_le_bytes());
    bytes.extend(heading.bytes());
    bytes.extend(data);
    bytes
}

fn ints(values: &[i32]) -> Vec<u8> {
    let data: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    npy("<i4", &format!("{},", values.len()), &data)
}

fn longs(values: &[i64]) -> Vec<u8> {
    let data: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    npy("<i8", &format!("{},", values.len()), &data)
}

fn reals(values: &[f64]) -> Vec<u8> {
    let data: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    npy("<f8", &format!("{},", values.len()), &data)
}

type Arrays = Vec<(&'static str, Vec<u8>)>;

fn archive(arrays: &Arrays, method: CompressionMethod) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays {
        let options = SimpleFileOptions::default().compression_method(method);
        zip.start_file(format!("{name}.npy"), options).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

fn csr() -> Arrays {
    vec![
        ("indices", ints(&[0, 1, 0, 1])),
        ("indptr", ints(&[0, 2, 4])),
        ("format", npy("|S3", "", b"csr")),
        ("shape", longs(&[2, 2])),
        ("data", reals(&[2.0, -2.5, -2.5, 4.0])),
    ]
}

fn changed(name: &str, bytes: Vec<u8>) -> Result<SparseMatrix, String> {
    let mut arrays = csr();
    arrays.retain(|(other, _)| *other != name || !bytes.is_empty());
    arrays.iter_mut().filter(|(other, _)| *other == name).for_each(|(_, own)| *own = bytes.clone());
    read(&archive(&arrays, CompressionMethod::Deflated), "k.npz", "").map_err(|e| e.to_string())
}

#[test]
fn archives_of_scipy_are_read_by_rows_by_columns_and_by_places() {
    for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
        let it = read(&archive(&csr(), method), "k.npz", "").unwrap();
        assert_eq!((it.size, &it.entries[..]), (2, &ROD[..]));
    }
    // One that is not symmetric tells rows from columns.
    let uneven = reals(&[2.0, 7.0, -2.5, 4.0]);
    let entries = |arrays: &Arrays| {
        read(&archive(arrays, CompressionMethod::Stored), "k.npz", "").unwrap().entries
    };
    let mut by = csr();
    by[4].1 = uneven.clone();
    let rows = [(0, 0, 2.0), (0, 1, 7.0), (1, 0, -2.5), (1, 1, 4.0)];
    assert_eq!(entries(&by), rows);
    by[2].1 = npy("<U3", "", b"c\0\0\0s\0\0\0c\0\0\0");
    let columns = [(0, 0, 2.0), (0, 1, -2.5), (1, 0, 7.0), (1, 1, 4.0)];
    assert_eq!(entries(&by), columns);
    let places = vec![
        ("format", npy("|S3", "", b"coo")),
        ("shape", longs(&[2, 2])),
        ("row", longs(&[1, 0, 0, 1, 1])),
        ("col", longs(&[1, 1, 0, 0, 1])),
        ("data", reals(&[3.0, 7.0, 2.0, -2.5, 1.0])),
    ];
    assert_eq!(entries(&places), rows);
}

#[test]
fn what_is_wrong_with_an_archive_is_told() {
    let told = |name: &str, bytes: Vec<u8>| changed(name, bytes).unwrap_err();
    assert_eq!(
        told("data", Vec::new()),
        "k.npz: the archive has no `data`: a matrix of `scipy.sparse.save_npz` is wanted"
    );
    assert_eq!(
        told("shape", longs(&[2, 3])),
        "k.npz: the matrix has 2 rows and 3 columns: must be square"
    );
    assert_eq!(
        told("indptr", ints(&[0, 2])),
        "k.npz: `indptr` of the archive has 2 numbers for 2 rows and 4 values: 3 are wanted, rising from 0 to 4"
    );
    assert!(told("indptr", ints(&[0, 9, 4])).contains("rising from 0 to 4"));
    assert_eq!(
        told("indices", ints(&[0, 1, 0, 2])),
        "k.npz: the archive has an entry in row or column 2 of 2, counted from 0"
    );
    assert_eq!(
        told("data", reals(&[2.0, -2.5, f64::INFINITY, 4.0])),
        "k.npz: entry (2, 1), counted from 1, is inf: must be a finite number"
    );
    assert!(told("format", npy("|S3", "", b"bsr")).contains("stored as `bsr`"));
    assert!(told("data", npy("<c16", "4,", &[0; 64])).contains("its items are `c16`"));
    assert_eq!(
        told("data", npy("<f8", "4,", &[0; 24])),
        "k.npz: `data` of the archive: it is cut off before the end of its 4 items"
    );
    assert!(told("indices", reals(&[0.0; 4])).contains("`indices` of the archive holds no whole"));
    let whole = archive(&csr(), CompressionMethod::Stored);
    let error = read(&whole[..whole.len() / 2], "k.npz", "").unwrap_err().to_string();
    assert!(error.contains("it may have been cut off"), "{error}");
}
