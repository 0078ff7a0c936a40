//! Loads along members and the forces inside them: against closed forms, an oracle that integrates the beam, and each other.

mod sections;
mod shot;

use shot::Shot;
use trilith::solvers::RunOptions;
use trilith::{Analysis, Model, Run, SolverKind, read_text, registry};

fn model(text: &str) -> Model {
    read_text(text, "members.ron", &registry(), &[]).unwrap_or_else(|errors| {
        let all: Vec<_> = errors.iter().map(ToString::to_string).collect();
        panic!("{}\n{text}", all.join("\n"))
    })
}

fn run_with(text: &str, solver: Option<SolverKind>) -> Run {
    let model = model(text);
    let case = model.cases.len() - 1;
    let run =
        Analysis::new(&model).unwrap().run(RunOptions { case, solver, ..RunOptions::default() });
    run.unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn last(run: &Run, output: &str) -> f64 {
    run.peak(output).unwrap().last
}

fn near(what: &str, got: f64, wanted: f64, off: f64) {
    assert!((got - wanted).abs() <= off, "{what}: {got:e} instead of {wanted:e}, ± {off:e}");
}

/// A step of wind on a mast without mass that carries one at its top:
///
/// ```text
///   u = P/k (1 − cos ωt),  P = 3qL/8,  k = 3EI/L³;   at the foot  V = qL − P cos ωt,  M = qL²/2 − P L cos ωt
/// ```
#[test]
fn wind_on_a_mast_has_its_closed_form_under_every_solver() {
    let (e, i, l, m, q) = (210e9, 2e-6, 3.0_f64, 1000.0, 1000.0);
    let text = format!(
        r#"(
    plane: XZ,
    nodes: {{ "foot": (0, 0, 0), "top": (0, 0, {l}) }},
    supports: {{ "foot": Fixed }},
    elements: {{
        "mast": Beam(nodes: ("foot", "top"), young: {e}, area: 1, i3: {i}),
        "mass": Mass(node: "top", mass: {m}),
    }},
    functions: {{ "gust": Constant(1) }},
    loads: {{ "wind": [Uniform(element: "mast", dof: Ux, force: {q})] }},
    cases: {{ "gust": Dynamic(duration: 2, dt: 0.01, step: Adaptive(tolerance: 1e-6),
        forces: [(load: "wind", function: "gust")]) }},
    outputs: {{
        "sway": Displacement(node: "top", dof: Ux),
        "moment": MemberForce(element: "mast", force: M3, at: "0 m"),
        "middle": MemberForce(element: "mast", force: M3, at: "50 %"),
        "shear": MemberForce(element: "mast", force: V2, at: 0),
        "reaction": Reaction(node: "foot", dof: Ux),
        "base": BaseShear(direction: X),
        "over": Overturning(direction: X, about: 0),
    }},
)"#
    );
    let (p, k) = (3.0 * q * l / 8.0, 3.0 * e * i / l.powi(3));
    let omega = (k / m).sqrt();
    for solver in SolverKind::ALL {
        let run = run_with(&text, Some(solver));
        let history = |name: &str| run.history(name).unwrap();
        // At the very start a joint without mass is where it was before the load.
        for (j, t) in run.time().iter().enumerate().skip(1) {
            let swing = (omega * t).cos();
            let (v, moment) = (q * l - p * swing, q * l * l / 2.0 - p * l * swing);
            // Local 2 of a mast points along X: pushed along it, the side of local 2 is pressed.
            let middle = q * l * l / 8.0 - p * l / 2.0 * swing;
            let off = 2e-4 * q * l * l;
            let name = solver.name();
            near(name, history("sway")[j], p / k * (1.0 - swing), 2e-4 * p / k);
            near(name, history("moment")[j], moment, off);
            near(name, history("middle")[j], middle, off);
            near(name, history("shear")[j], v, off);
            near(name, history("reaction")[j], -v, off);
            near(name, history("base")[j], v, off);
            near(name, history("over")[j], moment, off);
        }
    }
}

