//! The table of rows: `row,node,dof`.

use std::collections::HashMap;
use trilith_element::{Dof, FileError, FileText, ParameterError, SparseRow};

/// What each of so many rows is; `labels` are those of the nodes of the element, in their order.
pub(super) fn rows(
    table: &FileText,
    size: usize,
    labels: &[&str],
) -> Result<Vec<SparseRow>, ParameterError> {
    read(table, size, labels)
        .map_err(|e| ParameterError::File { name: "rows".into(), message: e.to_string() })
}

fn read(table: &FileText, size: usize, labels: &[&str]) -> Result<Vec<SparseRow>, FileError> {
    let whole = |message: String| FileError { file: table.name.clone(), line: None, message };
    let mut nodes: HashMap<&str, usize> = HashMap::new();
    for (node, label) in labels.iter().enumerate() {
        if nodes.insert(label, node).is_some() {
            return Err(whole(format!("two nodes have the label `{label}`")));
        }
    }
    let text = table.text.trim_start_matches('\u{feff}');
    let is_told = |line: &str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let mut lines = text.lines().enumerate().map(|(i, l)| (i + 1, l)).filter(|(_, l)| is_told(l));
    let Some((at, heading)) = lines.next() else {
        return Err(whole(
            "the table is empty: a heading `row,node,dof` and a line for each tied row are wanted"
                .into(),
        ));
    };
    let separator = [',', ';', '\t'].into_iter().find(|c| heading.contains(*c)).unwrap_or(',');
    let names: Vec<String> = parts(heading, separator).map(str::to_ascii_lowercase).collect();
    if names != ["row", "node", "dof"] {
        let message = format!("the heading is `{}`: `row,node,dof` is wanted", heading.trim());
        return Err(table.error(at, message));
    }
    let mut found = vec![SparseRow::Inner(None); size];
    let mut lines_of: HashMap<usize, usize> = HashMap::new();
    let mut tied: HashMap<(usize, Dof), usize> = HashMap::new();
    // True for the nodes that have a row.
    let mut met = vec![false; labels.len()];
    for (at, line) in lines {
        let Ok([row, label, dof]) =
            <[&str; 3]>::try_from(parts(line, separator).collect::<Vec<_>>())
        else {
            let message = format!("`{}`: a row, a node and a direction are wanted", line.trim());
            return Err(table.error(at, message));
        };
        let Some(row) = row.parse::<usize>().ok().filter(|row| (1..=size).contains(row)) else {
            let message =
                format!("there is no row `{row}`: the matrices have {size}, counted from 1");
            return Err(table.error(at, message));
        };
        let Some(dof) = Dof::ALL.into_iter().find(|d| d.name() == dof) else {
            let message = format!("`{dof}` is no direction: must be Ux, Uy, Uz, Rx, Ry or Rz");
            return Err(table.error(at, message));
        };
        if let Some(first) = lines_of.insert(row, at) {
            return Err(table.error(at, format!("row {row} stands in line {first} already")));
        }
        found[row - 1] = match nodes.get(label) {
            None => SparseRow::Inner(Some(dof)),
            Some(&node) => {
                if let Some(first) = tied.insert((node, dof), row) {
                    let message =
                        format!("{} of node `{label}` is row {first} already", dof.name());
                    return Err(table.error(at, message));
                }
                met[node] = true;
                SparseRow::Node(node, dof)
            }
        };
    }
    if let Some(node) = met.iter().position(|met| !met) {
        return Err(whole(format!(
            "no row is of a node `{}`: every node of the element needs one, under its name or its label",
            labels[node]
        )));
    }
    Ok(found)
}

fn parts(line: &str, separator: char) -> impl Iterator<Item = &str> {
    line.split(separator).map(|part| part.trim().trim_matches('"'))
}
