//! The text of a model from its description.

mod law;

use super::spec::{AXES, Basis, DOFS, Damping, Function, Kind, Law, Output, Spec};
use law::law;
use std::fmt::Write as _;

/// The model file.
#[must_use]
pub fn text(spec: &Spec) -> String {
    let mut s = String::from("(\n");
    let mut line = |x: String| {
        s.push_str(&x);
        s.push('\n');
    };
    if spec.plane {
        line("    plane: XZ,".into());
    }
    line(block(
        "nodes",
        spec.nodes.iter().enumerate().map(|(i, x)| format!("\"n{i}\": {}", triple(x))),
    ));
    let held = spec.fixed.iter().enumerate().filter(|(_, f)| f.iter().any(|x| *x));
    line(block(
        "supports",
        held.map(|(i, f)| {
            let all: Vec<&str> = DOFS.iter().zip(f).filter(|(_, x)| **x).map(|(d, _)| *d).collect();
            format!("\"n{i}\": ({})", all.join(", "))
        }),
    ));
    line(block(
        "elements",
        spec.members.iter().enumerate().map(|(i, m)| {
            let names: Vec<String> = m.nodes.iter().map(|n| format!("\"n{n}\"")).collect();
            let at = match &names[..] {
                [one] => format!("node: {one}"),
                _ => format!("nodes: ({})", names.join(", ")),
            };
            let axis1 = m.axis1.map_or(String::new(), |a| format!(", axis1: {}", triple(&a)));
            let (kind, rest) = kind(&m.kind);
            let comma = if rest.is_empty() { "" } else { ", " };
            format!("\"e{i}\": {kind}({at}{axis1}{comma}{rest})")
        }),
    ));
    match spec.damping {
        Damping::None => {}
        Damping::Modal(r) => line(format!("    damping: Modal(ratio: {r:?}),")),
        Damping::Rayleigh(a, b) => {
            line(format!("    damping: Rayleigh(mass: {a:?}, stiffness: {b:?}),"));
        }
    }
    let forces = spec.forces.iter().enumerate();
    line(block(
        "loads",
        forces.clone().map(|(i, f)| {
            let what = if f.dof < 3 { "force" } else { "moment" };
            format!(
                "\"p{i}\": [(node: \"n{}\", dof: {}, {what}: {:?})]",
                f.node, DOFS[f.dof], f.value
            )
        }),
    ));
    let all = forces
        .map(|(i, f)| (format!("f{i}"), &f.function, ""))
        .chain(spec.base.iter().enumerate().map(|(i, b)| (format!("b{i}"), &b.1, " m/s^2")))
        .chain(
            spec.moved
                .iter()
                .enumerate()
                .map(|(i, m)| (format!("m{i}"), &m.2, if m.1 < 3 { " m" } else { " rad" })),
        );
    line(block(
        "functions",
        all.map(|(name, f, unit)| format!("\"{name}\": {}", function(f, unit))),
    ));
    line(cases(spec));
    line(block(
        "outputs",
        spec.outputs.iter().enumerate().map(|(i, o)| {
            let what = match o {
                Output::Displacement(n, d) => {
                    format!("Displacement(node: \"n{n}\", dof: {})", DOFS[*d])
                }
                Output::Velocity(n, d) => format!("Velocity(node: \"n{n}\", dof: {})", DOFS[*d]),
                Output::Drift(n, m, d) => {
                    let term = |n: &usize, x: i32| {
                        format!("(node: \"n{n}\", dof: {}, factor: {x})", DOFS[*d])
                    };
                    format!("Displacement(terms: [{}, {}])", term(n, 1), term(m, -1))
                }
                Output::Acceleration(n, d) => {
                    format!("Acceleration(node: \"n{n}\", dof: {}, absolute: true)", DOFS[*d])
                }
                Output::End(e, end, d) => {
                    format!("ElementForce(element: \"e{e}\", end: {end}, dof: {})", DOFS[*d])
                }
                Output::LinkForce(e, a) => {
                    format!("LinkForce(link: \"e{e}\", {})", coordinate(spec, *e, *a))
                }
                Output::LinkDeformation(e, a) => {
                    format!("LinkDeformation(link: \"e{e}\", {})", coordinate(spec, *e, *a))
                }
            };
            format!("\"o{i}\": {what}")
        }),
    ));
    s.push_str(")\n");
    s
}

/// A local axis of a link; a body in finite rotation has the directions of its node instead.
fn coordinate(spec: &Spec, element: usize, axis: usize) -> String {
    match spec.members[element].kind {
        Kind::Link(Law::Rocking(_), _) => {
            let place = match axis {
                0 => 2,
                1 => 0,
                _ => 4,
            };
            format!("coordinate: {place}")
        }
        _ => format!("axis: {}", AXES[axis]),
    }
}

fn block(name: &str, items: impl Iterator<Item = String>) -> String {
    let mut s = format!("    {name}: {{\n");
    for item in items {
        let _ = writeln!(s, "        {item},");
    }
    s.push_str("    },");
    s
}

fn triple(x: &[f64; 3]) -> String {
    format!("({:?}, {:?}, {:?})", x[0], x[1], x[2])
}

fn list(x: &[f64]) -> String {
    let all: Vec<String> = x.iter().map(|v| format!("{v:?}")).collect();
    format!("[{}]", all.join(", "))
}

