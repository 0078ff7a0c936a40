//! Files that are right.

use super::rng::Rng;
use super::target::Target;
use crate::{parse, root};
use std::path::Path;
use trilith::RunOptions;
use trilith_element::{Dof, MeshRow, SparseMatrix};
use trilith_model::{MatrixForm, matrix_file, read_matrix};

/// Quantities as users write them.
const QUANTITIES: [&str; 8] = [
    "5.1 in",
    "2*0.3 m",
    "(1 + 2)*3 kN/m",
    "-4e6 N*s/m",
    "1 t",
    "pi*(20 mm)^2/4",
    "sqrt(2)*9.81 m/s^2",
    "min(1, 2, 3)",
];

/// A history with a unit, a comment and a column that nobody asked for.
const HISTORY: &str =
    "# measured\nt [s],U1 [mm],load [kN]\n0,0,0\n0.5,1.5,20\n1,-1.5e0,-20\n1.5,0,0\n";

/// A mass that slides to rest, small enough to be read thousands of times a second.
const SMALL: &str = r#"(
    parameters: { "mu": 0.5, "k": "1e8 N/m" },
    nodes: { "a": (0, 0, 0), "b": (1, 0, 0) },
    supports: { "a": (Uy, Rx, Ry, Rz), "b": Fixed },
    elements: {
        "m": Mass(node: "a", mass: "1 t"),
        "s": Spring(nodes: ("a", "b"), k1: "k/1000"),
        "f": NLink(node: "a", kn: "k", ks: "k", mu: "mu"),
    },
    damping: Rayleigh(mass: 0.1, stiffness: 0.001),
    functions: { "p": Points(points: [(0, "0 m/s^2"), (0.1, "1 m/s^2"), (0.2, "0 m/s^2")], after_end: Zero) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "motion": Dynamic(after: "gravity", duration: 0.3, dt: 0.01, base: [(direction: X, function: "p")]),
    },
    outputs: { "u": Displacement(node: "a", dof: Ux) },
)"#;

/// The same in many ways: repeated, in groups, with sections of another file.
const MANY: &str = r#"(
    include: ["sections/steel.ron"],
    parameters: { "n": 2, "k": "1e8 N/m", "mu": 0.5 },
    nodes: { "{c}{i}": For(i: "0 to n", c: { "a": (y: 0), "b": (y: "1 m") }, of: ("i*1 m", "y", 0)) },
    supports: { "far": (Uz, Rx, Ry, Rz), "{c}{n}": For(c: ["a", "b"], of: Fixed) },
    elements: {
        "m{c}{i}": For(i: "0 to n - 1", c: [a, b], of: Mass(node: "{c}{i}", mass: "(i + 1)*1 t")),
        "s{c}{i}": For(i: "1 to n", c: [a, b], of: Beam(nodes: ("{c}{i-1}", "{c}{i}"), use: "IPE 300")),
        "f{c}": For(c: [a, b], of: NLink(node: "{c}0", kn: "k", ks: "k", mu: "mu")),
        "tie": EqualDof(nodes: ("a1", "pair"), dofs: [Ux]),
    },
    groups: { "far": Nodes(["a0", For(i: "0 to n - 1", when: "i > 0 and n != i", of: "b{i}")]), "f": ["f*"], "pair": ["b1"] },
    functions: { "p{i}": For(i: "1 to 2", of: Sine(amplitude: "i*1 m/s^2", frequency: "i*5 Hz", cycles: 1)) },
    loads: { "push": [(node: "far", dof: Ux, force: "1 kN"), For(i: "0 to 1", of: (node: "a{i}", dof: Uy, force: "i*1 kN"))] },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "motion": Dynamic(after: "gravity", duration: 0.1, dt: 0.01, base: [(direction: X, function: "p1")]),
    },
    outputs: { "f": LinkForce(link: "f", axis: U1), "u{i}": For(i: "0 to 1", of: Displacement(node: "b{i}", dof: Ux)) },
)"#;

/// A small model in JSON.
const JSON: &str = r#"{
    "title": "A mass on a spring", "units": { "length": "m", "force": "kN" },
    "parameters": { "k": "10 kN/m" },
    "nodes": { "a": [0, 0, 0], "b": [0, 0, "1 m"] },
    "supports": { "a": "Fixed", "b": ["Uy", "Uz", "Rx", "Ry", "Rz"] },
    "elements": {
        "m": { "Mass": { "node": "b", "mass": "2 t" } },
        "s": { "Spring": { "nodes": ["a", "b"], "k2": "k", "k1": 5e2 } }
    },
    "damping": { "Rayleigh": { "mass": 0.1, "stiffness": 0.001 } },
    "loads": { "push": [{ "node": "b", "dof": "Ux", "force": -1.5 }] },
    "cases": { "push": { "Static": { "loads": ["push"] } } },
    "outputs": { "u": { "Displacement": { "node": "b", "dof": "Ux" } } }
}"#;

