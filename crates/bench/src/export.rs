//! The model that runs, as plain numbers for other programs.
//!
//! Everything is taken from the model after reading and from its assembled matrices, not from the
//! generator: what other programs get is what runs here.

use crate::Subject;
use serde_json::{Value as Json, json};
use trilith::element::{Axis, Value, Vector3};
use trilith::model::{Damping, Element, Quantity, TimeFunction};
use trilith::system::System;

/// Nodes, masses, beams, springs, bearings, dampers, Rayleigh damping and motions, SI, indices from 0.
///
/// # Errors
/// A sentence where the model holds something that has no place in it.
pub fn export(subject: &Subject) -> Result<Json, String> {
    let model = &subject.model;
    let system = System::without_axial_forces(model).map_err(|e| e.to_string())?;
    if !model.supports.is_empty() || system.order() != 6 * model.nodes.len() {
        return Err("a frame with supports or constraints cannot be handed over".into());
    }
    let (mut beams, mut springs, mut bearings, mut dampers) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for e in &model.elements {
        match e.kind {
            "Beam" => beams.push(beam(e)?),
            // In the mass matrix.
            "Mass" => {}
            "Spring" => springs.push(spring(e)?),
            "ElastomericBearing" => bearings.push(bearing(e)?),
            "Dashpot" => dampers.push(damper(e)?),
            other => return Err(format!("a frame with `{other}` cannot be handed over")),
        }
    }
    let Damping::Rayleigh { mass, stiffness } = model.damping else {
        return Err("a frame without Rayleigh damping cannot be handed over".into());
    };
    let dynamic = subject.dynamic().ok_or("the case is not dynamic")?;
    let mut motions = Vec::new();
    for b in &dynamic.base {
        let TimeFunction::Table(table) = &model.functions[b.function].function else {
            return Err("the motion is no table".into());
        };
        let values: Vec<f64> = table.values().iter().map(|a| b.factor * a).collect();
        motions.push(json!({ "dof": b.direction.index(), "values": values }));
    }
    let Some(Quantity::Displacement(terms)) = model.outputs.first().map(|o| &o.quantity) else {
        return Err("the first output is no displacement".into());
    };
    let probe: Vec<Json> = terms
        .iter()
        .map(|t| json!({ "node": t.node, "dof": t.dof.index(), "factor": t.factor }))
        .collect();
    Ok(json!({
        "title": model.title,
        "dt": subject.dt,
        "steps": subject.steps,
        "nodes": model.nodes.iter().map(|n| n.position).collect::<Vec<_>>(),
        "mass": masses(&system)?,
        "beams": beams,
        "springs": springs,
        "bearings": bearings,
        "dampers": dampers,
        "rayleigh": [mass, stiffness],
        "motions": motions,
        "probe": probe,
    }))
}

/// The diagonal mass matrix, six values a node.
fn masses(system: &System) -> Result<Vec<f64>, String> {
    let diagonal = system.mass.diagonal();
    if system.mass.entries().any(|(i, j, m)| i != j && m != 0.0) {
        return Err("a mass matrix with coupling cannot be handed over".into());
    }
    (0..system.order())
        .map(|full| match system.reduction.expand(full) {
            [(free, factor)] if *factor == 1.0 => Ok(diagonal[*free]),
            _ => Err("a constrained node cannot be handed over".into()),
        })
        .collect()
}

fn number(e: &Element, name: &str) -> Result<f64, String> {
    e.values.number(name).ok_or_else(|| format!("`{name}` of \"{}\" is not given", e.name))
}

/// Stiffness along axes 1, 2, 3: local 2 is y and local 3 is z of other programs.
fn beam(e: &Element) -> Result<Json, String> {
    let (young, width, depth) = (number(e, "young")?, number(e, "width")?, number(e, "depth")?);
    let plain = |name: &str| e.values.number(name).unwrap_or(0.0) == 0.0;
    if !(plain("offset_i")
        && plain("offset_j")
        && plain("shear_area_2")
        && plain("shear_coefficient"))
    {
        return Err(format!("\"{}\" has shear areas or offsets", e.name));
    }
    let shear = match e.values.number("shear_modulus") {
        Some(g) => g,
        None => young / (2.0 * (1.0 + number(e, "poisson")?)),
    };
    let (a, s) = (width.max(depth), width.min(depth));
    let r = s / a;
    Ok(json!({
        "nodes": e.nodes,
        "young": young,
        "shear": shear,
        "area": width * depth,
        "i2": depth * width.powi(3) / 12.0,
        "i3": width * depth.powi(3) / 12.0,
        "torsion": a * s.powi(3) * (1.0 / 3.0 - 0.21 * r * (1.0 - r.powi(4) / 12.0)),
        "axis3": e.frame.0[2],
    }))
}

