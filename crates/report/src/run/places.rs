//! Outputs that belong together: of one kind at several places, over the height, along both directions of one place.

use super::data::{Family, Orbit, Profile, ProfileCurve};
use super::picture::family_at_rest;
use super::reduce::{numbers, times};
use super::units::shown;
use crate::thin::kept;
use trilith_element::{Coordinates, Dof};
use trilith_model::{Body, Combine, Element, Model, NodalTerm, Output, Quantity, Support};
use trilith_results::{Peak, Recorder, Summary};

/// Orbits shown at most.
const ORBITS: usize = 9;
/// Points of an orbit leave its line by this share of its size.
const FINE: f64 = 1e-3;
/// An orbit is wide: its smaller side is this share of the larger one at least.
const WIDE: f64 = 1e-3;

/// The same on every axis: `displacement X`, `LeadRubber U2 force`; outputs of one kind compare. Empty for what stands
/// alone.
pub(crate) fn kind(model: &Model, output: &Output) -> String {
    let element = |e: usize| model.elements.get(e);
    match &output.quantity {
        Quantity::Displacement(terms) => match (&terms[..], drift(model, terms)) {
            ([one], _) => format!("displacement {}", one.dof.name()),
            (_, Some(_)) => format!("drift {}", terms[0].dof.name()),
            _ => String::new(),
        },
        Quantity::Velocity(terms) if terms.len() == 1 => {
            format!("velocity {}", terms[0].dof.name())
        }
        Quantity::Acceleration { terms, absolute } if terms.len() == 1 => {
            let absolute = if *absolute { "" } else { "relative " };
            format!("{absolute}acceleration {}", terms[0].dof.name())
        }
        Quantity::LinkDeformation { element: e, coordinate, .. } => match element(*e) {
            Some(link) => format!("{} {} deformation", link.kind, axis(model, *e, *coordinate)),
            None => String::new(),
        },
        Quantity::LinkForce(terms) => {
            match terms.first().and_then(|t| Some((t, element(t.element)?))) {
                Some((t, link)) if terms.len() == 1 => {
                    format!("{} {} force", link.kind, axis(model, t.element, t.coordinate))
                }
                _ => String::new(),
            }
        }
        Quantity::LinkHistory { element: e, field } => element(*e)
            .map_or_else(String::new, |link| {
                format!("{} {}", link.kind, variable(model, *e, *field))
            }),
        Quantity::ElementForce { end, dof, .. } => format!("force at end {end} {}", dof.name()),
        _ => String::new(),
    }
}

/// Name of a coordinate of a link.
fn axis(model: &Model, element: usize, coordinate: usize) -> String {
    let Body::Link(law, _) = &model.elements[element].body else { return String::new() };
    match law.coordinates() {
        Coordinates::Local(axes) => {
            axes.get(coordinate).map_or(String::new(), |a| a.name().to_owned())
        }
        Coordinates::Nodal { .. } => Dof::ALL[coordinate % 6].name().to_owned(),
    }
}

/// Name of a history variable of a link.
pub(crate) fn variable(model: &Model, element: usize, field: usize) -> String {
    match model.elements.get(element).map(|e| &e.body) {
        Some(Body::Link(law, _)) => {
            law.history().get(field).map_or(String::new(), |f| f.name.to_string())
        }
        _ => String::new(),
    }
}

/// The heights between which the difference of a horizontal displacement of two nodes is taken, m, low first.
pub(crate) fn drift(model: &Model, terms: &[NodalTerm]) -> Option<(f64, f64)> {
    let [a, b] = terms else { return None };
    let across = a.dof == b.dof && matches!(a.dof, Dof::Ux | Dof::Uy) && a.factor == -b.factor;
    let z = |t: &NodalTerm| model.nodes.get(t.node).map(|n| n.position[2]);
    let (a, b) = (z(a)?, z(b)?);
    (across && a != b).then_some((a.min(b), a.max(b)))
}

/// Largest magnitude of an output.
fn size(peak: &Peak) -> f64 {
    peak.max.abs().max(peak.min.abs())
}

