//! Frequencies of linear structures, in the complete basis of FNA.

use crate::unit::{HERTZ, NUMBER, SECOND, Unit};
use crate::{Case, Check, Solver};
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

const MODES: &[Solver] = &[Solver::Modes];
const SQUARED: Unit = Unit::si("rad²/s²");

pub(super) fn cases() -> Vec<Case> {
    let mut all = vec![lm1()];
    all.extend(lm3());
    all.extend([lm4(), lm6()]);
    all.extend(lm9());
    all.extend(lm10());
    all.push(fn1());
    all
}

/// Parts of a generated model: nodes, supports, elements.
#[derive(Default)]
struct Parts {
    nodes: String,
    supports: String,
    elements: String,
}

impl Parts {
    fn node(&mut self, name: &str, [x, y, z]: [f64; 3]) {
        let _ = writeln!(self.nodes, "        \"{name}\": ({x}, {y}, {z}),");
    }

    fn support(&mut self, name: &str, fixed: &str) {
        let _ = writeln!(self.supports, "        \"{name}\": {fixed},");
    }

    fn element(&mut self, name: &str, kind: &str, place: &str) {
        let _ = writeln!(self.elements, "        \"{name}\": {kind}({place}),");
    }

    /// The model text; `head` holds title, units, plane and properties.
    fn model(&self, head: &str) -> String {
        let supports = if self.supports.is_empty() {
            String::new()
        } else {
            format!("    supports: {{\n{}    }},\n", self.supports)
        };
        format!(
            "(\n{head}\n    nodes: {{\n{}    }},\n{supports}    elements: {{\n{}    }},\n    \
             cases: {{ \"modes\": Dynamic(duration: 1, dt: 0.1, basis: Complete) }},\n)\n",
            self.nodes, self.elements
        )
    }
}

fn frequency(i: usize, reference: f64, tolerance: f64) -> Check {
    Check::new(format!("f{}", i + 1), HERTZ, reference, tolerance, move |r| r.omega(i))
}

fn eigenvalue(i: usize, reference: f64, tolerance: f64) -> Check {
    Check::new(format!("ω{}²", i + 1), SQUARED, reference, tolerance, move |r| r.omega(i).powi(2))
}

fn case(
    id: &'static str,
    title: &'static str,
    source: &'static str,
    text: String,
    checks: Vec<Check>,
) -> Case {
    Case {
        id,
        title,
        source,
        text,
        set: Vec::new(),
        solvers: MODES,
        view: crate::View::default(),
        checks,
    }
}

fn lm1() -> Case {
    let mut parts = Parts::default();
    for j in 0..=9 {
        for i in 0..=10 {
            let (i_, j_) = (f64::from(i), f64::from(j));
            parts.node(&format!("{i} {j}"), [20.0 * i_, 0.0, 10.0 * j_]);
            if j == 0 {
                parts.support(&format!("{i} 0"), "Fixed");
                continue;
            }
            let column = format!("nodes: (\"{i} {}\", \"{i} {j}\"), use: \"member\"", j - 1);
            parts.element(&format!("column {i} {j}"), "Beam", &column);
            if i > 0 {
                let beam = format!("nodes: (\"{} {j}\", \"{i} {j}\"), use: \"member\"", i - 1);
                parts.element(&format!("beam {i} {j}"), "Beam", &beam);
            }
        }
    }
    let head = r#"    title: "Frame of Bathe and Wilson",
    units: (length: "ft", force: "kip", time: "s"),
    plane: XZ,
    properties: { "member": Beam(young: 432000, area: 3, i3: 1, distributed_mass: 3) },"#;
    let published = [0.589541, 5.52695, 16.5878];
    case(
        "LM-1",
        "Plane frame, ten bays and nine storeys",
        "Bathe, Wilson; CSI Software Verification 1-021",
        parts.model(head),
        published
            .into_iter()
            .enumerate()
            .map(|(i, x)| eigenvalue(i, x, 1e-5).published())
            .collect(),
    )
}

