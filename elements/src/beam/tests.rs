use super::*;
use crate::shared::parameters::read;
use approx::assert_relative_eq;
use nalgebra::{DVector, SymmetricEigen};
use trilith_element::{Dof, Frame, Value};

const E: f64 = 2.1e11;
const L: f64 = 3.0;
const I3: f64 = 2e-5;
const I2: f64 = 8e-6;
const G: f64 = 8e10;
const A: f64 = 6e-3;
const RHO: f64 = 7850.0;

fn beam(extra: &[(&str, Value)]) -> Beam {
    let n = Value::Number;
    let mut given = vec![
        ("young", n(E)),
        ("shear_modulus", n(G)),
        ("area", n(A)),
        ("i2", n(I2)),
        ("i3", n(I3)),
        ("torsion", n(1e-6)),
        ("density", n(RHO)),
    ];
    given.extend(extra.iter().cloned());
    read(&given).unwrap()
}

fn text(name: &str) -> Value {
    Value::Text(name.into())
}

fn matrices_between(beam: &Beam, nodes: &[[f64; 3]; 2]) -> (DMatrix<f64>, DMatrix<f64>) {
    let frame = Frame::of_nodes(nodes, None, None).unwrap();
    let got = beam.matrices(&Geometry::new(nodes, frame)).unwrap();
    let (mut k, mut m) = (DMatrix::zeros(12, 12), DMatrix::zeros(12, 12));
    let row = |p: usize| got.dofs[p].0 * 6 + got.dofs[p].1.index();
    for p in 0..got.dofs.len() {
        for q in 0..got.dofs.len() {
            k[(row(p), row(q))] = got.stiffness[(p, q)];
            m[(row(p), row(q))] = got.mass[(p, q)];
        }
    }
    (k, m)
}

/// Along X: local 2 is Z, local 3 is −Y.
fn matrices(beam: &Beam) -> (DMatrix<f64>, DMatrix<f64>) {
    matrices_between(beam, &[[0.0; 3], [L, 0.0, 0.0]])
}

fn free_end(a: &DMatrix<f64>) -> DMatrix<f64> {
    a.view((6, 6), (6, 6)).into_owned()
}

/// Displacement of the free end of a cantilever in the direction of a unit force there.
fn tip(beam: &Beam, dof: Dof) -> f64 {
    let mut p = DVector::zeros(6);
    p[dof.index()] = 1.0;
    free_end(&matrices(beam).0).lu().solve(&p).unwrap()[dof.index()]
}

#[test]
fn a_cantilever_bends_by_pl3_over_3ei_in_both_planes() {
    let b = beam(&[]);
    assert_relative_eq!(tip(&b, Dof::Uz), L.powi(3) / (3.0 * E * I3), max_relative = 1e-12);
    assert_relative_eq!(tip(&b, Dof::Uy), L.powi(3) / (3.0 * E * I2), max_relative = 1e-12);
    assert_relative_eq!(tip(&b, Dof::Ux), L / (E * A), max_relative = 1e-12);
    assert_relative_eq!(tip(&b, Dof::Rx), L / (G * 1e-6), max_relative = 1e-12);
}

#[test]
fn shear_adds_pl_over_ga_to_the_tip() {
    let b = beam(&[("shear_area_2", Value::Number(3e-3)), ("shear_area_3", Value::Number(1e-3))]);
    let up = L.powi(3) / (3.0 * E * I3) + L / (G * 3e-3);
    let across = L.powi(3) / (3.0 * E * I2) + L / (G * 1e-3);
    assert_relative_eq!(tip(&b, Dof::Uz), up, max_relative = 1e-12);
    assert_relative_eq!(tip(&b, Dof::Uy), across, max_relative = 1e-12);
}

#[test]
fn a_pinned_end_has_no_row_and_leaves_3ei_over_l3() {
    let b = beam(&[("release_j", Value::List(vec![text("R3"), text("R2")]))]);
    let nodes = [[0.0; 3], [L, 0.0, 0.0]];
    let frame = Frame::of_nodes(&nodes, None, None).unwrap();
    let got = b.matrices(&Geometry::new(&nodes, frame)).unwrap();
    assert!(!got.dofs.contains(&(1, Dof::Ry)) && !got.dofs.contains(&(1, Dof::Rz)));
    let uz = got.dofs.iter().position(|d| *d == (1, Dof::Uz)).unwrap();
    assert_relative_eq!(got.stiffness[(uz, uz)], 3.0 * E * I3 / L.powi(3), max_relative = 1e-12);
}

