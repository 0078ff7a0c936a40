//! From model and record to what the page shows.

use super::data::{Frames, Mode, Numbers, RunData, RunIdentity};
use super::figures::SUPPLY;
use super::picture::Sketch;
use super::{Sections, answers, choice, loops, members, places, reduce, settings, shaking, tints};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use trilith_model::Model;
use trilith_results::{ENERGIES, Frame, Recorder, Summary, ground_motions};
use trilith_solvers::{BasisReport, LinearModes, Linearised, StartEnergy};

/// Modes with links that are shown.
const LINKED: usize = 6;

/// Steps of a displacement, of the largest.
const STEPS: f64 = 3e4;
/// Displacements kept at most, over all frames.
const ROOM: usize = 380_000;

/// What a run left, to be put together for its report.
#[derive(Clone, Copy, Debug)]
pub struct Collect<'a> {
    /// The model.
    pub model: &'a Model,
    /// Index of the case.
    pub case: usize,
    /// Output step that ran, s.
    pub dt: Option<f64>,
    /// What was recorded.
    pub record: &'a Recorder,
    /// The summary.
    pub summary: &'a Summary,
    /// Weight of all masses that can move, N; 0 where it is not known.
    pub weight: f64,
    /// Modes of the structure, where they are known.
    pub modes: Option<&'a BasisReport>,
    /// Modes with engaged links, where links are stiff and the modes are known.
    pub linked: Option<(&'a Linearised<'a>, &'a LinearModes)>,
    /// Parameters given on the command line.
    pub overrides: &'a [(String, String)],
    /// Links whose loops are wanted, by name; empty: those that dissipate most.
    pub loops: &'a [String],
    /// Sections of the page that are wanted: what only others show is left out.
    pub sections: &'a Sections,
}

/// What is made where it is wanted.
fn some<T: Default>(wanted: bool, make: impl FnOnce() -> T) -> T {
    if wanted { make() } else { T::default() }
}

