//! What this crate offers beside links, by name from model files, against closed forms.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use trilith::element::{Register, Side, Stretch, Waveform};
use trilith::{Model, Registry, Run};

fn kinds() -> Registry {
    let mut kinds = trilith::registry();
    trilith_thirdparty_example::register(&mut kinds);
    kinds
}

fn read(text: &str) -> Model {
    trilith::read_text(text, "doors.ron", &kinds(), &[]).unwrap_or_else(|e| panic!("{e:?}"))
}

fn run(text: &str, case: &str) -> Run {
    trilith::run(&read(text), case).expect("a run")
}

/// The errors of a text, with line and column.
fn errors(text: &str, kinds: &Registry) -> String {
    match trilith::read_text(text, "doors.ron", kinds, &[]) {
        Ok(_) => panic!("this should be refused: {text}"),
        Err(errors) => format!("{errors:?}"),
    }
}

/// A mass of 1 t on a spring of 40 MN/m, which is hit: T = 31.4 ms.
fn blast(function: &str, solver: &str) -> String {
    format!(
        r#"(
            nodes: {{ "wall": (0, 0, 0) }},
            supports: {{ "wall": (Uy, Uz, Rx, Ry, Rz) }},
            elements: {{
                "mass": Mass(node: "wall", mass: "1 t"),
                "spring": Spring(node: "wall", k2: "40 MN/m"),
            }},
            functions: {{ "blast": {function} }},
            loads: {{ "push": [(node: "wall", dof: Ux, force: "1 kN")] }},
            cases: {{ "hit": Dynamic(
                duration: "80 ms", dt: "0.1 ms", forces: [(load: "push", function: "blast")], solver: {solver},
            ) }},
            outputs: {{ "u": Displacement(node: "wall", dof: Ux) }},
        )"#
    )
}

/// ü + ω² u = p₀ (1 − t/T) e^(−a t) from rest: u = e^(−a t) (P + Q t) − P cos ωt − (Q − a P)/ω sin ωt with
/// Q = −p₀/(T (ω² + a²)) and P = (p₀ + 2 a Q)/(ω² + a²), a = b/T.
fn moved(t: f64) -> f64 {
    let (p0, duration, decay, w2) = (50e3 / 1e3, 20e-3, 1.5, 40e6_f64 / 1e3);
    let (w, a) = (w2.sqrt(), decay / duration);
    let d = w2 + a * a;
    let q = -p0 / (duration * d);
    let p = (p0 + 2.0 * a * q) / d;
    (-a * t).exp() * (p + q * t) - p * (w * t).cos() - (q - a * p) / w * (w * t).sin()
}

const FRIEDLANDER: &str = "Friedlander(amplitude: 50, duration: \"20 ms\", decay: 1.5)";

#[test]
fn a_wall_answers_to_a_blast_as_the_closed_form_says() {
    for (solver, tolerance) in [("Fna", 2e-4), ("Hht", 2e-3)] {
        let run = run(&blast(FRIEDLANDER, solver), "hit");
        let most = (0..=800).map(|i| moved(1e-4 * f64::from(i)).abs()).fold(0.0, f64::max);
        for (t, u) in run.time().iter().zip(run.history("u").expect("an output")) {
            let expected = moved(*t);
            assert!((u - expected).abs() < tolerance * most, "{solver} at {t} s: {u}, {expected}");
        }
        assert!(run.time().len() > 700);
    }
}

#[test]
fn a_blast_is_scaled_written_out_and_read_again() {
    let twice = format!(
        "{}, \"twice\": Scaled(function: \"blast\", factor: 2)",
        FRIEDLANDER.replace("50,", "25,")
    );
    let model = read(&blast(&twice, "Fna"));
    let [once, twice] = [0, 1].map(|i| model.functions[i].function.clone());
    assert_eq!(twice.value(5e-3, Side::After), 2.0 * once.value(5e-3, Side::After));
    assert_eq!((once.value(0.0, Side::Before), once.value(0.0, Side::After)), (0.0, 25.0));
    let again = read(&trilith::model::resolved(&model));
    assert_eq!(again.functions[1].function, twice);
    assert_ne!(again.functions[0].function, twice);
}

#[test]
fn a_wrong_name_or_field_of_a_foreign_function_is_answered_as_of_a_built_in_one() {
    let told = |function: &str| errors(&blast(function, "Fna"), &kinds());
    let name = told(&FRIEDLANDER.replace("Friedlander", "Friedlandr"));
    assert!(name.contains("there is no function `Friedlandr`"), "{name}");
    assert!(name.contains("did you mean `Friedlander`"), "{name}");
    let field = told(&FRIEDLANDER.replace("decay", "decays"));
    assert!(field.contains("function `blast` has no field `decays`"), "{field}");
    let unit = told(&FRIEDLANDER.replace("20 ms", "20 mm"));
    assert!(unit.contains("this is a value in m: must be a value in s"), "{unit}");
    let range = told(&FRIEDLANDER.replace("1.5", "0.1"));
    assert!(range.contains("`decay`"), "{range}");
    let missing = told("Friedlander(duration: \"1 s\")");
    assert!(missing.contains("function `blast` has no `amplitude`"), "{missing}");
    // Nor is it a kind of elements, or an element a function.
    let element = blast(FRIEDLANDER, "Fna").replace("Mass(", "Friedlander(");
    assert!(errors(&element, &kinds()).contains("there is no kind `Friedlander`"));
    assert!(told("Mass(mass: 1)").contains("there is no function `Mass`"));
}

