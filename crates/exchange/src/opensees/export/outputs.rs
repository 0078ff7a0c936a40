//! Outputs as expressions of what OpenSees tells of nodes and elements.

use super::command::number;
use super::freedoms::{Freedoms, row};
use super::{Place, Writer};
use trilith_element::Coordinates;
use trilith_model::{Body, Combine, MemberForce, NodalTerm, Quantity};

/// An output that is written.
pub(super) struct Written {
    /// Index of the output.
    pub index: usize,
    pub name: String,
    pub expression: String,
    /// Nodes whose reactions it takes.
    pub reactions: Vec<i64>,
    pub hidden: bool,
}

/// All that can be said; the others are noted.
pub(super) fn outputs(writer: &mut Writer<'_>, freedoms: &Freedoms) -> Vec<Written> {
    let model = writer.model;
    let mut all: Vec<Written> = Vec::new();
    for (index, output) in model.outputs.iter().enumerate() {
        let done = all.iter().map(|w| w.index).collect::<Vec<_>>();
        match expression(writer, &output.quantity, freedoms, &done) {
            Ok(expression) => {
                let (name, hidden) = (output.name.clone(), output.hidden);
                let reactions = reacting(writer, &output.quantity);
                all.push(Written { index, name, expression, reactions, hidden });
            }
            Err(_) if output.hidden => {}
            Err(why) => writer.losses.note("output", &output.name, why),
        }
    }
    all
}

fn expression(
    writer: &Writer<'_>,
    quantity: &Quantity,
    freedoms: &Freedoms,
    done: &[usize],
) -> Result<String, &'static str> {
    let model = writer.model;
    match quantity {
        Quantity::Displacement(terms) => Ok(nodal(writer, "disp", terms)),
        Quantity::Velocity(terms) => Ok(nodal(writer, "vel", terms)),
        Quantity::Acceleration { terms, absolute } => {
            let mut all = nodal(writer, "accel", terms);
            if *absolute {
                for t in terms.iter().filter(|t| t.dof.index() < 3) {
                    all += &format!(" + {} * ground({}, t)", number(t.factor), t.dof.index());
                }
            }
            Ok(all)
        }
        Quantity::LinkDeformation { element, coordinate, factor } => {
            let (e, axis) = (&model.elements[*element], axis(writer, *element, *coordinate)?);
            if !writer.elements.contains_key(element) {
                return Err("its link is left out");
            }
            let terms = row(writer, e, axis);
            let terms = terms
                .iter()
                .map(|(i, c)| (*c * factor, format!("disp({}, {})", i / 6 + 1, i % 6 + 1)));
            Ok(sum(terms))
        }
        Quantity::LinkForce(terms) => {
            let mut all = Vec::new();
            for t in terms {
                let axis = axis(writer, t.element, t.coordinate)?;
                if !writer.elements.contains_key(&t.element) {
                    return Err("its link is left out");
                }
                let places = writer.forces.get(&(t.element, axis)).map_or(&[][..], |p| p);
                all.extend(places.iter().map(|place| {
                    let said = match place {
                        Place::Material(tag, k) => format!("stress({tag}, {k})"),
                        Place::Basic(tag, k) => format!("basic({tag}, {k})"),
                    };
                    (t.factor, said)
                }));
            }
            Ok(sum(all.into_iter()))
        }
        Quantity::ElementForce { elements, end, dof, factor } => {
            let mut all = Vec::new();
            for index in elements {
                let e = &model.elements[*index];
                let Some(tag) = writer.elements.get(index) else {
                    return Err("its element has no force there");
                };
                if e.kind == "Inerter" {
                    return Err("the force of an inerter is that of its mass");
                }
                // With one node the ground is the first there.
                let end = if e.nodes.len() == 1 { 1 } else { *end };
                all.push((*factor, format!("end({tag}, {})", 6 * end + dof.index())));
            }
            Ok(sum(all.into_iter()))
        }
        Quantity::BaseShear { direction } => {
            let one = |n: i64| (-1.0, format!("reaction({n}, {})", direction.index() + 1));
            Ok(sum(reacting(writer, quantity).into_iter().map(one)))
        }
        Quantity::Reaction { nodes, dof, factor } => {
            let held = nodes.iter().filter(|n| freedoms.held[6 * **n + dof.index()]);
            let one = |n: &usize| {
                (*factor, format!("reaction({}, {})", writer.node(*n), dof.index() + 1))
            };
            Ok(sum(held.map(one)))
        }
        Quantity::MemberForce { element, force, at, factor } => {
            member(writer, *element, *force, *at, *factor)
        }
        Quantity::Combination { how, constant, terms } => {
            if terms.iter().any(|(i, _)| !done.contains(i)) {
                return Err("an output that it is made of is not recorded");
            }
            let values: Vec<(f64, String)> =
                terms.iter().map(|(i, c)| (*c, format!("o{i}"))).collect();
            let listed = || {
                let each = values.iter().map(|(c, o)| format!("{} * {o}", number(*c)));
                each.collect::<Vec<_>>().join(", ")
            };
            Ok(match how {
                Combine::Sum => format!("{} + {}", sum(values.iter().cloned()), number(*constant)),
                Combine::Norm => format!("math.hypot({})", listed()),
                Combine::Largest => format!("max([{}])", listed()),
                Combine::Smallest => format!("min([{}])", listed()),
            })
        }
        Quantity::LinkHistory { .. } => Err("what a law remembers is not told there"),
        Quantity::Overturning { .. } => Err("an overturning moment is not written"),
        Quantity::Derived(_) => Err("it is of another crate"),
    }
}

