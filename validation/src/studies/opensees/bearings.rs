//! Bearings, led in their plane under an axial force.

use super::pair::{Agree, Ours, Pair, command, link};
use super::paths::Wave::{self, About, Ahead, Growing, Held, Irregular};
use serde_json::{Value, json};

/// Axial stiffness, N/m.
const AXIAL: f64 = 1e9;
/// The axial force is 1 MN.
const LOADED: Wave = Held(-1e-3);

/// An element behind its two materials: 1 along the axis, 2 for moments, which nothing turns.
fn element(kind: &str, before: Vec<Value>, numbers: &[f64]) -> Vec<Value> {
    let mut all = vec![
        json!(["uniaxialMaterial", "Elastic", 1, AXIAL]),
        json!(["uniaxialMaterial", "Elastic", 2, 1.0]),
    ];
    let friction = !before.is_empty();
    all.extend(before);
    let tags: &[u8] = if friction { &[1, 1, 2, 1] } else { &[1, 1, 2] };
    let mut command = command("element", kind, tags, numbers);
    for (option, tag) in [("-P", 1), ("-T", 2), ("-My", 2), ("-Mz", 2)] {
        command.extend([json!(option), json!(tag)]);
    }
    command.push(json!("-orient"));
    command.extend([1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(|x| json!(x)));
    if friction {
        // Iterations within the element and their tolerance: its own do not reach theirs where the bearing turns.
        command.extend([json!("-iter"), json!(100), json!(1e-8)]);
    }
    all.push(command.into());
    all
}

/// Along one axis, along a spiral, along a figure that crosses itself.
pub(super) fn motions(amplitude: f64) -> [(&'static str, [Wave; 2]); 3] {
    let a = amplitude;
    [
        ("one axis", [Irregular(a), Held(0.0)]),
        ("spiral", [Growing(a, 1.0), Ahead(a, 1.0)]),
        ("crossing", [Growing(a, 1.0), Growing(0.6 * a, 1.7)]),
    ]
}

fn led(name: &str, theirs: &[Value], ours: &Ours, amplitude: f64, axial: Wave) -> [Pair; 3] {
    motions(amplitude).map(|(motion, [a, b])| {
        let name = format!("{name}, {motion}");
        Pair::bearing(&name, theirs.to_vec(), ours.clone(), [axial, a, b])
    })
}

fn rubber() -> Vec<Pair> {
    let mut all = Vec::new();
    let theirs = element("elastomericBearingPlasticity", vec![], &[1e7, 9e4, 0.1, 0.0, 3.0]);
    let ours = link("ElastomericBearing", &[("k", "1e7"), ("fy", "1e5"), ("ratio", "0.1")]);
    all.extend(led("elastomericBearingPlasticity", &theirs, &ours, 0.05, LOADED));
    for (eta, beta, gamma) in [(1.0, 0.6, 0.4), (2.0, 0.5, 0.5)] {
        let numbers = [1e7, 9e4, 0.1, 0.0, 3.0, eta, beta, gamma];
        let theirs = element("elastomericBearingBoucWen", vec![], &numbers);
        let [e, b, g] = [eta, beta, gamma].map(|x: f64| x.to_string());
        let set = [
            ("k2", "1e7"),
            ("fy2", "1e5"),
            ("ratio2", "0.1"),
            ("kv", "1e9"),
            ("coupling", "Direction"),
            ("eta", &e),
            ("beta", &b),
            ("gamma", &g),
        ];
        let name = format!("elastomericBearingBoucWen, η = {eta}");
        let pairs = led(&name, &theirs, &link("RubberIsolator", &set), 0.05, LOADED);
        all.extend(pairs.map(Pair::implicit));
    }
    all
}

fn lead(heats: bool) -> [Pair; 3] {
    // A core of 160 mm in a bearing of 800 mm with twenty layers of 10 mm.
    let (fy, alpha, g, core, outer, shim, layer, layers) =
        (2e5, 0.1, 5e5, 0.16, 0.8, 3e-3, 0.01, 20.0);
    let area = std::f64::consts::FRAC_PI_4 * (outer * outer - core * core);
    let (rubber, steel) = (layers * layer, (layers - 1.0) * shim);
    let kr = g * area / rubber;
    let lead = std::f64::consts::FRAC_PI_4 * core * core;
    let yielded = fy / ((1.0 / alpha - 1.0) * kr);
    let set = [
        ("kr", kr.to_string()),
        ("lead_diameter", core.to_string()),
        ("lead_height", (rubber + steel).to_string()),
        ("lead_strength", (fy / lead).to_string()),
        ("yield_displacement", yielded.to_string()),
        ("shim_thickness", steel.to_string()),
        ("coupling", "Axes".to_owned()),
        ("beta", "0.9".to_owned()),
        ("gamma", "0.1".to_owned()),
        ("kv", "1e9".to_owned()),
        ("heating", heats.to_string()),
    ];
    let ours = ("LeadRubber", set.to_vec());
    // Of the effects that can be chosen only that of heat: none of the axial force.
    let (bulk, cavitation, damage, strain) = (2e9, 10.0, 0.5, 1.0);
    let numbers = [fy, alpha, g, bulk, core, outer, shim, layer];
    let mut theirs = command("element", "LeadRubberX", &[1, 1, 2], &numbers);
    theirs.push(json!(20));
    theirs.extend([1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(|x| json!(x)));
    theirs.extend([cavitation, damage, strain, 0.5, 0.0, 0.0, 0.0].map(|x| json!(x)));
    theirs.extend([11200.0, 130.0, 50.0, 1.41e-5].map(|x| json!(x)));
    theirs.extend([0, 0, 0, 0, u8::from(heats)].map(|x| json!(x)));
    let why = "heat is what is dissipated here, without the elastic stretch, and the core yields \
               at the same deformation hot or cold";
    let name = if heats { "LeadRubberX, hot" } else { "LeadRubberX, cold" };
    let pairs = led(name, &[theirs.into()], &ours, 0.15, LOADED).map(Pair::implicit);
    if heats {
        return pairs.map(|p| p.agreeing(Agree::Near(0.1, why)));
    }
    pairs
}

fn sliding() -> Vec<Pair> {
    let mut all = Vec::new();
    let coulomb = || vec![json!(["frictionModel", "Coulomb", 1, 0.05])];
    let by_speed = || vec![json!(["frictionModel", "VelDependent", 1, 0.03, 0.06, 20.0])];
    let plain = [("kn", "1e9"), ("ks", "1e8"), ("friction_model", "Coulomb"), ("mu", "0.05")];
    let none = [("mu_slow", "none"), ("mu_fast", "none"), ("rate", "none")];
    let slider = |more: &[(&'static str, &'static str)]| {
        let set: Vec<_> = plain.into_iter().chain(none).chain(more.iter().copied()).collect();
        link("FrictionPendulum", &set)
    };
    let flat = slider(&[("radius", "none")]);
    let theirs = element("flatSliderBearing", coulomb(), &[1e8]);
    all.extend(led("flatSliderBearing", &theirs, &flat, 0.05, LOADED));
    let varying = About(-1e-3, 5e-4, 1.3);
    all.extend(led("flatSliderBearing, N varies", &theirs, &flat, 0.05, varying));
    let lifting = About(-5e-4, 1e-3, 1.3);
    all.extend(led("flatSliderBearing, N comes and goes", &theirs, &flat, 0.05, lifting));
    for (ks, limit) in [("1e8", 0.2), ("1e9", 0.15)] {
        let speed = [
            ("kn", "1e9"),
            ("ks", ks),
            ("radius", "none"),
            ("friction_model", "Velocity"),
            ("mu_slow", "0.03"),
            ("mu_fast", "0.06"),
            ("rate", "20"),
        ];
        let theirs = element("flatSliderBearing", by_speed(), &[ks.parse().unwrap_or(0.0)]);
        let why = "friction by the speed of the bearing there, of the slip here";
        let name = format!("flatSliderBearing, by speed, {ks} N/m");
        let velocity = led(&name, &theirs, &link("FrictionPendulum", &speed), 0.05, LOADED);
        all.extend(velocity.map(|p| p.agreeing(Agree::Near(limit, why))));
    }
    all.extend(by_force_and_pressure(varying));
    // The stiffness before slip holds that of the pendulum, N/R, there.
    let round = slider(&[
        ("ks", "99333333.3333333"),
        ("radius", "1.5"),
        ("surface", "Spherical"),
        ("inclined", "true"),
    ]);
    let theirs = element("singleFPBearing", coulomb(), &[1.5, 1e8]);
    for (how, amplitude, limit) in [("small", 0.05, 0.002), ("large", 0.4, 0.08)] {
        let name = format!("singleFPBearing, {how}");
        let why =
            "the restoring force is that of N with its share of the shear over the slope there";
        all.extend(
            led(&name, &theirs, &round, amplitude, LOADED)
                .map(|p| p.agreeing(Agree::Near(limit, why))),
        );
    }
    all
}

/// Coefficients that the normal force changes as well: N goes from 0.5 MN to 1.5 MN and back.
fn by_force_and_pressure(axial: Wave) -> Vec<Pair> {
    let model =
        |name: &str, numbers: &[f64]| vec![command("frictionModel", name, &[1], numbers).into()];
    let set = |name: &'static str, more: &[(&'static str, &'static str)]| {
        let plain = [("kn", "1e9"), ("ks", "1e9"), ("radius", "none"), ("friction_model", name)];
        let none = [("mu_slow", "none"), ("mu_fast", "none"), ("rate", "none")];
        let set: Vec<_> = plain.into_iter().chain(none).chain(more.iter().copied()).collect();
        link("FrictionPendulum", &set)
    };
    // 0.025 and 0.05 at 1 MN.
    let power = [0.397, 0.8, 1.255, 0.7667, 20.0, 5e-6, 1e-12, 3.0];
    let by_force = [
        ("a_slow", "0.397"),
        ("n_slow", "0.8"),
        ("a_fast", "1.255"),
        ("n_fast", "0.7667"),
        ("rate_0", "20"),
        ("rate_1", "5e-6"),
        ("rate_2", "1e-12"),
    ];
    let tanh = [0.03, 0.09, 0.1, 0.05, 8e-8, 20.0];
    let by_pressure = [
        ("mu_slow", "0.03"),
        ("mu_fast", "0.09"),
        ("area", "0.1"),
        ("delta_mu", "0.05"),
        ("pressure_rate", "8e-8"),
        ("rate", "20"),
    ];
    let why = "friction by the speed of the bearing there, of the slip here";
    let mut all = Vec::new();
    for (theirs, numbers, ours) in [
        ("VelNormalFrcDep", &power[..], set("VelocityForce", &by_force)),
        ("VelPressureDep", &tanh[..], set("VelocityPressure", &by_pressure)),
    ] {
        let bearing = element("flatSliderBearing", model(theirs, numbers), &[1e9]);
        let name = format!("flatSliderBearing, {theirs}, N varies");
        let pairs = led(&name, &bearing, &ours, 0.05, axial);
        // The speed passes zero along one axis, and never on the path that crosses itself.
        all.extend(
            pairs
                .into_iter()
                .zip([0.15, 0.1, 0.015])
                .map(|(p, limit)| p.agreeing(Agree::Near(limit, why))),
        );
    }
    all
}

fn triple() -> Vec<Pair> {
    let mut theirs = vec![
        json!(["uniaxialMaterial", "Elastic", 1, AXIAL]),
        json!(["uniaxialMaterial", "Elastic", 2, 1.0]),
    ];
    for (tag, mu) in [(1, 0.02), (2, 0.05), (3, 0.09)] {
        theirs.push(json!(["frictionModel", "Coulomb", tag, mu]));
    }
    let tags = [1, 1, 2, 1, 2, 3, 1, 2, 2, 2];
    let (inner, outer, inner_rim, rim, weight, stretch) = (0.35, 2.1, 0.05, 0.35, 1e6, 1e-3);
    let (uplift, least, tolerance) = (1.0, 1.0, 1e-6);
    let numbers =
        [inner, outer, outer, inner_rim, rim, rim, weight, stretch, uplift, least, tolerance];
    theirs.push(command("element", "TripleFrictionPendulum", &tags, &numbers).into());
    let set = [
        ("kn", "1e9"),
        ("ks", "8e7"),
        ("radii", "2.1, 0.35, 0.35, 2.1"),
        ("heights", "0, 0, 0, 0"),
        ("capacities", "0.35, 0.05, 0.05, 0.35"),
        ("mu", "0.05, 0.02, 0.02, 0.09"),
    ];
    // The inner surfaces slip first, when all four springs have stretched as much together as the bearing there.
    let why = "the stretch before slip is shared among three elements there, four surfaces here";
    led("TripleFrictionPendulum", &theirs, &link("TriplePendulum", &set), 0.25, LOADED)
        .map(|p| Pair { directions: vec![3, 1, 2], ..p.agreeing(Agree::Near(0.02, why)) })
        .into()
}

pub(super) fn pairs() -> Vec<Pair> {
    let mut all = rubber();
    all.extend(lead(false));
    all.extend(lead(true));
    all.extend(sliding());
    all.extend(triple());
    all
}
