//! The matrices of one structure in every form that is read are the same, and so is what it does.

use std::fmt::Write;
use std::sync::Arc;
use trilith_element::{MeshRow, SparseMatrix, Value};
use trilith_model::{Model, SolverKind, resolved};
use trilith_solvers::modes;
use trilith_tests::{parse, registry, root, shipped_text, trace};

/// The wall that is shipped, for the first part of its motion.
fn wall() -> String {
    shipped_text("rocking_wall.ron").replace("\"4 s\"", "\"0.15 s\"")
}

/// A matrix of the element `wall`, as it was read.
fn matrix(model: &Model, name: &str) -> Arc<SparseMatrix> {
    let element = model.elements.iter().find(|e| e.name == "wall").expect("a wall");
    match element.values.get(name) {
        Some(Value::Matrix(matrix)) => Arc::clone(matrix),
        other => panic!("{name}: {other:?}"),
    }
}

/// Node and direction, 1 or 3, of a row of the wall: its mesh has Ux and Uz of node after node.
fn place(row: u32) -> (u32, u32) {
    (row / 2 + 1, 1 + 2 * (row % 2))
}

/// One triangle of it, with its rows from 0.
fn triangle(a: &SparseMatrix, lower: bool) -> Vec<(u32, u32, f64)> {
    let mut own: Vec<_> = a.entries.iter().copied().filter(|(i, j, _)| (i >= j) == lower).collect();
    if !lower {
        own.extend(a.entries.iter().filter(|(i, j, _)| i == j));
    }
    own.sort_by_key(|(i, j, _)| (*j, *i));
    own
}

/// As CalculiX writes it.
fn calculix(a: &SparseMatrix, lower: bool) -> String {
    let line = |(i, j, v): (u32, u32, f64)| format!("{} {} {v:20.13e}\n", i + 1, j + 1);
    triangle(a, lower).into_iter().map(line).collect()
}

/// A number of eleven digits in 16 characters, the exponent without its letter.
fn sixteen(v: f64) -> String {
    let text = format!("{v:.10e}");
    let (digits, exponent) = text.split_once('e').expect("an exponent");
    let exponent: i32 = exponent.parse().expect("a number");
    format!("{digits:>13}{exponent:+03}")
}

/// As DMIG in large fields, lines that go on with `*`.
fn large(name: &str, a: &SparseMatrix) -> String {
    let mut text = format!("DMIG*   {name:<16}{:>16}{:>16}{:>16}\n*\n", 0, 6, 2);
    let mut last = None;
    for (i, j, v) in triangle(a, true) {
        let ((g, c), (gj, cj)) = (place(i), place(j));
        if last.replace(j) != Some(j) {
            let _ = writeln!(text, "DMIG*   {name:<16}{gj:>16}{cj:>16}");
        }
        let _ = writeln!(text, "*       {g:>16}{c:>16}{}", sixteen(v));
    }
    text
}

/// As DMIG in free fields, all of it, three digits of the exponent behind a D.
fn free(name: &str, a: &SparseMatrix) -> String {
    let mut text = format!("DMIG,{name},0,1,1\n");
    for (i, j, v) in &a.entries {
        // Rows are columns of what is symmetric.
        let ((g, c), (gj, cj)) = (place(*j), place(*i));
        let v = format!("{v:e}").replace('e', "D");
        let _ = writeln!(text, "DMIG,{name},{gj},{cj},,{g},{c},{v}");
    }
    text
}

/// As DMIG in small fields, which a mass of seven characters fits into.
fn small(name: &str, a: &SparseMatrix) -> String {
    let mut text = format!("DMIG    {name:<8}{:<8}{:<8}{:<8}\n", 0, 6, 1);
    for (i, j, v) in triangle(a, true) {
        let ((g, c), (gj, cj)) = (place(i), place(j));
        let _ = writeln!(text, "DMIG    {name:<8}{gj:<8}{cj:<8}{:8}{g:<8}{c:<8}{v:<8}", "");
    }
    text
}

fn contents(field: &str, name: &str, text: &str) -> String {
    format!("{field}: Contents(\"{name}\", \"{text}\"),\n")
}

/// The wall with its three files replaced by these fields.
fn with(fields: &str) -> String {
    let text = wall();
    let (before, rest) = text.split_once("stiffness: \"superelements").expect("its files");
    let (_, after) = rest.split_once("wall_rows.csv\",").expect("its table");
    format!("{before}{fields}{after}")
}

fn forms(k: &SparseMatrix, m: &SparseMatrix) -> Vec<(&'static str, String)> {
    let dofs: String = (0..k.size as u32).map(place).map(|(n, d)| format!("{n}.{d}\n")).collect();
    let dofs = contents("rows", "wall.dof", &dofs);
    let both = format!("{}{}ENDDATA\n", large("KAAX", k), small("MAAX", m));
    let of = |own: [String; 2]| own.concat();
    let sti = |lower| {
        of([
            contents("stiffness", "w.sti", &calculix(k, lower)),
            contents("mass", "w.mas", &calculix(m, lower)),
        ])
    };
    vec![
        ("CalculiX", sti(false) + &dofs),
        ("CalculiX, other triangle", sti(true) + &dofs),
        (
            "DMIG, large and small",
            of([contents("stiffness", "w.pch:KAAX", &both), contents("mass", "w.pch:MAAX", &both)]),
        ),
        (
            "DMIG, free",
            of([
                contents("stiffness", "k.pch", &free("K", k)),
                contents("mass", "m.pch", &free("M", m)),
            ]),
        ),
    ]
}

