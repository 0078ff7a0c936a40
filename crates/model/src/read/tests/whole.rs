use super::*;
use crate::*;
use trilith_element::dimension as d;
use trilith_element::{Dof, Value};

const BLOCK: &str = include_str!("block.ron");

fn number(model: &Model, element: usize, name: &str) -> f64 {
    model.elements[element].values.number(name).expect("a number")
}

#[test]
fn a_full_file_becomes_indices_and_si_numbers() {
    let m = model(BLOCK);
    assert_eq!((m.title.as_str(), m.plane, m.gravity), ("Rigid block", Some(Plane::XZ), 9.80665));
    assert_eq!(m.nodes[0].position, [0.0, 0.0, 2.0]);
    assert_eq!(m.supports[2].fixed, [false, true, false, true, false, false]);
    let foot = &m.elements[1];
    assert_eq!((foot.kind, foot.nodes.as_slice()), ("Slider", &[1][..]));
    assert_eq!((number(&m, 1, "mu"), number(&m, 1, "c")), (0.3, 1e4));
    assert_eq!(number(&m, 2, "c"), 2000.0);
    assert_eq!(foot.values.get("pull"), Some(&Value::Flag(true)));
    let Body::Link(_, options) = &m.elements[2].body else { panic!("a link") };
    assert_eq!(options.effective_stiffness, Some(vec![1e5, 2.0, 3.0]));
    assert!((options.shear_at - 0.1).abs() < 1e-15);
    let lift = &m.patterns[0].forces;
    assert_eq!((lift[0].value, lift[1].value), (0.75 * 1e4 * 9.8, 1000.0));
    let Analysis::Dynamic(run) = &m.cases[1].analysis else { panic!("dynamic") };
    assert_eq!((m.cases[1].after, run.base[0].direction), (Some(0), Dof::Ux));
    assert_eq!(run.supports[0], SupportMotion { node: 3, dof: Dof::Ux, function: 1, factor: 0.5 });
    assert_eq!(m.functions[1].dimension, Some(d::LENGTH));
    assert_eq!(m.functions[1].function.value(1.0, Side::Before), 4.0);
    assert!((m.functions[0].function.peak() - 0.3 * 9.80665).abs() < 1e-12);
    let units: Vec<&str> = m.outputs.iter().map(|o| o.unit.as_str()).collect();
    assert_eq!(units, ["m", "m", "rad/s", "m/s²", "N·m", "rad", "m", "N"]);
    let Quantity::Displacement(uplift) = &m.outputs[1].quantity else { panic!("displacement") };
    assert_eq!(uplift[1].factor, -0.5);
}

#[test]
fn the_resolved_text_reads_back_to_the_same_model() {
    let first = model(BLOCK);
    let text = resolved(&first);
    let second = model(&text);
    let strip = |m: &Model| {
        let mut s = format!("{:?} {:?} {:?} {:?}", m.title, m.plane, m.gravity, m.damping);
        for n in &m.nodes {
            s += &format!("{:?}{:?}", n.name, n.position);
        }
        for x in &m.supports {
            s += &format!("{:?}{:?}", x.node, x.fixed);
        }
        for e in &m.elements {
            let Element { name, kind, nodes, frame, body, values, axes, .. } = e;
            s += &format!("{name}{kind}{nodes:?}{frame:?}{body:?}{values:?}{axes:?}");
        }
        for c in &m.cases {
            s += &format!("{}{:?}{:?}", c.name, c.after, c.analysis);
        }
        s + &format!("{:?}{:?}{:?}", m.functions, m.patterns, m.outputs)
    };
    assert_eq!(strip(&first), strip(&second), "{text}");
    assert!(second.parameters.is_empty());
}

