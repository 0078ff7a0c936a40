//! Measured histories and structures from outside: what the program prints of them.

use assert_cmd::Command;
use std::path::Path;

/// Exit status, stdout, stderr.
fn trilith(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    let output = command.current_dir(folder).args(args).output().unwrap();
    let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn a_link_is_led_along_a_measured_history() {
    let folder = tempfile::tempdir().unwrap();
    let measured = "t [s],U1 [mm],F [kN]\n0,0,0\n0.5,8,5\n1,2,1\n2,10,8\n";
    std::fs::write(folder.path().join("test.csv"), measured).unwrap();
    let link = ["exercise", "Hook", "--set", "k=1 MN/m", "--set", "opening=2 mm"];
    let args = [&link[..], &["--history", "test.csv"]].concat();
    let (status, out, err) = trilith(folder.path(), &args);
    assert_eq!(status, 0, "{out}{err}");
    for part in ["led along test.csv: 4 samples from 0 s to 2.0000 s", "not used: F", "8000.0"] {
        assert!(out.contains(part), "{part} in\n{out}");
    }
    let files = folder.path().join("out/exercise_Hook");
    let csv = std::fs::read_to_string(files.join("path.csv")).unwrap();
    let rows: Vec<Vec<f64>> =
        csv.lines().skip(1).map(|l| l.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    // At a sample it is the law of the sample, k (d − g) while the cable is taut.
    for (t, d) in [(0.0, 0.0), (0.5, 8e-3), (1.0, 2e-3), (2.0, 10e-3)] {
        let row = rows.iter().find(|r| r[0] == t).unwrap();
        assert!((row[1] - d).abs() < 1e-15, "{row:?}");
        assert!((row[3] - 1e6 * (d - 2e-3f64).max(0.0)).abs() < 1e-6, "{row:?}");
    }
    assert!(std::fs::read_to_string(files.join("loop.svg")).unwrap().starts_with("<svg "));
}

#[test]
fn a_history_that_cannot_be_says_what_would_be_right() {
    let folder = tempfile::tempdir().unwrap();
    for (text, parts) in [
        ("t,U1\n0,0\n0,1\n", &["test.csv: line 3: time must rise", "t [s],U1 [mm]"][..]),
        ("t,d\n0,0\n1,1\n", &["none of the coordinates U1"]),
        ("t,U1 [N]\n0,0\n1,1\n", &["column `U1`", "must be in m"]),
    ] {
        std::fs::write(folder.path().join("test.csv"), text).unwrap();
        let args = ["exercise", "Hook", "--no-files", "--history", "test.csv"];
        let (status, out, err) = trilith(folder.path(), &args);
        assert_eq!((status, out.as_str()), (2, ""), "{err}");
        for part in parts {
            assert!(err.contains(part), "{part} in\n{err}");
        }
    }
    let both = ["exercise", "Hook", "--history", "test.csv", "--cycles", "2"];
    let (status, _, err) = trilith(folder.path(), &both);
    assert!(status == 2 && err.contains("--cycles"), "{err}");
    let (status, _, err) = trilith(folder.path(), &["exercise", "Hook", "--history", "no.csv"]);
    assert!(status == 2 && err.contains("no.csv cannot be read"), "{err}");
}

const BUILDING: &str = r#"(
    title: "Two storeys beside a wall",
    plane: XZ,
    nodes: { "a": (0, 0, 0), "b": (0, 0, 4) },
    supports: { "a": Ry, "b": Ry },
    elements: {
        "base": Mass(node: "a", mass: "20 t"),
        "roof": Mass(node: "b", mass: "20 t"),
        "storey": Spring(nodes: ("a", "b"), k1: "10 GN/m", k2: "20 MN/m"),
        "isolator": FrictionPendulum(node: "a", kn: "5 GN/m", ks: "20 MN/m", radius: "1 m", mu: 0.05),
        "wall": Gap(node: "b", axis: U2, k: "10 MN/m", opening: "2 cm"),
    },
    functions: { "pulse": Ricker(amplitude: "0.4 g", frequency: "1 Hz", center: "1 s") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(
            after: "gravity", duration: "4 s", dt: "5 ms",
            base: [(direction: X, function: "pulse")],
        ),
    },
    outputs: {
        "drift": Displacement(terms: [(node: "b", dof: Ux), (node: "a", dof: Ux, factor: -1)]),
        "push": LinkForce(link: "wall", axis: U2),
    },
)"#;

#[test]
fn a_building_has_base_shear_and_drift_instead_of_a_response_mode() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("building.ron"), BUILDING).unwrap();
    let (status, out, err) = trilith(folder.path(), &["run", "building.ron"]);
    assert_eq!(status, 0, "{out}{err}");
    for part in [
        "base shear: ≤ ",
        " N along X at ",
        "drift: ≤ ",
        " in \"drift\", ",
        " of the 4.0000 m between its nodes",
        "bearings: travel ≤ ",
        " in \"isolator\" at ",
        " N in \"wall\" at ",
    ] {
        assert!(out.contains(part), "{part} in\n{out}");
    }
    for part in ["contact:", "slide", "rock", "along Y"] {
        assert!(!out.contains(part), "{part} in\n{out}");
    }
    let page = std::fs::read_to_string(folder.path().join("out/building/report.html")).unwrap();
    for part in ["base shear X", "largest drift", "largest travel of bearings", "hits of stops"] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("response mode"));
    // The head of the page has the numbers of the summary, and the certificate of the run.
    let read = |name: &str| -> serde_json::Value {
        let text = std::fs::read_to_string(folder.path().join("out/building").join(name)).unwrap();
        serde_json::from_str(&text).unwrap()
    };
    let (summary, data) = (read("summary.json"), read("report.json"));
    let answer = |words: &str| {
        let all = data["answers"].as_array().unwrap();
        all.iter().find(|a| a["words"] == words).unwrap_or_else(|| panic!("{words} in {all:?}"))
    };
    let shear = summary["base_shear"]["max"][0].as_f64().unwrap();
    assert!(close(&answer("base shear X")["value"], Some(shear)));
    let share = format!("{:.1} % of the weight", 100.0 * shear / (40e3 * 9.80665));
    assert_eq!(answer("base shear X")["note"], share);
    let error = &summary["outputs"]["drift"]["error"];
    let sum = error["reduction"].as_f64().unwrap() + error["step"].as_f64().unwrap();
    assert!(close(&answer("largest drift")["error"], Some(sum)));
    let travel = summary["bearings"]["max_travel"].as_f64().unwrap();
    let period = std::f64::consts::TAU * (40e3 * travel / shear).sqrt();
    assert!(close(&answer("period at the largest travel")["value"], Some(period)));
    // An output that tells the same as an answer tells its error as well.
    let error = &summary["outputs"]["push"]["error"];
    let sum = error["reduction"].as_f64().unwrap() + error["step"].as_f64().unwrap();
    assert!(sum > 0.0 && close(&answer("largest force of a stop")["error"], Some(sum)));
    assert_eq!(answer("hits of stops")["text"], summary["stops"]["hits"].to_string());
}

