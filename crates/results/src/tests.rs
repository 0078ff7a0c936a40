//! A made-up run, written and read back.

use crate::{ENERGIES, Envelope, Files, Recorder, Summary};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::collections::BTreeSet;
use std::io::Read;
use trilith_model::{Model, Registry, read_text};
use trilith_solvers::{EnergyTotals, Observer, Sample, Shape};

const TEXT: &str = r#"(
    title: "Mass on a spring",
    plane: XZ,
    nodes: { "top": (0, 0, 1), "ground": (0, 0, 0), "side": (1, 0, 1) },
    supports: { "ground": Fixed },
    elements: {
        "mass": Mass(node: "top", mass: "1 kg"),
        "spring": Spring(nodes: ("ground", "top"), k1: "1 kN/m", k2: "1 kN/m"),
        "bar": RigidLink(nodes: ("top", "side")),
    },
    cases: { "shake": Dynamic(duration: 1, dt: 0.1) },
    outputs: { "up": Displacement(node: "top", dof: Uz), "a, b": Velocity(node: "top", dof: Ux) },
)"#;

fn model() -> Model {
    let mut registry = Registry::new();
    trilith_elements::register(&mut registry);
    read_text(TEXT, "spring.ron", &registry, &[]).unwrap_or_else(|e| panic!("{e:?}"))
}

struct Lifted(f64);

impl Shape for Lifted {
    fn pose(&self) -> Vec<f64> {
        vec![self.0]
    }

    fn displacements(&self, poses: &[Vec<f64>], u: &mut [f64]) {
        let nodes = u.len() / 6 / poses.len();
        u.chunks_mut(6).enumerate().for_each(|(i, node)| node[2] = poses[i / nodes][0]);
    }
}

/// Two substeps per output step; the output jumps up between output times.
fn record(model: &Model) -> Recorder {
    shown(Recorder::new(model).with_frames(model, 5))
}

fn shown<T: Observer>(mut recorder: T) -> T {
    recorder.start(10);
    for i in 0..=20 {
        let t = 0.05 * f64::from(i);
        let energy = EnergyTotals { input: t, ..EnergyTotals::default() };
        let sample = Sample {
            t,
            output_step: (i % 2 == 0).then_some(i as usize / 2),
            values: &[if i == 7 { 9.0 } else { t / 3.0 }, 1e-300 * t],
            rates: &[f64::NAN; 2],
            energy: &energy,
            contacts: &[],
            overturned: None,
            deformation: &[t],
            force: &[2.0 * t],
            base_shear: [f64::NAN; 2],
            shape: &Lifted(t),
        };
        recorder.sample(&sample);
        if i == 20 {
            recorder.end(&sample);
        }
    }
    recorder
}

fn summary(model: &Model, record: &Recorder) -> Summary {
    // A result cannot be made up outside the solvers: its parts are.
    Summary {
        version: "0",
        build: "b",
        run_sha256: "00".into(),
        model: crate::ModelSummary { title: model.title.clone(), sha256: "00".into() },
        parameters: crate::Named(vec![]),
        case: "shake".into(),
        solver: "fna",
        status: "converged",
        message: "converged".into(),
        work: Default::default(),
        outputs: crate::Named(
            model
                .outputs
                .iter()
                .zip(record.peaks())
                .map(|(o, p)| {
                    let output =
                        crate::OutputSummary { unit: o.unit.clone(), peak: Some(*p), error: None };
                    (o.name.clone(), output)
                })
                .collect(),
        ),
        energy: EnergyTotals::default(),
        link_energy: crate::Named(vec![("foot".into(), Default::default())]),
        contact: None,
        stops: None,
        bearings: None,
        base_shear: None,
        drift: None,
        basis: None,
        envelopes: crate::Named(Vec::new()),
        spectra: crate::Named(crate::spectra::all(model, record)),
        warnings: vec![],
    }
}

#[test]
fn peaks_are_those_of_all_substeps() {
    let model = model();
    let record = record(&model);
    let peak = record.peaks()[0];
    assert_eq!((peak.max, peak.min, peak.t_min), (9.0, 0.0, 0.0));
    assert!((peak.t_max - 0.35).abs() < 1e-12);
    assert_eq!((record.time().len(), record.history(0).unwrap().len()), (11, 11));
    assert!(record.history(0).unwrap().iter().all(|y| *y < 1.0));
}

#[test]
fn without_histories_the_peaks_are_the_same() {
    let model = model();
    let (whole, bare) = (record(&model), shown(Recorder::new(&model).without_histories()));
    assert_eq!(bare.peaks(), whole.peaks());
    assert_eq!(shown(Envelope::new()).peaks(), whole.peaks());
    assert!(bare.time().is_empty() && bare.history(0).is_some_and(<[f64]>::is_empty));
    assert!(bare.energy().iter().all(Vec::is_empty));
}

