use super::*;
use crate::shared::parameters::read;
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Energy, Kinematics, Link, Response, Value};

const KN: f64 = 1e6;

fn list(points: &[Vector3]) -> Value {
    let one = |p: &Vector3| Value::List(p.iter().map(|x| Value::Number(*x)).collect());
    Value::List(points.iter().map(one).collect())
}

fn body(base: &[Vector3], more: &[(&str, Value)]) -> Result<RockingBody, ParameterError> {
    let mut all = vec![("base", list(base)), ("kn", Value::Number(KN))];
    all.extend(more.iter().cloned());
    read(&all)
}

const BLOCK: [Vector3; 2] = [[-0.5, 0.0, -1.0], [0.5, 0.0, -1.0]];
const TABLE: [Vector3; 4] =
    [[-0.5, -0.3, -1.0], [0.5, -0.3, -1.0], [0.5, 0.3, -1.0], [-0.5, 0.3, -1.0]];

fn number(name: &'static str, x: f64) -> (&'static str, Value) {
    (name, Value::Number(x))
}

fn inertia() -> (&'static str, Value) {
    ("inertia", Value::List([300.0, 400.0, 150.0].map(Value::Number).to_vec()))
}

/// Force on the node at a deformation, from rest.
fn force(law: &RockingBody, d: [f64; 6], v: [f64; 6]) -> ([f64; 6], Energy) {
    let mut history = vec![0.0; law.history().len()];
    law.at_rest(&mut history);
    let (mut f, mut k, mut c, mut trial) = ([0.0; 6], [0.0; 36], [0.0; 36], history.clone());
    let mut energy = Energy::default();
    let mut out = Response::new(&mut f, &mut k, &mut c, &mut energy);
    let at = Kinematics::still(&d, &v);
    law.respond(&at, &history, &mut trial, &mut out);
    (f, energy)
}

#[test]
fn conforms_in_a_plane_and_in_space() {
    let friction = [number("mu", 0.4), number("ks", 0.7 * KN), number("damping", 2e3)];
    let plane = [0.05, 0.02, 0.05, 0.02, 0.3, 0.02];
    Kit::new(&plane, 0.5).assert(&body(&BLOCK, &friction).unwrap());
    Kit::new(&plane, 0.5).assert(&body(&BLOCK, &[]).unwrap());
    let mut space = friction.to_vec();
    space.push(inertia());
    let all = [0.05, 0.05, 0.05, 0.3, 0.3, 0.3];
    Kit::new(&all, 0.5).assert(&body(&TABLE, &space).unwrap());
    space.push(("pull", Value::Flag(true)));
    Kit::new(&all, 0.5).assert(&body(&TABLE, &space).unwrap());
}

/// Tilted about its right corner by θ, the block of half width b and half height h under its weight W is
/// held by the moment W R sin(α − θ) about the corner.
#[test]
fn the_restoring_moment_falls_with_the_tilt() {
    let law = body(&BLOCK, &[number("mu", 5.0), number("ks", KN)]).unwrap();
    let (b, h) = (0.5_f64, 1.0_f64);
    let (alpha, radius) = (b.atan2(h), b.hypot(h));
    let weight: f64 = 1e3;
    for theta in [0.01, 0.2, alpha, 1.0] {
        // Positive about Y is over +X: the centre of gravity goes round the right corner.
        let (x, z) = (b - radius * (alpha - theta).sin(), radius * (alpha - theta).cos() - h);
        let (f, energy) = force(&law, [x, 0.0, z - weight / KN, 0.0, theta, 0.0], [0.0; 6]);
        assert_relative_eq!(f[2], -weight, max_relative = 1e-9);
        assert_relative_eq!(f[0], 0.0, epsilon = 1e-8 * weight);
        let restoring = weight * radius * (alpha - theta).sin();
        assert_relative_eq!(f[4], restoring, epsilon = 1e-9 * weight);
        assert_relative_eq!(energy.stored, 0.5 * weight * weight / KN, max_relative = 1e-9);
    }
}

#[test]
fn small_rotations_are_those_of_plain_contacts() {
    let more = [number("mu", 0.6), number("ks", 0.5 * KN)];
    let law = body(&BLOCK, &more).unwrap();
    let t = 1e-6;
    let d = [2e-6, 0.0, -3e-6, 0.0, t, 0.0];
    let (f, _) = force(&law, d, [0.0; 6]);
    let mut sum = [0.0; 3];
    for [x, _, z] in BLOCK {
        // u + θ × r
        let (dx, dz) = (d[0] + t * z, d[2] - t * x);
        let normal: f64 = KN * (-dz).max(0.0);
        let shear = (0.5 * KN * dx).clamp(-0.6 * normal, 0.6 * normal);
        sum[0] += shear;
        sum[1] -= normal;
        sum[2] += z * shear + x * normal;
    }
    for (given, plain) in [f[0], f[2], f[4]].iter().zip(sum) {
        assert_relative_eq!(*given, plain, epsilon = 1e-5);
    }
}

