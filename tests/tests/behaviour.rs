//! What a run does when it fails, when supports move, and with other settings of the link equations.

use serde::Deserialize;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Kinematics, Link, NodeCount,
    Parameters, Register, Response,
};
use trilith_model::{Analysis, Kernel, SolverKind, StepControl};
use trilith_solvers::{LawFault, Observer, RunOptions, Sample, Status, run};
use trilith_system::System;
use trilith_tests::{Trace, parse, registry, set_step, shipped, trace, trace_with};

/// A spring that has no force beyond a limit: what a broken law of a third party may do.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
struct Brittle {
    /// stiffness
    #[parameter("k", unit = "N/m", range = Positive)]
    k: f64,
    /// where it breaks
    #[parameter("l", unit = "m", range = Positive)]
    limit: f64,
}

impl Described for Brittle {
    const CARD: Card =
        Card::new("Brittle", Category::Link, "Spring without a force beyond a limit.")
            .nodes(NodeCount::exactly(1))
            .parameters(Self::PARAMETERS)
            .law("f = k d, not a number for |d| > l")
            .source("made for a test")
            .example("Brittle(node: \"a\", k: 1, limit: 1)")
            .exercise(Exercise::NONE);
}

impl Link for Brittle {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U1])
    }
    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }
    fn respond(&self, at: &Kinematics<'_>, _: &[f64], _: &mut [f64], out: &mut Response<'_>) {
        let broken = at.d[0].abs() > self.limit;
        out.f[0] = if broken { f64::NAN } else { self.k * at.d[0] };
        out.k[0] = self.k;
        out.energy.stored = 0.5 * self.k * at.d[0] * at.d[0];
    }
}

#[test]
fn a_run_whose_law_gives_out_says_where_and_keeps_the_last_good_state() {
    let text = r#"(
        nodes: { "a": (0, 0, 0) },
        supports: { "a": (Ux, Uy, Rx, Ry, Rz) },
        elements: {
            "m": Mass(node: "a", mass: 1),
            "thread": Brittle(node: "a", k: 100, limit: 0.5),
        },
        cases: { "pull": Dynamic(duration: 1, dt: 0.01,
            initial: [(node: "a", dof: Uz, velocity: 10)]) },
        outputs: { "u": Displacement(node: "a", dof: Uz) },
    )"#;
    let mut kinds = registry();
    kinds.link::<Brittle>();
    let model =
        trilith_model::read_text(text, std::path::Path::new("brittle.ron"), &kinds, &[]).unwrap();
    let system = System::without_axial_forces(&model).unwrap();
    for solver in SolverKind::ALL {
        let (mut seen, mut told) = (Trace::default(), Told { nodes: 1, ..Told::default() });
        let options = RunOptions { solver: Some(solver), ..RunOptions::default() };
        let result = run(&model, &system, options, &mut [&mut seen, &mut told]).unwrap();
        let Status::Law { t, link, fault } = &result.status else {
            panic!("{}: {:?}", solver.name(), result.status)
        };
        // sin(10 t) reaches 0.5 at t = 0.05236.
        assert!((t - 0.052_36).abs() < 1e-4, "{}: stopped at {t}", solver.name());
        assert_eq!(link, "thread");
        let named =
            matches!(fault, LawFault::NotFinite { quantity, .. } if quantity == "force of U1");
        assert!(named, "{fault:?}");
        assert!((result.end.displacement[0] - 0.5).abs() < 1e-4, "{:?}", result.end.displacement);
        assert_eq!(result.end.displacement[0].to_bits(), seen.last[0].to_bits());
        assert!(seen.history.len() >= 5, "the history up to the failure is kept");
        // The end is shown where it happened, between two output times.
        let (end, u) = told.end.unwrap();
        assert!(told.last == Some((end, u)) && (end - t).abs() < 1e-3 && end > 0.05, "{end}");
        assert_eq!((told.steps, told.outputs), (Some(100), seen.history.len()));
    }
}