/// Answers with what a test says; made by a reader that holds it.
#[derive(Clone, Debug)]
struct Odd {
    value: f64,
    peak: f64,
    step: f64,
}

impl Waveform for Odd {
    fn at(&self, t: f64, _: Side) -> [f64; 3] {
        [if t > 0.5 { self.value } else { 1.0 }, 0.0, 0.0]
    }
    fn breaks(&self) -> Vec<f64> {
        Vec::new()
    }
    fn stretch(&self) -> Option<Stretch> {
        Some(Stretch { from: 0.0, to: f64::INFINITY, step: self.step })
    }
    fn peak_until(&self, _: f64) -> f64 {
        self.peak
    }
}

/// The card of [`Odd`]: that of the blast under another name, without parameters.
const ODD: trilith::element::Card =
    <trilith_thirdparty_example::Friedlander as trilith::element::Described>::CARD
        .named("Odd")
        .parameters(&[]);

/// A card with the name of a built-in function.
const SINE: trilith::element::Card = ODD.named("Sine");

#[test]
fn a_function_that_is_none_is_refused_where_it_is_named() {
    let good = Odd { value: 1.0, peak: 1.0, step: 0.1 };
    let with = |odd: Odd| {
        let mut kinds = kinds();
        kinds.add_function(&ODD, std::sync::Arc::new(move |_| Ok(Box::new(odd.clone()))));
        kinds
    };
    let text = blast("Odd(amplitude: 1)", "Fna");
    assert!(trilith::read_text(&text, "doors.ron", &with(good.clone()), &[]).is_ok());
    for (odd, words) in [
        (Odd { value: f64::NAN, ..good.clone() }, "a value or a derivative is NaN at"),
        (Odd { value: 2.0, ..good.clone() }, "but `peak_until` is 1 for all times"),
        (Odd { peak: f64::INFINITY, ..good.clone() }, "`peak_until` is inf"),
        (Odd { step: 0.0, ..good.clone() }, "`stretch` is from 0 s"),
    ] {
        let told = errors(&text, &with(odd));
        assert!(told.contains(words), "{told}");
    }
    let mut sine = trilith::registry();
    sine.add_function(&SINE, std::sync::Arc::new(move |_| Ok(Box::new(good.clone()))));
    assert_eq!(sine.duplicates(), ["Sine"]);
}

/// A bar of 2 m from 10 to 20 cm² under 100 kN: F L ln 2/(E·10 cm²).
#[test]
fn a_tapered_bar_gives_way_by_its_logarithmic_mean() {
    let text = r#"(
        nodes: { "a": (0, 0, 0), "b": (2, 0, 0) },
        supports: { "a": (Ux, Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz) },
        elements: { "bar": TaperedBar(nodes: ("a", "b"), modulus: "200 GPa", area1: "10 cm^2", area2: "20 cm^2") },
        loads: { "pull": [(node: "b", dof: Ux, force: "100 kN")] },
        cases: { "pull": Static(loads: ["pull"]) },
        outputs: { "u": Displacement(node: "b", dof: Ux) },
    )"#;
    let expected = 1e5 * 2.0 * 2.0_f64.ln() / (2e11 * 1e-3);
    let u = run(text, "pull").peak("u").expect("an output").max;
    assert!((u - expected).abs() < 1e-9 * expected, "{u} {expected}");
    let short = text.replace("area2: \"20 cm^2\"", "area2: 0");
    assert!(errors(&short, &kinds()).contains("`area2`"));
}

/// Two springs over a gear of 1 : −3 are k₁ + 9 k₂ at the first: F/(k₁ + 9 k₂).
#[test]
fn a_gearing_carries_a_spring_over_by_the_square_of_its_ratio() {
    let text = r#"(
        nodes: { "a": (0, 0, 0), "b": (1, 0, 0) },
        supports: { "a": (Ux, Uy, Rx, Ry, Rz), "b": (Ux, Uy, Rx, Ry, Rz) },
        elements: {
            "first": Spring(node: "a", k3: "10 kN/m", axis1: (1, 0, 0), axis2: (0, 1, 0)),
            "second": Spring(node: "b", k3: "2 kN/m", axis1: (1, 0, 0), axis2: (0, 1, 0)),
            "gears": Gearing(nodes: ("a", "b"), dof: Uz, ratio: -3),
        },
        loads: { "push": [(node: "a", dof: Uz, force: "1.4 kN")] },
        cases: { "push": Static(loads: ["push"]) },
        outputs: { "a": Displacement(node: "a", dof: Uz), "b": Displacement(node: "b", dof: Uz) },
    )"#;
    let run = run(text, "push");
    let [a, b] = ["a", "b"].map(|name| run.peak(name).expect("an output"));
    assert!((a.max - 1.4 / 28.0).abs() < 1e-12, "{a:?}");
    assert!((b.min + 3.0 * 1.4 / 28.0).abs() < 1e-12, "{b:?}");
    let held = text.replace("ratio: -3", "ratio: 0");
    assert!(errors(&held, &kinds()).contains("write a support"));
}

