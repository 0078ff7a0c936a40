//! Rules for time from another crate: one against a closed form and the other solvers, one that is a built-in solver
//! written once more, and wrong ones.

use serde::Deserialize;
use std::sync::Arc;
use trilith::element::{
    Card, Category, Described, Exercise, Factor, Integrator, LinearStep, LinearStructure, Motion,
    MotionMut, NodeCount, Parameters, Register, Values,
};
use trilith::solvers::Status;
use trilith::{Analysis, Model, Registry, Run, RunOptions};
use trilith_thirdparty_example::CentralDifference;

fn kinds() -> Registry {
    let mut kinds = trilith::registry();
    trilith_thirdparty_example::register(&mut kinds);
    kinds.solver::<AlphaMethod>();
    kinds
}

fn read(text: &str) -> Model {
    trilith::read_text(text, "solvers.ron", &kinds(), &[]).unwrap_or_else(|e| panic!("{e:?}"))
}

fn run(model: &Model, solver: &str) -> Run {
    let last = model.cases.len() - 1;
    let solver = Some(model.solver(solver, last).expect("a solver"));
    let options = RunOptions { case: last, solver, ..RunOptions::default() };
    Analysis::new(model).and_then(|analysis| analysis.run(options)).expect("a run")
}

/// Two masses between springs, one of which slides, under a pulse; every direction that is free has a mass.
fn chain(solver: &str, step: &str, damping: &str) -> String {
    format!(
        r#"(
            nodes: {{ "a": (0, 0, 0), "b": (1, 0, 0), "wall": (2, 0, 0) }},
            supports: {{
                "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz), "wall": Fixed,
            }},
            elements: {{
                "mass a": Mass(node: "a", mass: "1 t"),
                "mass b": Mass(node: "b", mass: "2 t"),
                "spring": Spring(nodes: ("a", "b"), k1: "400 kN/m", c1: "2 kN*s/m"),
                "tie": Spring(nodes: ("b", "wall"), k1: "300 kN/m"),
                "stop": Gap(nodes: ("b", "wall"), k: "900 kN/m", opening: "5 mm"),
                "yields": Wen(nodes: ("a", "b"), k: "200 kN/m", fy: "1.5 kN", ratio: 0.02, axis: U1),
                "damper": Dashpot(nodes: ("a", "wall"), c: "1.5 kN*s/m", axis: U1),
            }},
            damping: {damping},
            functions: {{ "pulse": HalfSine(amplitude: "3 m/s^2", duration: "0.3 s") }},
            cases: {{ "shake": Dynamic(
                duration: "2 s", dt: "5 ms", base: [(direction: X, function: "pulse")],
                solver: {solver}, step: {step},
            ) }},
            outputs: {{
                "a": Displacement(node: "a", dof: Ux),
                "b": Displacement(node: "b", dof: Ux),
                "v": Velocity(node: "a", dof: Ux),
                "stop": LinkForce(link: "stop", axis: U1),
                "yields": LinkForce(link: "yields", axis: U1),
            }},
        )"#
    )
}

/// Largest difference of an output over time, of its largest value.
fn apart(one: &Run, two: &Run, output: &str) -> f64 {
    let [a, b] = [one, two].map(|run| run.history(output).expect("an output"));
    assert_eq!(a.len(), b.len());
    let size = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
}

const OUTPUTS: [&str; 5] = ["a", "b", "v", "stop", "yields"];