#[test]
fn spinning_freely_it_keeps_its_energy_and_feels_its_gyroscopic_moment() {
    let law = body(&TABLE, &[inertia()]).unwrap();
    let (f, _) = force(&law, [0.0, 0.0, 5.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0, 2.0, 3.0]);
    // Ω × J Ω, by components.
    let moment = [(150.0 - 400.0) * 6.0, (300.0 - 150.0) * 3.0, (400.0 - 300.0) * 2.0];
    assert_eq!(f, [0.0, 0.0, 0.0, moment[0], moment[1], moment[2]]);
    assert_eq!(moment[0] + 2.0 * moment[1] + 3.0 * moment[2], 0.0);
}

fn cask(more: &[(&str, Value)]) -> Result<RockingBody, ParameterError> {
    let mut all =
        vec![number("rim_radius", 0.5), number("rim_depth", 1.0), number("kn", KN), inertia()];
    all.extend(more.iter().cloned());
    read(&all)
}

#[test]
fn conforms_on_a_rim() {
    let friction = [number("mu", 0.4), number("ks", 0.7 * KN)];
    let all = [0.05, 0.05, 0.05, 0.3, 0.3, 0.3];
    Kit::new(&all, 0.5).assert(&cask(&[]).unwrap());
    Kit::new(&all, 0.5).assert(&cask(&friction).unwrap());
    let dashpots = [number("damping", 2e3), ("pull", Value::Flag(true))];
    Kit::new(&all, 0.5).assert(&cask(&dashpots).unwrap());
    Kit::new(&all, 0.5).assert(&cask(&[&friction[..], &dashpots].concat()).unwrap());
    let arc = [number("arc_stiffness", 3.0 * KN)];
    Kit::new(&all, 0.5).assert(&cask(&[&friction[..], &arc].concat()).unwrap());
}

#[test]
fn its_uplift_is_the_largest_gap_of_its_contacts() {
    let raised = [[-0.5, 0.0, -1.0], [0.5, 0.0, -0.9]];
    let laws =
        [body(&TABLE, &[inertia()]).unwrap(), body(&raised, &[]).unwrap(), cask(&[]).unwrap()];
    for law in laws {
        let index = law.history().iter().position(|field| field.name == "uplift").unwrap();
        for (z, x, y) in [(0.0, 0.0, 0.0), (-0.01, 0.0, 0.02), (0.05, 0.1, -0.2), (0.4, 0.0, 0.0)] {
            let mut history = vec![0.0; law.history().len()];
            law.at_rest(&mut history);
            let mut trial = history.clone();
            let (d, v) = ([0.02, 0.01, z, x, y, 0.0], [0.0; 6]);
            let (mut f, mut k, mut c) = ([0.0; 6], [0.0; 36], [0.0; 36]);
            let mut energy = Energy::default();
            let mut out = Response::new(&mut f, &mut k, &mut c, &mut energy);
            let at = Kinematics::still(&d, &v);
            law.respond(&at, &history, &mut trial, &mut out);
            let mut contacts = Vec::new();
            law.contacts(&at, &trial, &f, &mut contacts);
            let highest = contacts.iter().map(|c| c.gap).fold(f64::NEG_INFINITY, f64::max);
            assert_relative_eq!(trial[index], highest, epsilon = 1e-12);
            if [z, x, y] == [0.0; 3] {
                assert_relative_eq!(history[index], highest, epsilon = 1e-12);
            }
        }
    }
}

