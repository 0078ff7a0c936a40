//! `trilith check`: the sheet and the model with every default filled in.

mod common;

use common::trilith;

const BUILDING: &str = r#"(
    title: "Slab on bearings",
    parameters: { "g0": "0.3 g" },
    nodes: {
        "a": (0, 0, 0), "b": (6, 0, 0), "c": (6, 4, 0), "d": (0, 4, 0), "slab": (3, 2, 0.5),
    },
    elements: {
        "slab": Mass(node: "slab", mass: "40 t", inertia: (60e3, 130e3, 180e3)),
        "stiff": RigidBody(nodes: ["slab", "a", "b", "c", "d"]),
        "bearing {n}": For(n: ["a", "b", "c", "d"],
            of: Wen(node: "{n}", axis: U2, k: "2 MN/m", fy: "20 kN", ratio: 0.1)),
        "other {n}": For(n: ["a", "b", "c", "d"],
            of: Wen(node: "{n}", axis: U3, k: "2 MN/m", fy: "20 kN", ratio: 0.1)),
        "foot {n}": For(n: ["a", "b", "c", "d"], of: Spring(node: "{n}", k1: "1 GN/m")),
    },
    functions: { "shake": Sine(amplitude: "g0", frequency: "1 Hz", cycles: 3) },
    cases: {
        "weight": Static(loads: [Gravity]),
        "shaken": Dynamic(after: "weight", duration: 5, dt: 0.01, base: [(direction: X, function: "shake")]),
    },
    outputs: { "x": Displacement(node: "slab", dof: Ux), "v": BaseShear(direction: X) },
)"#;

fn sheet(text: &str) -> (String, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.ron"), text).unwrap();
    let (status, out, err) = trilith(folder.path(), &["check", "model.ron"]);
    assert_eq!(status, 0, "{err}");
    (out, err)
}

/// The lines of a key, and those below it without one.
fn lines(sheet: &str, key: &str) -> Vec<String> {
    let mut all = Vec::new();
    let mut on = false;
    for line in sheet.lines() {
        let (head, rest) = line.split_at_checked(11).unwrap_or((line, ""));
        if !head.trim().is_empty() {
            on = head.trim() == key;
        }
        if on {
            all.push(rest.trim().to_owned());
        }
    }
    assert!(!all.is_empty(), "no `{key}` in\n{sheet}");
    all
}

#[test]
fn the_sheet_says_what_the_structure_is() {
    let (out, _) = sheet(BUILDING);
    let line = |key: &str| lines(&out, key)[0].clone();
    assert_eq!(line("model"), "Slab on bearings");
    assert_eq!(line("counts"), "5 nodes, 5 elements, 8 links, 1 constraint, 0 supports");
    assert_eq!(line("mass"), "40 t");
    assert_eq!(line("weight"), "392.3 kN at g = 9.807 m/s²");
    assert_eq!(line("centre"), "of gravity at (3, 2, 0.5) m");
    assert!(
        line("reactions").starts_with("392.3 kN under gravity, 100.00 % of the weight"),
        "{out}"
    );
    assert_eq!(line("freedoms"), "3 freedoms without links: as a rigid body X, Y, about Z");
    // 4 · 2 MN/m hold 40 t: 0.4443 s; about Z they hold 180 t·m² at 13 m².
    let periods = lines(&out, "periods");
    assert!(periods[0].ends_with("links engaged") && periods[0].contains("0.44"), "{out}");
    assert!(periods[1].starts_with("∞ (3 free)") && periods[1].ends_with("links open"), "{out}");
    let cases = lines(&out, "cases");
    assert_eq!(cases[0], "\"weight\" static: weight, sum (0 N, 0 N, -392.3 kN)");
    assert!(cases[1].contains("after \"weight\": 5 s in 500 steps; base X up to 0.3 g"), "{out}");
    assert_eq!(line("outputs"), "2 outputs");
    assert!((12..=18).contains(&out.lines().count()), "{out}");
}

#[test]
fn periods_on_the_sheet_are_those_of_the_oscillator() {
    let (out, _) = sheet(BUILDING);
    let numbers = |line: &str| -> Vec<f64> {
        line.split([',', ' ']).filter_map(|x| x.parse().ok()).collect()
    };
    let engaged = numbers(&lines(&out, "periods")[0]);
    // The slab stands half a metre above its bearings and rocks on springs of 1 GN/m: little longer than 0.4443 s.
    assert!(engaged.len() == 3 && engaged[0] > 0.444 && engaged[0] < 0.46, "{out}");
    let (with, _) =
        sheet(&BUILDING.replace("ratio: 0.1)", "ratio: 0.1, effective_stiffness: \"500 kN/m\")"));
    let secant = numbers(&lines(&with, "periods")[1]);
    assert!(lines(&with, "periods")[1].ends_with("links at their `effective_stiffness`"), "{with}");
    assert!(secant[0] > 0.888 && secant[0] < 0.91, "{with}");
}

