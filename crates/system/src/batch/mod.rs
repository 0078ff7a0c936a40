//! Links of one law side by side in the lanes of a register.
//!
//! A law over lanes ([`LaneForm`](trilith_element::lanes::LaneForm)) answers for several links at once. Forces are what the
//! iteration of a step goes by: tangents, histories and energies go to their places once at its end.

#[cfg(target_arch = "x86_64")]
mod pack;
#[cfg(target_arch = "x86_64")]
mod places;

use crate::links::{Answers, LinkInstance, Tangents};
use std::fmt::Debug;
#[cfg(target_arch = "x86_64")]
use trilith_element::lanes::{Avx2Lanes, Avx512Lanes};
use trilith_element::{Kinematics, Link};

/// Links of one law that are asked together.
pub(crate) trait Pack: Debug {
    /// Index in the model of the first of its elements.
    fn element(&self) -> usize;

    /// Takes up a step from the deformations and rates at its start.
    fn start(&mut self, at: &Kinematics<'_>, committed: &[f64]);

    /// Forces; `last`: whether the step may well end here, so that tangents go with them.
    fn respond(&mut self, at: &Kinematics<'_>, last: bool, to: &mut Answers<'_>);

    /// Tangents that still wait.
    fn tangents(&mut self, to: &mut Tangents);

    /// Tangents that still wait, history and energies of the step at the forces asked for last.
    fn commit(&mut self, to: &mut Answers<'_>);
}

type Laws<'a> = [(&'a dyn Link, &'a LinkInstance)];

/// The packs of those of some links that have a law over lanes in company, and the indices of the others.
pub(crate) fn packs(laws: &Laws<'_>, some: Vec<usize>) -> (Vec<Box<dyn Pack>>, Vec<usize>) {
    #[cfg(target_arch = "x86_64")]
    if let Some(with) = Avx512Lanes::available() {
        return pack::packs_of(with, laws, some);
    }
    #[cfg(target_arch = "x86_64")]
    if let Some(with) = Avx2Lanes::available() {
        return pack::packs_of(with, laws, some);
    }
    // Other processors ask them one by one.
    _ = laws;
    (Vec::new(), some)
}