/// The load of the next test by length: rises from 2 to 6 kN/m between 1/4 and 3/4 of 4 m.
fn ramp(x: f64) -> f64 {
    if (1.0..3.0).contains(&x) { 2000.0 * x } else { 0.0 }
}

#[test]
fn a_beam_carries_what_an_integrated_one_does() {
    let (e, i, g, area, l) = (30e9, 4e-4, 12e9, 0.02, 4.0_f64);
    let shot = |q: fn(f64) -> f64, kappa: f64, points: &[(f64, f64)]| Shot {
        ei: e * i,
        ga: g * area,
        l,
        q,
        kappa,
        points: points.to_vec(),
    };
    let none = |_: f64| 0.0;
    let (alpha, gradient) = (1e-5, 20.0);
    let cases: [(&str, Shot); 3] = [
        (
            r#"Trapezoid(element: "b", dof: Uz, points: [(1, 2000), ("75 %", 6000)])"#,
            shot(ramp, 0.0, &[]),
        ),
        (
            r#"Point(element: "b", at: 1.5, axis: U2, force: 5000), Point(element: "b", at: 2.75, dof: Uz, force: -8000)"#,
            shot(none, 0.0, &[(1.5, 5000.0), (2.75, -8000.0)]),
        ),
        (r#"Temperature(element: "b", gradient_2: 20)"#, shot(none, -alpha * gradient, &[])),
    ];
    for hinged in [false, true] {
        for (load, shot) in &cases {
            let release = if hinged { "release_j: [R3]," } else { "" };
            let stations = [0.0, 0.7, 1.5, 2.0, 2.9, 4.0];
            let outputs: String = (stations.iter())
                .flat_map(|x| ["V2", "M3"].map(|f| (x, f)))
                .map(|(x, f)| {
                    format!("\"{f} {x}\": MemberForce(element: \"b\", force: {f}, at: {x:?}),\n")
                })
                .collect();
            let text = format!(
                r#"(
    plane: XZ,
    nodes: {{ "i": (0, 0, 0), "j": ({l}, 0, 0) }},
    supports: {{ "i": Fixed, "j": (Uz, Ry) }},
    elements: {{ "b": Beam(nodes: ("i", "j"), young: {e}, shear_modulus: {g}, area: 1, i3: {i},
        shear_area_2: {area}, expansion: {alpha}, {release}) }},
    loads: {{ "p": [{load}] }},
    cases: {{ "p": Static(loads: ["p"]) }},
    outputs: {{ {outputs} }},
)"#
            );
            let run = run_with(&text, None);
            let start = shot.clamped(hinged);
            for x in stations {
                let [_, _, m, v] = shot.fly(start, x);
                near(&format!("{load} V at {x}"), last(&run, &format!("V2 {x}")), v, 0.5);
                near(&format!("{load} M at {x}"), last(&run, &format!("M3 {x}")), m, 0.5);
            }
        }
    }
}

