//! Nodes that follow the rows: a table `node,dof,row,value`.

use super::table::{parts, separator, told};
use std::collections::{HashMap, HashSet};
use trilith_element::{Dof, FileError, FileText, ParameterError, Recovered, SparseRow};

const WANTED: &str = "a heading `node,dof,row,value` and a line for each share are wanted";

/// The lines behind the heading, with what stands between their fields.
fn lines(table: &FileText) -> Result<(char, impl Iterator<Item = (usize, &str)>), FileError> {
    let mut lines = told(table);
    let Some((first, heading)) = lines.next() else {
        let message = format!("the table is empty: {WANTED}");
        return Err(FileError { file: table.name.clone(), line: None, message });
    };
    let by = separator(heading);
    let names: Vec<String> = parts(heading, by).map(str::to_ascii_lowercase).collect();
    if names != ["node", "dof", "row", "value"] {
        let message =
            format!("the heading is `{}`: `node,dof,row,value` is wanted", heading.trim());
        return Err(table.error(first, message));
    }
    Ok((by, lines))
}

fn of_parameter(e: FileError) -> ParameterError {
    ParameterError::File { name: "recovery".into(), message: e.to_string() }
}

/// The nodes that the table tells of, wherever it says so; `labels` are those of the nodes of the element.
pub(super) fn nodes(table: &FileText, labels: &[&str]) -> Result<Vec<usize>, ParameterError> {
    let (by, lines) = lines(table).map_err(of_parameter)?;
    let mut last = None;
    let mut found: Vec<usize> = lines
        .filter_map(|(_, line)| parts(line, by).next())
        // Tables go node by node.
        .filter(|label| last.replace(*label) != Some(*label))
        .filter_map(|label| labels.iter().position(|l| *l == label))
        .collect();
    found.sort_unstable();
    found.dedup();
    Ok(found)
}

/// What follows the rows, which are these.
pub(super) fn read(
    table: &FileText,
    rows: &[SparseRow],
    labels: &[&str],
) -> Result<Vec<Recovered>, ParameterError> {
    shares(table, rows, labels).map_err(of_parameter)
}

fn shares(
    table: &FileText,
    rows: &[SparseRow],
    labels: &[&str],
) -> Result<Vec<Recovered>, FileError> {
    let (by, lines) = lines(table)?;
    let known: HashMap<&str, usize> = labels.iter().enumerate().map(|(i, l)| (*l, i)).collect();
    let tied: HashSet<(usize, Dof)> = rows
        .iter()
        .filter_map(|row| match row {
            SparseRow::Node(node, dof) => Some((*node, *dof)),
            SparseRow::Inner(_) => None,
        })
        .collect();
    let mut places: HashMap<(usize, Dof), usize> = HashMap::new();
    let mut met: HashMap<(usize, u32), usize> = HashMap::new();
    let mut all: Vec<Recovered> = Vec::new();
    for (at, line) in lines {
        let wrong = |message: String| table.error(at, message);
        let Ok([label, dof, row, value]) =
            <[&str; 4]>::try_from(parts(line, by).collect::<Vec<_>>())
        else {
            let message =
                format!("`{}`: a node, a direction, a row and a share are wanted", line.trim());
            return Err(wrong(message));
        };
        let Some(&node) = known.get(label) else {
            return Err(wrong(format!(
                "`{label}` is none of its nodes: those that follow rows are nodes of the element too"
            )));
        };
        let Some(dof) = Dof::ALL.into_iter().find(|d| d.name() == dof) else {
            let message = format!("`{dof}` is no direction: must be Ux, Uy, Uz, Rx, Ry or Rz");
            return Err(wrong(message));
        };
        let row = row.parse::<usize>().ok().filter(|row| (1..=rows.len()).contains(row));
        let Some(row) = row.map(|row| row as u32 - 1) else {
            let message = format!("there is no such row: there are {}, counted from 1", rows.len());
            return Err(wrong(message));
        };
        let Some(share) = value.parse::<f64>().ok().filter(|x| x.is_finite()) else {
            return Err(wrong(format!("`{value}` is no share: a finite number is wanted")));
        };
        if tied.contains(&(node, dof)) {
            let message = format!("{} of node `{label}` is a row already", dof.name());
            return Err(wrong(message));
        }
        let place = *places.entry((node, dof)).or_insert_with(|| {
            all.push(Recovered { node, dof, terms: Vec::new() });
            all.len() - 1
        });
        if let Some(first) = met.insert((place, row), at) {
            return Err(wrong(format!("this share stands in line {first} already")));
        }
        all[place].terms.push((row, share));
    }
    Ok(all)
}
