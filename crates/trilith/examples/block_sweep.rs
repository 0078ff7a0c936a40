//! How fast a sweep goes: a rigid block on two friction contacts under 5 Hz sines, 20 s at 1 ms.
//!
//! `cargo run --release -p trilith --example block_sweep [-- PAIRS]`: combinations are PAIRS × PAIRS (8) of
//! friction coefficient and amplitude; prints ns per step and analyses per second, and how the outcomes
//! of both widths and both thread counts compare.

use std::time::Instant;
use trilith::sweep::{Combination, Engine, Outcome, Sweep, SweepError};

/// 1 m × 2 m, 4 t, with linear dashpots beside the contacts, or in them.
const BLOCK: &str = r#"(
    plane: XZ, gravity: "9.81 m/s^2",
    parameters: { "mu": 0.4, "a": 0.3, "c": "20 kN*s/m", "cv": "0 N*s/m" },
    nodes: { "cg": (0, 0, 1), "left": (-0.5, 0, 0), "right": (0.5, 0, 0) },
    properties: {
        "foot": NLink(kn: "1e8 N/m", ks: "1e8 N/m", mu: "mu", damping: "cv"),
        "dashpot": Spring(c1: "c"),
    },
    elements: {
        "block": RigidBody(nodes: ("cg", "left", "right")),
        "inertia": Mass(node: "cg", mass: "4 t", inertia: (0, "4000 kg * 5 m^2 / 12", 0)),
        "rotation": Spring(node: "cg", cr3: "2 kN*m*s"),
        "dashpot left": Spring(node: "left", use: "dashpot"),
        "dashpot right": Spring(node: "right", use: "dashpot"),
        "foot left": NLink(node: "left", use: "foot"),
        "foot right": NLink(node: "right", use: "foot"),
    },
    functions: { "sine": Sine(amplitude: "a * 9.81 m/s^2", frequency: "5 Hz", cycles: 50) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "20 s", dt: "1 ms",
            base: [(direction: X, function: "sine")], step: Fixed(substeps: 1)),
    },
    outputs: {
        "sway": Displacement(node: "cg", dof: Ux),
        "slide": Displacement(node: "left", dof: Ux),
        "uplift_left": Displacement(node: "left", dof: Uz),
        "uplift_right": Displacement(node: "right", dof: Uz),
    },
)"#;

const STEPS: f64 = 20_000.0;

fn grid(pairs: usize, more: &[(&str, &str)]) -> Vec<Combination> {
    let share = |i: usize| i as f64 / (pairs.max(2) - 1) as f64;
    let mut all = Vec::new();
    for i in 0..pairs {
        for j in 0..pairs {
            let mut one = vec![
                ("mu".to_owned(), format!("{}", 0.2 + 0.6 * share(i))),
                ("a".to_owned(), format!("{}", 0.2 + 0.8 * share(j))),
            ];
            one.extend(more.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())));
            all.push(one);
        }
    }
    all
}

/// Time that this thread has computed, s; the clock on the wall where the system does not tell.
fn computed() -> f64 {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    let wall = START.get_or_init(Instant::now).elapsed().as_secs_f64();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split(' ').next().and_then(|x| x.parse::<f64>().ok());
    nanoseconds.map_or(wall, |ns| 1e-9 * ns)
}

type Outcomes = Vec<Result<Outcome, SweepError>>;

/// Times a sweep: of one thread the time that it computed, of several the time on the wall.
fn timed(label: &str, sweep: &Sweep, one: bool, combinations: &[Combination]) -> Outcomes {
    let mut best = f64::INFINITY;
    let mut outcomes = Vec::new();
    for _ in 0..3 {
        let (clock, wall) = (computed(), Instant::now());
        outcomes = sweep.run(combinations);
        let time = if one { computed() - clock } else { wall.elapsed().as_secs_f64() };
        best = best.min(time);
    }
    let n = combinations.len() as f64;
    let rerun = outcomes.iter().flatten().filter(|o| !matches!(o.engine, Engine::Lanes)).count();
    let failed = outcomes.iter().filter(|o| o.is_err()).count();
    let iterations: f64 = outcomes.iter().flatten().map(|o| o.iterations as f64).sum();
    println!(
        "{label:32} {:7.1} ns/step {:8.0} analyses/s  {:.2} it/step, {rerun} rerun, {failed} failed",
        1e9 * best / (n * STEPS),
        n / best,
        iterations / (n * STEPS)
    );
    outcomes
}

