//! Studies from their text to their table.

mod common;

use common::{ALONE, MODEL, bytes, folder, read, run};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use trilith_study::{How, Row, Study, StudyError, execute};

const GRID: &str = r#"
    axes: { "a": Range(from: "1 m/s^2", to: "8 m/s^2", count: 8), "mu": [0.1, 0.3, "3*0.2"] },
    columns: { "slide": Peak("slide"), "ratio": "slide*mu*9.81/a", "rms": Rms("slide") },
"#;

#[test]
fn a_grid_is_a_table_whatever_the_threads() {
    let folder = folder();
    let study = read(folder.path(), GRID).unwrap();
    let (one, three) = (folder.path().join("one"), folder.path().join("three"));
    let results = run(&study, &one, 1).unwrap();
    run(&study, &three, 3).unwrap();
    for name in ["table.parquet", "table.csv", "study.html"] {
        assert_eq!(bytes(&one, name), bytes(&three, name), "{name}");
    }
    assert_eq!((results.records.len(), results.failed()), (24, 0));
    let text = String::from_utf8(bytes(&one, "table.csv")).unwrap();
    let mut lines = text.lines();
    let head = lines.next().unwrap();
    assert!(
        head.starts_with("run,a [m/s²],mu,slide [m],ratio [s^2],rms [m],initial_mode,mode,"),
        "{head}"
    );
    let rows: Vec<Vec<&str>> = lines.map(|l| l.split(',').collect()).collect();
    // mu is the fast axis; the friction of 0.1 is overcome from 1 m/s² on, that of 0.6 from 6 m/s².
    assert_eq!((rows[5][1], rows[5][2]), ("2.0", "0.6000000000000001"));
    let slide = |row: usize| rows[row][3].parse::<f64>().unwrap();
    assert!(slide(3) > 1e-3 && slide(5) < 1e-3 && slide(23) > 1e-3, "{text}");
    assert_eq!(rows[3][7], "slide");
}

#[test]
fn a_journal_cut_anywhere_ends_with_the_same_table_and_no_run_twice() {
    let folder = folder();
    let study = read(folder.path(), GRID).unwrap();
    let whole = folder.path().join("whole");
    run(&study, &whole, 2).unwrap();
    let journal = bytes(&whole, "runs.journal");
    for share in [0.0, 0.1, 0.37, 0.5, 0.93, 1.0] {
        let out = folder.path().join(format!("cut{share}"));
        std::fs::create_dir(&out).unwrap();
        let cut = (share * journal.len() as f64) as usize;
        std::fs::write(out.join("runs.journal"), &journal[..cut]).unwrap();
        let lines = journal[..cut].iter().filter(|b| **b == b'\n').count();
        let results = run(&study, &out, 2).unwrap();
        assert_eq!(results.resumed, lines.saturating_sub(1));
        for name in ["table.parquet", "table.csv"] {
            assert_eq!(bytes(&out, name), bytes(&whole, name), "{name} cut at {share}");
        }
        let now = bytes(&out, "runs.journal");
        assert_eq!(now.iter().filter(|b| **b == b'\n').count(), 25, "cut at {share}");
    }
}

