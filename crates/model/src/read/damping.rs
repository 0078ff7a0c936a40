//! The damping statement.

use super::context::Context;
use crate::Damping;
use crate::check::RATIO;
use crate::schema;
use crate::tree::Node;
use std::f64::consts::TAU;
use trilith_element::Range;
use trilith_element::dimension::{FREQUENCY, NONE};

pub(super) fn damping(c: &Context<'_>, node: &Node) -> Option<Damping> {
    let what = "`damping`";
    let kind = c.one_of(node, "damping", &schema::DAMPING)?;
    match kind.name {
        "None" => c.block(node, what, kind).map(|_| Damping::None),
        "Modal" => {
            let fields = c.block(node, what, kind)?;
            fields.number(c, "ratio").map(|ratio| Damping::Modal { ratio })
        }
        "ModalTable" => table(c, node),
        "Rayleigh" => {
            let fields = c.block(node, what, kind)?;
            let (mass, stiffness) = (fields.number(c, "mass"), fields.number(c, "stiffness"));
            Some(Damping::Rayleigh { mass: mass?, stiffness: stiffness? })
        }
        _ => {
            let fields = c.block(node, what, kind)?;
            let ratio = fields.number(c, "ratio");
            let frequency = |key: &str| fields.number(c, key).map(|f| TAU * f);
            let (w1, w2) = (frequency("f1"), frequency("f2"));
            let (ratio, w1, w2) = (ratio?, w1?, w2?);
            // ζ = mass/(2ω) + stiffness·ω/2 at both frequencies.
            let stiffness = 2.0 * ratio / (w1 + w2);
            Some(Damping::Rayleigh { mass: stiffness * w1 * w2, stiffness })
        }
    }
}

fn table(c: &Context<'_>, node: &Node) -> Option<Damping> {
    let fields = c.block(node, "`damping`", &schema::MODAL_TABLE)?;
    let list = fields.required(c, "points")?;
    let mut points: Vec<(f64, f64)> = Vec::new();
    for item in list.items() {
        let pair = item.items();
        if !item.is_list() || pair.len() != 2 {
            return c.wrong(item, "a pair `(frequency, ratio)`");
        }
        let f = c.ranged(pair[0], "frequency", FREQUENCY, Range::NonNegative);
        let ratio = c.ranged(pair[1], "ratio", NONE, RATIO);
        let (f, ratio) = (f?, ratio?);
        if let Some((before, _)) = points.last().filter(|(before, _)| *before >= f) {
            let message = format!("frequencies must rise: {f} Hz follows {before} Hz");
            c.report(c.diagnostic("E0112", message, item.span.clone()));
            return None;
        }
        points.push((f, ratio));
    }
    if points.is_empty() {
        return c.wrong(list, "a list of `(frequency, ratio)`");
    }
    Some(Damping::ModalTable { points })
}
