//! Many modes of which a stiff link holds one: the others keep their exact rule, be they the first or the seventieth.

use std::fmt::Write;
use trilith_model::SolverKind;
use trilith_tests::{output, parse, trace};

/// Masses, each on a spring of its own.
const MASSES: usize = 80;
/// Output step, s.
const DT: f64 = 0.02;

/// Circular frequency of a mass, rad/s: each a mode of its own, in this order.
fn omega(mass: usize) -> f64 {
    10.0 * 1.02_f64.powi(mass as i32)
}

/// One of them is held by a stop that is stiff beside its spring, and all but that begin with 1 m/s.
fn row(held: usize) -> String {
    let (mut nodes, mut supports, mut elements) = (String::new(), String::new(), String::new());
    let (mut initial, mut outputs) = (String::new(), String::new());
    for m in 0..MASSES {
        let stiffness = 1000.0 * omega(m).powi(2);
        write!(nodes, r#""m{m}": ({m}, 0, 0), "#).unwrap();
        write!(supports, r#""m{m}": (Uy, Uz, Rx, Ry, Rz), "#).unwrap();
        write!(
            elements,
            r#""mass {m}": Mass(node: "m{m}", mass: "1 t"), "spring {m}": Spring(node: "m{m}", k2: {stiffness}), "#
        )
        .unwrap();
        write!(outputs, r#""way {m}": Displacement(node: "m{m}", dof: Ux), "#).unwrap();
        if m != held {
            write!(initial, r#"(node: "m{m}", dof: Ux, velocity: 1), "#).unwrap();
        }
    }
    format!(
        r#"(
            nodes: {{ {nodes} }},
            supports: {{ {supports} }},
            elements: {{ {elements} "stop": Gap(node: "m{held}", axis: U2, k: 1e13, opening: 0, effective_stiffness: 0) }},
            cases: {{ "swing": Dynamic(
                duration: "1 s", dt: {DT}, step: Fixed(substeps: 1), energy_limit: 0.9, initial: [{initial}],
                forces: [(load: "push", function: "push")],
            ) }},
            loads: {{ "push": [(node: "m{held}", dof: Ux, force: -1000)] }},
            functions: {{ "push": Step(amplitude: 1) }},
            outputs: {{ {outputs} }},
        )"#
    )
}

#[test]
fn modes_beside_that_of_a_stiff_link_keep_the_exact_rule() {
    for held in [3, 70] {
        let (model, system) = parse(&row(held), &[]);
        let (made, _) = trace(&model, &system, SolverKind::Fna);
        for m in (0..MASSES).filter(|m| *m != held) {
            let (w, at) = (omega(m), output(&model, &format!("way {m}")));
            let worst = made.history.iter().enumerate().map(|(i, values)| {
                let exact = (w * DT * i as f64).sin() / w;
                (values[at] - exact).abs() * w
            });
            let worst = worst.fold(0.0, f64::max);
            assert!(worst < 1e-9, "{held}, {m}: apart by {worst} of its amplitude");
        }
    }
}
