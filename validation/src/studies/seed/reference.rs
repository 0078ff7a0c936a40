//! The block by an independent program that locates every change of contact and steps exactly between.

use serde::Deserialize;
use std::collections::BTreeMap;

const CASES: &str = include_str!("../../../../tests/data/block_reference.json");
const HISTORIES: &str = include_str!("../../../data/block_histories.json");

/// A case.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Case {
    name: String,
    t_end: f64,
    height: f64,
    width: f64,
    mass: f64,
    pub(super) g: f64,
    mu: f64,
    pub(super) kn: f64,
    ks: f64,
    pub(super) cv: f64,
    cth: f64,
    motion: Motion,
    init: Init,
    #[serde(rename = "reference")]
    pub(super) peaks: Peaks,
    pub(super) energy: Energy,
    pub(super) tolerance: Tolerances,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase")]
enum Motion {
    Sine { ax: f64, fx: f64, nx: f64, ay: f64, fy: f64, ny: f64 },
    Steps,
    None,
}

#[derive(Clone, Debug, Deserialize)]
struct Init {
    w0: Option<f64>,
}

/// Extremes, m.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Peaks {
    pub(super) slide_max: f64,
    pub(super) slide_min: f64,
    pub(super) residual: f64,
    pub(super) up_l: f64,
    pub(super) up_r: f64,
}

/// At the end, J.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Energy {
    pub(super) input: f64,
    pub(super) friction: f64,
    pub(super) dash_v: f64,
    pub(super) dash_th: f64,
}

/// Three times the spread under changes of the parameters by 0.1 %, 2 % at least.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Tolerances {
    pub(super) slide: f64,
}

/// Slide and corner heights (m) over time (s).
#[derive(Clone, Debug, Deserialize)]
pub(super) struct History {
    t: Vec<f64>,
    slide: Vec<f64>,
    up_l: Vec<f64>,
    up_r: Vec<f64>,
}

/// A case by its name.
pub(super) fn case(name: &str) -> Result<Case, String> {
    #[derive(Deserialize)]
    struct File {
        cases: Vec<Case>,
    }
    let file: File = serde_json::from_str(CASES).map_err(|e| e.to_string())?;
    let found = file.cases.into_iter().find(|c| c.name == name);
    found.ok_or_else(|| format!("no reference `{name}`"))
}

/// The history of a case.
pub(super) fn history(name: &str) -> Result<History, String> {
    #[derive(Deserialize)]
    struct File {
        cases: BTreeMap<String, History>,
    }
    let mut file: File = serde_json::from_str(HISTORIES).map_err(|e| e.to_string())?;
    file.cases.remove(name).ok_or_else(|| format!("no history of `{name}`"))
}

impl Case {
    /// The parameters of the shipped model that runs it.
    pub(super) fn parameters(&self) -> Vec<(&'static str, f64)> {
        let mut all = vec![
            ("height", self.height),
            ("width", self.width),
            ("mass", self.mass),
            ("g", self.g),
            ("mu", self.mu),
            ("kn", self.kn),
            ("ks", self.ks),
            ("cv", self.cv),
            ("cr", self.cth),
            ("duration", self.t_end),
        ];
        if let Motion::Sine { ax, fx, nx, ay, fy, ny } = self.motion {
            all.extend([("ah", ax / self.g), ("av", ay / self.g)]);
            all.extend([("frequency", fx), ("cycles", nx), ("frequency_v", fy), ("cycles_v", ny)]);
        }
        all.extend(self.init.w0.map(|w0| ("uplift0", w0)));
        all
    }

    /// The parameters with contacts that are `factor` times as stiff and have the same restitution.
    pub(super) fn stiffer(&self, factor: f64) -> Vec<(&'static str, f64)> {
        let mut all = self.parameters();
        for (name, value) in &mut all {
            match *name {
                "kn" | "ks" => *value *= factor,
                "cv" => *value *= factor.sqrt(),
                _ => {}
            }
        }
        all
    }
}

impl History {
    /// (time, value) of an output of the shipped models.
    pub(super) fn of(&self, output: &str) -> impl Iterator<Item = (f64, f64)> {
        let values = match output {
            "slide" => &self.slide,
            "uplift_left" => &self.up_l,
            _ => &self.up_r,
        };
        self.t.iter().copied().zip(values.iter().copied())
    }
}
