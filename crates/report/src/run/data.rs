//! What the page of a run shows, as it lies in the folder of the run.

use crate::draw::nearest;
use serde::{Deserialize, Serialize};
use trilith_results::Summary;

/// `report.json`: what the page of a run shows beside `summary.json`, thinned to what can be seen.
///
/// Full histories are in `histories.npz`. SI throughout; `shown` says in which unit a figure is drawn.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunData {
    /// Version of this format.
    pub format: u32,
    /// Which run it is of.
    pub run: RunIdentity,
    /// Name of the model file.
    pub file: String,
    /// Parameters of the model with the values they had.
    pub parameters: Vec<(String, String)>,
    /// Parameters given on the command line.
    pub overrides: Vec<(String, String)>,
    /// What is asked first of such a model, and what the run answers.
    pub answers: Vec<Answer>,
    /// How the case was solved: what, and its value.
    pub settings: Vec<(String, String)>,
    /// The model as points and lines.
    pub picture: Picture,
    /// What parts of the picture can be coloured by.
    #[serde(default)]
    pub tints: Vec<Tint>,
    /// Deformed shapes.
    pub frames: Frames,
    /// Names of the outputs, in the order of the model.
    pub outputs: Vec<String>,
    /// Accelerations of the base.
    #[serde(default)]
    pub ground: Vec<Ground>,
    /// Their response spectra, one chart.
    #[serde(default)]
    pub ground_spectra: Vec<SpectrumChart>,
    /// Outputs over time.
    pub histories: Vec<History>,
    /// Extremes over the height of a structure.
    pub profiles: Vec<Profile>,
    /// Extremes of forces along members.
    #[serde(default)]
    pub members: Vec<MemberCurve>,
    /// Paths of places in plan.
    pub orbits: Vec<Orbit>,
    /// Floor spectra, a chart for each damping.
    #[serde(default)]
    pub floor_spectra: Vec<SpectrumChart>,
    /// Energies over time, with the names of `histories.csv`, and `supply`: start and input.
    pub energies: Vec<History>,
    /// Hysteresis loops of links.
    pub loops: Vec<Loop>,
    /// Mode shapes of the structure with its links engaged, where links are stiff, and without links.
    pub modes: Vec<Mode>,
    /// Modes without links that have no stiffness, beside these.
    pub free_modes: usize,
    /// What the page leaves out.
    pub notes: Vec<String>,
}

impl RunData {
    /// The format that is written and read here.
    pub const FORMAT: u32 = 6;
}

/// What tells a run from others, as its `summary.json` has it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunIdentity {
    /// Version of the program.
    pub version: String,
    /// Build of the program.
    pub build: String,
    /// SHA-256 of the model file.
    pub model: String,
    /// Name of the case.
    pub case: String,
    /// Name of the solver.
    pub solver: String,
    /// SHA-256 of the summary without its work.
    pub run_sha256: String,
}

impl RunIdentity {
    /// That of a summary.
    #[must_use]
    pub fn of(summary: &Summary) -> Self {
        Self {
            version: summary.version.to_owned(),
            build: summary.build.to_owned(),
            model: summary.model.sha256.clone(),
            case: summary.case.clone(),
            solver: summary.solver.to_owned(),
            run_sha256: summary.run_sha256.clone(),
        }
    }
}

/// Numbers as whole multiples of a step, which makes short files.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Numbers {
    /// The step.
    pub step: f64,
    /// Multiples of it.
    pub n: Vec<i32>,
}

impl Numbers {
    /// Rounds values to so many steps of the largest magnitude; what is not finite becomes zero.
    pub(crate) fn new(values: impl Iterator<Item = f64> + Clone, steps: f64) -> Self {
        let largest = values.clone().filter(|x| x.is_finite()).fold(0.0_f64, |a, x| a.max(x.abs()));
        let step = if largest > 0.0 { largest / steps } else { 1.0 };
        // A float turns into a whole number with saturation, NaN into zero.
        let whole = |x: f64| nearest(x / step).clamp(i64::from(i32::MIN), i64::from(i32::MAX));
        Self { step, n: values.map(|x| whole(x) as i32).collect() }
    }

    /// The values.
    pub fn values(&self) -> impl Iterator<Item = f64> + Clone + '_ {
        self.n.iter().map(|n| f64::from(*n) * self.step)
    }
}

