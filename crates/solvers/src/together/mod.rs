//! Several motions of one structure in lock step: FNA with fixed steps.
//!
//! Link maps and compliances are large matrices, and one motion uses each number of them once. Several
//! motions (records, scales, link laws of other strength) that share the structure share the reading: matrix
//! times matrix in place of matrix times vector. Every motion is iterated on its own and comes out as it
//! would alone.

mod course;

use crate::modal::Modes;
pub(crate) use course::Course;

/// One step of all courses that are on the way, from `index` to `index + 1` in parts of its step, over `dt`.
/// A course whose links find no equilibrium leaves the others.
pub(crate) fn step(modes: &mut Modes, courses: &mut [Course<'_, '_>], part: usize, dt: f64) {
    modes.prepare(dt);
    let modes = &*modes;
    let mut going: Vec<&mut Course<'_, '_>> =
        courses.iter_mut().filter(|c| c.is_on_the_way()).collect();
    going.iter_mut().for_each(|c| c.begin(&modes.space, part, dt));
    let mut pairs: Vec<_> = going.iter_mut().filter_map(|c| c.spread_start()).collect();
    modes.space.links.spread_each(&mut pairs);
    going.iter_mut().for_each(|c| c.predict(modes));
    let mut pairs: Vec<_> = going.iter_mut().flat_map(|c| c.predicted(modes)).collect();
    modes.space.links.deform_each(&mut pairs);
    going.iter_mut().for_each(|c| c.take_up(modes));
    loop {
        going.iter_mut().filter(|c| !c.is_settled()).for_each(|c| c.iterate(modes, dt));
        let open = going.iter_mut().filter(|c| c.is_on_the_way() && !c.is_settled());
        let mut pairs: Vec<_> = open.map(|c| c.change()).collect();
        if pairs.is_empty() {
            break;
        }
        modes.compliance().g.mul_add_each(-1.0, &mut pairs);
    }
    going.retain(|c| c.is_on_the_way());
    let mut pairs: Vec<_> = going.iter_mut().filter_map(|c| c.spread_end()).collect();
    modes.space.links.spread_each(&mut pairs);
    going.iter_mut().for_each(|c| c.correct(modes));
    let mut pairs: Vec<_> = going.iter_mut().filter_map(|c| c.rates(modes)).collect();
    modes.space.links.deform_each(&mut pairs);
    going.iter_mut().for_each(|c| c.accept(modes));
}
