//! The link side of a step: loads and pseudo-forces, the link equations, the books.

use super::propagator::Forces;
use super::state::{LinksBefore, State, StepEnergy, StepFailure};
use crate::kernel::{Affine, Committed, Compliance, Converged, Guess, Layout, LinkKernel, Wanted};
use crate::structure::ReducedSystem;
use trilith_element::Energy;
use trilith_model::Model;
use trilith_system::{Answers, Channel, Laws, LinkSet, LoadSet, StepLoads, System};

/// What one motion needs beside the propagator, kept so that a step allocates nothing.
pub(crate) struct LinkEquations<'a> {
    model: &'a Model,
    system: &'a System,
    loads: &'a LoadSet,
    pub kernel: LinkKernel<'a>,
    load0: Vec<f64>,
    load1: Vec<f64>,
    /// Of the loads at the end.
    amplitudes: Vec<f64>,
    /// Deformation that moving supports give the links at the start and the end, and its rate at the end.
    support0: Vec<f64>,
    support1: Vec<f64>,
    support_rate: Vec<f64>,
    /// Rates of the active coordinates at the end, where laws left some open.
    rates: Vec<f64>,
    /// Flat coordinates with an effective stiffness, and that.
    effective: Vec<(usize, f64)>,
    /// True where supports move links.
    moving: bool,
    /// True where outputs or the view of contacts may need rates that no law depends on.
    watched: bool,
}

impl<'a> LinkEquations<'a> {
    /// `order`: number of coordinates of the solver; `watched`: whether somebody may need rates that no law depends
    /// on.
    pub(crate) fn new(
        model: &'a Model,
        system: &'a System,
        loads: &'a LoadSet,
        kernel: LinkKernel<'a>,
        order: usize,
        watched: bool,
    ) -> Self {
        let (flat, active) = (system.links.len(), system.links.active.len());
        let Layout { links, effective_k, .. } = kernel.layout();
        let effective = links.active.iter().copied().zip(effective_k.iter().copied());
        let effective = effective.filter(|(_, k)| *k != 0.0).collect();
        let moves = |c: &Channel| !c.deformation.is_empty() || !c.rate.is_empty();
        Self {
            model,
            system,
            loads,
            kernel,
            load0: vec![0.0; order],
            load1: vec![0.0; order],
            amplitudes: Vec::new(),
            support0: vec![0.0; flat],
            support1: vec![0.0; flat],
            support_rate: vec![0.0; flat],
            rates: vec![0.0; active],
            effective,
            moving: loads.channels.iter().any(moves),
            watched,
        }
    }

