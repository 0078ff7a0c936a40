//! Frames of beams in a plane and in space, and long beams.

use super::links::{FREE, HELD, Size, along, between, law, node, section, shear};
use crate::oracle::rng::{Rng, figures};
use crate::oracle::spec::{Contact, Kind, Law, Spec, V3};

const UP: V3 = [0.0, 0.0, 1.0];
const X: V3 = [1.0, 0.0, 0.0];

fn size(rng: &mut Rng) -> (Size, f64) {
    let (mass, f) = (rng.log(500.0, 5e4), rng.log(0.8, 6.0));
    let w = std::f64::consts::TAU * f;
    (Size { k: figures(mass * w * w), u: figures(3.0 / (w * w)), w }, mass)
}

/// The foot of a column: held, pinned with something about it, or on an isolator.
fn foot(spec: &mut Spec, rng: &mut Rng, at: V3, s: Size, plane: bool) -> usize {
    match rng.weighted(&[4.0, 2.0, 2.0]) {
        0 => node(spec, at, HELD),
        1 => {
            let n = node(spec, at, [true, true, true, !plane, false, !plane]);
            let turn = figures(s.k * rng.log(0.5, 5.0));
            let kind = match rng.whole(0, 3) {
                0 => Kind::Spring([0.0, 0.0, 0.0, 0.0, 0.0, turn], [0.0; 6]),
                1 => Kind::Spring(
                    [0.0, 0.0, 0.0, 0.0, 0.0, turn],
                    [0.0, 0.0, 0.0, 0.0, 0.0, figures(turn / s.w * 0.2)],
                ),
                2 => Kind::Link(Law::Wen(turn, figures(turn * s.u / 3.0), 0.1, 2.0), 5),
                _ => Kind::Link(
                    Law::Plastic(
                        vec![0.0, 0.003, 0.05],
                        vec![0.0, figures(turn * 0.003), figures(turn * 0.003 + turn * 0.002)],
                    ),
                    5,
                ),
            };
            // Local 1 up, 2 along X, 3 along Y: R3 is about Y.
            spec.members.push(along(&[n], UP, kind));
            n
        }
        _ => {
            let n = node(spec, at, FREE);
            let k = figures(s.k * rng.log(0.2, 1.0));
            let up = figures(s.k * 50.0);
            let turn = figures(s.k * 20.0);
            let only = |x: usize, k: f64| {
                let mut all = [0.0; 6];
                all[x] = k;
                all
            };
            // Axis 1 up, 2 along X, 3 along Y.
            let mut k6 = [up, 0.0, 0.0, turn, turn, turn];
            let mut c6 = [0.0; 6];
            if rng.chance(0.3) {
                c6[1] = figures(k / s.w * 0.1);
                c6[2] = c6[1];
            }
            let isolator = match rng.whole(0, 2) {
                _ if rng.all_kinds && rng.chance(0.5) => Kind::Link(shear(rng, k, s), 1),
                0 => Kind::Link(Law::Elastomeric(k, figures(k * s.u), 0.1), 1),
                1 => Kind::Link(Law::Wen(k, figures(k * s.u), 0.15, 2.0), 1),
                _ => Kind::Spring(only(1, k), [0.0; 6]),
            };
            if !matches!(isolator, Kind::Link(Law::Elastomeric(..) | Law::Shear(_), _)) {
                k6[2] = k;
            }
            spec.members.push(along(&[n], UP, Kind::Spring(k6, c6)));
            spec.members.push(along(&[n], UP, isolator));
            n
        }
    }
}

/// Links that a frame gets besides.
fn extras(spec: &mut Spec, rng: &mut Rng, s: Size, braces: &[(usize, usize)], tops: &[usize]) {
    for (a, b) in braces {
        match rng.weighted(&[4.0, 1.0, 1.5, 1.0]) {
            1 => {
                let l = (0..3)
                    .map(|i| (spec.nodes[*a][i] - spec.nodes[*b][i]).powi(2))
                    .sum::<f64>()
                    .sqrt();
                let area = figures(s.k * rng.log(0.2, 2.0) * l / 2e11);
                let density = if rng.chance(0.5) { 0.0 } else { 7850.0 };
                spec.members
                    .push(between(&[*a, *b], Kind::Truss(2e11, area, density, rng.chance(0.5))));
            }
            2 => {
                let law = law(rng, s, false);
                if !matches!(law, Law::Linear(..)) {
                    spec.members.push(between(&[*a, *b], Kind::Link(law, 0)));
                }
            }
            3 => spec.members.push(between(
                &[*a, *b],
                super::links::axial(0.0, figures(s.k / s.w * rng.log(0.02, 0.3))),
            )),
            _ => {}
        }
    }
    for n in tops {
        if rng.chance(0.25) {
            let law = law(rng, s, false);
            spec.members.push(along(&[*n], X, Kind::Link(law, 0)));
        }
    }
}