/// One mass swings free: central differences have sin(ω′Δt/2) = ωΔt/2.
#[test]
fn a_free_swing_has_the_period_of_central_differences() {
    let (k, m, dt) = (40e3_f64, 1e3, 0.1);
    let text = format!(
        r#"(
            nodes: {{ "m": (0, 0, 0) }},
            supports: {{ "m": (Uy, Uz, Rx, Ry, Rz) }},
            elements: {{
                "mass": Mass(node: "m", mass: {m}), "spring": Spring(node: "m", k2: {k}),
                "stop": Gap(node: "m", k: 1, opening: "1 m", axis: U2),
            }},
            cases: {{ "swing": Dynamic(
                duration: "20 s", dt: {dt}, step: Fixed(substeps: 1), solver: CentralDifference, energy_limit: 0.5,
                initial: [(node: "m", dof: Ux, displacement: "1 cm")],
            ) }},
            outputs: {{ "u": Displacement(node: "m", dof: Ux) }},
        )"#
    );
    let run = run(&read(&text), "CentralDifference");
    assert_eq!(run.result.solver, "CentralDifference");
    let own = 2.0 / dt * ((k / m).sqrt() * dt / 2.0).asin();
    for (t, u) in run.time().iter().zip(run.history("u").expect("an output")) {
        assert!((u - 0.01 * (own * t).cos()).abs() < 1e-9, "{t}: {u}");
    }
}

#[test]
fn central_differences_agree_with_the_other_solvers_on_links() {
    for damping in ["None", "Rayleigh(mass: 0.3, stiffness: 0.001)", "Modal(ratio: 0.03)"] {
        let fine = read(&chain("Hht", "Adaptive(tolerance: 1e-7)", damping));
        let truth = run(&fine, "hht");
        for step in ["Fixed(substeps: 100)", "Adaptive(tolerance: 1e-6)"] {
            let model = read(&chain("CentralDifference", step, damping));
            let found = run(&model, "CentralDifference");
            assert!(matches!(found.result.status, Status::Converged), "{:?}", found.result.status);
            for output in OUTPUTS {
                let off = apart(&truth, &found, output);
                assert!(off < 2e-3, "{damping}, {step}: {output} is {off:.1e} off");
            }
            assert!(truth.peak("stop").expect("an output").min < -100.0);
        }
    }
}

#[test]
fn a_step_too_long_for_central_differences_is_no_answer() {
    let model =
        read(&chain("CentralDifference", "Fixed(substeps: 1)", "None").replace("5 ms", "0.2 s"));
    let found = run(&model, "CentralDifference");
    assert!(!matches!(found.result.status, Status::Converged), "{:?}", found.result.status);
}

