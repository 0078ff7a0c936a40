//! What rows are: a table `row,node,dof`, or the `.dof` of CalculiX.

use std::collections::HashMap;
use trilith_element::{Dof, FileError, FileText, ParameterError, SparseRow};

/// What each of so many rows is; `labels` are those of the nodes of the element, in their order; the
/// nodes that are led need no row.
pub(super) fn rows(
    table: &FileText,
    size: usize,
    labels: &[&str],
    led: &[usize],
) -> Result<Vec<SparseRow>, ParameterError> {
    read(table, size, labels, led)
        .map_err(|e| ParameterError::File { name: "rows".into(), message: e.to_string() })
}

fn read(
    table: &FileText,
    size: usize,
    labels: &[&str],
    led: &[usize],
) -> Result<Vec<SparseRow>, FileError> {
    let whole = |message: String| FileError { file: table.name.clone(), line: None, message };
    let mut ties = Ties::new(size, labels, led).map_err(whole)?;
    let lines: Vec<(usize, &str)> = told(table).collect();
    let Some((_, first)) = lines.first() else {
        return Err(whole(
            "the table is empty: a heading `row,node,dof` and a line for each tied row are wanted"
                .into(),
        ));
    };
    let is_dof = table.name.to_ascii_lowercase().ends_with(".dof") || direction(first).is_some();
    match is_dof {
        true => dofs(table, &lines, size, &mut ties)?,
        false => listed(table, &lines, size, &mut ties)?,
    }
    ties.finished().map_err(whole)
}

/// The lines that tell something, by their numbers from 1.
pub(super) fn told(table: &FileText) -> impl Iterator<Item = (usize, &str)> {
    let text = table.text.trim_start_matches('\u{feff}');
    let is_told = |line: &str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    text.lines().enumerate().map(|(i, l)| (i + 1, l)).filter(move |(_, l)| is_told(l))
}

/// What stands between the fields of a table with this heading.
pub(super) fn separator(heading: &str) -> char {
    [',', ';', '\t'].into_iter().find(|c| heading.contains(*c)).unwrap_or(',')
}

/// A heading, and a line for each row that is told.
fn listed(
    table: &FileText,
    lines: &[(usize, &str)],
    size: usize,
    ties: &mut Ties<'_>,
) -> Result<(), FileError> {
    let (at, heading) = lines[0];
    let separator = separator(heading);
    let names: Vec<String> = parts(heading, separator).map(str::to_ascii_lowercase).collect();
    if names != ["row", "node", "dof"] {
        let message = format!("the heading is `{}`: `row,node,dof` is wanted", heading.trim());
        return Err(table.error(at, message));
    }
    let mut lines_of: HashMap<usize, usize> = HashMap::new();
    for (at, line) in &lines[1..] {
        let wrong = |message: String| table.error(*at, message);
        let Ok([row, label, dof]) =
            <[&str; 3]>::try_from(parts(line, separator).collect::<Vec<_>>())
        else {
            let message = format!("`{}`: a row, a node and a direction are wanted", line.trim());
            return Err(wrong(message));
        };
        let Some(row) = row.parse::<usize>().ok().filter(|row| (1..=size).contains(row)) else {
            let message =
                format!("there is no row `{row}`: the matrices have {size}, counted from 1");
            return Err(wrong(message));
        };
        let Some(dof) = Dof::ALL.into_iter().find(|d| d.name() == dof) else {
            let message = format!("`{dof}` is no direction: must be Ux, Uy, Uz, Rx, Ry or Rz");
            return Err(wrong(message));
        };
        if let Some(first) = lines_of.insert(row, *at) {
            return Err(wrong(format!("row {row} stands in line {first} already")));
        }
        ties.add(row - 1, label, Some(dof)).map_err(wrong)?;
    }
    Ok(())
}

/// A line `node.direction` for every row in its order, directions from 1
/// [G. Dhondt, "CalculiX CrunchiX User's Manual", the card `*FREQUENCY`].
fn dofs(
    table: &FileText,
    lines: &[(usize, &str)],
    size: usize,
    ties: &mut Ties<'_>,
) -> Result<(), FileError> {
    if lines.len() != size {
        let message = format!(
            "{} lines, and the matrices have {size} rows: a line for each row is wanted",
            lines.len()
        );
        return Err(FileError { file: table.name.clone(), line: None, message });
    }
    let mut met: HashMap<(&str, Dof), usize> = HashMap::new();
    for (row, (at, line)) in lines.iter().enumerate() {
        let Some((label, dof)) = direction(line) else {
            let message = format!(
                "`{}`: a node and its direction are wanted, as in `12.1`, 1 to 3 along X, Y and Z, 4 to 6 about them",
                line.trim()
            );
            return Err(table.error(*at, message));
        };
        if let Some(first) = met.insert((label, dof), *at) {
            let message = format!("`{}` stands in line {first} already", line.trim());
            return Err(table.error(*at, message));
        }
        ties.add(row, label, Some(dof)).map_err(|message| table.error(*at, message))?;
    }
    Ok(())
}

/// Node and direction of `12.1`.
fn direction(line: &str) -> Option<(&str, Dof)> {
    let (node, dof) = line.trim().split_once('.')?;
    let is_whole = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let dof = Dof::ALL.get(dof.parse::<usize>().ok()?.checked_sub(1)?)?;
    is_whole(node).then_some((node, *dof))
}

pub(super) fn parts(line: &str, separator: char) -> impl Iterator<Item = &str> {
    line.split(separator).map(|part| part.trim().trim_matches('"'))
}

/// Rows on their way to the nodes of the element.
pub(super) struct Ties<'a> {
    labels: &'a [&'a str],
    nodes: HashMap<&'a str, usize>,
    rows: Vec<SparseRow>,
    tied: HashMap<(usize, Dof), usize>,
    /// True for the nodes that have a row.
    met: Vec<bool>,
}

impl<'a> Ties<'a> {
    /// Rows of which nothing is told yet; nodes that are led need none.
    pub fn new(size: usize, labels: &'a [&'a str], led: &[usize]) -> Result<Self, String> {
        let mut nodes: HashMap<&str, usize> = HashMap::new();
        for (node, label) in labels.iter().enumerate() {
            if nodes.insert(label, node).is_some() {
                return Err(format!("two nodes have the label `{label}`"));
            }
        }
        let (rows, mut met) = (vec![SparseRow::Inner(None); size], vec![false; labels.len()]);
        led.iter().for_each(|node| met[*node] = true);
        Ok(Self { labels, nodes, rows, tied: HashMap::new(), met })
    }

    /// A row, from 0, is a direction of what the files call so.
    pub fn add(&mut self, row: usize, label: &str, dof: Option<Dof>) -> Result<(), String> {
        let Some((&node, dof)) = self.nodes.get(label).zip(dof) else {
            self.rows[row] = SparseRow::Inner(dof);
            return Ok(());
        };
        if let Some(first) = self.tied.insert((node, dof), row) {
            return Err(format!("{} of node `{label}` is row {} already", dof.name(), first + 1));
        }
        self.met[node] = true;
        self.rows[row] = SparseRow::Node(node, dof);
        Ok(())
    }

    /// All rows, where every node has some.
    pub fn finished(self) -> Result<Vec<SparseRow>, String> {
        match self.met.iter().position(|met| !met) {
            Some(node) => Err(format!(
                "no row is of a node `{}`: every node of the element needs one, under its name or its label",
                self.labels[node]
            )),
            None => Ok(self.rows),
        }
    }
}