#[test]
fn releasing_both_ends_leaves_a_truss_and_one_more_is_refused() {
    let both = Value::List(vec![text("R2"), text("R3")]);
    let b = beam(&[("release_i", both.clone()), ("release_j", both)]);
    let (k, _) = matrices(&b);
    assert_eq!(k[(2, 2)], 0.0);
    assert_relative_eq!(k[(0, 0)], E * A / L, max_relative = 1e-12);
    let twice = Value::List(vec![text("R1")]);
    let b = beam(&[("release_i", twice.clone()), ("release_j", twice)]);
    let nodes = [[0.0; 3], [L, 0.0, 0.0]];
    let frame = Frame::of_nodes(&nodes, None, None).unwrap();
    let err = b.matrices(&Geometry::new(&nodes, frame)).unwrap_err();
    assert_eq!(err.parameter(), Some("release_j"));
}

#[test]
fn rigid_offsets_shorten_the_flexible_length_and_keep_the_arm() {
    let b = beam(&[("offset_i", Value::Number(0.5)), ("offset_j", Value::Number(0.7))]);
    let l = L - 1.2;
    // A unit force at the node acts on the flexible tip as force and moment 0.7 of it.
    let ei = E * I3;
    let expected = l.powi(3) / (3.0 * ei) + 0.7 * l * l / ei + 0.49 * l / ei;
    assert_relative_eq!(tip(&b, Dof::Uz), expected, max_relative = 1e-11);
}

#[test]
fn rigid_offsets_that_stiffen_bending_alone_leave_stretch_to_the_whole_length() {
    let ends = [("offset_i", Value::Number(0.5)), ("offset_j", Value::Number(0.7))];
    let all = beam(&ends);
    let bending = beam(&[&ends[..], &[("offsets_stiffen", text("Bending"))]].concat());
    assert_relative_eq!(tip(&all, Dof::Ux), (L - 1.2) / (E * A), max_relative = 1e-11);
    assert_relative_eq!(tip(&bending, Dof::Ux), L / (E * A), max_relative = 1e-11);
    assert_relative_eq!(tip(&bending, Dof::Uz), tip(&all, Dof::Uz), max_relative = 1e-11);
    assert!(tip(&bending, Dof::Rx) > 1.3 * tip(&all, Dof::Rx));
}

#[test]
fn rigid_motions_cost_nothing_and_weigh_the_whole_mass() {
    let o = Value::Number(0.4);
    let cases: [&[(&str, Value)]; 4] = [
        &[],
        &[("mass_matrix", text("Consistent"))],
        &[("mass_matrix", text("Consistent")), ("offset_i", o.clone()), ("offset_j", o)],
        &[("mass_matrix", text("Consistent")), ("shear_coefficient", Value::Number(0.8))],
    ];
    let nodes = [[1.0, 2.0, 3.0], [2.5, 0.5, 4.0]];
    let span = DVector::from_vec(vec![1.5, -1.5, 1.0]);
    let mass = RHO * A * span.norm();
    for extra in cases {
        let (k, m) = matrices_between(&beam(extra), &nodes);
        for i in 0..3 {
            let mut u = DVector::zeros(12);
            (u[i], u[6 + i]) = (1.0, 1.0);
            assert!((&k * &u).amax() < 1e-9 * k.amax());
            assert_relative_eq!((u.transpose() * &m * &u)[0], mass, max_relative = 1e-12);
            // Rotation about node i.
            let mut axis = nalgebra::Vector3::zeros();
            axis[i] = 1.0;
            let arm = axis.cross(&nalgebra::Vector3::new(span[0], span[1], span[2]));
            let mut r = DVector::zeros(12);
            (r[3 + i], r[9 + i]) = (1.0, 1.0);
            (0..3).for_each(|x| r[6 + x] = arm[x]);
            assert!((&k * &r).amax() < 1e-9 * k.amax());
            if !extra.is_empty() {
                let turned = (r.transpose() * &m * &r)[0];
                let rod = mass * arm.norm_squared() / 3.0;
                assert!((turned - rod).abs() < RHO * (I2 + I3) * L, "{turned} {rod}");
            }
        }
    }
}

