//! A law that reads a file: from the model to results, studies and errors.

use std::path::{Path, PathBuf};
use std::process::Command;
use trilith::{Model, Registry};

const CURVE: &str = "d, f\n0, 0\n0.02, 8e3\n0.05, 11e3\n";

/// A mass of 1 t on a mount and a spring of 100 kN/m.
const MODEL: &str = r#"(
    parameters: { "test": Text("mount.csv"), "force": "5 kN" },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Ux, Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1 t"),
        "spring": Spring(node: "m", k1: "100 kN/m"),
        "mount": MeasuredSpring(node: "m", curve: Parameter("test"), specimen: "mount 3"),
    },
    loads: { "push": [(node: "m", dof: Uz, force: "force")] },
    functions: { "on": Constant(value: 1) },
    cases: {
        "push": Static(loads: ["push"]),
        "let go": Dynamic(duration: "0.2 s", dt: "5 ms", forces: [(load: "push", function: "on")]),
    },
    outputs: { "u": Displacement(node: "m", dof: Uz) },
)"#;

fn kinds() -> Registry {
    let mut kinds = trilith::registry();
    trilith_thirdparty_example::register(&mut kinds);
    kinds
}

/// A folder with files in it.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, files: &[(&str, &str)]) -> Self {
        let folder = std::env::temp_dir().join(format!("trilith-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("a folder");
        let it = Self(folder);
        files.iter().for_each(|(name, text)| it.write(name, text));
        it
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.0.join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, text).expect("written");
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).expect("a file")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn model(folder: &Path, text: &str, set: &[(&str, &str)]) -> Result<Model, String> {
    let set: Vec<_> = set.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    let told = |d: &trilith::model::Diagnostic| {
        format!(
            "[{}] {} ({})",
            &d.source.text[d.span.clone()],
            d.message,
            d.help.as_deref().unwrap_or("")
        )
    };
    trilith::read_text(text, folder.join("model.ron"), &kinds(), &set)
        .map_err(|all| all.iter().map(told).collect::<Vec<_>>().join("\n"))
}

fn pushed(model: &Model) -> f64 {
    trilith::run(model, "push").expect("a run").peak("u").expect("an output").max
}

#[test]
fn a_law_follows_the_file_that_the_model_names() {
    let other = "0, 0\n0.1, 30e3\n";
    let folder = Folder::new("names", &[("mount.csv", CURVE), ("more/other.csv", other)]);
    let one = model(&folder.0, MODEL, &[]).unwrap();
    // 500 kN/m hold 5 kN.
    assert!((pushed(&one) - 0.01).abs() < 1e-9);
    assert_eq!(one.files, [folder.0.join("mount.csv")]);
    let two = model(&folder.0, MODEL, &[("test", "more/other.csv")]).unwrap();
    assert!((pushed(&two) - 5.0 / 400.0).abs() < 1e-9);
    // With all that it has read in it, the model needs no other file.
    let resolved = trilith::model::resolved(&one);
    let again = model(Path::new("/nowhere"), &resolved, &[]).unwrap();
    assert_eq!(pushed(&again), pushed(&one));
    assert!(again.files.is_empty());
    // But for the parameters, which it tells in comments.
    let elements = |text: &str| text[text.find("elements").expect("elements")..].to_owned();
    assert_eq!(elements(&trilith::model::resolved(&again)), elements(&resolved));
}

#[test]
fn what_is_wrong_with_a_file_is_told_at_its_name() {
    let bad = CURVE.replace("0.05,", "0.01,");
    let folder = Folder::new("errors", &[("mount.csv", CURVE), ("bad.csv", &bad)]);
    let told = |curve: &str| {
        let text = MODEL.replace("Parameter(\"test\")", curve);
        model(&folder.0, &text, &[]).expect_err("an error")
    };
    assert_eq!(
        told("\"bad.csv\""),
        "[\"bad.csv\"] element `mount`: `curve`: bad.csv, line 4: deformations must rise: 0.01 m comes after 0.02 m ()"
    );
    let missing = told("\"mont.csv\"");
    assert!(
        missing.starts_with("[\"mont.csv\"] ") && missing.contains("cannot be read"),
        "{missing}"
    );
    assert!(missing.ends_with("(the path counts from the folder of the file in which it stands)"));
    assert!(told("Parameter(\"tset\")").contains("there is no text parameter `tset`"));
    assert!(told("3").contains("a file name in quotes"));
    assert!(told("Contents(\"a\")").contains("a name and what the file holds"));
    let text = MODEL.replace("\"mount 3\"", "mount");
    let told = model(&folder.0, &text, &[]).expect_err("an error");
    assert!(told.contains("a text in quotes or `Parameter(\"name\")` for `specimen`"), "{told}");
}

fn program(arguments: &[&str]) -> (bool, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith-thirdparty-example"));
    let done = command.args(arguments).output().expect("the program");
    let text =
        [done.stdout, done.stderr].map(|t| String::from_utf8_lossy(&t).into_owned()).concat();
    (done.status.success(), text)
}

#[test]
fn the_program_keeps_the_hash_of_the_file_and_a_study_sees_it_change() {
    let study = r#"(
        model: "model.ron", case: "let go",
        axes: { "force": ["1 kN", "4 kN"], "test": ["mount.csv", "stiff.csv"] },
        columns: { "u": Peak("u") },
    )"#;
    let stiff = "0 0\n0.05 40e3\n";
    let files =
        [("mount.csv", CURVE), ("stiff.csv", stiff), ("model.ron", MODEL), ("study.ron", study)];
    let folder = Folder::new("program", &files);
    let path = |name: &str| folder.0.join(name).display().to_string();
    let (model, out, study, table) =
        (path("model.ron"), path("out"), path("study.ron"), path("table"));

    let (good, text) = program(&["run", &model, "--case", "push", "--out", &out, "--no-report"]);
    assert!(good, "{text}");
    let made_by = folder.read("out/made_by.json");
    let hash = trilith::results::sha256(CURVE.as_bytes());
    assert!(made_by.contains("mount.csv") && made_by.contains(&hash), "{made_by}");

    // Where the curve ends, so does the run, and the study says it as well.
    let (good, text) =
        program(&["run", &model, "--set", "force=15 kN", "--out", &out, "--no-report"]);
    let words = "mount 3 was pulled to 50 mm only (`mount.csv`)";
    assert!(!good && text.contains(words), "{text}");
    assert!(folder.read("out/summary.json").contains("\"status\": \"refused\""));

    let sweep = || program(&["sweep", &study, "--out", &table]);
    let (good, text) = sweep();
    assert!(good, "{text}");
    let before = folder.read("table/table.csv");
    let (good, again) = sweep();
    assert!(good && again.contains("4 were on disk"), "{again}");
    folder.write("stiff.csv", "0 0\n0.05 45e3\n");
    // What was made with another file is no part of the same table.
    let (good, changed) = sweep();
    assert!(!good && changed.contains("has runs of another study"), "{changed}");
    assert!(
        changed.contains("a ground motion, or another file that the model names, changed"),
        "{changed}"
    );
    std::fs::remove_dir_all(folder.0.join("table")).expect("removed");
    assert!(sweep().0);
    assert_ne!(folder.read("table/table.csv"), before);
}
