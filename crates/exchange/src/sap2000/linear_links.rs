//! Linear directions of links, and moments of P-Δ.

use super::context::Context;
use super::joints::STIFFNESSES;
use super::link_laws::{PLACE, Property};
use crate::ron::Ron;

/// Springs and dashpots of the linear directions; a link where the shear acts elsewhere than at the second joint.
pub fn linear(stiff: [f64; 6], damp: [f64; 6], shear: Option<f64>) -> Ron {
    let sheared = [1, 2].iter().any(|i| stiff[*i] != 0.0 || damp[*i] != 0.0);
    if let (Some(at), true) = (shear, sheared) {
        let matrix = |d: [f64; 6]| {
            let row = |i: usize| {
                Ron::List((0..6).map(|j| Ron::Number(if i == j { d[i] } else { 0.0 })).collect())
            };
            Ron::List((0..6).map(row).collect())
        };
        let some = |d: [f64; 6]| d.iter().any(|x| *x != 0.0).then(|| matrix(d));
        return Ron::block("LinearLink")
            .maybe("stiffness", some(stiff))
            .maybe("damping", some(damp))
            .with("shear_at", at);
    }
    const DAMPING: [&str; 6] = ["c1", "c2", "c3", "cr1", "cr2", "cr3"];
    let mut block = Ron::block("Spring");
    for (keys, values) in [(STIFFNESSES, stiff), (DAMPING, damp)] {
        for (key, x) in keys.iter().zip(values).filter(|(_, x)| *x != 0.0) {
            block = block.with(key, x);
        }
    }
    block
}

/// P-Δ moments: the same shares in both directions go to every law that has them.
pub fn shares(cx: &mut Context<'_>, name: &str, [i2, j2, i3, j3]: [f64; 4], out: &mut Property) {
    let what = if [i2, j2] == [i3, j3] {
        "P-Δ moments act in all cases here, in SAP2000 in those with P-Δ"
    } else {
        "P-Δ moments that differ in both directions: those of the first are taken"
    };
    cx.report.otherwise(&format!("{PLACE} 01 - GENERAL: PDM…"), what, name);
    let bearing =
        |k: &str| k.contains("Isolator") || k.contains("Pendulum") || k.contains("Friction");
    for (_, part) in out.parts.iter_mut().filter(|(_, p)| bearing(p.name())) {
        *part = part.clone().with("p_delta_at", Ron::vector(&[i2, j2]));
    }
}