#[test]
fn the_summary_has_the_documented_keys() {
    let model = model();
    let json = serde_json::to_value(summary(&model, &record(&model))).unwrap();
    let keys = |v: &serde_json::Value| -> BTreeSet<String> {
        v.as_object().unwrap().keys().cloned().collect()
    };
    let has = |v: &serde_json::Value, names: &[&str]| {
        let keys = keys(v);
        assert!(names.iter().all(|n| keys.contains(*n)), "{names:?} in {keys:?}");
    };
    has(&json, &["model", "case", "solver", "status", "work", "outputs", "energy", "contact"]);
    has(&json, &["message", "warnings", "basis", "link_energy", "version", "build"]);
    has(&json, &["run_sha256", "parameters"]);
    has(&json["model"], &["title", "sha256"]);
    has(&json["work"], &["steps", "substeps", "iterations", "rejected", "factorizations"]);
    has(&json["work"], &["wall_s", "setup_cpu_s", "march_cpu_s", "peak_rss_mb"]);
    has(&json["outputs"], &["up", "a, b"]);
    has(&json["outputs"]["up"], &["unit", "max", "t_max", "min", "t_min", "final"]);
    has(&json["energy"], &ENERGIES[..9]);
    has(&json["energy"], &["error_relative", "start"]);
    has(&json["energy"]["start"], &["kinetic", "strain", "link_stored"]);
    has(&json["link_energy"]["foot"], &["stored", "hysteretic", "viscous"]);
    assert!(json["contact"].is_null());
}

#[test]
fn the_csv_reads_back_to_the_same_numbers() {
    let (model, folder) = (model(), tempfile::tempdir().unwrap());
    let record = record(&model);
    Files { model: &model, record: &record, summary: &summary(&model, &record) }
        .write(folder.path())
        .unwrap();
    let mut file = csv::Reader::from_path(folder.path().join("histories.csv")).unwrap();
    let header: Vec<String> = file.headers().unwrap().iter().map(str::to_owned).collect();
    assert_eq!(header[..4], ["t [s]", "up [m]", "a, b [m/s]", "energy input [J]"]);
    let rows: Vec<Vec<f64>> =
        file.records().map(|r| r.unwrap().iter().map(|x| x.parse().unwrap()).collect()).collect();
    for (i, row) in rows.iter().enumerate() {
        let column = |c: usize| record.history(c).unwrap()[i];
        assert_eq!(row[..4], [record.time()[i], column(0), column(1), record.energy()[0][i]]);
    }
    assert_eq!(rows.len(), 11);
}

/// Names that a spreadsheet would take for formulas.
#[test]
fn names_in_csv_files_are_no_formulas() {
    let text = TEXT.replace("\"up\":", "\"=up\":").replace("\"a, b\":", "\"-a, b\":");
    let mut registry = Registry::new();
    trilith_elements::register(&mut registry);
    let model = read_text(&text, "x.ron", &registry, &[]).unwrap_or_else(|e| panic!("{e:?}"));
    let (record, folder) = (record(&model), tempfile::tempdir().unwrap());
    Files { model: &model, record: &record, summary: &summary(&model, &record) }
        .write(folder.path())
        .unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("histories.csv").starts_with("t [s],'=up [m],\"'-a, b [m/s]\",energy"));
    let peaks = read("peaks.csv");
    let begins: Vec<&str> = peaks.lines().skip(1).map(|l| &l[..4]).collect();
    assert_eq!(begins, ["'=up", "\"'-a"], "{peaks}");
}

#[test]
fn the_npz_holds_one_array_per_history() {
    let (model, folder) = (model(), tempfile::tempdir().unwrap());
    let record = record(&model);
    let path = folder.path().join("h.npz");
    crate::npz::write(&path, &model, &record).unwrap();
    let mut zip = zip::ZipArchive::new(std::fs::File::open(path).unwrap()).unwrap();
    assert_eq!(zip.len(), 1 + ENERGIES.len() + 2);
    for (name, values) in [("t", record.time()), ("a__b", record.history(1).unwrap())] {
        let mut bytes = Vec::new();
        zip.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
        assert_eq!(bytes, crate::npy(values));
    }
}

