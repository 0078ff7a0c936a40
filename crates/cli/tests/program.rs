//! The program from outside.

mod common;

use common::trilith;
use std::path::Path;
use trilith::results::{Folder, Writer};

const MODEL: &str = r#"(
    title: "A swinging mass",
    plane: XZ,
    parameters: { "k": "39.4784 N/m" },
    nodes: { "top": (0, 0, 1), "base": (0, 0, 0) },
    supports: { "base": Fixed },
    elements: {
        "mass": Mass(node: "top", mass: "1 kg"),
        "spring": Spring(nodes: ("base", "top"), k1: "1 kN/m", k2: "k", r2: 1, r3: 1),
        "stop": Gap(nodes: ("base", "top"), k: "1 kN/m", opening: "1 cm"),
    },
    cases: {
        "swing": Dynamic(
            duration: "1 s", dt: "0.01 s",
            initial: [(node: "top", dof: Ux, displacement: "2 cm")],
        ),
    },
    outputs: { "sway": Displacement(node: "top", dof: Ux) },
)"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("swing.ron"), MODEL).unwrap();
    folder
}

fn summary(folder: &Path) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(folder.join("summary.json")).unwrap()).unwrap()
}

#[test]
fn a_run_prints_its_peaks_and_writes_its_folder() {
    let folder = folder();
    let (status, out, err) = trilith(folder.path(), &["run", "swing.ron"]);
    assert_eq!(status, 0, "{out}{err}");
    for part in ["A swinging mass", "swing", "fna", "converged", "sway", "input", "work:"] {
        assert!(out.contains(part), "{part} in\n{out}");
    }
    let out = folder.path().join("out/swing");
    let json = summary(&out);
    assert!((json["outputs"]["sway"]["max"].as_f64().unwrap() - 0.02).abs() < 1e-4, "{json}");
    for file in ["histories.csv", "histories.npz", "model.resolved.ron", "model.pvd"] {
        assert!(out.join(file).is_file(), "{file}");
    }
}

