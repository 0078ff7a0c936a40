//! One motion among several.

use crate::fna::{ModalLoads, Modes};
use crate::march::{Segment, StepControlState, Timeline, jump, potential};
use crate::record::{Ledger, Viewer};
use crate::step::{LinkEquations, State, StepEnergy, is_sound};
use crate::structure::ReducedSystem;
use trilith_system::{LoadSet, StepLoads};

/// One motion, its link side, its books and who watches it.
pub(super) struct Course<'a, 'b> {
    pub side: LinkEquations<'a>,
    pub loads: &'a LoadSet,
    pub timeline: Timeline,
    pub state: State,
    pub control: StepControlState,
    pub ledger: Ledger,
    pub viewer: Viewer<'a, 'b>,
    /// Forces of constant loads in the coordinates of the modes.
    pub constant: Vec<f64>,
    /// Output steps made.
    pub made: usize,
    /// Steps made.
    pub substeps: usize,
    /// True for a course that ends before its time, in lock step.
    pub left: bool,
    /// Index of the element of a body that has fallen over; the course ends there.
    pub fallen: Option<usize>,
    modal_loads: ModalLoads,
    next: State,
    energy: StepEnergy,
    step_loads: StepLoads,
    converged: bool,
    /// Segments of the output step under way.
    segments: Vec<Segment>,
    /// End of the step under way, s.
    at: f64,
}

impl<'a, 'b> Course<'a, 'b> {
    pub(crate) fn new(
        space: &ReducedSystem,
        side: LinkEquations<'a>,
        loads: &'a LoadSet,
        timeline: Timeline,
        (state, control, ledger): (State, StepControlState, Ledger),
        viewer: Viewer<'a, 'b>,
    ) -> Self {
        let layout = side.kernel.layout();
        let modal_loads = ModalLoads::new(space, &layout.rate_dependent, &layout.damped);
        Self {
            constant: crate::march::constant_force(space, loads),
            modal_loads,
            side,
            loads,
            timeline,
            state,
            control,
            ledger,
            viewer,
            made: 0,
            substeps: 0,
            left: false,
            fallen: None,
            next: State::default(),
            energy: StepEnergy::default(),
            step_loads: StepLoads::default(),
            converged: false,
            segments: Vec::new(),
            at: 0.0,
        }
    }

    /// True while it goes on with the others.
    pub(crate) fn is_on_the_way(&self) -> bool {
        !self.left && self.fallen.is_none() && self.made < self.timeline.steps
    }

    pub(super) fn is_converged(&self) -> bool {
        self.converged
    }

    /// Shows the state it starts from.
    pub(super) fn show_start(&mut self) {
        self.viewer.start(self.timeline.steps);
        self.viewer.show(self.timeline.time(0), Some(0), &self.state, &self.ledger);
    }

    /// Tells that it has ended.
    pub(super) fn show_end(&mut self) {
        self.viewer.end(&self.state, &self.ledger);
    }

    /// Lengths of the segments of the output step under way.
    pub(super) fn lengths(&self) -> Vec<f64> {
        self.timeline.pieces(self.made).map(|segment| segment.length).collect()
    }

    /// An output step starts. One that loads cut otherwise than that of the others leaves them.
    pub(super) fn set_out(&mut self, lengths: &[f64]) {
        self.segments.clear();
        self.segments.extend(self.timeline.pieces(self.made));
        let same = self.segments.iter().map(|segment| &segment.length).eq(lengths);
        self.left = !same;
    }

    /// A segment of the output step starts: a load may jump there.
    pub(crate) fn set_off(&mut self, segment: usize, modes: &Modes) {
        let start = self.segments[segment].start;
        if start > 0.0 && self.timeline.is_jump(start) {
            self.step_loads.cut();
            if let Some(change) = jump(self.loads, start) {
                modes.jump(&mut self.state.motion, &change);
                self.viewer.show_behind(start, &self.state, &self.ledger);
            }
        }
    }

    /// The end of an output step.
    pub(crate) fn arrive(&mut self) {
        self.made += 1;
        let t = self.timeline.time(self.made);
        self.viewer.show(t, Some(self.made), &self.state, &self.ledger);
        self.fallen = self.viewer.overturned(&self.state);
    }

