//! Stiffness, mass and damping of linear elements from the textbook.
//!
//! Mass matrices are integrals of shape functions, taken by Gauss's rule; bars and beams in local axes,
//! DOFs in the order of the nodes. [Przemieniecki 1968; Cook, Malkus, Plesha & Witt 2002]

use super::spec::{Beam, V3};
use nalgebra::{DMatrix, Matrix3, Vector3};

/// Matrices of an element over six DOFs of each of its nodes, global directions.
pub struct Matrices {
    /// Stiffness.
    pub k: DMatrix<f64>,
    /// Mass.
    pub m: DMatrix<f64>,
    /// Damping.
    pub c: DMatrix<f64>,
}

impl Matrices {
    /// Nothing, over n DOFs.
    #[must_use]
    pub fn none(n: usize) -> Self {
        let zero = DMatrix::zeros(n, n);
        Self { k: zero.clone(), m: zero.clone(), c: zero }
    }
}

/// Rows: local axes 1, 2, 3. Axis 2 leans upwards, or along X where axis 1 is vertical.
#[must_use]
pub fn frame(from: V3, to: Option<V3>, axis1: Option<V3>) -> Matrix3<f64> {
    let span = to.map(|to| Vector3::from(to) - Vector3::from(from));
    let along = match (axis1, span) {
        (Some(a), _) => Vector3::from(a),
        (None, Some(s)) if s.norm() > 0.0 => s,
        _ => Vector3::z(),
    };
    let e1 = along.normalize();
    let vertical = e1.x.hypot(e1.y) < 1e-3;
    let up = if vertical { Vector3::x() } else { Vector3::z() };
    let e2 = (up - e1 * e1.dot(&up)).normalize();
    let e3 = e1.cross(&e2);
    Matrix3::from_rows(&[e1.transpose(), e2.transpose(), e3.transpose()])
}

/// R in blocks along the diagonal.
fn blocks(r: &Matrix3<f64>, count: usize) -> DMatrix<f64> {
    let mut t = DMatrix::zeros(3 * count, 3 * count);
    for b in 0..count {
        t.view_mut((3 * b, 3 * b), (3, 3)).copy_from(r);
    }
    t
}

/// Points in 0 … 1 and weights of Gauss's rule of order 10.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

/// ∫ s sᵀ over 0 … 1 for shape functions at x.
fn products(shapes: impl Fn(f64) -> [f64; 4]) -> [[f64; 4]; 4] {
    let mut sum = [[0.0; 4]; 4];
    for (x, w) in GAUSS {
        let s = shapes(x);
        for i in 0..4 {
            for j in 0..4 {
                sum[i][j] += w * s[i] * s[j];
            }
        }
    }
    sum
}