/// A cantilever in n parts, mass spread as said.
fn cantilever(n: u32, i3: f64, mass: &str) -> String {
    let mut parts = Parts::default();
    for i in 0..=n {
        parts.node(&i.to_string(), [96.0 * f64::from(i) / f64::from(n), 0.0, 0.0]);
        if i == 0 {
            parts.support("0", "Fixed");
        } else {
            // Bending only, as in the reference.
            parts.support(&i.to_string(), "Ux");
            let place = format!("nodes: (\"{}\", \"{i}\"), use: \"member\"", i - 1);
            parts.element(&format!("part {i}"), "Beam", &place);
        }
    }
    parts.model(&format!(
        "    title: \"Cantilever\",\n    units: (length: \"in\", force: \"kip\", time: \"s\"),\n    \
         plane: XZ,\n    properties: {{ \"member\": Beam(young: 3600, area: 216, i3: {i3}, \
         density: 2.3e-7, mass_matrix: {mass}) }},"
    ))
}

fn lm3() -> Vec<Case> {
    let source = "CSI Software Verification 1-014";
    let period = |i: usize, reference: f64| {
        // Five digits are printed.
        Check::new(format!("T{}", i + 1), SECOND, reference, 1e-4, move |r| TAU / r.omega(i))
    };
    // (β L)² of a clamped-free beam.
    let exact = |i3: f64| -> Vec<Check> {
        [1.875_104_068_7, 4.694_091_133, 7.854_757_438_2, 10.995_540_734_9, 14.137_168_391]
            .into_iter()
            .enumerate()
            .map(|(i, b): (usize, f64)| {
                let w = (b / 96.0).powi(2) * (3600.0 * i3 / (2.3e-7 * 216.0)).sqrt();
                period(i, TAU / w)
            })
            .collect()
    };
    let mut all = vec![
        case(
            "LM-3a",
            "Cantilever, weak axis, 60 elements with consistent mass",
            "Bernoulli beam, clamped and free",
            cantilever(60, 2592.0, "Consistent"),
            exact(2592.0),
        ),
        case(
            "LM-3b",
            "Cantilever, strong axis, 60 elements with consistent mass",
            "Bernoulli beam, clamped and free",
            cantilever(60, 5832.0, "Consistent"),
            exact(5832.0),
        ),
    ];
    for (id, title, n, t) in [
        ("LM-3c", "Cantilever, lumped mass, 1 element", 1, 0.054547),
        ("LM-3d", "Cantilever, lumped mass, 2 elements", 2, 0.042333),
        ("LM-3e", "Cantilever, lumped mass, 4 elements", 4, 0.039090),
        ("LM-3f", "Cantilever, lumped mass, 10 elements", 10, 0.038175),
        ("LM-3g", "Cantilever, lumped mass, 96 elements", 96, 0.038003),
    ] {
        let checks = vec![period(0, t).published()];
        all.push(case(id, title, source, cantilever(n, 2592.0, "Lumped"), checks));
    }
    all
}

fn lm4() -> Case {
    let mut parts = Parts::default();
    parts.node("centre", [0.0; 3]);
    for arm in 0..8 {
        let angle = PI / 4.0 * f64::from(arm);
        let n = 6;
        for i in 1..=n {
            let r = 5.0 * f64::from(i) / f64::from(n);
            let name = format!("{arm} {i}");
            // Rounded, so that upright arms are exactly upright.
            let round = |x: f64| (x * 1e9).round() / 1e9;
            parts.node(&name, [round(r * angle.cos()), 0.0, round(r * angle.sin())]);
            let before = if i == 1 { "centre".to_owned() } else { format!("{arm} {}", i - 1) };
            let place = format!("nodes: (\"{before}\", \"{name}\"), use: \"arm\"");
            parts.element(&format!("arm {name}"), "Beam", &place);
        }
        parts.support(&format!("{arm} {n}"), "(Ux, Uz)");
    }
    let head = r#"    title: "Double cross with pinned ends",
    plane: XZ,
    properties: {
        "arm": Beam(
            young: "200 GPa", area: 0.015625, i3: "0.125^4/12", density: "8000 kg/m^3",
            mass_matrix: Consistent,
        ),
    },"#;
    let published = [(0, 11.336), (1, 17.709), (7, 17.709), (8, 45.345), (9, 57.390), (15, 57.390)];
    case(
        "LM-4",
        "Pin-ended double cross",
        "NAFEMS FV2",
        parts.model(head),
        published.map(|(i, f)| frequency(i, f, 1e-2).published()).into(),
    )
}