#[test]
fn what_is_in_the_way_of_the_results_is_told_before_the_run() {
    let folder = folder();
    let run = |args: &[&str]| {
        let (status, out, err) = trilith(folder.path(), args);
        assert_eq!((status, out.as_str()), (2, ""), "{args:?}\n{err}");
        err
    };
    let err = run(&["run", "swing.ron", "--out", "swing.ron"]);
    assert!(err.contains("swing.ron is a file, no folder") && err.contains("--out DIR"), "{err}");
    let taken = Folder::open(folder.path().join("out"), Writer::default()).unwrap();
    let err = run(&["run", "swing.ron", "--out", "out"]);
    assert!(err.contains("another run is writing to out"), "{err}");
    drop(taken);
    assert_eq!(trilith(folder.path(), &["run", "swing.ron", "--out", "out"]).0, 0);
    // A model of that name, and a record.
    for (name, text) in [("model.resolved.ron", MODEL), ("spectra.csv", "t [s],a [g]\n0,0\n1,1\n")]
    {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let err = run(&["run", "model.resolved.ron", "--out", "."]);
    assert!(err.contains("model.resolved.ron is an input, and would be overwritten"), "{err}");
    let err = run(&["record", "spectra.csv", "--out", "."]);
    assert!(err.contains("spectra.csv is an input, and would be overwritten"), "{err}");
    let model = std::fs::read_to_string(folder.path().join("model.resolved.ron")).unwrap();
    assert_eq!(model, MODEL);
}

#[test]
fn runs_with_other_parameters_have_folders_of_their_own() {
    let folder = folder();
    let (status, out, err) = trilith(folder.path(), &["run", "swing.ron", "--set", "k=9.87 N/m"]);
    assert_eq!(status, 0, "{out}{err}");
    assert!(out.contains("files: out/swing/k=9.87_N_m\n"), "{out}");
    assert!(folder.path().join("out/swing/k=9.87_N_m/summary.json").is_file());
    assert!(!folder.path().join("out/swing/summary.json").exists());
}

#[test]
fn what_is_rounding_is_shown_as_zero() {
    let folder = folder();
    let model =
        MODEL.replace("outputs: {", "outputs: { \"heave\": Displacement(node: \"top\", dof: Uz), ");
    std::fs::write(folder.path().join("heave.ron"), model.replace("r2: 1", "r2: 1e9")).unwrap();
    let (_, out, err) = trilith(folder.path(), &["run", "heave.ron", "--no-files"]);
    let heave: Vec<&str> =
        out.lines().find(|l| l.contains("heave")).unwrap().split_whitespace().collect();
    assert_eq!([heave[2], heave[4], heave[6]], ["0"; 3], "{out}{err}");
}

#[test]
fn a_set_parameter_changes_the_period() {
    let folder = folder();
    let args = ["run", "swing.ron", "--set", "k=9.8696 N/m", "--out", "slow"];
    let (status, out, err) = trilith(folder.path(), &args);
    assert_eq!(status, 0, "{out}{err}");
    let end = &summary(&folder.path().join("slow"))["outputs"]["sway"]["final"];
    assert!((end.as_f64().unwrap() + 0.02).abs() < 1e-3, "{end}");
}

#[test]
fn a_restart_ends_as_the_run_in_one_piece() {
    let folder = folder();
    let run = |args: &[&str]| {
        let (status, out, err) = trilith(folder.path(), &[&["run", "swing.ron"], args].concat());
        assert_eq!(status, 0, "{out}{err}");
    };
    run(&["--out", "whole"]);
    run(&["--out", "half", "--checkpoint-at", "0.5"]);
    run(&["--out", "rest", "--restart", "half/checkpoint.json"]);
    let end = |name: &str| summary(&folder.path().join(name))["outputs"]["sway"]["final"].clone();
    let (whole, rest) = (end("whole").as_f64().unwrap(), end("rest").as_f64().unwrap());
    assert!((whole - rest).abs() < 1e-12, "{whole} {rest}");
}

#[test]
fn the_resolved_model_is_itself_a_model() {
    let folder = folder();
    let (status, first, err) = trilith(folder.path(), &["check", "swing.ron", "--resolved"]);
    assert_eq!(status, 0, "{err}");
    std::fs::write(folder.path().join("again.ron"), &first).unwrap();
    let (status, second, err) = trilith(folder.path(), &["check", "again.ron", "--resolved"]);
    assert_eq!(status, 0, "{err}");
    let body = |t: &str| t.lines().filter(|l| !l.starts_with("//")).collect::<String>();
    assert_eq!(body(&first), body(&second));
}

#[test]
fn all_errors_of_a_file_are_shown_with_their_lines() {
    let folder = folder();
    let text = MODEL.replace("k: \"1 kN/m\"", "kk: \"1 kN\"").replace("dof: Ux)", "dof: Uxx)");
    std::fs::write(folder.path().join("bad.ron"), text).unwrap();
    let (status, out, err) = trilith(folder.path(), &["run", "bad.ron"]);
    assert_eq!((status, out.as_str()), (2, ""));
    assert!(err.contains("bad.ron:10:") && err.contains("bad.ron:18:"), "{err}");
    assert!(err.contains("^") && !err.contains('\u{1b}'), "{err}");
}

#[test]
fn a_structure_that_can_move_is_shown_at_its_node() {
    let folder = folder();
    let text = r#"(
    plane: XZ,
    nodes: { "cart": (0, 0, 0) },
    supports: { "cart": (Uz, Ry) },
    elements: { "mass": Mass(node: "cart", mass: "1 kg") },
    cases: { "push": Static(loads: [Gravity]) },
)"#;
    std::fs::write(folder.path().join("loose.ron"), text).unwrap();
    let (status, _, err) = trilith(folder.path(), &["check", "loose.ron"]);
    assert_eq!(status, 2, "{err}");
    assert!(err.contains("loose.ron:3:") && err.contains("\"cart\" Ux"), "{err}");
}

