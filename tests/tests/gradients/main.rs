//! Derivatives of outputs against differences of runs over the same steps.

mod pair;

use std::path::Path;
use trilith::gradient::around;
use trilith::model::ModelText;
use trilith::solvers::assemble;
use trilith::solvers::gradient::{Around, Gradient, GradientOptions, SMALL, gradient, replay};
use trilith::{Model, SolverKind};

/// A model with its derivatives.
struct Case {
    around: Vec<Around>,
    options: GradientOptions,
    found: Gradient,
}

fn text(text: &str, path: &str) -> ModelText {
    ModelText::new(text, Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a text")
}

impl Case {
    fn new(text: &ModelText, solver: SolverKind, set: &[(&str, &str)], by: &[&str]) -> Self {
        let registry = trilith::registry();
        let set: Vec<_> = set.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
        let model = text.read(&registry, &set).expect("a model");
        let by: Vec<String> = by.iter().map(|n| (*n).to_owned()).collect();
        let around = around(text, &registry, &set, &model, &by).expect("models around");
        let case = model.cases.len() - 1;
        let options = GradientOptions { case, solver: Some(solver), dt: None, input: true };
        let system = assemble(&model).expect("a structure");
        let found = gradient(&model, &system, options, &around).expect("derivatives");
        Self { around, options, found }
    }

    fn histories(&self, model: &Model) -> Vec<Vec<f64>> {
        let system = assemble(model).expect("a structure");
        replay(model, &system, self.options, &self.found).expect("a run").histories
    }

    /// How far derivatives are off differences over two millionths of the parameter, as share of the largest: by parameter, of each output.
    fn off(&self) -> Vec<(String, Vec<f64>)> {
        let of = |(j, around): (usize, &Around)| {
            let [low, high] = &around.close;
            let [low, high] = [self.histories(low), self.histories(high)];
            let h = 2.0 * SMALL * around.of.step;
            let off = |o: usize| {
                let given = &self.found.outputs[o].by[j];
                let quotient = |i: usize| (high[o][i] - low[o][i]) / h;
                let most = given.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                // A parameter that hardly moves an output is told to the rounding of that output.
                let size =
                    self.found.outputs[o].history.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                let most = most.max(1e-2 * size / around.of.value.abs());
                let apart = |i: usize| (given[i] - quotient(i)).abs();
                (0..given.len()).map(apart).fold(0.0, f64::max) / most
            };
            (around.of.name.clone(), (0..self.found.outputs.len()).map(off).collect())
        };
        self.around.iter().enumerate().map(of).collect()
    }

    /// The same by one parameter over four runs up to two thousandths beside, whose rounding counts for a thousandth as much.
    fn far_off(&self, j: usize) -> Vec<f64> {
        let around = &self.around[j];
        let all: Vec<_> = around.near.iter().map(|model| self.histories(model)).collect();
        let weights = [1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0];
        let off = |o: usize| {
            let output = &self.found.outputs[o];
            let largest = |x: &[f64]| x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let most = largest(&output.by[j]);
            let most = most.max(1e-2 * largest(&output.history) / around.of.value.abs());
            let quotient = |i: usize| {
                weights.iter().zip(&all).map(|(w, run)| w * run[o][i]).sum::<f64>() / around.of.step
            };
            let apart = |i: usize| (output.by[j][i] - quotient(i)).abs();
            (0..output.by[j].len()).map(apart).fold(0.0, f64::max) / most
        };
        (0..self.found.outputs.len()).map(off).collect()
    }

    /// The same of the heat of every link, as share of the largest derivative of one.
    fn heat_off(&self) -> Vec<(String, f64)> {
        let of = |(j, around): (usize, &Around)| {
            let [low, high] = [0, 1].map(|side| {
                let model = &around.close[side];
                let system = assemble(model).expect("a structure");
                replay(model, &system, self.options, &self.found).expect("a run").heat
            });
            let h = 2.0 * SMALL * around.of.step;
            let given = |l: usize| self.found.heat[l].by[j];
            let all = 0..self.found.heat.len();
            // A parameter that hardly moves the heat is told to the rounding of that heat.
            let total = self.found.all_heat().0;
            let most = all.clone().map(|l| given(l).abs()).fold(0.0, f64::max);
            let most = most.max(1e-2 * total / around.of.value.abs());
            let apart = |l: usize| (given(l) - (high[l] - low[l]) / h).abs();
            (around.of.name.clone(), all.map(apart).fold(0.0, f64::max) / most)
        };
        self.around.iter().enumerate().map(of).collect()
    }

    /// The same of the energy that loads have put in.
    fn input_off(&self) -> Vec<(String, f64)> {
        let of = |(j, around): (usize, &Around)| {
            let [low, high] = [0, 1].map(|side| {
                let model = &around.close[side];
                let system = assemble(model).expect("a structure");
                replay(model, &system, self.options, &self.found).expect("a run").input
            });
            let h = 2.0 * SMALL * around.of.step;
            let (value, by) = self.found.input.as_ref().expect("it is asked for");
            let given = by[j];
            let most = given.abs().max(1e-2 * value.abs() / around.of.value.abs());
            (around.of.name.clone(), (given - (high - low) / h).abs() / most)
        };
        self.around.iter().enumerate().map(of).collect()
    }

    /// Heat is that of a run.
    fn has_the_heat_of_a_run(&self, model: &Model) {
        let run = trilith::Analysis::new(model).expect("a structure");
        let options = trilith::RunOptions {
            case: self.options.case,
            solver: self.options.solver,
            ..trilith::RunOptions::default()
        };
        let run = run.run(options).expect("a run").result;
        assert!(!run.link_energy.is_empty());
        for (element, energy) in &run.link_energy {
            let name = &model.elements[*element].name;
            let own = self.found.heat.iter().find(|h| h.link == *name).expect("the link");
            let heat = energy.hysteretic + energy.viscous;
            assert!((own.heat - heat).abs() <= 1e-9 * heat.abs(), "{name}: {} {heat}", own.heat);
        }
        let (input, _) = self.found.input.as_ref().expect("it is asked for");
        assert!((input / run.energy.input - 1.0).abs() < 1e-9);
        let sum = run.energy.link_hysteretic + run.energy.link_viscous;
        assert!((self.found.all_heat().0 / sum - 1.0).abs() < 1e-9);
    }
}

/// The isolated frame with links in equilibrium to rounding: differences of runs are no better than that.
fn frame() -> ModelText {
    let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(FRAME);
    let whole = std::fs::read_to_string(whole).expect("a file");
    let tight = "dt: \"5 ms\",\n            link_tolerance: 1e-14,";
    assert!(whole.contains("dt: \"5 ms\","));
    text(&whole.replace("dt: \"5 ms\",", tight), FRAME)
}

const FRAME: &str = "../models/isolated_frame.ron";
const ASKED: [&str; 6] = ["base_x", "base_y", "roof_x", "roof_y", "isolator_a_x", "isolator_a_y"];

/// Six outputs by eight parameters, of links, of the structure, of its geometry, of loads.
#[test]
fn the_isolated_frame_moves_as_runs_beside_it_do() {
    let by =
        ["radius", "mu_slow", "mu_fast", "damper", "brace_damper", "floor_mass", "ax", "storey"];
    let case = Case::new(&frame(), SolverKind::Hht, &[("duration", "1.6 s")], &by);
    for (name, off) in case.off() {
        for (output, off) in case.found.outputs.iter().zip(off) {
            let asked = ASKED.contains(&output.name.as_str());
            assert!(off < if asked { 1e-6 } else { 1e-4 }, "{} by {name}: {off:e}", output.name);
        }
    }
    for (name, off) in case.heat_off().into_iter().chain(case.input_off()) {
        assert!(off < 1e-6, "energy by {name}: {off:e}");
    }
    let (registry, set) = (trilith::registry(), [("duration".to_owned(), "1.6 s".to_owned())]);
    case.has_the_heat_of_a_run(&frame().read(&registry, &set).expect("a model"));
}

/// On the basis of the run, parameters of links and loads.
#[test]
fn the_isolated_frame_moves_so_under_fna() {
    let by = ["radius", "mu_fast", "damper", "ax"];
    let case = Case::new(&frame(), SolverKind::Fna, &[("duration", "1.2 s")], &by);
    for (name, off) in case.off() {
        for (output, off) in case.found.outputs.iter().zip(off) {
            assert!(off < 1e-5, "{} by {name}: {off:e}", output.name);
        }
    }
    for (name, off) in case.heat_off().into_iter().chain(case.input_off()) {
        assert!(off < 1e-6, "energy by {name}: {off:e}");
    }
}

/// The isolated frame with other words in its case and in its isolators.
fn frame_with(case: &str, isolator: &str) -> ModelText {
    let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(FRAME);
    let whole = std::fs::read_to_string(whole).expect("a file");
    let (step, stiffness) = ("dt: \"5 ms\",", "kn: \"1e9 N/m\",");
    assert!(whole.contains(step) && whole.contains(stiffness));
    let whole = whole.replace(step, &format!("{step} link_tolerance: 1e-14, {case}"));
    text(&whole.replace(stiffness, &format!("{stiffness} {isolator}")), FRAME)
}

/// Masses, stiffness and geometry move modes, with dashpots and modal damping that couple them.
#[test]
fn modes_move_with_the_structure() {
    for solver in [SolverKind::Fna, SolverKind::RitzHht] {
        let by = ["storey", "damper"];
        let case = Case::new(&frame_with("", ""), solver, &[("duration", "1.2 s")], &by);
        for (name, off) in case.off() {
            for (output, off) in case.found.outputs.iter().zip(off) {
                // Of what hardly moves, as the twist, differences of runs are rounding.
                let asked = ASKED.contains(&output.name.as_str());
                let most = if asked { 1e-5 } else { 1e-4 };
                assert!(off < most, "{} by {name}, {solver:?}: {off:e}", output.name);
            }
        }
        for (name, off) in case.heat_off().into_iter().chain(case.input_off()) {
            assert!(off < 1e-5, "energy by {name}, {solver:?}: {off:e}");
        }
    }
}

/// By a parameter that leads no link to another branch in four parts in a thousand, differences are good to many digits; with effective stiffnesses
/// in the modes as well, where one exponential of all of them makes a step. These are those of the pendulums after slip: forces go
/// against k_e d there, and stiffer ones leave less of both than the last digits of runs, which are others on other processors.
#[test]
fn masses_move_modes_to_many_digits() {
    for (isolator, solver) in [
        ("", SolverKind::Fna),
        ("", SolverKind::RitzHht),
        ("effective_stiffness: \"100 kN/m\",", SolverKind::Fna),
    ] {
        let by = ["floor_mass"];
        let case = Case::new(&frame_with("", isolator), solver, &[("duration", "0.8 s")], &by);
        for (output, off) in case.found.outputs.iter().zip(case.far_off(0)) {
            assert!(off < 1e-6, "{} under {solver:?}, {isolator}: {off:e}", output.name);
        }
    }
}

/// In a span that is not all there is derivatives are those of HHT to what the span lacks: with more vectors they come nearer.
#[test]
fn derivatives_in_a_cut_span_come_nearer_with_its_vectors() {
    let by = ["floor_mass", "storey"];
    let set = [("duration", "1.2 s")];
    let exact = Case::new(&frame_with("alpha: 0,", ""), SolverKind::Hht, &set, &by).found;
    let off = |vectors: usize| {
        let few = format!("basis: Ritz(vectors: {vectors}, enrich: false),");
        let found = Case::new(&frame_with(&few, ""), SolverKind::Fna, &set, &by).found;
        let largest = |of: &Gradient, o: usize, j: usize| of.outputs[o].max.by[j];
        let outputs = ["base_x", "roof_x", "drift1_x"];
        let at = |name: &&str| exact.outputs.iter().position(|o| o.name == *name).expect("it");
        let pairs = outputs.iter().flat_map(|o| [(at(o), 0), (at(o), 1)]);
        let off =
            |(o, j): (usize, usize)| (largest(&found, o, j) / largest(&exact, o, j) - 1.0).abs();
        pairs.map(off).fold(0.0, f64::max)
    };
    let [few, more] = [24, 48].map(off);
    assert!(few < 0.2 && more < 0.02, "{few} {more}");
}

/// x = x₀ cos ωt: ∂x/∂m = x₀ ωt sin(ωt) / 2m, ∂x/∂k = −x₀ ωt sin(ωt) / 2k, exact in steps of any length.
#[test]
fn a_swing_by_its_mass_and_its_spring() {
    let file = r#"(
        plane: XZ,
        parameters: { "lump": "3 kg", "stiff": "120 N/m" },
        nodes: { "a": (0, 0, 0) },
        supports: { "a": (Uz, Ry) },
        elements: {
            "mass": Mass(node: "a", mass: "lump"), "spring": Spring(node: "a", k2: "stiff"),
            "far": Gap(node: "a", k: "1 kN/m", opening: 1),
        },
        cases: { "swing": Dynamic(
            duration: 4, dt: 0.05, solver: Fna, step: Fixed(substeps: 1),
            initial: [(node: "a", dof: Ux, displacement: 0.02)],
        ) },
        outputs: { "x": Displacement(node: "a", dof: Ux), "v": Velocity(node: "a", dof: Ux) },
    )"#;
    let found = Case::new(&text(file, "swing.ron"), SolverKind::Fna, &[], &["lump", "stiff"]).found;
    let (m, k, start) = (3.0_f64, 120.0_f64, 0.02);
    let w = (k / m).sqrt();
    for (i, t) in found.time.iter().enumerate() {
        let (sin, cos) = (w * t).sin_cos();
        // By ω, which goes as √(k/m).
        let by = [-start * t * sin, -start * (sin + w * t * cos)];
        for (o, by) in by.into_iter().enumerate() {
            let size = start * [1.0, w][o] * (1.0 + w * t);
            let [of_m, of_k] = [0, 1].map(|j| found.outputs[o].by[j][i]);
            assert!((of_m - by * -0.5 * w / m).abs() < 1e-9 * size / m, "{t}: {of_m}");
            assert!((of_k - by * 0.5 * w / k).abs() < 1e-9 * size / k, "{t}: {of_k}");
        }
    }
}