fn lm6() -> Case {
    let mut parts = Parts::default();
    let n = 20;
    for i in 0..=n {
        let name = i.to_string();
        parts.node(&name, [10.0 * f64::from(i) / f64::from(n), 0.0, 0.0]);
        // The beam has no rotary inertia of its own: ρ I times the length that belongs to the node.
        let share = if i == 0 || i == n { 0.5 } else { 1.0 };
        let inertia = 8000.0 * 16.0 / 12.0 * 10.0 / f64::from(n) * share;
        let place = format!("node: \"{name}\", inertia: (0, {inertia}, {inertia})");
        parts.element(&format!("rotary {name}"), "Mass", &place);
        if i > 0 {
            let place = format!("nodes: (\"{}\", \"{name}\"), use: \"beam\"", i - 1);
            parts.element(&format!("beam {name}"), "Beam", &place);
        }
    }
    parts.support("0", "(Ux, Uy, Uz, Rx)");
    parts.support(&n.to_string(), "(Uy, Uz)");
    let head = r#"    title: "Deep beam",
    properties: {
        "beam": Beam(
            young: "200 GPa", poisson: 0.3, area: 4, i2: "16/12", i3: "16/12",
            torsion: "0.1406*16", shear_coefficient: "5/6", density: "8000 kg/m^3",
            mass_matrix: Consistent,
        ),
    },"#;
    let published = [42.650, 42.650, 71.20, 125.00, 148.15, 148.15, 213.61, 283.47, 283.47];
    case(
        "LM-6",
        "Deep simply supported beam",
        "NAFEMS FV5",
        parts.model(head),
        published
            .into_iter()
            .enumerate()
            .map(|(i, f)| frequency(i, f, 1.5e-2).published())
            .collect(),
    )
}

/// Masses and springs in a row; no mass: held. Units: of the numbers.
fn chain(units: &str, masses: &[Option<f64>], springs: &[f64]) -> String {
    let mut parts = Parts::default();
    for (i, m) in masses.iter().enumerate() {
        let name = i.to_string();
        parts.node(&name, [i as f64, 0.0, 0.0]);
        match m {
            None => parts.support(&name, "Fixed"),
            Some(m) => {
                parts.support(&name, "(Uy, Uz, Rx, Ry, Rz)");
                parts.element(&format!("mass {i}"), "Mass", &format!("node: \"{i}\", mass: {m}"));
            }
        }
    }
    for (i, k) in springs.iter().enumerate() {
        let place = format!("nodes: (\"{i}\", \"{}\"), k1: {k}", i + 1);
        parts.element(&format!("spring {i}"), "Spring", &place);
    }
    parts.model(&format!("    title: \"Masses and springs in a row\",\n{units}"))
}

const RIGID_BAR: &str = r#"(
    title: "Rigid bar on two springs",
    units: (length: "ft", force: "lbf", time: "s"),
    plane: XZ,
    nodes: { "cg": (0, 0, 0), "left": (-4.5, 0, 0), "right": (5.5, 0, 0) },
    supports: { "cg": Ux },
    elements: {
        "bar": RigidBody(nodes: ("cg", "left", "right")),
        "mass": Mass(node: "cg", mass: 100, inertia: (0, 1600, 0)),
        "spring left": Spring(node: "left", k1: 2400),
        "spring right": Spring(node: "right", k1: 2600),
    },
    cases: { "modes": Dynamic(duration: 1, dt: 0.1) },
)"#;

