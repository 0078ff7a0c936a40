//! Superelement: walls, slabs, tanks and machines by the matrices of another program.
//!
//! ```text
//!   | K_tt K_ti | | u_t |                 t: rows tied to directions of nodes of the model
//!   | K_it K_ii | | u_i |                 i: all other rows, equations of their own
//!
//!   r_i = −K_ii⁻¹ K_it r_t                r: moved as a rigid body, where the table gives a row no direction
//! ```
//!
//! | parameter   | symbol | unit | default | meaning                                        |
//! |-------------|--------|------|---------|------------------------------------------------|
//! | `stiffness` | K      | SI   | –       | `.mtx`, `.npz`, `.sti`, `.mas` or `.pch`       |
//! | `mass`      | M      | SI   | none    | the same                                       |
//! | `damping`   | C      | SI   | none    | the same                                       |
//! | `rows`      |        |      | none    | CSV `row,node,dof`, or `.dof`: what rows are   |
//! | `labels`    |        |      | names   | what the files call its nodes, in their order  |
//! | `recovery`  | R      | SI   | none    | CSV `node,dof,row,value`: nodes that follow rows |
//!
//! Matrices are in global axes and SI: N/m, N, N·m; kg, kg·m, kg·m². The rigid motion r of inner rows spreads weight and
//! ground motion over them: a row that the table lists goes with its direction, whoever its node is; others follow the
//! tied ones by K.
//!
//! Directions of nodes that `recovery` lists are no rows: they follow these, `u = R u_rows`, as what is inside a structure
//! that has been reduced does.

mod checks;
mod named;
mod recovery;
mod table;

use std::sync::Arc;
use trilith_element::{
    Card, Category, Default, ElementMatrices, Exercise, Form, Geometry, LinearElement,
    NodalOutline, NodeCount, Parameter, ParameterError, SparseMatrices, SparseMatrix, Value,
    Values, sub,
};

/// A structure by its matrices.
#[derive(Clone, Debug)]
pub struct Superelement {
    sparse: SparseMatrices,
}

