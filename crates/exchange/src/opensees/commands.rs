//! The commands of OpenSees: what becomes of each.

use super::args::Told;
use super::recorder::Recorder;
use super::tcl::{Reply, Value};

/// What a command does, told its words.
type Does = fn(&mut Recorder<'_>, &[Value]) -> Told<Reply>;

/// Commands that make the model, its cases and its outputs.
pub(super) const COMMANDS: [(&str, Does); 37] = [
    ("model", |r, w| quiet(r.model(w))),
    ("wipe", |r, _| quiet(r.wipe())),
    ("node", |r, w| quiet(r.add_node(w))),
    ("mass", |r, w| quiet(r.mass(w))),
    ("fix", |r, w| quiet(r.fix(w))),
    ("fixX", |r, w| quiet(r.fix_plane(w))),
    ("fixY", |r, w| quiet(r.fix_plane(w))),
    ("fixZ", |r, w| quiet(r.fix_plane(w))),
    ("equalDOF", |r, w| quiet(r.equal_dof(w))),
    ("rigidLink", |r, w| quiet(r.rigid_link(w))),
    ("rigidDiaphragm", |r, w| quiet(r.diaphragm(w))),
    ("uniaxialMaterial", |r, w| quiet(r.material(w))),
    ("frictionModel", |r, w| quiet(r.friction(w))),
    ("section", |r, w| quiet(r.section(w))),
    ("geomTransf", |r, w| quiet(r.transform(w))),
    ("element", |r, w| quiet(r.element(w))),
    ("timeSeries", |r, w| quiet(r.time_series(w))),
    ("pattern", |r, w| r.pattern(w)),
    ("load", |r, w| quiet(r.load(w))),
    ("eleLoad", |r, w| quiet(r.element_load(w))),
    ("sp", |r, w| quiet(r.single_point(w))),
    ("groundMotion", |r, w| quiet(r.ground_motion(w))),
    ("imposedMotion", |r, w| quiet(r.imposed_motion(w))),
    ("imposedSupportMotion", |r, w| quiet(r.imposed_motion(w))),
    ("rayleigh", |r, w| quiet(r.rayleigh(w))),
    ("modalDamping", |r, w| quiet(r.modal_damping(w))),
    ("integrator", |r, w| quiet(r.integrator(w))),
    ("analysis", |r, w| quiet(r.kind_of_analysis(w))),
    ("analyze", |r, w| answered(r.analyze(w).map(|()| Value::new("0")))),
    ("loadConst", |r, w| quiet(r.load_constant(w))),
    ("setTime", |r, w| quiet(r.set_time(w))),
    ("getTime", |r, _| answered(Ok(Value::new(format!("{:?}", r.analysis.time))))),
    ("eigen", |r, w| answered(r.eigen(w))),
    ("recorder", |r, w| quiet(r.recorder(w))),
    ("getNodeTags", |r, _| answered(Ok(tags(r.by_tag.keys())))),
    ("getEleTags", |r, _| answered(Ok(tags(r.elements.keys())))),
    ("nodeCoord", |r, w| answered(r.coordinates(w))),
];

fn quiet(done: Told<()>) -> Told<Reply> {
    answered(done.map(|()| Value::empty()))
}

fn answered(value: Told<Value>) -> Told<Reply> {
    value.map(Reply::Value)
}

/// Tags in their order.
fn tags<'t>(all: impl Iterator<Item = &'t i64>) -> Value {
    let mut tags: Vec<i64> = all.copied().collect();
    tags.sort_unstable();
    let texts: Vec<String> = tags.iter().map(i64::to_string).collect();
    Value::list(&texts)
}

/// All that are known.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    let made = COMMANDS.iter().map(|c| c.0);
    made.chain(CHOICES.iter().map(|c| c.0)).chain(QUESTIONS).chain(LOST)
}

/// Commands that choose how equations are solved, and others that change no result.
pub(super) const CHOICES: [(&str, &str); 20] = [
    ("constraints", "constraints are eliminated here"),
    ("numberer", "nothing to choose here"),
    ("system", "nothing to choose here"),
    ("test", "`link_tolerance` stands for it"),
    ("algorithm", "nothing to choose here"),
    ("wipeAnalysis", "the next analysis says its own"),
    ("record", "outputs are recorded at every step"),
    ("reactions", "reactions are always there"),
    ("print", "what a script prints is left out"),
    ("printModel", "what a script prints is left out"),
    ("printA", "what a script prints is left out"),
    ("logFile", "what a script prints is left out"),
    ("defaultUnits", "units of the file are those of `--units`"),
    ("setMaxOpenFiles", "no files are opened"),
    ("setPrecision", "outputs have all digits"),
    ("display", "nothing is drawn"),
    ("prp", "nothing is drawn"),
    ("vrp", "nothing is drawn"),
    ("start", "the time of day is left out"),
    ("stop", "the time of day is left out"),
];

/// Commands that ask for results, which are not there when a script is imported.
pub(super) const QUESTIONS: [&str; 16] = [
    "nodeDisp",
    "nodeVel",
    "nodeAccel",
    "nodeReaction",
    "nodeEigenvector",
    "nodeResponse",
    "nodeUnbalance",
    "eleForce",
    "eleResponse",
    "basicForce",
    "basicDeformation",
    "localForce",
    "eleDynamicalForce",
    "testNorm",
    "testIter",
    "modalProperties",
];

/// Commands of OpenSees that carry a model and have no counterpart.
pub(super) const LOST: [&str; 28] = [
    "nDMaterial",
    "patch",
    "layer",
    "fiber",
    "block2D",
    "block3D",
    "region",
    "remove",
    "reset",
    "parameter",
    "updateParameter",
    "addToParameter",
    "setParameter",
    "updateMaterialStage",
    "beamIntegration",
    "limitCurve",
    "damping",
    "modalDampingQ",
    "setElementRayleighDampingFactors",
    "setElementRayleighFactors",
    "rigidBody",
    "mpcConstraint",
    "equalDOF_Mixed",
    "equationConstraint",
    "yieldSurface_BC",
    "hystereticBackbone",
    "responseSpectrumAnalysis",
    "setNodeDisp",
];
