//! Contacts and dampers.

use super::pair::{Agree, Ours, Pair, link, material};
use super::paths::Wave::Irregular;

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
    all.extend(viscous());
    all
}