#[test]
fn wrong_names_are_corrected() {
    let folder = folder();
    for (args, part) in [
        (&["run", "swing.ron", "--case", "swnig"][..], "did you mean `swing`?"),
        (&["run", "swing.ron", "--solver", "hhtt"], "did you mean `hht`?"),
        (&["elements", "Nlink"], "did you mean `NLink`?"),
        (&["run", "none.ron"], "cannot be read"),
        (&["run", "swing.ron", "--set", "k"], "NAME=VALUE"),
        (&["run", "swing.ron", "--restart", "swing.ron"], "checkpoint"),
    ] {
        let (status, out, err) = trilith(folder.path(), args);
        assert_eq!((status, out.as_str()), (2, ""), "{args:?}");
        assert!(err.contains(part), "{part} in\n{err}");
    }
}

#[test]
fn the_catalogue_lists_every_kind_and_shows_each_in_full() {
    let folder = folder();
    let (status, list, _) = trilith(folder.path(), &["elements"]);
    assert_eq!(status, 0);
    for card in trilith::registry().cards() {
        assert!(list.contains(card.kind) && list.contains(card.summary), "{list}");
    }
    let (_, card, _) = trilith(folder.path(), &["elements", "NLink"]);
    for part in ["parameters", "law", "source", "example", "required", "N/m"] {
        assert!(card.contains(part), "{part} in\n{card}");
    }
}

#[test]
fn modes_show_the_period_of_the_spring() {
    let folder = folder();
    let (status, out, err) = trilith(folder.path(), &["modes", "swing.ron"]);
    assert_eq!(status, 0, "{err}");
    assert!(out.contains("1.0000"), "{out}");
}

#[test]
fn two_solvers_agree_on_the_swing() {
    let folder = folder();
    let args = ["compare", "swing.ron", "--solvers", "fna,hht"];
    let (status, out, err) = trilith(folder.path(), &args);
    assert_eq!(status, 0, "{out}{err}");
    for part in ["fna max", "hht max", "diff", "fna (converged)", "hht (converged)"] {
        assert!(out.contains(part), "{part} in\n{out}");
    }
    let (status, _, err) = trilith(folder.path(), &["compare", "swing.ron", "--solvers", "fna"]);
    assert!(status == 2 && err.contains("two solvers"), "{err}");
}

/// A block on two feet, as a file.
const BLOCK: &str = r#"(
    plane: XZ,
    nodes: { "cg": (0, 0, 2), "left": (-1, 0, 0), "right": (1, 0, 0) },
    elements: {
        "block": RigidBody(nodes: ("cg", "left", "right")),
        "mass": Mass(node: "cg", mass: "10 t", inertia: (0, "16666.7 kg*m^2", 0)),
        "left": NLink(node: "left", kn: "5e8 N/m", ks: "5e8 N/m", mu: 5, restitution: 0.25, pull: true),
        "right": NLink(node: "right", kn: "5e8 N/m", ks: "5e8 N/m", mu: 5, restitution: 0.25, pull: true),
    },
    cases: { "gravity": Static(loads: [Gravity]) },
)"#;

#[test]
fn a_block_is_calibrated_for_a_drop_and_for_rocking() {
    let folder = folder();
    std::fs::write(folder.path().join("block.ron"), BLOCK).unwrap();
    let args = ["calibrate", "block.ron", "--restitution", "0.25", "--rocking", "0.4"];
    let (status, out, err) = trilith(folder.path(), &args);
    assert_eq!(status, 0, "{out}{err}");
    // ζ = 0.4037 against half the mass; Housner's 0.49; a dashpot to paste.
    for part in ["1.27665e6 N·s/m at each foot", "0.4900", "Spring(node: \"cg\", cr3:", "5000.0"] {
        assert!(out.contains(part), "{part} in\n{out}");
    }
    for (args, part) in [
        (&["calibrate", "block.ron", "--rocking", "0.9"][..], "out of reach"),
        (&["calibrate", "block.ron", "--rocking", "houzner"], "`housner` is wanted"),
        (&["calibrate", "block.ron", "--restitution", "2"], "at most 1"),
        (&["calibrate", "block.ron", "--height", "3 s"], "must be in m"),
        (&["calibrate", "block.ron", "--along", "Y"], "leaves no motion along Y"),
        (&["calibrate", "swing.ron"], "stand free"),
    ] {
        let (status, _, err) = trilith(folder.path(), args);
        assert_eq!(status, 2, "{args:?}");
        assert!(err.contains(part), "{part} in\n{err}");
    }
}