#[test]
fn warmth_presses_where_it_is_held_and_lengthens_where_not() {
    let text = |supports: &str| {
        format!(
            r#"(
    nodes: {{ "i": (0, 0, 0), "j": (3, 4, 0) }},
    supports: {{ "i": Fixed, {supports} }},
    elements: {{ "b": Beam(nodes: ("i", "j"), section: "HEB 200", material: Steel) }},
    loads: {{ "sun": [Temperature(element: "b", rise: "40 K", gradient_3: "100 K/m")] }},
    cases: {{ "sun": Static(loads: ["sun"]) }},
    outputs: {{
        "n": MemberForce(element: "b", force: N, at: "30 %"),
        "m": MemberForce(element: "b", force: M2, at: "60 %"),
        "x": Displacement(node: "j", dof: Ux), "y": Displacement(node: "j", dof: Uy),
        "side": Displacement(terms: [(node: "j", dof: Ux, factor: 0.8), (node: "j", dof: Uy, factor: -0.6)]),
    }},
)"#
        )
    };
    let s = trilith::model::sections::rolled("HEB 200").unwrap();
    let (e, alpha, l) = (210e9, 1.2e-5, 5.0_f64);
    let held = run_with(&text(r#""j": (Ux, Uy, Rx, Ry, Rz)"#), None);
    near("N", last(&held, "n"), -e * s.area * alpha * 40.0, 1e-6 * e * s.area * alpha * 40.0);
    // Warmer on the side of local 3: it would bow that way, and is pressed there.
    near("M2", last(&held, "m"), e * s.i2 * alpha * 100.0, 1e-6 * e * s.i2);
    let free = run_with(&text(""), None);
    near("no force", last(&free, "n"), 0.0, 1e-3);
    near("no moment", last(&free, "m"), 0.0, 1e-3);
    // Along itself, and κ L²/2 towards the other side: local 3 of a level beam is 1 × Z.
    let bow = alpha * 100.0 * l * l / 2.0;
    near("longer", 0.6 * last(&free, "x") + 0.8 * last(&free, "y"), alpha * 40.0 * l, 1e-9);
    near("bowed", last(&free, "side"), -bow, 1e-9);
}

/// One member with loads of every kind, its stiff ends and releases, in space, and so many times its weight.
fn leaning(member: &str, loads: &str, weight: f64, outputs: &str) -> String {
    format!(
        r#"(
    nodes: {{ "i": (1, 2, 0), "j": (3, 3, 2.5), "aside": (4, 1, 0) }},
    supports: {{ "i": Fixed, "aside": Fixed }},
    elements: {{
        "b": Beam(nodes: ("i", "j"), section: "IPE 400", material: Steel, {member}),
        "prop": Beam(nodes: ("aside", "j"), section: "HEB 200", material: Steel, density: 0),
    }},
    loads: {{ "all": [{loads}] }},
    cases: {{ "all": Static(loads: ["all", Gravity(factor: {weight})]) }},
    outputs: {{ {outputs} }},
)"#
    )
}

const EVERY: &str = r#"
    Uniform(element: "b", dof: Uz, force: -3000), Uniform(element: "b", dof: Uy, force: 700, projected: true),
    Trapezoid(element: "b", axis: U3, points: [(0.2, 1000), (1.1, -500), (2.9, 2000)]),
    Point(element: "b", at: "40 %", dof: Ux, force: 4000), Point(element: "b", at: 3, axis: R2, moment: 900),
    Point(element: "b", at: 2, dof: Rz, moment: -1500), Uniform(element: "b", axis: R1, moment: 250, from: 1, to: "90 %"),
    Temperature(element: "b", rise: 15, gradient_2: 30)"#;

