//! Statics by FNA: "structures subject to static loads can also be solved by the FNA method".

use super::plots::{MILLIMETRE, Plot, Seen};
use super::{BLOCK, BOTH, PAPER, run};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study, Trace};
use trilith::SolverKind;
use trilith::model::{Analysis, Load};

/// The shipped block, loaded slowly by its weight and then by a push, and damped. The push is close to
/// tipping the block, so that the foot it unloads slips.
const SLOWLY: &str = r#"(
    title: "Rigid block under static loads",
    plane: XZ,
    parameters: {
        "width": "2 m", "height": "4 m", "mass": "10 t", "g": "9.81 m/s^2", "mu": 0.6,
        "kn": "5e8 N/m", "ks": "5e8 N/m", "cv": "1.27665182e6 N*s/m", "push": 0.45,
    },
    nodes: {
        "cg": (0, 0, "height/2"), "left": ("-width/2", 0, 0), "right": ("width/2", 0, 0),
    },
    properties: { "foot": NLink(kn: "kn", ks: "ks", mu: "mu", damping: "cv", pull: 1) },
    elements: {
        "block": RigidBody(nodes: ("cg", "left", "right")),
        "inertia": Mass(node: "cg", mass: "mass", inertia: (0, "mass*(height^2 + width^2)/12", 0)),
        "foot left": NLink(node: "left", use: "foot"),
        "foot right": NLink(node: "right", use: "foot"),
    },
    damping: Rayleigh(mass: 400, stiffness: 0),
    functions: {
        "weight": Ramp(amplitude: 1, start: 0, rise: "1 s"),
        "push": Ramp(amplitude: 1, start: "1 s", rise: "1 s"),
    },
    loads: {
        "weight": [(node: "cg", dof: Uz, force: "-mass*g")],
        "push": [(node: "cg", dof: Ux, force: "push*mass*g")],
    },
    cases: {
        "weight": Static(loads: ["weight"]),
        "push": Static(after: "weight", loads: ["push"]),
        "slowly": Dynamic(
            duration: "3 s", dt: "10 ms",
            forces: [(load: "weight", function: "weight"), (load: "push", function: "push")],
        ),
    },
    outputs: {
        "ux": Displacement(node: "left", dof: Ux),
        "uz_left": Displacement(node: "left", dof: Uz),
        "uz_right": Displacement(node: "right", dof: Uz),
        "n_left": LinkForce(link: "foot left", axis: U1, factor: -1),
        "n_right": LinkForce(link: "foot right", axis: U1, factor: -1),
        "t_left": LinkForce(link: "foot left", axis: U2),
        "t_right": LinkForce(link: "foot right", axis: U2),
    },
)"#;

pub(super) fn studies() -> Vec<Study> {
    let title = "Static loads by FNA: weight and push on a block with friction";
    vec![Study { id: "FIG-S", title, source: PAPER, work }]
}

/// Where a run ends against the closed form and the static analysis.
fn end(f: &mut Findings, solver: SolverKind, stopped: &Trace, trace: &Trace) {
    let weight = 1e4 * 9.81;
    let (kn, ks, mu, push) = (5e8, 5e8, 0.6, 0.45);
    // H/B = 2: the push moves push · W from foot to foot.
    let (light, heavy) = (weight * (0.5 - push), weight * (0.5 + push));
    let (slips, holds) = (mu * light, push * weight - mu * light);
    let rows = [
        ("ux", "mm", holds / ks, 1e3),
        ("uz_left", "mm", -light / kn, 1e3),
        ("uz_right", "mm", -heavy / kn, 1e3),
        ("n_left", "kN", light, 1e-3),
        ("n_right", "kN", heavy, 1e-3),
        ("t_left", "kN", slips, 1e-3),
        ("t_right", "kN", holds, 1e-3),
    ];
    for (output, unit, closed, factor) in rows {
        let value = trace.last(output) * factor;
        let name = solver.name();
        for (words, reference, kind) in [
            ("closed form", closed, Kind::ClosedForm),
            ("static analysis", stopped.last(output), Kind::Theory),
        ] {
            let quantity = format!("{output} against the {words}");
            let reference = (reference * factor, kind);
            f.check(quantity, unit, reference, Tolerance::Relative(1e-6), name, value);
        }
    }
}

fn work(f: &mut Findings) -> Result<(), String> {
    slowly(f)?;
    at_once(f)
}

fn slowly(f: &mut Findings) -> Result<(), String> {
    f.text(
        "The weight grows within the first second, a push of 0.45 times the weight at the centre of \
         gravity within the second. The static solution: the left foot keeps a twentieth of the weight \
         and slips at μ times that, the right one carries the rest of both. The dynamic case ends in it.",
    );
    let stopped = run(SLOWLY, &[], SolverKind::Fna, |model| model.cases.truncate(2))?;
    let mut seen: Vec<Seen> = Vec::new();
    for solver in BOTH {
        let trace = run(SLOWLY, &[], solver, |_| {})?;
        end(f, solver, &stopped, &trace);
        seen.push((solver.name(), trace));
    }
    let outputs = &[("uz_left", "left, "), ("uz_right", "right, ")];
    let title = "Height of both feet".into();
    let plot = Plot { title, outputs, axis: "height", unit: MILLIMETRE, end: 3.0 };
    let marks = ["uz_left", "uz_right"].map(|o| (3.0, stopped.last(o) * 1e3));
    let weight = [(0.0, 0.0), (1.0, -0.0981)];
    f.figure(plot.draw(&seen, None).reference("W/2kₙ", weight).marks("static analysis", marks));
    let outputs = &[("t_left", "left, "), ("t_right", "right, ")];
    let title = "Friction force of both feet".into();
    let unit = crate::Unit { name: "kN", si: 1e3 };
    let plot = Plot { title, outputs, axis: "force", unit, end: 3.0 };
    let marks = ["t_left", "t_right"].map(|o| (3.0, stopped.last(o) / 1e3));
    f.figure(plot.draw(&seen, None).marks("static analysis", marks));
    Ok(())
}

/// The shipped block without its static case: the weight acts from the first moment.
fn at_once(f: &mut Findings) -> Result<(), String> {
    f.text(
        "The shipped block, its weight put on at once: the contact dashpots bring it to the static \
         deflection W/2kₙ.",
    );
    let deflection = -1e4 * 9.81 / (2.0 * 5e8) * 1e3;
    let set = [("ah", 0.0), ("av", 0.0), ("duration", 0.2)];
    let mut seen: Vec<Seen> = Vec::new();
    for solver in BOTH {
        let trace = run(BLOCK, &set, solver, |model| {
            for case in &mut model.cases {
                if let Analysis::Dynamic(dynamic) = &mut case.analysis {
                    case.after = None;
                    dynamic.constant = vec![Load::Gravity { factor: 1.0 }];
                }
            }
        })?;
        let reference = (deflection, Kind::ClosedForm);
        let value = trace.last("uplift_left") * 1e3;
        let tolerance = Tolerance::Relative(1e-6);
        f.check("weight at once: uz_left", "mm", reference, tolerance, solver.name(), value);
        seen.push((solver.name(), trace));
    }
    let title = "Height of the left foot, weight put on at once".into();
    let outputs = &[("uplift_left", "")];
    let plot = Plot { title, outputs, axis: "height", unit: MILLIMETRE, end: 0.2 };
    f.figure(plot.draw(&seen, None).reference("W/2kₙ", [(0.0, deflection), (0.2, deflection)]));
    Ok(())
}
