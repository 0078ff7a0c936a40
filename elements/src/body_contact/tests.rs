use super::*;
use crate::shared::parameters::read;
use approx::assert_relative_eq;
use nalgebra::{UnitQuaternion, Vector3 as V};
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Geometry, History, Link, Value};

const KN: f64 = 1e6;
const OFFSET: Vector3 = [0.8, 0.3, 0.1];

fn number(name: &'static str, x: f64) -> (&'static str, Value) {
    (name, Value::Number(x))
}

fn numbers(name: &'static str, x: &[f64]) -> (&'static str, Value) {
    (name, Value::List(x.iter().map(|x| Value::Number(*x)).collect()))
}

fn points(all: &[Vector3]) -> (&'static str, Value) {
    let one = |p: &Vector3| Value::List(p.iter().map(|x| Value::Number(*x)).collect());
    ("points", Value::List(all.iter().map(one).collect()))
}

fn placed(values: &[(&str, Value)], offset: Vector3) -> Result<BodyContact, ParameterError> {
    let mut law: BodyContact = read(values)?;
    let nodes = [[4.0, 5.0, 6.0], [4.0 + offset[0], 5.0 + offset[1], 6.0 + offset[2]]];
    let frame = Frame::of_nodes(&nodes, None, None).unwrap();
    law.place(&Geometry::new(&nodes, frame))?;
    Ok(law)
}

fn rubbing() -> Vec<(&'static str, Value)> {
    vec![number("kn", KN), number("mu", 0.4), number("ks", 0.7 * KN)]
}

/// Corners of the second on a slanting face of the first.
fn on_a_face(more: &[(&str, Value)]) -> BodyContact {
    let corners = [[-0.3, 0.1, 0.2], [-0.2, -0.2, -0.1]];
    let face = [numbers("face", &[0.4, 0.3, 0.1]), numbers("normal", &[0.9, 0.2, -0.1])];
    let mut all = rubbing();
    all.extend(more.iter().cloned());
    all.extend(face);
    all.push(points(&corners));
    placed(&all, OFFSET).unwrap()
}

fn side_by_side(more: &[(&str, Value)]) -> BodyContact {
    let mut all = rubbing();
    all.extend(more.iter().cloned());
    all.extend([numbers("radii", &[0.5, 0.3]), numbers("heights", &[-0.6, 0.1, 0.7])]);
    placed(&all, OFFSET).unwrap()
}

fn kinds() -> Vec<BodyContact> {
    let dashpots = [number("damping", 2e3)];
    vec![on_a_face(&[]), on_a_face(&dashpots), side_by_side(&[]), side_by_side(&dashpots)]
}

#[test]
fn conforms() {
    let all = [0.05, 0.05, 0.05, 0.1, 0.1, 0.1, 0.05, 0.05, 0.05, 0.1, 0.1, 0.1];
    for law in kinds() {
        Kit::new(&all, 0.5).assert(&law);
    }
    // With an edge forces jump where a point slips over it: nothing goes so far here.
    Kit::new(&all, 0.5).assert(&on_a_face(&[numbers("extent", &[9.0, 9.0])]));
}

/// Motions of both nodes that press them together.
fn waves(seed: f64) -> Vec<[f64; 12]> {
    let at = |k: usize| {
        let t = 0.07 * k as f64;
        std::array::from_fn(|i| {
            let size = if i % 6 < 3 { 0.02 } else { 0.2 };
            let phase = seed * i as f64;
            let x = size * ((t * (1.0 + 0.3 * i as f64) + phase).sin() - phase.sin());
            if i == 6 { x - 0.004 * k as f64 } else { x }
        })
    };
    (1..40).map(at).collect()
}

/// Forces cancel, and so do their moments about any point.
#[test]
fn both_bodies_together_keep_their_momentum() {
    for law in kinds() {
        for seed in [0.3, 1.1, 2.4] {
            let mut driver = Driver::new(&law);
            let motion = waves(seed);
            let mut f = [0.0; 12];
            motion.iter().for_each(|d| f.copy_from_slice(driver.to(d)));
            let end = motion.last().unwrap();
            let turned = |i: usize| {
                let own = &driver.history[1 + i * crate::shared::rotation::Turned::FIELDS.len()..];
                crate::shared::rotation::Turned::load(own).turn(&end[6 * i + 3..6 * i + 6]).matrix
            };
            let vector = |x: &[f64]| V::new(x[0], x[1], x[2]);
            let (f1, f2) = (vector(&f[..3]), vector(&f[6..9]));
            let (m1, m2) = (turned(0) * vector(&f[3..6]), turned(1) * vector(&f[9..]));
            let lever = V::from(OFFSET) + vector(&end[6..9]) - vector(&end[..3]);
            let size = f2.norm();
            assert!(size > 1e3, "{seed}: {f:?}");
            assert_relative_eq!(f1, -f2, epsilon = 1e-12 * size);
            let moment = m1 + m2 + lever.cross(&f2);
            assert!(moment.norm() < 1e-11 * size, "{seed}: {moment}");
        }
    }
}