/// What is drawn over the height of a structure: drifts, absolute accelerations, displacements.
pub(crate) fn profiles(model: &Model, summary: &Summary, ground: &[super::Ground]) -> Vec<Profile> {
    let mut all: Vec<Profile> = Vec::new();
    for output in &model.outputs {
        let Some(peak) = summary.outputs.get(&output.name).and_then(|o| o.peak.as_ref()) else {
            continue;
        };
        let (what, term, heights, value) = match &output.quantity {
            Quantity::Displacement(terms) => match (drift(model, terms), &terms[..]) {
                (Some((low, high)), [a, b]) => {
                    let of = |t: &NodalTerm| model.nodes[t.node].position[2];
                    let upper = if of(a) > of(b) { a } else { b };
                    (DRIFT, *upper, (low, high), size(peak) / (a.factor.abs() * (high - low)))
                }
                (None, [one]) => level(model, "displacement", one, peak),
                _ => continue,
            },
            Quantity::Acceleration { terms, absolute: true } if terms.len() == 1 => {
                level(model, ACCELERATION, &terms[0], peak)
            }
            _ => continue,
        };
        if !matches!(term.dof, Dof::Ux | Dof::Uy) || !value.is_finite() {
            continue;
        }
        let place = model.nodes[term.node].position;
        let profile = match all.iter().position(|p| p.quantity == what) {
            Some(i) => &mut all[i],
            None => {
                all.push(Profile { quantity: what.into(), ..Profile::default() });
                all.last_mut().expect("just pushed")
            }
        };
        let direction = term.dof.name().trim_start_matches(['U', 'u']).to_uppercase();
        let here = |c: &ProfileCurve| {
            c.direction == direction && (0..2).all(|i| (c.place[i] - place[i]).abs() < 1e-6)
        };
        let curve = match profile.curves.iter().position(here) {
            Some(i) => &mut profile.curves[i],
            None => {
                let place = [place[0], place[1]];
                profile.curves.push(ProfileCurve { direction, place, ..ProfileCurve::default() });
                profile.curves.last_mut().expect("just pushed")
            }
        };
        // A place that is told twice counts once.
        if !curve.from.contains(&heights.0) || what != DRIFT && !curve.to.contains(&heights.1) {
            curve.from.push(heights.0);
            curve.to.push(heights.1);
            curve.value.push(value);
        }
    }
    for profile in &mut all {
        for curve in &mut profile.curves {
            if profile.quantity == ACCELERATION {
                add_ground(curve, ground, model);
            }
            let mut order: Vec<usize> = (0..curve.to.len()).collect();
            order.sort_by(|a, b| curve.to[*a].total_cmp(&curve.to[*b]));
            let sorted = |values: &[f64]| order.iter().map(|i| values[*i]).collect();
            (curve.from, curve.to, curve.value) =
                (sorted(&curve.from), sorted(&curve.to), sorted(&curve.value));
        }
        profile.curves.retain(|c| c.to.len() > 1);
        let most = profile.curves.iter().flat_map(|c| &c.value).fold(0.0, |a: f64, v| a.max(*v));
        profile.curves.retain(|c| c.value.iter().any(|v| *v > 1e-9 * most));
        let unit = if profile.quantity == DRIFT {
            "1"
        } else if profile.quantity == ACCELERATION {
            "m/s^2"
        } else {
            "m"
        };
        profile.shown = match profile.quantity.as_str() {
            DRIFT => super::Shown { unit: "%".into(), factor: 100.0 },
            ACCELERATION => {
                super::Shown { unit: "g".into(), factor: 1.0 / trilith_model::STANDARD_GRAVITY }
            }
            _ => shown(unit, most),
        };
    }
    all.retain(|p| !p.curves.is_empty());
    all
}

const DRIFT: &str = "drift";
const ACCELERATION: &str = "acceleration";

/// A value at one height.
fn level<'a>(
    model: &Model,
    what: &'a str,
    term: &NodalTerm,
    peak: &Peak,
) -> (&'a str, NodalTerm, (f64, f64), f64) {
    let z = model.nodes[term.node].position[2];
    (what, *term, (z, z), size(peak) / term.factor.abs())
}

