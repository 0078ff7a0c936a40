//! Sweeps: a rigid block on two friction contacts under 5 Hz sines, 20 s at 1 ms, with many values of its
//! friction and amplitude.

use crate::clock::{least, median, timed};
use crate::threads::{Round, Threads, separately};
use crate::{Programs, child, peers};
use serde::{Deserialize, Serialize};
use std::time::Instant;
use trilith::sweep::{Combination, Engine, Outcome, Sweep, SweepError};

/// 1 m × 2 m, 4 t, shaken for 10 s.
pub(crate) const BLOCK: &str = r#"(
    plane: XZ, gravity: "9.81 m/s^2",
    parameters: { "mu": 0.4, "a": 0.3 },
    nodes: { "cg": (0, 0, 1), "left": (-0.5, 0, 0), "right": (0.5, 0, 0) },
    properties: {
        "foot": NLink(kn: "1e8 N/m", ks: "1e8 N/m", mu: "mu"),
        "dashpot": Spring(c1: "20 kN*s/m"),
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

/// Steps of an analysis.
const STEPS: f64 = 20_000.0;

/// Friction coefficient, amplitude in g, duration in s: the largest sway, m, by OpenSeesPy 3.7.1 on
/// flatSliderBearings, Newmark with steps of 0.02 ms. Longer rocking is chaotic: no program agrees with itself at
/// other steps.
const REFERENCE: [(&str, &str, &str, f64); 3] = [
    ("0.2", "0.6", "1 s", 0.019_638_8),
    ("0.6", "0.8", "0.3 s", 0.013_477_8),
    ("0.4", "0.3", "1 s", 0.000_510_1),
];

/// What a sweep costs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BlockSweep {
    /// Analyses of 20 s.
    pub analyses: usize,
    /// CPU time of one analysis on one thread, reading and set-up included, s: one after the other.
    pub alone_s: f64,
    /// The same side by side in vector lanes.
    pub lanes_s: f64,
    /// The fastest of the runs that those are the medians of, alone and in lanes: cores of a shared machine change their
    /// pace from one second to the next, each by itself, and the fastest run had its core for itself most of the time.
    pub fastest_s: [f64; 2],
    /// Of it reading and set-up, s.
    pub setup_s: f64,
    /// What all threads are worth, in lanes.
    pub threads: Threads,
    /// Iterations in a step.
    pub iterations: f64,
    /// Analyses that left the lanes, and those that failed.
    pub left: usize,
    /// Analyses without an outcome.
    pub failed: usize,
    /// Alone, in lanes and on all threads the same bits came out.
    pub same: bool,
    /// Largest difference from the reference sways, as share of them.
    pub error: f64,
}

impl BlockSweep {
    /// Medians of the times of several; of what must hold in each the worst.
    pub(crate) fn median<'a>(all: impl Iterator<Item = &'a Self>) -> Option<Self> {
        let all: Vec<&Self> = all.collect();
        let of = |read: fn(&Self) -> f64| median(all.iter().map(|s| read(s)).collect());
        let first = all.first()?;
        Some(Self {
            alone_s: of(|s| s.alone_s),
            lanes_s: of(|s| s.lanes_s),
            fastest_s: [0, 1]
                .map(|k| least(&all.iter().map(|s| s.fastest_s[k]).collect::<Vec<_>>())),
            setup_s: of(|s| s.setup_s),
            threads: Threads::among(&all.iter().map(|s| &s.threads).collect::<Vec<_>>())?,
            iterations: of(|s| s.iterations),
            left: all.iter().map(|s| s.left).max()?,
            failed: all.iter().map(|s| s.failed).max()?,
            same: all.iter().all(|s| s.same),
            error: all.iter().map(|s| s.error).fold(0.0, f64::max),
            ..(*first).clone()
        })
    }

    /// False where analyses failed, bits differ or a sway is off by more than a thousandth.
    #[must_use]
    pub fn good(&self) -> bool {
        self.failed == 0 && self.same && self.error < 1e-3
    }
}

/// A step of the other programs on the same block, CPU s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Step {
    step_s: f64,
}

/// The sweep and other programs, one after the other. Steps in CPU s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BlockPair {
    /// This program.
    pub own: BlockSweep,
    /// OpenSees on flatSliderBearings: friction follows the normal force.
    pub coupled_s: f64,
    /// OpenSees on uncoupled springs.
    pub uncoupled_s: f64,
    /// Exudyn with Newton's method; none where it is not installed.
    pub exudyn_s: Option<f64>,
}

/// How many analyses of this program fit into one of another, by name: (alone, in lanes).
#[must_use]
pub fn block_ratios(pairs: &[BlockPair]) -> Vec<(&'static str, f64, f64)> {
    type Step = fn(&BlockPair) -> f64;
    let programs: [(&str, Step); 3] = [
        ("OpenSees, coupled friction", |p| p.coupled_s),
        ("OpenSees, uncoupled springs", |p| p.uncoupled_s),
        ("Exudyn, Newton", |p| p.exudyn_s.unwrap_or(f64::NAN)),
    ];
    programs
        .into_iter()
        .map(|(name, theirs)| {
            let over = |own: fn(&BlockSweep) -> f64| {
                median(pairs.iter().map(|p| STEPS * theirs(p) / own(&p.own)).collect())
            };
            (name, over(|s| s.alone_s), over(|s| s.lanes_s))
        })
        .filter(|(_, alone, _)| alone.is_finite())
        .collect()
}

fn set(values: &[(&str, String)]) -> Combination {
    values.iter().map(|(n, v)| ((*n).to_owned(), v.clone())).collect()
}