/// A frame in XZ.
pub fn plane(rng: &mut Rng) -> Spec {
    let mut spec = Spec { family: "plane frame", plane: true, ..Spec::default() };
    let (s, mass) = size(rng);
    let (bays, storeys) = (rng.whole(0, 2), rng.whole(1, 3));
    let parts = rng.whole(1, 2);
    let height = rng.log(2.5, 5.0);
    let width = rng.log(3.0, 6.0);
    let own = rng.pick(&[0.0, 0.02, 0.2]);
    let [of_column, of_beam] = [0.0; 2].map(|_| s.k * rng.log(0.3, 3.0));
    let column = section(rng, of_column, height, mass * own);
    let beam = section(rng, of_beam, width, mass * own);
    let mut below: Vec<usize> = Vec::new();
    for b in 0..=bays {
        let at = [width * b as f64, 0.0, 0.0];
        let n = foot(&mut spec, rng, at, s, true);
        below.push(n);
    }
    let mut braces = Vec::new();
    let mut tops = Vec::new();
    for level in 1..=storeys {
        let z = height * level as f64;
        let mut row = Vec::new();
        for (b, low) in below.clone().into_iter().enumerate() {
            let top = node(&mut spec, [width * b as f64, 0.0, z], FREE);
            let mut last = low;
            for part in 1..parts {
                let share = part as f64 / parts as f64;
                let middle =
                    node(&mut spec, [width * b as f64, 0.0, z - height * (1.0 - share)], FREE);
                spec.members.push(between(&[last, middle], Kind::Beam(column)));
                last = middle;
            }
            spec.members.push(between(&[last, top], Kind::Beam(column)));
            if rng.chance(0.8) || level == storeys {
                let inertia =
                    if rng.chance(0.3) { figures(mass * rng.log(0.05, 0.5)) } else { 0.0 };
                let m = figures(mass * rng.log(0.3, 1.5));
                spec.members.push(between(&[top], Kind::Mass(m, [0.0, inertia, 0.0])));
            }
            row.push(top);
        }
        for b in 0..bays {
            // A girder that starts at a hinge, a link or at the column itself.
            let left = match rng.weighted(&[5.0, 1.0, 1.0]) {
                0 => row[b],
                hinge => {
                    let at = spec.nodes[row[b]];
                    let n = node(&mut spec, at, FREE);
                    spec.members.push(between(&[row[b], n], Kind::EqualDof(vec![0, 2])));
                    if hinge == 2 {
                        let turn = figures(s.k * rng.log(0.5, 5.0));
                        let law = match rng.whole(0, 2) {
                            0 => Law::Wen(turn, figures(turn * s.u / 3.0), 0.1, 2.0),
                            1 => Law::Dashpot(figures(turn / s.w * 0.3), 1.0),
                            _ => Law::Elastic(
                                vec![-0.01, 0.0, 0.01],
                                vec![-turn * 0.01, 0.0, turn * 0.01],
                            ),
                        };
                        // Local 1 up as the nodes coincide: R3 is about Y.
                        spec.members.push(along(&[row[b], n], UP, Kind::Link(law, 5)));
                    }
                    n
                }
            };
            spec.members.push(between(&[left, row[b + 1]], Kind::Beam(beam)));
            braces.push((below[b], row[b + 1]));
        }
        tops.extend(&row);
        below = row;
    }
    // An outrigger on a rigid arm, with a mass or a damper at its end.
    if rng.chance(0.25) {
        let at = rng.pick(&tops);
        let [x, _, z] = spec.nodes[at];
        let end = node(&mut spec, [figures(x + 0.3 * width), 0.0, figures(z + 0.2 * height)], FREE);
        spec.members.push(between(&[at, end], Kind::RigidLink));
        if rng.chance(0.6) {
            spec.members.push(between(&[end], Kind::Mass(figures(mass * 0.3), [0.0; 3])));
        }
        tops.push(end);
    }
    extras(&mut spec, rng, s, &braces, &tops);
    spec
}