/// Tags of the nodes whose reactions an output takes.
fn reacting(writer: &Writer<'_>, quantity: &Quantity) -> Vec<i64> {
    let model = writer.model;
    match quantity {
        Quantity::BaseShear { direction } => {
            let held = model.supports.iter().filter(|s| s.fixed[direction.index()]);
            let ground = (1..=writer.ground.len()).map(|k| (model.nodes.len() + k) as i64);
            held.map(|s| writer.node(s.node)).chain(ground).collect()
        }
        Quantity::Reaction { nodes, .. } => nodes.iter().map(|n| writer.node(*n)).collect(),
        _ => Vec::new(),
    }
}

fn nodal(writer: &Writer<'_>, what: &str, terms: &[NodalTerm]) -> String {
    let one = |t: &NodalTerm| {
        (t.factor, format!("{what}({}, {})", writer.node(t.node), t.dof.index() + 1))
    };
    sum(terms.iter().map(one))
}

/// Local axis of a coordinate of a law.
fn axis(writer: &Writer<'_>, element: usize, coordinate: usize) -> Result<usize, &'static str> {
    match &writer.model.elements[element].body {
        Body::Link(law, _) => match law.coordinates() {
            Coordinates::Local(axes) => {
                axes.get(coordinate).map(|a| a.index()).ok_or("a coordinate that is none")
            }
            Coordinates::Nodal { .. } => Err("its link is left out"),
        },
        _ => Err("it is no link"),
    }
}

fn member(
    writer: &Writer<'_>,
    element: usize,
    force: MemberForce,
    at: f64,
    factor: f64,
) -> Result<String, &'static str> {
    let model = writer.model;
    let e = &model.elements[element];
    let loaded = model.patterns.iter().any(|p| p.members.iter().any(|l| l.element == element));
    let heavy = ["density", "distributed_mass"].iter().any(|n| e.values.number(n) > Some(0.0));
    if loaded || heavy {
        return Err("a force inside a member that has a mass or loads is not written");
    }
    let Some(tag) = writer.elements.get(&element).filter(|_| e.kind == "Beam") else {
        return Err("a force inside a beam alone is written");
    };
    // Its forces there are those of the flexible part, which begins behind the rigid one.
    let at = at - e.values.number("offset_i").unwrap_or(0.0);
    let local = |c: f64, i: usize| (c * factor, format!("local({tag}, {i})"));
    Ok(sum(match force {
        MemberForce::N => vec![local(-1.0, 0)],
        MemberForce::V2 => vec![local(-1.0, 1)],
        MemberForce::V3 => vec![local(-1.0, 2)],
        MemberForce::T => vec![local(-1.0, 3)],
        MemberForce::M2 => vec![local(1.0, 4), local(at, 2)],
        MemberForce::M3 => vec![local(-1.0, 5), local(at, 1)],
    }
    .into_iter()))
}

/// A sum of terms with their factors.
fn sum(terms: impl Iterator<Item = (f64, String)>) -> String {
    let mut out = String::new();
    for (c, what) in terms.filter(|(c, _)| *c != 0.0) {
        let sign = match (out.is_empty(), c < 0.0) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        let size = c.abs();
        let factor = if size == 1.0 { String::new() } else { format!("{} * ", number(size)) };
        out += &format!("{sign}{factor}{what}");
    }
    if out.is_empty() { "0.0".into() } else { out }
}