#[test]
fn all_loads_of_a_member_arrive_at_the_supports() {
    for member in [
        "",
        "offset_i: 0.3, offset_j: 0.5",
        "offset_i: 0.3, offset_j: 0.5, offsets_stiffen: Bending, mass_matrix: Consistent",
        "release_i: [R2, R3], offset_j: 0.4",
        "release_j: [R1, R2, R3, U1], mass_matrix: Consistent",
    ] {
        let nodes = [("i", [1.0, 2.0, 0.0]), ("aside", [4.0, 1.0, 0.0])];
        let mut outputs = String::new();
        for (node, _) in nodes {
            for dof in ["Ux", "Uy", "Uz", "Rx", "Ry", "Rz"] {
                outputs += &format!("\"{node} {dof}\": Reaction(node: \"{node}\", dof: {dof}),\n");
            }
        }
        let text = leaning(member, EVERY, 0.0, &outputs);
        let run = run_with(&text, None);
        let mut sum = [0.0; 6];
        for (node, [x, y, z]) in nodes {
            let r: Vec<f64> = ["Ux", "Uy", "Uz", "Rx", "Ry", "Rz"]
                .map(|dof| last(&run, &format!("{node} {dof}")))
                .to_vec();
            let f = [r[0], r[1], r[2]];
            let arm = [y * f[2] - z * f[1], z * f[0] - x * f[2], x * f[1] - y * f[0]];
            for k in 0..3 {
                sum[k] += f[k];
                sum[3 + k] += r[3 + k] + arm[k];
            }
        }
        // The same loads, by hand: places along the member, axes as a level observer has them.
        let (i, d) = ([1.0, 2.0, 0.0], [2.0, 1.0, 2.5]);
        let l = (d.iter().map(|x| x * x).sum::<f64>()).sqrt();
        let one = d.map(|x| x / l);
        let lean = [-one[2] * one[0], -one[2] * one[1], 1.0 - one[2] * one[2]];
        let size = lean.iter().map(|x| x * x).sum::<f64>().sqrt();
        let two = lean.map(|x| x / size);
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let three = cross(one, two);
        let mut wanted = [0.0; 6];
        let mut act = |at: f64, force: [f64; 3], moment: [f64; 3]| {
            let place: [f64; 3] = std::array::from_fn(|k| i[k] + one[k] * at);
            let turn = cross(place, force);
            for k in 0..3 {
                wanted[k] -= force[k];
                wanted[3 + k] -= moment[k] + turn[k];
            }
        };
        let none = [0.0; 3];
        act(l / 2.0, [0.0, 0.0, -3000.0 * l], none);
        act(l / 2.0, [0.0, 700.0 * l * (one[0] * one[0] + one[2] * one[2]).sqrt(), 0.0], none);
        for (a, b, p, q) in [(0.2, 1.1, 1000.0, -500.0), (1.1, 2.9, -500.0, 2000.0)] {
            let (h, n) = (b - a, 2000);
            for k in 0..n {
                let s = (f64::from(k) + 0.5) / f64::from(n);
                let f = (p + s * (q - p)) * h / f64::from(n);
                act(a + s * h, three.map(|x| f * x), none);
            }
        }
        act(0.4 * l, [4000.0, 0.0, 0.0], none);
        act(3.0, none, two.map(|x| 900.0 * x));
        act(2.0, none, [0.0, 0.0, -1500.0]);
        act(1.0, none, one.map(|x| 250.0 * (0.9 * l - 1.0) * x));
        for k in 0..6 {
            near(&format!("{member} {k}"), sum[k], wanted[k], 0.02);
        }
    }
}

#[test]
fn a_member_has_the_forces_of_the_pieces_it_could_be_cut_into() {
    let forces = ["N", "V2", "V3", "T", "M2", "M3"];
    let l = 11.25_f64.sqrt();
    let n = 8;
    let outputs = |names: &dyn Fn(usize) -> (String, f64)| -> String {
        (0..n)
            .flat_map(|k| forces.map(|f| (k, f)))
            .map(|(k, f)| {
                let (element, at) = names(k);
                format!(
                    "\"{k} {f}\": MemberForce(element: \"{element}\", force: {f}, at: {at:?}),\n"
                )
            })
            .collect()
    };
    let at = |k: usize| (k as f64 + 0.5) / n as f64 * l;
    let loads = r#"Uniform(element: "b", dof: Uz, force: -3000), Uniform(element: "b", axis: U3, force: 800),
        Uniform(element: "b", axis: R1, moment: 120), Temperature(element: "b", rise: 12, gradient_3: 5)"#;
    let whole = leaning("mass_matrix: Consistent", loads, 0.5, &outputs(&|k| ("b".into(), at(k))));
    let mut pieces = leaning("", &loads.replace("\"b\"", "\"pieces\""), 0.5, &{
        let step = l / n as f64;
        outputs(&|k| (format!("p{}", k + 1), 0.5 * step))
    });
    let first = pieces.find("\"b\": Beam").unwrap();
    let end = first + pieces[first..].find('\n').unwrap();
    let mut cut = String::new();
    for k in 1..=n {
        let name = |k: usize| match k {
            0 => "i".to_owned(),
            k if k == n => "j".to_owned(),
            k => format!("c{k}"),
        };
        cut += &format!(
            "\"p{k}\": Beam(nodes: (\"{}\", \"{}\"), section: \"IPE 400\", material: Steel, mass_matrix: Consistent),\n",
            name(k - 1),
            name(k)
        );
    }
    pieces.replace_range(first..end, &cut);
    let between: String = (1..n)
        .map(|k| {
            let s = k as f64 / n as f64;
            format!("\"c{k}\": ({:?}, {:?}, {:?}), ", 1.0 + 2.0 * s, 2.0 + s, 2.5 * s)
        })
        .collect();
    let pieces = pieces
        .replace("\"aside\": (4", &format!("{between} \"aside\": (4"))
        .replace("loads: {", "groups: { \"pieces\": [\"p*\"] }, loads: {")
        .replace("\"prop\"", "\"stay\"");
    let (whole, pieces) = (run_with(&whole, None), run_with(&pieces, None));
    for f in forces {
        let most = (0..n).map(|k| last(&whole, &format!("{k} {f}")).abs()).fold(1.0, f64::max);
        for k in 0..n {
            let name = format!("{k} {f}");
            near(&name, last(&whole, &name), last(&pieces, &name), 1e-7 * most + 1e-3);
        }
    }
}

