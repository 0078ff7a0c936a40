//! Cantilevers side by side against closed forms: loads between joints, rigid ends, partial fixity, meshing, offsets.

mod common;

use common::{close, file, import, last, model};
use trilith_exchange::Fate;

/// Bending and axial stiffness, N·m² and N, and length, m.
const EI: f64 = 2e7;
const EA: f64 = 2e9;
const L: f64 = 4.0;

#[test]
fn forces_of_joints_move_them_as_in_books() {
    let model = model(&import(&file("cantilevers.s2k"), None));
    let got = last(&model, "TIP", &["2 Uz", "4 Uz", "4 Ux", "6 Uz", "8 Uz", "10 Ux", "10 Uz"]);
    let tip = |l: f64| -10e3 * l.powi(3) / (3.0 * EI);
    let expected = [
        tip(L),
        // Half a metre is rigid, and stretches all the same.
        tip(3.5),
        20e3 * L / EA,
        // A spring of 1000 kN·m holds its foot.
        tip(L) - 10e3 * L * L / 1e6,
        tip(L),
        // Its axis lies 20 cm above the joints.
        20e3 * L / EA + 20e3 * 0.04 * L / EI,
        20e3 * 0.2 * L * L / (2.0 * EI),
    ];
    for (i, (a, b)) in got.into_iter().zip(expected).enumerate() {
        close(a, b, 1e-9, &format!("output {i}"));
    }
}

#[test]
fn loads_between_joints_move_them_as_in_books() {
    let model = model(&import(&file("cantilevers.s2k"), None));
    let cases: [(&str, &[(&str, f64)]); 4] = [
        (
            "SPREAD",
            &[
                ("2 Uz", -5e3 * L.powi(4) / (8.0 * EI)),
                ("4 Uz", -5e3 * 3.5_f64.powi(4) / (8.0 * EI)),
                // From nothing at the middle to 6 kN/m at the tip: ∫ w a² (3 L − a) / (6 E I) da.
                ("8 Uz", -3e3 * 193.6 / (6.0 * EI)),
            ],
        ),
        (
            "MIDDLE",
            &[
                ("2 Uz", -8e3 * 4.0 * 10.0 / (6.0 * EI)),
                ("4 Uz", 0.0),
                ("8 Uz", 3e3 * 1.5 * (L - 0.75) / EI),
            ],
        ),
        ("WARM", &[("2 Ux", 1e-5 * 20.0 * L), ("4 Uz", -1e-5 * 30.0 * 3.5 * 3.5 / 2.0)]),
        ("OWN", &[("2 Uz", -2.0 * 770.0 * L.powi(4) / (8.0 * EI))]),
    ];
    for (case, outputs) in cases {
        let names: Vec<&str> = outputs.iter().map(|(name, _)| *name).collect();
        for (got, (name, expected)) in last(&model, case, &names).into_iter().zip(outputs) {
            if *expected == 0.0 {
                assert!(got.abs() < 1e-15, "{case} {name}: {got}");
            } else {
                close(got, *expected, 1e-9, &format!("{case} {name}"));
            }
        }
    }
}

#[test]
fn a_settling_support_takes_half_of_it_to_the_middle_and_sums_are_cases() {
    let mut import = import(&file("cantilevers.s2k"), None);
    let block = trilith_exchange::ron::Ron::block("Displacement");
    let block = block.with("node", trilith_exchange::ron::Ron::text("12"));
    let block = block.with("dof", trilith_exchange::ron::Ron::word("Uz"));
    import.draft.outputs.push(("middle".into(), block));
    let model = model(&import);
    close(last(&model, "SETTLE", &["middle"])[0], -0.01, 1e-9, "settled");
    let sum = 1.5 * -10e3 * L.powi(3) / (3.0 * EI) - 770.0 * L.powi(4) / (8.0 * EI);
    close(last(&model, "ALL", &["2 Uz"])[0], sum, 1e-9, "sum");
}

#[test]
fn the_report_names_what_is_said_otherwise_and_loses_nothing() {
    let import = import(&file("cantilevers.s2k"), None);
    assert_eq!(import.report.losses(), 0, "{}", import.report.text());
    assert!(import.report.tables.iter().all(|t| t.fate == Fate::Read), "{}", import.report.text());
    let text = import.report.text();
    for words in [
        "cantilevers.s2k: SAP2000 20.1.0, kN, m",
        "FRAME LOADS",
        "MemberForce counts them",
        "the support itself reads 0 (13)",
        "FRAME SECTION PROPERTIES 01 - GENERAL: S33",
    ] {
        assert!(text.contains(words), "{words} in\n{text}");
    }
    let ron = import.draft.to_ron();
    for words in [
        "title: \"Cantilevers \\\"side by side\\\"\"",
        "units: (length: \"m\", force: \"kN\")",
        "\"12\": (4, 10, 0)",
        "offset_i: 0.5, offsets_stiffen: Bending",
        "use: \"BAR\"",
        "use: \"TWICE\"",
    ] {
        assert!(ron.contains(words), "{words} in\n{ron}");
    }
}

#[test]
fn forces_inside_frames_count_the_loads_along_them() {
    let mut import = import(&file("cantilevers.s2k"), None);
    let ron = import.draft.to_ron();
    for words in [
        "Uniform(element: \"frame 1\", axis: U2, force: -5)",
        "Trapezoid(element: \"frame 4/3\", axis: U2, points: [(0, 0), (1, -3)])",
        "Point(element: \"frame 1\", at: 2, axis: U2, force: -8)",
        "Temperature(element: \"frame 2\", gradient_2: 30)",
    ] {
        assert!(ron.contains(words), "{words} in\n{ron}");
    }
    // Moments at the foot of the first cantilever, by their book: q l²/2, and P l/2.
    let moment = trilith_exchange::ron::Ron::block("MemberForce")
        .with("element", "frame 1")
        .with("force", trilith_exchange::ron::Ron::word("M3"))
        .with("at", 0.0);
    import.draft.outputs.push(("foot".into(), moment));
    let model = model(&import);
    close(last(&model, "SPREAD", &["foot"])[0], -5e3 * L * L / 2.0, 1e-9, "foot");
    close(last(&model, "MIDDLE", &["foot"])[0], -8e3 * L / 2.0, 1e-9, "foot");
    close(last(&model, "OWN", &["foot"])[0], -2.0 * 770.0 * L * L / 2.0, 1e-9, "foot");
}
