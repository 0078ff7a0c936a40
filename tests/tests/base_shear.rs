//! The base shear is what elements and links give to the supports and the ground.

use trilith_model::SolverKind;
use trilith_solvers::{BaseShear, Observer, RunOptions, Sample, run};
use trilith_tests::parse;

/// Two storeys on a support, and a link from the first floor to the ground.
const MODEL: &str = r#"(
    plane: XZ,
    nodes: { "g": (0, 0, 0), "a": (0, 0, 3), "b": (0, 0, 6) },
    supports: { "g": Fixed, "a": (Uz, Ry), "b": (Uz, Ry) },
    elements: {
        "lower": Spring(nodes: ("g", "a"), k2: "4 MN/m"),
        "upper": Spring(nodes: ("a", "b"), k2: "3 MN/m"),
        "floor a": Mass(node: "a", mass: "20 t"),
        "floor b": Mass(node: "b", mass: "20 t"),
        "brace": Wen(node: "a", axis: U2, k: "2 MN/m", fy: "20 kN", ratio: 0.05),
    },
    damping: Modal(ratio: "3 %"),
    functions: { "pulse": Ricker(amplitude: "0.3 g", frequency: "1.5 Hz", center: "1 s") },
    cases: { "shake": Dynamic(duration: "4 s", dt: "5 ms", base: [(direction: X, function: "pulse")]) },
    outputs: {
        "lower": ElementForce(element: "lower", end: 0, dof: Ux, factor: -1),
        "brace": LinkForce(link: "brace", axis: U2),
    },
)"#;

/// How far the base shear is from the sum of the outputs, and the largest of it along X and Y.
#[derive(Default)]
struct Differences {
    worst: f64,
    largest: [f64; 2],
}

impl Observer for Differences {
    fn sample(&mut self, s: &Sample<'_>) {
        let [x, y] = s.base_shear;
        self.worst = self.worst.max((x - s.values[0] - s.values[1]).abs());
        self.largest = [self.largest[0].max(x.abs()), self.largest[1].max(y.abs())];
    }

    fn wants_base_shear(&self) -> bool {
        true
    }
}

#[test]
fn it_is_the_sum_of_what_stands_on_supports_and_ground() {
    let (model, system) = parse(MODEL, &[]);
    for solver in [SolverKind::Fna, SolverKind::Hht, SolverKind::RitzHht, SolverKind::FullNewton] {
        let (mut seen, mut kept) = (Differences::default(), BaseShear::default());
        let options = RunOptions { solver: Some(solver), ..RunOptions::default() };
        run(&model, &system, options, &mut [&mut seen, &mut kept]).unwrap();
        assert!(seen.largest[0] > 5e4, "{solver:?}: {:?}", seen.largest);
        assert!(seen.worst < 1e-9 * seen.largest[0], "{solver:?}: {}", seen.worst);
        assert_eq!(seen.largest[1], 0.0);
        assert_eq!(kept.summary().max, seen.largest, "{solver:?}");
    }
}