/// What an observer is told beside the samples, in its order.
#[derive(Default)]
struct Told {
    steps: Option<usize>,
    outputs: usize,
    /// Time, and sum of the displacements.
    last: Option<(f64, f64)>,
    end: Option<(f64, f64)>,
    nodes: usize,
    /// A pose on the way, and its displacements.
    earlier: Option<(Vec<f64>, Vec<f64>)>,
}

impl Told {
    fn look(&mut self, s: &Sample<'_>) -> Option<(f64, f64)> {
        let mut u = vec![0.0; 6 * self.nodes];
        s.shape.displacements(&[s.shape.pose()], &mut u);
        if let Some((pose, before)) = &self.earlier {
            // Several at once, and later than they were there, are what each is.
            let mut both = vec![0.0; 2 * u.len()];
            s.shape.displacements(&[pose.clone(), s.shape.pose()], &mut both);
            let each = before.iter().chain(&u);
            assert!(both.iter().zip(each).all(|(x, y)| (x - y).abs() <= 1e-12), "{both:?}");
        }
        if self.outputs == 20 {
            self.earlier = Some((s.shape.pose(), u.clone()));
        }
        Some((s.t, u.iter().sum()))
    }
}

impl Observer for Told {
    fn start(&mut self, steps: usize) {
        assert!(self.steps.is_none() && self.last.is_none(), "once, before the first sample");
        self.steps = Some(steps);
    }

    fn sample(&mut self, s: &Sample<'_>) {
        assert!(self.end.is_none(), "nothing after the end");
        self.outputs += usize::from(s.output_step.is_some());
        self.last = self.look(s);
    }

    fn end(&mut self, s: &Sample<'_>) {
        assert!(self.end.is_none(), "once");
        self.end = self.look(s);
    }
}

#[test]
fn an_observer_is_told_of_the_start_and_shown_the_end_again() {
    let (model, system) = shipped("rigid_block.ron", &[]);
    let gravity = 0;
    let shake = model.cases.len() - 1;
    for solver in SolverKind::ALL {
        for (case, steps) in [(gravity, 0), (shake, 40)] {
            let mut told = Told { nodes: model.nodes.len(), ..Told::default() };
            let dt = Some(0.002);
            let until = Some(0.08);
            let options =
                RunOptions { case, solver: Some(solver), dt, until, ..RunOptions::default() };
            run(&model, &system, options, &mut [&mut told]).unwrap();
            assert_eq!((told.steps, told.outputs), (Some(steps), steps + 1));
            assert!(told.end.is_some() && told.end == told.last, "{:?}", told.end);
            assert_eq!(told.earlier.is_some(), steps > 0);
        }
    }
}

/// Keeps (value, rate) of the first output.
#[derive(Default)]
struct Looks {
    at_rates: bool,
    seen: Vec<(f64, f64)>,
}

impl Observer for Looks {
    fn sample(&mut self, s: &Sample<'_>) {
        self.seen.push((s.values[0], s.rates[0]));
    }

    fn wants_rates(&self) -> bool {
        self.at_rates
    }
}

#[test]
fn rates_of_outputs_are_made_where_an_observer_looks_at_them() {
    let (model, system) = shipped("rigid_block.ron", &[]);
    let of = |at_rates: &[bool]| -> Vec<Looks> {
        let looks = |at_rates: &bool| Looks { at_rates: *at_rates, ..Looks::default() };
        let mut all: Vec<Looks> = at_rates.iter().map(looks).collect();
        let mut observers: Vec<&mut dyn Observer> =
            all.iter_mut().map(|o| o as &mut dyn Observer).collect();
        let case = model.cases.len() - 1;
        let options = RunOptions { case, until: Some(0.5), ..RunOptions::default() };
        run(&model, &system, options, &mut observers).unwrap();
        all
    };
    let (blind, mixed) = (of(&[false]), of(&[false, true]));
    assert!(blind[0].seen.len() > 10 && blind[0].seen.iter().all(|(_, rate)| rate.is_nan()));
    assert!(mixed[1].seen.iter().all(|(_, rate)| rate.is_finite()));
    assert!(mixed[1].seen.iter().any(|(_, rate)| *rate != 0.0));
    let values = |l: &Looks| l.seen.iter().map(|(y, _)| y.to_bits()).collect::<Vec<_>>();
    assert!(mixed.iter().all(|l| values(l) == values(&blind[0])), "the same values");
}

