//! A draft of a run: with coarser steps, for a value that is still being moved.
//!
//! Steps that keep to a tolerance keep to a larger one, so the draft of a smooth motion is off by about that tolerance. Equal steps
//! stay as they are: nothing watches what coarser ones would miss.

use trilith::model::{Analysis, DynamicCase, Model, StepControl, output_steps};

/// Times the tolerance of the steps, ...
const LOOSER: f64 = 30.0;
/// ... and at most this one.
const LOOSEST: f64 = 1e-2;
/// Output steps that show a motion well.
const STEPS: f64 = 250.0;
/// Share of the largest link force by which a link may miss equilibrium.
const LINKS: f64 = 1e-6;
/// Share of the energy that may be unaccounted for.
const ENERGY: f64 = 3e-2;

/// Makes the motions of a model cheap to find; false where none of them can be.
pub(crate) fn coarsen(model: &mut Model) -> bool {
    let mut any = false;
    for case in &mut model.cases {
        if let Analysis::Dynamic(dynamic) = &mut case.analysis {
            any |= coarsen_case(dynamic);
        }
    }
    any
}

fn coarsen_case(case: &mut DynamicCase) -> bool {
    let solution = &mut case.solution;
    let StepControl::Adaptive { tolerance } = &mut solution.step else { return false };
    *tolerance = tolerance.max((LOOSER * *tolerance).min(LOOSEST));
    solution.link_tolerance = solution.link_tolerance.max(LINKS);
    solution.energy_limit = solution.energy_limit.max(ENERGY);
    case.dt *= (output_steps(case.duration, case.dt) / STEPS).floor().max(1.0);
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model(step: &str, duration: &str) -> DynamicCase {
        let text = format!(
            r#"(
                plane: XZ,
                nodes: {{ "m": (0, 0, 0) }},
                supports: {{ "m": (Uz, Ry) }},
                elements: {{ "mass": Mass(node: "m", mass: "1 kg"), "spring": Spring(node: "m", k2: "1 N/m") }},
                cases: {{ "swing": Dynamic(duration: "{duration}", dt: "1 ms", step: {step},
                    initial: [(node: "m", dof: Ux, velocity: "1 m/s")]) }},
                outputs: {{ "sway": Displacement(node: "m", dof: Ux) }},
            )"#
        );
        let text = trilith::model::ModelText::new(&text, "a.ron").unwrap();
        let mut model = text.read(&trilith::registry(), &[]).unwrap();
        assert_eq!(coarsen(&mut model), step.starts_with("Adaptive"));
        let Analysis::Dynamic(case) = model.cases.remove(0).analysis else { panic!("static") };
        *case
    }

    #[test]
    fn a_draft_has_looser_steps_and_fewer_of_them() {
        let tolerance = |c: &DynamicCase| match c.solution.step {
            StepControl::Adaptive { tolerance } => tolerance,
            StepControl::Fixed { .. } => panic!("fixed"),
        };
        let (long, short) = (model("Adaptive", "4.5 s"), model("Adaptive", "0.2 s"));
        assert!((long.dt - 18e-3).abs() < 1e-12 && (short.dt - 1e-3).abs() < 1e-12);
        assert!((tolerance(&long) - 3e-3).abs() < 1e-12);
        // Looser than the loosest stays what it is.
        assert!((tolerance(&model("Adaptive(tolerance: 2e-3)", "1 s")) - 1e-2).abs() < 1e-12);
        assert!((tolerance(&model("Adaptive(tolerance: 0.05)", "1 s")) - 0.05).abs() < 1e-12);
    }

    #[test]
    fn equal_steps_stay_as_they_are() {
        let case = model("Fixed(substeps: 2)", "4 s");
        assert_eq!((case.dt, case.solution.step), (1e-3, StepControl::Fixed { substeps: 2 }));
        assert_eq!(case.solution.link_tolerance, 1e-9);
    }
}