#[test]
fn a_series_ends_at_its_limit_and_ensembles_keep_their_members() {
    let folder = folder();
    let body = r#"
        axes: {
            "record": ["quiet.csv", "loud.csv"],
            "a": ["1 m/s^2", "2 m/s^2", "4 m/s^2", "8 m/s^2"],
        },
        ensemble: (members: 3, of: { "mu": 0.05, "mass": 0.01 }),
        stop: (along: "a", when: Above("peak_slide", "20 mm")),
        over: ["record"],
        events: { "moves": Above("peak_slide", "1 mm"), "stops": Above("peak_slide", "20 mm") },
        figures: [
            Ida(demand: "peak_slide", intensity: "a"),
            Fragility(intensity: "a", event: Above("peak_slide", "5 mm")),
            Hazard(demand: "peak_slide", intensity: "a", rates: [("1 m/s^2", 0.01), ("8 m/s^2", 1e-4)]),
            Spread(x: "a", y: "peak_slide"), Points(x: "mu", y: "peak_slide", by: "record"),
        ],
    "#;
    let study = read(folder.path(), body).unwrap();
    let out = folder.path().join("out");
    let results = run(&study, &out, 2).unwrap();
    assert_eq!(study.identity.runs, 24);
    assert!(results.left_out > 0 && results.records.len() + results.left_out == 24);
    let at = |member: usize| {
        let of = results.records.iter().filter(|r| study.plan.place(r.run()).member == member);
        of.map(|r| r.number(&study.varied, &study.columns, "mu").unwrap()).collect::<Vec<_>>()
    };
    assert!(at(0).iter().all(|mu| *mu == 0.3));
    let first = at(1)[0];
    assert!(at(1).iter().all(|mu| *mu == first && *mu != 0.3));
    // What stopped a series counts beyond: its share is that of all series that have stopped so far.
    let table = String::from_utf8(bytes(&out, "statistics.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    let column = |name: &str| {
        let k = rows[0]
            .iter()
            .position(|h| *h == name)
            .unwrap_or_else(|| panic!("{name}: {:?}", rows[0]));
        rows[1..].iter().map(|r| r[k].parse::<f64>().unwrap()).collect::<Vec<_>>()
    };
    let (runs, left) = (column("runs"), column("left_out"));
    assert!(runs.iter().zip(&left).all(|(r, l)| r + l == 6.0), "{table}");
    let stopped = |a: f64| {
        let met = results.records.iter().filter(|r| r.value(0).is_some_and(|x| x > 0.02));
        let at = |r: &Row<'_>| r.number(&study.varied, &study.columns, "a");
        met.filter(|r| at(r).is_some_and(|x| x <= a)).count() as f64 / 6.0
    };
    assert_eq!(column("stops_probability"), [1.0, 2.0, 4.0, 8.0].map(stopped));
    assert!(left[2] > 0.0 && stopped(4.0) < 1.0, "{table}");
    // Each record is a nominal case of its own, as long as it is run.
    assert_eq!(column("cases"), [2.0, 2.0, 2.0, 1.0]);
    // Going on from half of the journal leaves out the same runs.
    let journal = bytes(&out, "runs.journal");
    let again = folder.path().join("again");
    std::fs::create_dir(&again).unwrap();
    std::fs::write(again.join("runs.journal"), &journal[..journal.len() / 2]).unwrap();
    run(&study, &again, 1).unwrap();
    for name in ["table.csv", "statistics.csv", "study.html"] {
        assert_eq!(bytes(&again, name), bytes(&out, name), "{name}");
    }
}

#[test]
fn runs_that_fail_among_others_are_rows_and_the_study_goes_on() {
    let folder = folder();
    // −1: the model refuses it. An energy limit of nothing at all: the run loses too much.
    let body = r#"points: [
        { "mu": 0.3, "limit": 0.5 }, { "mu": 0.2, "limit": 1e-300 }, { "mu": 0.1, "limit": 0.5 },
    ]"#;
    let study = read(folder.path(), body).unwrap();
    let out = folder.path().join("out");
    let results = run(&study, &out, 2).unwrap();
    let status: Vec<_> = results.records.iter().map(Row::status).collect();
    assert_eq!(status, ["converged", "energy error", "converged"]);
    assert_eq!(results.failed(), 1);
    let failed = results.records.get(1).unwrap();
    assert!(failed.values().all(|value| value.is_none()));
    assert!(failed.message().contains("unaccounted"));
    let html = String::from_utf8(bytes(&out, "study.html")).unwrap();
    assert!(html.contains("Runs that failed"));
    let random =
        r#"seed: 2, samples: Random(count: 12, of: { "mu": Normal(mean: 0.1, deviation: 0.2) })"#;
    let study = read(folder.path(), random).unwrap();
    let results = run(&study, &folder.path().join("random"), 2).unwrap();
    let refused: Vec<_> = results.records.iter().filter(|r| r.status() == "model error").collect();
    assert!(!refused.is_empty() && refused.len() < 12);
    assert!(refused[0].message().contains("must be ≥ 0"), "{}", refused[0].message());
}