/// A rigid column between a moving support and a mass: u relative to the ground equals the response to
/// the same motion as uniform base acceleration.
#[test]
fn a_moving_support_gives_what_base_acceleration_gives() {
    let text = |case: &str| {
        format!(
            r#"(
            nodes: {{ "g": (0, 0, 0), "a": (0, 0, 1) }},
            supports: {{ "g": Fixed, "a": (Uy, Uz, Rx, Ry, Rz) }},
            elements: {{
                "m": Mass(node: "a", mass: 2),
                "s": Spring(nodes: ("g", "a"), k2: 300, c2: 2, axis2: (1, 0, 0)),
                "stop": Gap(nodes: ("g", "a"), k: 5000, opening: 0.01, axis1: (1, 0, 0), axis2: (0, 0, 1)),
            }},
            functions: {{
                "d": Sine(amplitude: "2 cm", frequency: 1.5),
                "a": Sine(amplitude: "-1.7765287921960844 m/s^2", frequency: 1.5),
            }},
            cases: {{ {case} }},
            outputs: {{ "stretch": LinkDeformation(link: "stop", axis: U1) }},
        )"#
        )
    };
    // The support starts with velocity 2 cm · 2π · 1.5 Hz; so does the mass in the relative frame.
    let start = "0.1884955592153876";
    let moved = text(&format!(
        r#""m": Dynamic(duration: 3, dt: 0.005, step: Adaptive(tolerance: 1e-5),
        initial: [(node: "a", dof: Ux, velocity: {start})],
        supports: [(node: "g", dof: Ux, displacement: "d")])"#
    ));
    let base = text(
        r#""b": Dynamic(duration: 3, dt: 0.005, step: Adaptive(tolerance: 1e-5),
        base: [(direction: X, function: "a")])"#,
    );
    for solver in SolverKind::ALL {
        let run = |text: &str| {
            let (model, system) = parse(text, &[]);
            let (t, r) = trace(&model, &system, solver);
            assert_eq!(r.status, Status::Converged, "{}", solver.name());
            t
        };
        let (a, b) = (run(&moved), run(&base));
        assert!(b.peak(0) > 0.011, "the stop is hit: {}", b.peak(0));
        assert!(a.difference(&b, 0) < 2e-3, "{}: {}", solver.name(), a.difference(&b, 0));
    }
}

/// Wilson's constant-stiffness iteration finds the same forces as Newton, in more iterations.
#[test]
fn the_fixed_point_iteration_gives_what_newton_gives() {
    let run = |kernel: Kernel| {
        let (mut model, system) = shipped("rigid_block.ron", &[("duration", "0.6".into())]);
        set_step(&mut model, StepControl::Fixed { substeps: 10 });
        for case in &mut model.cases {
            if let Analysis::Dynamic(d) = &mut case.analysis {
                d.solution.kernel = kernel;
            }
        }
        trace(&model, &system, SolverKind::Fna)
    };
    let ((a, ra), (b, rb)) = (run(Kernel::Newton), run(Kernel::FixedPoint));
    assert!(rb.work.iterations > ra.work.iterations);
    for i in 0..3 {
        assert!(a.difference(&b, i) < 1e-4, "output {i}: {}", a.difference(&b, i));
    }
}

/// Fixed steps that are too long for the exact rule are not made by another one in silence.
#[test]
fn a_fixed_step_too_long_for_the_exact_rule_is_told() {
    let (mut model, system) = shipped("rigid_block.ron", &[("duration", "0.02".into())]);
    set_step(&mut model, StepControl::Fixed { substeps: 1 });
    let options =
        || RunOptions { solver: Some(SolverKind::Fna), dt: Some(0.02), ..RunOptions::default() };
    let (_, coarse) = trace_with(&model, &system, options());
    assert!(
        coarse.warnings.iter().any(|w| w.contains("limit of stability")),
        "{:?}",
        coarse.warnings
    );
    let (_, fine) = trace_with(&model, &system, RunOptions { dt: Some(1e-3), ..options() });
    assert!(fine.warnings.is_empty(), "{:?}", fine.warnings);
}

