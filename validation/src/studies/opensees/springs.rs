//! Springs that yield or bend.

use super::pair::{Agree, Ours, Pair, command, link, material};
use super::paths::Wave::{Growing, Ramp};
use serde_json::{Value, json};

/// A plastic spring along these points, m and N.
fn plastic(rule: &str, deformation: &str, force: &str) -> Vec<Ours> {
    let set = [("axis", "U1"), ("rule", rule), ("deformation", deformation), ("force", force)];
    vec![link("MultilinearPlastic", &set)]
}

/// Stiffness and yield force of springs of two lines.
const E: f64 = 1e8;
const FY: f64 = 3e5;

/// A spring that yields, with another slope behind, 1 m of it.
fn two_lines(rule: &str, slope: f64) -> Vec<Ours> {
    let end = FY + slope;
    plastic(rule, "-1.003, -0.003, 0, 0.003, 1.003", &format!("{}, -3e5, 0, 3e5, {end}", -end))
}

/// Points of five lines, m and N; the last three are those of three lines.
const POINTS: [(f64, f64); 5] =
    [(0.001, 1.2e5), (0.002, 2.2e5), (0.003, 3e5), (0.008, 4e5), (0.028, 5e5)];

/// A kinematic spring through these points and their counterparts.
fn through(points: &[(f64, f64)]) -> Vec<Ours> {
    along("Kinematic", points)
}

/// A plastic spring through these points and their counterparts.
fn along(rule: &str, points: &[(f64, f64)]) -> Vec<Ours> {
    let back = points.iter().rev().map(|(d, f)| (-d, -f));
    let all: Vec<_> = back.chain([(0.0, 0.0)]).chain(points.iter().copied()).collect();
    let list = |of: fn(&(f64, f64)) -> f64| {
        all.iter().map(|p| of(p).to_string()).collect::<Vec<_>>().join(", ")
    };
    plastic(rule, &list(|p| p.0), &list(|p| p.1))
}

fn yielding() -> Vec<Pair> {
    // Slope behind yield of a plastic modulus.
    let behind = E * 4e6 / (E + 4e6);
    let two = [
        ("ElasticPP", "ElasticPP", &[E, FY / E][..], "Kinematic", 0.0),
        ("Steel01", "Steel01", &[FY, E, 0.02], "Kinematic", 0.02 * E),
        ("Hardening, kinematic", "Hardening", &[E, FY, 0.0, 4e6], "Kinematic", behind),
        ("Hardening, isotropic", "Hardening", &[E, FY, 4e6, 0.0], "Isotropic", behind),
        ("MultiLinear of two lines", "MultiLinear", &[FY / E, FY, 0.013, 5e5], "Kinematic", 2e7),
    ];
    let mut all = Vec::new();
    for (name, kind, numbers, rule, slope) in two {
        all.extend(Pair::twice(name, &[material(kind, numbers)], &two_lines(rule, slope), 0.02));
    }
    for (lines, points) in [("three", &POINTS[2..]), ("five", &POINTS[..])] {
        let theirs: Vec<f64> = points.iter().flat_map(|(d, f)| [*d, *f]).collect();
        let (theirs, ours) = (vec![material("MultiLinear", &theirs)], through(points));
        let name = format!("MultiLinear of {lines} lines");
        let first = format!("{name}, first loading");
        all.push(Pair::material(&first, theirs.clone(), ours.clone(), Ramp(0.025)));
        all.extend(Pair::twice(&name, &theirs, &ours, 0.02));
    }
    all
}