#[test]
fn a_catalogue_is_written_by_the_ending_of_its_name() {
    let folder = folder();
    for name in ["all.html", "all.md"] {
        let (status, out, err) = trilith(folder.path(), &["elements", "--page", name]);
        assert_eq!(status, 0, "{out}{err}");
        let text = std::fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(text.contains("NLink") && text.contains("<svg") == (name == "all.html"));
    }
    let (status, _, err) = trilith(folder.path(), &["elements", "--page", "all.pdf"]);
    assert!(status == 2 && err.contains("`.html` or `.md`"), "{err}");
}

#[test]
fn a_run_ends_with_a_report_that_its_folder_can_make_again() {
    let folder = folder();
    let (status, out, err) = trilith(folder.path(), &["run", "swing.ron", "--set", "k=30 N/m"]);
    assert_eq!(status, 0, "{out}{err}");
    let dir = folder.path().join("out/swing/k=30_N_m");
    let page = std::fs::read_to_string(dir.join("report.html")).unwrap();
    let parts = [
        "A swinging mass",
        "sway",
        "Mode shapes",
        "Energy",
        "SHA-256",
        "30 N/m",
        "<svg",
        "class=\"drawing\"",
    ];
    for part in parts {
        assert!(page.contains(part), "{part}");
    }
    // Nothing is fetched: the only addresses are names of formats.
    for (at, _) in page.match_indices("http") {
        assert!(page[at..].starts_with("http://www.w3.org/"), "{}", &page[at..at + 40]);
    }
    for fetched in ["src=", "@import"] {
        assert!(!page.contains(fetched), "{fetched}");
    }
    for (at, _) in page.match_indices("url(") {
        assert!(page[at..].starts_with("url(#"), "{}", &page[at..at + 40]);
    }
    std::fs::remove_file(dir.join("report.html")).unwrap();
    let (status, out, err) = trilith(folder.path(), &["report", "out/swing/k=30_N_m"]);
    assert_eq!(status, 0, "{out}{err}");
    assert_eq!(std::fs::read_to_string(dir.join("report.html")).unwrap(), page);
    // A report of another run would be left among the new files.
    let args = ["run", "swing.ron", "--set", "k=30 N/m", "--no-report"];
    let (status, ..) = trilith(folder.path(), &args);
    assert_eq!(status, 0);
    assert!(!dir.join("report.html").exists() && !dir.join("report.json").exists());
    let (status, _, err) = trilith(folder.path(), &["report", "out/swing/k=30_N_m"]);
    assert!(status == 2 && err.contains("report.json") && err.contains("trilith run"), "{err}");
}

#[test]
fn the_report_shows_the_loops_that_are_asked_for() {
    let folder = folder();
    // The stop lies across the mast.
    let text = MODEL.replace("opening: \"1 cm\"", "opening: \"1 cm\", axis1: (1, 0, 0)");
    std::fs::write(folder.path().join("swing.ron"), text).unwrap();
    let (status, _, err) = trilith(folder.path(), &["run", "swing.ron", "--loops", "stpo"]);
    assert!(status == 2 && err.contains("did you mean `stop`?"), "{err}");
    let (status, _, err) = trilith(folder.path(), &["run", "swing.ron", "--loops", "stop"]);
    assert_eq!(status, 0, "{err}");
    let text = std::fs::read_to_string(folder.path().join("out/swing/report.json")).unwrap();
    let data: serde_json::Value = serde_json::from_str(&text).unwrap();
    let [stop] = &data["loops"].as_array().unwrap()[..] else { panic!("{}", data["loops"]) };
    assert_eq!((&stop["link"], &stop["kind"]), (&"stop".into(), &"Gap".into()));
    // A gap pushes with k (d + opening) where d < −opening, and is free elsewhere.
    let numbers = |of: &serde_json::Value| -> Vec<f64> {
        let step = of["step"].as_f64().unwrap();
        of["n"].as_array().unwrap().iter().map(|n| n.as_f64().unwrap() * step).collect()
    };
    for (d, f) in numbers(&stop["d"]).iter().zip(numbers(&stop["f"])) {
        assert!((f - 1000.0 * (d + 0.01).min(0.0)).abs() < 0.05, "{d} {f}");
    }
}

