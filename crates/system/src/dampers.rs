//! Links that are `f = c ḋ` at all times: nothing to ask their laws about in a step.

use crate::links::LinkInstance;
use trilith_element::{Energy, Kinematics, Link};

/// A linear dashpot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Damper {
    /// Index of the link.
    pub link: usize,
    coordinate: usize,
    c: f64,
}

impl Damper {
    /// The link with this index, where its law is a dashpot and nothing else.
    pub(crate) fn of(index: usize, law: &dyn Link, link: &LinkInstance) -> Option<Self> {
        let c = law.damping_constant().filter(|_| link.range.len() == 1)?;
        Some(Self { link: index, coordinate: link.range.start, c })
    }

    /// Force; the tangents are the same at all times.
    #[inline]
    pub(crate) fn force(&self, at: &Kinematics<'_>, f: &mut [f64]) {
        f[self.coordinate] = self.c * at.v[self.coordinate];
    }

    /// Energies of a step.
    #[inline]
    pub(crate) fn energy(&self, at: &Kinematics<'_>, energy: &mut [Energy]) {
        let i = self.coordinate;
        let viscous = at.viscous_work(i, self.c * at.v0[i], self.c * at.v[i]);
        energy[self.link] = Energy::new(0.0, 0.0, viscous);
    }
}
