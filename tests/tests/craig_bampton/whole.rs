//! A tower on yielding bearings that strikes a mast: the whole of it, and with its frame by few rows.

use std::fmt::Write;
use trilith::reduce::{FILES, FixedModes, MatrixForm, Request};
use trilith::{Analysis, Model};
use trilith_model::SolverKind;
use trilith_system::System;
use trilith_tests::{output, parse, registry, root, shipped_text, trace};

const STOREYS: usize = 5;
const RAYLEIGH: &str = "Rayleigh(mass: 0.1, stiffness: 0.001)";

/// The tower: two columns of beams, dashpots in its storeys; bearings, mast and stop are around it.
pub fn tower(damping: &str) -> String {
    let (mut nodes, mut frame, mut group) = (String::new(), String::new(), String::new());
    let beam = r#"young: "30 GPa", area: 0.16, i2: 0.0021, i3: 0.0021, density: 2500"#;
    for j in 0..=STOREYS {
        for i in 0..2 {
            let _ = write!(nodes, "\"n{i}{j}\": ({}, 0, {}), ", 4 * i, 3 * j);
            if j < STOREYS {
                let _ = writeln!(
                    frame,
                    "\"c{i}{j}\": Beam(nodes: (\"n{i}{j}\", \"n{i}{}\"), {beam}),",
                    j + 1
                );
                let _ = write!(group, "\"c{i}{j}\", ");
            }
        }
        let _ = write!(
            frame,
            "\"b{j}\": Beam(nodes: (\"n0{j}\", \"n1{j}\"), {beam}, mass_matrix: Consistent),\n\
             \"d{j}\": Spring(nodes: (\"n0{j}\", \"n1{j}\"), c1: \"20 kN*s/m\"),\n"
        );
        let _ = write!(group, "\"b{j}\", \"d{j}\", ");
    }
    for i in 0..2 {
        let axes = format!("node: \"n{i}0\", axis1: (0, 0, 1), axis2: (1, 0, 0)");
        let _ = write!(
            frame,
            "\"iso{i}\": Wen({axes}, axis: U2, k: \"5 MN/m\", fy: \"20 kN\", ratio: 0.1),\n\
             \"s{i}\": Spring({axes}, k1: \"400 MN/m\", k3: \"1 MN/m\"),\n"
        );
    }
    format!(
        r#"(
        title: "Tower", plane: XZ,
        nodes: {{ {nodes} "foot": (-1, 0, 0), "mast": (-1, 0, 15) }},
        supports: {{ "foot": Fixed }},
        elements: {{
            {frame}
            "mast": Beam(nodes: ("foot", "mast"), young: "30 GPa", area: 0.3, i2: 0.2, i3: 0.2, density: 2500),
            "stop": Gap(nodes: ("mast", "n05"), k: "40 MN/m", opening: "10 mm"),
        }},
        groups: {{ "tower": [{group}] }},
        damping: {damping},
        functions: {{ "pulse": Sine(amplitude: "0.4 g", frequency: "1.5 Hz", cycles: 2), "gust": Sine(amplitude: 1, frequency: "3 Hz") }},
        loads: {{
            "live": [Uniform(element: "b2", axis: U2, force: "-5 kN/m"), (node: "n11", dof: Ux, force: "20 kN")],
            "wind": [(node: "n12", dof: Ux, force: "4 kN"), (node: "n12", dof: Ry, moment: "1 kN*m")],
        }},
        cases: {{
            "weight": Static(loads: [Gravity, (load: "live")]),
            "shaken": Dynamic(after: "weight", duration: "0.4 s", dt: "10 ms",
                base: [(direction: X, function: "pulse"), (direction: Z, function: "pulse", factor: 0.3)],
                forces: [(load: "wind", function: "gust")]),
        }},
        outputs: {{
            "base": Displacement(node: "n00", dof: Ux), "roof": Displacement(node: "n15", dof: Ux),
            "mid": Displacement(node: "n11", dof: Ux), "sag": Displacement(node: "n12", dof: Uz),
            "turn": Displacement(node: "n12", dof: Ry), "speed": Velocity(node: "n12", dof: Ux),
            "felt": Acceleration(node: "n11", dof: Ux, absolute: true),
            "bearing": LinkForce(link: "iso0", axis: U2), "stop": LinkForce(link: "stop", axis: U1),
            "shear": BaseShear(direction: X),
        }},
    )"#
    )
}