#[test]
fn a_frame_of_so_many_bays_is_generated() {
    let folder = folder();
    let frame = |bays: &str| {
        let args = ["generate", "frame", "--bays", bays, "--storeys", "1", "--out", "frame.ron"];
        trilith(folder.path(), &args)
    };
    let (status, out, err) = frame("3,2");
    assert_eq!(
        (status, out.lines().next()),
        (0, Some("24 nodes, 46 beams, 12 isolators")),
        "{err}"
    );
    let (status, _, err) = frame("3");
    assert!(status == 2 && err.contains("two values"), "{err}");
}

#[test]
fn figures_are_svg_and_on_request_png() {
    let folder = folder();
    let run = |formats: &[&str]| {
        let args = ["run", "swing.ron", "--figure", "sway,energy", "--out", "figures"];
        trilith(folder.path(), &[&args, formats].concat())
    };
    let file = |name: &str| std::fs::read(folder.path().join("figures").join(name));
    assert_eq!(run(&[]).0, 0);
    assert!(file("sway.svg").unwrap().starts_with(b"<svg") && file("sway.png").is_err());
    let (status, out, err) = run(&["--figure-format", "png,svg"]);
    if cfg!(feature = "png") {
        assert_eq!(status, 0, "{err}");
        assert!(out.contains("sway.png") && out.contains("energy.svg"), "{out}");
        for name in ["sway.png", "energy.png"] {
            assert!(file(name).unwrap().starts_with(b"\x89PNG\r\n"), "{name}");
        }
    } else {
        assert!(status == 2 && err.contains("--features png") && out.is_empty(), "{out}{err}");
    }
    let (status, _, err) = run(&["--figure-format", "jpg"]);
    assert!(status == 2 && err.contains("svg") && err.contains("png"), "{err}");
    let args = ["run", "swing.ron", "--figure-format", "svg"];
    let (status, _, err) = trilith(folder.path(), &args);
    assert!(status == 2 && err.contains("--figure"), "{err}");
}

/// The motion that the page shows is that which the recorder has of a node that is fixed to the ground.
#[test]
fn the_ground_motion_of_the_report_is_that_of_a_fixed_node() {
    let folder = tempfile::tempdir().unwrap();
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/floor_spectra.ron");
    let model = model.display().to_string();
    let args = ["run", &model, "--out", "floors", "--figure", "ground,spectra"];
    let (status, out, err) = trilith(folder.path(), &args);
    assert_eq!(status, 0, "{err}");
    for name in ["ground_1.svg", "ground_2.svg", "spectra_1.svg", "spectra_2.svg"] {
        assert!(out.contains(name), "{out}");
    }
    let dir = folder.path().join("floors");
    let text = std::fs::read_to_string(dir.join("report.json")).unwrap();
    let data: serde_json::Value = serde_json::from_str(&text).unwrap();
    let zpa = summary(&dir)["spectra"]["ground"]["zpa"].as_f64().unwrap();
    let peak = data["ground"][0]["peak"].as_f64().unwrap();
    assert!((peak.abs() / zpa - 1.0).abs() < 1e-9, "{peak} {zpa}");
    // The spectrum of the motion beside the floor spectrum of that node, which goes by absolute acceleration.
    let curve = |chart: &serde_json::Value| -> Vec<(f64, f64)> {
        let of = |n: &serde_json::Value| -> Vec<f64> {
            let step = n["step"].as_f64().unwrap();
            n["n"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap() * step).collect()
        };
        of(&chart["period"]).into_iter().zip(of(&chart["y"])).collect()
    };
    let ground = curve(&data["ground_spectra"][0]["curves"][0]);
    let floors = data["floor_spectra"].as_array().unwrap();
    assert_eq!(floors.len(), 2, "a chart for each damping");
    let five = floors.iter().find(|c| c["title"].as_str().unwrap().contains("5 %")).unwrap();
    let floor = curve(&five["curves"][0]);
    let mut compared = 0;
    for (period, sa) in floor.iter().filter(|(t, _)| (0.05..2.0).contains(t)) {
        let i = ground.iter().position(|(t, _)| t > period).unwrap();
        let ((t0, y0), (t1, y1)) = (ground[i - 1], ground[i]);
        let psa = y0 + (y1 - y0) * (period - t0) / (t1 - t0);
        // Sa is above PSA by the force of the damper, and between periods the curve is a chord.
        assert!((0.97..1.08).contains(&(sa / psa)), "{period} s: {sa} {psa}");
        compared += 1;
    }
    assert!(compared > 20, "{compared}");
}