    pub(crate) fn links(&self) -> &'a LinkSet {
        &self.system.links
    }

    /// The laws of all links.
    pub(crate) fn laws(&self) -> Laws<'a> {
        self.system.links.laws(self.model)
    }

    /// Rates that supports give the links at the end of the step begun last, flat.
    pub(crate) fn support_rates(&self, to: &mut [f64]) {
        if self.moving { to.copy_from_slice(&self.support_rate) } else { to.fill(0.0) }
    }

    /// Deformations that moving supports give the links at both ends of the step begun last, flat.
    pub(crate) fn supports(&self) -> Option<[&[f64]; 2]> {
        self.moving.then_some([&self.support0, &self.support1])
    }

    /// Flat link coordinates with an effective stiffness, and that.
    pub(crate) fn effective(&self) -> &[(usize, f64)] {
        &self.effective
    }

    /// Loads of a step, and a place for its end.
    #[inline]
    pub(crate) fn begin(
        &mut self,
        space: &ReducedSystem,
        from: &State,
        to: &mut State,
        loads: &StepLoads,
        energy: &mut StepEnergy,
    ) {
        if self.moving {
            for x in [&mut self.support0, &mut self.support1, &mut self.support_rate] {
                x.fill(0.0);
            }
            self.loads.support_deformation(
                &loads.start,
                &mut self.support0,
                &mut self.support_rate,
            );
            self.support_rate.fill(0.0);
            self.loads.support_deformation(&loads.end, &mut self.support1, &mut self.support_rate);
        }
        to.follow(from);
        // What a law does not write shows.
        to.history.fill(f64::NAN);
        energy.links.resize(self.system.links.links.len(), Energy::default());
        if loads.start == self.amplitudes {
            std::mem::swap(&mut self.load0, &mut self.load1);
        } else {
            space.force_into(&loads.start, &mut self.load0);
        }
        space.force_into(&loads.end, &mut self.load1);
        self.amplitudes.clone_from(&loads.end);
    }

    /// Loads and these pseudo-forces at both ends.
    pub(crate) fn forces<'f>(&'f self, pseudo0: &'f [f64], pseudo1: &'f [f64]) -> Forces<'f> {
        Forces { loads: [&self.load0, &self.load1], pseudo0, pseudo1 }
    }

    /// The same with the pseudo-forces at the end as they are at the start, and where the predicted d and v of the
    /// active coordinates go.
    #[inline]
    pub(crate) fn prediction<'f>(&'f mut self, from: &'f State) -> (Forces<'f>, Wanted<'f>) {
        let Self { load0, load1, kernel, .. } = self;
        let pseudo = &from.pseudo;
        (Forces { loads: [load0, load1], pseudo0: pseudo, pseudo1: pseudo }, kernel.wanted())
    }

    /// Solves the link equations.
    #[inline]
    pub(crate) fn solve(
        &mut self,
        compliance: &Compliance,
        from: &State,
        to: &mut State,
        dt: f64,
        energy: &mut StepEnergy,
    ) -> Result<(), StepFailure> {
        let Self { kernel, support1, support_rate, .. } = self;
        let support = self.moving.then_some([&support1[..], &support_rate[..]]);
        let affine = affine(compliance, support);
        let (start, out) = (&committed(from, dt), &mut converged(to, &mut energy.links));
        kernel.solve(&affine, &from.pseudo, Guess::Tangents, start, &from.scale, out).map_err(|e| {
            kernel.show(out);
            StepFailure::from(e)
        })
    }

    /// Takes up the link equations at the predicted d and v, with the pseudo-forces that the tangents at the
    /// start of the step predict: true where deformations must follow them.
    pub(crate) fn take_up(
        &mut self,
        compliance: &Compliance,
        from: &State,
        to: &mut State,
        dt: f64,
    ) -> bool {
        let Self { kernel, support1, support_rate, .. } = self;
        let support = self.moving.then_some([&support1[..], &support_rate[..]]);
        let affine = affine(compliance, support);
        let start = &committed(from, dt);
        kernel.begin(&from.pseudo, start);
        kernel.predict(&affine, start, &mut converged(to, &mut []))
    }

    /// One iteration of the link equations; false where deformations must follow, as [`LinkKernel::change`] says.
    pub(crate) fn iterate(
        &mut self,
        compliance: &Compliance,
        from: &State,
        to: &mut State,
        dt: f64,
        energy: &mut StepEnergy,
    ) -> Result<bool, StepFailure> {
        let Self { kernel, support1, support_rate, .. } = self;
        let support = self.moving.then_some([&support1[..], &support_rate[..]]);
        let affine = affine(compliance, support);
        let out = &mut converged(to, &mut energy.links);
        kernel.advance(&affine, &committed(from, dt), &from.scale, out).map_err(StepFailure::from)
    }

    /// Where the rates of the active coordinates go once the motion is complete, if the laws left some open and
    /// somebody needs them; else those stay zero.
    #[inline]
    pub(crate) fn open_rates(&mut self) -> Option<&mut [f64]> {
        (self.watched && !self.kernel.layout().rate_independent.is_empty())
            .then_some(&mut self.rates)
    }

    /// Rates of a state that was made while nobody needed them; `t` is its time, s.
    pub(crate) fn recall_rates(&mut self, space: &ReducedSystem, t: f64, state: &mut State) {
        let Some(rates) = self.open_rates() else { return };
        let n = space.order();
        space.links.deform(&state.motion[n..2 * n], rates);
        let mut now = StepLoads::default();
        self.loads.step(t, t, &mut now);
        self.support_rate.fill(0.0);
        self.loads.support_deformation(&now.end, &mut self.support0, &mut self.support_rate);
        for (a, flat) in &self.kernel.layout().rate_independent {
            state.v[*flat] = self.support_rate[*flat] + self.rates[*a];
        }
    }

    /// Takes note of a converged step whose motion is complete.
    #[inline]
    pub(crate) fn finish(&mut self, to: &mut State, energy: &StepEnergy) {
        if self.watched && self.kernel.layout().complete && !self.moving {
            self.kernel.layout().rate_dependent.iter().for_each(|a| self.rates[*a] = to.v[*a]);
            to.v.copy_from_slice(&self.rates);
        } else if self.watched {
            for (a, flat) in &self.kernel.layout().rate_independent {
                to.v[*flat] = self.support_rate[*flat] + self.rates[*a];
            }
        }
        to.record_converged(&self.system.links, &energy.links, self.kernel.largest_force());
    }

    /// Enters a step, taking the effective stiffnesses out of the books: what they store belongs to the links.
    #[inline]
    pub(crate) fn book(
        &self,
        from: &State,
        to: &State,
        (kinetic, strain): (f64, f64),
        energy: &mut StepEnergy,
    ) {
        let (support0, support1) = (&self.support0, &self.support1);
        (energy.kinetic, energy.strain) = (kinetic, strain);
        energy.link_work = energy.work.links;
        for (flat, k) in &self.effective {
            let (d0, d1) = (from.d[*flat] - support0[*flat], to.d[*flat] - support1[*flat]);
            energy.strain -= 0.5 * k * d1 * d1;
            energy.link_work += 0.5 * k * (d1 * d1 - d0 * d0);
        }
        energy.support = 0.0;
        if self.moving {
            for i in 0..from.d.len() {
                energy.support += 0.5 * (from.f[i] + to.f[i]) * (support1[i] - support0[i]);
            }
        }
    }

    /// A state at rest or in given motion of the free DOFs, accelerations still missing, and the force that
    /// causes them.
    pub(crate) fn start(
        &self,
        space: &ReducedSystem,
        u: &[f64],
        v: &[f64],
        before: &LinksBefore,
        amplitudes: &[f64],
    ) -> (State, Vec<f64>) {
        let (q, p) = (space.coordinates(self.system, u), space.coordinates(self.system, v));
        let links = &self.system.links;
        let (mut d, mut rate) = (vec![0.0; links.len()], vec![0.0; links.len()]);
        self.loads.support_deformation(amplitudes, &mut d, &mut rate);
        let support_d = d.clone();
        let mut own = vec![0.0; links.active.len()];
        for (motion, flat) in [(&q, &mut d), (&p, &mut rate)] {
            space.links.deform(motion, &mut own);
            for (a, i) in links.active.iter().enumerate() {
                flat[*i] += own[a];
            }
        }
        let mut state = State::of_links(self.model, links, before, d, rate);
        let mut force = space.force(amplitudes);
        space.damp(-1.0, &p, &mut force);
        space.stiffness.mul_add(-1.0, &q, &mut force);
        self.kernel.pseudo(&state.f, &state.d, &support_d, &mut own);
        space.links.spread(-1.0, &own, &mut force);
        state.pseudo = own;
        state.motion = [q, p].concat();
        (state, force)
    }
}

fn committed(from: &State, dt: f64) -> Committed<'_> {
    let State { d, v, f, history, tangents, extrapolation, .. } = from;
    Committed { d, v, f, history, tangents, extrapolation, dt }
}

fn converged<'a>(to: &'a mut State, energy: &'a mut [Energy]) -> Converged<'a> {
    let State { d, v, f, history, tangents, pseudo, extrapolation, .. } = to;
    Converged { d, v, laws: Answers { history, f, tangents, energy }, pseudo, extrapolation }
}

fn affine<'a>(compliance: &'a Compliance, support: Option<[&'a [f64]; 2]>) -> Affine<'a> {
    let Compliance { g, h, key } = compliance;
    Affine { support, g, h, key }
}