/// Two like masses that move alike, and a stop between them that is just open, or just closed: by the spring of one alone
/// there are two derivatives, and that is told.
#[test]
fn links_that_are_about_to_change_are_named() {
    let alike = |opening: &str| {
        let file = format!(
            r#"(
            plane: XZ,
            parameters: {{ "k": "10 kN/m", "other": "10 kN/m" }},
            nodes: {{ "g": (0, 0, 0), "a": (1, 0, 0), "b": (2, 0, 0), "w": (3, 0, 0) }},
            supports: {{ "g": Fixed, "w": Fixed, "a": (Uz, Ry), "b": (Uz, Ry) }},
            elements: {{
                "ma": Mass(node: "a", mass: "100 kg"), "mb": Mass(node: "b", mass: "100 kg"),
                "ka": Spring(nodes: ("g", "a"), k1: "k"), "kb": Spring(nodes: ("b", "w"), k1: "other"),
                "stop": Gap(nodes: ("a", "b"), k: "1 MN/m", opening: "{opening}"),
            }},
            functions: {{ "wave": Sine(amplitude: "1 m/s^2", frequency: 1) }},
            cases: {{ "shake": Dynamic(
                duration: 1, dt: 0.01, solver: Hht, step: Fixed(substeps: 1),
                base: [(direction: X, function: "wave")],
            ) }},
            outputs: {{ "a": Displacement(node: "a", dof: Ux) }},
        )"#
        );
        Case::new(&text(&file, "alike.ron"), SolverKind::Hht, &[], &["k", "other"]).found
    };
    let found = alike("0 m");
    assert_eq!(found.bends.len(), 1, "{:?}", found.bends);
    assert_eq!(found.bends[0].link, "stop");
    assert!(found.bends[0].count > 90, "{:?}", found.bends);
    assert_eq!(alike("1 m").bends, []);
}