#[test]
fn two_at_once_and_folders_of_others_are_refused() {
    let folder = folder();
    let out = folder.path().join("out");
    let study = read(folder.path(), GRID).unwrap();
    let second = Mutex::new(None);
    let first_call = AtomicUsize::new(0);
    let on_first = |_| {
        if first_call.fetch_add(1, Ordering::Relaxed) == 0 {
            *second.lock().unwrap() = Some(run(&study, &out, 1).unwrap_err());
        }
    };
    let never = AtomicBool::new(false);
    execute(&study, &trilith::registry(), &out, How::threads(1), &on_first, &never).unwrap();
    assert!(matches!(second.into_inner().unwrap(), Some(StudyError::Locked { .. })));
    // Figures may change, runs may not.
    let figures = format!("{GRID} figures: [Points(x: \"a\", y: \"slide\")]");
    let results = run(&read(folder.path(), &figures).unwrap(), &out, 1).unwrap();
    assert_eq!(results.resumed, 24);
    let refused =
        |body: &str| run(&read(folder.path(), body).unwrap(), &out, 1).unwrap_err().to_string();
    assert!(refused(&GRID.replace("0.3", "0.31")).contains("the runs of the study changed"));
    std::fs::write(folder.path().join("quiet.csv"), "0,0\n1,0.1\n").unwrap();
    assert!(
        refused(GRID).contains("a ground motion, or another file that the model names, changed")
    );
    std::fs::write(folder.path().join("mass.ron"), MODEL.replace("10 ms", "5 ms")).unwrap();
    assert!(refused(GRID).contains("the model"));
}

#[test]
fn histories_are_kept_of_the_runs_asked_for() {
    let folder = folder();
    let body = r#"axes: { "a": ["1 m/s^2", "8 m/s^2"] }, histories: Above("peak_slide", "1 mm")"#;
    let out = folder.path().join("out");
    run(&read(folder.path(), body).unwrap(), &out, 2).unwrap();
    assert!(!out.join("runs/000001").exists());
    assert!(out.join("runs/000002/histories.csv").is_file());
}

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let folder = folder();
    let study = read(folder.path(), GRID).unwrap();
    let file = folder.path().join("mass.ron");
    let error = run(&study, &file.join("out"), 1).unwrap_err().to_string();
    assert!(error.contains("mass.ron") && error.contains("cannot be written"), "{error}");
}