fn request(modes: FixedModes) -> Request {
    Request::new(["tower"], modes)
}

/// The reduced model, read from its text.
fn reduced(text: &str, request: &Request) -> (Model, System) {
    let (model, system) = parse(text, &[]);
    let reduced = trilith::reduce::reduce(&model, &system, request);
    parse(&reduced.unwrap_or_else(|e| panic!("{e}")).text(), &[])
}

fn peaks_agree(whole: &(Model, System), few: &(Model, System), tolerance: f64) {
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let [(a, _), (b, _)] = [whole, few].map(|(m, s)| trace(m, s, solver));
        for (i, output) in whole.0.outputs.iter().enumerate() {
            let scale = a.peak(i);
            assert!(scale > 0.0, "{}", output.name);
            for (x, y) in [(a.max[i], b.max[i]), (a.min[i], b.min[i]), (a.last[i], b.last[i])] {
                let off = (x - y).abs() / scale;
                assert!(off < tolerance, "{} under {solver:?}: {x:e} and {y:e}", output.name);
            }
            assert!(a.difference(&b, i) < tolerance, "{}", output.name);
        }
        // It has struck the mast, and the bearings have yielded.
        assert!(a.peak(output(&whole.0, "stop")) > 1e4);
        assert!(a.peak(output(&whole.0, "bearing")) > 2e4);
    }
}

#[test]
fn with_all_modes_the_reduced_model_is_the_whole_one() {
    let keep = Request { keep: Some(vec!["n00".into()]), ..request(FixedModes::All) };
    for damping in [RAYLEIGH, "Modal(ratio: 0.04)"] {
        let whole = parse(&tower(damping), &[]);
        // Outputs and loads are at nodes that follow the rows.
        let few = reduced(&tower(damping), &keep);
        let superelement = few.0.elements.iter().find(|e| e.kind == "Superelement").unwrap();
        assert_eq!(superelement.name, "tower");
        assert_eq!(few.0.elements.len(), 7);
        assert_eq!(few.1.inner.doubts, Vec::<String>::new());
        let [a, b] = [&whole, &few].map(|(m, s)| trilith_solvers::frequencies(m, s, 12).unwrap());
        assert_eq!((a.len(), b.len()), (12, 12));
        for (x, y) in a.iter().zip(&b) {
            assert!((x / y - 1.0).abs() < 1e-9, "{x} and {y} Hz");
        }
        peaks_agree(&whole, &few, 1e-8);
    }
}

/// The tower with floors that are stiff along X, a tank on a rigid bracket, and a foot that turns with the node above it:
/// what stays leads what does not, whichever the constraint names.
fn tied() -> String {
    let mut ties = String::new();
    for j in 1..=STOREYS {
        let _ = write!(ties, "\"t{j}\": EqualDof(nodes: (\"n0{j}\", \"n1{j}\"), dofs: (Ux)), ");
    }
    let bracket = r#""bracket": RigidLink(nodes: ("n12", "tank")), "water": Mass(node: "tank", mass: "12 t", inertia: (0, 3000, 0)), "#;
    let foot = r#""foot turns": EqualDof(nodes: ("n11", "n10"), dofs: (Ry)), "#;
    tower(RAYLEIGH)
        .replace("\"foot\": (-1", "\"tank\": (4.5, 0, 7), \"foot\": (-1")
        .replace("\"mast\": Beam", &format!("{ties}{bracket}{foot}\"mast\": Beam"))
        .replace("\"tower\": [", "\"tower\": [\"t*\", \"bracket\", \"water\", \"foot turns\", ")
        .replace("\"shear\"", "\"tank\": Displacement(node: \"tank\", dof: Uz), \"shear\"")
}