/// In which unit a quantity is drawn: value in SI times factor.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Shown {
    /// Unit.
    pub unit: String,
    /// Factor.
    pub factor: f64,
}

impl Shown {
    /// The unit in which values of up to this size (SI) are easy to read.
    #[must_use]
    pub fn fitting(unit: &str, size: f64) -> Self {
        super::units::shown(unit, size)
    }

    /// A quantity and this unit in brackets, for an axis.
    #[must_use]
    pub fn labelled(&self, what: &str) -> String {
        super::units::labelled(what, self)
    }
}

/// A quantity over time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct History {
    /// Name.
    pub name: String,
    /// What it is, whatever the place: histories of one kind compare. Empty: alone.
    #[serde(default)]
    pub kind: String,
    /// Unit in figures.
    pub shown: Shown,
    /// Times, s.
    pub t: Numbers,
    /// Values.
    pub y: Numbers,
}

/// An answer to a question that is asked of such a model.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The question.
    pub words: String,
    /// The value in SI, where there is no text.
    pub value: f64,
    /// SI unit.
    pub unit: String,
    /// An answer in words; empty: a value.
    pub text: String,
    /// When it was so, s.
    pub t: Option<f64>,
    /// How far it may be off by the certificate of the run; none: nobody knows.
    pub error: Option<f64>,
    /// Where it was, or what share it is.
    pub note: String,
}

/// Extremes of one quantity over the height of a structure.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Profile {
    /// `displacement`, `drift` (a share of the height) or `acceleration`.
    pub quantity: String,
    /// Unit in figures.
    pub shown: Shown,
    /// A curve for each direction and place in plan.
    pub curves: Vec<ProfileCurve>,
}

/// Largest magnitudes above one place in plan, rising.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ProfileCurve {
    /// `X` or `Y`.
    pub direction: String,
    /// The place in plan, m.
    pub place: [f64; 2],
    /// From these heights, m …
    pub from: Vec<f64>,
    /// … to these.
    pub to: Vec<f64>,
    /// Largest magnitudes.
    pub value: Vec<f64>,
}

/// Extremes over time of a force along a member.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MemberCurve {
    /// Name of the envelope.
    pub envelope: String,
    /// Name of the member.
    pub member: String,
    /// `N`, `V2` … `M3`.
    pub force: String,
    /// Unit in figures, one for all of a force and an envelope.
    pub shown: Shown,
    /// Distances from the first node, m.
    pub at: Numbers,
    /// Largest values, N or N·m.
    pub max: Numbers,
    /// Smallest values.
    pub min: Numbers,
}

/// A path in plan: one output against another.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Orbit {
    /// Names of both outputs.
    pub names: [String; 2],
    /// Unit in figures.
    pub shown: Shown,
    /// Times, s.
    pub t: Numbers,
    /// The first.
    pub x: Numbers,
    /// The second.
    pub y: Numbers,
}

impl History {
    /// (time in s, value in the unit shown).
    pub(crate) fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.t.values().zip(self.y.values().map(|y| y * self.shown.factor))
    }
}

/// An acceleration of the base.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ground {
    /// Over time.
    pub history: History,
    /// The largest, with its sign, m/s².
    pub peak: f64,
    /// Its time, s.
    pub t_peak: f64,
}

/// Response spectra in one diagram.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SpectrumChart {
    /// Title.
    pub title: String,
    /// What is drawn, such as `PSA`.
    pub quantity: String,
    /// Unit in figures.
    pub shown: Shown,
    /// The curves.
    pub curves: Vec<SpectrumCurve>,
}

/// A response spectrum.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SpectrumCurve {
    /// Name.
    pub name: String,
    /// Periods, s, rising.
    pub period: Numbers,
    /// Accelerations, m/s².
    pub y: Numbers,
}

/// Force over deformation of a link coordinate.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Loop {
    /// Name of the link.
    pub link: String,
    /// Kind of the link.
    pub kind: String,
    /// Name of the coordinate.
    pub coordinate: String,
    /// Units of deformation and force in figures.
    pub shown: [Shown; 2],
    /// Times, s.
    pub t: Numbers,
    /// Deformations.
    pub d: Numbers,
    /// Forces.
    pub f: Numbers,
}

impl Loop {
    /// (deformation, force) in the units shown.
    pub(crate) fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let [d, f] = [self.shown[0].factor, self.shown[1].factor];
        self.d.values().map(move |x| x * d).zip(self.f.values().map(move |x| x * f))
    }
}

