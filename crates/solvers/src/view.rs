//! Shows accepted states to the observers.

use crate::ledger::Ledger;
use crate::observe::{EnergyTotals, Observer, Sample, Shape};
use crate::outputs::Outputs;
use crate::space::Space;
use crate::stepper::State;
use trilith_element::{Contact, Kinematics};
use trilith_model::{Model, Side};
use trilith_system::{LoadSet, System};

/// Displacements of all nodes of one state.
struct Figure<'a> {
    system: &'a System,
    space: &'a Space,
    state: &'a State,
    prescribed: Vec<f64>,
}

impl Shape for Figure<'_> {
    fn displacements(&self, u: &mut [f64]) {
        let free = self.space.expand(&self.state.motion[..self.space.order()]);
        for (full, x) in u.iter_mut().enumerate() {
            *x = self
                .system
                .reduction
                .expand(full)
                .iter()
                .map(|(j, c)| c * free.get(*j).unwrap_or_else(|| &self.prescribed[j - free.len()]))
                .sum();
        }
    }
}

/// Shows accepted substeps to the observers.
pub(crate) struct Viewer<'a, 'b> {
    model: &'a Model,
    system: &'a System,
    loads: &'a LoadSet,
    outputs: Outputs,
    values: Vec<f64>,
    rates: Vec<f64>,
    observers: &'a mut [&'b mut dyn Observer],
}

impl<'a, 'b> Viewer<'a, 'b> {
    pub(crate) fn new(
        model: &'a Model,
        system: &'a System,
        loads: &'a LoadSet,
        space: &Space,
        observers: &'a mut [&'b mut dyn Observer],
    ) -> Self {
        let count = model.outputs.len();
        Self {
            model,
            system,
            loads,
            outputs: Outputs::new(model, system, space),
            values: vec![0.0; count],
            rates: vec![0.0; count],
            observers,
        }
    }

    /// True where nobody looks.
    pub(crate) fn is_idle(&self) -> bool {
        self.observers.is_empty()
    }

    /// Shows a state; `step` is the index of the output step that ends there.
    pub(crate) fn show(
        &mut self,
        t: f64,
        step: Option<usize>,
        state: &State,
        space: &Space,
        ledger: &Ledger,
    ) {
        if self.observers.is_empty() {
            return;
        }
        self.outputs.evaluate(t, state, self.loads, &mut self.values, &mut self.rates);
        let contacts = contacts(self.model, self.system, state);
        let overturned = overturned(self.model, self.system, state);
        let count = self.system.reduction.prescribed.len();
        let [prescribed, _, _] = self.loads.prescribed(t, Side::Before, count);
        let shape = Figure { system: self.system, space, state, prescribed };
        for observer in self.observers.iter_mut() {
            observer.sample(&Sample {
                t,
                output_step: step,
                values: &self.values,
                rates: &self.rates,
                energy: &ledger.totals,
                contacts: &contacts,
                overturned,
                shape: &shape,
            });
        }
    }
}

/// Index of the element of the first body that has fallen over.
pub(crate) fn overturned(model: &Model, system: &System, state: &State) -> Option<usize> {
    let links = &system.links;
    let fallen = links.links.iter().find(|link| {
        let r = link.range.clone();
        let (d, v) = (&state.d[r.clone()], &state.v[r]);
        let at = Kinematics { d, v, d0: d, v0: v, dt: 0.0 };
        links
            .law(model, link)
            .is_some_and(|law| law.overturned(&at, &state.history[link.history.clone()]))
    });
    fallen.map(|link| link.element)
}

fn contacts(model: &Model, system: &System, state: &State) -> Vec<(usize, Contact)> {
    let links = &system.links;
    let (mut all, mut own) = (Vec::new(), Vec::new());
    for link in &links.links {
        let Some(law) = links.law(model, link) else { continue };
        let r = link.range.clone();
        let (d, v) = (&state.d[r.clone()], &state.v[r.clone()]);
        let at = Kinematics { d, v, d0: d, v0: v, dt: 0.0 };
        law.contacts(&at, &state.history[link.history.clone()], &state.f[r], &mut own);
        all.extend(own.drain(..).map(|c| (link.element, c)));
    }
    all
}

/// Shows the end of a static case: one sample at t = 0.
pub(crate) fn show_static(
    model: &Model,
    system: &System,
    state: &State,
    energy: EnergyTotals,
    observers: &mut [&mut dyn Observer],
) {
    let loads = LoadSet::default();
    let space = Space::physical(system, &loads, &vec![0.0; system.links.len()], None);
    let mut viewer = Viewer::new(model, system, &loads, &space, observers);
    let ledger = Ledger::of(energy);
    viewer.show(0.0, Some(0), state, &space, &ledger);
}
