//! Cross-sections and materials of members, as parameters of their cards.

use super::context::{Context, Fields};
use crate::diagnostic::{closest, names_help};
use crate::schema;
use crate::sections::{self, Section, Shape};
use crate::tree::{Entry, Kind, Node};
use trilith_element::Card;

/// Parameters by name, SI.
type Numbers = Vec<(&'static str, f64)>;

/// What a section and a material give.
#[derive(Default)]
pub(super) struct Made {
    /// Parameters by name, SI.
    pub numbers: Numbers,
    /// What the section looks like.
    pub shape: Option<Shape>,
}

/// Strengths f_ck of the classes of concrete and of cubes, MPa. \[EN 1992-1-1, table 3.1\]
const CLASSES: [(u8, u8); 14] = [
    (12, 15),
    (16, 20),
    (20, 25),
    (25, 30),
    (30, 37),
    (35, 45),
    (40, 50),
    (45, 55),
    (50, 60),
    (55, 67),
    (60, 75),
    (70, 85),
    (80, 95),
    (90, 105),
];

fn find<'n>(entries: &'n [Entry], key: &str) -> Option<&'n Node> {
    entries.iter().find(|e| e.key == key).map(|e| &e.value)
}

/// What section and material of these fields give, as far as the card takes it.
pub(super) fn made(c: &Context<'_>, card: &Card, entries: &[Entry], what: &str) -> Option<Made> {
    let (mut all, mut shape) = (Numbers::new(), None);
    if !schema::is_member(card) {
        return Some(Made::default());
    }
    let mut good = true;
    if let Some(node) = find(entries, "section") {
        if let Some(twice) = ["width", "depth"].iter().find_map(|key| find(entries, key)) {
            let message = format!("{what} has a `section` and the sides of a rectangle");
            let d = c.diagnostic("E0102", message, twice.span.clone());
            c.report(d.help("keep one of the two"));
            good = false;
        }
        match section(c, node) {
            Some(s) => {
                shape = Some(s.shape);
                all.extend([
                    ("area", s.area),
                    ("i2", s.i2),
                    ("i3", s.i3),
                    ("torsion", s.torsion),
                    ("shear_area_2", s.shear_area_2),
                    ("shear_area_3", s.shear_area_3),
                ]);
            }
            None => good = false,
        }
    }
    if let Some(node) = find(entries, "material") {
        match material(c, node) {
            Some(made) => all.extend(made),
            None => good = false,
        }
    }
    all.retain(|(name, _)| card.parameters.iter().any(|p| p.name == *name));
    good.then_some(Made { numbers: all, shape })
}

/// The only value in `Name("value")`.
fn only<'n>(node: &'n Node, block: &schema::Block) -> Option<&'n Node> {
    match &node.kind {
        Kind::List(Some(name), items) if name == block.name => match &items[..] {
            [one] => Some(one),
            _ => None,
        },
        _ => None,
    }
}

fn section(c: &Context<'_>, node: &Node) -> Option<Section> {
    if let Kind::Text(_) = node.kind {
        return rolled(c, node);
    }
    if let Some(name) = only(node, &schema::ROLLED) {
        return rolled(c, name);
    }
    let block = c.one_of(node, "section", &schema::SECTIONS)?;
    let fields = c.block(node, &format!("`{}`", block.name), block)?;
    let read = |keys: &[&str]| -> Option<Vec<f64>> {
        let all: Vec<_> = keys.iter().map(|key| fields.number(c, key)).collect();
        all.into_iter().collect()
    };
    let hollow = |key: &str, of: f64, most: f64| {
        let message =
            format!("`{key}` = {of} m: must be at most {most} m, half of what it goes into");
        let at = fields.get(key).map_or(node.span.clone(), |n| n.span.clone());
        c.report(c.diagnostic("E0112", message, at));
        None
    };
    match block.name {
        "Pipe" => {
            let all = read(&["diameter", "thickness"])?;
            let (d, t) = (all[0], all[1]);
            if t > 0.5 * d { hollow("thickness", t, 0.5 * d) } else { Some(sections::pipe(d, t)) }
        }
        "Box" => {
            let all = read(&["width", "depth", "thickness"])?;
            let (b, h, web) = (all[0], all[1], all[2]);
            let flange = match fields.get("flange") {
                Some(_) => fields.number(c, "flange")?,
                None => web,
            };
            match (web > 0.5 * b, flange > 0.5 * h) {
                (true, _) => hollow("thickness", web, 0.5 * b),
                (_, true) if fields.get("flange").is_none() => hollow("thickness", web, 0.5 * h),
                (_, true) => hollow("flange", flange, 0.5 * h),
                _ => Some(sections::hollow_box(b, h, web, flange)),
            }
        }
        "IShape" => {
            let all = read(&["depth", "width", "web", "flange", "radius"])?;
            let (h, b, web, flange, r) = (all[0], all[1], all[2], all[3], all[4]);
            if flange > 0.5 * h {
                return hollow("flange", flange, 0.5 * h);
            }
            let room = (0.5 * (b - web)).min(0.5 * h - flange);
            if r > room || web > b {
                let (key, x) = if web > b { ("web", web) } else { ("radius", r) };
                let message = format!("`{key}` = {x} m: there is no room for it in this section");
                let at = fields.get(key).map_or(node.span.clone(), |n| n.span.clone());
                c.report(c.diagnostic("E0112", message, at));
                return None;
            }
            Some(sections::i_shape([h, b, web, flange, r]))
        }
        "Rectangle" => read(&["width", "depth"]).map(|a| sections::rectangle(a[0], a[1])),
        "Circle" => read(&["diameter"]).map(|a| sections::circle(a[0])),
        _ => rolled(c, fields.required(c, "name")?),
    }
}