#[test]
fn consistent_mass_gives_the_first_cantilever_frequency() {
    let b = beam(&[("mass_matrix", text("Consistent"))]);
    let (k, m) = matrices(&b);
    let n = 8;
    let (k, m) = chain(&k, &m, n, &b);
    let chol = m.cholesky().unwrap().l();
    let inv = chol.try_inverse().unwrap();
    let values = SymmetricEigen::new(&inv * k * inv.transpose()).eigenvalues;
    let got = values.min().sqrt();
    let exact = 1.875_104_068_711_961_f64.powi(2) * (E * I3 / (RHO * A * L.powi(4))).sqrt();
    // Hermite elements converge with h⁴ from above: (β h)⁴/720 ≈ 4e-6 for 8 elements.
    assert_relative_eq!(got, exact, max_relative = 1e-5);
    assert!(got >= exact);
}

/// In-plane (Uz, Ry) cantilever of `n` elements over the length L.
fn chain(_: &DMatrix<f64>, _: &DMatrix<f64>, n: usize, b: &Beam) -> (DMatrix<f64>, DMatrix<f64>) {
    let (ke, me) = matrices_between(b, &[[0.0; 3], [L / n as f64, 0.0, 0.0]]);
    let rows = [2, 4, 8, 10];
    let size = 2 * (n + 1);
    let (mut k, mut m) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
    for e in 0..n {
        for p in 0..4 {
            for q in 0..4 {
                k[(2 * e + p, 2 * e + q)] += ke[(rows[p], rows[q])];
                m[(2 * e + p, 2 * e + q)] += me[(rows[p], rows[q])];
            }
        }
    }
    let inner = |a: DMatrix<f64>| a.view((2, 2), (size - 2, size - 2)).into_owned();
    (inner(k), inner(m))
}

#[test]
fn a_rectangle_gives_its_section_and_a_square_the_known_torsion() {
    let n = Value::Number;
    let given = [("young", n(E)), ("poisson", n(0.25)), ("width", n(0.2)), ("depth", n(0.4))];
    let s = read::<Beam>(&given).unwrap().section();
    assert_relative_eq!(s.i3, 0.2 * 0.4_f64.powi(3) / 12.0, max_relative = 1e-14);
    assert_relative_eq!(s.i2, 0.4 * 0.2_f64.powi(3) / 12.0, max_relative = 1e-14);
    assert_relative_eq!(s.torsion, 0.229 * 0.4 * 0.2_f64.powi(3), max_relative = 5e-3);
    let square = [("young", n(E)), ("poisson", n(0.25)), ("width", n(1.0)), ("depth", n(1.0))];
    assert_relative_eq!(
        read::<Beam>(&square).unwrap().section().torsion,
        0.1406,
        max_relative = 3e-3
    );
}

#[test]
fn refuses_contradictions_by_name() {
    let n = Value::Number;
    let name =
        |given: &[(&str, Value)]| read::<Beam>(given).unwrap_err().parameter().map(str::to_owned);
    assert_eq!(name(&[("young", n(E))]).as_deref(), Some("area"));
    assert_eq!(name(&[("young", n(E)), ("width", n(1.0))]).as_deref(), Some("width"));
    let torsion = [("young", n(E)), ("area", n(A)), ("torsion", n(1e-6))];
    assert_eq!(name(&torsion).as_deref(), Some("shear_modulus"));
}

#[test]
fn refuses_coincident_nodes_and_offsets_longer_than_the_beam() {
    let frame = Frame::of_nodes(&[[0.0; 3]], Some([1.0, 0.0, 0.0]), None).unwrap();
    let same = [[0.0; 3]; 2];
    assert!(beam(&[]).matrices(&Geometry::new(&same, frame)).is_err());
    let long = beam(&[("offset_i", Value::Number(4.0))]);
    let nodes = [[0.0; 3], [L, 0.0, 0.0]];
    assert!(long.matrices(&Geometry::new(&nodes, frame)).is_err());
}