/// A storey in space with a diaphragm.
pub fn space(rng: &mut Rng) -> Spec {
    let mut spec = Spec { family: "space frame", ..Spec::default() };
    let (s, mass) = size(rng);
    let (height, width, depth) = (rng.log(2.5, 4.0), rng.log(3.0, 6.0), rng.log(3.0, 6.0));
    let own = rng.pick(&[0.0, 0.02, 0.1]);
    let storeys = rng.whole(1, 2);
    let [of_column, of_beam] = [0.0; 2].map(|_| s.k * rng.log(0.2, 1.0));
    let column = section(rng, of_column, height, mass * own);
    let beam = section(rng, of_beam, width, mass * own);
    let places = [[0.0, 0.0], [width, 0.0], [width, depth], [0.0, depth]];
    let corners = rng.whole(2, 4);
    let mut below: Vec<usize> = Vec::new();
    for p in &places[..corners] {
        let n = foot(&mut spec, rng, [p[0], p[1], 0.0], s, false);
        below.push(n);
    }
    let (mut braces, mut tops) = (Vec::new(), Vec::new());
    for level in 1..=storeys {
        let z = height * level as f64;
        let row: Vec<usize> =
            places[..corners].iter().map(|p| node(&mut spec, [p[0], p[1], z], FREE)).collect();
        for (a, b) in below.iter().zip(&row) {
            spec.members.push(between(&[*a, *b], Kind::Beam(column)));
        }
        for i in 0..corners {
            let (a, b) = (row[i], row[(i + 1) % corners]);
            if corners > 2 || i == 0 {
                spec.members.push(between(&[a, b], Kind::Beam(beam)));
            }
            braces.push((below[i], row[(i + 1) % corners]));
        }
        if rng.chance(0.6) {
            let centre = node(
                &mut spec,
                [width * 0.4, depth * 0.55, z],
                [false, false, true, true, true, false],
            );
            let mut nodes = vec![centre];
            nodes.extend(&row);
            spec.members.push(between(&nodes, Kind::Diaphragm));
            let inertia = figures(mass * width * depth * 0.2);
            spec.members
                .push(between(&[centre], Kind::Mass(figures(2.0 * mass), [0.0, 0.0, inertia])));
            // Gravity and vertical motion need mass at the columns too.
            for n in &row {
                spec.members.push(between(&[*n], Kind::Mass(figures(0.1 * mass), [0.0; 3])));
            }
        } else {
            for n in &row {
                let m = figures(mass * rng.log(0.3, 1.0));
                spec.members.push(between(&[*n], Kind::Mass(m, [0.0; 3])));
            }
        }
        tops.extend(&row);
        below = row;
    }
    extras(&mut spec, rng, s, &braces, &tops);
    spec
}

/// A beam of many parts, with links along it.
pub fn long(rng: &mut Rng) -> Spec {
    let mut spec = Spec { family: "long beam", plane: true, ..Spec::default() };
    let (s, mass) = size(rng);
    // 300 equations are between 99 and 101 parts.
    let parts = if rng.chance(0.3) { rng.whole(99, 115) } else { rng.whole(15, 60) };
    let l = rng.log(5.0, 20.0);
    let step = l / parts as f64;
    let pinned = rng.chance(0.5);
    // The lowest frequency of the beam is that of the size.
    let root: f64 = if pinned { std::f64::consts::PI } else { 1.8751 };
    let ei = mass / l * s.w * s.w * (l / root).powi(4);
    let mut beam = section(rng, 1.0, step, 1.0);
    beam.i3 = figures(ei / beam.young);
    beam.i2 = beam.i3;
    beam.torsion = beam.i3;
    beam.area = figures(beam.i3 * 12.0 / (l / 20.0_f64).powi(2));
    beam.density = figures(mass / (beam.area * l));
    if rng.chance(0.2) {
        beam.density = 0.0;
    }
    let ends = if pinned { [true, false, true, false, false, false] } else { HELD };
    let mut all = vec![node(&mut spec, [0.0; 3], ends)];
    for i in 1..=parts {
        let far = i == parts && pinned;
        let fixed = if far { [false, false, true, false, false, false] } else { FREE };
        let n = node(&mut spec, [step * i as f64, 0.0, 0.0], fixed);
        spec.members.push(between(&[n - 1, n], Kind::Beam(beam)));
        if beam.density == 0.0 && (i % 4 == 0 || (i == parts && !pinned)) {
            let m = figures(4.0 * mass / parts as f64);
            spec.members.push(between(&[n], Kind::Mass(m, [0.0; 3])));
        }
        all.push(n);
    }
    let stiff = Size { k: figures(mass * s.w * s.w), ..s };
    for _ in 0..rng.whole(1, 3) {
        let n = rng.pick(&all[1..parts]);
        let law = law(rng, stiff, false);
        if matches!(law, Law::Linear(..)) {
            continue;
        }
        spec.members.push(along(&[n], UP, Kind::Link(law, 0)));
    }
    if rng.chance(0.3) {
        let n = rng.pick(&all[1..parts]);
        let kn = figures(stiff.k * 10.0);
        let c = Contact {
            kn,
            opening: figures(0.3 * s.u),
            c: 0.0,
            pull: false,
            slow: 0.3,
            fast: 0.3,
            rate: 0.0,
            ks: kn,
        };
        spec.members.push(along(&[n], UP, Kind::Link(Law::Contact(c), 0)));
    }
    spec
}