fn cases(spec: &Spec) -> String {
    let mut s = String::from("    cases: {\n");
    if spec.gravity {
        s.push_str("        \"weight\": Static(loads: [Gravity], steps: 16),\n");
    }
    s.push_str("        \"motion\": Dynamic(\n");
    if spec.gravity {
        s.push_str("            after: \"weight\",\n");
    }
    let _ = writeln!(s, "            duration: {:?}, dt: {:?},", spec.duration, spec.dt);
    let all: Vec<String> =
        (0..spec.forces.len()).map(|i| format!("(load: \"p{i}\", function: \"f{i}\")")).collect();
    let _ = writeln!(s, "            forces: [{}],", all.join(", "));
    let bases = spec.base.iter().enumerate();
    let all: Vec<String> = bases
        .map(|(i, b)| format!("(direction: {}, function: \"b{i}\")", ["X", "Y", "Z"][b.0]))
        .collect();
    let _ = writeln!(s, "            base: [{}],", all.join(", "));
    let moved = spec.moved.iter().enumerate();
    let all: Vec<String> = moved
        .map(|(i, (n, d, _))| {
            format!("(node: \"n{n}\", dof: {}, displacement: \"m{i}\")", DOFS[*d])
        })
        .collect();
    let _ = writeln!(s, "            supports: [{}],", all.join(", "));
    let all: Vec<String> = spec
        .initial
        .iter()
        .map(|(n, d, u, v)| {
            format!("(node: \"n{n}\", dof: {}, displacement: {u:?}, velocity: {v:?})", DOFS[*d])
        })
        .collect();
    let _ = writeln!(s, "            initial: [{}],", all.join(", "));
    if let Some(tolerance) = spec.tolerance {
        let _ = writeln!(s, "            step: Adaptive(tolerance: {tolerance:?}),");
    }
    let basis = match spec.basis {
        Basis::Ritz => String::new(),
        Basis::RitzOf(n) => format!("            basis: Ritz(vectors: {n}),\n"),
        Basis::EigenOf(n) => format!("            basis: Eigen(vectors: {n}),\n"),
        Basis::Complete => "            basis: Complete,\n".into(),
    };
    s.push_str(&basis);
    s.push_str("        ),\n    },");
    s
}

fn function(f: &Function, unit: &str) -> String {
    let a = |x: &f64| format!("\"{x:?}{unit}\"");
    match f {
        Function::Step(x, start) => format!("Step(amplitude: {}, start: {start:?})", a(x)),
        Function::Ramp(x, start, rise) => {
            format!("Ramp(amplitude: {}, start: {start:?}, rise: {rise:?})", a(x))
        }
        Function::Sine(x, f, cycles) => {
            format!("Sine(amplitude: {}, frequency: {f:?}, cycles: {cycles:?})", a(x))
        }
        Function::HalfSine(x, start, length) => {
            format!("HalfSine(amplitude: {}, start: {start:?}, duration: {length:?})", a(x))
        }
        Function::Ricker(x, f, centre) => {
            format!("Ricker(amplitude: {}, frequency: {f:?}, center: {centre:?})", a(x))
        }
        Function::Points(points) => {
            let all: Vec<String> =
                points.iter().map(|(t, x)| format!("({t:?}, {})", a(x))).collect();
            format!("Points(points: [{}], after_end: Zero)", all.join(", "))
        }
    }
}

fn kind(kind: &Kind) -> (&'static str, String) {
    let axis = |a: usize| format!("axis: {}", AXES[a]);
    match kind {
        Kind::Beam(b) => {
            let mut s = format!(
                "young: {:?}, shear_modulus: {:?}, area: {:?}, i2: {:?}, i3: {:?}, torsion: {:?}",
                b.young, b.shear, b.area, b.i2, b.i3, b.torsion
            );
            if b.kappa > 0.0 {
                let _ = write!(s, ", shear_coefficient: {:?}", b.kappa);
            }
            let _ = write!(s, ", density: {:?}, mass_matrix: {}", b.density, spread(b.consistent));
            ("Beam", s)
        }
        Kind::Truss(e, a, density, consistent) => {
            let how = spread(*consistent);
            (
                "Truss",
                format!("young: {e:?}, area: {a:?}, density: {density:?}, mass_matrix: {how}"),
            )
        }
        Kind::Spring(k, c) => {
            let names = ["k1", "k2", "k3", "r1", "r2", "r3", "c1", "c2", "c3", "cr1", "cr2", "cr3"];
            let given = names.iter().zip(k.iter().chain(c)).filter(|(_, x)| **x != 0.0);
            let all: Vec<String> = given.map(|(n, x)| format!("{n}: {x:?}")).collect();
            ("Spring", all.join(", "))
        }
        Kind::Mass(m, j) => {
            let inertia =
                if *j == [0.0; 3] { String::new() } else { format!(", inertia: {}", triple(j)) };
            ("Mass", format!("mass: {m:?}{inertia}"))
        }
        Kind::Inerter(b, a) => ("Inerter", format!("b: {b:?}, {}", axis(*a))),
        Kind::RigidLink => ("RigidLink", String::new()),
        Kind::EqualDof(dofs) => {
            let all: Vec<&str> = dofs.iter().map(|d| DOFS[*d]).collect();
            ("EqualDof", format!("dofs: ({})", all.join(", ")))
        }
        Kind::RigidBody => ("RigidBody", String::new()),
        Kind::Diaphragm => ("Diaphragm", String::new()),
        Kind::Link(l, a) => law(l, &axis(*a), *a > 2),
    }
}

fn spread(consistent: bool) -> &'static str {
    if consistent { "Consistent" } else { "Lumped" }
}