#[test]
fn a_direction_without_mass_is_told_by_its_name() {
    let text = chain("CentralDifference", "Fixed(substeps: 1)", "None")
        .replace(r#""mass a": Mass(node: "a", mass: "1 t"),"#, "")
        .replace(r#", c1: "2 kN*s/m""#, "");
    let model = read(&text);
    let told = trilith::run(&model, "shake").expect_err("no mass").to_string();
    assert!(
        told.starts_with("solver CentralDifference: ") && told.contains("Ux of \"a\""),
        "{told}"
    );
}

/// HHT-α in the words of the contract.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
struct AlphaMethod {
    /// damping of high frequencies
    #[parameter("α", unit = "1", range = Within(-1.0 / 3.0, 0.0), default = 0.0)]
    alpha: f64,
    /// on Ritz vectors
    #[parameter]
    on_basis: bool,
}

impl Described for AlphaMethod {
    const CARD: Card = Card::new("AlphaMethod", Category::Solver, "HHT-α once more.")
        .nodes(NodeCount::NONE)
        .parameters(Self::PARAMETERS)
        .law("M a₁ = (1+α) s₁ − α s₀")
        .source("Hilber, Hughes, Taylor 1977")
        .example("solver: AlphaMethod(alpha: -0.1)")
        .exercise(Exercise::NONE);
}

impl Integrator for AlphaMethod {
    fn step(
        &self,
        structure: &dyn LinearStructure,
        dt: f64,
    ) -> Result<Box<dyn LinearStep>, String> {
        let alpha = self.alpha;
        let (gamma, beta) = (0.5 - alpha, 0.25 * (1.0 - alpha).powi(2));
        let w = 1.0 + alpha;
        let factor = structure.factorise(1.0, w * gamma * dt, w * beta * dt * dt)?;
        Ok(Box::new(AlphaStep { dt, alpha, gamma, beta, factor }))
    }

    fn on_basis(&self) -> bool {
        self.on_basis
    }
}

struct AlphaStep {
    dt: f64,
    alpha: f64,
    gamma: f64,
    beta: f64,
    factor: Box<dyn Factor>,
}

impl LinearStep for AlphaStep {
    fn advance(
        &mut self,
        structure: &dyn LinearStructure,
        from: Motion<'_>,
        force: [&[f64]; 2],
        to: MotionMut<'_>,
    ) {
        let Self { dt, alpha, gamma, beta, .. } = *self;
        for i in 0..structure.order() {
            to.u[i] = from.u[i] + dt * from.v[i] + dt * dt * (0.5 - beta) * from.a[i];
            to.v[i] = from.v[i] + dt * (1.0 - gamma) * from.a[i];
            to.a[i] = (1.0 + alpha) * force[1][i] - alpha * force[0][i];
        }
        for (s, u, v) in [(-1.0 - alpha, &*to.u, &*to.v), (alpha, from.u, from.v)] {
            structure.stiffness(s, u, to.a);
            structure.damping(s, v, to.a);
        }
        self.factor.solve(to.a);
        for i in 0..structure.order() {
            to.u[i] += beta * dt * dt * to.a[i];
            to.v[i] += gamma * dt * to.a[i];
        }
    }
}

/// The same rule, the same steps: what differs is rounding.
#[test]
fn a_built_in_rule_written_through_the_door_is_that_rule() {
    for damping in ["None", "Rayleigh(mass: 0.3, stiffness: 0.001)", "Modal(ratio: 0.03)"] {
        for alpha in ["0", "-0.1"] {
            for step in ["Fixed(substeps: 2)", "Adaptive(tolerance: 1e-4)"] {
                for (own, basis) in [("hht", "false"), ("ritz-hht", "true")] {
                    let custom = format!("AlphaMethod(alpha: {alpha}, on_basis: {basis})");
                    let text = chain(&custom, step, damping);
                    let text = text.replace("solver:", &format!("alpha: {alpha}, solver:"));
                    let model = read(&text);
                    let [found, expected] = ["AlphaMethod", own].map(|s| run(&model, s));
                    let [a, b] = [&found, &expected].map(|run| run.result.work.substeps);
                    assert!(step.starts_with("Adaptive") || a == b);
                    for output in OUTPUTS {
                        let off = apart(&expected, &found, output);
                        assert!(
                            off < 1e-7,
                            "{damping}, {alpha}, {step}, {own}: {output} {off:.1e}"
                        );
                    }
                    let totals = [&found, &expected].map(|run| run.result.energy.input);
                    assert!((totals[0] - totals[1]).abs() <= 1e-7 * totals[1].abs(), "{totals:?}");
                }
            }
        }
    }
}

#[test]
fn a_solver_is_written_out_and_read_again() {
    let text = chain("AlphaMethod(alpha: -0.2)", "Fixed(substeps: 2)", "None");
    let model = read(&text);
    let again = read(&trilith::model::resolved(&model));
    assert_eq!(model.solvers[0].values, again.solvers[0].values);
    assert_eq!(model.solver("AlphaMethod", 0), again.solver("AlphaMethod", 0));
    // Those that need no parameter can be asked for though no case names them.
    assert!(model.solver("CentralDifference", 0).is_some());
    assert!(model.solver("CentralDiference", 0).is_none());
    let [one, two] = [&model, &again].map(|model| trilith::run(model, "shake").expect("a run"));
    assert_eq!(one.history("a").expect("an output"), two.history("a").expect("an output"));
}

#[test]
fn a_wrong_name_or_field_of_a_foreign_solver_is_answered() {
    let told = |solver: &str| {
        let text = chain(solver, "Fixed(substeps: 2)", "None");
        match trilith::read_text(&text, "solvers.ron", &kinds(), &[]) {
            Ok(_) => panic!("{solver}"),
            Err(errors) => format!("{errors:?}"),
        }
    };
    let name = told("CentralDiference");
    assert!(name.contains("there is no solver `CentralDiference`"), "{name}");
    assert!(name.contains("did you mean `CentralDifference`"), "{name}");
    let field = told("CentralDifference(alpha: 0)");
    assert!(field.contains("solver `CentralDifference` has no field `alpha`"), "{field}");
    let range = told("AlphaMethod(alpha: 0.5)");
    assert!(range.contains("`alpha` = 0.5"), "{range}");
    assert!(told("Mass(mass: 1)").contains("there is no solver `Mass`"));
}

#[test]
fn a_run_stops_and_goes_on_with_a_foreign_solver() {
    let model = read(&chain("AlphaMethod(alpha: -0.1)", "Adaptive(tolerance: 1e-4)", "None"));
    let analysis = Analysis::new(&model).expect("a structure");
    let whole = analysis.run(RunOptions::default()).expect("a run");
    let part = RunOptions { until: Some(0.7), ..RunOptions::default() };
    let part = analysis.run(part).expect("a run");
    let rest = RunOptions { from: Some(part.result.end), ..RunOptions::default() };
    let rest = analysis.run(rest).expect("a run");
    let [a, b] =
        [&whole, &rest].map(|run| *run.history("a").expect("an output").last().expect("a value"));
    assert_eq!(a.to_bits(), b.to_bits());
}

/// What a wrong rule does.
#[derive(Clone, Copy, Debug)]
enum Wrong {
    Bent,
    Silent,
    Lopsided,
    Failing,
}

/// Central differences with something wrong.
#[derive(Debug)]
struct Odd(Wrong);

struct OddStep(Wrong, Box<dyn LinearStep>);

impl Integrator for Odd {
    fn step(
        &self,
        structure: &dyn LinearStructure,
        dt: f64,
    ) -> Result<Box<dyn LinearStep>, String> {
        if matches!(self.0, Wrong::Failing) {
            return Err("no step for such a structure".into());
        }
        Ok(Box::new(OddStep(self.0, CentralDifference {}.step(structure, dt)?)))
    }
}

impl LinearStep for OddStep {
    fn advance(
        &mut self,
        structure: &dyn LinearStructure,
        from: Motion<'_>,
        force: [&[f64]; 2],
        to: MotionMut<'_>,
    ) {
        let kept = to.a[0];
        let MotionMut { u, v, a } = to;
        self.1.advance(structure, from, force, MotionMut { u, v, a });
        match self.0 {
            Wrong::Bent => v[0] += v[0] * v[0],
            Wrong::Silent => a[0] = kept,
            Wrong::Lopsided => v[0] += 0.5 * a[1] * 1e-3,
            Wrong::Failing => {}
        }
    }
}

const ODD: Card = CentralDifference::CARD.named("Odd");

#[test]
fn a_rule_that_is_none_is_refused_by_name() {
    for (wrong, words) in [
        (Wrong::Bent, "its step is not linear in motion and forces: the velocity"),
        (Wrong::Silent, "the acceleration of coordinate 1 of 2 unwritten"),
        (
            Wrong::Lopsided,
            "the velocity that a force at one link gives another is not that of the reverse",
        ),
        (Wrong::Failing, "no step for such a structure"),
    ] {
        let mut kinds = kinds();
        kinds.add_solver(&ODD, Arc::new(move |_: &Values| Ok(Box::new(Odd(wrong)))));
        let text = chain("Odd", "Fixed(substeps: 1)", "None");
        let model = trilith::read_text(&text, "solvers.ron", &kinds, &[]).expect("a model");
        let told = trilith::run(&model, "shake").expect_err("no rule").to_string();
        assert!(told.starts_with("solver Odd: ") && told.contains(words), "{wrong:?}: {told}");
    }
}