    /// Takes up one part of so many of a segment of the output step.
    pub(super) fn begin(&mut self, space: &ReducedSystem, segment: usize, part: usize, of: usize) {
        let Segment { start: t0, end: t1, .. } = self.segments[segment].part(part, of);
        self.loads.step(t0, t1, &mut self.step_loads);
        self.side.begin(space, &self.state, &mut self.next, &self.step_loads, &mut self.energy);
        self.converged = false;
        self.at = t1;
    }

    /// Pseudo-forces to be spread, and where.
    pub(super) fn spread_start(&mut self) -> Option<(&[f64], &mut [f64])> {
        let pseudo = &self.state.pseudo[..];
        self.modal_loads.renew_spread(pseudo).map(|to| (pseudo, to))
    }

    /// The same at the end of the step.
    pub(super) fn spread_end(&mut self) -> Option<(&[f64], &mut [f64])> {
        let pseudo = &self.next.pseudo[..];
        self.modal_loads.renew_spread(pseudo).map(|to| (pseudo, to))
    }

    pub(super) fn predict(&mut self, modes: &Modes) {
        let forces = self.side.forces(&self.state.pseudo, &self.next.pseudo);
        modes.predict(
            &mut self.modal_loads,
            &self.state.motion,
            &forces.loads,
            &mut self.next.motion,
        );
    }

    /// Displacements as predicted, and where those of the links go; rates that laws depend on are put in place.
    pub(super) fn predicted(&mut self, modes: &Modes) -> (&[f64], &mut [f64]) {
        let m = modes.space.order();
        let (displacement, rest) = self.next.motion.split_at(m);
        let wanted = self.side.kernel.wanted();
        self.modal_loads.rates(&modes.space.links, &rest[..m], wanted.v);
        (displacement, wanted.d)
    }

    /// True where deformations must follow what is predicted.
    pub(super) fn take_up(&mut self, modes: &Modes, dt: f64) -> bool {
        self.side.take_up(modes.compliance(), &self.state, &mut self.next, dt)
    }

    pub(super) fn iterate(&mut self, modes: &Modes, dt: f64) {
        let (from, to) = (&self.state, &mut self.next);
        match self.side.iterate(modes.compliance(), from, to, dt, &mut self.energy) {
            Ok(converged) => self.converged = converged,
            Err(_) => (self.left, self.converged) = (true, true),
        }
    }

    /// The last change of the pseudo-forces, and the deformations that must follow, where they have not done so
    /// with it; the rates have.
    pub(super) fn change(&mut self, modes: &Modes) -> Option<(&[f64], &mut [f64])> {
        self.side.kernel.change(&modes.compliance().h)
    }

    pub(super) fn correct(&mut self, modes: &Modes) {
        let forces = self.side.forces(&self.state.pseudo, &self.next.pseudo);
        modes.complete(
            &mut self.modal_loads,
            &self.state.motion,
            &forces.loads,
            &mut self.next.motion,
        );
    }

    /// Velocities, and where those of the links go, if the laws left some open.
    pub(super) fn rates(&mut self, modes: &Modes) -> Option<(&[f64], &mut [f64])> {
        let m = modes.space.order();
        let rates = self.side.open_rates()?;
        Some((&self.next.motion[m..2 * m], rates))
    }

    /// Closes the books of a step and makes its end the start of the next.
    pub(super) fn accept(&mut self, modes: &Modes) {
        let Self { side, state, next, energy, modal_loads, .. } = self;
        side.finish(next, energy);
        if !is_sound(next, &energy.links) {
            // Alone it says which law is to blame.
            self.left = true;
            return;
        }
        energy.work = modes.work(modal_loads);
        let of_motion = (energy.work.kinetic, energy.work.strain);
        side.book(state, next, of_motion, energy);
        self.ledger.enter(&self.energy, potential(&self.constant, &self.next));
        if self.at < self.timeline.time(self.made + 1) - 1e-12 * self.timeline.dt {
            self.viewer.show(self.at, None, &self.next, &self.ledger);
        }
        std::mem::swap(&mut self.state, &mut self.next);
        self.substeps += 1;
    }
}
