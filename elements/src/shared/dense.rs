//! Small dense algebra between local stiffness and [`ElementMatrices`].

use nalgebra::{DMatrix, Matrix3, Vector3 as V3};
use trilith_element::{Dof, ElementMatrices, Frame, Geometry, Vector3};

/// Rows of the frame as a rotation matrix: local = R · global.
pub(crate) fn rotation(frame: &Frame) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| frame.0[i][j])
}

/// `b − a`.
pub(crate) fn between(a: Vector3, b: Vector3) -> V3<f64> {
    V3::from(b) - V3::from(a)
}

/// The frame twice along the diagonal.
fn twice(frame: &Frame) -> DMatrix<f64> {
    let r = rotation(frame);
    let mut t = DMatrix::zeros(6, 6);
    for b in 0..2 {
        t.view_mut((3 * b, 3 * b), (3, 3)).copy_from(&r);
    }
    t
}

/// A matrix over triples of local displacements or rotations, over global ones.
pub(crate) fn to_global(local: &DMatrix<f64>, frame: &Frame) -> DMatrix<f64> {
    let r = rotation(frame);
    let mut global = DMatrix::zeros(local.nrows(), local.ncols());
    for a in (0..local.nrows()).step_by(3) {
        for b in (0..local.ncols()).step_by(3) {
            let block: Matrix3<f64> = local.fixed_view::<3, 3>(a, b).into();
            global.fixed_view_mut::<3, 3>(a, b).copy_from(&(r.transpose() * block * r));
        }
    }
    global
}

/// Local deformations from the global displacements of one or two nodes: `6 × 6` or `6 × 12`. Two nodes
/// apart are joined by a rigid arm from i to j, and the deformation is taken at j.
pub(crate) fn deformations(at: &Geometry<'_>) -> DMatrix<f64> {
    let turned = twice(&at.frame);
    let [i, j] = at.nodes else { return turned };
    let mut b = DMatrix::zeros(6, 12);
    b.view_mut((0, 6), (6, 6)).copy_from(&turned);
    b.view_mut((0, 0), (6, 6)).copy_from(&(-turned));
    // −θ × r = r × θ
    let r = between(*i, *j);
    let arm = Matrix3::new(0.0, -r[2], r[1], r[2], 0.0, -r[0], -r[1], r[0], 0.0);
    b.view_mut((0, 3), (3, 3)).copy_from(&(rotation(&at.frame) * arm));
    b
}

/// Element matrices from matrices over all six DOFs of each node, without the DOFs that get nothing.
///
/// A row counts as nothing where its diagonal is rounding noise in all three matrices. These are
/// positive semi-definite, or have a geometric stiffness with a diagonal of its own in every row that
/// it fills, so the rest of such a row is noise as well.
pub(crate) fn used(k: &DMatrix<f64>, m: &DMatrix<f64>, c: &DMatrix<f64>) -> ElementMatrices {
    let noise = |a: &DMatrix<f64>| 1e-24 * a.diagonal().amax();
    let (nk, nm, nc) = (noise(k), noise(m), noise(c));
    let rows: Vec<usize> = (0..k.nrows())
        .filter(|&i| k[(i, i)].abs() > nk || m[(i, i)] > nm || c[(i, i)] > nc)
        .collect();
    let dofs = rows.iter().map(|r| (r / 6, Dof::ALL[r % 6])).collect();
    let mut out = ElementMatrices::zeros(dofs);
    for (p, &i) in rows.iter().enumerate() {
        for (q, &j) in rows.iter().enumerate() {
            // The mean of both halves makes the result symmetric to the last bit.
            out.stiffness[(p, q)] = 0.5 * (k[(i, j)] + k[(j, i)]);
            out.mass[(p, q)] = 0.5 * (m[(i, j)] + m[(j, i)]);
            out.damping[(p, q)] = 0.5 * (c[(i, j)] + c[(j, i)]);
        }
    }
    out
}

/// True for a symmetric matrix without negative eigenvalues, up to rounding.
pub(crate) fn is_semi_definite(a: &DMatrix<f64>) -> bool {
    let size = a.amax();
    if (a - a.transpose()).amax() > 1e-9 * size {
        return false;
    }
    // Scaling by the diagonal takes units out of the comparison.
    let s = a.diagonal().map(|x| if x > 0.0 { 1.0 / x.sqrt() } else { 0.0 });
    let scaled = DMatrix::from_fn(a.nrows(), a.ncols(), |i, j| s[i] * a[(i, j)] * s[j]);
    let bare = (0..a.nrows()).all(|i| a[(i, i)] > 0.0 || a.row(i).amax() == 0.0);
    bare && scaled.symmetric_eigenvalues().iter().all(|x| *x >= -1e-9)
}