/// Beam between two points.
#[must_use]
pub fn beam(b: &Beam, from: V3, to: V3) -> Matrices {
    let r = frame(from, Some(to), None);
    let l = (Vector3::from(to) - Vector3::from(from)).norm();
    let mut it = Matrices::none(12);
    let mass = b.density * b.area * l;
    let pair = |a: &mut DMatrix<f64>, i: usize, j: usize, same: f64, other: f64| {
        a[(i, i)] += same;
        a[(j, j)] += same;
        a[(i, j)] += other;
        a[(j, i)] += other;
    };
    let (ea, gj) = (b.young * b.area / l, b.shear * b.torsion / l);
    pair(&mut it.k, 0, 6, ea, -ea);
    pair(&mut it.k, 3, 9, gj, -gj);
    if b.consistent {
        pair(&mut it.m, 0, 6, mass / 3.0, mass / 6.0);
        let polar = b.density * (b.i2 + b.i3) * l;
        pair(&mut it.m, 3, 9, polar / 3.0, polar / 6.0);
    } else {
        for i in [0, 1, 2, 6, 7, 8] {
            it.m[(i, i)] += mass / 2.0;
        }
    }
    // The rotation about local 3 is w₂′, the one about local 2 is −w₃′.
    for (inertia, dofs, sign) in [(b.i3, [1, 5, 7, 11], 1.0), (b.i2, [2, 4, 8, 10], -1.0)] {
        let ei = b.young * inertia;
        let phi =
            if b.kappa > 0.0 { 12.0 * ei / (b.shear * b.kappa * b.area * l * l) } else { 0.0 };
        // Hinge-free member by its flexibility: end moments of unit end rotations.
        let (near, far) = (ei / l * (4.0 + phi) / (1.0 + phi), ei / l * (2.0 - phi) / (1.0 + phi));
        // Bending modes: rotations of the ends against the chord.
        let turn = [[1.0 / l, 1.0, -1.0 / l, 0.0], [1.0 / l, 0.0, -1.0 / l, 1.0]];
        let signs = [1.0, sign, 1.0, sign];
        for i in 0..4 {
            for j in 0..4 {
                let s = near * (turn[0][i] * turn[0][j] + turn[1][i] * turn[1][j])
                    + far * (turn[0][i] * turn[1][j] + turn[1][i] * turn[0][j]);
                it.k[(dofs[i], dofs[j])] += signs[i] * signs[j] * s;
            }
        }
        if b.consistent {
            let shapes = |x: f64| {
                let d = 1.0 + phi;
                [
                    (1.0 - 3.0 * x * x + 2.0 * x.powi(3) + phi * (1.0 - x)) / d,
                    l * (x - 2.0 * x * x + x.powi(3) + 0.5 * phi * (x - x * x)) / d,
                    (3.0 * x * x - 2.0 * x.powi(3) + phi * x) / d,
                    l * (x.powi(3) - x * x - 0.5 * phi * (x - x * x)) / d,
                ]
            };
            let p = products(shapes);
            for i in 0..4 {
                for j in 0..4 {
                    it.m[(dofs[i], dofs[j])] += mass * signs[i] * signs[j] * p[i][j];
                }
            }
        }
    }
    let t = blocks(&r, 4);
    it.k = t.transpose() * &it.k * &t;
    it.m = t.transpose() * &it.m * &t;
    it
}

/// Bar between two points.
#[must_use]
pub fn truss(
    (young, area, density, consistent): (f64, f64, f64, bool),
    from: V3,
    to: V3,
) -> Matrices {
    let span = Vector3::from(to) - Vector3::from(from);
    let l = span.norm();
    let e = span / l;
    let mut it = Matrices::none(12);
    let mass = density * area * l;
    let (same, other) = if consistent { (mass / 3.0, mass / 6.0) } else { (mass / 2.0, 0.0) };
    for (a, b, s) in [(0, 0, 1.0), (0, 6, -1.0), (6, 0, -1.0), (6, 6, 1.0)] {
        for i in 0..3 {
            it.m[(a + i, b + i)] += if a == b { same } else { other };
            for j in 0..3 {
                it.k[(a + i, b + j)] += s * young * area / l * e[i] * e[j];
            }
        }
    }
    it
}

/// Local deformations over the DOFs of one or two nodes: those of the second node against the place that
/// a rigid arm on the first one brings there.
#[must_use]
pub fn deformation(from: V3, to: Option<V3>, axis1: Option<V3>) -> DMatrix<f64> {
    let r = frame(from, to, axis1);
    let t = blocks(&r, 2);
    let Some(to) = to else { return t };
    let arm = Vector3::from(to) - Vector3::from(from);
    // u_i + θ_i × arm.
    let mut carried = DMatrix::identity(6, 6);
    let cross = Matrix3::new(0.0, arm.z, -arm.y, -arm.z, 0.0, arm.x, arm.y, -arm.x, 0.0);
    carried.view_mut((0, 3), (3, 3)).copy_from(&cross);
    let mut b = DMatrix::zeros(6, 12);
    b.view_mut((0, 0), (6, 6)).copy_from(&(-(&t * carried)));
    b.view_mut((0, 6), (6, 6)).copy_from(&t);
    b
}

/// Springs and dashpots on deformations.
#[must_use]
pub fn spring(k: &[f64; 6], c: &[f64; 6], b: &DMatrix<f64>) -> Matrices {
    let with = |x: &[f64; 6]| b.transpose() * DMatrix::from_diagonal(&x.to_vec().into()) * b;
    Matrices { k: with(k), c: with(c), m: DMatrix::zeros(b.ncols(), b.ncols()) }
}