/// Many base points on the circle share its stiffness: their sum is the rim's integral.
#[test]
fn a_rim_is_a_circle_of_points() {
    let count = 20_000;
    let ring: Vec<Vector3> = (0..count)
        .map(|i| std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(count))
        .map(|chi| [0.5 * chi.cos(), 0.5 * chi.sin(), -1.0])
        .collect();
    let share = 1.0 / f64::from(count);
    let parts = |damping: f64| {
        let more = [
            ("kn", Value::Number(KN * share)),
            ("base", list(&ring)),
            number("damping", damping * share),
            ("pull", Value::Flag(true)),
            inertia(),
        ];
        read::<RockingBody>(&more).unwrap()
    };
    let whole =
        |damping: f64| cask(&[number("damping", damping), ("pull", Value::Flag(true))]).unwrap();
    let v = [0.1, -0.2, 0.3, 0.2, -0.1, 0.4];
    for (z, x, y) in
        [(-0.01, 0.001, 0.002), (-0.01, 0.03, -0.05), (0.12, 0.2, -0.3), (0.4, 0.1, 0.1)]
    {
        for damping in [0.0, 1e4] {
            let d = [0.02, 0.01, z, x, y, 0.3];
            let (a, ea) = force(&parts(damping), d, v);
            let (b, eb) = force(&whole(damping), d, v);
            for i in 0..6 {
                assert_relative_eq!(a[i], b[i], epsilon = 0.1, max_relative = 1e-3);
            }
            assert_relative_eq!(ea.stored, eb.stored, epsilon = 1e-3, max_relative = 1e-3);
        }
    }
}

/// Moment about the vertical through the centre of pressure of a body that is tilted by `tilt` about Y, pressed on an
/// arc of half angle `half`, and turned there about the vertical far enough that everything slips; over μ N ρ.
fn drilling(law: &RockingBody, tilt: f64, half: f64) -> f64 {
    let (rho, h, mu) = (0.5, 1.0, law.mu);
    let b = rho * tilt.sin();
    let z = b * half.cos() - h * (1.0 - tilt.cos());
    // ∫ (cos ψ − cos ψ꜀) cos ψ dψ / ∫ (cos ψ − cos ψ꜀) dψ
    let first = 0.5 * (half + half.sin() * half.cos()) - half.cos() * half.sin();
    let centre = rho * first / (half.sin() - half * half.cos());
    // From the centre of gravity, global.
    let arm = [centre * tilt.cos() - h * tilt.sin(), -centre * tilt.sin() - h * tilt.cos()];
    let mut driver = Driver::new(law);
    driver.to(&[0.0, 0.0, z, 0.0, tilt, 0.0]);
    let turn = 2e-3;
    let (sin, cos) = f64::sin_cos(turn);
    // The vertical in the axes of the body, about which it turns.
    let axis = [-tilt.sin(), 0.0, tilt.cos()];
    let d = [
        arm[0] * (1.0 - cos),
        -arm[0] * sin,
        z,
        turn * axis[0],
        tilt + turn * axis[1],
        turn * axis[2],
    ];
    let f = driver.to(&d).to_vec();
    // The vertical has not changed in the axes of the body; the arm has turned.
    let moment = axis[0] * f[3] + axis[1] * f[4] + axis[2] * f[5];
    let force = arm[0] * cos * f[1] - arm[0] * sin * f[0];
    (moment - force) / (mu * -f[2] * rho)
}

/// Many points on the circle slip each for itself. With the arc over π instead of the mean distance of what presses
/// the moment of a short arc is 15 % too small.
#[test]
fn a_rim_drills_as_a_circle_of_points_does() {
    let count = 20_000;
    let ring: Vec<Vector3> = (0..count)
        .map(|i| std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(count))
        .map(|chi| [0.5 * chi.cos(), 0.5 * chi.sin(), -1.0])
        .collect();
    let share = 1.0 / f64::from(count);
    let parts = read::<RockingBody>(&[
        ("kn", Value::Number(KN * share)),
        ("base", list(&ring)),
        number("mu", 0.8),
        number("ks", 1e5 * KN * share),
        inertia(),
    ])
    .unwrap();
    let whole = cask(&[number("mu", 0.8), number("ks", 1e5 * KN)]).unwrap();
    for (tilt, half) in [(0.3, 0.1), (0.1, 0.3), (0.05, 1.0), (0.01, 2.5)] {
        let (a, b) = (drilling(&parts, tilt, half), drilling(&whole, tilt, half));
        assert_relative_eq!(a, b, max_relative = 1e-2);
    }
    assert_relative_eq!(drilling(&whole, 0.3, 0.1), 0.0375, max_relative = 1e-2);
}

/// With a stiffness of its own the arc of drilling stays where that of the contact changes: 3/8 (3π N/(k ρ sin θ))^⅓.
#[test]
fn drilling_hangs_on_the_stiffness_that_is_given_for_it() {
    let of = |kn: f64| {
        let more = [number("mu", 0.8), number("ks", 1e5 * KN), number("arc_stiffness", 3e7)];
        let mut all =
            vec![number("rim_radius", 0.5), number("rim_depth", 1.0), number("kn", kn), inertia()];
        all.extend(more);
        read::<RockingBody>(&all).unwrap()
    };
    let tilt: f64 = 0.2;
    for (kn, half) in [(1e6, 0.3_f64), (8e6, 0.15)] {
        let b = 0.5 * tilt.sin();
        let normal = kn / std::f64::consts::PI * b * (half.sin() - half * half.cos());
        let arc = (3.0 * std::f64::consts::PI * normal / (3e7 * b)).cbrt();
        assert_relative_eq!(drilling(&of(kn), tilt, half), 0.375 * arc, max_relative = 5e-3);
    }
}