#[test]
fn weight_bends_a_member_between_its_ends() {
    let text = |matrix: &str| {
        format!(
            r#"(
    plane: XZ,
    nodes: {{ "i": (0, 0, 0), "j": (6, 0, 0) }},
    supports: {{ "i": Pinned, "j": (Uz, Ry) }},
    elements: {{ "b": Beam(nodes: ("i", "j"), section: "HEB 300", material: Steel, release_j: [R3], mass_matrix: {matrix}) }},
    cases: {{ "own weight": Static(loads: [Gravity]) }},
    outputs: {{
        "middle": MemberForce(element: "b", force: M3, at: "50 %"),
        "left": MemberForce(element: "b", force: V2, at: 0),
        "share": Sum(terms: [(output: "left", factor: "1 m")], hidden: true),
        "mixed": Sum(terms: ["middle", (output: "share", factor: -1)]),
    }},
    envelopes: {{ "b": (element: "b", stations: 7) }},
)"#
        )
    };
    let w = trilith::model::sections::rolled("HEB 300").unwrap().area * 7850.0 * 9.80665;
    for matrix in ["Lumped", "Consistent"] {
        let model = model(&text(matrix));
        let run = Analysis::new(&model).unwrap().run(RunOptions::default()).unwrap();
        near(matrix, last(&run, "middle"), w * 36.0 / 8.0, 1e-6 * w);
        near(matrix, last(&run, "left"), -w * 3.0, 1e-6 * w);
        near(matrix, last(&run, "mixed"), w * (4.5 + 3.0), 1e-6 * w);
        let summary = run.summary(&model);
        let names: Vec<&str> = summary.outputs.0.iter().map(|(n, _)| n.as_str()).collect();
        assert_eq!(names, ["middle", "left", "mixed"]);
        let forces = summary.envelopes.get("b").unwrap();
        let names: Vec<&str> = forces.0.iter().map(|(n, _)| n.as_str()).collect();
        assert_eq!(names, ["N", "V2", "M3"]);
        let m3 = &forces.get("M3").unwrap().max;
        near(matrix, m3.value, w * 4.5, 1e-6 * w);
        assert_eq!((m3.element.as_str(), m3.at), ("b", 3.0));
    }
}