/// Friction 0.2 to 0.8 by amplitudes 0.2 to 1 g: rest, sliding and rocking.
fn grid(side: usize) -> Vec<Combination> {
    let share = |i: usize| i as f64 / (side.max(2) - 1) as f64;
    let pairs = (0..side).flat_map(|i| (0..side).map(move |j| (i, j)));
    let one = |(i, j)| {
        let (mu, a) = (0.2 + 0.6 * share(i), 0.2 + 0.8 * share(j));
        set(&[("mu", format!("{mu}")), ("a", format!("{a}"))])
    };
    pairs.map(one).collect()
}

fn sweep(duration: &str) -> Sweep {
    let text = BLOCK.replace("duration: \"20 s\"", &format!("duration: \"{duration}\""));
    Sweep::new(text, "block.ron", trilith::registry()).case("shake")
}

type Outcomes = Vec<Result<Outcome, SweepError>>;

/// Everything in the outcomes, digit by digit.
fn text(outcomes: &[Result<Outcome, SweepError>]) -> String {
    let one = |o: &Result<Outcome, SweepError>| match o {
        Ok(o) => format!("{:?} {:?} {:?}", o.outputs, o.energy, o.contact),
        Err(e) => e.to_string(),
    };
    outcomes.iter().map(one).collect::<Vec<_>>().join("\n")
}

fn reference_error() -> f64 {
    let error = |(mu, a, duration, sway): (&str, &str, &str, f64)| {
        let one = set(&[("mu", mu.into()), ("a", a.into())]);
        let outcome = sweep(duration).fixed_steps(50).threads(1).run(&[one]).pop();
        let found = outcome.and_then(Result::ok).and_then(|o| o.outputs.get("sway").copied());
        found.map_or(f64::INFINITY, |p| (p.max.max(-p.min) / sway - 1.0).abs())
    };
    REFERENCE.into_iter().map(error).fold(0.0, f64::max)
}

/// How often the combinations come in the sweeps in lanes: once, they are over in 25 ms on two threads, too soon to tell
/// what several threads are worth; much oftener, no run has all cores at their best pace.
const ROUNDS: usize = 4;

/// How often everything is measured: half a minute, longer than a shared machine keeps one pace.
const TIMES: usize = 54;

/// Measures a sweep of `side` × `side` combinations.
#[must_use]
pub fn sweep_block(side: usize) -> BlockSweep {
    let combinations = grid(side);
    let many = vec![combinations.clone(); ROUNDS].concat();
    let (each, each_of_many) = (combinations.len().max(1) as f64, many.len().max(1) as f64);
    let (mut alone, mut lanes, mut setup) = (vec![], vec![], vec![]);
    let mut rounds = vec![];
    let mut found = None;
    let count = std::thread::available_parallelism().map_or(1, usize::from);
    for _ in 0..TIMES {
        let (one, seconds) = timed(|| sweep("20 s").threads(1).width(1).run(&combinations));
        alone.push(seconds / each);
        let wall = Instant::now();
        let (side_by_side, seconds) = timed(|| sweep("20 s").threads(1).run(&many));
        let one_thread = wall.elapsed().as_secs_f64();
        lanes.push(seconds / each_of_many);
        let wall = Instant::now();
        let together = sweep("20 s").threads(count).run(&many);
        rounds.push(Round {
            one: one_thread,
            all: wall.elapsed().as_secs_f64(),
            separate: separately(&many, count, |part| drop(sweep("20 s").threads(1).run(part))),
        });
        // One step costs nothing beside what leads to it.
        let (_, seconds) = timed(|| sweep("1 ms").threads(1).run(&many));
        setup.push(seconds / each_of_many);
        found = Some((one, side_by_side, together));
    }
    let (one, side_by_side, together) = found.unwrap_or_default();
    let one = text(&one);
    let same =
        |all: &Outcomes| all.chunks(combinations.len().max(1)).all(|round| text(round) == one);
    let good = || side_by_side.iter().flatten();
    let iterations: f64 = good().map(|o| o.iterations as f64).sum();
    BlockSweep {
        analyses: combinations.len(),
        fastest_s: [least(&alone), least(&lanes)],
        alone_s: median(alone),
        lanes_s: median(lanes),
        setup_s: median(setup),
        threads: Threads::of(count, &rounds),
        iterations: iterations / (STEPS * each_of_many),
        left: good().filter(|o| !matches!(o.engine, Engine::Lanes)).count(),
        failed: side_by_side.iter().filter(|o| o.is_err()).count(),
        same: same(&side_by_side) && same(&together),
        error: reference_error(),
    }
}

/// Runs the sweep and the other programs in turn.
///
/// # Errors
/// A sentence where one of them fails; Exudyn may be missing.
pub fn block_beside(programs: Programs<'_>) -> Result<Vec<BlockPair>, String> {
    let Programs { own, python, pairs, .. } = programs;
    let script = |name: &str, words: [&str; 2]| {
        let path = peers::scripts().join(name).display().to_string();
        let all = ["-B", &path, words[0], words[1]].map(str::to_owned);
        child::json::<Step>(python, &all).map(|s| s.step_s)
    };
    let pair = |_| {
        Ok(BlockPair {
            own: child::json(own, &["block".to_owned()])?,
            coupled_s: script("opensees_block.py", ["--links", "coupled"])?,
            uncoupled_s: script("opensees_block.py", ["--links", "uncoupled"])?,
            exudyn_s: script("exudyn_block.py", ["--newton", "full"]).ok(),
        })
    };
    (0..pairs.max(1)).map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_sweep_is_right_and_the_same_however_it_runs() {
        let sweep = sweep_block(2);
        assert!(sweep.good() && sweep.analyses == 4 && sweep.left == 0, "{sweep:?}");
        assert!(sweep.setup_s < sweep.lanes_s && sweep.lanes_s > 0.0);
        assert!(!BlockSweep { error: 0.01, ..sweep }.good());
    }
}
