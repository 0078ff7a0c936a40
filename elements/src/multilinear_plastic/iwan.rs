//! Iwan's rule: elastic springs with sliders, side by side.
//!
//! Every corner of the curve is an element: a spring with the change of slope there, and a slider that lets go
//! at the deformation of the corner. What is left of the slope at the end of the curve is a spring
//! alone. Loaded for the first time they give the curve; after a reversal each has to go through its
//! whole range, so the path is the curve doubled, and a closed cycle returns to where it began.
//!
//! ```text
//!   f = Σⱼ g(eⱼ) + k_end d,   g(e) = kⱼ⁺ e upwards, kⱼ⁻ e downwards,   −dⱼ⁻ ≤ eⱼ ≤ dⱼ⁺
//! ```
//!
//! Where the sides differ, the j-th corners belong together: unloading has the slopes of the side it leaves
//! for as long as its elements are stretched, then those of the other side. A side with fewer corners
//! has elements that carry nothing on it.

use super::branch::Branch;
use super::{Answer, MultilinearPlastic, Step};
use trilith_element::Field;

/// Number of corners of the side with more of them.
pub(super) fn corners(law: &MultilinearPlastic) -> usize {
    law.branch(1.0).lines().max(law.branch(-1.0).lines()) - 1
}

/// The stretch of every element.
pub(super) fn fields(law: &MultilinearPlastic, length: &'static str) -> Vec<Field> {
    let field = |j| Field::named(format!("stretch{}", j + 1), length);
    (0..corners(law)).map(field).collect()
}

/// Size of the deformation at the `j`-th corner of a side, that of its last where it has fewer.
pub(super) fn corner(side: Branch<'_>, j: usize) -> f64 {
    side.corner_before(j + 1).0
}

/// Stiffness and range of element `j` on a side.
fn element(side: Branch<'_>, j: usize) -> (f64, f64) {
    if j + 1 < side.lines() {
        ((side.slope(j) - side.slope(j + 1)).max(0.0), side.point(j + 1).0)
    } else {
        (0.0, 0.0)
    }
}

pub(super) fn respond(
    law: &MultilinearPlastic,
    step: Step,
    committed: &[f64],
    trial: &mut [f64],
) -> Answer {
    let [up, down] = [law.branch(1.0), law.branch(-1.0)];
    let upwards = |x: f64| x > 0.0 || (x == 0.0 && step.direction >= 0.0);
    let end = if upwards(step.d) { up } else { down };
    let k = end.slope(usize::MAX);
    let mut out = Answer { f: k * step.d, k, stored: 0.5 * k * step.d * step.d, heat: 0.0 };
    for (j, (old, new)) in committed.iter().zip(trial).enumerate() {
        let stretch = old + (step.d - step.d0);
        let e = stretch.clamp(-element(down, j).1, element(up, j).1);
        let k = element(if upwards(e) { up } else { down }, j).0;
        let slides = (stretch - e) * step.direction > 0.0 || {
            let limit = if step.direction > 0.0 { element(up, j).1 } else { -element(down, j).1 };
            step.direction != 0.0 && e == limit
        };
        out.f += k * e;
        out.k += if slides { 0.0 } else { k };
        out.stored += 0.5 * k * e * e;
        out.heat += k * e * (stretch - e);
        *new = e;
    }
    out
}