/// (text of the study, parts of the error).
const WRONG: &[(&str, &[&str])] = &[
    (r#"axes: { "muu": [0.1] }"#, &["no parameter `muu`", "did you mean `mu`?", "study.ron:1:"]),
    (r#"axes: { "mu": [] }"#, &["the axis `mu` has no values"]),
    (r#"axes: { "mu": [0.1, -0.2] }"#, &["must be ≥ 0"]),
    (r#"axes: { "mu": [0.1, "2 m"] }"#, &["`mu` is set to a value in m"]),
    (r#"axes: {}"#, &["`axes` names no parameter", "study.ron:1:"]),
    (r#"axes: { "mu": [0.1, inf] }"#, &["a finite number", "not the number inf"]),
    (
        r#"axes: { "record": ["quiet.csv", "none.csv"] }"#,
        &["study.ron:1:", "none.csv cannot be read", "met at", "mass.ron:"],
    ),
    (r#"axes: { "mu": Range(from: 0.1, to: 0.9) }"#, &["has no `count`"]),
    (r#"axes: { "mu": Range(from: 0, to: 1, step: 0.3) }"#, &["no whole number of steps"]),
    (r#"axes: { "mu": Log(from: 0, to: 1, count: 3) }"#, &["must be above 0"]),
    (r#"axes: { "mu": Range(from: 0, to: "1 m", count: 3) }"#, &["`to` is in m"]),
    (r#"axes: { "mu": Grid(1) }"#, &["no axis `Grid`", "`Range`"]),
    (r#"axs: {}"#, &["no field `axs`", "did you mean `axes`?"]),
    (r#"set: { "mu": 0.1 }, axes: { "mu": [0.1] }"#, &["`set` and `axes` both set `mu`"]),
    (r#"set: { "nu": 0.1 }"#, &["no parameter `nu`", "did you mean `mu`?"]),
    (r#"points: [{ "mu": 0.1 }, { "a": 1 }]"#, &["same parameters as the first"]),
    (r#"case: "gravity""#, &["static"]),
    (r#"case: "shak""#, &["did you mean `shake`?"]),
    (r#"columns: { "x": Peak("slid") }"#, &["no output `slid`", "did you mean `slide`?"]),
    (r#"columns: { "x": "slid*2" }"#, &["no parameter `slid`"]),
    (r#"columns: { "x": "a + mu" }"#, &["cannot be added"]),
    (r#"columns: { "mu": Peak("slide") }"#, &["the model has a parameter `mu`"]),
    (r#"columns: { "x": Duration(output: "slide", above: "1 s") }"#, &["must be a value in m"]),
    (r#"histories: Above("slide", 1)"#, &["no column `slide`", "`peak_slide`"]),
    (r#"histories: Abov("slide", 1)"#, &["did you mean `Above`?"]),
    (r#"stop: (along: "mu", when: Overturned)"#, &["no axis `mu`"]),
    (r#"samples: Random(count: 0, of: { "mu": Uniform(from: 0, to: 1) })"#, &["1 or more"]),
    (
        r#"samples: Random(count: 5, of: { "mu": Uniform(from: 1, to: 0) })"#,
        &["`from` must be below `to`"],
    ),
    (r#"samples: Random(count: 5, of: { "mu": Norml(mean: 1) })"#, &["did you mean `Normal`?"]),
    (r#"samples: Random(count: 5, of: {})"#, &["names no parameter"]),
    (
        r#"ensemble: (members: 5, of: { "mue": 0.1 })"#,
        &["no parameter `mue`", "did you mean `mu`?"],
    ),
    (r#"ensemble: (members: 5, of: { "record": 0.1 })"#, &["`record` is a text"]),
    (r#"figures: [Points(x: "mu", y: "peak_slide")]"#, &["no column or varied parameter `mu`"]),
    (
        r#"figures: [Hazard(demand: "peak_slide", intensity: "peak_slide", rates: [(1, 2), (2, 3)])]"#,
        &["must rise"],
    ),
    (r#"solver: "fnaa""#, &["did you mean `fna`?"]),
    (
        r#"axes: { "mu": Range(from: 0, to: 1, count: 100000), "a": Range(from: 1, to: 2, count: 100000) }"#,
        &["more than 100000000 runs"],
    ),
];

#[test]
fn wrong_studies_say_where_and_what_would_be_right() {
    let folder = folder();
    for (body, parts) in WRONG {
        let errors = match read(folder.path(), body) {
            Ok(_) => panic!("{body} was taken"),
            Err(errors) => errors,
        };
        let text: String = errors.iter().map(|d| format!("{d}\n")).collect();
        for part in *parts {
            assert!(text.contains(part), "{body}: `{part}` in\n{text}");
        }
    }
}

#[test]
fn all_errors_of_a_study_are_told_at_once() {
    let folder = folder();
    let body = r#"axes: { "muu": [0.1], "a": [] }, seed: -1, columns: { "x": Peak("slid") }"#;
    let errors = read(folder.path(), body).unwrap_err();
    assert!(errors.len() >= 3, "{errors:?}");
    // One wrong value is one error.
    let errors = read(folder.path(), r#"axes: { "mu": [0.1, inf] }"#).unwrap_err();
    assert_eq!(errors.len(), 1, "{errors:?}");
    let missing = Study::read_text("(axes: {})", "s.ron", &trilith::registry(), &[]).unwrap_err();
    assert!(missing[0].message.contains("has no `model`"));
    let none =
        Study::read_text("(model: \"none.ron\")", "s.ron", &trilith::registry(), &[]).unwrap_err();
    assert!(none[0].message.contains("none.ron cannot be read"));
}

/// Repetition may make other outputs for another value: what a study keeps of every run must be there in every run.
#[test]
fn outputs_that_hang_on_a_varied_parameter_are_refused() {
    let folder = folder();
    let path = folder.path().join("mass.ron");
    let with = |of: &str| {
        let model = MODEL.replace("outputs: {", &format!("outputs: {{ \"copy {{i}}\": {of},"));
        std::fs::write(&path, model.replace("parameters: {", "parameters: { \"copies\": 1,"))
            .unwrap();
        read(folder.path(), r#"axes: { "copies": [1, 2] }"#)
    };
    let slide =
        |range: &str| format!("For(i: \"1 to {range}\", of: LinkForce(link: \"foot\", axis: U1))");
    let errors = with(&slide("copies")).unwrap_err();
    let [e] = errors.as_slice() else { panic!("{errors:?}") };
    assert!(e.message.contains("other outputs than in the first run"), "{e}");
    assert_eq!(&e.source.text[e.span.clone()], "2");
    assert!(with(&slide("2")).is_ok());
}

/// A combination at every point has the extremes that `trilith combine` tells there.
#[test]
fn a_combination_takes_the_place_of_a_case() {
    let folder = folder();
    let cases = r#"
        "push": Static(after: "gravity", loads: ["push"]),
        "shake": "#;
    let model = MODEL
        .replace("\"shake\": ", cases)
        .replace(
            "functions: {",
            "loads: { \"push\": [(node: \"cg\", dof: Ux, force: \"1 kN\")] },\n    functions: {",
        )
        .replace(
            "outputs: {",
            r#"combinations: {
        "sum": LinearAdd(cases: { "push": 2, "shake": 1 }),
        "twice": LinearAdd(cases: ["gravity", "push"]),
    },
    outputs: { "weight": LinkForce(link: "foot", axis: U1, hidden: true),"#,
        );
    std::fs::write(folder.path().join("mass.ron"), &model).unwrap();
    let body = |more: &str| {
        format!(
            r#"set: {{ "k": "1 MN/m" }}, axes: {{ "a": ["1 m/s^2", "4 m/s^2", "8 m/s^2"] }}, combination: "sum",
            columns: {{ "most": Max("slide"), "least": Min("slide"), "peak": Peak("slide"), "share": "peak/(most - least)" }},
            {more}"#
        )
    };
    let study = read(folder.path(), &body(r#"figures: [Points(x: "a", y: "peak")],"#)).unwrap();
    let registry = trilith::registry();
    assert_eq!(study.alone(&registry).as_deref(), Some("a combination runs several cases"));
    let store = folder.path().join("store");
    let made = |out: &str, threads: usize| {
        let how = How { store: Some(&store), ..How::threads(threads) };
        let (out, stop) = (folder.path().join(out), AtomicBool::new(false));
        let results = execute(&study, &registry, &out, how, &|_| {}, &stop).unwrap();
        (results, bytes(&out, "table.csv"), bytes(&out, "study.html"))
    };
    let (first, table, page) = made("one", 1);
    let (again, other, _) = made("two", 2);
    assert_eq!((first.failed(), first.reused, again.reused), (0, 0, 3));
    assert_eq!(table, other);
    let page = String::from_utf8(page).unwrap();
    assert!(page.contains("trilith combine ") && page.contains("mass.ron --of sum"), "{page}");
    for (record, a) in first.records.iter().zip(["1 m/s^2", "4 m/s^2", "8 m/s^2"]) {
        let set = [("k", "1 MN/m"), ("a", a)].map(|(n, v)| (n.to_owned(), v.to_owned()));
        let path = folder.path().join("mass.ron");
        let model = trilith::read_text(&model, path, &registry, &set).unwrap();
        let found = trilith::combine::combine(&model, &["sum".into()]).unwrap();
        let own = &found.combinations[0].outputs[0];
        let peak = own.max.abs().max(own.min.abs());
        let expected = [own.max, own.min, peak, peak / (own.max - own.min)].map(Some);
        assert_eq!(record.values().collect::<Vec<_>>(), expected, "{a}");
        assert!(record.warnings().is_empty(), "{:?}", record.warnings());
        // Twice the push, and what the shaking adds.
        assert!(own.max > 1.9e-4, "{own:?}");
    }
    let twice = body("").replace("\"sum\"", "\"twice\"");
    let results = run(&read(folder.path(), &twice).unwrap(), &folder.path().join("twice"), 1);
    let results = results.unwrap();
    let warned = results.records.get(0).unwrap().warnings();
    assert!(warned[0].contains("it adds \"gravity\" and \"push\""), "{warned:?}");
    for (more, part) in [
        (r#"case: "shake","#, "`case` runs a case and no combination"),
        (r#"solver: "hht","#, "`solver` is that of one case"),
        (r#"histories: All,"#, "`histories` are those of one case"),
        (r#"events: { "falls": Overturned },"#, "nobody knows how bodies respond"),
        (
            r#"figures: [Overturning(frequency: "a", amplitude: "a")],"#,
            "`Overturning` shows how bodies",
        ),
    ] {
        let errors = read(folder.path(), &body(more)).unwrap_err();
        assert!(errors[0].message.contains(part), "{more}: {errors:?}");
    }
    for (column, part) in [
        ("Final(\"slide\")", "column `most` is known of one case"),
        ("EnergyError", "column `most` is known of one case"),
        ("Max(\"weight\")", "output \"weight\" is hidden"),
    ] {
        let errors = read(folder.path(), &body("").replace("Max(\"slide\")", column)).unwrap_err();
        assert!(errors.iter().any(|e| e.message.contains(part)), "{column}: {errors:?}");
    }
    let unknown = body("").replace("\"sum\"", "\"som\"");
    let errors = read(folder.path(), &unknown).unwrap_err();
    assert!(errors[0].to_string().contains("did you mean `sum`?"), "{errors:?}");
    std::fs::write(folder.path().join("mass.ron"), MODEL).unwrap();
    let errors = read(folder.path(), &body("")).unwrap_err();
    assert!(errors[0].message.contains("the model has no combination"), "{errors:?}");
}

/// A file that is no model keeps what it holds for itself; one with an error in it is shown where it is.
#[test]
fn what_a_file_that_is_no_model_holds_is_not_told() {
    let folder = folder();
    for text in ["root:x:0:0:secret\n", "(secret: 1)", "# secret\n(nodes: {})", "secret"] {
        std::fs::write(folder.path().join("mass.ron"), text).unwrap();
        let errors = read(folder.path(), GRID).unwrap_err();
        let [e] = errors.as_slice() else { panic!("{errors:?}") };
        assert!(e.message.ends_with("mass.ron is no model: it has no `nodes`"), "{e}");
        assert!(!e.source.text.contains("secret") && e.source.path.ends_with("study.ron"), "{e}");
        let all = format!("{e:?}");
        assert!(!all.contains("secret"), "{all}");
    }
    std::fs::write(folder.path().join("mass.ron"), MODEL.replace("plane: XZ", "plain: XZ"))
        .unwrap();
    let errors = read(folder.path(), GRID).unwrap_err();
    assert!(errors[0].source.path.ends_with("mass.ron"), "{errors:?}");
}

/// What a run would say of its model stands in the table and is counted on the page, side by side and one by one.
#[test]
fn warnings_of_runs_reach_the_study() {
    let folder = folder();
    let path = folder.path().join("mass.ron");
    std::fs::write(&path, MODEL.replace("after: \"gravity\", ", "")).unwrap();
    let told = |body: &str, out: &str| {
        let study = read(folder.path(), body).unwrap();
        let results = run(&study, &folder.path().join(out), 1).unwrap();
        let out = folder.path().join(out);
        let [table, page] = ["table.csv", "study.html"].map(|n| bytes(&out, n));
        let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
        (results, text(table), text(page))
    };
    let beside = r#"axes: { "a": ["1 m/s^2", "2 m/s^2"] },"#;
    let alone = format!("{beside} columns: {{ \"slide\": Peak(\"slide\") }}, {ALONE}");
    for (body, lanes) in [(beside, 2), (&alone, 0)] {
        let (results, table, page) = told(body, &format!("weightless {lanes}"));
        assert_eq!((results.beside, results.failed(), results.warned()), (lanes, 0, 2));
        for text in [&table, &page] {
            assert!(text.matches("1000 kg have no weight").count() >= 2, "{text}");
        }
        assert!(page.contains("2 of them warned of something"), "{page}");
    }
    std::fs::write(&path, MODEL).unwrap();
    let (results, table, page) = told(beside, "heavy");
    assert!(results.warned() == 0 && !table.contains("check") && !page.contains("warned"));
}

/// Contacts that are far too soft, side by side: where such a lane ends, the run is made alone, and says why.
#[test]
fn a_body_that_sinks_in_is_told_of_runs_side_by_side() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let text = "(model: \"../rigid_block.ron\", axes: { \"kn\": [500, 5e8] }, set: { \"duration\": \"0.5 s\" })";
    let study =
        Study::read_text(text, root.join("models/studies/kn.ron"), &trilith::registry(), &[]);
    let folder = tempfile::tempdir().unwrap();
    let results = run(&study.unwrap(), &folder.path().join("out"), 1).unwrap();
    assert_eq!((results.beside, results.warned()), (1, 1));
    let warned = results.records.get(0).unwrap().warnings();
    let [one] = warned else { panic!("{warned:?}") };
    assert!(one.contains("was pressed in by 98.1 m, 4910 % of the size"), "{one}");
}

/// Runs that are finished are kept and not made again. Side by side, those that go on in their lanes come to their ends.
#[test]
fn an_interrupted_study_goes_on() {
    for (body, most) in [(&format!("{GRID} {ALONE}"), 5), (&GRID.to_owned(), 12)] {
        let folder = folder();
        let out = folder.path().join("out");
        let study = read(folder.path(), body).unwrap();
        let stop = AtomicBool::new(false);
        let at_the_fifth = |p: trilith_study::Progress| stop.store(p.done >= 5, Ordering::Relaxed);
        let how = How::threads(1);
        let error =
            execute(&study, &trilith::registry(), &out, how, &at_the_fifth, &stop).unwrap_err();
        let StudyError::Interrupted { done, total, .. } = error else { panic!("{error}") };
        assert_eq!(total, 24);
        assert!((5..=most).contains(&done), "{done}");
        let results = run(&study, &out, 1).unwrap();
        assert_eq!((results.resumed, results.records.len()), (done, 24));
    }
}