#[test]
fn envelopes_hold_what_histories_of_their_stations_do() {
    let text = r#"(
    plane: XZ,
    nodes: { "i": (0, 0, 0), "m": (4, 0, 0), "j": (8, 0, 0) },
    supports: { "i": Pinned, "j": (Uz) },
    properties: { "b": Beam(section: "IPE 300", material: Steel, mass_matrix: Consistent) },
    elements: { "left": Beam(nodes: ("i", "m"), use: "b"), "right": Beam(nodes: ("m", "j"), use: "b") },
    damping: Modal(ratio: 0.02),
    functions: { "shake": Sine(amplitude: 1, frequency: "3 Hz") },
    loads: { "live": [Trapezoid(element: "left", dof: Uz, points: [(1, 0), (3, "-5 kN/m")])] },
    groups: { "all": ["left", "right"] },
    cases: {
        "rest": Static(loads: [Gravity]),
        "shaken": Dynamic(after: "rest", duration: 1, dt: 0.01, forces: [(load: "live", function: "shake")]),
    },
    outputs: {
        "a": MemberForce(element: "left", force: M3, at: 2),
        "b": MemberForce(element: "right", force: V2, at: "100 %"),
    },
    envelopes: { "girder": (element: "all", stations: 5, forces: [M3, V2]) },
)"#;
    let model = model(text);
    let run = Analysis::new(&model).unwrap().run(RunOptions { case: 1, ..RunOptions::default() });
    let run = run.unwrap();
    let folder = tempfile::tempdir().unwrap();
    run.write(&model, folder.path()).unwrap();
    let rows = std::fs::read_to_string(folder.path().join("envelopes.csv")).unwrap();
    let rows: Vec<Vec<&str>> = rows.lines().map(|l| l.split(',').collect()).collect();
    assert_eq!(rows.len(), 1 + 2 * 5 * 2);
    let row = |element: &str, at: &str, force: &str| {
        let fits = |r: &&Vec<&str>| r[1] == element && r[2] == at && r[3] == force;
        rows.iter().find(fits).unwrap_or_else(|| panic!("no {element} {at} {force}"))
    };
    for (name, row) in [("a", row("left", "2.0", "M3")), ("b", row("right", "4.0", "V2"))] {
        let peak = run.peak(name).unwrap();
        let numbers: Vec<f64> = row[5..].iter().map(|x| x.parse().unwrap()).collect();
        assert_eq!(numbers, [peak.max, peak.t_max, peak.min, peak.t_min, peak.last], "{name}");
        assert!(peak.max > peak.min);
    }
    // Hidden outputs leave no columns.
    let head = std::fs::read_to_string(folder.path().join("histories.csv")).unwrap();
    assert!(head.starts_with("t [s],a [N·m],b [N],energy input [J]"), "{head}");
    // The model with every default filled in is the same model.
    let text = std::fs::read_to_string(folder.path().join("model.resolved.ron")).unwrap();
    let again = self::model(&text);
    assert_eq!(again.outputs, model.outputs);
    assert_eq!(again.envelopes, model.envelopes);
    assert_eq!(again.patterns[0].members, model.patterns[0].members);
}

#[test]
fn what_is_made_in_code_is_looked_at() {
    let text = r#"(
    nodes: { "i": (0, 0, 0), "j": (2, 0, 0) },
    supports: { "i": Fixed },
    elements: { "b": Beam(nodes: ("i", "j"), section: "HEB 300", material: Steel), "k": Spring(node: "j", k1: 1) },
    loads: { "p": [Uniform(element: "b", dof: Uz, force: 1)] },
    cases: { "c": Static(loads: ["p"]) },
    outputs: { "m": MemberForce(element: "b", force: M3, at: 1) },
    envelopes: { "e": (element: "b") },
)"#;
    assert!(model(text).check().is_ok());
    let refused = |spoil: &dyn Fn(&mut Model), words: &str| {
        let mut model = model(text);
        spoil(&mut model);
        let errors = model.check().expect_err(words);
        assert!(errors.iter().any(|e| e.to_string().contains(words)), "{words}: {errors:?}");
        assert!(Analysis::new(&model).is_err(), "{words}");
    };
    refused(&|m| m.patterns[0].members[0].element = 9, "element");
    refused(&|m| m.patterns[0].members[0].element = 1, "is no member");
    refused(
        &|m| {
            m.patterns[0].members[0].load =
                trilith::element::SpanLoad::Point { at: 3.0, load: [1.0; 6] }
        },
        "at",
    );
    refused(&|m| m.envelopes[0].members[0].first = 9, "output");
}
