//! Optimised parameters against closed forms and published optima, and against plain runs around them.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use trilith::Model;
use trilith::model::ModelText;
use trilith::optimize::{HOLDS, OptimizeError, Optimum, Stop, Variable, Wanted, optimize};

fn search(text: &str, path: &str, wanted: &Wanted) -> Result<Optimum, OptimizeError> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let text = ModelText::new(text, path).expect("a text");
    optimize(&text, &trilith::registry(), wanted)
}

fn by(all: &[&str]) -> Vec<Variable> {
    all.iter().map(|text| text.parse().expect("a variable")).collect()
}

fn texts(all: &[&str]) -> Vec<String> {
    all.iter().map(|text| (*text).to_owned()).collect()
}

/// A mass of 100 kg that strikes an isolator with 1 m/s.
const ISOLATOR: &str = r#"(
    parameters: { "c": "200 N*s/m", "k": "10 kN/m" },
    plane: XZ,
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uz, Ry) },
    elements: {
        "mass": Mass(node: "m", mass: "100 kg"),
        "spring": Spring(node: "m", k2: "k"),
        "damper": Dashpot(node: "m", axis: U2, c: "c"),
    },
    cases: { "strike": Dynamic(
        duration: "0.4 s", dt: "1 ms", solver: Hht,
        initial: [(node: "m", dof: Ux, velocity: "1 m/s")],
    ) },
    outputs: { "x": Displacement(node: "m", dof: Ux), "acceleration": Acceleration(node: "m", dof: Ux) },
)"#;

/// Largest displacement and acceleration of a mass on a spring and a dashpot (k/m = ω²) after a blow of 1 m/s, ζ < 1/2.
fn struck(omega: f64, zeta: f64) -> [f64; 2] {
    let damped = (1.0 - zeta * zeta).sqrt();
    let x = (-zeta / damped * (damped / zeta).atan()).exp() / omega;
    let slow = damped * (1.0 - 4.0 * zeta * zeta) / (zeta * (3.0 - 4.0 * zeta * zeta));
    [x, omega * (-zeta / damped * slow.atan()).exp()]
}

/// The place of the least value, by thirds.
fn least(of: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..100 {
        let third = (high - low) / 3.0;
        if of(low + third) < of(high - third) { high -= third } else { low += third }
    }
    0.5 * (low + high)
}

#[test]
fn a_dashpot_makes_the_acceleration_of_a_blow_smallest() {
    let wanted = Wanted {
        by: by(&["c=50 N*s/m..2000 N*s/m"]),
        minimise: texts(&["acceleration"]),
        ..Wanted::default()
    };
    let found = search(ISOLATOR, "isolator.ron", &wanted).expect("an optimum");
    let zeta = least(|z| struck(10.0, z)[1], 0.1, 0.49);
    assert!((zeta - 0.265).abs() < 1e-3, "the closed form: {zeta}");
    let best = found.best();
    assert!((best.x[0] / 2000.0 - zeta).abs() < 5e-3, "{} and {zeta}", best.x[0] / 2000.0);
    assert!((best.goal / struck(10.0, zeta)[1] - 1.0).abs() < 2e-4);
    assert!(found.runs.len() <= 20, "{} runs", found.runs.len());
    assert!(matches!(found.stop, Stop::Smallest | Stop::Kink));
}