/// Laws of reinforced concrete: along the envelope, before anything turns back.
fn envelopes() -> Vec<Pair> {
    let [first, second, third, fourth] = [(0.003, 3e5), (0.008, 4e5), (0.018, 4.5e5), (0.028, 5e5)];
    let both = |points: &[(f64, f64)]| -> Vec<f64> {
        let side = |sign: f64| points.iter().flat_map(move |(d, f)| [sign * f, sign * d]);
        side(1.0).chain(side(-1.0)).collect()
    };
    // Pinching and damage, which turn up on the way back only.
    let mut hysteretic = both(&[first, second, fourth]);
    hysteretic.extend([0.6, 0.3, 0.01, 0.02, 0.4]);
    let mut pinching = both(&[first, second, third, fourth]);
    pinching.extend([0.5, 0.25, 0.05, 0.5, 0.25, 0.05]);
    pinching.extend([0.3, 0.2, 0.3, 0.2, 0.9].repeat(3));
    pinching.push(10.0);
    let mut pinching = command("uniaxialMaterial", "Pinching4", &[1], &pinching);
    pinching.push(json!("energy"));
    let mut all = Vec::new();
    for (name, theirs, rule) in [
        ("Hysteretic", material("Hysteretic", &hysteretic), "Takeda"),
        ("Pinching4", pinching.into(), "Pivot"),
    ] {
        let ours = along(rule, &[first, second, fourth]);
        for (side, end) in [("pulled", 0.025), ("pressed", -0.025)] {
            let name = format!("{name}, first loading, {side}");
            all.push(Pair::material(&name, vec![theirs.clone()], ours.clone(), Ramp(end)));
        }
    }
    all
}

/// Elastic, with another stiffness against compression.
fn two_sided() -> [Pair; 2] {
    let theirs = material("Elastic", &[E, 0.0, 0.4 * E]);
    let set = [("deformation", "-0.05, 0, 0.05"), ("force", "-2e6, 0, 5e6")];
    Pair::twice("Elastic with Eneg", &[theirs], &[link("MultilinearElastic", &set)], 0.02)
}

fn elastic() -> [Pair; 2] {
    let mut theirs = command("uniaxialMaterial", "ElasticMultiLinear", &[1], &[0.0]);
    theirs.push(json!("-strain"));
    theirs.extend([-0.05, -0.02, 0.0, 0.01, 0.04].map(|x| json!(x)));
    theirs.push(json!("-stress"));
    theirs.extend([-4e5, -6e4, 0.0, 6e4, 3e5].map(|x| json!(x)));
    let set =
        [("deformation", "-0.05, -0.02, 0, 0.01, 0.04"), ("force", "-4e5, -6e4, 0, 6e4, 3e5")];
    let ours = [link("MultilinearElastic", &set)];
    Pair::twice("ElasticMultiLinear", &[theirs.into()], &ours, 0.06)
}

fn side_by_side() -> [Pair; 2] {
    let part = |kind: &str, tag: u8, numbers: &[f64]| {
        Value::from(command("uniaxialMaterial", kind, &[tag], numbers))
    };
    let parts = [
        part("Steel01", 2, &[FY, E, 0.02]),
        part("ENT", 3, &[2e7]),
        part("Viscous", 4, &[5e4, 1.0]),
        json!(["uniaxialMaterial", "Parallel", 1, 2, 3, 4]),
    ];
    let mut ours = two_lines("Kinematic", 0.02 * E);
    ours.push(link("Gap", &[("k", "2e7"), ("opening", "0")]));
    ours.push(link("Dashpot", &[("c", "5e4")]));
    Pair::twice("Parallel of three", &parts, &ours, 0.02)
}

/// Capped backbone: capping strength over yield strength, deformations to capping and from there to zero, residual.
const CAPPED: [f64; 4] = [1.1, 0.02, 0.1, 0.2];

/// What of a spring with a capped backbone wears out.
#[derive(Clone, Copy, PartialEq)]
enum Worn {
    Nothing,
    Strength,
    All,
}

