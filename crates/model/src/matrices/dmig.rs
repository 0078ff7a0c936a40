//! Matrices of Nastran, entries `DMIG` of bulk data, as punch files have them.
//!
//! ```text
//!   DMIG  NAME  0   IFO  TIN  TOUT  POLAR  .  NCOL          a matrix: form (6 symmetric, one triangle; 1, 2 all of it)
//!   DMIG  NAME  GJ  CJ   .    G1  C1  A1  B1                and type (1, 2 real)
//!               G2  C2   A2  B2 …                           column GJ.CJ: value A1 in row G1.C1, and so on
//! ```
//!
//! Rows are grids with a component from 1 to 6, or scalar points without one; B is for complex ones.
//!
//! Autodesk Nastran 2025 Reference Manual, and Altair OptiStruct 2021 Reference Guide, both: "DMIG".

use super::bulk::{Card, Field, cards, real};
use super::{Entries, MOST_ROWS, at_line, is_symmetric, parted, whole};
use std::collections::BTreeSet;
use std::fmt::Write;
use trilith_element::{Dof, FileError, MeshRow, SparseMatrix};

/// Two entries that mirror each other may differ by this share of what their diagonal entries allow.
const ROUNDING: f64 = 1e-8;

/// An entry by the names of its row and column, with its line.
struct Item {
    row: MeshRow,
    column: MeshRow,
    value: f64,
    line: usize,
}

/// True where there is a card of a matrix.
pub(super) fn has(bytes: &[u8]) -> bool {
    cards(bytes, &["DMIG"]).next().is_some()
}

/// Names of rows, and entries, of one matrix of the file; of the only square one where none is named.
pub(super) fn read(
    bytes: &[u8],
    name: &str,
    which: Option<&str>,
) -> Result<(Vec<MeshRow>, Entries), FileError> {
    let head = chosen(bytes, name, which)?;
    let items = items(bytes, name, &head)?;
    let wanted: BTreeSet<MeshRow> = items.iter().flat_map(|i| [i.row, i.column]).collect();
    let rows: Vec<MeshRow> = wanted.into_iter().collect();
    if rows.is_empty() {
        let message = format!("matrix {} has no columns: the file has been cut off", head.name);
        return Err(at_line(name, head.line, message));
    }
    if rows.len() > MOST_ROWS {
        let message = format!("{} rows: at most {MOST_ROWS} are read", rows.len());
        return Err(whole(name, message));
    }
    let end = bytes.split(|b| *b == b'\n').next_back().unwrap_or_default().trim_ascii();
    if !end.is_empty() && !end.eq_ignore_ascii_case(b"ENDDATA") {
        let message = "the last line does not end: the file has been cut off".into();
        return Err(at_line(name, bytes.split(|b| *b == b'\n').count(), message));
    }
    // Every name is among the rows.
    let place = |row: MeshRow| rows.binary_search(&row).unwrap_or_default() as u32;
    let mut placed = Vec::with_capacity(2 * items.len());
    for item in &items {
        let (i, j) = (place(item.row), place(item.column));
        placed.push((i, j, item.value, item.line));
        if head.symmetric && i != j {
            placed.push((j, i, item.value, item.line));
        }
    }
    placed.sort_by_key(|e| (e.0, e.1, e.3));
    checked(&placed, &rows, head.symmetric)
        .map_err(|(line, message)| at_line(name, line, message))?;
    grids(bytes, name, &rows)?;
    Ok((rows, placed.into_iter().map(|(i, j, value, _)| (i, j, value)).collect()))
}

/// The header of a matrix.
struct Head {
    name: String,
    line: usize,
    symmetric: bool,
}

