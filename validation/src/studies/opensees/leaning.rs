//! Links with a length of their own, axial forces in what is slender, and links in a row.

use super::frames::{beam, member};
use super::pair::Agree;
use super::structures::Moved::{Led, Pushed};
use super::structures::{Node, Structure};
use serde_json::{Value, json};

/// Stiffness of a long link along and about its axes, N/m and N·m.
const LONG: [f64; 6] = [5e7, 2e6, 3e6, 4e5, 6e5, 8e5];
/// Its length, m.
const LENGTH: f64 = 0.8;

/// A long link in both programs, with these options each.
fn long(options: &[Value], own: &str) -> (Vec<Value>, String) {
    let material = |(i, k)| json!(["uniaxialMaterial", "Elastic", i, k]);
    let mut theirs: Vec<Value> = (1..=6).zip(LONG).map(material).collect();
    let mut element = vec![json!("element"), json!("twoNodeLink"), json!(1), json!(1), json!(2)];
    for option in ["-mat", "-dir"] {
        element.push(json!(option));
        element.extend((1..=6).map(|i| json!(i)));
    }
    element.push(json!("-orient"));
    element.extend([0.0, 0.0, 1.0, 1.0, 0.0, 0.0].map(|x| json!(x)));
    element.extend(options.iter().cloned());
    theirs.push(element.into());
    let row = |(i, k): (usize, &f64)| {
        let mut row = [0.0; 6];
        row[i] = *k;
        format!("{row:?}")
    };
    let rows: Vec<String> = LONG.iter().enumerate().map(row).collect();
    let ours = format!(
        r#""link": LinearLink(nodes: ("1", "2"), axis1: (0, 0, 1), axis2: (1, 0, 0), {own} stiffness: [{}])"#,
        rows.join(", ")
    );
    (theirs, ours)
}

/// An option of a long link, with numbers.
fn option(name: &str, numbers: &[f64]) -> Vec<Value> {
    [json!(name)].into_iter().chain(numbers.iter().map(|x| json!(x))).collect()
}

/// Links with a length of their own: where their shear acts, and the axial force.
fn leaning() -> Vec<Structure> {
    let top = [0.0, 0.0, LENGTH];
    let mut all = Vec::new();
    // Nothing turns about the axis, nor about the others where the shear has no arm.
    for (name, options, own, turns) in [
        ("twoNodeLink, shear in the middle", vec![], "shear_at: 0.4,", true),
        ("-shearDist 0.25", option("-shearDist", &[0.25, 0.25]), "shear_at: 0.6,", true),
        ("-shearDist 1", option("-shearDist", &[1.0, 1.0]), "", false),
    ] {
        let (theirs, ours) = long(&options, own);
        let nodes = vec![Node::clamped([0.0; 3]), Node::free(top, 2000.0)];
        let watched = (1..=if turns { 5 } else { 3 }).map(|i| (2, i)).collect();
        all.push(Structure { watched, ..Structure::new(name, nodes, theirs, &ours) });
    }
    // Small motions: the axial force of the weight stays as it is, and links do not shorten.
    let weight = Some((2, 3, -3e5));
    let (theirs, ours) = long(&option("-pDelta", &[0.0; 4]), "p_delta_at: (0, 0), shear_at: 0.4,");
    let nodes = vec![Node::clamped([0.0; 3]), Node::only(top, 2000.0, &[1, 2, 3])];
    all.push(Structure {
        weight,
        moved: Pushed(2, [30.0, 20.0, 0.0]),
        watched: vec![(2, 1), (2, 2)],
        agree: Agree::Equal,
        ..Structure::new("-pDelta 0 0, a couple of shears", nodes, theirs, &ours)
    });
    // An end that turns and is led sideways, where the shear has no arm and the push of an end that tilts
    // moves nothing.
    let shares = option("-pDelta", &[0.4, 0.6, 0.4, 0.6]);
    for (name, end, arm, own) in [
        ("-pDelta 0.4 0.6, the first end turns", 1, [0.0; 2], "shear_at: 0.8,"),
        ("-pDelta 0.4 0.6, the second end turns", 2, [1.0; 2], ""),
    ] {
        let options = [shares.clone(), option("-shearDist", &arm)].concat();
        let (theirs, ours) = long(&options, &format!("p_delta_at: (0.4, 0.6), {own}"));
        let nodes = if end == 1 {
            vec![Node::only([0.0; 3], 2000.0, &[4, 5]), Node::only(top, 2000.0, &[3])]
        } else {
            vec![Node::clamped([0.0; 3]), Node::only(top, 2000.0, &[3, 4, 5])]
        };
        all.push(Structure {
            weight,
            moved: Led(vec![(end, 1, 1e-4), (end, 2, -6e-5)]),
            watched: vec![(end, 4), (end, 5)],
            agree: Agree::Equal,
            ..Structure::new(name, nodes, theirs, &ours)
        });
    }
    all.push(column());
    all
}

/// Parts of a column.
const PARTS: u8 = 16;

/// A slender column of some parts under nearly half of what it can carry.
fn column() -> Structure {
    let height = 6.0;
    let mut nodes = vec![Node::clamped([0.0; 3])];
    let (mut theirs, mut ours) = (Vec::new(), String::new());
    for part in 1..=PARTS {
        nodes.push(Node::free([0.0, 0.0, height * f64::from(part) / f64::from(PARTS)], 100.0));
        let mut one = member(part, [part, part + 1], true, None);
        if let Some(Value::Array(axes)) = one.first_mut() {
            axes[1] = json!("PDelta");
        }
        theirs.extend(one);
        let [i, j] = [part, part + 1].map(|n| n.to_string());
        ours += &beam(&i, [&i, &j], "");
    }
    let top = usize::from(PARTS) + 1;
    // Half as many parts are apart by 0.031, and the error of a chord is of second order.
    let why = "P acts on the chord of each part there, on its bent axis as well here";
    Structure {
        weight: Some((top, 3, -3e5)),
        moved: Pushed(top, [300.0, 200.0, 0.0]),
        more: r#"p_delta: "weight","#,
        watched: vec![(top, 1), (top, 2)],
        agree: Agree::Near(0.008, why),
        ..Structure::new("geomTransf PDelta, a column", nodes, theirs, &ours)
    }
}

/// A spring that yields and one that does not, one behind the other, under a mass.
fn series() -> Structure {
    let theirs = vec![
        json!(["uniaxialMaterial", "Steel01", 2, 2e4, 4e6, 0.05]),
        json!(["uniaxialMaterial", "Elastic", 3, 2e6]),
        json!(["uniaxialMaterial", "Series", 1, 2, 3]),
        json!(["element", "zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1]),
    ];
    let ours = r#"
        "yields": MultilinearPlastic(nodes: ("1", "3"), axis: U1, axis1: (1, 0, 0), rule: Kinematic,
            deformation: [-1.005, -0.005, 0, 0.005, 1.005], force: [-2.2e5, -2e4, 0, 2e4, 2.2e5]),
        "does not": LinearLink(nodes: ("3", "2"), axis1: (1, 0, 0), stiffness: [
            [2e6, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0],
            [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]]),
    "#;
    let nodes = vec![Node::clamped([0.0; 3]), Node::only([0.0; 3], 2000.0, &[1])];
    Structure {
        own: vec![Node::only([0.0; 3], 0.0, &[1])],
        watched: vec![(2, 1)],
        agree: Agree::Equal,
        ..Structure::new("Series of two, a mass on them", nodes, theirs, ours)
    }
}

pub(super) fn structures() -> Vec<Structure> {
    let mut all = leaning();
    all.push(series());
    all
}