/// A bar that is pulled, and gears whose wheels turn.
const DRAWN: &str = r#"(
    nodes: { "a": (0, 0, 0), "b": (2, 0, 0), "motor": (0, 1, 0), "wheel": (0, 1.5, 0) },
    supports: {
        "a": Fixed, "b": (Uy, Uz, Rx, Ry, Rz),
        "motor": (Ux, Uy, Uz, Ry, Rz), "wheel": (Ux, Uy, Uz, Ry, Rz),
    },
    elements: {
        "bar": TaperedBar(nodes: ("a", "b"), modulus: "200 GPa", area1: "16 cm^2", area2: "36 cm^2"),
        "gears": Gearing(nodes: ("motor", "wheel"), dof: Rx, ratio: -0.25),
        "mass": Mass(node: "b", mass: "1 t"),
        "rotor": Mass(node: "wheel", mass: 1, inertia: (1, 1, 1)),
    },
    functions: { "on": Constant(value: 1) },
    loads: { "drive": [(node: "motor", dof: Rx, moment: 0.01), (node: "b", dof: Ux, force: "1 MN")] },
    cases: { "drive": Dynamic(duration: "1 s", dt: "10 ms", forces: [(load: "drive", function: "on")]) },
    outputs: { "turn": Displacement(node: "motor", dof: Rx) },
)"#;

/// Rows of three numbers of an array of a `.vtu` file: base64 behind eight bytes of its length.
fn rows(vtu: &str, name: &str) -> Vec<[f64; 3]> {
    let at = vtu.find(&format!("Name=\"{name}\"")).expect("an array");
    let bytes = STANDARD.decode(vtu[at..].lines().nth(1).expect("a line")).expect("base64");
    let is_single = vtu[..at].ends_with("type=\"Float32\" ");
    let number = |bytes: &[u8]| match is_single {
        true => f64::from(f32::from_le_bytes(bytes.try_into().expect("four bytes"))),
        false => f64::from_le_bytes(bytes.try_into().expect("eight bytes")),
    };
    let numbers: Vec<f64> = bytes[8..].chunks(if is_single { 4 } else { 8 }).map(number).collect();
    numbers.chunks(3).map(|row| [row[0], row[1], row[2]]).collect()
}

#[test]
fn an_element_and_a_constraint_look_as_they_say() {
    let folder = std::env::temp_dir().join(format!("trilith-drawn-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("drawn.ron"), DRAWN).expect("written");
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_trilith-thirdparty-example"));
    let done = command.current_dir(&folder).args(["run", "drawn.ron", "--out", "out"]).output();
    let done = done.expect("the program");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let read = |name: &str| std::fs::read_to_string(folder.join("out").join(name)).expect("a file");
    // Nodes, corners of the bar, two wheels of 24 corners.
    let last = (0..)
        .map(|i| format!("frames/{i:04}.vtu"))
        .take_while(|f| folder.join("out").join(f).exists());
    let vtu = read(&last.last().expect("frames"));
    let (points, moved) = (rows(&vtu, "points"), rows(&vtu, "displacement"));
    assert_eq!((points.len(), moved.len()), (4 + 8 + 48, 4 + 8 + 48));
    let close = |a: f64, b: f64| (a - b).abs() < 1e-6 * b.abs().max(1e-3);
    // Squares of 4 cm at one end and 6 cm at the other, which go with their nodes.
    for (corner, node, half) in [(4, 0, 0.02), (8, 1, 0.03)] {
        for i in corner..corner + 4 {
            let [x, y, z] = points[i];
            assert!(
                close(x, points[node][0]) && close(y.abs(), half) && close(z.abs(), half),
                "{:?}",
                points[i]
            );
            assert_eq!(moved[i], moved[node]);
        }
    }
    // Where the wheels touch, both go the same way.
    let (one, other) = (12, 12 + 24 + 12);
    assert!((0..3).all(|i| close(points[one][i], [0.0, 1.1, 0.0][i])), "{:?}", points[one]);
    assert!((0..3).all(|i| close(points[other][i], points[one][i])), "{:?}", points[other]);
    assert!(
        close(moved[one][2], moved[other][2]) && moved[one][2].abs() > 1e-4,
        "{:?}",
        moved[one]
    );
    // The page has the same: faces of both, and no line from node to node.
    let page = read("report.json");
    for (what, faces) in [("bar (TaperedBar)", 2), ("gears (Gearing)", 2)] {
        let found = page.matches(&format!("\"name\":\"{what}\",\"corners\"")).count();
        assert_eq!(found, faces, "{what}");
    }
    assert!(!page.contains("\"name\":\"gears (Gearing)\",\"what\""));
    let _ = std::fs::remove_dir_all(&folder);
}
