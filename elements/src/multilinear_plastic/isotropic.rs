//! The isotropic rule: one elastic spring and one slider whose range grows on both sides with the plastic path.
//!
//! ```text
//!   f = K₀ e,  e = d − p,   −f⁻(κ) ≤ f ≤ f⁺(κ),   κ = ∫ |dp|
//! ```
//!
//! f⁺(κ) is the force of the curve where its plastic part d − f/K₀ is κ. While the slider moves, the curve is
//! followed from there, so a step needs no iteration. Where the sides have different K₀, the spring has
//! that of the side it is on.

use super::branch::Branch;
use super::{Answer, MultilinearPlastic, Step};
use trilith_element::{Field, History, history};

history! {
    /// Plastic deformation and its path.
    struct Plastic {
        plastic: "m",
        path: "m",
    }
}

pub(super) fn fields(length: &'static str) -> Vec<Field> {
    vec![Field::new("plastic", length), Field::new("path", length)]
}

/// Where the curve stands once its plastic part is `path`; infinite where it never yields.
fn standing(side: Branch<'_>, path: f64) -> f64 {
    let k0 = side.slope(0);
    let plastic = |i: usize| {
        let (d, f) = side.point(i);
        d - f / k0
    };
    let last = side.lines() - 1;
    let i = (0..last).find(|&i| plastic(i + 1) > path).unwrap_or(last);
    let share = 1.0 - side.slope(i) / k0;
    // A line of slope K₀ has no plastic part.
    if share <= 1e-9 {
        return if i == last { f64::INFINITY } else { side.point(i + 1).0 };
    }
    side.point(i).0 + (path - plastic(i)) / share
}

pub(super) fn respond(
    law: &MultilinearPlastic,
    step: Step,
    committed: &[f64],
    trial: &mut [f64],
) -> Answer {
    let old = Plastic::load(committed);
    let e = step.d - old.plastic;
    let sign = if e == 0.0 { step.direction } else { e };
    let side = law.branch(1.0_f64.copysign(sign));
    let k0 = side.slope(0);
    let elastic = Answer { f: k0 * e, k: k0, stored: 0.5 * k0 * e * e, heat: 0.0 };
    old.store(trial);
    let x0 = standing(side, old.path);
    if x0.is_infinite() {
        return elastic;
    }
    let (f0, _) = side.at(x0);
    let beyond = e.abs() - f0 / k0;
    if beyond < 0.0 || step.direction * side.sign <= 0.0 {
        return elastic;
    }
    let (f, k) = side.at(x0 + beyond);
    let heat = side.area(x0 + beyond) - side.area(x0) - 0.5 * (f - f0) * (f + f0) / k0;
    let plastic = step.d - side.sign * f / k0;
    let path = old.path + (plastic - old.plastic).abs();
    Plastic { plastic, path }.store(trial);
    Answer { f: side.sign * f, k, stored: 0.5 * f * f / k0, heat }
}
