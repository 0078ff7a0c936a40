//! Envelopes of forces along members: `envelopes.csv`, and the extremes of each in the summary.

use crate::{FileError, Named, Peak};
use serde::Serialize;
use std::path::Path;
use trilith_model::{MemberForce, Model};
use trilith_record::cell;

/// The extremes of one force over the members and stations of an envelope.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ForceEnvelope {
    /// SI unit.
    pub unit: &'static str,
    /// The largest value.
    pub max: Extreme,
    /// The smallest value.
    pub min: Extreme,
}

/// An extreme over time and along members.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Extreme {
    /// N or N·m.
    pub value: f64,
    /// Name of the element.
    pub element: String,
    /// Distance from its first node, m.
    pub at: f64,
    /// When, s.
    pub t: f64,
}

/// One value of an envelope: a force at a station of a member.
struct Value<'a> {
    envelope: &'a str,
    element: &'a str,
    at: f64,
    force: MemberForce,
    peak: Peak,
}

/// All values in the order of the model; none where nothing was recorded.
fn values<'a>(model: &'a Model, peaks: &'a [Peak]) -> impl Iterator<Item = Value<'a>> {
    model.envelopes.iter().flat_map(move |envelope| {
        envelope.members.iter().flat_map(move |member| {
            let each =
                member.stations.iter().flat_map(|at| member.forces.iter().map(|f| (*at, *f)));
            each.enumerate().filter_map(move |(i, (at, force))| {
                let peak = *peaks.get(member.first + i)?;
                let element = &model.elements.get(member.element)?.name;
                Some(Value { envelope: &envelope.name, element, at, force, peak })
            })
        })
    })
}

/// Extremes over time of one force along one member.
#[derive(Clone, Debug, PartialEq)]
pub struct AlongMember {
    /// Name of the envelope in the model.
    pub envelope: String,
    /// Name of the element.
    pub element: String,
    /// Which force.
    pub force: MemberForce,
    /// Stations: distances from the first node, m.
    pub at: Vec<f64>,
    /// Largest values there, N or N·m.
    pub max: Vec<f64>,
    /// Smallest values there.
    pub min: Vec<f64>,
}

/// The envelopes of a model, member by member and force by force; `peaks` as the run has recorded them.
#[must_use]
pub fn along_members(model: &Model, peaks: &[Peak]) -> Vec<AlongMember> {
    let mut all: Vec<AlongMember> = Vec::new();
    // Where the member begins that the values are of: its forces take turns at each station.
    let mut first = 0;
    for Value { envelope, element, at, force, peak } in values(model, peaks) {
        if all.get(first).is_none_or(|a| a.envelope != envelope || a.element != element) {
            first = all.len();
        }
        let known = all[first..].iter().position(|a| a.force == force);
        let index = known.map_or(all.len(), |i| first + i);
        if known.is_none() {
            let (envelope, element) = (envelope.to_owned(), element.to_owned());
            let (at, max, min) = (Vec::new(), Vec::new(), Vec::new());
            all.push(AlongMember { envelope, element, force, at, max, min });
        }
        let along = &mut all[index];
        along.at.push(at);
        along.max.push(peak.max);
        along.min.push(peak.min);
    }
    all
}

fn unit(force: MemberForce) -> &'static str {
    if force.is_moment() { "N·m" } else { "N" }
}

/// The extremes of every envelope, by its name and that of the force.
pub(crate) fn extremes(model: &Model, peaks: &[Peak]) -> Named<Named<ForceEnvelope>> {
    let mut all: Vec<(String, Named<ForceEnvelope>)> = Vec::new();
    for Value { envelope, element, at, force, peak } in values(model, peaks) {
        if all.last().is_none_or(|(name, _)| name != envelope) {
            all.push((envelope.to_owned(), Named(Vec::new())));
        }
        let Some((_, Named(forces))) = all.last_mut() else { continue };
        let extreme = |value: f64, t: f64| Extreme { value, element: element.to_owned(), at, t };
        let (max, min) = (extreme(peak.max, peak.t_max), extreme(peak.min, peak.t_min));
        match forces.iter_mut().find(|(name, _)| name == force.name()) {
            None => {
                let unit = unit(force);
                forces.push((force.name().to_owned(), ForceEnvelope { unit, max, min }));
            }
            Some((_, known)) => {
                if max.value > known.max.value {
                    known.max = max;
                }
                if min.value < known.min.value {
                    known.min = min;
                }
            }
        }
    }
    Named(all)
}

/// Writes a line for each force at each station, in the order of the model, in SI.
pub(crate) fn write(path: &Path, model: &Model, peaks: &[Peak]) -> Result<(), FileError> {
    let fail = |e: csv::Error| FileError::at(path)(e);
    let mut file = csv::Writer::from_path(path).map_err(fail)?;
    let head = [
        "envelope",
        "element",
        "station [m]",
        "force",
        "unit",
        "max",
        "t_max [s]",
        "min",
        "t_min [s]",
        "final",
    ];
    file.write_record(head).map_err(fail)?;
    for v in values(model, peaks) {
        let p = v.peak;
        let texts = [cell(v.envelope).into_owned(), cell(v.element).into_owned()];
        let names = [v.force.name().to_owned(), unit(v.force).to_owned()];
        let numbers = [p.max, p.t_max, p.min, p.t_min, p.last].map(|x| format!("{x:?}"));
        let row = texts.into_iter().chain([format!("{:?}", v.at)]).chain(names).chain(numbers);
        file.write_record(row).map_err(fail)?;
    }
    file.flush().map_err(FileError::at(path))
}