#[test]
fn floor_spectra_of_long_output_steps_are_warned_of() {
    let folder = folder();
    let spectra = r#"spectra: { "top": (node: "top", dof: Ux, frequencies: [1, 10]) },
    cases:"#;
    let text = MODEL.replace("cases:", spectra);
    std::fs::write(folder.path().join("swing.ron"), text).unwrap();
    let told = |step: &str| {
        let (status, out, err) = trilith(folder.path(), &["run", "swing.ron", "--dt", step]);
        assert_eq!(status, 0, "{out}{err}");
        out + &err
    };
    // 10 Hz in 10 ms: ten steps a period, and one too few.
    assert!(!told("0.01").contains("floor spectrum"));
    let text = told("0.0125");
    for part in [
        "floor spectrum `top`: 8.000 output steps of 0.0125 s",
        "0.1 s",
        "up to 5 %",
        "`dt` ≤ 0.01 s",
    ] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
}

/// The building of the guide under the spectrum of a code, by files and by arguments that are wrong.
#[test]
fn modes_with_links_and_a_spectrum_tell_what_is_wrong_with_them() {
    let folder = folder();
    std::fs::write(folder.path().join("points.csv"), "T [s],Sa [g]\n0,1\n4,1\n").unwrap();
    let ask = |more: &[&str]| trilith(folder.path(), &[&["modes", "swing.ron"], more].concat());
    let (status, out, err) = ask(&["--links", "engaged", "--spectrum", "points.csv"]);
    assert_eq!(status, 0, "{err}");
    assert!(
        out.contains("modes with engaged links") && out.contains("peaks under points.csv"),
        "{out}"
    );
    assert!(!out.contains("no stiffness"), "{out}");
    // Without its spring nothing holds it; along Y it cannot move at all.
    let free = MODEL.replace(
        r#""spring": Spring(nodes: ("base", "top"), k1: "1 kN/m", k2: "k", r2: 1, r3: 1),"#,
        "",
    );
    let free = free.replace(r#""base": Fixed"#, r#""base": Fixed, "top": Ry"#);
    std::fs::write(folder.path().join("free.ron"), free).unwrap();
    let args = ["modes", "free.ron", "--links", "open", "--spectrum", "points.csv"];
    let (_, out, err) = trilith(folder.path(), &args);
    assert!(!out.contains("along Y"), "{out}");
    assert!(out.contains("of the modes have no stiffness"), "{out}{err}");
    for (more, part) in [
        (&["--amplitude", "1 cm"][..], "--links"),
        (&["--links", "secant"], "--amplitude"),
        (&["--links", "tangent", "--amplitude", "1 cm"], "`--links secant` alone"),
        (&["--links", "open", "--after", "rest"], "`--after`"),
        (&["--links", "tangent", "--after", "nothing"], "no case \"nothing\""),
        (&["--links", "secant", "--amplitude", "1 cm", "--of", "x*"], "no link \"x*\""),
        (&["--links", "open", "--spectrum", "none.csv"], "none.csv"),
        (&["--links", "open", "--spectrum", "points.csv", "--along", "x,x"], "at most once"),
        (&["--links", "open", "--spectrum", "EC8(ground: B)"], "ag"),
    ] {
        let (status, out, err) = ask(more);
        assert!(status == 2 && err.contains(part) && out.is_empty(), "{more:?}: {status} {err}");
    }
}
