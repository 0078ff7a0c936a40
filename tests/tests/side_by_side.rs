//! Links of one kind are asked side by side: the answers are those of each law alone.

use trilith_element::{Energy, Kinematics};
use trilith_system::{Answers, StepLaws, Tangents};
use trilith_tests::parse;

/// A mass on so many links of each kind that has a law over lanes, each with numbers of its own; kind after kind, or one
/// of each in turn.
fn model(each: usize, sorted: bool) -> String {
    let mut elements = Vec::new();
    for i in 0..each {
        let x = 1.0 + 0.13 * i as f64;
        for (name, law) in [
            (
                "bearing",
                format!(
                    "ElastomericBearing(node: \"n\", k: {}, fy: {}, ratio: 0.1)",
                    1e6 * x,
                    2e4 / x
                ),
            ),
            ("slider", format!("ElastomericBearing(node: \"n\", k: {}, fy: {})", 2e6 * x, 1e4 / x)),
            (
                "foot",
                format!(
                    "NLink(node: \"n\", kn: {}, ks: {}, mu: {}, damping: 1e4)",
                    1e7 * x,
                    5e6 * x,
                    0.3 * x
                ),
            ),
            (
                "still",
                format!("NLink(node: \"n\", kn: {}, ks: {}, mu: {})", 1e7 * x, 5e6 * x, 0.3 * x),
            ),
            ("dashpot", format!("Dashpot(node: \"n\", axis: U2, c: {})", 1e5 * x)),
            ("gap", format!("Gap(node: \"n\", k: {}, opening: {})", 1e7 * x, 1e-3 * x)),
            ("hook", format!("Hook(node: \"n\", k: {}, opening: {})", 1e7 * x, 1e-3 * x)),
        ] {
            elements.push((name, format!("\"{name} {i}\": {law},\n")));
        }
    }
    if sorted {
        elements.sort_by_key(|(name, _)| *name);
    }
    let elements: String = elements.into_iter().map(|(_, text)| text).collect();
    format!(
        "(nodes: {{ \"n\": (0, 0, 0) }}, elements: {{ \"mass\": Mass(node: \"n\", mass: \"1 t\", inertia: (1, 1, 1)),
        \"upright\": Spring(node: \"n\", r1: 1e6, r2: 1e6, r3: 1e6), {elements} }},
        cases: {{ \"free\": Dynamic(duration: \"1 s\", dt: \"0.01 s\") }})"
    )
}

fn close(what: &str, a: &[f64], b: &[f64], size: f64) {
    for (i, (a, b)) in a.iter().zip(b).enumerate() {
        assert!((a - b).abs() <= 1e-12 * size, "{what} {i}: {a} {b}");
    }
}

/// Numbers on both sides of the width of the lanes; steps in which every law changes its regime.
#[test]
fn links_of_one_kind_answer_together_as_alone() {
    for (each, sorted) in [1, 3, 4, 5, 8, 9, 17].into_iter().flat_map(|n| [(n, false), (n, true)]) {
        let (model, system) = parse(&model(each, sorted), &[]);
        let links = &system.links;
        let laws = links.laws(&model);
        let mut together = StepLaws::new(laws.clone());
        let n = links.len();
        let zero = || vec![0.0; n];
        let none =
            || Tangents { k: vec![f64::NAN; links.block_len], c: vec![f64::NAN; links.block_len] };
        let mut history = links.at_rest(&model);
        let (mut d0, mut v0) = (zero(), zero());
        let dt = 0.01;
        let mut two = links.tangents();
        let at = Kinematics::new([&d0, &v0], [&d0, &v0], dt);
        let mut energy = vec![Energy::default(); links.links.len()];
        laws.respond(at, &history, &mut history.clone(), &mut zero(), &mut two, &mut energy);
        for step in 0..60 {
            let mut d = zero();
            let mut v = zero();
            let (mut of, mut other) = (zero(), zero());
            let mut one = none();
            let (mut trial, mut second) = (history.clone(), history.clone());
            let mut energy = vec![Energy::default(); links.links.len()];
            let mut energies = energy.clone();
            let start = Kinematics::new([&d0, &v0], [&d0, &v0], dt);
            together.start(&start, &history);
            // Two looks, as an iteration makes them.
            for look in 0..2 {
                for i in 0..n {
                    let phase = 0.37 * f64::from(step) + 0.9 * i as f64 + 0.01 * f64::from(look);
                    (d[i], v[i]) = (8e-3 * phase.sin(), 0.3 * phase.cos());
                }
                let at = Kinematics::new([&d, &v], [&d0, &v0], dt);
                laws.respond(at, &history, &mut trial, &mut of, &mut one, &mut energy);
                let last = (step + look) % 2 == 0;
                let (f, tangents, energy) = (&mut other, &mut two, &mut energies);
                let to = &mut Answers { history: &mut second, f, tangents, energy };
                together.respond(&at, last, &history, to);
                if look == 0 {
                    together.tangents(to.tangents);
                }
                if look == 1 {
                    together.end(&at, to);
                }
                close("force", &of, &other, 1e5);
                close("stiffness", &one.k, &two.k, 1e7);
                close("damping", &one.c, &two.c, 1e7);
            }
            close("history", &trial, &second, 1.0);
            for (a, b) in energy.iter().zip(&energies) {
                let of = |e: &Energy| [e.stored, e.hysteretic, e.viscous];
                close("energy", &of(a), &of(b), 1e3);
            }
            (history, d0, v0) = (trial, d, v);
        }
    }
}
