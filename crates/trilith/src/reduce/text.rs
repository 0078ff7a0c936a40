//! A reduced part as files: matrices, tables and the model.

use super::{MatrixForm, Reduced};
use std::fmt::Write;
use std::sync::Arc;
use trilith_element::{FileText, MeshRow, SparseMatrix, Value, Values};
use trilith_model::{Model, Replacement, matrix_file, resolved_with, visible_line};

/// Name of the model file.
const MODEL: &str = "model.ron";
const ROWS: &str = "rows.csv";
const RECOVERY: &str = "recovery.csv";
/// Parameters of the matrices, and the names of their files without an ending.
const MATRICES: [&str; 3] = ["stiffness", "mass", "damping"];
const PUNCH: &str = "matrices.pch";
const OUTPUT4: &str = "matrices.op4";

/// Names of all files that a reduction may write; the model first.
pub const FILES: [&str; 11] = [
    MODEL,
    "stiffness.npz",
    "mass.npz",
    "damping.npz",
    "stiffness.mtx",
    "mass.mtx",
    "damping.mtx",
    PUNCH,
    OUTPUT4,
    ROWS,
    RECOVERY,
];

/// A dense matrix, column by column, by its entries.
pub(super) fn sparse(name: &str, values: &[f64], rows: &[MeshRow]) -> SparseMatrix {
    let size = rows.len();
    let all = (0..size).flat_map(|i| (0..size).map(move |j| (i, j)));
    let entries = all
        .map(|(i, j)| (i as u32, j as u32, values[j * size + i]))
        .filter(|e| e.2 != 0.0)
        .collect();
    let name = format!("{PUNCH}:{name}");
    SparseMatrix { name, size, entries, rows: rows.to_vec(), ..SparseMatrix::default() }
}

/// A name for the superelement: that of the one group or element, or `part`, as no other element has it.
pub(super) fn name(model: &Model, part: &[bool], names: &[String]) -> String {
    let first = match names {
        [one] => one.as_str(),
        _ => "part",
    };
    let taken =
        |name: &str| model.elements.iter().zip(part).any(|(e, own)| !*own && e.name == name);
    let mut name = first.to_owned();
    for i in 2.. {
        if !taken(&name) {
            break;
        }
        name = format!("{first} {i}");
    }
    name
}

impl Reduced<'_> {
    /// The matrices that there are, by parameter.
    fn own(&self) -> impl Iterator<Item = (&'static str, &SparseMatrix)> {
        let all = MATRICES.into_iter().zip(&self.matrices).enumerate();
        all.filter(|(i, (_, a))| *i == 0 || !a.entries.is_empty()).map(|(_, own)| own)
    }

    /// Which row is what: those of modes are left out, and move with nothing.
    fn row_table(&self) -> String {
        let mut table = String::from("row,node,dof\n");
        for (i, row) in self.matrices[0].rows.iter().enumerate() {
            if let Some(dof) = row.dof {
                // Writing to a String cannot fail.
                let _ = writeln!(table, "{},{},{}", i + 1, row.node, dof.name());
            }
        }
        table
    }

    fn recovery_table(&self) -> String {
        let mut table = String::from("node,dof,row,value\n");
        for (label, dof, shares) in &self.followed {
            for (row, share) in shares {
                let _ = writeln!(table, "{label},{},{},{share:e}", dof.name(), row + 1);
            }
        }
        table
    }

    /// The model with the superelement, whose matrices and tables `value` puts into its fields.
    fn model(&self, form: MatrixForm, value: impl Fn(&str, Part<'_>) -> Value) -> String {
        let mut values: Vec<(String, Value)> = self
            .own()
            .map(|(name, matrix)| (name.to_owned(), value(name, Part::Matrix(matrix))))
            .collect();
        if form != MatrixForm::Dmig {
            let table = value("rows", Part::Table(ROWS, self.row_table()));
            values.push(("rows".into(), table));
        }
        let labels = (1..=self.nodes.len()).map(|i| Value::Text(i.to_string())).collect();
        values.push(("labels".into(), Value::List(labels)));
        if !self.followed.is_empty() {
            let table = value("recovery", Part::Table(RECOVERY, self.recovery_table()));
            values.push(("recovery".into(), table));
        }
        let note = format!(
            "\"{}\" stands for {} elements: Craig–Bampton, {} rows of nodes and {} modes{}.",
            visible_line(&self.name),
            self.elements,
            self.rows,
            self.frequencies.len(),
            self.frequencies.last().map_or(String::new(), |f| format!(" up to {f:.4} Hz"))
        );
        resolved_with(
            self.model,
            &Replacement {
                notes: &[note],
                without_nodes: &self.without_nodes,
                without_elements: &self.without_elements,
                name: &self.name,
                kind: "Superelement",
                nodes: &self.nodes,
                values: &Values(values),
                patterns: &self.patterns,
            },
        )
    }

    /// The model as one text with the matrices in it.
    #[must_use]
    pub fn text(&self) -> String {
        self.model(MatrixForm::Market, |name, part| match part {
            Part::Matrix(matrix) => {
                // Without names of rows, as the table gives them.
                let (rows, name) = (Vec::new(), format!("{name}.mtx"));
                Value::Matrix(Arc::new(SparseMatrix { rows, name, ..matrix.clone() }))
            }
            Part::Table(file, text) => {
                Value::File(Arc::new(FileText { name: file.to_owned(), text }))
            }
        })
    }

    /// The files of a folder by their names: `model.ron`, which `trilith run` takes, and what it reads.
    ///
    /// # Errors
    /// Where an archive would be larger than its format knows.
    pub fn files(&self, form: MatrixForm) -> std::io::Result<Vec<(String, Vec<u8>)>> {
        let file = |name: &str, matrix: &SparseMatrix| match form {
            MatrixForm::Market => format!("{name}.mtx"),
            MatrixForm::Npz => format!("{name}.npz"),
            MatrixForm::Dmig => matrix.name.clone(),
            MatrixForm::Op4 => matrix.name.replace(PUNCH, OUTPUT4),
        };
        let text = self.model(form, |name, part| {
            Value::Text(match part {
                Part::Matrix(matrix) => file(name, matrix),
                Part::Table(file, _) => file.to_owned(),
            })
        });
        let mut files = vec![(MODEL.to_owned(), text.into_bytes())];
        let together = match form {
            MatrixForm::Dmig => Some(PUNCH),
            MatrixForm::Op4 => Some(OUTPUT4),
            MatrixForm::Market | MatrixForm::Npz => None,
        };
        let mut all = Vec::new();
        for (name, matrix) in self.own() {
            let bytes = matrix_file(matrix, form)?;
            match together {
                Some(_) => all.extend(bytes),
                None => files.push((file(name, matrix), bytes)),
            }
        }
        files.extend(together.map(|name| (name.to_owned(), all)));
        if form != MatrixForm::Dmig {
            files.push((ROWS.to_owned(), self.row_table().into_bytes()));
        }
        if !self.followed.is_empty() {
            files.push((RECOVERY.to_owned(), self.recovery_table().into_bytes()));
        }
        Ok(files)
    }
}

/// What a field of the superelement holds.
enum Part<'a> {
    Matrix(&'a SparseMatrix),
    /// Name of the file, and what is in it.
    Table(&'static str, String),
}