/// Index of the global axis that a local one runs along.
fn along(e: &Element, local: usize) -> Result<usize, String> {
    let axis: Vector3 = e.frame.0[local];
    (0..3)
        .find(|&i| (axis[i].abs() - 1.0).abs() < 1e-12)
        .ok_or_else(|| format!("\"{}\" does not run along X, Y or Z", e.name))
}

fn grounded(e: &Element) -> Result<usize, String> {
    match e.nodes[..] {
        [node] => Ok(node),
        _ => Err(format!("\"{}\" does not stand on the ground", e.name)),
    }
}

fn spring(e: &Element) -> Result<Json, String> {
    let mut k = [0.0; 3];
    for (local, name) in ["k1", "k2", "k3"].into_iter().enumerate() {
        k[along(e, local)?] = e.values.number(name).unwrap_or(0.0);
    }
    Ok(json!({ "node": grounded(e)?, "k": k }))
}

fn bearing(e: &Element) -> Result<Json, String> {
    if number(e, "ratio")? != 0.0 || (along(e, 1)?, along(e, 2)?) != (0, 1) {
        return Err(format!("\"{}\" hardens, or does not lie in the plane X, Y", e.name));
    }
    Ok(json!({ "node": grounded(e)?, "k": number(e, "k")?, "fy": number(e, "fy")? }))
}

fn damper(e: &Element) -> Result<Json, String> {
    if number(e, "exponent")? != 1.0 {
        return Err(format!("\"{}\" is not linear", e.name));
    }
    let axis = match e.values.get("axis") {
        Some(Value::Text(name)) => Axis::ALL.iter().position(|a| a.name() == name),
        _ => None,
    };
    let local = axis.filter(|a| *a < 3).ok_or_else(|| format!("\"{}\" has no axis", e.name))?;
    Ok(json!({ "node": grounded(e)?, "dof": along(e, local)?, "c": number(e, "c")? }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Task, find};
    use trilith::SolverKind;

    #[test]
    fn the_smallest_frame_is_handed_over_whole() {
        let task =
            Task { solver: SolverKind::Fna, vectors: None, steps: 3600, substeps: 1, offset: 2.0 };
        let size = find("P1e2").unwrap();
        let subject = Subject::new(&size.frame().to_ron(), task).unwrap();
        let json = export(&subject).unwrap();
        let count = |key: &str| json[key].as_array().unwrap().len();
        assert_eq!(
            ["nodes", "beams", "springs", "bearings", "dampers"].map(count),
            [16, 28, 4, 4, 2]
        );
        let mass: f64 = json["mass"].as_array().unwrap().iter().filter_map(Json::as_f64).sum();
        assert!((mass / 3.0 - 251_550.0).abs() < 1e-6, "{mass}");
        let close = |value: &Json, wanted: f64| {
            assert!((value.as_f64().unwrap() / wanted - 1.0).abs() < 1e-9, "{value} {wanted}");
        };
        // Known from an independent program; the column stands along Z with its depth along X.
        close(&json["bearings"][0]["fy"], 37_015.582_5);
        close(&json["bearings"][0]["k"], 37_015_582.5);
        close(&json["springs"][0]["k"][2], 616_926_375.0);
        close(&json["springs"][0]["k"][0], 246_770.55);
        close(&json["dampers"][1]["c"], 49_829.762_934_415);
        close(&json["rayleigh"][1], 6.180_774_489_005_645e-4);
        close(&json["beams"][12]["torsion"], 0.038_032);
        close(&json["beams"][12]["i3"], 0.036_45);
        assert_eq!(json["dampers"][1]["dof"], 1);
        // Peak of X at step 1692 of the whole motion, 400 of which are left out.
        close(&json["motions"][0]["values"][1292], 3.924);
    }
}