/// A rolled section by its name, or by the text parameter that holds it.
fn rolled(c: &Context<'_>, node: &Node) -> Option<Section> {
    let Kind::Text(text) = &node.kind else {
        return c.wrong(node, "the name of a rolled section in quotes");
    };
    let name = c.parameters().text(text).unwrap_or(text);
    if let Some(found) = sections::rolled(name) {
        return Some(found);
    }
    let names = sections::names(name);
    let near = closest(name, names.iter().copied());
    let mut d =
        c.diagnostic("E0106", format!("there is no rolled section `{name}`"), node.span.clone());
    match near {
        Some(near) => {
            d = d.help(names_help(name, "sections", names.iter().copied()));
            d = d.suggestion(node.span.clone(), format!("\"{near}\""));
        }
        None => {
            let series = sections::SERIES.join(", ");
            d = d.help(format!(
                "the series are {series}, as in `\"HEB 300\"`, `\"W14x90\"`, `\"RHS 200x100x8\"` (mm) and `\"HSS 8x6x1/2\"` (in); others are given by `Pipe`, `Box`, `IShape`, `Rectangle` or `Circle`"
            ));
        }
    }
    c.report(d);
    None
}

fn material(c: &Context<'_>, node: &Node) -> Option<Numbers> {
    if let Some(class) = only(node, &schema::CONCRETE) {
        let young = young_of_class(c, class)?;
        return rest(c, &Fields::none(node, &schema::CONCRETE), young);
    }
    let block = c.one_of(node, "material", &schema::MATERIALS)?;
    let fields = match node.kind {
        Kind::Text(_) => Fields::none(node, block),
        _ => c.block(node, &format!("`{}`", block.name), block)?,
    };
    if block.name != schema::CONCRETE.name {
        let young = fields.number(c, "young");
        return rest(c, &fields, young?);
    }
    let young = match (fields.get("class"), fields.get("strength")) {
        (Some(_), Some(twice)) => {
            let message = "`Concrete` has `class` and `strength`";
            let d = c.diagnostic("E0102", message, twice.span.clone());
            c.report(d.help("keep one of the two"));
            None
        }
        (Some(class), None) => young_of_class(c, class),
        (None, Some(_)) => fields.number(c, "strength").map(|f| 4.7e9 * (f / 1e6).sqrt()),
        (None, None) => fields.required(c, "class").and(None),
    };
    rest(c, &fields, young?)
}

/// The modulus and what else a material gives.
fn rest(c: &Context<'_>, fields: &Fields<'_>, young: f64) -> Option<Numbers> {
    let mut made = vec![("young", young)];
    let mut good = true;
    for key in ["poisson", "density", "expansion"] {
        match fields.number(c, key) {
            Some(x) => made.push((key, x)),
            None => good = false,
        }
    }
    good.then_some(made)
}

fn young_of_class(c: &Context<'_>, node: &Node) -> Option<f64> {
    let Kind::Text(text) = &node.kind else {
        return c.wrong(node, "a strength class in quotes, such as \"C30/37\",");
    };
    let text = c.parameters().text(text).unwrap_or(text);
    let name = |(cylinder, cube): (u8, u8)| format!("C{cylinder}/{cube}");
    if let Some((strength, _)) = CLASSES.into_iter().find(|class| name(*class) == text.trim()) {
        return Some(22e9 * ((f64::from(strength) + 8.0) / 10.0).powf(0.3));
    }
    let names: Vec<String> = CLASSES.into_iter().map(name).collect();
    let help = names_help(text, "classes", names.iter().map(String::as_str));
    let message = format!("there is no class of concrete `{text}`");
    c.report(c.diagnostic("E0106", message, node.span.clone()).help(help));
    None
}
