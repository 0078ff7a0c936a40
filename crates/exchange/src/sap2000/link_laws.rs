//! Link properties: the laws of their directions as links of a model file.

use super::bearings::{both_ways, rubber, sliding, triple};
use super::context::Context;
use super::database::Entry;
use super::joints::LOCAL;
use super::linear_links::{linear, shares};
use crate::ron::Ron;

/// Tables of the directions, by the number in their names, with the types that they belong to.
const TABLES: [&str; 13] = [
    "02 - LINEAR",
    "03 - MULTILINEAR",
    "04 - DAMPER",
    "05 - GAP",
    "06 - HOOK",
    "07 - RUBBER ISOLATOR",
    "08 - SLIDING ISOLATOR",
    "09 - TC SLIDING ISOLATOR",
    "10 - PLASTIC (WEN)",
    "11 - MULTILINEAR PLASTIC",
    "12 - TRIPLE PENDULUM ISOLATOR",
    "14 - BILINEAR DAMPER",
    "15 - FRICTION SPRING DAMPER",
];
/// Where link properties stand.
pub const PLACE: &str = "LINK PROPERTY DEFINITIONS";

/// What a link property becomes.
#[derive(Clone, Debug, Default)]
pub struct Property {
    /// Kinds with their parameters, each with words that tell it from the others.
    pub parts: Vec<(String, Ron)>,
    /// Directions that are fixed.
    pub fixed: [bool; 6],
    /// Mass, rotary inertias, weight.
    pub mass: f64,
    pub inertia: [f64; 3],
    pub weight: f64,
    /// Stiffness of the linear directions, for displacements of the ground.
    pub linear: [f64; 6],
    /// Directions with a law of their own.
    pub nonlinear: bool,
}

/// A direction of a property: its first row and all its points.
struct Direction<'a> {
    at: usize,
    row: Entry<'a>,
    points: Vec<[f64; 2]>,
}

/// Reads a property.
pub fn property<'a>(cx: &mut Context<'a>, row: Entry<'a>, name: &'a str) -> Property {
    let kind = row.need("LinkType");
    let mut out = Property {
        mass: row.or_zero("Mass"),
        weight: row.or_zero("Weight"),
        inertia: ["RotInert1", "RotInert2", "RotInert3"].map(|key| row.or_zero(key)),
        ..Property::default()
    };
    let moments = ["PDM2I", "PDM2J", "PDM3I", "PDM3J"].map(|key| row.or_zero(key));
    let mut directions: Vec<Direction<'a>> = Vec::new();
    let db = cx.db;
    for table in TABLES {
        let rows = db.rows(&format!("{PLACE} {table}")).filter(|r| r.need("Link") == name);
        for r in rows {
            let Some(at) = LOCAL.iter().position(|d| *d == r.need("DOF")) else {
                r.wrong_at("DOF", "an unknown direction", "U1, U2, U3, R1, R2 or R3");
                continue;
            };
            let point = r.number("Displ").or_else(|| r.number("Rotn")).or_else(|| r.number("Rot"));
            let point =
                point.map(|d| [d, r.number("Force").or_else(|| r.number("Moment")).unwrap_or(0.0)]);
            match directions.iter_mut().find(|d| d.at == at) {
                Some(known) => known.points.extend(point),
                None => {
                    directions.push(Direction { at, row: r, points: point.into_iter().collect() })
                }
            }
        }
    }
    let (mut stiff, mut damp, mut shear) = ([0.0; 6], [0.0; 6], None);
    let mut lawful: Vec<Direction<'a>> = Vec::new();
    for d in directions {
        let dj = d.row.or_zero("DJ");
        if (d.at == 1 || d.at == 2) && *shear.get_or_insert(dj) != dj {
            cx.report.lose(
                &format!("{PLACE}: DJ"),
                "shear of both directions acts where that of the first does",
                name,
            );
        }
        if d.row.yes("Fixed") {
            out.fixed[d.at] = true;
            d.row.idle();
        } else if d.row.yes("NonLinear") && kind != "Linear" {
            lawful.push(d);
        } else {
            let turn = d.at >= 3;
            stiff[d.at] = d.row.or_zero(if turn { "RotKE" } else { "TransKE" });
            damp[d.at] = d.row.or_zero(if turn { "RotCE" } else { "TransCE" });
            // What its law would take means nothing in a linear direction.
            d.row.idle();
        }
    }
    out.nonlinear = !lawful.is_empty();
    out.linear = stiff;
    let shear = shear.filter(|s| *s != 0.0);
    laws(cx, kind, name, &lawful, &mut out, &mut stiff);
    if stiff.iter().chain(&damp).any(|x| *x < 0.0) {
        row.wrong("a stiffness or damping below zero in a direction of this property", "");
    } else if stiff.iter().chain(&damp).any(|x| *x != 0.0) {
        out.parts.insert(0, ("linear".into(), linear(stiff, damp, shear)));
    }
    if let Some(at) = shear {
        for (_, part) in
            out.parts.iter_mut().filter(|(_, p)| !matches!(p.name(), "Spring" | "LinearLink"))
        {
            *part = part.clone().with("shear_at", at);
        }
    }
    if moments != [0.0; 4] {
        shares(cx, name, moments, &mut out);
    }
    out
}