/// A law of shear alone travels like a bearing where a spring or a support carries what stands on it.
#[test]
fn a_bearing_is_one_beside_a_spring_that_carries_as_well() {
    let bearing =
        r#""isolator": ElastomericBearing(node: "a", k: "20 MN/m", fy: "20 kN", ratio: 0.05),"#;
    let carried = BUILDING.replace(r#""a": Ry"#, r#""a": (Uz, Ry)"#);
    let spring = r#""spring": Spring(node: "a", k1: "5 GN/m", axis1: (0, 0, 1)),"#;
    let at = BUILDING.lines().find(|line| line.contains("FrictionPendulum")).unwrap();
    for text in [carried.replace(at, bearing), BUILDING.replace(at, &format!("{bearing}{spring}"))]
    {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("building.ron"), &text).unwrap();
        let (status, out, err) = trilith(folder.path(), &["run", "building.ron"]);
        assert_eq!(status, 0, "{out}{err}");
        let data = std::fs::read_to_string(folder.path().join("out/building/report.json")).unwrap();
        let data: serde_json::Value = serde_json::from_str(&data).unwrap();
        let all = data["answers"].as_array().unwrap();
        let travel = all.iter().find(|a| a["words"] == "largest travel of bearings");
        let travel = travel.unwrap_or_else(|| panic!("{all:?}\n{text}"));
        assert!(
            travel["value"].as_f64().unwrap() > 0.01 && travel["note"] == "isolator",
            "{travel}"
        );
    }
}

/// The same number, or none in both places.
fn close(found: &serde_json::Value, wanted: Option<f64>) -> bool {
    match (found.as_f64(), wanted) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * b.abs(),
        (a, b) => a == b,
    }
}

#[test]
fn a_cask_tells_tilt_margin_and_approach_first() {
    let folder = tempfile::tempdir().unwrap();
    let model =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/storage_cask.ron");
    let args = ["run", model.to_str().unwrap(), "--set", "duration=3 s", "--out", "cask"];
    let (status, out, err) = trilith(folder.path(), &args);
    assert_eq!(status, 0, "{out}{err}");
    let read = |name: &str| -> serde_json::Value {
        let text = std::fs::read_to_string(folder.path().join("cask").join(name)).unwrap();
        serde_json::from_str(&text).unwrap()
    };
    let (summary, data) = (read("summary.json"), read("report.json"));
    for (words, output, extreme) in [
        ("largest tilt", "tilt", "max"),
        ("margin to overturning", "margin", "min"),
        ("closest approach", "approach", "min"),
        ("largest uplift", "uplift", "max"),
    ] {
        let all = data["answers"].as_array().unwrap();
        let a = all.iter().find(|a| a["words"] == words).unwrap_or_else(|| panic!("{words}"));
        let o = &summary["outputs"][output];
        assert!(close(&a["value"], o[extreme].as_f64()), "{words}");
        assert_eq!(a["note"], output);
        let error = &o["error"];
        let sum = error["reduction"].as_f64().zip(error["step"].as_f64()).map(|(a, b)| a + b);
        assert!(close(&a["error"], sum), "{words}");
    }
    let page = std::fs::read_to_string(folder.path().join("cask/report.html")).unwrap();
    assert!(page.contains("leaves rest by") && page.contains("margin to overturning"));
}