/// The header of the matrix that is wanted.
fn chosen(bytes: &[u8], file: &str, which: Option<&str>) -> Result<Head, FileError> {
    let heads: Vec<Card<'_>> = cards(bytes, &["DMIG"]).filter(is_header).collect();
    let name = |card: &Card<'_>| card.fields[0].text.to_ascii_uppercase();
    let names = heads.iter().map(name).collect::<Vec<_>>().join(", ");
    let found: Vec<&Card<'_>> = match which {
        Some(which) => heads.iter().filter(|c| name(c).eq_ignore_ascii_case(which)).collect(),
        // Loads are rectangular.
        None => heads.iter().filter(|c| c.fields[2].text != "9").collect(),
    };
    let head = match (&found[..], which) {
        ([head], _) => head,
        ([], _) if heads.is_empty() => {
            let message =
                "no matrix begins in the file: `DMIG`, its name, 0, form and type are wanted";
            return Err(whole(file, message.into()));
        }
        ([], Some(which)) => {
            let message = format!("there is no matrix `{which}`: the file has {names}");
            return Err(whole(file, message));
        }
        ([], None) => return Err(whole(file, format!("none of its matrices is square: {names}"))),
        ([first, .., again], _) if name(first) == name(again) => {
            let (own, at) = (name(first), first.line);
            let message = format!("matrix {own} begins in line {at} already");
            return Err(at_line(file, again.line, message));
        }
        ([first, ..], _) => {
            let message = format!(
                "the file has the matrices {names}: name one of them, as in `{file}:{}`",
                name(first)
            );
            return Err(whole(file, message));
        }
    };
    let own = name(head);
    let wrong = |message: String| Err(at_line(file, head.line, message));
    if let Some((line, message)) = &head.fault {
        return Err(at_line(file, *line, message.clone()));
    }
    let symmetric = match head.fields[2].text {
        "6" => true,
        "1" | "2" => false,
        "9" => {
            return wrong(format!(
                "matrix {own} is rectangular (IFO 9), such as loads: a square one is wanted, IFO 6, 1 or 2"
            ));
        }
        other => {
            return wrong(format!("the form IFO of matrix {own} is `{other}`: must be 6, 1 or 2"));
        }
    };
    match head.fields[3].text {
        "1" | "2" => Ok(Head { name: own, line: head.line, symmetric }),
        complex @ ("3" | "4") => wrong(format!(
            "matrix {own} is complex (TIN {complex}), and no stiffness, mass or damping: a real one is wanted, TIN 1 or 2"
        )),
        other => wrong(format!("the type TIN of matrix {own} is `{other}`: must be 1 or 2")),
    }
}

fn is_header(card: &Card<'_>) -> bool {
    card.fields[1].text == "0"
}

/// The entries of a matrix in the order of the file.
fn items(bytes: &[u8], file: &str, head: &Head) -> Result<Vec<Item>, FileError> {
    let mut items = Vec::new();
    let own = |card: &Card<'_>| card.fields[0].text.eq_ignore_ascii_case(&head.name);
    for card in cards(bytes, &["DMIG"]).filter(own).filter(|card| !is_header(card)) {
        if let Some((line, message)) = &card.fault {
            return Err(at_line(file, *line, message.clone()));
        }
        column(&card, &mut items).map_err(|(line, message)| at_line(file, line, message))?;
    }
    Ok(items)
}

/// The entries of one column.
fn column(card: &Card<'_>, items: &mut Vec<Item>) -> Result<(), (usize, String)> {
    let column = mesh_row(card.fields[1], card.fields[2])?;
    let empty = card.fields[3];
    if !empty.text.is_empty() {
        let message = format!("`{}` between column and first row: must be empty", empty.text);
        return Err((empty.line, message));
    }
    let before = items.len();
    for of_four in card.fields[4..].chunks(4) {
        let [g, c, a, b] = of_four else { continue };
        if of_four.iter().all(|f| f.text.is_empty()) {
            continue;
        }
        let row = mesh_row(*g, *c)?;
        let is_zero = |f: &Field<'_>| f.text.is_empty() || real(f.text) == Some(0.0);
        if !is_zero(b) {
            let message = format!(
                "`{}` behind the value of row {row}: a real matrix has nothing there",
                b.text
            );
            return Err((b.line, message));
        }
        let value = real(a.text).ok_or_else(|| {
            let message = format!(
                "{} in row {row} of column {column}: a finite number is wanted, such as 1.5, 1.5D+3 or 1.5+3",
                told(*a)
            );
            (a.line, message)
        })?;
        items.push(Item { row, column, value, line: a.line });
    }
    if items.len() == before {
        let message = format!("column {column} has no rows: the file has been cut off");
        return Err((card.line, message));
    }
    Ok(())
}

/// A field in a sentence.
fn told(field: Field<'_>) -> String {
    match field.text {
        "" => "an empty field, as in a file that has been cut off,".into(),
        text => format!("`{text}`"),
    }
}