/// Without friction the force on each point is the stiffness times how far it is behind the face, wherever both are.
#[test]
fn a_point_feels_how_far_it_is_behind_the_face() {
    let corner = [-0.4, 0.1, 0.0];
    let all = [
        number("kn", KN),
        points(&[corner]),
        numbers("face", &[0.4, 0.0, 0.0]),
        numbers("normal", &[1.0, 0.0, 0.0]),
    ];
    let law = placed(&all, OFFSET).unwrap();
    let mut driver = Driver::new(&law);
    for k in 1..30 {
        let t = 0.1 * f64::from(k);
        // Turned about fixed axes, where integrals are angles.
        let (a, b) = (0.4 * (0.7 * t).sin(), 0.5 * (0.9 * t).sin());
        let (u1, u2) = (V::new(0.1 * t.sin(), 0.02, 0.0), V::new(-0.1 * t, 0.0, 0.05 * t));
        let d = [u1[0], u1[1], u1[2], 0.0, 0.0, a, u2[0], u2[1], u2[2], 0.0, b, 0.0];
        let f = driver.to(&d).to_vec();
        let r1 = UnitQuaternion::from_scaled_axis(V::new(0.0, 0.0, a));
        let r2 = UnitQuaternion::from_scaled_axis(V::new(0.0, b, 0.0));
        let point = V::from(OFFSET) + u2 + r2 * V::from(corner);
        let (face, normal) = (u1 + r1 * V::new(0.4, 0.0, 0.0), r1 * V::new(1.0, 0.0, 0.0));
        let depth = (-normal.dot(&(point - face))).max(0.0);
        let wanted = -KN * depth * normal;
        for i in 0..3 {
            assert_relative_eq!(f[6 + i], wanted[i], epsilon = 1e-9 * KN);
        }
        assert_relative_eq!(driver.energy.stored, 0.5 * KN * depth * depth, epsilon = 1e-6);
        assert!(k < 5 || depth > 0.0, "{t}");
    }
}

/// A face of half widths 0.2 and 0.1 m, lying; the second's point above it.
fn on_a_table() -> BodyContact {
    let all = [
        number("kn", KN),
        number("mu", 0.5),
        number("ks", KN),
        points(&[[0.0, 0.0, -0.3]]),
        numbers("face", &[0.0, 0.0, 0.5]),
        numbers("extent", &[0.2, 0.1]),
    ];
    placed(&all, [0.0, 0.0, 0.8]).unwrap()
}

#[test]
fn a_point_beside_the_face_touches_nothing() {
    let law = on_a_table();
    let mut driver = Driver::new(&law);
    let mut to = |x: f64, y: f64, z: f64| {
        let mut d = [0.0; 12];
        d[6..9].copy_from_slice(&[x, y, z]);
        driver.to(&d)[8]
    };
    assert_relative_eq!(to(0.0, 0.0, -1e-3), -1e-3 * KN, max_relative = 1e-9);
    assert_relative_eq!(to(0.19, 0.0, -1e-3), -1e-3 * KN, max_relative = 1e-9);
    // Over the edge, and back under the face: it came from beside.
    assert_eq!(to(0.21, 0.0, -1e-3), 0.0);
    assert_eq!(to(0.1, 0.0, -0.2), 0.0);
    assert_eq!(to(0.1, 0.0, -1e-3), 0.0);
    // Up and down again.
    assert_eq!(to(0.1, 0.0, 1e-3), 0.0);
    assert_relative_eq!(to(0.1, 0.0, -1e-3), -1e-3 * KN, max_relative = 1e-9);
    // The other axis is shorter.
    assert_eq!(to(0.1, 0.11, -1e-3), 0.0);
}

/// What spring and friction held becomes heat where the point slips over the edge.
#[test]
fn nothing_is_lost_at_the_edge() {
    let law = on_a_table();
    let mut driver = Driver::new(&law);
    let mut before = 0.0;
    for x in [0.0, 1e-4, 0.199, 0.2001] {
        let mut d = [0.0; 12];
        d[6..9].copy_from_slice(&[x, 0.0, -1e-3]);
        before = driver.accounted();
        driver.to(&d);
    }
    assert_eq!(driver.energy.stored, 0.0);
    // In the last step the work of the friction alone is done, at most.
    let (normal, way) = (1e-3 * KN, 0.2001 - 0.199);
    let more = driver.accounted() - before;
    assert!((-1e-9..=0.5 * normal * way).contains(&more), "{more}");
}

