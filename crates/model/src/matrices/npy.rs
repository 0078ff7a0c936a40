//! One array of a `.npz`: the format `.npy` of NumPy, versions 1 to 3
//! (<https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>).

/// The numbers of an array, whatever they were stored as.
pub(super) enum Numbers {
    Whole(Vec<i64>),
    Real(Vec<f64>),
}

/// An array taken apart: its kind, such as `<f8`, how many items, and their bytes.
struct Array<'a> {
    kind: String,
    count: usize,
    data: &'a [u8],
}

/// Bytes of the start of a file before the length of its heading.
const MAGIC: &[u8] = b"\x93NUMPY";

fn array(bytes: &[u8]) -> Result<Array<'_>, String> {
    let cut = || "it is cut off".to_owned();
    let rest = bytes.strip_prefix(MAGIC).ok_or("it is no array of NumPy")?;
    let (version, rest) = rest.split_at_checked(2).ok_or_else(cut)?;
    let wide = if version[0] == 1 { 2 } else { 4 };
    let (length, rest) = rest.split_at_checked(wide).ok_or_else(cut)?;
    let length = length.iter().rev().fold(0, |sum, b| 256 * sum + usize::from(*b));
    let (heading, data) = rest.split_at_checked(length).ok_or_else(cut)?;
    let heading = String::from_utf8_lossy(heading);
    let after =
        |key: &str| heading.split_once(key).map(|(_, rest)| rest.trim_start_matches([':', ' ']));
    let kind = after("'descr'").and_then(|rest| rest.strip_prefix('\'')?.split('\'').next());
    let kind = kind.ok_or("its numbers are of several kinds")?.to_owned();
    let shape = after("'shape'").and_then(|rest| rest.strip_prefix('(')?.split(')').next());
    let shape = shape.ok_or("its heading names no shape")?;
    let sizes = shape.split(',').map(str::trim).filter(|s| !s.is_empty());
    let sizes: Option<Vec<usize>> = sizes.map(|s| s.parse().ok()).collect();
    let count = match sizes.as_deref() {
        Some([]) => 1,
        Some([n]) => *n,
        _ => return Err("it is no list of numbers".into()),
    };
    Ok(Array { kind, count, data })
}

impl Array<'_> {
    /// Items of a width, the first byte the least.
    fn items<const W: usize>(&self) -> Result<impl Iterator<Item = [u8; W]> + '_, String> {
        let bytes = self.count.checked_mul(W).and_then(|all| self.data.get(..all));
        let bytes = bytes
            .ok_or_else(|| format!("it is cut off before the end of its {} items", self.count))?;
        let turned = self.kind.starts_with('>');
        Ok(bytes.chunks_exact(W).map(move |own| {
            let mut item: [u8; W] = std::array::from_fn(|i| own[i]);
            if turned {
                item.reverse();
            }
            item
        }))
    }
}

/// The numbers of an array.
pub(super) fn numbers(bytes: &[u8]) -> Result<Numbers, String> {
    let a = array(bytes)?;
    Ok(match a.kind.trim_start_matches(['<', '>', '|', '=']) {
        "f8" => Numbers::Real(a.items()?.map(f64::from_le_bytes).collect()),
        "f4" => Numbers::Real(a.items()?.map(|b| f64::from(f32::from_le_bytes(b))).collect()),
        "i8" => Numbers::Whole(a.items()?.map(i64::from_le_bytes).collect()),
        "i4" => Numbers::Whole(a.items()?.map(|b| i64::from(i32::from_le_bytes(b))).collect()),
        "i2" => Numbers::Whole(a.items()?.map(|b| i64::from(i16::from_le_bytes(b))).collect()),
        "i1" => Numbers::Whole(a.items()?.map(|b| i64::from(i8::from_le_bytes(b))).collect()),
        "u4" => Numbers::Whole(a.items()?.map(|b| i64::from(u32::from_le_bytes(b))).collect()),
        other => return Err(format!("its items are `{other}`, no numbers that a matrix has")),
    })
}

/// A text: bytes, or characters of four bytes.
pub(super) fn text(bytes: &[u8]) -> Result<String, String> {
    let a = array(bytes)?;
    let letters: String = match a.kind.contains('U') {
        true => a
            .data
            .chunks(4)
            .filter_map(|c| c.iter().find(|b| **b != 0))
            .map(|b| char::from(*b))
            .collect(),
        false => a.data.iter().map(|b| char::from(*b)).collect(),
    };
    Ok(letters.trim_matches('\0').to_owned())
}

/// Items of one kind as a file of format 1.0; `shape` as Python writes it, such as `(3,)`.
pub(super) fn file(kind: &str, shape: &str, data: impl IntoIterator<Item = u8>) -> Vec<u8> {
    let fields = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    // Magic, version and length take 10 bytes; the whole head is a multiple of 64 and ends a line.
    let head = (MAGIC.len() + 4 + fields.len() + 1).next_multiple_of(64);
    let mut bytes = MAGIC.to_vec();
    // A head has some hundred bytes.
    let length = (head - MAGIC.len() - 4) as u16;
    bytes.extend([1, 0].into_iter().chain(length.to_le_bytes()));
    bytes.extend(fields.as_bytes());
    bytes.resize(head - 1, b' ');
    bytes.push(b'\n');
    bytes.extend(data);
    bytes
}
