//! Whether the step of another crate is one: finite, written in full, and linear.

use super::parts;
use trilith_element::{LinearStep, LinearStructure, Motion, MotionMut};

/// Share by which the step of a sum may differ from the sum of steps: rounding of a factor, and no more.
const LINEAR: f64 = 1e-6;

/// A motion with the forces at both ends of a step from it.
struct Trial {
    start: Vec<f64>,
    force: [Vec<f64>; 2],
}

impl Trial {
    /// Of a chain of numbers without a pattern, of the sizes that go with each other over such a step.
    fn new(structure: &dyn LinearStructure, dt: f64, seed: &mut u64) -> Self {
        let n = structure.order();
        let mut start: Vec<f64> = (0..3 * n).map(|_| next(seed)).collect();
        start[n..2 * n].iter_mut().for_each(|v| *v /= dt);
        start[2 * n..].iter_mut().for_each(|a| *a /= dt * dt);
        let force = [(); 2].map(|()| {
            let mut force = vec![0.0; n];
            let shape: Vec<f64> = (0..n).map(|_| next(seed)).collect();
            structure.mass(1.0 / (dt * dt), &shape, &mut force);
            structure.stiffness(1.0, &shape, &mut force);
            force
        });
        Self { start, force }
    }

    fn plus(&self, other: &Self) -> Self {
        let sum = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x + y).collect();
        let force = [0, 1].map(|i| sum(&self.force[i], &other.force[i]));
        Self { start: sum(&self.start, &other.start), force }
    }

    fn end(&self, step: &mut dyn LinearStep, structure: &dyn LinearStructure) -> Vec<f64> {
        let n = structure.order();
        let from =
            Motion { u: &self.start[..n], v: &self.start[n..2 * n], a: &self.start[2 * n..] };
        let mut end = vec![f64::NAN; 3 * n];
        let to: MotionMut<'_> = parts(&mut end);
        step.advance(structure, from, [&self.force[0], &self.force[1]], to);
        end
    }
}

/// A number between −1 and 1 \[Knuth's MMIX generator\].
fn next(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// What is wrong with a step, found by three trials.
pub(super) fn fault(
    step: &mut dyn LinearStep,
    structure: &dyn LinearStructure,
    dt: f64,
) -> Option<String> {
    let n = structure.order();
    let mut seed = 1;
    let [one, two] = [(); 2].map(|()| Trial::new(structure, dt, &mut seed));
    let both = one.plus(&two).end(step, structure);
    let apart = [one, two].map(|trial| trial.end(step, structure));
    for (part, name) in ["displacement", "velocity", "acceleration"].into_iter().enumerate() {
        let range = part * n..(part + 1) * n;
        let all = [&both[range.clone()], &apart[0][range.clone()], &apart[1][range]];
        if let Some(i) = (0..n).find(|i| all.iter().any(|x| !x[*i].is_finite())) {
            return Some(format!(
                "its step leaves the {name} of coordinate {} of {n} unwritten, or no finite number",
                i + 1
            ));
        }
        let size = all.iter().flat_map(|x| x.iter()).fold(0.0_f64, |m, x| m.max(x.abs()));
        let off = (0..n).map(|i| (all[0][i] - all[1][i] - all[2][i]).abs()).fold(0.0, f64::max);
        if off > LINEAR * size {
            return Some(format!(
                "its step is not linear in motion and forces: the {name} at the end of a sum is {:.1e} of itself off the sum of the ends",
                off / size
            ));
        }
    }
    None
}