#[test]
fn what_is_left_out_takes_the_default_of_the_card() {
    let m = model(&small(r#"supports: { "a": Pinned }"#));
    assert_eq!(m.gravity, STANDARD_GRAVITY);
    assert_eq!(m.supports[0].fixed, [true, true, true, false, false, false]);
    let text = small("").replace("Spring(", "Slider(").replace("stiffness", "kn");
    let m = model(&text);
    assert_eq!(number(&m, 0, "mu"), 0.5);
    assert_eq!(m.elements[0].values.get("dash"), Some(&Value::Text("contact".into())));
}

#[test]
fn a_set_number_takes_the_dimension_of_the_declared_one() {
    let m = model_with(BLOCK, &[("mass", "12000"), ("cv", "20 kN s/m"), ("record", "other file")]);
    let find = |name: &str| m.parameters.iter().find(|p| p.name == name).map(|p| p.value.clone());
    assert_eq!(find("mass"), Some(ParameterValue::Number(12000.0, d::MASS)));
    assert_eq!(find("record"), Some(ParameterValue::Text("other file".into())));
    assert_eq!(number(&m, 1, "c"), 2e4);
}

#[test]
fn bare_numbers_are_in_the_units_of_the_file() {
    let extra = r#"units: (length: "in", force: "kip", time: "s"),
        functions: { "f": Sine(amplitude: 386.0886, frequency: 1) }"#;
    let text = small(extra).replace("\"1 kN/m\"", "30").replace(
        "Static(loads: [Gravity])",
        r#"Dynamic(duration: 1, dt: 0.1, base: [(direction: Z, function: "f")])"#,
    );
    let m = model(&text);
    assert!((number(&m, 0, "stiffness") / (30.0 * 4448.2216152605 / 0.0254) - 1.0).abs() < 1e-12);
    assert_eq!(m.nodes[1].position[2], 2.0);
    let Analysis::Dynamic(run) = &m.cases[0].analysis else { panic!("dynamic") };
    let amplitude = run.base[0].factor * m.functions[0].function.peak();
    assert!((amplitude - 9.80665).abs() < 1e-5);
}

#[test]
fn a_record_is_read_beside_the_model_file() {
    let folder = std::env::temp_dir().join(format!("trilith-model-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("x.csv"), "# made up\ntime, acc\n0, 0.0\n0.5, 0.1\n1.0, -0.2\n")
        .unwrap();
    let extra = r#"parameters: { "record": Text("x.csv"), "scale": 2, "g": "3 m/s^2" },
        functions: { "f": Table(file: Parameter("record"), value: "acc", unit: "g", scale: "scale") }"#;
    let text = small(extra).replace(
        "Static(loads: [Gravity])",
        r#"Dynamic(duration: 1, dt: 0.1, base: [(direction: X, function: "f")])"#,
    );
    let path = folder.join("model.ron");
    let read = |text: &str| read_text(text, &path, &registry(), &[]);
    let m = read(&text).unwrap_or_else(|e| panic!("{}", shown(&e)));
    assert!((m.functions[0].function.peak() - 0.4 * STANDARD_GRAVITY).abs() < 1e-12);

    let long = read(&text.replace("duration: 1", "duration: 20")).expect_err("too short a record");
    assert!(long[0].message.contains("ends at 1 s, the case at 20 s"), "{}", shown(&long));
    std::fs::write(folder.join("x.csv"), "time,acc\n0,0\n0.5,much\n").unwrap();
    let cell = read(&text).expect_err("a cell without number");
    assert!(cell[0].message.contains("x.csv:3:5: `much`"), "{}", shown(&cell));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn motions_that_are_kept_are_those_of_their_parameters() {
    let folder = std::env::temp_dir().join(format!("trilith-motions-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let row = |i: i32| format!("{},{},{}\n", 0.01 * f64::from(i), i % 7 - 3, i % 5 - 2);
    std::fs::write(folder.join("x.csv"), (0..300).map(row).collect::<String>()).unwrap();
    let extra = r#"parameters: { "scale": 2, "to": "2 s", "seed": 1, "skip": 0, "level": 3, "damping": 0.5 },
        functions: {
            "record": Record(file: "x.csv", component: 2, unit: "g", trim: (0, "to"), scale: "scale"),
            "table": Table(file: "x.csv", value: 1, skip: "skip", scale: "scale"),
            "noise": Synthetic(seed: "seed", peak: "1 m/s^2", duration: "5 s", damping: "damping", scale: "scale"),
            "spectrum": Synthetic(
                seed: "seed", duration: "8 s", spectrum: [(0.1, "level"), (0.5, "level"), (2, 1)], scale: "scale",
            ),
        }"#;
    let (text, path) = (small(extra), folder.join("model.ron"));
    let kept = super::super::ModelText::new(&text, &path).unwrap();
    let read = |set: &[(String, String)]| kept.read(&registry(), set).unwrap().functions;
    let plain = read(&[]);
    for (name, value, changes) in [
        ("scale", "3", [true; 4]),
        ("to", "1 s", [true, false, false, false]),
        ("skip", "2", [false, true, false, false]),
        ("seed", "2", [false, false, true, true]),
        ("damping", "0.7", [false, false, true, false]),
        ("level", "4", [false, false, false, true]),
    ] {
        let set = [(name.to_owned(), value.to_owned())];
        let (again, fresh) = (read(&set), read_text(&text, &path, &registry(), &set).unwrap());
        for (i, changes) in changes.into_iter().enumerate() {
            let what = format!("{name}, {}", plain[i].name);
            assert!(
                again[i].function == fresh.functions[i].function,
                "{what}: not what a fresh reading gives"
            );
            assert_eq!(again[i].function != plain[i].function, changes, "{what}");
        }
    }
    // What was there first is still there, though the file is gone.
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(read(&[]).iter().zip(&plain).all(|(a, b)| a.function == b.function));
}

/// What a file leaves out is what code leaves out.
#[test]
fn defaults_of_files_are_those_of_code() {
    let dynamic = |solution: &str| {
        let text = small("").replace(
            "Static(loads: [Gravity])",
            &format!("Dynamic(duration: 1, dt: 0.1{solution})"),
        );
        let Analysis::Dynamic(run) = model(&text).cases.remove(0).analysis else {
            panic!("{text}")
        };
        run.solution
    };
    assert_eq!(dynamic(""), Solution::default());
    let explicit = ", step: Adaptive, basis: Ritz";
    assert_eq!(dynamic(explicit), Solution::default());
    let motion = model(&small("functions: { \"s\": Synthetic(seed: 3, peak: 1) },"));
    let plain = trilith_record::synthetic::KanaiTajimi { seed: 3, peak: 1.0, ..Default::default() };
    let table = motion.functions[0].function.table().unwrap();
    assert_eq!(table.values(), plain.make().unwrap().acceleration);
    let complete = Basis { kind: BasisKind::Complete, ..Basis::default() };
    assert_eq!(dynamic(", basis: Complete").basis, complete);
}