#[test]
fn a_wall_in_every_form_is_the_same_wall_and_moves_the_same() {
    let (model, system) = parse(&wall(), &[]);
    let (k, m) = (matrix(&model, "stiffness"), matrix(&model, "mass"));
    assert_eq!((k.size, k.entries.len(), m.entries.len()), (182, 2394, 182));
    let (own, _) = trace(&model, &system, SolverKind::Fna);
    assert!(own.peak(0) > 1e-4, "{}", own.peak(0));
    for (form, fields) in forms(&k, &m) {
        let (model, system) = parse(&with(&fields), &[]);
        for (name, wanted) in [("stiffness", &k), ("mass", &m)] {
            let found = matrix(&model, name);
            assert_eq!((found.size, &found.entries), (wanted.size, &wanted.entries), "{form}");
            let named = |row: &MeshRow| row.to_string();
            let rows: Vec<String> = found.rows.iter().map(named).collect();
            let listed = form.starts_with("DMIG");
            let wanted: Vec<String> =
                (0..182).map(place).map(|(n, d)| format!("{n}.{d}")).collect();
            assert_eq!(rows, if listed { wanted } else { Vec::new() }, "{form}");
        }
        let (found, _) = trace(&model, &system, SolverKind::Fna);
        assert_eq!((&found.max, &found.min), (&own.max, &own.min), "{form}");
        // What is written of the model reads back to the same.
        let (again, _) = parse(&resolved(&model), &[]);
        for name in ["stiffness", "mass"] {
            let (a, b) = (matrix(&again, name), matrix(&model, name));
            assert_eq!((&a.entries, &a.rows, &a.name), (&b.entries, &b.rows, &b.name), "{form}");
        }
    }
}

#[test]
fn what_does_not_go_together_is_told_where_the_model_says_it() {
    let (model, _) = parse(&wall(), &[]);
    let (k, m) = (matrix(&model, "stiffness"), matrix(&model, "mass"));
    let told = |fields: &str| {
        let path = root().join("models/test.ron");
        let errors = trilith_model::read_text(&with(fields), &path, &registry(), &[]).unwrap_err();
        errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    let sti = contents("stiffness", "w.sti", &calculix(&k, true));
    let pch = contents("stiffness", "w.pch", &free("K", &k));
    let dofs = contents("rows", "w.dof", "1.1\n1.3\n");
    let error = told(&format!("{sti}{dofs}"));
    assert!(error.contains("`rows`: w.dof: 2 lines, and the matrices have 182 rows"), "{error}");
    let error = told(&sti);
    assert!(error.contains("w.sti does not say what its rows are: a table of `rows`"), "{error}");
    let error = told(&format!("{pch}{dofs}"));
    assert!(error.contains("w.pch says itself what its rows are: leave out `rows`"), "{error}");
    let error = told(&format!("{pch}{}", contents("mass", "w.mas", &calculix(&m, true))));
    assert!(error.contains("one of w.mas and w.pch says what its rows are"), "{error}");
    let error = told(&contents("stiffness", "w.pch:KAAX", &free("K", &k)));
    assert!(error.contains("w.pch: there is no matrix `KAAX`: the file has K"), "{error}");
}

/// Files of CalculiX 2.20, and the frequencies that it prints of the same column held at its base.
#[test]
fn a_column_that_calculix_has_written_has_the_frequencies_that_calculix_has_found() {
    let text = r#"(
        nodes: { "a": (0, 0, 0), "b": (0.4, 0, 0), "c": (0.4, 0.5, 0), "d": (0, 0.5, 0) },
        supports: { "a": Pinned, "b": Pinned, "c": Pinned, "d": Pinned },
        elements: { "wall": Superelement(nodes: { "1": "a", "2": "b", "3": "c", "4": "d" },
            stiffness: "../tests/data/calculix/column.sti", mass: "../tests/data/calculix/column.mas",
            rows: "../tests/data/calculix/column.dof") },
        cases: { "weight": Static(loads: [Gravity]) },
        outputs: { "up": Reaction(node: "a", dof: Uz) },
    )"#;
    let (model, system) = parse(text, &[]);
    assert_eq!((matrix(&model, "mass").size, system.order()), (48, 36));
    assert_eq!(system.inner.doubts, Vec::<String>::new());
    let found = modes(&model, &system, None).unwrap();
    let wanted = [46.75033, 50.06887, 184.9510, 295.3696, 301.2747, 312.3381];
    for (omega, wanted) in found.omega.iter().zip(wanted) {
        let f = omega / std::f64::consts::TAU;
        // Its seven digits.
        assert!((f - wanted).abs() < 1e-6 * wanted, "{f} and {wanted}");
    }
    // ρ V, in the middle.
    let sum = system.mass_sum(&model);
    let mass = 2500.0 * 0.4 * 0.5 * 3.0;
    assert!((sum.mass[2] - mass).abs() < 1e-9 * mass, "{}", sum.mass[2]);
    for (found, wanted) in sum.centre.iter().zip([0.2, 0.25, 1.5]) {
        assert!((found - wanted).abs() < 1e-9, "{found}");
    }
}