/// The ground under the floors: its acceleration, where the structure stands.
fn add_ground(curve: &mut ProfileCurve, ground: &[super::Ground], model: &Model) {
    let name = format!("ground acceleration {}", curve.direction);
    let Some(motion) = ground.iter().find(|g| g.history.name == name) else { return };
    let low = model.nodes.iter().map(|n| n.position[2]).fold(f64::INFINITY, f64::min);
    if curve.to.iter().all(|z| *z > low) {
        curve.from.push(low);
        curve.to.push(low);
        curve.value.push(motion.peak.abs());
    }
}

/// What makes the second direction of a place; none for what has only one.
fn beside(model: &Model, a: &Output, b: &Output) -> bool {
    let turned = |a: &NodalTerm, b: &NodalTerm| {
        a.node == b.node && a.factor == b.factor && (a.dof, b.dof) == (Dof::Ux, Dof::Uy)
    };
    let links = |e: (usize, usize), c: (usize, usize)| {
        e.0 == e.1
            && (axis(model, e.0, c.0).as_str(), axis(model, e.1, c.1).as_str()) == ("U2", "U3")
    };
    match (&a.quantity, &b.quantity) {
        (Quantity::Displacement(p), Quantity::Displacement(q)) => {
            p.len() == q.len() && p.iter().zip(q).all(|(a, b)| turned(a, b))
        }
        (
            Quantity::Acceleration { terms: p, absolute: x },
            Quantity::Acceleration { terms: q, absolute: y },
        ) => x == y && p.len() == q.len() && p.iter().zip(q).all(|(a, b)| turned(a, b)),
        (
            Quantity::LinkDeformation { element: e, coordinate: c, factor: f },
            Quantity::LinkDeformation { element: g, coordinate: d, factor: h },
        ) => f == h && links((*e, *g), (*c, *d)),
        (Quantity::LinkForce(p), Quantity::LinkForce(q)) => match (&p[..], &q[..]) {
            ([a], [b]) => {
                a.factor == b.factor && links((a.element, b.element), (a.coordinate, b.coordinate))
            }
            _ => false,
        },
        (
            Quantity::LinkHistory { element: e, field: f },
            Quantity::LinkHistory { element: g, field: h },
        ) => {
            let (first, second) = (variable(model, *e, *f), variable(model, *g, *h));
            let stem = first.strip_suffix('1');
            e == g && stem.is_some() && stem == second.strip_suffix('2')
        }
        _ => false,
    }
}

/// Paths in plan: outputs along X and Y, or along both shear axes of a link, against each other.
pub(crate) fn orbits(model: &Model, record: &Recorder) -> Vec<Orbit> {
    let mut all = Vec::new();
    for (i, a) in model.outputs.iter().enumerate() {
        let second = model.outputs.iter().enumerate().find(|(_, b)| beside(model, a, b));
        let Some((j, b)) = second else { continue };
        let (Some(x), Some(y)) = (record.history(i), record.history(j)) else { continue };
        let t = record.time();
        if x.len() != t.len() || y.len() != t.len() || t.len() < 3 {
            continue;
        }
        let most = |v: &[f64]| v.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        let (wide, tall) = (most(x), most(y));
        if wide.min(tall) <= WIDE * wide.max(tall) {
            continue;
        }
        let size = wide.max(tall);
        let points: Vec<(f64, f64)> = x.iter().zip(y).map(|(x, y)| (x / size, y / size)).collect();
        let kept = kept(&points, FINE);
        all.push(Orbit {
            names: [a.name.clone(), b.name.clone()],
            shown: shown(&a.unit, size),
            t: times(kept.iter().map(|k| t[*k])),
            x: numbers(kept.iter().map(|k| x[*k])),
            y: numbers(kept.iter().map(|k| y[*k])),
        });
        if all.len() == ORBITS {
            break;
        }
    }
    all
}

