//! Which hysteresis loops are shown.

use super::data::{Loop, Numbers};
use super::reduce::{numbers, times};
use super::units::shown;
use crate::thin::kept;
use trilith_element::{Coordinates, Dof};
use trilith_model::{Body, Model};
use trilith_results::{LoopPoint, Recorder, Summary};

/// Links whose loops are shown where none are named.
const LINKS: usize = 6;
/// Coordinates of one link.
const COORDINATES: usize = 3;
/// A coordinate is shown where its force does this share of the work of the best one.
const SHARE: f64 = 0.01;
/// Points of a loop: it leaves its line by this share of its size.
const FINE: f64 = 1e-3;

/// The loops of the links named, or of those that dissipate most.
pub(crate) fn chosen(
    model: &Model,
    record: &Recorder,
    summary: &Summary,
    named: &[String],
) -> Vec<Loop> {
    let heat = |name: &str| {
        summary.link_energy.get(name).map_or(0.0, |e| e.hysteretic.abs() + e.viscous.abs())
    };
    let name = |element: usize| model.elements[element].name.as_str();
    let mut links: Vec<(usize, usize)> = record.loops().links().collect();
    if named.is_empty() {
        // Stable: equal links stay in the order of the model.
        links.sort_by(|a, b| heat(name(b.0)).total_cmp(&heat(name(a.0))));
        let most = links.first().map_or(0.0, |l| heat(name(l.0)));
        links.retain(|l| heat(name(l.0)) > 1e-6 * most);
        links.truncate(LINKS);
    } else {
        links.retain(|l| named.iter().any(|n| n == name(l.0)));
        links.sort_by_key(|l| named.iter().position(|n| n == name(l.0)));
    }
    let all = links.into_iter().flat_map(|(e, n)| of_link(model, record, e, n, !named.is_empty()));
    let mut all: Vec<Loop> = all.collect();
    // Loops of one coordinate of one kind have the units of the largest.
    let size = |n: &Numbers| n.values().fold(0.0_f64, |a, x| a.max(x.abs()));
    for i in 0..all.len() {
        let same = |l: &&Loop| (&l.kind, &l.coordinate) == (&all[i].kind, &all[i].coordinate);
        let by = |of: fn(&Loop) -> &Numbers| {
            let most = |a: &&Loop, b: &&Loop| size(of(a)).total_cmp(&size(of(b)));
            all.iter().filter(same).max_by(most)
        };
        let units = (by(|l| &l.d), by(|l| &l.f));
        if let (Some(d), Some(f)) = units {
            all[i].shown = [d.shown[0].clone(), f.shown[1].clone()];
        }
    }
    all
}

/// Size of ∫ f dd: what the force of a coordinate took.
fn work(points: &[LoopPoint]) -> f64 {
    let parts = points.windows(2).map(|w| 0.5 * (w[0].f + w[1].f) * (w[1].d - w[0].d));
    parts.sum::<f64>().abs()
}

/// True where a coordinate moves.
fn moves(points: &[LoopPoint]) -> bool {
    points.first().is_some_and(|first| points.iter().any(|p| p.d != first.d))
}

fn of_link(model: &Model, record: &Recorder, element: usize, n: usize, all: bool) -> Vec<Loop> {
    let e = &model.elements[element];
    let Body::Link(law, _) = &e.body else { return Vec::new() };
    let coordinates = law.coordinates();
    let mut found: Vec<(usize, f64, Vec<LoopPoint>)> = (0..n)
        .map(|k| (k, record.loops().coordinate(element, k).collect::<Vec<_>>()))
        .map(|(k, points)| (k, work(&points), points))
        .collect();
    let most = found.iter().fold(0.0_f64, |a, f| a.max(f.1));
    found.retain(|f| f.2.len() > 2 && moves(&f.2) && (all || f.1 > SHARE * most));
    let mut order: Vec<(usize, f64)> = found.iter().map(|f| (f.0, f.1)).collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1));
    order.truncate(if all { n } else { COORDINATES });
    found.retain(|f| order.iter().any(|o| o.0 == f.0));
    let one = |(k, _, points): (usize, f64, Vec<LoopPoint>)| {
        let (coordinate, turns) = match &coordinates {
            Coordinates::Local(axes) => (axes[k].name().to_owned(), axes[k].index() > 2),
            Coordinates::Nodal { nodes } => {
                let dof = Dof::ALL[k % 6];
                let node = e.nodes.get(k / 6).map_or("", |n| model.nodes[*n].name.as_str());
                let at = if *nodes > 1 { format!("{node} ") } else { String::new() };
                (format!("{at}{}", dof.name()), dof.is_rotation())
            }
        };
        let size =
            |of: fn(&LoopPoint) -> f64| points.iter().fold(0.0_f64, |a, p| a.max(of(p).abs()));
        let (d, f) = (size(|p| p.d), size(|p| p.f));
        let [length, force] = if turns { ["rad", "N·m"] } else { ["m", "N"] };
        let scaled: Vec<(f64, f64)> =
            points.iter().map(|p| (p.d / d.max(1e-300), p.f / f.max(1e-300))).collect();
        let shown_points: Vec<LoopPoint> =
            kept(&scaled, FINE).into_iter().map(|i| points[i]).collect();
        Loop {
            link: e.name.clone(),
            kind: e.kind.to_owned(),
            coordinate,
            shown: [shown(length, d), shown(force, f)],
            t: times(shown_points.iter().map(|p| p.t)),
            d: numbers(shown_points.iter().map(|p| p.d)),
            f: numbers(shown_points.iter().map(|p| p.f)),
        }
    };
    found.into_iter().map(one).collect()
}
