//! Linear elements.

use super::error::MOTIONS;
use super::{StructureError as Broken, full, rigid_motions};
use crate::{Dof, ElementMatrices, Frame, Geometry, LinearElement, SquareMatrix, Vector3};

/// Rounding, as a share of the sizes that add up.
const ROUNDING: f64 = 1e-9;

/// How a linear element is examined; see the [module](super::super).
#[derive(Clone, Debug)]
pub struct ElementKit {
    nodes: Vec<Vector3>,
    axes: [Option<Vector3>; 2],
    global: bool,
    divisible: bool,
}

/// A matrix over six DOFs a node.
struct Whole {
    n: usize,
    values: Vec<f64>,
}

impl Whole {
    fn zeros(n: usize) -> Self {
        Self { n, values: vec![0.0; n * n] }
    }

    fn of(m: &ElementMatrices, a: &SquareMatrix, nodes: usize) -> Self {
        let mut whole = Self::zeros(6 * nodes);
        for (i, row) in m.dofs.iter().enumerate() {
            for (j, column) in m.dofs.iter().enumerate() {
                *whole.at(full(*row), full(*column)) += a[(i, j)];
            }
        }
        whole
    }

    fn at(&mut self, i: usize, j: usize) -> &mut f64 {
        &mut self.values[i * self.n + j]
    }

    fn get(&self, i: usize, j: usize) -> f64 {
        self.values[i * self.n + j]
    }

    /// R A Rᵀ with the rotation of every node's triads, and the sizes that added up.
    fn turned(&self, r: &[Vector3; 3]) -> (Self, Self) {
        let (mut sum, mut size) = (Self::zeros(self.n), Self::zeros(self.n));
        for i in 0..self.n {
            for j in 0..self.n {
                let (bi, bj) = (i - i % 3, j - j % 3);
                for k in 0..3 {
                    for l in 0..3 {
                        let part = r[i % 3][k] * self.get(bi + k, bj + l) * r[j % 3][l];
                        *sum.at(i, j) += part;
                        *size.at(i, j) += part.abs();
                    }
                }
            }
        }
        (sum, size)
    }
}

/// Node and direction of a row.
fn place(i: usize) -> (usize, &'static str) {
    (i / 6 + 1, Dof::ALL[i % 6].name())
}

fn parts(m: &ElementMatrices) -> [(&'static str, &SquareMatrix); 4] {
    [
        ("stiffness", &m.stiffness),
        ("damping", &m.damping),
        ("inertance", &m.inertance),
        ("mass", &m.mass),
    ]
}

/// A rotation by 0.7 about (1, 2, 3), row by row.
fn rotation() -> [Vector3; 3] {
    let (s, c) = 0.7_f64.sin_cos();
    let length = 14.0_f64.sqrt();
    let u = [1.0 / length, 2.0 / length, 3.0 / length];
    let skew = [[0.0, -u[2], u[1]], [u[2], 0.0, -u[0]], [-u[1], u[0], 0.0]];
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let own = if i == j { c } else { 0.0 };
            own + s * skew[i][j] + (1.0 - c) * u[i] * u[j]
        })
    })
}

fn times(r: &[Vector3; 3], x: Vector3) -> Vector3 {
    r.map(|row| row.iter().zip(x).map(|(a, b)| a * b).sum())
}

impl ElementKit {
    /// For an element with nodes at these positions, m.
    #[must_use]
    pub fn new(nodes: &[Vector3]) -> Self {
        Self { nodes: nodes.to_vec(), axes: [None; 2], global: false, divisible: false }
    }

    /// With these directions of local axes 1 and 2, as a model file gives them.
    #[must_use]
    pub fn axes(mut self, axis1: Option<Vector3>, axis2: Option<Vector3>) -> Self {
        self.axes = [axis1, axis2];
        self
    }

    /// Its parameters are in global axes: turned with its frame it need not be the same.
    #[must_use]
    pub fn in_global_axes(mut self) -> Self {
        self.global = true;
        self
    }

    /// It is a member between two nodes, and two of half its length in a row are as stiff as one.
    #[must_use]
    pub fn divisible(mut self) -> Self {
        self.divisible = true;
        self
    }

    /// Examines an element.
    ///
    /// # Errors
    /// The first property that does not hold, with its numbers.
    pub fn check(&self, element: &dyn LinearElement) -> Result<(), Broken> {
        let nodes = &self.nodes[..];
        let frame = Frame::of_nodes(nodes, self.axes[0], self.axes[1])?;
        let own = sound(element, nodes, frame)?;
        let again = matrices(element, nodes, frame)?;
        for ((what, a), (_, b)) in parts(&own).into_iter().zip(parts(&again)) {
            if a != b || own.dofs != again.dofs {
                return Err(Broken::Impure { what });
            }
        }
        if nodes.len() > 1 {
            rigid(&own, nodes)?;
        }
        let by = [3.0, -5.0, 7.0];
        let moved: Vec<Vector3> =
            nodes.iter().map(|x| std::array::from_fn(|i| x[i] + by[i])).collect();
        let there = sound(element, &moved, frame)?;
        let unturned = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        alike("moved", &own, &there, nodes.len(), &unturned)?;
        if !self.global {
            let r = rotation();
            let turned: Vec<Vector3> = nodes.iter().map(|x| times(&r, *x)).collect();
            let there = sound(element, &turned, Frame(frame.0.map(|axis| times(&r, axis))))?;
            alike("turned", &own, &there, nodes.len(), &r)?;
        }
        match (self.divisible, nodes) {
            (true, [a, b]) => halves(element, &own, (*a, *b), frame),
            _ => Ok(()),
        }
    }

