//! Loads along members, and places along them.

use super::context::{Context, Fields};
use super::groups::several;
use super::names::Names;
use crate::schema::{self, Block};
use crate::tree::Node;
use crate::{Body, Element, MemberLoad, Span};
use trilith_element::dimension::{FORCE, LENGTH, MOMENT, NONE, STIFFNESS};
use trilith_element::{Axis, Dimension, Geometry, Member, SpanLoad, Vector3, cross, norm, sub};

/// Share of the length by which a place may lie beyond the end: rounding.
const BEYOND: f64 = 1e-9;

/// The elements of a model among which members are looked for.
pub(super) struct Members<'c, 'n> {
    pub names: &'c Names<'n>,
    pub elements: &'c [Option<Element>],
    pub nodes: &'c [Option<crate::Node>],
}

/// A member and where it stands.
pub(super) struct Found<'c> {
    pub index: usize,
    pub element: &'c Element,
    member: &'c dyn Member,
    places: [Vector3; 2],
}

impl Found<'_> {
    /// From node to node, m.
    pub fn length(&self) -> f64 {
        norm(sub(self.places[1], self.places[0]))
    }

    /// Where it stands, without P-Δ.
    fn geometry(&self) -> Geometry<'_> {
        Geometry::new(&self.places, self.element.frame)
    }
}

/// Which way a load acts, in local axes: forces and moments.
struct Way {
    local: [f64; 6],
    turns: bool,
    /// Global direction, where that is what the file gives.
    global: Option<Vector3>,
}

impl<'c> Members<'c, '_> {
    /// A member by its index; an element that is none is reported.
    pub fn find(&self, c: &Context<'_>, index: usize, at: &Span) -> Option<Found<'c>> {
        let element = self.elements.get(index)?.as_ref()?;
        let member = match &element.body {
            Body::Linear(e) => e.member(),
            _ => None,
        };
        let Some(member) = member else {
            let message = format!("`{}` ({}) is no member", element.name, element.kind);
            let d = c.diagnostic("E0106", message, at.clone());
            c.report(d.help("name a `Beam` or a `Truss`"));
            return None;
        };
        let [i, j] = element.nodes[..] else { return None };
        let place = |i: usize| self.nodes.get(i)?.as_ref().map(|n| n.position);
        Some(Found { index, element, member, places: [place(i)?, place(j)?] })
    }

    /// The members that a field names.
    pub fn several(&self, c: &Context<'_>, fields: &Fields<'_>) -> Option<Vec<(Found<'c>, Span)>> {
        let all = several(c, fields.required(c, "element")?, self.names)?;
        let all: Vec<_> =
            all.into_iter().map(|(i, at)| Some((self.find(c, i, &at)?, at))).collect();
        all.into_iter().collect()
    }

    /// A load along a member, or along each of several.
    pub fn loads(&self, c: &Context<'_>, node: &Node, what: &str) -> Option<Vec<MemberLoad>> {
        let block = c.one_of(node, "load", &schema::LOADINGS)?;
        let what = format!("`{}` of {what}", block.name);
        let fields = c.block(node, &what, block)?;
        let found = self.several(c, &fields);
        let mut all = Vec::new();
        for (member, at) in found? {
            for load in load(c, &fields, block, &what, &member)? {
                if let Err(error) = member.member.end_loads(&member.geometry(), &load) {
                    let message = format!("{what} on `{}`: {error}", member.element.name);
                    c.report(c.diagnostic("E0114", message, at));
                    return None;
                }
                all.push(MemberLoad { element: member.index, load });
            }
        }
        Some(all)
    }
}

/// A place along a member of this length, m: a distance from the first node, or a share.
pub(super) fn place(c: &Context<'_>, node: &Node, name: &str, length: f64) -> Option<f64> {
    let q = c.quantity(node)?;
    let x = match q.measured && q.dimension.matches(NONE) {
        true => q.value * length,
        false => c.in_dimension(node, q, LENGTH)?,
    };
    if x >= -BEYOND * length && x <= length * (1.0 + BEYOND) {
        return Some(x.clamp(0.0, length));
    }
    let message = format!("`{name}` = {x} m: must be between 0 and {length} m, on the member");
    let d = c.diagnostic("E0112", message, node.span.clone());
    c.report(d.help("a distance from the first node, or a share such as \"50 %\""));
    None
}

