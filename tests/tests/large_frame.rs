//! A building of ten thousand degrees of freedom on a hundred friction pendulums.

use std::fmt::Write;
use trilith_model::SolverKind;
use trilith_solvers::Status;
use trilith_tests::{parse, trace};

/// `n` × `n` columns, `storeys` levels above the isolated base grid; bays of 6 m, storeys of 3.5 m,
/// columns 0.6 × 0.6 m, beams 0.35 × 0.65 m of concrete, 900 kg/m² a floor lumped at the joints.
fn building(n: usize, storeys: usize, vectors: usize, steps: usize) -> String {
    let (mut nodes, mut elements) = (String::new(), String::new());
    let name = |i: usize, j: usize, k: usize| format!("{i}-{j}-{k}");
    let share = |i: usize| if i == 0 || i + 1 == n { 0.5 } else { 1.0 };
    for k in 0..=storeys {
        for j in 0..n {
            for i in 0..n {
                let at = name(i, j, k);
                let (x, y, z) = (6.0 * i as f64, 6.0 * j as f64, 3.5 * k as f64);
                let mass = 900.0 * 36.0 * share(i) * share(j);
                writeln!(nodes, "\"{at}\": ({x}, {y}, {z}),").unwrap();
                writeln!(elements, "\"m{at}\": Mass(node: \"{at}\", mass: {mass}),").unwrap();
                let mut member = |to: String, kind: &str, axis: &str| {
                    writeln!(
                        elements,
                        "\"{axis}{at}\": Beam(nodes: (\"{at}\", \"{to}\"), use: \"{kind}\"),"
                    )
                    .unwrap();
                };
                if k < storeys {
                    member(name(i, j, k + 1), "column", "c");
                }
                if i + 1 < n {
                    member(name(i + 1, j, k), "beam", "x");
                }
                if j + 1 < n {
                    member(name(i, j + 1, k), "beam", "y");
                }
                if k == 0 {
                    writeln!(elements, "\"iso{at}\": NLink(node: \"{at}\", use: \"isolator\"),")
                        .unwrap();
                }
            }
        }
    }
    format!(
        r#"(
        gravity: 9.81,
        nodes: {{ {nodes} }},
        properties: {{
            "column": Beam(young: "30 GPa", poisson: 0.2, width: 0.6, depth: 0.6, density: 2500),
            "beam": Beam(young: "30 GPa", poisson: 0.2, width: 0.35, depth: 0.65, density: 2500),
            "isolator": NLink(kn: "2e9 N/m", damping: "2e6 N*s/m", ks: "3e8 N/m",
                mu_slow: 0.03, mu_fast: 0.06, rate: "20 s/m", radius: 2.5),
        }},
        elements: {{ {elements} }},
        damping: Modal(ratio: 0.02),
        functions: {{
            "x": Sine(amplitude: "3 m/s^2", frequency: 0.8, cycles: 6),
            "y": Sine(amplitude: "2 m/s^2", frequency: 1.1, cycles: 6, start: 0.5),
        }},
        cases: {{
            "gravity": Static(loads: [Gravity]),
            "quake": Dynamic(after: "gravity", duration: {duration}, dt: 0.005,
                base: [(direction: X, function: "x"), (direction: Y, function: "y")],
                basis: Ritz(vectors: {vectors}, adequacy: 0.01, tolerance: 1)),
        }},
        outputs: {{
            "base": Displacement(node: "0-0-0", dof: Ux),
            "roof": Displacement(node: "0-0-{storeys}", dof: Ux),
        }},
    )"#,
        duration = 0.005 * steps as f64
    )
}

#[test]
fn ten_thousand_degrees_of_freedom_run_four_thousand_steps_of_fna() {
    let start = std::time::Instant::now();
    let (model, system) = parse(&building(10, 16, 100, 4000), &[]);
    assert!(system.order() > 10_000 && system.links.links.len() == 100);
    eprintln!("read and assembled {} equations in {:.1?}", system.order(), start.elapsed());
    let (t, result) = trace(&model, &system, SolverKind::Fna);
    eprintln!("{:?} after {:.1?}", result.work, start.elapsed());
    assert_eq!(result.status, Status::Converged);
    assert_eq!(result.work.steps, 4000);
    assert_eq!(result.basis.map(|b| b.vectors), Some(100));
    // It slides: friction of 6 % and a base acceleration of 0.3 g.
    assert!(t.peak(0) > 0.02 && t.peak(1) > t.peak(0), "{} {}", t.peak(0), t.peak(1));
}