/// One turns about its axis in contact with another that turns the other way, as wheels do: no slip, no force across.
/// They touch where the first is pressed in.
#[test]
fn round_bodies_roll_on_each_other() {
    let values = |mu: f64| {
        let mut all = vec![number("kn", KN), number("mu", mu), number("ks", KN)];
        all.extend([numbers("radii", &[0.5, 0.25]), numbers("heights", &[0.0])]);
        placed(&all, [0.75, 0.0, 0.0]).unwrap()
    };
    let law = values(0.5);
    let press = 1e-3;
    // Over a radian of the first.
    let rolled = |steps: u32| {
        let mut driver = Driver::new(&law);
        let mut f = Vec::new();
        for k in 0..=steps {
            let turn = f64::from(k) / f64::from(steps);
            let mut d = [0.0; 12];
            (d[5], d[6], d[11]) = (turn, -press, -(0.5 - press) / 0.25 * turn);
            f = driver.to(&d).to_vec();
        }
        assert_relative_eq!(f[6], -KN * press, max_relative = 1e-9);
        f[7].abs()
    };
    // A step takes a chord for an arc; a slip of a millimetre in the metre of its way would be seen.
    let (coarse, fine) = (rolled(200), rolled(400));
    assert!(coarse < 1e-4 * KN && fine < 0.3 * coarse, "{coarse} {fine}");
    // One that does not turn is rubbed with μ N, and turned by that.
    let mut driver = Driver::new(&law);
    let mut still = Vec::new();
    for k in 0..200 {
        let mut d = [0.0; 12];
        (d[5], d[6]) = (0.005 * f64::from(k), -press);
        still = driver.to(&d).to_vec();
    }
    assert_relative_eq!(still[7].abs(), 0.5 * KN * press, max_relative = 1e-9);
    assert_relative_eq!(still[11].abs(), 0.25 * 0.5 * KN * press, max_relative = 1e-9);
}

/// The force between two round bodies follows the distance of their axes at that height.
#[test]
fn round_bodies_feel_the_distance_of_their_axes() {
    let all = [number("kn", KN), numbers("radii", &[0.5, 0.3]), numbers("heights", &[0.6])];
    let law = placed(&all, [0.9, 0.0, 0.0]).unwrap();
    let mut driver = Driver::new(&law);
    // The second leans over by ϑ about Y towards the first.
    for theta in [0.0, -0.1, -0.2, -0.3] {
        let mut d = [0.0; 12];
        d[10] = theta;
        let f = driver.to(&d).to_vec();
        let gap = 0.9 + 0.6 * f64::sin(theta) - 0.8;
        assert_relative_eq!(f[6], KN * gap.min(0.0), epsilon = 1e-6);
        assert_relative_eq!(driver.history[0], gap, epsilon = 1e-12);
        // Moment about Y of a force along −X at 0.6 cos ϑ above the node.
        assert_relative_eq!(f[10], 0.6 * f64::cos(theta) * f[6], epsilon = 1e-6);
    }
}

#[test]
fn refuses_what_touches_nothing() {
    let parameter = |values: &[(&str, Value)], offset: Vector3| {
        let mut all = rubbing();
        all.extend(values.iter().cloned());
        placed(&all, offset).unwrap_err().parameter().unwrap().to_owned()
    };
    let point = points(&[[0.0, 0.0, -0.5]]);
    let face = numbers("face", &[0.0, 0.0, 0.5]);
    let (radii, heights) = (numbers("radii", &[0.5, 0.5]), numbers("heights", &[0.0]));
    let far = [0.0, 0.0, 1.0];
    assert_eq!(parameter(&[], far), "points");
    assert_eq!(parameter(std::slice::from_ref(&point), far), "face");
    assert_eq!(parameter(std::slice::from_ref(&radii), far), "heights");
    assert_eq!(parameter(std::slice::from_ref(&heights), far), "heights");
    assert_eq!(parameter(&[radii.clone(), heights.clone(), face.clone()], far), "points");
    let flat = numbers("normal", &[0.0; 3]);
    assert_eq!(parameter(&[point.clone(), face.clone(), flat], far), "normal");
    // Inside each other.
    assert_eq!(parameter(&[radii.clone(), heights.clone()], [0.9, 0.0, 0.0]), "radii");
    assert_eq!(parameter(&[point.clone(), face.clone()], [0.0, 0.0, 0.9]), "points");
    let all = [rubbing(), vec![radii, heights]].concat();
    assert!(placed(&all, [0.6, 0.8, 0.3]).is_ok(), "they touch");
    let all = [rubbing(), vec![point, face]].concat();
    assert!(placed(&all, far).is_ok(), "it touches");
}