#[test]
fn the_sheet_tells_what_is_odd() {
    // Weight on a support itself.
    let beam = r#"(
    plane: XZ,
    nodes: { "i": (0, 0, 0), "j": (4, 0, 0) },
    supports: { "i": Fixed },
    elements: { "b": Beam(nodes: ("i", "j"), section: "IPE 300", material: Steel) },
    loads: { "live": [Uniform(element: "b", dof: Uz, force: "-5 kN/m")] },
    cases: { "c": Static(loads: [Gravity, (load: "live", factor: 1.5)]) },
    outputs: { "u": Displacement(node: "j", dof: Uz, hidden: true), "w": Sum(terms: ["u"]) },
)"#;
    let (out, _) = sheet(beam);
    let reactions = &lines(&out, "reactions")[0];
    assert!(
        reactions.contains("100.00 % of the weight; 828.5 N of it weighs on supports"),
        "{out}"
    );
    assert_eq!(lines(&out, "freedoms")[0], "none: the structure is held without its links");
    assert_eq!(
        lines(&out, "cases")[0],
        "\"c\" static: weight + 1.5 × live, sum (0 N, 0 N, -31.66 kN)"
    );
    assert_eq!(lines(&out, "outputs")[0], "1 output and 1 hidden");
    assert_eq!(lines(&out, "periods").len(), 1, "no links, one line: {out}");
    // Mass that swings free is no error, and is said.
    let free = r#"(
    nodes: { "m": (0, 0, 0) },
    elements: { "m": Mass(node: "m", mass: 2), "k": Spring(node: "m", k1: "1 kN/m") },
    functions: { "f": Constant(1) },
    loads: { "p": [(node: "m", dof: Ux, force: 1)] },
    cases: { "c": Dynamic(duration: 1, dt: 0.01, forces: [(load: "p", function: "f")]) },
)"#;
    let (out, _) = sheet(free);
    assert!(lines(&out, "freedoms")[0].contains("2 left with links engaged"), "{out}");
    assert!(lines(&out, "reactions")[0].contains("something moves without stiffness"), "{out}");
}

#[test]
fn the_resolved_model_is_printed_on_demand_and_is_a_model() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.ron"), BUILDING).unwrap();
    let (status, first, err) = trilith(folder.path(), &["check", "model.ron", "--resolved"]);
    assert_eq!(status, 0, "{err}");
    assert!(first.contains("\"bearing c\": Wen("), "{first}");
    std::fs::write(folder.path().join("again.ron"), &first).unwrap();
    let (_, second, err) = trilith(folder.path(), &["check", "again.ron", "--resolved"]);
    let body = |t: &str| t.lines().filter(|l| !l.starts_with("//")).collect::<String>();
    assert_eq!(body(&first), body(&second), "{err}");
}

#[test]
fn a_superelement_on_a_ground_of_its_own_is_doubted() {
    // Two masses in a row, by matrices; the first has a spring to no node of the model.
    let folder = tempfile::tempdir().unwrap();
    let model = |ground: f64| {
        let k = format!(
            "%%MatrixMarket matrix coordinate real symmetric\\n2 2 3\\n1 1 {}\\n2 1 -1e6\\n2 2 1e6\\n",
            1e6 + ground
        );
        format!(
            r#"(
    plane: XZ,
    nodes: {{ "a": (0, 0, 0), "b": (1, 0, 0) }},
    supports: {{ "a": (Uz, Ry), "b": (Uz, Ry) }},
    elements: {{
        "row": Superelement(nodes: ["a", "b"], stiffness: Contents("k.mtx", "{k}"),
            mass: Contents("m.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 1e3\n2 2 1e3\n"),
            rows: Contents("rows.csv", "row,node,dof\n1,a,Ux\n2,b,Ux\n")),
        "spring": Spring(node: "a", k2: "1 MN/m"),
    }},
    cases: {{ "go": Dynamic(duration: 1, dt: 0.01, initial: [(node: "a", dof: Ux, velocity: 1)]) }},
)"#
        )
    };
    for (ground, doubted) in [(0.0, false), (5e5, true)] {
        std::fs::write(folder.path().join("row.ron"), model(ground)).unwrap();
        let (status, out, err) = trilith(folder.path(), &["check", "row.ron"]);
        assert_eq!(status, 0, "{out}{err}");
        assert_eq!(err.contains("its stiffness stands on a ground of its own"), doubted, "{err}");
    }
}