/// Springs with a capped backbone.
fn capped(form: &str, worn: Worn) -> (Value, Vec<Ours>) {
    let [capping, plastic, post, residual] = CAPPED;
    let side = [plastic, post, 10.0, FY, capping, residual];
    let capacity = |wears: bool| wears.then_some(0.4);
    let (strength, rest) = (capacity(worn != Worn::Nothing), capacity(worn == Worn::All));
    let lambdas = [strength, strength, rest, rest];
    let mut numbers = [&[E][..], &side, &side, &lambdas.map(|x| x.unwrap_or(1e12))].concat();
    numbers.extend([1.0; 6]);
    let pinching = form == "Pinching";
    if pinching {
        numbers.extend([0.3, 0.4]);
    }
    let text = |x: Option<f64>| x.map_or("none".to_owned(), |x| x.to_string());
    let set = [
        ("k", E.to_string()),
        ("fy", FY.to_string()),
        ("capping", capping.to_string()),
        ("plastic", plastic.to_string()),
        ("post_capping", post.to_string()),
        ("residual", residual.to_string()),
        ("lambda_s", text(strength)),
        ("lambda_c", text(strength)),
        ("lambda_a", text(rest)),
        ("lambda_k", text(rest)),
        ("form", form.into()),
        ("kappa_f", text(pinching.then_some(0.3))),
        ("kappa_d", text(pinching.then_some(0.4))),
        ("axis", "U1".into()),
    ];
    (material(&format!("IMK{form}"), &numbers), vec![("IbarraMedinaKrawinkler", set.into())])
}

fn deteriorating() -> Vec<Pair> {
    let trapezoids = "energies of the trapezoids of its steps there";
    let reversals = "stiffness falls at reversals there, with the energy here";
    let mut all = Vec::new();
    for form in ["PeakOriented", "Pinching"] {
        let (theirs, ours) = capped(form, Worn::Nothing);
        let name = format!("IMK{form}, sound, first loading");
        all.push(Pair::material(&name, vec![theirs.clone()], ours.clone(), Ramp(0.15)));
        all.extend(Pair::twice(&format!("IMK{form}, sound"), &[theirs], &ours, 0.05));
        for (what, worn, agree) in [
            ("strength wears out", Worn::Strength, Agree::Stepped(trapezoids)),
            ("all wears out", Worn::All, Agree::Near(0.002, reversals)),
        ] {
            let (theirs, ours) = capped(form, worn);
            let name = format!("IMK{form}, {what}");
            let pairs = Pair::twice(&name, &[theirs], &ours, 0.05);
            all.extend(pairs.map(|pair| pair.finer(10).agreeing(agree)));
        }
    }
    all
}

/// Soil behind a wall that comes and goes, in compression only.
fn soil() -> [Pair; 2] {
    let theirs = material("HyperbolicGapMaterial", &[2e7, 5e7, 0.7, -1.5e5, -0.002]);
    let pu = (1.5e5_f64 / 0.7).to_string();
    let set = [
        ("k", "2e7"),
        ("ku", "5e7"),
        ("pu", pu.as_str()),
        ("opening", "0.002"),
        ("sides", "Negative"),
        ("drag", "0"),
        ("axis", "U1"),
    ];
    Pair::twice("HyperbolicGapMaterial", &[theirs], &[link("SoilSpring", &set)], 0.05)
}

fn flag() -> Pair {
    let theirs = material("SelfCentering", &[5e7, 5e6, 3e5, 0.6]);
    // The same branch of loading, and one of return that meets theirs within the motion.
    let set = [
        ("k", "5e7"),
        ("k1", "5e6"),
        ("k2", "2.6e6"),
        ("u0", "0.054"),
        ("us", "none"),
        ("axis", "U1"),
    ];
    let ours = vec![link("FrictionSpring", &set)];
    let why = "the branches are parallel there and run to one point here";
    Pair::material("SelfCentering, growing cycles", vec![theirs], ours, Growing(0.04, 1.0))
        .agreeing(Agree::Near(0.12, why))
}

pub(super) fn pairs() -> Vec<Pair> {
    let mut all = yielding();
    all.extend(envelopes());
    all.extend(two_sided());
    all.extend(elastic());
    all.extend(side_by_side());
    all.push(flag());
    all.extend(deteriorating());
    all.extend(soil());
    all
}