    /// [`check`](Self::check) for tests.
    ///
    /// # Panics
    /// Where the element does not conform, with what is wrong.
    #[track_caller]
    pub fn assert(&self, element: &dyn LinearElement) {
        if let Err(error) = self.check(element) {
            panic!("{element:?} does not conform: {error}");
        }
    }
}

fn matrices(
    element: &dyn LinearElement,
    nodes: &[Vector3],
    frame: Frame,
) -> Result<ElementMatrices, Broken> {
    Ok(element.matrices(&Geometry { nodes, frame, tension: 0.0 })?)
}

/// The same, looked at; under an axial force as well.
fn sound(
    element: &dyn LinearElement,
    nodes: &[Vector3],
    frame: Frame,
) -> Result<ElementMatrices, Broken> {
    let own = matrices(element, nodes, frame)?;
    own.check(nodes.len(), element.softens())?;
    let size = own.stiffness.values().iter().fold(0.0_f64, |most, k| most.max(k.abs()));
    for tension in [-1e-3 * size, 1e-3 * size] {
        let tense = element.matrices(&Geometry { nodes, frame, tension })?;
        tense.check(nodes.len(), true)?;
    }
    Ok(own)
}

fn rigid(m: &ElementMatrices, nodes: &[Vector3]) -> Result<(), Broken> {
    for (motion, u) in MOTIONS.into_iter().zip(rigid_motions(nodes)) {
        for (what, a) in &parts(m)[..3] {
            for (i, row) in m.dofs.iter().enumerate() {
                let terms = || m.dofs.iter().enumerate().map(|(j, at)| a[(i, j)] * u[full(*at)]);
                let (value, size) = (terms().sum::<f64>(), terms().map(f64::abs).sum::<f64>());
                if value.abs() > ROUNDING * size {
                    let (node, direction) = place(full(*row));
                    return Err(Broken::Rigid { motion, what, node, direction, value });
                }
            }
        }
    }
    Ok(())
}

/// The matrices in another place are those of the first, turned.
fn alike(
    how: &'static str,
    own: &ElementMatrices,
    there: &ElementMatrices,
    nodes: usize,
    r: &[Vector3; 3],
) -> Result<(), Broken> {
    for ((what, a), (_, b)) in parts(own).into_iter().zip(parts(there)) {
        let (expected, sizes) = Whole::of(own, a, nodes).turned(r);
        let found = Whole::of(there, b, nodes);
        let most = sizes.values.iter().fold(0.0_f64, |most, x| most.max(*x));
        for i in 0..found.n {
            for j in 0..found.n {
                let (value, expected) = (found.get(i, j), expected.get(i, j));
                let allowed = ROUNDING * sizes.get(i, j) + 1e-3 * ROUNDING * most;
                if (value - expected).abs() > allowed {
                    let (row, column) = (place(i), place(j));
                    return Err(Broken::Place { how, what, row, column, value, expected });
                }
            }
        }
    }
    Ok(())
}

/// Two halves with the node between them eliminated.
fn halves(
    element: &dyn LinearElement,
    whole: &ElementMatrices,
    (a, b): (Vector3, Vector3),
    frame: Frame,
) -> Result<(), Broken> {
    let middle: Vector3 = std::array::from_fn(|i| 0.5 * (a[i] + b[i]));
    let whole = Whole::of(whole, &whole.stiffness, 2);
    // Nodes: a, b, the middle.
    let mut sum = Whole::zeros(18);
    for (nodes, places) in [([a, middle], [0, 2]), ([middle, b], [2, 1])] {
        let half = matrices(element, &nodes, frame)?;
        for (i, row) in half.dofs.iter().enumerate() {
            for (j, column) in half.dofs.iter().enumerate() {
                let to = |(n, dof): &(usize, Dof)| 6 * places[*n] + dof.index();
                *sum.at(to(row), to(column)) += half.stiffness[(i, j)];
            }
        }
    }
    let most = (12..18).map(|i| sum.get(i, i)).fold(0.0, f64::max);
    let mut open: Vec<usize> = (12..18).collect();
    // The largest pivot first; what nothing holds any more is zero.
    while let Some(at) = (0..open.len()).max_by(|x, y| {
        let pivot = |at: &usize| sum.get(open[*at], open[*at]);
        pivot(x).total_cmp(&pivot(y))
    }) {
        let p = open.swap_remove(at);
        let pivot = sum.get(p, p);
        if pivot <= ROUNDING * most {
            break;
        }
        for i in 0..18 {
            let factor = sum.get(i, p) / pivot;
            if i == p || factor == 0.0 {
                continue;
            }
            for j in 0..18 {
                let row = sum.get(p, j);
                *sum.at(i, j) -= factor * row;
            }
        }
        for i in 0..18 {
            (*sum.at(i, p), *sum.at(p, i)) = (0.0, 0.0);
        }
    }
    for i in 0..12 {
        for j in 0..12 {
            let (halves, whole_here) = (sum.get(i, j), whole.get(i, j));
            let size = (whole.get(i, i) * whole.get(j, j)).abs().sqrt().max(whole_here.abs());
            if (halves - whole_here).abs() > 10.0 * ROUNDING * size.max(1e-3 * most) {
                let (row, column) = (place(i), place(j));
                return Err(Broken::Halves { row, column, halves, whole: whole_here });
            }
        }
    }
    Ok(())
}