/// How far a link that carries a structure on the ground has moved sideways: element, largest distance, its time, and
/// the distance at the end; none for other links.
pub(crate) fn isolation(
    model: &Model,
    record: &Recorder,
    element: usize,
) -> Option<(usize, f64, f64, f64)> {
    let e = model.elements.get(element).filter(|e| e.nodes.len() == 1)?;
    let Body::Link(law, _) = &e.body else { return None };
    let Coordinates::Local(axes) = law.coordinates() else { return None };
    // By itself, or beside a support or a spring that does.
    let carries = axes.iter().any(|a| a.name() == "U1") || is_carried(model, e.nodes[0]);
    let carries = carries && e.frame.0[0][2].abs() > 0.9;
    let holds = [Family::Hysteretic, Family::Spring].contains(&family_at_rest(law.as_ref()));
    let across: Vec<usize> =
        (0..axes.len()).filter(|k| ["U2", "U3"].contains(&axes[*k].name())).collect();
    if !carries || !holds || across.is_empty() {
        return None;
    }
    let mut way: Vec<(f64, f64)> = Vec::new();
    for k in across {
        for (i, p) in record.loops().coordinate(element, k).enumerate() {
            match way.get_mut(i) {
                Some(at) => at.1 += p.d * p.d,
                None => way.push((p.t, p.d * p.d)),
            }
        }
    }
    let most = way.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((element, most.1.sqrt(), most.0, way.last()?.1.sqrt()))
}

/// True for a node that a support or a spring to the ground holds vertically.
fn is_carried(model: &Model, node: usize) -> bool {
    let spring = |e: &Element| e.kind == "Spring" && e.nodes == [node];
    let support = |s: &Support| s.node == node && s.fixed[2];
    model.supports.iter().any(support) || model.elements.iter().any(spring)
}

/// Which outputs are what is left between two things: a length at rest and how it changes, its size in several directions,
/// what sizes leave of it, the smallest of several.
pub(crate) fn distances(all: &[Output]) -> Vec<bool> {
    let mut found: Vec<bool> = Vec::with_capacity(all.len());
    for output in all {
        // Parts stand before what is made of them.
        let part = |(of, factor): &(usize, f64)| *factor > 0.0 && found.get(*of) == Some(&true);
        found.push(match &output.quantity {
            Quantity::Combination { how, constant, terms } if output.unit == "m" => match how {
                Combine::Sum => *constant > 0.0 || terms.iter().any(part),
                Combine::Norm => terms.iter().any(part),
                Combine::Smallest => !terms.is_empty() && terms.iter().all(part),
                Combine::Largest => false,
            },
            _ => false,
        });
    }
    found
}

/// True for 1 − tilt/limit: what is left until a body overturns.
pub(crate) fn is_margin(model: &Model, output: &Output) -> bool {
    let Quantity::Combination { how: Combine::Sum, constant, terms } = &output.quantity else {
        return false;
    };
    let [(of, factor)] = terms[..] else { return false };
    let tilt = |o: &Output| matches!(o.quantity, Quantity::LinkHistory { element, field } if variable(model, element, field) == "tilt");
    *constant == 1.0 && factor < 0.0 && model.outputs.get(of).is_some_and(tilt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_at_rest_and_how_it_changes_is_a_distance() {
        let output = |unit: &str, quantity: Quantity| Output {
            name: String::new(),
            unit: unit.into(),
            quantity,
            hidden: false,
        };
        let made = |how: Combine, constant: f64, of: &[(usize, f64)]| {
            output("m", Quantity::Combination { how, constant, terms: of.to_vec() })
        };
        let all = [
            output("m", Quantity::Displacement(Vec::new())),
            made(Combine::Sum, 0.05, &[(0, 1.0)]),
            made(Combine::Sum, 0.0, &[(0, 1.0)]),
            made(Combine::Norm, 0.0, &[(1, 1.0), (2, 1.0)]),
            made(Combine::Sum, -0.04, &[(3, 1.0)]),
            made(Combine::Smallest, 0.0, &[(1, 1.0), (4, 1.0)]),
            made(Combine::Smallest, 0.0, &[(0, 1.0), (4, 1.0)]),
            made(Combine::Largest, 0.0, &[(1, 1.0), (4, 1.0)]),
            made(Combine::Norm, 0.0, &[(0, 1.0), (2, 1.0)]),
        ];
        let wanted = [false, true, false, true, true, true, false, false, false];
        assert_eq!(distances(&all), wanted);
        let turned = output("rad", all[1].quantity.clone());
        assert_eq!(distances(&[all[0].clone(), turned]), [false, false]);
    }
}
