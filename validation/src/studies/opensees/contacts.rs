//! Contacts and dampers.

use super::bearings::motions;
use super::pair::{Agree, Ours, Pair, command, link, material};
use super::paths::Wave::{self, About, Held, Irregular};
use serde_json::{Value, json};

/// A material of OpenSees in two motions.
fn twice(name: &str, (kind, numbers): (&str, &[f64]), ours: &[Ours], amplitude: f64) -> [Pair; 2] {
    Pair::twice(name, &[material(kind, numbers)], ours, amplitude)
}

fn contacts() -> Vec<Pair> {
    let mut all = Vec::new();
    let gap = |opening: &str| link("Gap", &[("k", "2e6"), ("opening", opening)]);
    all.extend(twice("ENT", ("ENT", &[2e6]), &[gap("0")], 0.05));
    let elastic: (&str, &[f64]) = ("ElasticPPGap", &[2e6, -1e9, -0.01]);
    all.extend(twice("ElasticPPGap below Fy", elastic, &[gap("0.01")], 0.05));
    let hook = link("Hook", &[("k", "2e6"), ("opening", "0.03")]);
    all.extend(twice("HookGap", ("HookGap", &[2e6, -0.02, 0.03]), &[gap("0.02"), hook], 0.05));
    let kelvin = link(
        "ImpactKelvin",
        &[
            ("k", "1e8"),
            ("restitution", "none"),
            ("impact_mass", "none"),
            ("damping", "8e5"),
            ("pull", "true"),
            ("opening", "0.02"),
        ],
    );
    all.extend(twice("ViscoelasticGap", ("ViscoelasticGap", &[1e8, 8e5, -0.02]), &[kelvin], 0.05));
    let hertz = link(
        "ImpactHertz",
        &[("k", "1e9"), ("restitution", "none"), ("xi", "0.6"), ("opening", "0.02")],
    );
    let theirs: (&str, &[f64]) = ("Hertzdamp", &[1e9, 0.6, -0.02, 1.5]);
    let why = "the speed of an impact is that at the end of the step that closes the gap there";
    let pairs = twice("Hertzdamp", theirs, &[hertz], 0.05);
    all.extend(pairs.map(|p| p.finer(20).agreeing(Agree::Stepped(why))));
    let jankowski = link(
        "ImpactHertz",
        &[
            ("model", "Jankowski"),
            ("k", "1e9"),
            ("restitution", "none"),
            ("xi", "0.4"),
            ("impact_mass", "5e4"),
            ("opening", "0.02"),
        ],
    );
    let theirs: (&str, &[f64]) = ("JankowskiImpact", &[1e9, 0.4, 5e4, -0.02, 1.5]);
    all.extend(twice("JankowskiImpact", theirs, &[jankowski], 0.05));
    all
}

/// Less than stretches `ks` to the friction, 0.3 · 1 MN, m.
const STUCK: f64 = 2e-3;

/// Contacts with friction: one that closes and opens, and ones that stay closed and stick. Where they slip, the
/// friction there falls to nothing and builds up anew.
fn with_friction() -> Vec<Pair> {
    let ours = link("NLink", &[("kn", "1e9"), ("ks", "1e8"), ("mu", "0.3")]);
    let (numbers, cohesion, normal) = ([1e9, 1e8, 0.3], 0.0, 3);
    // The constrained node, which is the moved one, comes first.
    let mut space = command("element", "zeroLengthContact3D", &[1, 2, 1], &numbers);
    space.extend([json!(cohesion), json!(normal)]);
    let mut plane = command("element", "zeroLengthContact2D", &[1, 2, 1], &numbers);
    plane.extend([json!("-normal"), json!(0.0), json!(1.0)]);
    let led = |name: &str, theirs: &[Value], waves: &[Wave], directions: &[u8], freedoms| {
        let three = [Held(0.0); 3];
        let pair = Pair::bearing(name, theirs.to_vec(), ours.clone(), three);
        Pair { waves: waves.to_vec(), directions: directions.to_vec(), freedoms, ..pair }
    };
    let (space, plane) = ([space.into()], [plane.into()]);
    let pressed = Held(-1e-3);
    let both = [pressed, Irregular(STUCK)];
    let mut all = vec![
        led("zeroLengthContact3D, normal force", &space, &[About(-5e-4, 1e-3, 1.3)], &[3], 3),
        led("zeroLengthContact2D, normal force", &plane, &[About(-5e-4, 1e-3, 1.3)], &[2], 2),
        led("zeroLengthContact2D that sticks", &plane, &both, &[2, 1], 2),
    ];
    for (motion, [a, b]) in motions(STUCK) {
        let name = format!("zeroLengthContact3D that sticks, {motion}");
        all.push(led(&name, &space, &[pressed, a, b], &[3, 1, 2], 3));
    }
    all
}

/// With what the steps of a damper in series leave: a quarter with half the step.
fn stepped(pair: Pair) -> Pair {
    pair.agreeing(Agree::Stepped("steps of second order there, of 1 ms"))
}

fn viscous() -> Vec<Pair> {
    let mut all = Vec::new();
    for alpha in [0.3, 0.5, 1.0, 1.5] {
        let a = alpha.to_string();
        let ours = link("Dashpot", &[("c", "1e4"), ("exponent", &a), ("linear_below", "1e-9")]);
        let name = format!("Viscous, α = {alpha}, irregular");
        let theirs = vec![material("Viscous", &[1e4, alpha])];
        all.push(Pair::material(&name, theirs, vec![ours], Irregular(0.05)));
    }
    for alpha in [0.3, 0.5, 1.0] {
        let a = alpha.to_string();
        let ours = link("MaxwellDamper", &[("k", "1e7"), ("c", "1e5"), ("exponent", &a)]);
        let name = format!("ViscousDamper, α = {alpha}");
        let theirs: (&str, &[f64]) = ("ViscousDamper", &[1e7, 1e5, alpha]);
        all.extend(twice(&name, theirs, &[ours], 0.05).map(stepped));
    }
    let ours = link("MaxwellDamper", &[("k", "1e7"), ("c", "1e6"), ("exponent", "1")]);
    let theirs: (&str, &[f64]) = ("Maxwell", &[1e7, 1e6, 1.0, 1.0]);
    all.extend(twice("Maxwell, α = 1", theirs, &[ours], 0.05).map(stepped));
    // Linear whatever α is: C/L^α is what α does.
    let c = (1e6 / 2_f64.sqrt()).to_string();
    let ours = link("MaxwellDamper", &[("k", "1e7"), ("c", &c), ("exponent", "1")]);
    let theirs: (&str, &[f64]) = ("Maxwell", &[1e7, 1e6, 0.5, 2.0]);
    all.extend(twice("Maxwell, α = 0.5, L = 2 m", theirs, &[ours], 0.05).map(stepped));
    for p in [0.0, 0.2] {
        let cy = (p * 1e6).to_string();
        let ours =
            link("BilinearDamper", &[("k", "1e7"), ("c", "1e6"), ("cy", &cy), ("fl", "6e4")]);
        let name = format!("BilinearOilDamper, p = {p}");
        let theirs: (&str, &[f64]) = ("BilinearOilDamper", &[1e7, 1e6, 6e4, p]);
        all.extend(twice(&name, theirs, &[ours], 0.05).map(stepped));
    }
    all
}

pub(super) fn pairs() -> Vec<Pair> {
    let mut all = contacts();
    all.extend(with_friction());
    all.extend(viscous());
    all
}