fn same(a: &Outcomes, b: &Outcomes) -> bool {
    let text = |o: &Outcomes| -> Vec<String> {
        o.iter()
            .map(|x| {
                format!(
                    "{:?}",
                    x.as_ref()
                        .map(|x| (&x.outputs, &x.energy, &x.contact))
                        .map_err(ToString::to_string)
                )
            })
            .collect()
    };
    text(a) == text(b)
}

/// What a combination costs beside the steps: the same for one step.
fn overhead(combinations: &[Combination]) {
    let text = BLOCK.replace("duration: \"20 s\"", "duration: \"1 ms\"");
    let sweep = Sweep::new(text, "block.ron", trilith::registry()).case("shake").threads(1);
    let clock = computed();
    let outcomes = sweep.run(combinations);
    let each = (computed() - clock) / outcomes.len() as f64;
    println!("reading and setting up: {:.0} µs an analysis", 1e6 * each);
    let registry = trilith::registry();
    let clock = computed();
    let models: Vec<_> = combinations
        .iter()
        .filter_map(|c| trilith::read_text(BLOCK, "block.ron", &registry, c).ok())
        .collect();
    println!("  reading: {:.0} µs", 1e6 * (computed() - clock) / models.len() as f64);
    let clock = computed();
    let systems = models.iter().filter(|m| trilith::solvers::assemble(m).is_ok()).count();
    println!("  assembly: {:.0} µs", 1e6 * (computed() - clock) / systems as f64);
}

/// The largest sway of the centre of gravity, both with steps of 0.02 ms; OpenSees: flatSliderBearing,
/// Newmark. Longer rocking is chaotic: neither code agrees with itself at other steps.
fn against_opensees() {
    println!("mu, a/g, duration: largest sway, m; OpenSees flatSliderBearing; energy error");
    for (mu, a, duration, reference) in [
        ("0.2", "0.6", "1 s", 0.019_638_8),
        ("0.6", "0.8", "0.3 s", 0.013_477_8),
        ("0.4", "0.3", "1 s", 0.000_510_1),
    ] {
        let one = vec![("mu".to_owned(), mu.to_owned()), ("a".to_owned(), a.to_owned())];
        let text = BLOCK.replace("duration: \"20 s\"", &format!("duration: \"{duration}\""));
        let sweep = Sweep::new(text, "block.ron", trilith::registry()).fixed_steps(50);
        match sweep.run(&[one]).pop() {
            Some(Ok(o)) => println!(
                "{mu} {a} {duration}: {:.7} {reference:.7}; {:.1e}, {:?}, {:?}",
                o.outputs.get("sway").map_or(f64::NAN, |p| p.max.max(-p.min)),
                o.energy.error_relative,
                o.engine,
                o.contact.map(|c| (c.initial_mode, c.mode)),
            ),
            Some(Err(e)) => println!("{mu} {a} {duration}: {e}"),
            None => {}
        }
    }
}

/// A number that changes when any digit of any outcome does.
fn digest(outcomes: &Outcomes) -> u64 {
    let mut sum = 0xcbf2_9ce4_8422_2325_u64;
    for o in outcomes.iter().flatten() {
        for byte in format!("{:?} {:?}", o.outputs, o.energy).bytes() {
            sum = (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
    sum
}

fn main() {
    let pairs = std::env::args().nth(1).and_then(|x| x.parse().ok()).unwrap_or(8);
    let sweep = || Sweep::new(BLOCK, "block.ron", trilith::registry()).case("shake");
    against_opensees();
    for (label, more) in [
        ("dashpots beside the contacts", vec![]),
        ("dashpots in the contacts", vec![("c", "0 N*s/m"), ("cv", "20 kN*s/m")]),
    ] {
        println!("{label}");
        let combinations = grid(pairs, &more);
        overhead(&combinations);
        let alone = timed("  alone", &sweep().threads(1).width(1), true, &combinations);
        let lanes = timed("  lanes", &sweep().threads(1), true, &combinations);
        let both = timed("  lanes, all cores", &sweep(), false, &combinations);
        println!(
            "  lanes as alone: {}; all cores as one: {}; digest {:x}",
            same(&alone, &lanes),
            same(&lanes, &both),
            digest(&lanes)
        );
    }
}
