//! Craig–Bampton reduction of a part of a model: a superelement of few rows in place of many elements.
//!
//! ```
//! # let text = r#"(
//! #     plane: XZ,
//! #     nodes: { "a": (0, 0, 0), "b": (0, 0, 1), "c": (0, 0, 2), "d": (0, 0, 3) },
//! #     supports: { "a": Fixed },
//! #     elements: {
//! #         "1": Beam(nodes: ("a", "b"), young: "210 GPa", area: 0.01, i2: 1e-5, i3: 1e-5, density: 7850),
//! #         "2": Beam(nodes: ("b", "c"), young: "210 GPa", area: 0.01, i2: 1e-5, i3: 1e-5, density: 7850),
//! #         "3": Beam(nodes: ("c", "d"), young: "210 GPa", area: 0.01, i2: 1e-5, i3: 1e-5, density: 7850),
//! #     },
//! #     groups: { "mast": ["1", "2", "3"] },
//! #     cases: { "push": Dynamic(duration: 0.1, dt: 0.01, initial: [(node: "d", dof: Ux, velocity: 1)]) },
//! #     outputs: { "top": Displacement(node: "d", dof: Ux) },
//! # )"#;
//! use trilith::reduce::{FixedModes, Request};
//!
//! let model = trilith::read_text(text, "mast.ron", &trilith::registry(), &[])?;
//! let analysis = trilith::Analysis::new(&model)?;
//! let reduced = analysis.reduce(&Request::new(["mast"], FixedModes::Count(2)))?;
//! assert_eq!(reduced.kept, ["a", "d"]);
//! let small = trilith::read_text(&reduced.text(), "small.ron", &trilith::registry(), &[])?;
//! assert_eq!((model.elements.len(), small.elements.len()), (3, 1));
//! assert!(trilith::run(&small, "push")?.peak("top")?.max > 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod part;
mod text;

pub use error::ReduceError;
pub use text::FILES;
pub use trilith_model::MatrixForm;
pub use trilith_solvers::FixedModes;

use part::Part;
use std::f64::consts::TAU;
use trilith_element::{Dof, MeshRow, SparseMatrix};
use trilith_model::{Model, NodalForce, Pattern};
use trilith_solvers::{CraigBampton, ReductionError};
use trilith_system::{Subset, System};

/// Entries of the largest table of inner nodes.
const MOST_SHARES: usize = 2_000_000;

/// What is reduced, and how far.
#[derive(Clone, Debug)]
pub struct Request {
    /// Names of elements, or of groups of them.
    pub part: Vec<String>,
    /// Names of nodes, or of groups of them, that are kept beside those that the rest of the model touches; none: those
    /// that loads and outputs name.
    pub keep: Option<Vec<String>>,
    /// Names of nodes, or of groups of them, that follow the rows, for outputs and loads. Those that the outputs and loads
    /// of the model name do so anyhow, where they are not kept.
    pub recover: Vec<String>,
    /// All nodes of the part that are not kept follow the rows.
    pub recover_all: bool,
    /// The fixed-interface modes.
    pub modes: FixedModes,
}

impl Request {
    /// The elements of these names, and so many modes.
    pub fn new<S: Into<String>>(part: impl IntoIterator<Item = S>, modes: FixedModes) -> Self {
        let part = part.into_iter().map(Into::into).collect();
        Self { part, keep: None, recover: Vec::new(), recover_all: false, modes }
    }
}

/// A direction of an inner node by the rows: label, direction, shares of rows from 0.
type Followed = (usize, Dof, Vec<(usize, f64)>);

/// A part by the matrices of few rows, and the model with it.
#[derive(Debug)]
pub struct Reduced<'a> {
    model: &'a Model,
    without_nodes: Vec<bool>,
    without_elements: Vec<bool>,
    patterns: Vec<Pattern>,
    /// Nodes of the superelement: those that are kept, then those that follow.
    nodes: Vec<usize>,
    matrices: [SparseMatrix; 3],
    followed: Vec<Followed>,
    /// Name of the superelement.
    pub name: String,
    /// How many elements it stands for.
    pub elements: usize,
    /// How many equations these have, those of nodes that are kept among them.
    pub equations: usize,
    /// Nodes that are kept.
    pub kept: Vec<String>,
    /// Nodes that follow the rows.
    pub recovered: Vec<String>,
    /// Rows of nodes that are kept; behind them stand those of modes.
    pub rows: usize,
    /// Fixed-interface frequencies, Hz, rising.
    pub frequencies: Vec<f64>,
    /// Number of fixed-interface modes that there are.
    pub available: usize,
    /// Effective mass of each fixed-interface mode along X, Y and Z, kg.
    pub effective_mass: Vec<[f64; 3]>,
    /// What all fixed-interface modes together have, kg.
    pub inner_mass: [f64; 3],
}

