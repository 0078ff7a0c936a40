//! Extremes of forces along members.

use super::data::MemberCurve;
use super::reduce::numbers;
use super::units;
use trilith_model::Model;
use trilith_results::{AlongMember, Recorder, along_members};

/// Members with a figure of each force of an envelope: those with the largest.
const MEMBERS: usize = 12;
/// Forces below this share of the largest of the model are nothing but rounding.
const SHARE: f64 = 1e-9;

fn size(a: &AlongMember) -> f64 {
    a.max.iter().chain(&a.min).fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// The curves, and what was left out.
pub(crate) fn curves(model: &Model, record: &Recorder) -> (Vec<MemberCurve>, Option<String>) {
    let all = along_members(model, record.peaks());
    let largest = |moment: bool| {
        let of = all.iter().filter(|a| a.force.is_moment() == moment);
        of.map(size).fold(0.0, f64::max)
    };
    let (forces, moments) = (largest(false), largest(true));
    let felt =
        |a: &&AlongMember| size(a) > SHARE * if a.force.is_moment() { moments } else { forces };
    let mut kinds: Vec<(&str, trilith_model::MemberForce)> = Vec::new();
    for a in all.iter().filter(felt) {
        if !kinds.contains(&(&a.envelope, a.force)) {
            kinds.push((&a.envelope, a.force));
        }
    }
    let (mut curves, mut left) = (Vec::new(), false);
    for (envelope, force) in kinds {
        let of = all.iter().filter(felt).filter(|a| a.envelope == envelope && a.force == force);
        let mut these: Vec<&AlongMember> = of.collect();
        these.sort_by(|a, b| size(b).total_cmp(&size(a)));
        left |= these.len() > MEMBERS;
        these.truncate(MEMBERS);
        let unit = if force.is_moment() { "N·m" } else { "N" };
        let shown = units::shown(unit, these.first().map_or(0.0, |a| size(a)));
        curves.extend(these.into_iter().map(|a| MemberCurve {
            envelope: a.envelope.clone(),
            member: a.element.clone(),
            force: force.name().to_owned(),
            shown: shown.clone(),
            at: numbers(a.at.iter().copied()),
            max: numbers(a.max.iter().copied()),
            min: numbers(a.min.iter().copied()),
        }));
    }
    let note = format!(
        "Figures of forces along members show the {MEMBERS} members with the largest; all are in envelopes.csv."
    );
    (curves, left.then_some(note))
}