/// The least displacement x of an isolator that lets through no more than an acceleration a: x a/v² = 0.5206 for a spring and a dashpot
/// (Sevin & Pilkey 1971, *Optimum shock and vibration isolation*).
#[test]
fn an_isolator_of_least_travel_for_a_given_acceleration() {
    let limit = 6.0;
    let wanted = Wanted {
        by: by(&["c=50 N*s/m..2000 N*s/m", "k=1 kN/m..100 kN/m log"]),
        minimise: texts(&["x"]),
        limits: texts(&["acceleration <= 6 m/s^2"]),
        ..Wanted::default()
    };
    let found = search(ISOLATOR, "isolator.ron", &wanted).expect("an optimum");
    let best = found.best();
    let omega = (best.x[1] / 100.0).sqrt();
    let zeta = best.x[0] / (200.0 * omega);
    // By the closed form alone: with each ζ the softest spring that meets the limit.
    let product = |z: f64| struck(1.0, z)[0] * struck(1.0, z)[1];
    let exact = least(product, 0.1, 0.49);
    assert!((product(exact) - 0.5206).abs() < 2e-4, "the closed form: {}", product(exact));
    assert!(found.holds() && found.limits[0].beyond.abs() <= HOLDS, "{:?}", found.limits);
    assert!((best.goal * limit / product(exact) - 1.0).abs() < 2e-3, "{}", best.goal * limit);
    assert!((zeta - exact).abs() < 0.03, "{zeta} and {exact}");
    // One per cent more of the acceleration takes one per cent off the displacement, which is x a/v².
    let worth = found.limits[0].multiplier * found.runs[0].goal / best.goal;
    assert!((worth - 1.0).abs() < 0.05, "{worth}");
    assert!(found.runs.len() <= 50);
}

/// A slow sweep of a sine through frequencies, as a table: a unit force of the frequency f₀ + (f₁ − f₀) t/T.
fn sweep(from: f64, to: f64, duration: f64) -> String {
    let dt = 0.01;
    let count = (duration / dt) as usize;
    let value = |i: usize| {
        let t = i as f64 * dt;
        let phase = from * t + 0.5 * (to - from) * t * t / duration;
        // It sets in slowly: what a sudden start makes dies out before the peaks.
        let ramp = (t / 20.0).min(1.0);
        format!("({t:.2}, {:.9})", ramp * (std::f64::consts::TAU * phase).sin())
    };
    (0..=count).map(value).collect::<Vec<_>>().join(", ")
}

/// A tuned mass damper on a mass without damping under a harmonic force, of 5 % of its mass: Den Hartog's tuning 1/(1+μ) and damping
/// √(3μ/(8(1+μ)³)), with the amplification √(1 + 2/μ) (*Mechanical vibrations*, 1956, §3.3). Slow sweeps ask all frequencies, from far
/// below the lower peak to between both, and from far above the upper one.
#[test]
fn a_tuned_mass_damper_is_den_hartogs() {
    let ratio = 0.05_f64;
    let half = |s: &str| {
        format!(
            r#""main {s}": Mass(node: "m {s}", mass: "1 t"), "mass {s}": Mass(node: "d {s}", mass: "50 kg"),
            "spring {s}": Spring(node: "m {s}", k2: "39478.4176 N/m"),
            "tuned {s}": Spring(nodes: ("m {s}", "d {s}"), k1: "k"),
            "damper {s}": Dashpot(nodes: ("m {s}", "d {s}"), c: "c"),"#
        )
    };
    let text = format!(
        r#"(
        parameters: {{ "k": "2.2 kN/m", "c": "40 N*s/m" }},
        plane: XZ,
        nodes: {{ "m low": (0, 0, 0), "d low": (1, 0, 0), "m high": (0, 0, 0), "d high": (1, 0, 0) }},
        supports: {{ "m low": (Uz, Ry), "d low": (Uz, Ry), "m high": (Uz, Ry), "d high": (Uz, Ry) }},
        elements: {{ {} {} }},
        functions: {{ "up": Points(points: [{}]), "down": Points(points: [{}]) }},
        loads: {{
            "low": [(node: "m low", dof: Ux, force: "39.4784176 N")],
            "high": [(node: "m high", dof: Ux, force: "39.4784176 N")],
        }},
        cases: {{ "sweep": Dynamic(
            duration: "180 s", dt: "20 ms", solver: Hht,
            forces: [(load: "low", function: "up"), (load: "high", function: "down")],
        ) }},
        outputs: {{ "low": Displacement(node: "m low", dof: Ux), "high": Displacement(node: "m high", dof: Ux) }},
    )"#,
        half("low"),
        half("high"),
        sweep(0.75, 0.95, 180.0),
        sweep(1.25, 0.95, 180.0),
    );
    let wanted = Wanted {
        by: by(&["k=1 kN/m..3 kN/m", "c=20 N*s/m..200 N*s/m"]),
        minimise: texts(&["low", "high"]),
        ..Wanted::default()
    };
    let found = search(&text, "tuned.ron", &wanted).expect("an optimum");
    let [k, c] = found.best().x[..] else { panic!("two parameters") };
    let own = (k / 50.0).sqrt();
    let (tuning, damping) = (own / std::f64::consts::TAU, c / (2.0 * 50.0 * own));
    let exact = [1.0 / (1.0 + ratio), (3.0 * ratio / (8.0 * (1.0 + ratio).powi(3))).sqrt()];
    let amplification = found.best().goal / 1e-3;
    let told = format!("{tuning} {damping} {amplification}: {exact:?}, {found:?}");
    assert!((tuning / exact[0] - 1.0).abs() < 0.01, "{told}");
    assert!((damping / exact[1] - 1.0).abs() < 0.08, "{told}");
    assert!((amplification / (1.0 + 2.0 / ratio).sqrt() - 1.0).abs() < 0.02, "{told}");
    assert!(found.runs.len() <= 50);
}

