//! Several motions in lock step come out as each of them alone, to the bit.

use trilith_model::{Analysis, Model, SolverKind, StepControl};
use trilith_solvers::{Member, Observer, RunOptions, Sample, assemble, run, run_together};
use trilith_system::System;
use trilith_tests::{registry, set_step, shipped};

/// Every number that an observer sees, as bits.
#[derive(Default)]
struct Seen(Vec<u64>);

impl Observer for Seen {
    fn start(&mut self, steps: usize) {
        self.0.push(steps as u64);
    }

    fn sample(&mut self, s: &Sample<'_>) {
        let energies = [s.energy.input, s.energy.kinetic, s.energy.link_hysteretic, s.energy.error];
        let numbers = [&[s.t], s.values, s.rates, &energies].concat();
        self.0.extend(numbers.iter().map(|x| x.to_bits()));
    }

    fn end(&mut self, s: &Sample<'_>) {
        self.0.push(u64::MAX);
        self.sample(s);
    }
}

fn alone(model: &Model, system: &System, case: usize) -> (Seen, String) {
    let mut seen = Seen::default();
    let options = RunOptions { case, solver: Some(SolverKind::Fna), ..RunOptions::default() };
    let result = run(model, system, options, &mut [&mut seen]).unwrap();
    (seen, format!("{:?} {:?} {:?}", result.status, result.energy, result.end))
}

/// Runs all together and each alone; true for those that made as many iterations in both.
fn compare(models: &[Model], case: usize) {
    let systems: Vec<System> = models.iter().map(|m| assemble(m).unwrap()).collect();
    let members: Vec<Member<'_>> =
        models.iter().zip(&systems).map(|(model, system)| Member { model, system }).collect();
    let together = run_together(&members, case, |_| Seen::default()).unwrap();
    for (i, (result, seen)) in together.iter().enumerate() {
        let (expected, end) = alone(&models[i], &systems[i], case);
        assert!(
            seen.0 == expected.0,
            "member {i}: {} and {} numbers",
            seen.0.len(),
            expected.0.len()
        );
        assert_eq!(format!("{:?} {:?} {:?}", result.status, result.energy, result.end), end);
    }
}

fn frame(scale: f64, text: &str) -> Model {
    let text = text
        .replace(
            "base: [(direction: X, function: \"record x\")",
            &format!("base: [(direction: X, factor: {scale}, function: \"record x\")"),
        )
        .replace("duration: \"20 s\"", "duration: \"4 s\"");
    trilith::read_text(&text, "frame.ron", &registry(), &[]).unwrap()
}

/// Six scales of one record (a group of four and two more), and one building with more friction: laws may
/// differ.
#[test]
fn scaled_records_on_one_building_come_out_as_alone() {
    let text = trilith::generate::Frame::preset("P1e2").unwrap().to_ron();
    let mut models: Vec<Model> =
        [0.0, 0.3, 0.7, 1.0, 1.5, 2.0].iter().map(|s| frame(*s, &text)).collect();
    models.push(frame(1.0, &text.replace("\"damper\": \"49829", "\"damper\": \"39829")));
    compare(&models, 0);
}

/// Stiff contacts choose their rule for themselves, adaptive steps are their own, another structure is
/// another one: all are run alone.
#[test]
fn what_does_not_fit_is_run_alone() {
    let block = |mass: &str, step: StepControl| {
        let set = [("duration", "0.5".into()), ("mass", mass.to_owned())];
        let (mut model, _) = shipped("rigid_block.ron", &set);
        set_step(&mut model, step);
        model
    };
    let fixed = StepControl::Fixed { substeps: 4 };
    let models = [
        block("4000", fixed),
        block("4000", fixed),
        block("3000", fixed),
        block("4000", StepControl::default()),
    ];
    let case = models[0].cases.iter().position(|c| matches!(c.analysis, Analysis::Dynamic(_)));
    compare(&models, case.unwrap());
}