fn load(
    c: &Context<'_>,
    fields: &Fields<'_>,
    block: &'static Block,
    what: &str,
    member: &Found<'_>,
) -> Option<Vec<SpanLoad>> {
    let length = member.length();
    let place = |key: &str, without: f64| {
        fields.get(key).map_or(Some(without), |n| place(c, n, key, length))
    };
    if block.name == schema::TEMPERATURE.name {
        let rise = fields.number(c, "rise");
        let gradients = ["gradient_2", "gradient_3"].map(|key| fields.number(c, key));
        let [a, b] = gradients;
        return Some(vec![SpanLoad::Warmth { rise: rise?, gradients: [a?, b?] }]);
    }
    let way = way(c, fields, what, member)?;
    if block.name == schema::POINT.name {
        let size = size(c, fields, what, &way, [FORCE, MOMENT]);
        let at = fields.required(c, "at").and_then(|_| place("at", 0.0));
        let size = size?;
        return Some(vec![SpanLoad::Point { at: at?, load: way.local.map(|x| x * size) }]);
    }
    let projected = fields.flag(c, "projected")?;
    let local = match (projected, way.global) {
        (false, _) => way.local,
        (true, Some(global)) => {
            let seen = norm(cross(global, member.element.frame.0[0]));
            way.local.map(|x| x * seen)
        }
        (true, None) => {
            let message = format!("{what}: a length is projected along a global direction");
            let at = fields.get("projected").map_or(0..0, |n| n.span.clone());
            c.report(c.diagnostic("E0105", message, at).help("give `dof` in place of `axis`"));
            return None;
        }
    };
    let dimensions = [STIFFNESS, FORCE];
    let points = if block.name == schema::UNIFORM.name {
        let size = size(c, fields, what, &way, dimensions);
        let (from, to) = (place("from", 0.0), place("to", length));
        let size = size?;
        vec![(from?, size), (to?, size)]
    } else {
        points(c, fields, what, dimensions[usize::from(way.turns)], length)?
    };
    if let Some(two) = points.windows(2).find(|two| two[1].0 <= two[0].0) {
        let message = format!(
            "{what}: places must rise along the member, not go from {} m to {} m",
            two[0].0, two[1].0
        );
        let at = ["points", "to", "from"].into_iter().find_map(|key| fields.get(key));
        c.report(c.diagnostic("E0112", message, at.map_or(0..0, |n| n.span.clone())));
        return None;
    }
    let spread = |two: &[(f64, f64)]| SpanLoad::Spread {
        from: two[0].0,
        to: two[1].0,
        start: local.map(|x| x * two[0].1),
        end: local.map(|x| x * two[1].1),
    };
    Some(points.windows(2).map(spread).collect())
}

/// The direction of a load: `dof` or `axis`.
fn way(c: &Context<'_>, fields: &Fields<'_>, what: &str, member: &Found<'_>) -> Option<Way> {
    let mut local = [0.0; 6];
    match (fields.get("dof"), fields.get("axis")) {
        (Some(_), Some(twice)) => {
            let message = format!("{what} has `dof` and `axis`");
            let d = c.diagnostic("E0102", message, twice.span.clone());
            c.report(d.help("keep one of the two"));
            None
        }
        (None, Some(node)) => {
            let axis = Axis::ALL[c.choice(node, "axis", Axis::NAMES)?];
            local[axis.index()] = 1.0;
            Some(Way { local, turns: axis.index() > 2, global: None })
        }
        (dof, None) => {
            let dof = c.dof(dof.or_else(|| fields.required(c, "dof"))?)?;
            let (part, along) = (3 * (dof.index() / 3), dof.index() % 3);
            let global = std::array::from_fn(|i| f64::from(u8::from(i == along)));
            local[part..part + 3].copy_from_slice(&member.element.frame.to_local(global));
            Some(Way { local, turns: dof.is_rotation(), global: Some(global) })
        }
    }
}

/// `force`, or `moment` where it turns.
fn size(
    c: &Context<'_>,
    fields: &Fields<'_>,
    what: &str,
    way: &Way,
    [force, moment]: [Dimension; 2],
) -> Option<f64> {
    let (key, other, dimension) =
        if way.turns { ("moment", "force", moment) } else { ("force", "moment", force) };
    if let Some(wrong) = fields.get(other) {
        let message = format!("{what}: this direction takes a `{key}`, not a `{other}`");
        c.report(c.diagnostic("E0105", message, wrong.span.clone()));
        return None;
    }
    c.number(fields.required(c, key)?, dimension)
}

/// `[(place, size), …]`.
fn points(
    c: &Context<'_>,
    fields: &Fields<'_>,
    what: &str,
    dimension: Dimension,
    length: f64,
) -> Option<Vec<(f64, f64)>> {
    let node = fields.required(c, "points")?;
    let point = |item: &Node| match item.items()[..] {
        [at, size] if item.is_list() => {
            let (at, size) = (place(c, at, "points", length), c.number(size, dimension));
            Some((at?, size?))
        }
        _ => c.wrong(item, "a point `(place, force by length)`"),
    };
    let all: Vec<_> = node.items().into_iter().map(point).collect();
    let all: Vec<(f64, f64)> = all.into_iter().collect::<Option<_>>()?;
    if all.len() < 2 {
        let message = format!("{what} has {} points: must have two or more", all.len());
        c.report(c.diagnostic("E0104", message, node.span.clone()));
        return None;
    }
    Some(all)
}