#[test]
fn frames_show_nodes_members_and_constraints() {
    let (model, folder) = (model(), tempfile::tempdir().unwrap());
    let path = folder.path().join("model.pvd");
    crate::vtk::write(&path, &model, record(&model).frames()).unwrap();
    let index = std::fs::read_to_string(path).unwrap();
    let count = index.matches("<DataSet").count();
    assert!((2..=5).contains(&count), "{index}");
    let path = folder.path().join(format!("frames/{:04}.vtu", count - 1));
    let frame = std::fs::read_to_string(&path).unwrap();
    assert!(frame.contains("NumberOfPoints=\"3\" NumberOfCells=\"5\""), "{frame}");
    let bytes = |name: &str| {
        let at = frame.find(&format!("Name=\"{name}\"")).unwrap();
        let bytes = STANDARD.decode(frame[at..].lines().nth(1).unwrap()).unwrap();
        assert_eq!(bytes[..8], (bytes.len() as u64 - 8).to_le_bytes());
        bytes[8..].to_vec()
    };
    let integers = |name: &str| -> Vec<i32> {
        bytes(name).chunks(4).map(|b| i32::from_le_bytes(b.try_into().unwrap())).collect()
    };
    // Three nodes, the spring's line and the rigid link's.
    assert_eq!(integers("connectivity"), [0, 1, 2, 0, 2, 1, 0]);
    assert_eq!(integers("offsets"), [1, 2, 3, 5, 7]);
    assert_eq!(bytes("types"), [1, 1, 1, 3, 3]);
    assert_eq!(bytes("points").len(), 3 * 3 * 8);
    let moved: Vec<f32> = bytes("displacement")
        .chunks(4)
        .map(|b| f32::from_le_bytes(b.try_into().unwrap()))
        .collect();
    assert_eq!(moved, [0.0, 0.0, 1.0].repeat(3));
    assert_eq!(bytes("rotation"), [0; 3 * 3 * 4]);
    // Of a run with fewer nothing of these is left.
    crate::vtk::clear(folder.path()).unwrap();
    assert!(!path.exists());
}

#[test]
fn an_error_of_writing_names_the_file() {
    let (model, folder) = (model(), tempfile::tempdir().unwrap());
    let record = record(&model);
    std::fs::create_dir(folder.path().join("histories.csv")).unwrap();
    let error = Files { model: &model, record: &record, summary: &summary(&model, &record) }
        .write(folder.path())
        .unwrap_err();
    assert!(error.to_string().contains("histories.csv cannot be written"), "{error}");
}

#[test]
fn peaks_csv_reads_back_to_the_same_bits() {
    let model = model();
    let record = record(&model);
    let summary = summary(&model, &record);
    let folder = tempfile::tempdir().unwrap();
    Files { model: &model, record: &record, summary: &summary }.write(folder.path()).unwrap();
    let mut file = csv::Reader::from_path(folder.path().join("peaks.csv")).unwrap();
    let rows: Vec<csv::StringRecord> = file.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), model.outputs.len());
    for ((row, o), p) in rows.iter().zip(&model.outputs).zip(record.peaks()) {
        assert_eq!((&row[0], &row[1]), (o.name.as_str(), o.unit.as_str()));
        let numbers: Vec<f64> = row.iter().skip(2).map(|x| x.parse().unwrap()).collect();
        assert_eq!(numbers, [p.max, p.t_max, p.min, p.t_min, p.last]);
    }
}

#[test]
fn motions_of_one_direction_add_up_and_each_has_its_spectrum() {
    // A half sine and a constant along X, a mirrored half sine along Z.
    let cases = r#"functions: {
            "pulse": HalfSine(amplitude: "3 m/s^2", duration: 0.5, start: 0.2),
            "push": Step(amplitude: "1 m/s^2", start: 0.1, end: 1.1),
        },
        cases: { "still": Dynamic(duration: 1, dt: 0.1), "shake": Dynamic(duration: 2, dt: 0.01, base: [
            (direction: X, function: "pulse"), (direction: X, function: "push"),
            (direction: Z, function: "pulse", factor: -2),
        ]) },"#;
    let text = TEXT.replace(r#"cases: { "shake": Dynamic(duration: 1, dt: 0.1) },"#, cases);
    let mut registry = Registry::new();
    trilith_elements::register(&mut registry);
    let model = read_text(&text, "x.ron", &registry, &[]).unwrap_or_else(|e| panic!("{e:?}"));
    assert!(crate::ground_motions(&model, 0, 0.1).is_empty());
    assert!(crate::ground_motions(&model, 9, 0.1).is_empty());
    let all = crate::ground_motions(&model, 1, 0.01);
    let of = |i: usize| (all[i].direction.name(), all[i].peak.0, all[i].peak.1);
    assert_eq!(all.len(), 2);
    for (i, name, peak) in [(0, "Ux", 4.0), (1, "Uz", -6.0)] {
        let found = of(i);
        assert_eq!(found.0, name);
        assert!((found.1 - peak).abs() < 1e-12 && (found.2 - 0.45).abs() < 1e-9, "{found:?}");
        // Sampled at 5 ms over the whole case.
        assert_eq!((all[i].time.len(), all[i].acceleration.len()), (401, 401));
    }
    // An undamped oscillator of the period of the pulse answers a half sine with 1.73 times its peak (Chopra, Dynamics
    // of Structures, fig. 4.8.2); 5 % of damping takes a few per cent, and a stiff one follows the ground.
    let z = &all[1];
    let at = |period: f64| {
        let i = z.periods.iter().position(|p| *p >= period).unwrap();
        z.psa[i] / 6.0
    };
    assert!((at(0.02) - 1.0).abs() < 0.01, "{}", at(0.02));
    assert!((1.55..1.73).contains(&at(0.5)), "{}", at(0.5));
    assert_eq!(crate::GROUND_DAMPING, 0.05);
}
