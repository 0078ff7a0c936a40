//! What is counted and seen on the way of a march, apart from the motion: energies, extremes of outputs, contacts.

use super::contact::Feet;
use super::outputs::Extremes;
use super::plan::{Plan, pick};
use super::setup::LaneSetup;
use trilith_element::Contact;
use trilith_element::lanes::{Arithmetic, LaneContact, Real, Task};

/// What is counted and seen.
#[derive(Clone)]
pub(super) struct Record<R: Real> {
    /// What the contacts do, and which links have overturned (1, else 0), after the step that was accounted for last.
    pub contacts: Vec<LaneContact<R>>,
    pub fallen: Vec<R>,
    /// Heat of each link: hysteretic, viscous.
    pub heat: Vec<[R; 2]>,
    pub external: R,
    pub damping: R,
    pub kinetic: R,
    pub strain: R,
    pub potential: R,
    pub stored: R,
    pub largest: R,
    pub kinetic0: R,
    pub strain0: R,
    pub stored0: R,
    pub potential0: R,
    /// Steps.
    pub count: R,
    pub peaks: Extremes<R>,
    pub feet: Feet<R>,
}

impl<R: Real> Record<R> {
    pub fn new<A: Arithmetic<Real = R>, const M: usize, const L: usize, const N: usize>(
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
    ) -> Self {
        let one = setups[0];
        let zero = with.splat(0.0);
        let get = |of: &dyn Fn(&LaneSetup) -> f64| pick(with, setups, of);
        let links = one.forms.len();
        let feet: Vec<&[Contact]> = setups.iter().map(|s| &s.contacts[..]).collect();
        let stands = setups.iter().map(|s| s.stands).collect();
        let plane = one.forms.iter().all(|f| f.extent.coordinates < 3);
        let [kinetic, strain] = [get(&|s| s.kinetic), get(&|s| s.strain)];
        let [potential, stored] = [get(&|s| s.potential), get(&|s| s.stored.iter().sum())];
        Self {
            contacts: vec![LaneContact::smooth(zero, zero); plan.contacts],
            fallen: vec![zero; links],
            heat: vec![[zero; 2]; links],
            external: zero,
            damping: zero,
            kinetic,
            strain,
            potential,
            stored,
            largest: kinetic,
            kinetic0: kinetic,
            strain0: strain,
            stored0: stored,
            potential0: potential,
            count: zero,
            peaks: plan.outputs.extremes(with, setups),
            feet: Feet::new(with, &feet, stands, plane),
        }
    }

    /// The energy in motion: kinetic, and what springs and links hold more or less than at the start.
    #[inline(always)]
    pub fn in_motion(&self) -> R {
        let (strained, charged) = (self.strain - self.strain0, self.stored - self.stored0);
        self.kinetic + strained.abs() + charged.abs()
    }

    /// Takes the other where a mask says yes. What the contacts do is left.
    #[inline(always)]
    pub fn take(&mut self, mask: R::Mask, from: &Self) {
        for (to, from) in self.heat.as_flattened_mut().iter_mut().zip(from.heat.as_flattened()) {
            *to = R::select(mask, *from, *to);
        }
        for (to, from) in [
            (&mut self.external, &from.external),
            (&mut self.damping, &from.damping),
            (&mut self.kinetic, &from.kinetic),
            (&mut self.strain, &from.strain),
            (&mut self.potential, &from.potential),
            (&mut self.stored, &from.stored),
            (&mut self.largest, &from.largest),
            (&mut self.count, &from.count),
        ] {
            *to = R::select(mask, *from, *to);
        }
        self.peaks.keep(!mask, &from.peaks);
        self.feet.keep(!mask, &from.feet);
    }
}

/// What [`Record::take`] does, by a call.
#[inline(never)]
pub(super) fn take_record<A: Arithmetic>(
    with: A,
    mask: <A::Real as Real>::Mask,
    from: &Record<A::Real>,
    to: &mut Record<A::Real>,
) {
    with.run(TakeRecord { mask, from, to });
}

/// What [`Record::take`] does, as a task.
struct TakeRecord<'a, R: Real> {
    mask: R::Mask,
    from: &'a Record<R>,
    to: &'a mut Record<R>,
}

impl<A: Arithmetic> Task<A> for TakeRecord<'_, A::Real> {
    type Output = ();

    #[inline(always)]
    fn run(self, _: A) {
        self.to.take(self.mask, self.from);
    }
}