/// The largest storey drift of the frame with these dampers, by a run as any other.
fn drift(constants: &[f64]) -> f64 {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(FRAME);
    let set =
        constants.iter().enumerate().map(|(i, c)| (format!("c{}", i + 1), format!("{c:?} kg/s")));
    let set: Vec<_> = set.chain([("duration".to_owned(), "11 s".to_owned())]).collect();
    let model: Model = trilith::read(path, &trilith::registry(), &set).expect("a model");
    let run = trilith::run(&model, "earthquake").expect("a run");
    let peak = |k: usize| run.peak(&format!("drift{k}")).expect("an output").magnitude();
    (1..=10).map(peak).fold(0.0, f64::max)
}

const FRAME: &str = "../../models/damped_frame.ron";

#[test]
fn dampers_of_a_frame_of_ten_storeys_are_shared_out() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(FRAME);
    let text = std::fs::read_to_string(path).expect("a file");
    let total = 4e6;
    let wanted = Wanted {
        by: by(&["c*=10 kN*s/m..2 MN*s/m"]),
        minimise: texts(&["drift*"]),
        limits: texts(&["total <= 4 MN*s/m"]),
        // The strong part of the motion.
        set: vec![("duration".into(), "11 s".into())],
        max_runs: 50,
        ..Wanted::default()
    };
    let found = search(&text, FRAME, &wanted).expect("an optimum");
    let best = found.best();
    assert_eq!(found.parameters.len(), 10);
    assert!(found.runs.len() <= 50 && found.holds(), "{:?}", found.limits);
    assert!((best.x.iter().sum::<f64>() / total - 1.0).abs() <= HOLDS);
    // The same total in equal parts is where the search began: much worse.
    let uniform = drift(&[total / 10.0; 10]);
    let own = drift(&best.x);
    assert!((found.runs[0].goal / uniform - 1.0).abs() < 1e-3);
    assert!((best.goal / own - 1.0).abs() < 1e-3);
    assert!(own < 0.89 * uniform, "{own} and {uniform}");
    // Nor is it better to give a part of one storey to another one.
    let part = 0.02 * total;
    let mut asked = 0;
    for from in 0..10 {
        for to in (0..10).filter(|to| *to != from) {
            let mut other = best.x.clone();
            let part = part.min(other[from] - 1e4).min(2e6 - other[to]);
            if part < 0.002 * total {
                continue;
            }
            other[from] -= part;
            other[to] += part;
            let there = drift(&other);
            assert!(there > 0.99 * own, "{part} from {from} to {to}: {there} below {own}");
            asked += 1;
        }
    }
    assert!(asked >= 20, "only {asked} ways to share were open");
}