fn lm9() -> Vec<Case> {
    let us = "    units: (length: \"in\", force: \"lbf\", time: \"s\"),";
    // Closed forms of two or few masses; the tolerance is that of the printed digits.
    let mut masses = vec![Some(10.0); 8];
    masses.insert(0, None);
    masses.push(None);
    let row = (1..=8).map(|j| {
        let f = (1e5_f64 / 10.0).sqrt() / PI * (f64::from(j) * PI / 18.0).sin();
        frequency(j as usize - 1, f, 1e-9)
    });
    let small = [0.139300647653736, 1.05865310768512, 4.9582024008173];
    vec![
        case(
            "LM-9a",
            "Eight masses between two walls",
            "Code_Aster SDLD02: fⱼ = √(k/m)/π sin(jπ/18)",
            chain("", &masses, &[1e5; 9]),
            row.collect(),
        ),
        case(
            "LM-9b",
            "Three masses and springs",
            "OpenSees verification SmallEigen",
            chain("", &[None, Some(11.1), Some(22.2), Some(33.3)], &[30.0, 20.0, 10.0]),
            small
                .into_iter()
                .enumerate()
                .map(|(i, x)| eigenvalue(i, x, 1e-10).published())
                .collect(),
        ),
        case(
            "LM-9c",
            "Two masses between two walls",
            "ANSYS VM89",
            chain(us, &[None, Some(0.5), Some(1.0), None], &[200.0, 800.0, 200.0]),
            vec![frequency(0, 2.58139, 1e-5).published(), frequency(1, 8.32630, 1e-5).published()],
        ),
        case(
            "LM-9d",
            "Rigid bar on two springs",
            "ANSYS VM52",
            RIGID_BAR.into(),
            vec![
                frequency(0, 1.098_078, 1e-5).published(),
                frequency(1, 1.440_586, 1e-5).published(),
            ],
        ),
    ]
}

fn lm10() -> Vec<Case> {
    let mut beam = Parts::default();
    let n = 16;
    for i in 0..=n {
        let name = i.to_string();
        beam.node(&name, [80.0 * f64::from(i) / f64::from(n), 0.0, 0.0]);
        beam.support(&name, if i == 0 || i == n { "(Ux, Uz)" } else { "Ux" });
        if i > 0 {
            let place = format!("nodes: (\"{}\", \"{i}\"), use: \"beam\"", i - 1);
            beam.element(&format!("beam {i}"), "Beam", &place);
        }
    }
    let head = r#"    title: "Simple beam",
    units: (length: "in", force: "lbf", time: "s"),
    plane: XZ,
    properties: {
        "beam": Beam(young: 30e6, area: 4, i3: "4/3", density: 7.28e-4, mass_matrix: Consistent),
    },"#;
    let mut rod = Parts::default();
    let m = 80;
    for i in 0..=m {
        rod.node(&i.to_string(), [10.0 * f64::from(i), 0.0, 0.0]);
        rod.support(&i.to_string(), "(Uy, Uz, Rx, Ry, Rz)");
        if i > 0 {
            let place = format!("nodes: (\"{}\", \"{i}\"), use: \"rod\"", i - 1);
            rod.element(&format!("rod {i}"), "Truss", &place);
        }
    }
    let rod_head = r#"    title: "Free rod",
    units: (length: "in", force: "lbf", time: "s"),
    properties: {
        "rod": Truss(young: 30e6, area: 1, density: 7.3e-4, mass_matrix: Consistent),
    },"#;
    // Four to five digits are printed; the elements are fine enough for 0.1 %.
    vec![
        case(
            "LM-10a",
            "Simply supported beam",
            "ANSYS VM50",
            beam.model(head),
            vec![frequency(0, 28.766, 1e-3).published()],
        ),
        case(
            "LM-10b",
            "Longitudinal vibration of a free rod",
            "ANSYS VM61",
            rod.model(rod_head),
            vec![
                frequency(0, 0.0, 1e-4).absolute(),
                frequency(1, 126.70, 1e-3).published(),
                frequency(2, 253.40, 1e-3).published(),
            ],
        ),
    ]
}

/// Ten storeys in the complete basis: frequencies and effective masses.
fn fn1() -> Case {
    let mut masses = vec![Some(1.0); 10];
    masses.insert(0, None);
    let text = chain("", &masses, &[1.0; 10]);
    let mut checks = Vec::new();
    for j in 1..=5 {
        let w = 2.0 * (f64::from(2 * j - 1) * PI / 42.0).sin();
        checks.push(Check::new(format!("ω{j}"), Unit::si("rad/s"), w, 1e-9, move |r| {
            r.omega(j as usize - 1)
        }));
    }
    for (j, share) in [0.847925, 0.091408, 0.030915, 0.014286, 0.007488].into_iter().enumerate() {
        let check = Check::new(format!("mass share {}", j + 1), NUMBER, share, 1e-6, move |r| {
            let basis = r.basis.as_ref();
            basis.and_then(|b| b.mass_participation.get(j)).map_or(f64::NAN, |m| m[0])
        });
        checks.push(check.absolute());
    }
    case("FN-1", "Ten equal storeys", "ωⱼ = 2 √(k/m) sin((2j − 1) π/42)", text, checks)
}