impl Collect<'_> {
    /// Puts it together.
    #[must_use]
    pub fn data(&self) -> RunData {
        let sketch = Sketch::new(self.model);
        let mut notes: Vec<String> = sketch.note.iter().cloned().collect();
        let file = self.model.source.path.file_name();
        let has = |id| self.sections.have(id);
        let outputs = self.model.shown().count();
        let shown = self.chosen();
        let count = shown.iter().filter(|s| **s).count();
        if count < outputs {
            notes.push(format!(
                "Tables and figures show {count} of {outputs} outputs: the first of the file and the largest. All peaks \
                 are in peaks.csv, all histories in histories.csv and .npz."
            ));
        }
        // Profiles of accelerations begin at the ground.
        let motions = some(has("ground") || has("profiles"), || {
            ground_motions(self.model, self.case, self.dt.unwrap_or(0.0))
        });
        let ground = shaking::ground(&motions);
        let loops =
            some(has("loops"), || loops::chosen(self.model, self.record, self.summary, self.loops));
        let with_figure = self.model.shown().zip(&shown).filter(|(_, s)| **s).map(|((i, _), _)| i);
        let tints = tints::tints(self.model, &sketch.marks, &sketch.picture, with_figure, &loops);
        let (members, left_out) = members::curves(self.model, self.record);
        notes.extend(left_out);
        let frames = some(has("motion"), || self.frames(&sketch));
        let modes = some(has("modes"), || self.modes(&sketch));
        let free = self.modes.map_or(0, |m| m.omega.iter().filter(|omega| **omega <= 0.0).count());
        RunData {
            format: RunData::FORMAT,
            run: RunIdentity::of(self.summary),
            file: file.map_or(String::new(), |f| f.to_string_lossy().into_owned()),
            parameters: settings::parameters(self.model),
            overrides: self.overrides.to_vec(),
            answers: answers::answers(&answers::Seen {
                model: self.model,
                summary: self.summary,
                record: self.record,
                modes: self.modes,
                weight: self.weight,
            }),
            settings: settings::of_case(self.model, self.case, self.summary.solver, self.dt),
            picture: sketch.picture,
            tints,
            frames,
            outputs: self.model.shown().map(|(_, o)| o.name.clone()).collect(),
            profiles: some(self.summary.contact.is_none() && has("profiles"), || {
                places::profiles(self.model, self.summary, &ground)
            }),
            members: some(has("members"), || members),
            orbits: some(has("plan"), || places::orbits(self.model, self.record)),
            ground,
            ground_spectra: some(has("ground"), || shaking::ground_spectra(&motions)),
            histories: some(has("histories"), || self.histories(&shown)),
            floor_spectra: some(has("floors"), || shaking::floor_spectra(self.summary)),
            energies: some(has("energy"), || self.energies()),
            loops,
            modes,
            free_modes: free,
            notes,
        }
    }

    /// Whether each output has a figure.
    fn chosen(&self) -> Vec<bool> {
        let sizes: Vec<(&str, f64)> = self
            .model
            .shown()
            .map(|(_, o)| {
                let peak = self.summary.outputs.get(&o.name).and_then(|s| s.peak.as_ref());
                let size = peak.map_or(0.0, |p| p.max.abs().max(p.min.abs()).max(p.last.abs()));
                (o.unit.as_str(), size)
            })
            .collect();
        choice::chosen(&sizes)
    }

    fn histories(&self, shown: &[bool]) -> Vec<super::History> {
        let t = self.record.time();
        let outputs = self.model.shown().zip(shown).filter(|(_, shown)| **shown);
        let mut all: Vec<super::History> = outputs
            .filter_map(|((i, o), _)| {
                let y = self.record.history(i).filter(|y| y.len() == t.len() && y.len() > 1)?;
                let kind = places::kind(self.model, o);
                Some(super::History { kind, ..reduce::history(o.name.clone(), &o.unit, t, y) })
            })
            .collect();
        // One unit for all of a kind, so that they can be compared.
        let size = |h: &super::History| h.y.values().fold(0.0_f64, |a, y| a.max(y.abs()));
        let mut largest: BTreeMap<String, (f64, super::Shown)> = BTreeMap::new();
        for h in all.iter().filter(|h| !h.kind.is_empty()) {
            let best = largest.entry(h.kind.clone()).or_insert((-1.0, h.shown.clone()));
            if size(h) > best.0 {
                *best = (size(h), h.shown.clone());
            }
        }
        for h in &mut all {
            if let Some((_, shown)) = largest.get(&h.kind) {
                h.shown = shown.clone();
            }
        }
        all
    }

    fn energies(&self) -> Vec<super::History> {
        let t = self.record.time();
        let columns = ENERGIES.iter().zip(self.record.energy());
        let whole = columns.filter(|(_, e)| e.len() == t.len() && e.len() > 1);
        let one = |name: &str, e: &[f64]| reduce::history(name.to_owned(), "J", t, e);
        let mut all: Vec<_> = whole.map(|(name, e)| one(name, e)).collect();
        // What all others make together.
        let StartEnergy { kinetic, strain, link_stored } = self.summary.energy.start;
        let start = kinetic + strain + link_stored;
        let input = ENERGIES.iter().zip(self.record.energy()).find(|(name, _)| **name == "input");
        if let Some((_, input)) = input.filter(|(_, e)| e.len() == t.len() && e.len() > 1) {
            let sum: Vec<f64> = input.iter().map(|e| start + e).collect();
            all.push(one(SUPPLY, &sum));
        }
        // One unit for all, so that they can be stacked.
        let largest = all.iter().flat_map(|h| h.y.values()).fold(0.0_f64, |a, x| a.max(x.abs()));
        let one = super::units::shown("J", largest);
        all.iter_mut().for_each(|h| h.shown = one.clone());
        all
    }

    fn frames(&self, sketch: &Sketch) -> Frames {
        let all: Vec<&Frame> = self.record.frames().iter().collect();
        let room = (ROOM / (3 * sketch.picture.points.len()).max(1)).max(2);
        let stride = all.len().div_ceil(room).max(1);
        let last = all.len().saturating_sub(1);
        let kept: Vec<&Frame> = all
            .iter()
            .enumerate()
            .filter(|(i, _)| i % stride == 0 || *i == last)
            .map(|(_, f)| *f)
            .collect();
        let moved: Vec<f64> =
            kept.iter().flat_map(|f| sketch.moved(&f.displacements, &f.outlines)).collect();
        Frames {
            t: kept.iter().map(|f| f.t).collect(),
            u: Numbers::new(moved.iter().copied(), STEPS),
        }
    }

    fn modes(&self, sketch: &Sketch) -> Vec<Mode> {
        let mode = |with_links, number, omega: f64, participation, displacements: &[f32]| Mode {
            with_links,
            number,
            frequency: omega / TAU,
            participation,
            u: Numbers::new(sketch.moved(displacements, &[]).iter().copied(), 1e3),
        };
        let mut all = Vec::new();
        if let Some((linear, modes)) = self.linked {
            let holds = modes.omega2.iter().enumerate().filter(|(_, w)| **w > 0.0).take(LINKED);
            all.extend(holds.map(|(j, w)| {
                let at_nodes = linear.at_nodes(modes.shapes.column(j));
                mode(true, j + 1, w.sqrt(), modes.mass_share[j], &at_nodes)
            }));
        }
        let Some(report) = self.modes else { return all };
        all.extend(report.shapes.iter().filter_map(|shape| {
            let omega = *report.omega.get(shape.mode)?;
            let share = *report.mass_participation.get(shape.mode)?;
            Some(mode(false, shape.mode + 1, omega, share, &shape.displacements))
        }));
        all
    }
}