#[test]
fn constraints_of_the_part_are_in_its_matrices() {
    let whole = parse(&tied(), &[]);
    let keep = Request { keep: Some(vec!["n13".into()]), ..request(FixedModes::All) };
    for request in [keep, request(FixedModes::All)] {
        let few = reduced(&tied(), &request);
        assert!(few.0.elements.iter().all(|e| !["EqualDof", "RigidLink"].contains(&e.kind)));
        assert_eq!(few.1.order(), whole.1.order());
        assert_eq!(few.1.inner.doubts, Vec::<String>::new());
        let [own, other] = [&whole, &few].map(|(m, s)| s.mass_sum(m));
        assert!((own.mass[0] / other.mass[0] - 1.0).abs() < 1e-12);
        let [a, b] = [&whole, &few].map(|(m, s)| trilith_solvers::frequencies(m, s, 12).unwrap());
        for (x, y) in a.iter().zip(&b) {
            assert!((x / y - 1.0).abs() < 1e-9, "{x} and {y} Hz");
        }
        peaks_agree(&whole, &few, 1e-8);
    }
}

#[test]
fn few_modes_keep_mass_and_weight_and_come_close() {
    let whole = parse(&tower(RAYLEIGH), &[]);
    let a = trilith_solvers::frequencies(&whole.0, &whole.1, 4).unwrap();
    let mut before = f64::INFINITY;
    for count in [0, 4, 8] {
        let few = reduced(&tower(RAYLEIGH), &request(FixedModes::Count(count)));
        let [own, other] = [&whole, &few].map(|(m, s)| s.mass_sum(m));
        for axis in [0, 2] {
            assert!((own.mass[axis] / other.mass[axis] - 1.0).abs() < 1e-12);
            assert!((own.centre[axis] - other.centre[axis]).abs() < 1e-9);
            let [x, y] = [&whole, &few].map(|(_, s)| s.mass_along(axis));
            assert!((x / y - 1.0).abs() < 1e-12, "{x} and {y}");
        }
        let b = trilith_solvers::frequencies(&few.0, &few.1, 4).unwrap();
        let off: f64 = a.iter().zip(&b).map(|(x, y)| y / x - 1.0).sum();
        // A structure of fewer shapes is stiffer.
        assert!(a.iter().zip(&b).all(|(x, y)| *y >= x * (1.0 - 1e-10)), "{a:?} and {b:?}");
        assert!(off < before, "{off} after {before}");
        before = off;
    }
    assert!(before < 0.01, "{before}");
    // A node more that is kept: static forces on it are answered exactly, inside as well.
    let few = reduced(&tower(RAYLEIGH), &request(FixedModes::Count(12)));
    peaks_agree(&whole, &few, 0.01);
}

/// The ground pushes at a modal coordinate with −Φᵀ M r, and at a node with what hangs on it.
#[test]
fn the_ground_acts_on_modal_coordinates_with_their_share_of_the_mass() {
    let (model, system) = parse(&tower("None"), &[]);
    let request = Request { keep: Some(Vec::new()), ..request(FixedModes::Count(5)) };
    let found = trilith::reduce::reduce(&model, &system, &request).unwrap();
    let (few, of_few) = parse(&found.text(), &[]);
    for axis in [0, 2] {
        let modal: Vec<f64> = (0..of_few.order())
            .filter(|i| of_few.inner.node(of_few.reduction.free[*i]).is_none())
            .map(|i| of_few.inertia[axis][i].powi(2))
            .collect();
        assert_eq!(modal.len(), 5);
        for (share, mass) in modal.iter().zip(&found.effective_mass) {
            assert!(
                (share - mass[axis]).abs() < 1e-9 * found.inner_mass[axis],
                "{share} of {mass:?}"
            );
        }
        assert!(modal.iter().any(|share| *share > 0.05 * found.inner_mass[axis]));
    }
    // A motion of the ground that is slow moves all of it: K u = −M r a with few modes and with all.
    let push = |m: &Model, s: &System| {
        let k = s.stiffness_with(&s.links.engaged(m));
        let mut u: Vec<f64> = s.inertia[0].iter().map(|x| -x).collect();
        trilith_linalg::Ldlt::new(&k).unwrap().solve(&mut u);
        let node = m.nodes.iter().position(|n| n.name == "n00").unwrap();
        s.reduction.expand(6 * node).iter().map(|(i, t)| t * u[*i]).sum::<f64>()
    };
    let [x, y] = [push(&model, &system), push(&few, &of_few)];
    assert!((x / y - 1.0).abs() < 1e-9, "{x} and {y}");
}

