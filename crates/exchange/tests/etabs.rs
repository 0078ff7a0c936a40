//! Text models of ETABS: a building against the same one by hand, and against closed forms.

mod common;

use common::{close, last, model, run};
use std::path::{Path, PathBuf};
use trilith::{Analysis, Model};
use trilith_exchange::{Fate, Import, Options, etabs};

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/etabs").join(name)
}

fn import(name: &str) -> Import {
    read(&std::fs::read_to_string(file(name)).unwrap())
}

fn read(text: &str) -> Import {
    let options = Options { path: "links.e2k".into(), ..Options::default() };
    etabs::import(text.as_bytes(), &options).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn by_hand(set: &[(&str, &str)]) -> Model {
    let path = file("building.ron");
    let text = std::fs::read_to_string(&path).unwrap();
    let set: Vec<_> = set.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
    let read = trilith::read_text(&text, path, &trilith::registry(), &set);
    read.unwrap_or_else(|all| {
        panic!("{}", all.iter().map(|e| format!("{e}\n")).collect::<String>())
    })
}

fn periods(model: &Model) -> Vec<f64> {
    let modes = Analysis::new(model).and_then(|a| a.modes(None)).unwrap();
    modes.omega.iter().map(|w| std::f64::consts::TAU / w).collect()
}

/// All within a share of the largest of them.
fn alike(got: &[f64], wanted: &[f64], share: f64, what: &str) {
    let size = wanted.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    for (i, (a, b)) in got.iter().zip(wanted).enumerate() {
        assert!((a - b).abs() <= share * size, "{what} {i}: {a} is not {b}\n{got:?}\n{wanted:?}");
    }
    assert_eq!(got.len(), wanted.len());
}

/// What two loads between joints, whose shares at both ends the file by hand leaves open, press with at one of them: by the
/// shapes of a beam with shear that is held at both ends.
fn shares() -> [String; 2] {
    let (young, shear) = (2.1e8, 2.1e8 / 2.6 * 0.5 * 0.0102);
    let inertia = (0.2 * 0.5_f64.powi(3) - (0.2 - 0.0102) * (0.5 - 0.032_f64).powi(3)) / 12.0;
    let phi = |i: f64| 12.0 * young * i / (shear * 25.0);
    let far = |x: f64, phi: f64| (3.0 * x * x - 2.0 * x.powi(3) + phi * x) / (1.0 + phi);
    // 30 kN at 0.4 of the beam from 4 to 1.
    let point = 30.0 * far(0.4, phi(inertia));
    // From nothing at 1 m to 10 kN/m at 4 m of the beam from 2 to 3, of a larger moment.
    let n = 20_000;
    let step = 3.0 / f64::from(n);
    let triangle: f64 = (0..n)
        .map(|k| {
            let s = (f64::from(k) + 0.5) * step;
            10.0 * s / 3.0 * step * (1.0 - far((1.0 + s) / 5.0, phi(1.25 * inertia)))
        })
        .sum();
    [point, triangle].map(|x| format!("{x:e} kN"))
}

#[test]
fn a_building_has_the_periods_of_the_same_one_by_hand() {
    let import = import("building.e2k");
    let text = import.report.text();
    assert_eq!(import.report.losses(), 0, "{text}\n{}", import.draft.to_ron());
    let [b1, t2] = shares();
    let hand = by_hand(&[("b1", &b1), ("t2", &t2)]);
    let (got, wanted) = (periods(&model(&import)), periods(&hand));
    assert!(wanted.len() >= 6 && got.len() == wanted.len(), "{got:?} {wanted:?}");
    for (a, b) in got.iter().zip(&wanted) {
        close(*a, *b, 1e-6, "period");
    }
}

const JOINTS: [(&str, &str); 8] = [
    ("1@First", "1F"),
    ("2@First", "2F"),
    ("3@First", "3F"),
    ("4@First", "4F"),
    ("1@Roof", "1R"),
    ("2@Roof", "2R"),
    ("3@Roof", "3R"),
    ("4@Roof", "4R"),
];

#[test]
fn a_building_moves_under_its_loads_as_the_same_one_by_hand() {
    let import = import("building.e2k");
    let (imported, hand) = (model(&import), by_hand(&[("b1", "0 kN"), ("t2", "0 kN")]));
    // Joints that loads stand on, though they are nothing, have outputs.
    let named: Vec<&str> = import.draft.outputs.iter().map(|(name, _)| name.as_str()).collect();
    let mut outputs = Vec::new();
    for (theirs, ours) in JOINTS {
        for dof in ["Ux", "Uy", "Uz", "Rx", "Ry", "Rz"] {
            let (theirs, ours) = (format!("{theirs} {dof}"), format!("{ours} {dof}"));
            if named.contains(&theirs.as_str()) {
                outputs.push((theirs, ours));
            }
        }
    }
    assert!(outputs.len() >= 30, "{named:?}");
    let theirs: Vec<&str> = outputs.iter().map(|o| o.0.as_str()).collect();
    let ours: Vec<&str> = outputs.iter().map(|o| o.1.as_str()).collect();
    for case in ["Live", "Push"] {
        let (got, wanted) = (last(&imported, case, &theirs), last(&hand, case, &ours));
        alike(&got, &wanted, 1e-8, case);
    }
}

#[test]
fn what_is_said_of_the_building_counts() {
    let text = std::fs::read_to_string(file("building.e2k")).unwrap();
    let original = read(&text);
    let outputs = ["1@First Uz", "2@First Ux", "4@Roof Ux", "4@Roof Uy", "4@Roof Rz", "3@Roof Uy"];
    let answers = |import: &Import| {
        let model = model(import);
        let statics = ["Push", "Live", "Dead"].map(|case| last(&model, case, &outputs)).concat();
        [periods(&model)[..3].to_vec(), statics].concat()
    };
    let plain = answers(&original);
    for (from, to) in [
        ("RIGIDZONE 0.5", "RIGIDZONE 0.3"),
        ("ANG  90 ", "ANG  0 "),
        ("PROPMODI33 1.25", "PROPMODI33 1"),
        ("CARDINALPT 8", "CARDINALPT 2"),
        ("I2MOD 0.5", "I2MOD 0.6"),
        ("RELEASE \"PINNED\"", ""),
        ("RELEASE \"M2I M3I M2J M3J\"", "RELEASE \"M2I M2J\""),
        ("MASSUXUY 4", "MASSUXUY 3"),
        ("\"Live\"  0.3", "\"Live\"  0.2"),
        ("RDSTART 0.2", "RDSTART 0.3"),
        ("RDIST 0.4", "RDIST 0.5"),
        ("INCLUDEELEMENTS \"Yes\"", "INCLUDEELEMENTS \"No\""),
        ("SELFWEIGHT  1", "SELFWEIGHT  2"),
        ("DIAPH \"D1\"  OBJMESHTYPE", "OBJMESHTYPE"),
        ("  T 10", "  T 12"),
        ("\"C1\"  COLUMN  \"1\"  \"1\"  1\n", "\"C1\"  COLUMN  \"4\"  \"1\"  1\n"),
        ("E 3E+07  U 0.2", "E 3E+07  U 0.3"),
    ] {
        assert!(text.contains(from), "{from}");
        let other = answers(&read(&text.replacen(from, to, 1)));
        let moved = plain.iter().zip(&other).any(|(a, b)| (a - b).abs() > 1e-6 * a.abs());
        assert!(moved, "{to} for {from} changes nothing");
    }
}

#[test]
fn a_history_is_that_of_the_same_building_by_hand() {
    let import = import("building.e2k");
    let [b1, t2] = shares();
    let hand = by_hand(&[("b1", &b1), ("t2", &t2)]);
    let (theirs, ours) = (run(&model(&import), "Shake", None), run(&hand, "Shake", None));
    let (a, b) = (theirs.history("4@Roof Ux").unwrap(), ours.history("4R Ux").unwrap());
    assert!(b.iter().any(|x| x.abs() > 1e-4), "{b:?}");
    alike(a, b, 1e-6, "roof");
}

#[test]
fn links_become_those_of_the_same_law() {
    let import = import("links.e2k");
    let ron = import.draft.to_ron();
    for words in [
        "units: (length: \"cm\", force: \"tonf\")",
        "\"1@Top\": (0, 0, 100)",
        // Below its storey.
        "\"3@Top\": (90, 0, 60)",
        "\"link K1@Top\": RubberIsolator(nodes: (\"1@Base\", \"1@Top\"), use: ",
        "RubberIsolator(k2: 10, fy2: 5, ratio2: 0.2, kv: 3000)",
        "\"link K2@Top\": Gap(nodes: (\"1@Top\", \"2@Top\"), use: \"GAP\")",
        "\"GAP\": Gap(k: 2000, opening: 0.25)",
        "\"link K3@Top\": Spring(node: \"2@Top\", axis1: (0, 0, 1), axis2: (0, 1, 0), use: \"LIN\")",
        "\"LIN\": Spring(k1: 100, k2: 10, k3: 10, c1: 0.5)",
        "\"link PAD 3@Top\": FrictionPendulum(node: \"3@Top\", ",
        "FrictionPendulum(kn: 4000, damping: 2, pull: true, ks: 30, radius: 90, friction_model: Velocity, \
         mu_slow: 0.04, mu_fast: 0.06, rate: 1.1)",
        "\"spring 2@Top\": Spring(node: \"2@Top\", k1: 4, k2: 9, k3: 1000, r3: 50",
        // Half of the link's mass is in the ground.
        "\"mass 2@Top\": Mass(node: \"2@Top\", mass: 0.501)",
        "\"mass 3@Top\": Mass(node: \"3@Top\", masses: (0.5, 0.5, 0))",
        "after: \"Dead\"",
        "alpha: -0.1",
        "factor: \"100 cm/s^2\"",
    ] {
        assert!(ron.contains(words), "{words} in\n{ron}");
    }
    let lost: Vec<(&str, &str)> =
        import.report.lost.iter().map(|n| (n.place.as_str(), n.what.as_str())).collect();
    for wanted in [
        ("LINK PROPERTIES: TYPE", "a link of type High Damping Rubber Isolator has no counterpart"),
        ("LINK ASSIGNS", "a link with a property that is lost is not written"),
        ("LOAD PATTERNS: SEISMIC", "loads that the pattern makes by a code"),
        ("LOAD CASES: TYPE", "a case of type Response Spectrum has no counterpart"),
    ] {
        assert!(lost.contains(&wanted), "{wanted:?} in {lost:?}");
    }
    let table = import.report.tables.iter().find(|t| t.name == "NEW THINGS OF A LATER VERSION");
    assert_eq!(table.map(|t| &t.fate), Some(&Fate::Lost("an unknown section".into())));
    // Five percent at periods of 1 s and 0.1 s: a = 2 ζ ω₁ ω₂ / (ω₁ + ω₂), b = 2 ζ / (ω₁ + ω₂).
    let (w1, w2) = (std::f64::consts::TAU, 10.0 * std::f64::consts::TAU);
    let damping = import.draft.damping.as_ref().map(ToString::to_string).unwrap();
    let numbers: Vec<f64> =
        damping.split([':', ',', ')']).filter_map(|word| word.trim().parse().ok()).collect();
    close(numbers[0], 0.1 * w1 * w2 / (w1 + w2), 1e-12, "mass");
    close(numbers[1], 0.1 / (w1 + w2), 1e-12, "stiffness");
}

#[test]
fn a_mass_on_springs_swings_and_yields_as_in_books() {
    let import = import("links.e2k");
    let model = model(&import);
    let tonf = 9806.65;
    // The gap is open: along X spring and link of joint 2 hold 8 tonf.
    let u = last(&model, "Dead", &["2@Top Ux"])[0];
    close(u, 8.0 / (4.0 + 10.0) * 0.01, 1e-9, "displacement");
    // Along Y: 9 of the spring and 10 of the link.
    let (k, m) = (19.0 * tonf / 0.01, 0.501 * tonf / 0.01);
    let wanted = std::f64::consts::TAU * f64::sqrt(m / k);
    let all = periods(&model);
    assert!(all.iter().any(|t| (t / wanted - 1.0).abs() < 1e-6), "{wanted} in {all:?}");
}
