//! What is set side by side: commands of OpenSees and links of Trilith.

use super::paths::Wave;
use serde_json::{Value, json};

/// A link: its kind, and the parameters that differ from the example on its card.
pub(super) type Ours = (&'static str, Vec<(&'static str, String)>);

/// How well both must agree.
#[derive(Clone, Copy, Debug)]
pub(super) enum Agree {
    /// The same equations in the same steps: rounding.
    Same,
    /// The same law, without a step in it.
    Equal,
    /// The same law, of which something depends on the step in OpenSees: what.
    Stepped(&'static str),
    /// Laws that differ: how far they may be apart in this motion, and what differs.
    Near(f64, &'static str),
}

impl Agree {
    /// Largest difference as share of the largest force.
    pub fn limit(self) -> f64 {
        match self {
            Self::Same => 1e-11,
            Self::Equal => 1e-6,
            Self::Stepped(_) => 1e-4,
            Self::Near(limit, _) => limit,
        }
    }

    /// For the table.
    pub fn words(self) -> String {
        match self {
            Self::Same | Self::Equal => "equal".into(),
            Self::Stepped(what) => format!("equal; {what}"),
            Self::Near(_, what) => format!("near: {what}"),
        }
    }
}

/// A law in both programs, and a motion.
pub(super) struct Pair {
    /// The law and its motion.
    pub name: String,
    /// Commands that make element 1 of OpenSees between the nodes 1 and 2.
    pub commands: Vec<Value>,
    /// Links side by side.
    pub ours: Vec<Ours>,
    /// Motion of the coordinates.
    pub waves: Vec<Wave>,
    /// Global directions of OpenSees for these coordinates.
    pub directions: Vec<u8>,
    /// Directions that a node of OpenSees has.
    pub freedoms: u8,
    /// Steps.
    pub steps: usize,
    /// OpenSees has an error in proportion to its step: with twice as many steps as well, what it tends to is told.
    pub extrapolated: bool,
    /// How well both must agree.
    pub agree: Agree,
}

/// Forces are compared at so many times; the steps are a multiple.
pub(super) const KEPT: usize = 3000;

impl Pair {
    /// A material along one axis, the last of the commands being the one that is tested, with the tag 1.
    pub fn material(name: &str, commands: Vec<Value>, ours: Vec<Ours>, wave: Wave) -> Self {
        let mut commands = commands;
        commands.push(json!(["element", "zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1]));
        let (waves, directions) = (vec![wave], vec![1]);
        let (name, steps) = (name.to_owned(), KEPT);
        Self {
            name,
            commands,
            ours,
            waves,
            directions,
            freedoms: 6,
            steps,
            extrapolated: false,
            agree: Agree::Equal,
        }
    }

    /// The same in cycles that grow, and in an irregular motion.
    pub fn twice(name: &str, commands: &[Value], ours: &[Ours], amplitude: f64) -> [Self; 2] {
        let growing = ("growing cycles", Wave::Growing(amplitude, 1.0));
        [growing, ("irregular", Wave::Irregular(amplitude))].map(|(motion, wave)| {
            let name = format!("{name}, {motion}");
            Self::material(&name, commands.to_vec(), ours.to_vec(), wave)
        })
    }

    /// A bearing whose axis is the first direction.
    pub fn bearing(name: &str, commands: Vec<Value>, ours: Ours, waves: [Wave; 3]) -> Self {
        Self {
            name: name.to_owned(),
            commands,
            ours: vec![ours],
            waves: waves.to_vec(),
            directions: vec![1, 2, 3],
            freedoms: 6,
            steps: KEPT,
            extrapolated: false,
            agree: Agree::Equal,
        }
    }

    /// With another measure.
    pub fn agreeing(self, agree: Agree) -> Self {
        Self { agree, ..self }
    }

    /// A law that OpenSees integrates by implicit steps of first order.
    pub fn implicit(self) -> Self {
        let agree =
            Agree::Stepped("implicit steps of first order there, taken to a step of nought");
        Self { agree, extrapolated: true, ..self.finer(4) }
    }

    /// With so many steps for each force that is kept.
    pub fn finer(self, times: usize) -> Self {
        Self { steps: KEPT * times, ..self }
    }
}

/// A command of OpenSees: its name, a kind, whole numbers such as tags, and numbers.
pub(super) fn command(name: &str, kind: &str, tags: &[u8], numbers: &[f64]) -> Vec<Value> {
    let tags = tags.iter().map(|x| json!(x));
    let numbers = numbers.iter().map(|x| json!(x));
    [json!(name), json!(kind)].into_iter().chain(tags).chain(numbers).collect()
}

/// A material of OpenSees with the tag 1.
pub(super) fn material(kind: &str, numbers: &[f64]) -> Value {
    command("uniaxialMaterial", kind, &[1], numbers).into()
}

/// A link of Trilith.
pub(super) fn link(kind: &'static str, set: &[(&'static str, &str)]) -> Ours {
    (kind, set.iter().map(|(name, value)| (*name, (*value).to_owned())).collect())
}