#[test]
fn what_is_no_search_is_told() {
    let told = |wanted: Wanted| {
        search(ISOLATOR, "isolator.ron", &wanted).map(|_| ()).unwrap_err().to_string()
    };
    let x = || Wanted { minimise: texts(&["x"]), by: by(&["c=50..2000"]), ..Wanted::default() };
    assert!(told(Wanted { by: Vec::new(), ..x() }).contains("no parameter to search for"));
    assert!(told(Wanted { minimise: Vec::new(), ..x() }).contains("nothing to make smallest"));
    assert!(told(Wanted { minimise: texts(&["y"]), ..x() }).contains("there is no parameter `y`"));
    assert!(told(Wanted { minimise: texts(&["y*"]), ..x() }).contains("begins with `y`"));
    assert!(
        told(Wanted { minimise: texts(&["x", "acceleration"]), ..x() }).contains("it is in m/s²")
    );
    assert!(told(Wanted { minimise: texts(&["x + acceleration"]), ..x() }).contains("cannot be"));
    assert!(told(Wanted { limits: texts(&["x"]), ..x() }).contains("`<=` or `>=`"));
    assert!(told(Wanted { limits: texts(&["x <= 1 s"]), ..x() }).contains("its bound in s"));
    assert!(told(Wanted { by: by(&["c=1..2", "c=1..3"]), ..x() }).contains("twice"));
    assert!(told(Wanted { by: by(&["q=1..2"]), ..x() }).contains("no parameter `q`"));
    assert!(told(Wanted { by: by(&["q*=1..2"]), ..x() }).contains("no parameter begins so"));
    assert!(told(Wanted { by: by(&["c=1 m..2 m"]), ..x() }).contains("this is in m"));
    // A solver that has no linear step: said as it is for derivatives.
    let wanted = Wanted { solver: Some(trilith::SolverKind::FullNewton), ..x() };
    let refused = search(ISOLATOR, "isolator.ron", &wanted).unwrap_err().to_string();
    assert!(refused.contains("--solver hht"), "{refused}");
    // A parameter on which nothing hangs.
    let idle = ISOLATOR.replace(r#""k": "10 kN/m""#, r#""k": "10 kN/m", "q": 1"#);
    let wanted = Wanted { by: by(&["q=0.5..2"]), ..x() };
    let refused = search(&idle, "isolator.ron", &wanted).unwrap_err().to_string();
    assert!(refused.contains("changes with `q`"), "{refused}");
}

#[test]
fn a_search_ends_when_its_runs_are_spent_or_somebody_wants_it_to() {
    let wanted = Wanted {
        by: by(&["c=50 N*s/m..2000 N*s/m"]),
        minimise: texts(&["acceleration"]),
        max_runs: 3,
        ..Wanted::default()
    };
    let found = search(ISOLATOR, "isolator.ron", &wanted).expect("an optimum");
    assert_eq!((found.stop, found.runs.len()), (Stop::Spent, 3));
    assert!(found.best().goal <= found.runs[0].goal);
    let text = ModelText::new(ISOLATOR, "isolator.ron").expect("a text");
    let flag = AtomicBool::new(false);
    let mut stop =
        |_: usize, _: &trilith::optimize::Evaluation| flag.store(true, Ordering::Relaxed);
    let kinds = trilith::registry();
    let found = trilith::optimize::optimize_with(&text, &kinds, &wanted, &mut stop, &flag);
    let found = found.expect("what there is");
    assert_eq!((found.stop, found.runs.len(), found.best), (Stop::Interrupted, 1, 0));
    // Before the first run there is nothing to be told.
    let found = trilith::optimize::optimize_with(&text, &kinds, &wanted, &mut |_, _| (), &flag);
    assert_eq!(found.map(|_| ()).unwrap_err().to_string(), "interrupted");
}

#[test]
fn limits_that_nothing_meets_are_told() {
    let wanted = Wanted {
        by: by(&["c=50 N*s/m..2000 N*s/m"]),
        minimise: texts(&["x"]),
        limits: texts(&["acceleration <= 1 m/s^2"]),
        ..Wanted::default()
    };
    let found = search(ISOLATOR, "isolator.ron", &wanted).expect("an optimum");
    assert!(!found.holds() && found.limits[0].beyond > 1.0, "{:?}", found.limits);
    assert!(matches!(found.stop, Stop::Limits | Stop::Spent), "{:?}", found.stop);
    // What is told is the least broken.
    assert!(found.runs.iter().all(|r| r.broken() >= found.best().broken()));
}