/// Both triangles of a chain of three springs, line by line as CalculiX stores them.
const CALCULIX: &str = "1 1 2.0\n2 1 -1.0\n2 2 2.5E+00\n3 2 -1.5\n3 3 1.5\n";

/// A small matrix in every form that has a reader.
fn matrices() -> Vec<File> {
    let mut a = read_matrix(CALCULIX.as_bytes(), "k.sti").expect("a matrix");
    let mut all = vec![File { target: Target::Calculix, bytes: CALCULIX.into() }];
    let mut add = |target, a: &SparseMatrix, form| {
        let bytes = matrix_file(a, form).expect("a small file");
        all.push(File { target, bytes });
    };
    add(Target::Market, &a, MatrixForm::Market);
    add(Target::Npz, &a, MatrixForm::Npz);
    a.name = "k.op4:KAA".into();
    add(Target::Op4, &a, MatrixForm::Op4);
    a.name = "k.pch:KAAX".into();
    a.rows = (1..=3).map(|node| MeshRow { node, dof: Some(Dof::Ux) }).collect();
    add(Target::Dmig, &a, MatrixForm::Dmig);
    all
}

/// A file and what reads it.
#[derive(Clone, Debug)]
pub struct File {
    /// What reads it.
    pub target: Target,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// What mutants are made of.
#[derive(Clone, Debug)]
pub struct Corpus(Vec<File>);

impl Corpus {
    /// The shipped models, studies, records, text models of SAP2000 and ETABS, scripts of OpenSees, matrices, a checkpoint and
    /// quantities.
    ///
    /// # Panics
    /// Where one of them is missing.
    #[must_use]
    pub fn shipped() -> Self {
        let mut files = Vec::new();
        let mut take = |target: Target, folder: &str, ending: &str| {
            let folder = root().join(folder);
            let listed = std::fs::read_dir(&folder).expect("a shipped folder");
            let mut paths: Vec<_> = listed.flatten().map(|entry| entry.path()).collect();
            // Folders list their files in any order.
            paths.sort();
            for path in paths.iter().filter(|path| ends(path, ending)) {
                let bytes = std::fs::read(path).expect("a shipped file");
                files.push(File { target, bytes });
            }
        };
        take(Target::Model, "models", ".ron");
        take(Target::Study, "models/studies", ".ron");
        take(Target::Record, "crates/record/tests/files", "");
        take(Target::Record, "models/records", "_1.csv");
        take(Target::Import, "crates/exchange/tests/files", ".s2k");
        take(Target::Etabs, "crates/exchange/tests/etabs", ".e2k");
        take(Target::Script, "crates/exchange/tests/opensees", ".tcl");
        take(Target::Sections, "models/sections", ".ron");
        take(Target::Market, "models/superelements", ".mtx");
        let small = |target| File { target, bytes: SMALL.into() };
        let many = |target| File { target, bytes: MANY.into() };
        files.extend([Target::Model, Target::Model, Target::Run].map(many));
        files.extend(
            [Target::Model, Target::Model, Target::Run, Target::Run, Target::Run].map(small),
        );
        let (model, _) = parse(SMALL, &[]);
        let analysis = trilith::Analysis::new(&model).expect("a structure").with_loops();
        let options = RunOptions { case: 1, ..RunOptions::default() };
        let run = analysis.run(options).expect("a run");
        let bytes = serde_json::to_vec(&run.result.end).expect("a checkpoint");
        files.push(File { target: Target::Checkpoint, bytes });
        let bytes = serde_json::to_vec(&run.report(&analysis, &[], &[])).expect("a report");
        files.push(File { target: Target::Report, bytes });
        files.push(File { target: Target::History, bytes: HISTORY.into() });
        files.push(File { target: Target::Json, bytes: JSON.into() });
        files.push(File { target: Target::Table, bytes: HISTORY.into() });
        files.extend(matrices());
        let quantity =
            |text: &&str| File { target: Target::Quantity, bytes: text.as_bytes().into() };
        files.extend(QUANTITIES.iter().map(quantity));
        Self(files)
    }

    /// One that a reader reads.
    pub(super) fn of(&self, target: Target, rng: &mut Rng) -> Option<&File> {
        let all: Vec<&File> = self.0.iter().filter(|f| f.target == target).collect();
        all.get(rng.below(all.len())).copied()
    }

    /// Any of them.
    pub(super) fn any(&self, rng: &mut Rng) -> &File {
        rng.pick(&self.0)
    }

    /// One that is read by the same.
    pub(super) fn alike(&self, file: &File, rng: &mut Rng) -> &File {
        let alike: Vec<&File> = self.0.iter().filter(|f| f.target == file.target).collect();
        alike[rng.below(alike.len())]
    }
}

fn ends(path: &Path, ending: &str) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
    path.is_file() && name.is_some_and(|name| name.ends_with(ending) && name != "README.md")
}