/// Reduces a part of an assembled model.
///
/// # Errors
/// [`ReduceError`] where the part is none, is not linear, or is not held by the nodes that are kept.
pub fn reduce<'a>(
    model: &'a Model,
    system: &System,
    request: &Request,
) -> Result<Reduced<'a>, ReduceError> {
    let part = Part::new(model, system, request)?;
    let own = system.subset(model, &part.elements, &part.kept)?;
    let node_of = |full: usize| system.inner.node(full);
    let is = |flags: &[bool], full: usize| node_of(full).is_some_and(|node| flags[node]);
    let rows: Vec<usize> = (0..own.full.len()).filter(|i| is(&part.kept, own.full[*i])).collect();
    if rows.is_empty() {
        return Err(ReduceError::NothingKept);
    }
    let matrices = [&own.stiffness, &own.mass, &own.damping];
    let cb = CraigBampton::new(matrices, &rows, request.modes)
        .map_err(|e| told(e, model, system, &own))?;
    let (effective_mass, inner_mass) = effective_masses(system, &own, &cb)?;

    let mut nodes: Vec<usize> = Vec::new();
    let mut labels = vec![0; model.nodes.len()];
    let mut label = |node: usize, nodes: &mut Vec<usize>| {
        if labels[node] == 0 {
            nodes.push(node);
            labels[node] = nodes.len();
        }
        labels[node]
    };
    let dof = |full: usize| Dof::ALL[full % 6];
    let mut mesh: Vec<MeshRow> = Vec::new();
    for row in &rows {
        let full = own.full[*row];
        let node = label(node_of(full).unwrap_or_default(), &mut nodes) as u32;
        mesh.push(MeshRow { node, dof: Some(dof(full)) });
    }
    let count = nodes.len();
    let mut followed: Vec<Followed> = Vec::new();
    let inner = (0..own.full.len()).filter(|i| is(&part.recovered, own.full[*i]));
    for row in inner {
        let full = own.full[row];
        let label = label(node_of(full).unwrap_or_default(), &mut nodes);
        followed.push((label, dof(full), shares(&cb, &[(row, 1.0)])));
    }
    // Directions of kept nodes as well, which follow others that are kept.
    let is_told = |full: usize| is(&part.recovered, full) || is(&part.kept, full);
    for (full, terms) in own.following.iter().filter(|(full, _)| is_told(*full)) {
        let label = label(node_of(*full).unwrap_or_default(), &mut nodes);
        followed.push((label, dof(*full), shares(&cb, terms)));
    }
    let shares: usize = followed.iter().map(|(.., all)| all.len()).sum();
    if shares > MOST_SHARES {
        return Err(ReduceError::TooMany { shares, most: MOST_SHARES });
    }
    // Amplitudes of modes are scalar points behind all nodes.
    let modes = cb.omega.len();
    mesh.extend((0..modes).map(|q| MeshRow { node: (nodes.len() + q + 1) as u32, dof: None }));
    let matrices = [("KAAX", &cb.stiffness), ("MAAX", &cb.mass), ("BAAX", &cb.damping)]
        .map(|(name, a)| text::sparse(name, a.values(), &mesh));
    let names = |all: &[usize]| all.iter().map(|i| model.nodes[*i].name.clone()).collect();
    let without_nodes = (0..model.nodes.len())
        .map(|i| part.nodes[i] && !part.kept[i] && !part.recovered[i])
        .collect();
    Ok(Reduced {
        model,
        without_nodes,
        patterns: patterns(model, system, &part.elements),
        matrices,
        followed,
        name: text::name(model, &part.elements, &request.part),
        elements: part.elements.iter().filter(|own| **own).count(),
        equations: own.full.len(),
        kept: names(&nodes[..count]),
        recovered: names(&nodes[count..]),
        nodes,
        rows: rows.len(),
        frequencies: cb.omega.iter().map(|w| w / TAU).collect(),
        available: cb.available,
        effective_mass,
        inner_mass,
        without_elements: part.elements,
    })
}

/// What a sum of rows moves by, in shares of all coordinates.
fn shares(cb: &CraigBampton, terms: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let at = |j: usize| terms.iter().map(|(row, c)| c * cb.shapes[(*row, j)]).sum::<f64>();
    (0..cb.shapes.columns()).map(|j| (j, at(j))).filter(|(_, x)| *x != 0.0).collect()
}

/// An error of the matrices in the words of the model.
fn told(error: ReductionError, model: &Model, system: &System, own: &Subset) -> ReduceError {
    let name = |row: &usize| system.inner.name(model, own.full[*row]);
    match error {
        ReductionError::Loose(rows) => ReduceError::Loose(rows.iter().map(name).collect()),
        ReductionError::Negative(row) => {
            let (node, direction) = name(&row);
            ReduceError::Negative { node, direction }
        }
        other => ReduceError::Reduction(other),
    }
}

/// Effective masses of the fixed-interface modes along X, Y and Z, and what all of them would have.
fn effective_masses(
    system: &System,
    own: &Subset,
    cb: &CraigBampton,
) -> Result<(Vec<[f64; 3]>, [f64; 3]), ReduceError> {
    let (mut each, mut all) = (vec![[0.0; 3]; cb.omega.len()], [0.0; 3]);
    for axis in 0..3 {
        let motion: Vec<f64> =
            cb.kept.iter().map(|row| system.inner.shift(own.full[*row], axis)).collect();
        let found = cb.effective_mass(&own.mass, &motion).map_err(ReduceError::Reduction)?;
        each.iter_mut().zip(found.0).for_each(|(each, m)| each[axis] = m);
        all[axis] = found.1;
    }
    Ok((each, all))
}

/// The load patterns with forces at nodes in place of loads along elements of the part.
fn patterns(model: &Model, system: &System, part: &[bool]) -> Vec<Pattern> {
    let mut all = model.patterns.clone();
    for pattern in &mut all {
        let (own, others): (Vec<_>, Vec<_>) =
            pattern.members.drain(..).partition(|load| part[load.element]);
        pattern.members = others;
        for load in own {
            let at_nodes = system.member_load(model, &load);
            pattern.forces.extend(at_nodes.into_iter().filter(|(_, x)| *x != 0.0).map(
                |(full, value)| NodalForce { node: full / 6, dof: Dof::ALL[full % 6], value },
            ));
        }
    }
    all
}