#[test]
fn refuses_what_cannot_stand() {
    let parameter = |base: &[Vector3], more: &[(&str, Value)]| {
        body(base, more).unwrap_err().parameter().unwrap().to_owned()
    };
    assert_eq!(parameter(&BLOCK[..1], &[]), "base");
    assert_eq!(parameter(&[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]], &[]), "base");
    assert_eq!(parameter(&BLOCK, &[number("mu", 0.5)]), "ks");
    assert_eq!(parameter(&TABLE, &[]), "inertia");
    assert_eq!(parameter(&BLOCK, &[number("arc_stiffness", 1e6)]), "arc_stiffness");
    let rim = |more: &[(&str, Value)]| cask(more).unwrap_err().parameter().unwrap().to_owned();
    assert_eq!(rim(&[("base", list(&TABLE))]), "base");
    assert_eq!(rim(&[number("damping", 1.0)]), "pull");
    assert_eq!(rim(&[number("mu", 0.1)]), "ks");
}

/// Where the body is drawn: as a block about its centre of gravity, turned exactly however far.
#[test]
fn is_drawn_where_it_is() {
    let at = |law: &RockingBody, d: [f64; 6]| {
        let mut history = vec![0.0; law.history().len()];
        law.at_rest(&mut history);
        let still = [0.0; 6];
        let at = Kinematics::still(&d, &still);
        law.outline(&at, &history).unwrap()
    };
    let block = body(&BLOCK, &[]).unwrap();
    let rest = at(&block, [0.0; 6]);
    let mut corners = rest.points.clone();
    corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(corners, [[-0.5, 0.0, -1.0], [-0.5, 0.0, 1.0], [0.5, 0.0, -1.0], [0.5, 0.0, 1.0]]);
    // On its side, a quarter turn about Y: (x, z) goes to (z, −x).
    let fallen = at(&block, [0.3, 0.0, -0.4, 0.0, FRAC_PI_2, 0.0]);
    for (p, q) in rest.points.iter().zip(&fallen.points) {
        assert_relative_eq!(q[0], p[2] + 0.3, epsilon = 1e-12);
        assert_relative_eq!(q[2], -p[0] - 0.4, epsilon = 1e-12);
    }
    let table = at(&body(&TABLE, &[inertia()]).unwrap(), [0.0; 6]);
    assert_eq!((table.points.len(), table.paths.len()), (8, 6));
    let cask = at(&cask(&[]).unwrap(), [0.0; 6]);
    assert!(cask.points.iter().all(|p| p[2].abs() == cask.points[0][2].abs()));
}

/// The body at a place above a node that it stands on.
fn on_a_node(mut law: RockingBody, above: Vector3) -> RockingBody {
    let nodes = [[1.0, 2.0, 3.0], [1.0 + above[0], 2.0 + above[1], 3.0 + above[2]]];
    let frame = trilith_element::Frame::of_nodes(&nodes, None, None).unwrap();
    law.place(&trilith_element::Geometry::new(&nodes, frame)).unwrap();
    law
}

const ABOVE: Vector3 = [0.2, -0.1, 1.3];

/// On plane feet and on a rim, with friction, with and without dashpots.
fn on_nodes() -> Vec<RockingBody> {
    let friction = [number("mu", 0.4), number("ks", 0.7 * KN)];
    let dashpots = [number("damping", 2e3), ("pull", Value::Flag(true)), inertia()];
    let all = [&friction[..], &dashpots].concat();
    [
        body(&TABLE, &[&friction[..], &[inertia()]].concat()),
        body(&TABLE, &all),
        cask(&friction),
        cask(&all[..4]),
    ]
    .map(|law| on_a_node(law.unwrap(), ABOVE))
    .to_vec()
}

#[test]
fn conforms_on_another_body() {
    let small = [0.05, 0.05, 0.05, 0.2, 0.2, 0.2];
    let all = [small, small].concat();
    for law in on_nodes() {
        assert_eq!(law.coordinates().len(), 12);
        Kit::new(&all, 0.5).assert(&law);
    }
}