impl Superelement {
    /// The card.
    pub const CARD: Card = Card::new(
        "Superelement",
        Category::Linear,
        "A structure by its matrices, made by another program: a wall, a slab, a tank, a machine.",
    )
    .nodes(NodeCount::at_least(1))
    .parameters(&[
        Parameter::new(
            "stiffness",
            "K",
            Form::SparseMatrix,
            Default::Required,
            "stiffness matrix in global axes and SI (N/m, N, N·m)",
        ),
        Parameter::new(
            "mass",
            "M",
            Form::SparseMatrix,
            Default::Absent,
            "mass matrix (kg, kg·m, kg·m²); without it there is no mass",
        ),
        Parameter::new(
            "damping",
            "C",
            Form::SparseMatrix,
            Default::Absent,
            "damping matrix (N·s/m, N·s, N·m·s), beside what `damping` of the model gives",
        ),
        Parameter::new(
            "rows",
            "",
            Form::File,
            Default::Absent,
            "what rows are: CSV file `row,node,dof`, number of a row, from 1, label of its node, and `Ux` … `Rz`, or the `.dof` of CalculiX; not with `.pch`, which says so itself",
        ),
        Parameter::new(
            "labels",
            "",
            Form::Labels,
            Default::Absent,
            "what the files call its nodes, in their order; instead, `nodes` may be a map from labels to nodes. Without either the files use the names of the nodes",
        ),
        Parameter::new(
            "recovery",
            "R",
            Form::File,
            Default::Absent,
            "directions of nodes that are no rows and follow them, `u = R u_rows`: CSV file `node,dof,row,value`, label of the node, `Ux` … `Rz`, number of a row, from 1, and its share",
        ),
    ])
    .law("K u + C u̇ + M ü, rows tied to directions of nodes as `rows` says\nall other rows are equations of the system")
    .source("R. D. Cook et al., Concepts and Applications of Finite Element Analysis, 4th ed., 2002, §10.11")
    .example(r#""rod": Superelement(nodes: {"1": "a", "3": "b"}, stiffness: Contents("k.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 2e8\n2 1 -2e8\n2 2 4e8\n3 2 -2e8\n3 3 2e8"), mass: Contents("m.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 50\n2 2 100\n3 3 50"), rows: Contents("rows.csv", "row,node,dof\n1,1,Ux\n2,2,Ux\n3,3,Ux"))"#)
    .exercise(Exercise::NONE);

    /// Reads the parameters.
    ///
    /// # Errors
    /// What is wrong with a file, by parameter, file and line.
    pub fn read(values: &Values) -> Result<Self, ParameterError> {
        const NAMES: &[&str] = &["stiffness", "mass", "damping", "rows", "labels", "recovery"];
        if let Some((name, _)) = values.0.iter().find(|(name, _)| !NAMES.contains(&name.as_str())) {
            return Err(serde::de::Error::unknown_field(name, NAMES));
        }
        let matrix = |name: &str| match values.get(name) {
            Some(Value::Matrix(matrix)) => checks::checked(name, matrix).map(Some),
            _ => Ok(None),
        };
        let stiffness = matrix("stiffness")?
            .ok_or_else(|| ParameterError::inconsistent("stiffness", "there is no `stiffness`"))?;
        let (mass, damping) = (matrix("mass")?, matrix("damping")?);
        let labels: Vec<&str> = match values.get("labels") {
            Some(Value::List(texts)) => texts.iter().filter_map(text).collect(),
            _ => Vec::new(),
        };
        let (rows, recovered) = (Vec::new(), Vec::new());
        let mut sparse = SparseMatrices { rows, stiffness, mass, damping, recovered };
        for (name, other) in [("mass", &sparse.mass), ("damping", &sparse.damping)] {
            other.as_ref().map_or(Ok(()), |other| alike(name, other, &sparse.stiffness))?;
        }
        let file = |name: &str| match values.get(name) {
            Some(Value::File(table)) => Some(table),
            _ => None,
        };
        let (table, recovery) = (file("rows"), file("recovery"));
        let led = match recovery {
            Some(table) => recovery::nodes(table, &labels)?,
            None => Vec::new(),
        };
        let file = &sparse.stiffness.name;
        match (table, sparse.stiffness.rows.is_empty()) {
            (Some(table), true) => {
                sparse.rows = table::rows(table, sparse.stiffness.size, &labels, &led)?;
            }
            (None, false) => named::tie(&mut sparse, &labels, &led)?,
            (Some(_), false) => {
                let message = format!("{file} says itself what its rows are: leave out `rows`");
                return Err(ParameterError::inconsistent("rows", &message));
            }
            (None, true) => {
                let message = format!(
                    "{file} does not say what its rows are: a table of `rows` is wanted, CSV `row,node,dof` or the `.dof` of CalculiX"
                );
                return Err(ParameterError::inconsistent("rows", &message));
            }
        }
        if let Some(table) = recovery {
            sparse.recovered = recovery::read(table, &sparse.rows, &labels)?;
        }
        Ok(Self { sparse })
    }
}

fn text(value: &Value) -> Option<&str> {
    match value {
        Value::Text(text) => Some(text),
        _ => None,
    }
}

/// Of the same rows, or both of rows that have names.
fn alike(name: &str, a: &SparseMatrix, stiffness: &SparseMatrix) -> Result<(), ParameterError> {
    let message = match (a.rows.is_empty(), stiffness.rows.is_empty()) {
        (true, true) if a.size != stiffness.size => format!(
            "{} has {} rows, and the stiffness of {} has {}: both must be of the same rows",
            a.name, a.size, stiffness.name, stiffness.size
        ),
        (true, false) | (false, true) => format!(
            "one of {} and {} says what its rows are, and the other does not: both must be of one form",
            a.name, stiffness.name
        ),
        _ => return Ok(()),
    };
    Err(ParameterError::File { name: name.to_owned(), message })
}

impl LinearElement for Superelement {
    fn matrices(&self, _at: &Geometry<'_>) -> Result<ElementMatrices, ParameterError> {
        Ok(ElementMatrices::zeros(Vec::new()))
    }

    fn sparse(&self) -> Option<&SparseMatrices> {
        Some(&self.sparse)
    }

    /// Lines from its centre to its nodes.
    fn outline(&self, at: &Geometry<'_>) -> Option<NodalOutline> {
        let count = at.nodes.len();
        if count < 3 {
            return None;
        }
        let mean = |k: usize| at.nodes.iter().map(|p| p[k]).sum::<f64>() / count as f64;
        let centre = sub([mean(0), mean(1), mean(2)], at.nodes[0]);
        let mut points = vec![(0, centre)];
        points.extend((0..count).map(|node| (node, [0.0; 3])));
        Some(NodalOutline { points, paths: (1..=count).map(|i| vec![0, i]).collect() })
    }
}

/// The reader for a registry.
pub(crate) fn reader() -> trilith_element::ReadLinear {
    Arc::new(|values| Ok(Box::new(Superelement::read(values)?)))
}

#[cfg(test)]
mod tests;
