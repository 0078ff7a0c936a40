//! The kinematic rule: the lines of the curve one after the other, each with its counterpart of the other sign.
//!
//! ```text
//!   d = Σⱼ xⱼ,   f = Σⱼ kⱼ xⱼ,   kⱼ = kⱼ⁺ where xⱼ > 0, kⱼ⁻ where xⱼ < 0,   −lⱼ⁻ ≤ xⱼ ≤ lⱼ⁺
//! ```
//!
//! The j-th line from the origin has the slope kⱼ and the length lⱼ, the last goes on. Of the lines that have not come
//! to their end on the side of the motion, the first moves. So a path back from the curve has, from the first line
//! on, a part parallel to the line loaded before and as long as that was loaded, then one parallel to its counterpart
//! and as long as that; after the last it is on the curve of the other side. A closed cycle returns to where it
//! began, and where both sides are alike the path is the curve doubled.
//!
//! The last lines of both sides belong together, the others from the origin on; a side with fewer lines has
//! none of length in between. History are the sums eⱼ = x₁ + … + xⱼ, which follow d between the j-th corners.
//!
//! **Energy.** Stored: ½ Σⱼ kⱼ (eⱼ² − eⱼ₋₁²). What line m makes heat of while it moves by dx towards a side of the curve whose
//! (m − 1)-th corner is (D, F): (F − kₘ D) |dx|. None is negative where no line is steeper than
//! one before it, of either side; steeper ones would give energy in a cycle, and are refused.

use super::branch::Branch;
use super::{Answer, MultilinearPlastic, Step, iwan};
use trilith_element::ParameterError;

/// The place of line `i` among the lines of both sides.
fn place(side: Branch<'_>, i: usize, corners: usize) -> usize {
    if i + 1 == side.lines() { corners } else { i }
}

/// Lines must get no steeper away from the origin, and none steeper than those of the other side before it.
pub(super) fn check(law: &MultilinearPlastic) -> Result<(), ParameterError> {
    let corners = iwan::corners(law);
    for sign in [1.0, -1.0] {
        let (side, other) = (law.branch(sign), law.branch(-sign));
        side.no_steeper_outwards("`Kinematic`")?;
        for i in 0..side.lines() {
            let before = |o: &usize| place(other, *o, corners) < place(side, i, corners);
            let softer = |o: &usize| other.slope(*o) < side.slope(i) * (1.0 - 1e-9);
            if let Some(o) = (0..other.lines()).filter(before).find(softer) {
                let ((d, f), (x, g)) = (side.outer_end(i), other.outer_end(o));
                let message = format!(
                    "the line towards ({d}, {f}) is steeper than the one towards ({x}, {g}), which `Kinematic` goes \
                     through before it on the way back: it would give energy in a cycle. Make it softer, or choose \
                     `rule: Iwan`"
                );
                return Err(ParameterError::inconsistent("force", message));
            }
        }
    }
    Ok(())
}

pub(super) fn respond(
    law: &MultilinearPlastic,
    step: Step,
    committed: &[f64],
    trial: &mut [f64],
) -> Answer {
    let [up, down] = [law.branch(1.0), law.branch(-1.0)];
    let ahead = if step.direction < 0.0 { down } else { up };
    let slope = |x: f64, j: usize| {
        let upwards = x > 0.0 || (x == 0.0 && step.direction >= 0.0);
        if upwards { up.slope(j) } else { down.slope(j) }
    };
    let corners = committed.len();
    let mut out = Answer::default();
    // Sums up to the line before, at the start and at the end of the step, and what is left of the motion after it.
    let (mut before0, mut before, mut left) = (0.0, 0.0, step.d - step.d0);
    let mut moves = true;
    for j in 0..=corners {
        let (mut e0, mut e, mut beyond, mut ended) = (step.d0, step.d, 0.0, false);
        if j < corners {
            let (low, high) = (-iwan::corner(down, j), iwan::corner(up, j));
            let stretch = committed[j] + (step.d - step.d0);
            e0 = committed[j];
            e = stretch.clamp(low, high);
            beyond = stretch - e;
            let end = if step.direction > 0.0 { high } else { low };
            ended = step.direction != 0.0 && e == end;
            trial[j] = e;
        }
        let (x0, x) = (e0 - before0, e - before);
        let k = slope(x, j);
        out.f += k * x;
        out.stored += 0.5 * k * x * (e + before);
        if moves && !ended {
            out.k = k;
            moves = false;
        }
        let moved = (left - beyond).abs();
        if moved > 0.0 {
            let (d, f) = ahead.corner_before(j);
            out.heat += f * moved - d * (k * x - slope(x0, j) * x0).abs();
        }
        (before0, before, left) = (e0, e, beyond);
    }
    out
}