/// A beam on a one-sided stop: F = k (P L³/3EI − gap)/(1 + k L³/3EI) once closed.
#[test]
fn a_static_case_closes_a_gap_like_the_closed_form() {
    let text = r#"(
        nodes: { "root": (0, 0, 0), "tip": (2, 0, 0) },
        supports: { "root": Fixed },
        plane: XZ,
        elements: {
            "beam": Beam(nodes: ("root", "tip"), young: "200 GPa", poisson: 0.3, width: "5 cm", depth: "10 cm"),
            "stop": Gap(node: "tip", k: "1 MN/m", opening: "5 mm"),
        },
        loads: { "push": [(node: "tip", dof: Uz, force: "-10 kN")] },
        cases: { "press": Static(loads: [(load: "push")]) },
        outputs: { "tip": Displacement(node: "tip", dof: Uz), "stop": LinkForce(link: "stop", axis: U1) },
    )"#;
    let (model, system) = parse(text, &[]);
    let (t, _) = trace(&model, &system, SolverKind::Fna);
    let flexibility = 8.0 / (3.0 * 200e9 * 0.05 * 0.1f64.powi(3) / 12.0);
    let force = 1e6 * (1e4 * flexibility - 0.005) / (1.0 + 1e6 * flexibility);
    assert!((t.last[1] + force).abs() < 1e-6 * force, "{} against {force}", -t.last[1]);
    assert!((t.last[0] + (1e4 - force) * flexibility).abs() < 1e-9);
}

/// The closing of link energies in a step cannot be asked for beyond rounding: the deformation of a stiff
/// contact under weight is a small difference of displacements far larger.
#[test]
fn a_very_stiff_contact_takes_a_tight_tolerance() {
    let set =
        [("kn", "5e12 N/m"), ("ks", "5e12 N/m"), ("cv", "1.28e8 N*s/m"), ("duration", "0.3 s")];
    let set: Vec<_> = set.iter().map(|(n, v)| (*n, (*v).to_owned())).collect();
    let (mut model, system) = shipped("rigid_block_rocking.ron", &set);
    set_step(&mut model, StepControl::Adaptive { tolerance: 1e-6 });
    for solver in SolverKind::ALL {
        let (_, result) = trace(&model, &system, solver);
        assert_eq!(result.status, Status::Converged, "{}", solver.name());
        assert!(result.work.substeps < 100_000, "{} {:?}", solver.name(), result.work);
    }
}

/// A body on a slope, held by a spring far softer than the contact: the spring holds what friction does
/// not, W (tan β − μ)/(1 + μ tan β) (holder and load along and against gravity's plane).
#[test]
fn a_static_case_balances_a_soft_spring_beside_a_stiff_contact() {
    let text = r#"(
        parameters: { "k": "1 N/m", "angle": "20*pi/180" },
        nodes: { "n": (0, 0, 0) },
        supports: { "n": (Uy, Rx, Ry, Rz) },
        elements: {
            "mass": Mass(node: "n", mass: 1),
            "holder": Spring(node: "n", k2: "k"),
            "slope": NLink(
                node: "n", axis1: ("-sin(angle)", 0, "cos(angle)"),
                axis2: ("cos(angle)", 0, "sin(angle)"), kn: 1e9, ks: 1e9, mu: 0.3,
            ),
        },
        loads: { "press": [(node: "n", dof: Uz, force: -100)] },
        cases: { "press": Static(loads: ["press"], steps: 10) },
        outputs: { "holder": Displacement(node: "n", dof: Ux, factor: "-k") },
    )"#;
    let slope = 20f64.to_radians().tan();
    let wanted = 100.0 * (slope - 0.3) / (1.0 + 0.3 * slope);
    for k in ["1 N/m", "1e3 N/m", "1e6 N/m"] {
        let (model, system) = parse(text, &[("k", k.into())]);
        let (t, result) = trace(&model, &system, SolverKind::Fna);
        assert_eq!(result.status, Status::Converged);
        let off = t.last[0] / wanted - 1.0;
        assert!(off.abs() < 1e-4, "{k}: {} instead of {wanted}", t.last[0]);
    }
}