#[test]
fn every_form_of_files_reads_back_to_the_same_model() {
    let (model, system) = parse(&tower(RAYLEIGH), &[]);
    let keep = Request { keep: Some(vec!["n00".into()]), ..request(FixedModes::UpTo(60.0)) };
    let found = trilith::reduce::reduce(&model, &system, &keep).unwrap();
    assert!((3..12).contains(&found.frequencies.len()), "{:?}", found.frequencies);
    assert!(found.frequencies.iter().all(|f| *f <= 60.0));
    let (_, own) = parse(&found.text(), &[]);
    let wanted: Vec<_> = own.stiffness.entries().collect();
    for form in [MatrixForm::Npz, MatrixForm::Market, MatrixForm::Dmig, MatrixForm::Op4] {
        let folder = tempfile();
        for (name, bytes) in found.files(form).unwrap() {
            assert!(FILES.contains(&name.as_str()), "{name}");
            std::fs::write(folder.join(name), bytes).unwrap();
        }
        let again = trilith::read(folder.join(FILES[0]), &registry(), &[]).unwrap();
        let of_files = Analysis::new(&again).unwrap();
        let system = of_files.system();
        assert_eq!(system.stiffness.entries().collect::<Vec<_>>(), wanted, "{form:?}");
        assert_eq!(
            system.mass.entries().collect::<Vec<_>>(),
            own.mass.entries().collect::<Vec<_>>(),
            "{form:?}"
        );
        std::fs::remove_dir_all(folder).unwrap();
    }
}

/// A folder of this test alone.
fn tempfile() -> std::path::PathBuf {
    let name = format!("trilith_craig_bampton_{}", std::process::id());
    let folder = std::env::temp_dir().join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The wall that is shipped is a superelement already; its inner rows are no nodes.
#[test]
fn a_superelement_is_reduced_as_other_elements_are() {
    let text = shipped_text("rocking_wall.ron").replace("\"4 s\"", "\"0.15 s\"");
    assert!(text.contains("superelements/wall_k.mtx") && root().join("models").is_dir());
    let whole = parse(&text, &[]);
    let of = |modes| {
        let found = trilith::reduce::reduce(&whole.0, &whole.1, &Request::new(["wall"], modes));
        found.unwrap_or_else(|e| panic!("{e}"))
    };
    let few = of(FixedModes::Count(10));
    assert_eq!((few.equations, few.rows), (182, 6));
    assert_eq!(few.kept, ["left", "right", "top"]);
    let few = parse(&few.text(), &[]);
    assert_eq!(few.1.order(), 16);
    let [a, b] = [&whole, &few].map(|(m, s)| trilith_solvers::frequencies(m, s, 4).unwrap());
    assert!(a.iter().zip(&b).all(|(x, y)| (x / y - 1.0).abs() < 0.01), "{a:?} and {b:?}");
    let all = parse(&of(FixedModes::All).text(), &[]);
    let b = trilith_solvers::frequencies(&all.0, &all.1, 4).unwrap();
    assert!(a.iter().zip(&b).all(|(x, y)| (x / y - 1.0).abs() < 1e-9), "{a:?} and {b:?}");
}