fn laws<'a>(
    cx: &mut Context<'a>,
    kind: &str,
    name: &str,
    all: &[Direction<'a>],
    out: &mut Property,
    stiff: &mut [f64; 6],
) {
    let find = |at: usize| all.iter().find(|d| d.at == at).map(|d| d.row);
    let bearing = match kind {
        "Rubber Isolator" => Some(rubber(find(1), find(2), stiff)),
        "Friction Isolator" => Some(sliding(cx, name, [find(0), find(1), find(2)])),
        "T/C Friction Isolator" => Some(both_ways(cx, name, [find(0), find(1), find(2)])),
        "Triple Pendulum Isolator" => Some(triple(cx, name, [find(0), find(1), find(2)])),
        _ => None,
    };
    if let Some(bearing) = bearing {
        match bearing {
            Some(block) => out.parts.push(("bearing".into(), block)),
            None if all.is_empty() => {}
            None => cx.report.lose(
                PLACE,
                "a bearing without the directions of its law is not written",
                name,
            ),
        }
        return;
    }
    for d in all {
        let mut ended = Direction { at: d.at, row: d.row, points: d.points.clone() };
        if kind == "MultiLinear Elastic" && ends_at_zero(&mut ended.points) {
            let what =
                "a curve whose last line falls ends at zero force, in SAP2000 the line goes on";
            cx.report.lose(PLACE, what, name);
        }
        let d = &ended;
        match one(kind, d) {
            Some(block) => {
                let block =
                    if d.at == 0 { block } else { block.with("axis", Ron::word(LOCAL[d.at])) };
                out.parts.push((LOCAL[d.at].into(), block));
            }
            None => {
                let what = format!("the law of {} of a link {kind} is not written", LOCAL[d.at]);
                cx.report.lose(PLACE, &what, name);
            }
        }
    }
}

/// Ends a curve at zero force where its outer lines fall towards it; true where one did.
fn ends_at_zero(points: &mut Vec<[f64; 2]>) -> bool {
    let mut any = false;
    for last in [true, false] {
        let n = points.len();
        if n < 2 {
            return any;
        }
        let (inner, outer) =
            if last { (points[n - 2], points[n - 1]) } else { (points[1], points[0]) };
        let slope = (outer[1] - inner[1]) / (outer[0] - inner[0]);
        if slope.is_nan() || slope >= 0.0 {
            continue;
        }
        any = true;
        let zero = outer[0] - outer[1] / slope;
        let step = zero - outer[0];
        let more = [[zero, 0.0], [zero + step, 0.0]];
        if last {
            points.extend(more.iter().filter(|_| step > 0.0));
        } else {
            more.iter().filter(|_| step < 0.0).for_each(|p| points.insert(0, *p));
        }
    }
    any
}

/// The law of a single direction.
fn one(kind: &str, d: &Direction<'_>) -> Option<Ron> {
    let (row, turn) = (d.row, d.at >= 3);
    let get = |key: &str| row.or_zero(&format!("{}{key}", if turn { "Rot" } else { "Trans" }));
    let list = |i: usize| Ron::List(d.points.iter().map(|p| Ron::Number(p[i])).collect());
    let curve = |kind: &str| Ron::block(kind).with("deformation", list(0)).with("force", list(1));
    let block = match kind {
        "Gap" if !turn => Ron::block("Gap").with("k", get("K")).with("opening", get("Open")),
        "Hook" if !turn => Ron::block("Hook").with("k", get("K")).with("opening", get("Open")),
        "Damper - Exponential" | "Damper" if !turn => {
            let exponent = row.number("CExp").unwrap_or(1.0);
            let block = Ron::block("MaxwellDamper").with("k", get("K")).with("c", get("C"));
            block.maybe("exponent", (exponent != 1.0).then_some(exponent))
        }
        "Damper - Bilinear" if !turn => Ron::block("BilinearDamper")
            .with("k", get("K"))
            .with("c", get("C"))
            .with("cy", get("Cy"))
            .with("fl", row.or_zero("ForceLimit")),
        "Damper - Friction Spring" => {
            let stop = get("Us");
            let way = row.text("ActiveDir").filter(|way| *way != "Both");
            // The precompression is a deformation below zero there.
            Ron::block("FrictionSpring")
                .with("k", get("K"))
                .with("k1", get("K1"))
                .with("k2", get("K2"))
                .with("u0", get("U0").abs())
                .maybe("us", (stop != 0.0).then_some(stop.abs()))
                .maybe("direction", way.map(Ron::word))
        }
        "Plastic (Wen)" => Ron::block("Wen")
            .with("k", get("K"))
            .with("fy", get("Yield"))
            .with("ratio", row.or_zero("Ratio"))
            .with("exponent", row.number("YieldExp").unwrap_or(2.0)),
        "MultiLinear Elastic" => curve("MultilinearElastic"),
        "MultiLinear Plastic" => {
            let rule = row.text("HysType").unwrap_or("Kinematic");
            let block = curve("MultilinearPlastic");
            match rule {
                "Kinematic" => block,
                "Takeda" | "Isotropic" => block.with("rule", Ron::word(rule)),
                "Pivot" => {
                    let keys = [
                        ("alpha1", "Alpha1"),
                        ("alpha2", "Alpha2"),
                        ("beta1", "Beta1"),
                        ("beta2", "Beta2"),
                    ];
                    let block = block.with("rule", Ron::word("Pivot"));
                    keys.iter().fold(block, |b, (ours, theirs)| b.maybe(ours, row.number(theirs)))
                }
                _ => return None,
            }
        }
        _ => return None,
    };
    Some(block)
}