/// A grid and its component.
fn mesh_row(g: Field<'_>, c: Field<'_>) -> Result<MeshRow, (usize, String)> {
    let node =
        g.text.parse().ok().filter(|node| *node > 0).ok_or_else(|| {
            (g.line, format!("{} is no grid: its number is wanted, from 1", told(g)))
        })?;
    let dof = match c.text {
        "" | "0" => None,
        text => {
            let found = text.parse::<usize>().ok().and_then(|c| Dof::ALL.get(c.checked_sub(1)?));
            Some(*found.ok_or_else(|| {
                let message = format!(
                    "`{text}` is no component of grid {node}: must be 1 to 6, or 0 of a scalar point"
                );
                (c.line, message)
            })?)
        }
    };
    Ok(MeshRow { node, dof })
}

/// Each entry once, a diagonal one wherever there are others, and two triangles alike where both are given.
fn checked(
    placed: &[(u32, u32, f64, usize)],
    rows: &[MeshRow],
    symmetric: bool,
) -> Result<(), (usize, String)> {
    let name = |i: u32| rows[i as usize];
    for two in placed.windows(2) {
        let [(i, j, _, first), (k, l, _, line)] = [two[0], two[1]];
        if (i, j) == (k, l) {
            let how = match symmetric {
                true => ": IFO 6 gives one triangle, each entry once",
                false => ": each is given once",
            };
            let message = format!(
                "the entry of rows {} and {} stands in line {first} already{how}",
                name(i.min(j)),
                name(i.max(j))
            );
            return Err((line, message));
        }
    }
    let at = |i: u32, j: u32| {
        placed.binary_search_by_key(&(i, j), |e| (e.0, e.1)).ok().map(|k| placed[k].2)
    };
    let mut diagonal = vec![None; rows.len()];
    placed.iter().filter(|e| e.0 == e.1).for_each(|e| diagonal[e.0 as usize] = Some(e.2));
    for (i, j, value, line) in placed.iter().filter(|e| e.2 != 0.0) {
        let [Some(a), Some(b)] = [diagonal[*i as usize], diagonal[*j as usize]] else {
            let bare = if diagonal[*i as usize].is_none() { i } else { j };
            let message = format!(
                "row {} has an entry beside the diagonal and none on it: the file has been cut off, or is none of a structure",
                name(*bare)
            );
            return Err((*line, message));
        };
        if symmetric || i == j {
            continue;
        }
        let Some(other) = at(*j, *i) else {
            let message = format!(
                "not symmetric: row {} has an entry in column {}, and not the other way round; IFO 6 is the form of one triangle",
                name(*i),
                name(*j)
            );
            return Err((*line, message));
        };
        let size = (a.max(0.0) * b.max(0.0)).sqrt().max(value.abs()).max(other.abs());
        if (value - other).abs() > ROUNDING * size {
            let message = format!(
                "not symmetric: {value:e} in row {}, column {}, and {other:e} the other way round",
                name(*i),
                name(*j)
            );
            return Err((*line, message));
        }
    }
    Ok(())
}

/// Grids of the same file that have directions of their own are none of global axes.
fn grids(bytes: &[u8], file: &str, rows: &[MeshRow]) -> Result<(), FileError> {
    for card in cards(bytes, &["GRID"]) {
        let (node, system) = (card.fields[0].text, card.fields.get(5).map_or("", |f| f.text));
        let met = node.parse().is_ok_and(|node: u32| {
            let first = rows.partition_point(|row| row.node < node);
            rows.get(first).is_some_and(|row| row.node == node)
        });
        if met && !system.is_empty() && system != "0" {
            let message = format!(
                "grid {node} has its directions in coordinate system {system}: global axes are wanted, 0 in field CD"
            );
            return Err(at_line(file, card.line, message));
        }
    }
    Ok(())
}

/// The matrix in free fields, its lower triangle where it is symmetric.
pub(super) fn write(a: &SparseMatrix) -> String {
    let own = parted(&a.name).1.unwrap_or("A");
    let symmetric = is_symmetric(a);
    let mut text = format!("DMIG,{own},0,{},2\n", if symmetric { 6 } else { 1 });
    let mut columns: Vec<&(u32, u32, f64)> =
        a.entries.iter().filter(|(i, j, _)| !symmetric || j <= i).collect();
    columns.sort_by_key(|e| (e.1, e.0));
    let pair = |i: u32| a.row_name(i as usize).replace('.', ",");
    let mut last = None;
    for (i, j, value) in columns {
        if last.replace(j) != Some(j) {
            // Writing to a String cannot fail.
            let _ = write!(text, "DMIG,{own},{},", pair(*j));
        }
        let _ = writeln!(text, ",{},{value:e}", pair(*i));
    }
    text
}

#[cfg(test)]
mod tests;
