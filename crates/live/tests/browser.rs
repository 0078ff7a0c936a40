//! A live page in a real browser, where there are one, Node.js and the engine: its peaks are those of the library.

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use trilith::RunOptions;
use trilith::report::{Charts, Entries, Entry, Figure, Stroke};
use trilith_live::{Live, page};

/// Slider of a parameter whose value is x0 5^s: s, and the value as the page rounds it.
const SLIDER: (f64, &str) = (-0.25, "0.401");

/// The engine where cargo puts it; `TRILITH_ENGINE` names another. None, and it is said, where it or Node.js is missing.
fn engine() -> Option<Vec<u8>> {
    if Command::new("node").arg("--version").output().is_err() {
        println!("not run: no Node.js found");
        return None;
    }
    let target = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("..");
    let built = target.join("wasm32-unknown-unknown/live/trilith_live.wasm");
    let path = std::env::var_os("TRILITH_ENGINE").map_or(built, PathBuf::from);
    let engine = std::fs::read(path).ok();
    if engine.is_none() {
        println!("not run: the engine for pages is not built");
    }
    engine
}

/// The shipped block as a live page.
fn block<'a>(title: &'a str, text: &'a str, engine: &'a [u8]) -> Live<'a> {
    Live {
        title,
        path: "rigid_block.ron",
        text,
        files: BTreeMap::new(),
        set: &[],
        case: None,
        solver: None,
        charts: None,
        engine,
    }
}

/// Writes a page and what is expected of it into a folder of its own, and has a script drive it.
fn drive(script: &str, live: &Live<'_>, expected: &Value) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(script).with_extension("");
    std::fs::create_dir_all(&folder).unwrap();
    let write = |name: &str, content: String| {
        let path = folder.join(name);
        std::fs::write(&path, content).unwrap();
        path
    };
    let files =
        [write("page.html", page(live).unwrap()), write("expected.json", expected.to_string())];
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(script);
    let mut drive = Command::new("node");
    let done = drive.arg(script).args(files).arg(folder.join("pictures")).output().unwrap();
    let told = String::from_utf8_lossy(&done.stdout);
    print!("{told}");
    assert!(done.status.success(), "{told}{}", String::from_utf8_lossy(&done.stderr));
}

/// The text of the shipped block.
fn text() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/rigid_block.ron");
    std::fs::read_to_string(path).unwrap()
}

/// Peaks by the library, as the page shows them.
fn peaks(text: &str, set: &[(&str, &str)]) -> BTreeMap<String, f64> {
    let set: Vec<_> = set.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    let text = trilith::model::ModelText::new(text, "rigid_block.ron").unwrap();
    let model = text.read(&trilith::registry(), &set).unwrap();
    let case = model.cases.len() - 1;
    let options = RunOptions { case, ..RunOptions::default() };
    let run = trilith::Analysis::new(&model).unwrap().run(options).unwrap();
    let one = |o: &trilith::model::Output| {
        let peak = run.peak(&o.name).unwrap();
        (o.name.clone(), if peak.max >= -peak.min { peak.max } else { peak.min })
    };
    model.shown().map(|(_, o)| one(o)).filter(|(_, x)| *x != 0.0).collect()
}

/// Points of a small mode chart of the block: friction and peak acceleration, by rows of runs.
const CHART: [(f64, f64); 4] = [(0.2, 0.3), (0.8, 0.3), (0.2, 0.9), (0.8, 0.9)];

/// A chart over two parameters, with the runs that its points stand for.
fn charts() -> Charts {
    let of = |name: &str| (name.to_owned(), String::new());
    let chart = Figure::new("Modes", "friction coefficient μ", "peak acceleration A [g]")
        .series("runs", Stroke::Squares, CHART)
        .standing_for(0..CHART.len())
        .setting(of("mu"), of("ah"))
        .ranges((0.0, 1.0), (0.0, 1.0));
    let row = |(mu, ah): (f64, f64)| Entry {
        cells: vec![mu.to_string(), ah.to_string()],
        place: Vec::new(),
        set: vec![("mu".into(), mu.to_string()), ("ah".into(), ah.to_string())],
    };
    let entries = Entries {
        name: "run".into(),
        command: "trilith run rigid_block.ron".into(),
        common: vec![("duration".into(), "1 s".into())],
        head: vec![of("mu"), of("ah")],
        rows: CHART.into_iter().map(row).collect(),
    };
    Charts::new(&[chart], &entries)
}

#[test]
fn a_page_computes_the_run_where_the_cursor_of_a_chart_is() {
    let Some(engine) = engine() else { return };
    let (text, charts) = (text(), charts());
    let live = Live { charts: Some(&charts), ..block("Modes of a block", &text, &engine) };
    // Between the runs of the chart: what is read from the page is what the page sets.
    let places = [("0.7", "0.25"), ("0.15", "0.85"), ("0.75", "0.8")];
    let places: Vec<Value> = places
        .iter()
        .map(|(mu, ah)| {
            let set = [("duration", "1 s"), ("mu", mu), ("ah", ah)];
            json!({ "x": mu, "y": ah, "peaks": peaks(&text, &set) })
        })
        .collect();
    drive("cursor.mjs", &live, &json!(places));
}

#[test]
fn a_page_computes_what_the_library_computes_and_tells_what_is_wrong() {
    let Some(engine) = engine() else { return };
    let text = text();
    let expected = json!({
        "parameter": "mu",
        "slider": SLIDER.0,
        "peaks": peaks(&text, &[]),
        "moved": peaks(&text, &[("mu", SLIDER.1)]),
        "wrong": ["\"10 t\"", "\"10 m\""],
    });
    drive("live.mjs", &block("Rigid block", &text, &engine), &expected);
}