/// A random motion of both nodes; what the law says at its end.
fn led(law: &RockingBody, motion: &[[f64; 12]]) -> ([f64; 12], Vec<f64>) {
    let mut driver = Driver::new(law);
    let mut f = [0.0; 12];
    for d in motion {
        f.copy_from_slice(driver.to(d));
    }
    (f, driver.history.clone())
}

fn waves(seed: f64) -> Vec<[f64; 12]> {
    let at = |k: usize| {
        let t = 0.07 * k as f64;
        std::array::from_fn(|i| {
            let size = if i % 6 < 3 { 0.02 } else { 0.3 };
            let x = size * (t * (1.0 + 0.3 * i as f64) + seed * i as f64).sin();
            // Pressed, mostly.
            if i == 8 { x - 0.02 } else { x - size * (seed * i as f64).sin() }
        })
    };
    (1..40).map(at).collect()
}

/// Forces cancel, and so do their moments about any point.
#[test]
fn two_bodies_keep_their_momentum() {
    for law in on_nodes() {
        let plain = RockingBody { inertia: None, ..law };
        for seed in [0.3, 1.1, 2.4] {
            let motion = waves(seed);
            let (f, history) = led(&plain, &motion);
            let (offset, turned) = plain.both(&history).unwrap();
            let end = motion.last().unwrap();
            let turns = [turned[0].turn(&end[3..6]), turned[1].turn(&end[9..12])];
            let vector = |x: &[f64]| nalgebra::Vector3::new(x[0], x[1], x[2]);
            let (f1, f2) = (vector(&f[..3]), vector(&f[6..9]));
            let (m1, m2) = (turns[0].matrix * vector(&f[3..6]), turns[1].matrix * vector(&f[9..]));
            let lever = offset + vector(&end[6..9]) - vector(&end[..3]);
            let size = f2.norm();
            assert!(size > 1e3, "{seed}: {f:?}");
            assert_relative_eq!(f1, -f2, epsilon = 1e-12 * size);
            let moment = m1 + m2 + lever.cross(&f2);
            assert!(moment.norm() < 1e-11 * size, "{seed}: {moment}");
        }
    }
}

/// Seen from a node that moves and turns, the body does what it does on the ground: its forces come along.
#[test]
fn on_a_node_it_is_the_body_on_the_ground_as_that_node_sees_it() {
    use nalgebra::{UnitQuaternion, Vector3};
    let friction = [number("mu", 0.4), number("ks", 0.7 * KN)];
    let table = [&friction[..], &[inertia()]].concat();
    for law in [body(&TABLE, &table).unwrap(), cask(&friction).unwrap()] {
        let law = RockingBody { inertia: None, ..law };
        let two = on_a_node(law.clone(), ABOVE);
        let (mut ground, mut moving) = (Driver::new(&law), Driver::new(&two));
        // Turns of the body on the ground, and of both nodes, with their integrals.
        let mut alone = UnitQuaternion::identity();
        let mut both = [UnitQuaternion::<f64>::identity(); 2];
        let (mut before, mut d) = ([0.0; 6], [0.0; 12]);
        for (k, full) in waves(0.7).iter().enumerate() {
            let own: [f64; 6] = full[6..].try_into().unwrap();
            let on_ground = ground.to(&own).to_vec();
            let t = (k + 1) as f64;
            let by: [f64; 3] = std::array::from_fn(|i| own[3 + i] - before[3 + i]);
            alone *= UnitQuaternion::from_scaled_axis(Vector3::from(by));
            before = own;
            let carried = UnitQuaternion::from_scaled_axis(0.05 * t * Vector3::new(0.5, -0.3, 0.8));
            let way = Vector3::new(0.3, -0.1, 0.2) * (0.1 * t).sin();
            for (i, q) in [carried, carried * alone].into_iter().enumerate() {
                let by = (both[i].inverse() * q).scaled_axis();
                (0..3).for_each(|j| d[6 * i + 3 + j] += by[j]);
                both[i] = q;
            }
            let offset = Vector3::from(ABOVE);
            let place = way + carried * (offset + Vector3::new(own[0], own[1], own[2])) - offset;
            d[..3].copy_from_slice(way.as_slice());
            d[6..9].copy_from_slice(place.as_slice());
            let f = moving.to(&d).to_vec();
            let wanted = carried * Vector3::new(on_ground[0], on_ground[1], on_ground[2]);
            let size = wanted.norm().max(1.0);
            for i in 0..3 {
                assert_relative_eq!(f[6 + i], wanted[i], epsilon = 1e-8 * size);
                assert_relative_eq!(f[9 + i], on_ground[3 + i], epsilon = 1e-8 * size);
            }
        }
    }
}