/// Stiffness values whose inverse times themselves is one to the last digit, and others.
#[test]
fn an_open_contact_closes_under_a_weight() {
    for kn in [1e6, 3e7, 1e8, 1e9] {
        for friction in ["", ", mu: 0.3, ks: 1e7"] {
            let text = format!(
                r#"(
    plane: XZ, gravity: 10,
    nodes: {{ "m": (0, 0, 0) }}, supports: {{ "m": Ry }},
    elements: {{
        "mass": Mass(node: "m", mass: 1000),
        "side": Spring(node: "m", k2: 1e5),
        "foot": NLink(node: "m", kn: {kn}, opening: 1e-3{friction}),
    }},
    cases: {{ "rest": Static(loads: [Gravity]), "go": Dynamic(after: "rest", duration: 0.1, dt: 0.01) }},
    outputs: {{ "z": Displacement(node: "m", dof: Uz) }},
)"#
            );
            let (model, system) = parse(&text, &[]);
            for solver in [SolverKind::Fna, SolverKind::Hht] {
                let (trace, result) = trace(&model, &system, solver);
                assert_eq!(result.status, Status::Converged);
                let wanted = -1e-3 - 1e4 / kn;
                assert!((trace.last[0] / wanted - 1.0).abs() < 1e-6, "{kn}: {}", trace.last[0]);
            }
        }
    }
}

/// A block at rest, and one that slides and comes to rest again, take about the steps that were asked for (two
/// substeps each, and some where it starts and stops), and a few times as many on a contact of 1e12 N/m, where ω Δt = 22
/// and the displacements that count are those of its trembling.
#[test]
fn a_stiff_contact_at_rest_or_in_steady_sliding_costs_no_substeps() {
    for stiffness in ["1e8", "1e10", "1e12"] {
        for (ah, mu) in [("0.05", "0.6"), ("0.5", "0.2")] {
            let set: [(&str, String); 4] = [
                ("kn", stiffness.into()),
                ("ks", stiffness.into()),
                ("ah", ah.into()),
                ("mu", mu.into()),
            ];
            let (model, system) = shipped("rigid_block.ron", &set);
            for solver in [SolverKind::Fna, SolverKind::Hht] {
                let (_, result) = trace(&model, &system, solver);
                let share = result.work.substeps as f64 / result.work.steps as f64;
                let most = if stiffness == "1e12" { 7.0 } else { 2.8 };
                assert!(share < most, "{stiffness} N/m, {ah} g, {}: {share}", solver.name());
            }
        }
    }
}

/// Nor does a body in finite rotation, which trembles at rest by angles below the last digit of one.
#[test]
fn a_body_in_finite_rotation_at_rest_costs_no_substeps() {
    let (model, system) = shipped("rocking_body.ron", &[("ah", "0.2".into())]);
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let (_, result) = trace(&model, &system, solver);
        let per_step = |count: usize| count as f64 / result.work.steps as f64;
        let (substeps, iterations) =
            (per_step(result.work.substeps), per_step(result.work.iterations));
        let name = solver.name();
        assert!(substeps < 2.6 && iterations < 5.0, "{name}: {substeps} {iterations}");
    }
}

/// Where every contact sticks, the tangents foresee the forces of a step: one look at the laws confirms them.
#[test]
fn a_step_without_a_change_takes_one_look_at_the_laws() {
    let set = [("ah", "0.1".into()), ("mu", "0.6".into())];
    let (mut model, system) = shipped("rigid_block.ron", &set);
    set_step(&mut model, StepControl::Fixed { substeps: 4 });
    let (_, result) = trace(&model, &system, SolverKind::Fna);
    let looks = result.work.iterations as f64 / result.work.substeps as f64;
    assert!(result.status.is_good() && looks < 1.01, "{looks} {:?}", result.status);
}
