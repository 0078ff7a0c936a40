//! Bearings: laws that take their two directions of shear together.

use super::context::Context;
use super::database::Entry;
use super::link_laws::PLACE;
use crate::ron::Ron;

pub fn rubber(u2: Option<Entry<'_>>, u3: Option<Entry<'_>>, stiff: &mut [f64; 6]) -> Option<Ron> {
    let (first, second) = (u2.or(u3)?, u2.and(u3));
    let of = |row: Entry<'_>| ["TransK", "TransYield", "Ratio"].map(|key| row.or_zero(key));
    let [k, fy, ratio] = of(first);
    let mut block =
        Ron::block("RubberIsolator").with("k2", k).with("fy2", fy).with("ratio2", ratio);
    if let Some(second) = second {
        let [k3, fy3, ratio3] = of(second);
        if [k3, fy3, ratio3] != [k, fy, ratio] {
            block = block.with("k3", k3).with("fy3", fy3).with("ratio3", ratio3);
        }
    }
    // Its axial spring is linear; a dashpot beside it stays with the linear directions.
    let axial = std::mem::take(&mut stiff[0]);
    Some(if axial == 0.0 { block } else { block.with("kv", axial) })
}

/// Friction of a direction: slow, fast, rate, with the ending of its side.
fn friction(block: Ron, row: Entry<'_>, side: &str, ours: &str, model: bool) -> Ron {
    let [slow, fast, rate] =
        ["Slow", "Fast", "Rate"].map(|key| row.or_zero(&format!("{key}{side}")));
    if slow == fast {
        return block.with(&format!("mu{ours}"), fast);
    }
    let block = if model { block.with("friction_model", Ron::word("Velocity")) } else { block };
    block
        .with(&format!("mu_slow{ours}"), slow)
        .with(&format!("mu_fast{ours}"), fast)
        .with(&format!("rate{ours}"), rate)
}

/// The two directions of sliding, which must be alike.
fn alike<'a>(
    cx: &mut Context<'a>,
    name: &str,
    u2: Option<Entry<'a>>,
    u3: Option<Entry<'a>>,
    keys: &[&str],
) -> Option<Entry<'a>> {
    if let (Some(a), Some(b)) = (u2, u3) {
        if keys.iter().any(|key| a.or_zero(key) != b.or_zero(key)) {
            cx.report.lose(
                PLACE,
                "U2 and U3 of a sliding bearing differ: those of U2 are taken",
                name,
            );
        }
    } else if cx.draft.plane.is_none() {
        cx.report.lose(PLACE, "a bearing that slides along one direction slides along both", name);
    }
    let what = "sticks as a spring until it slips, in SAP2000 by the smooth law of Wen";
    cx.report.otherwise(PLACE, what, name);
    u2.or(u3)
}

pub fn sliding<'a>(
    cx: &mut Context<'a>,
    name: &str,
    [u1, u2, u3]: [Option<Entry<'a>>; 3],
) -> Option<Ron> {
    let across = alike(cx, name, u2, u3, &["TransK", "Slow", "Fast", "Rate", "Radius"])?;
    let up = u1?;
    let damping = up.or_zero("TransC");
    let block = Ron::block("FrictionPendulum").with("kn", up.or_zero("TransK"));
    let block = if damping == 0.0 {
        block
    } else {
        block.with("damping", damping).with("pull", Ron::word("true"))
    };
    let block = block.with("ks", across.or_zero("TransK")).with("radius", across.or_zero("Radius"));
    Some(friction(block, across, "", "", true))
}

pub fn both_ways<'a>(
    cx: &mut Context<'a>,
    name: &str,
    [u1, u2, u3]: [Option<Entry<'a>>; 3],
) -> Option<Ron> {
    let keys = [
        "TransK", "SlowComp", "FastComp", "RateComp", "SlowTens", "FastTens", "RateTens", "Radius",
    ];
    let across = alike(cx, name, u2, u3, &keys)?;
    let up = u1?;
    let damping = up.or_zero("TransC");
    let block = Ron::block("TensionCompressionFriction")
        .with("kn", up.or_zero("TransK"))
        .with("kt", up.or_zero("TransKTens"))
        .with("gap_compression", up.or_zero("GapComp"))
        .with("gap_tension", up.or_zero("GapTens"));
    let block = if damping == 0.0 {
        block
    } else {
        block.with("damping", damping).with("pull", Ron::word("true"))
    };
    let block = block.with("ks", across.or_zero("TransK")).with("radius", across.or_zero("Radius"));
    let block = friction(block, across, "Comp", "", false);
    Some(friction(block, across, "Tens", "_tension", false))
}

/// Surfaces outer bottom, inner bottom, inner top, outer top; symmetric ones are given once.
pub fn triple<'a>(
    cx: &mut Context<'a>,
    name: &str,
    [u1, u2, u3]: [Option<Entry<'a>>; 3],
) -> Option<Ron> {
    const FRONTS: [&str; 6] = ["K", "Rad", "Stop", "Slow", "Fast", "Rate"];
    let keys = FRONTS
        .iter()
        .flat_map(|f| ["OutTop", "InTop", "OutBot", "InBot"].map(|s| format!("{f}{s}")));
    let keys: Vec<String> = keys.chain(["HeightOut".into(), "HeightIn".into()]).collect();
    let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
    [u2, u3].into_iter().flatten().for_each(|row| {
        row.yes("SymOut");
        row.yes("SymIn");
    });
    let across = alike(cx, name, u2, u3, &keys)?;
    let up = u1?;
    let [out, inner] = ["SymOut", "SymIn"].map(|key| across.text(key).is_none_or(|s| s == "Yes"));
    let four = |front: &str| {
        let top = ["OutTop", "InTop"].map(|s| across.or_zero(&format!("{front}{s}")));
        let bottom = ["OutBot", "InBot"].map(|s| across.or_zero(&format!("{front}{s}")));
        let ob = if out { top[0] } else { bottom[0] };
        let ib = if inner { top[1] } else { bottom[1] };
        [ob, ib, top[1], top[0]]
    };
    let (k, stops) = (four("K"), four("Stop"));
    let stiffness = k.iter().fold(0.0, |a: f64, b| a.max(*b));
    if k.iter().any(|x| *x != stiffness) {
        let what = "stiffnesses before slip that differ: the largest is taken for all surfaces";
        cx.report.otherwise(PLACE, what, name);
    }
    let heights = [across.or_zero("HeightOut") / 2.0, across.or_zero("HeightIn") / 2.0];
    let damping = up.or_zero("TransC");
    let block = Ron::block("TriplePendulum").with("kn", up.or_zero("TransK"));
    let block = if damping == 0.0 {
        block
    } else {
        block.with("damping", damping).with("pull", Ron::word("true"))
    };
    let block = block
        .with("ks", stiffness)
        .with("radii", Ron::vector(&four("Rad")))
        .with("heights", Ron::vector(&[heights[0], heights[1], heights[1], heights[0]]));
    let block = if stops == [0.0; 4] {
        block
    } else {
        block.with("capacities", Ron::vector(&stops)).with("stop_stiffness", stiffness)
    };
    let (slow, fast) = (four("Slow"), four("Fast"));
    Some(if slow == fast {
        block.with("mu", Ron::vector(&fast))
    } else {
        block
            .with("mu_slow", Ron::vector(&slow))
            .with("mu_fast", Ron::vector(&fast))
            .with("rate", Ron::vector(&four("Rate")))
    })
}