/// The model as points with lines, faces and marks on them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// Plane of a plane model, such as `XZ`.
    pub plane: Option<String>,
    /// Points, m.
    pub points: Vec<[f64; 3]>,
    /// Nodes.
    pub nodes: Vec<NodeMark>,
    /// Members and lines of bodies.
    pub lines: Vec<LineMark>,
    /// Faces of bodies.
    pub faces: Vec<FaceMark>,
    /// Links.
    pub links: Vec<LinkMark>,
    /// Groups of the model.
    #[serde(default)]
    pub groups: Vec<GroupMark>,
    /// Outlines of sections: corners from the axis of a member, m, in global axes.
    #[serde(default)]
    pub outlines: Vec<Vec<[f64; 3]>>,
    /// Level of the ground, where the model stands on one, m.
    pub ground: Option<f64>,
}

/// A node.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NodeMark {
    /// Name.
    pub name: String,
    /// Index of the point.
    pub at: usize,
    /// Fixed directions by name; empty for a free node.
    pub fixed: String,
}

/// What a line stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LineKind {
    /// A beam, truss, spring …
    Member,
    /// Nodes tied by a constraint.
    Tie,
    /// An edge of a body.
    Edge,
}

/// A line between two points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LineMark {
    /// Name and kind of the element.
    pub name: String,
    /// What it stands for.
    pub what: LineKind,
    /// Indices of its points.
    pub ends: [usize; 2],
    /// Index of the outline of its section, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outline: Option<usize>,
}

/// A face of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FaceMark {
    /// Name and kind of the element.
    pub name: String,
    /// Indices of its corners, in order.
    pub corners: Vec<usize>,
}

/// Families of links, each with a symbol of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Family {
    /// Opens and closes.
    Contact,
    /// Force by rate alone.
    Dashpot,
    /// Has a memory: friction, yielding.
    Hysteretic,
    /// Force by deformation alone.
    Spring,
}

/// A link.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinkMark {
    /// Name.
    pub name: String,
    /// Kind.
    pub kind: String,
    /// Family.
    pub family: Family,
    /// Indices of its points: one for a link on the ground.
    pub ends: Vec<usize>,
    /// Direction of local axis 1.
    #[serde(default)]
    pub axis: [f64; 3],
    /// True where a body is drawn in its place.
    pub body: bool,
}

/// A group of the model: indices of the marks that belong to it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GroupMark {
    /// Name.
    pub name: String,
    /// Among the nodes.
    pub nodes: Vec<usize>,
    /// Among the lines.
    pub lines: Vec<usize>,
    /// Among the faces.
    pub faces: Vec<usize>,
    /// Among the links.
    pub links: Vec<usize>,
}

/// A quantity by which parts of the picture can be coloured, at the time that the page shows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tint {
    /// What it is, such as `LeadRubber U2 force`.
    pub quantity: String,
    /// Whose values are known.
    pub of: Vec<Tinted>,
}

/// Parts of the picture with one value of a [`Tint`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tinted {
    /// Title of the figure of the page that has the values: a history, or a loop with its times.
    pub figure: String,
    /// Indices among the nodes of the picture.
    pub nodes: Vec<usize>,
    /// Among its lines.
    pub lines: Vec<usize>,
    /// Among its links.
    pub links: Vec<usize>,
}

/// Displacements of the points of a picture over time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Frames {
    /// Times, s.
    pub t: Vec<f64>,
    /// Displacements, m: X, Y, Z of point after point, frame after frame.
    pub u: Numbers,
}

impl Frames {
    /// Displacement of a point in a frame, m.
    pub(crate) fn at(&self, frame: usize, points: usize, point: usize) -> [f64; 3] {
        let first = 3 * (frame * points + point);
        [0, 1, 2].map(|i| self.u.n.get(first + i).map_or(0.0, |n| f64::from(*n) * self.u.step))
    }
}

/// A mode shape.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mode {
    /// True where links count, as stiff as they are when engaged.
    #[serde(default)]
    pub with_links: bool,
    /// Number among all modes, from 1.
    pub number: usize,
    /// Frequency, Hz.
    pub frequency: f64,
    /// Share of the mass along X, Y, Z.
    pub participation: [f64; 3],
    /// Displacements of the points of the picture, of any size.
    pub u: Numbers,
}
