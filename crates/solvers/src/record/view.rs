//! Shows accepted states to the observers.

use super::base_shear;
use super::coordinates::Coordinates;
use super::energy::EnergyTotals;
use super::inside::{Inside, Moment};
use super::ledger::Ledger;
use super::observer::{Observer, Sample, Shape};
use super::outputs::Outputs;
use crate::checks::{Noticed, Overlaps, Place, Pressed, rounded};
use crate::contacts::are_contacts;
use crate::modal::ClosedForm;
use crate::step::State;
use crate::structure::ReducedSystem;
use trilith_element::{Contact, Kinematics, Link, Outline, Vector3};
use trilith_model::{Load, Model, Output, Quantity, Side};
use trilith_system::{LinkInstance, LoadSet, System, blaming};

/// Displacements of all nodes of one state.
struct Figure<'a> {
    system: &'a System,
    coordinates: &'a Coordinates,
    state: &'a State,
    loads: &'a LoadSet,
    /// The links that have an outline.
    bodies: &'a [(&'a dyn Link, &'a LinkInstance)],
    at: (f64, Side),
}

impl Shape for Figure<'_> {
    fn pose(&self) -> Vec<f64> {
        let count = self.system.reduction.prescribed.len();
        let [prescribed, _, _] = self.loads.prescribed(self.at.0, self.at.1, count);
        [&self.state.motion[..self.coordinates.order], &prescribed].concat()
    }

    fn displacements(&self, poses: &[Vec<f64>], u: &mut [f64]) {
        let directions = u.len() / poses.len().max(1);
        let order = self.coordinates.order;
        let (motions, prescribed): (Vec<&[f64]>, Vec<&[f64]>) =
            poses.iter().map(|pose| pose.split_at(order)).unzip();
        let free = self.coordinates.leading(self.system, &motions, directions);
        let each = u.chunks_mut(directions.max(1)).zip(free.iter().zip(prescribed));
        for (u, (free, prescribed)) in each {
            let of = |j: usize| free.get(j).unwrap_or_else(|| &prescribed[j - free.len()]);
            for (full, x) in u.iter_mut().enumerate() {
                let terms = self.system.reduction.expand(full).iter();
                *x = terms.map(|(j, c)| c * of(*j)).sum();
            }
        }
    }

    fn outlines(&self, points: &mut Vec<Vector3>) {
        for (law, link) in self.bodies {
            let history = &self.state.history[link.history.clone()];
            points.extend(
                blaming(link.element, || law.outline(&standing(link, self.state), history))
                    .into_iter()
                    .flat_map(|o| o.points),
            );
        }
    }
}

/// Shows accepted substeps to the observers.
pub(crate) struct Viewer<'a, 'b> {
    system: &'a System,
    loads: &'a LoadSet,
    coordinates: Coordinates,
    outputs: Outputs,
    /// Those of other crates: index, name, and when it was first no number.
    derived: Vec<(usize, &'a str, Option<f64>)>,
    values: Vec<f64>,
    rates: Vec<f64>,
    /// Those shown before.
    before: (Vec<f64>, Vec<f64>),
    /// True where an observer needs them.
    rated: bool,
    /// Looks inside steps, where they may be long beside what swings.
    inside: Option<Inside>,
    /// The links that are contacts.
    touching: Vec<(&'a dyn Link, &'a LinkInstance)>,
    /// The links that have an outline.
    bodies: Vec<(&'a dyn Link, &'a LinkInstance)>,
    contacts: Vec<(usize, Contact)>,
    own: Vec<Contact>,
    /// The contact that was pressed in deepest so far.
    pressed: Pressed,
    /// Bodies that are or were in each other.
    overlaps: Overlaps<'a>,
    /// Number of load patterns.
    patterns: usize,
    /// Makes the base shear, where an observer needs it.
    shear: Option<base_shear::Rows>,
    /// The base shear of the state last shown, N.
    base_shear: [f64; 2],
    /// Time, the side of it, and output step last shown.
    last: (f64, Side, Option<usize>),
    observers: &'a mut [&'b mut dyn Observer],
}

/// Links that are shown beside the outputs.
struct Seen<'a> {
    /// Those with contacts.
    touching: Vec<(&'a dyn Link, &'a LinkInstance)>,
    /// Those with an outline.
    bodies: Vec<(&'a dyn Link, &'a LinkInstance)>,
}

impl<'a> Seen<'a> {
    fn new(model: &'a Model, system: &'a System) -> Self {
        let rest = vec![0.0; system.links.len()];
        let history = system.links.at_rest(model);
        let laws = system.links.laws(model);
        let has_outline = |(law, link): &(&dyn Link, &LinkInstance)| {
            let d = &rest[link.range.clone()];
            let at = Kinematics::still(d, d);
            blaming(link.element, || law.outline(&at, &history[link.history.clone()])).is_some()
        };
        let bodies = laws.iter().filter(has_outline).collect();
        let contacts = are_contacts(model, system);
        let touching = laws.iter().zip(contacts).filter_map(|(link, is)| is.then_some(link));
        Self { touching: touching.collect(), bodies }
    }
}

/// True where something beside the laws may need rates of deformation; `wanted`: whether an observer wants those
/// of outputs.
pub(crate) fn needs_rates(model: &Model, system: &System, wanted: bool) -> bool {
    let of_links = |o: &Output| matches!(o.quantity, Quantity::LinkDeformation { .. });
    let Seen { touching, bodies } = Seen::new(model, system);
    let outputs = wanted && model.outputs.iter().any(of_links);
    outputs || !touching.is_empty() || !bodies.is_empty()
}

/// The outputs of other crates, of which nothing is known.
fn derived(model: &Model) -> Vec<(usize, &str, Option<f64>)> {
    let all = model.outputs.iter().enumerate();
    let own = all.filter(|(_, o)| matches!(o.quantity, Quantity::Derived(_)));
    own.map(|(i, o)| (i, o.name.as_str(), None)).collect()
}

impl<'a, 'b> Viewer<'a, 'b> {
    pub(crate) fn new(
        model: &'a Model,
        system: &'a System,
        loads: &'a LoadSet,
        space: &ReducedSystem,
        observers: &'a mut [&'b mut dyn Observer],
    ) -> Self {
        let count = model.outputs.len();
        let sheared = observers.iter().any(|o| o.wants_base_shear());
        let Seen { touching, bodies } = Seen::new(model, system);
        let outlined: Vec<_> = bodies.iter().map(|(law, link)| (link.element, *law)).collect();
        Self {
            overlaps: Overlaps::new(model, &outlined),
            system,
            loads,
            coordinates: Coordinates::new(space.order(), space.shape.clone()),
            outputs: Outputs::new(model, system, space),
            derived: derived(model),
            values: vec![0.0; count],
            rates: vec![f64::NAN; count],
            before: (vec![0.0; count], vec![f64::NAN; count]),
            inside: None,
            rated: observers.iter().any(|o| o.wants_rates()),
            touching,
            bodies,
            contacts: Vec::new(),
            own: Vec::new(),
            pressed: Pressed::default(),
            patterns: model.patterns.len(),
            shear: sheared.then(|| base_shear::Rows::new(model, system, space)),
            base_shear: [f64::NAN; 2],
            last: (0.0, Side::After, None),
            observers,
        }
    }

    /// Looks inside steps of this length at most, whose motion has a closed form, going on from the largest values
    /// of an earlier part of the case.
    pub(crate) fn look_inside(
        &mut self,
        form: Option<ClosedForm>,
        longest: f64,
        largest: Vec<f64>,
    ) {
        let form = form.filter(|f| self.rated && Inside::is_worth(f, longest));
        self.inside = form.map(|f| Inside::new(f, &self.outputs, largest));
    }

    /// The largest values so far, where looks inside steps hang on them.
    pub(crate) fn largest(&self) -> Vec<f64> {
        self.inside.as_ref().map(|i| i.largest.clone()).unwrap_or_default()
    }

    /// What was noticed of contacts and bodies so far, as far as somebody watches.
    pub(crate) fn noticed(&self) -> Noticed {
        let told = self.overlaps.told(|t| match t {
            0.0 => "at the start".into(),
            t => format!("at t = {} s", rounded(t)),
        });
        let lost = self.derived.iter().filter_map(|(_, name, lost)| Some((*name, (*lost)?)));
        let without_number = lost.map(|(name, t)| {
            format!(
                "output \"{name}\" is no number at t = {} s: what makes it answers so",
                rounded(t)
            )
        });
        Noticed { pressed: self.pressed, said: told.into_iter().chain(without_number).collect() }
    }

    /// Tells that the run starts, with at most so many output steps to come.
    pub(crate) fn start(&mut self, steps: usize) {
        self.observers.iter_mut().for_each(|o| o.start(steps));
    }

    /// Shows a state; `step` is the index of the output step that ends there.
    pub(crate) fn show(&mut self, t: f64, step: Option<usize>, state: &State, ledger: &Ledger) {
        // Before a case there is nothing: what it starts from is what the loads make of it.
        let side = if t > 0.0 { Side::Before } else { Side::After };
        self.evaluate((t, side), step, state, ledger);
    }

    /// Shows a state just behind a time at which loads have jumped.
    pub(crate) fn show_behind(&mut self, t: f64, state: &State, ledger: &Ledger) {
        self.evaluate((t, Side::After), None, state, ledger);
    }

    fn evaluate(
        &mut self,
        (t, side): (f64, Side),
        step: Option<usize>,
        state: &State,
        ledger: &Ledger,
    ) {
        if self.observers.is_empty() {
            return;
        }
        std::mem::swap(&mut self.values, &mut self.before.0);
        std::mem::swap(&mut self.rates, &mut self.before.1);
        let now = self.outputs.at((t, side), state, self.loads);
        now.values(&mut self.values);
        for (i, _, lost) in &mut self.derived {
            if lost.is_none() && !self.values[*i].is_finite() {
                *lost = Some(t);
            }
        }
        if self.rated {
            now.rates(&self.values, &mut self.rates);
        }
        self.report_inside(t, &state.motion);
        self.touch(state);
        if step.is_some() {
            let place = Standing { bodies: &self.bodies, state };
            self.overlaps.see(t, &place, &self.contacts);
        }
        if let Some(shear) = &self.shear {
            let count = self.system.reduction.prescribed.len();
            let supports = shear.supported.then(|| self.loads.prescribed(t, side, count));
            let factors = match shear.loaded {
                true => self.loads.factors(self.patterns, t, side),
                false => Vec::new(),
            };
            let order = self.coordinates.order;
            self.base_shear = shear.at(order, state, supports.as_ref(), &factors);
        }
        self.last = (t, side, step);
        self.report(state, ledger, |o, sample| o.sample(sample));
    }

    /// Tells that the run ends, with the state that was shown last.
    pub(crate) fn end(&mut self, state: &State, ledger: &Ledger) {
        self.report(state, ledger, |o, sample| o.end(sample));
    }

    /// Hands what the outputs are inside the step that ends at `t` to the observers.
    fn report_inside(&mut self, t: f64, to: &[f64]) {
        let Self { inside: Some(inside), outputs, values, rates, before, last, observers, .. } =
            self
        else {
            return;
        };
        let length = t - last.0;
        let (moments, trusted) = inside.evaluate(outputs, to, length, values);
        if !moments.is_empty() {
            // What the motion does not give runs straight.
            let parts = |motion: &[f64]| {
                let mut own = (vec![0.0; values.len()], vec![0.0; values.len()]);
                outputs.of_motion(motion, &mut own.0, &mut own.1);
                own
            };
            let (from, end) = (parts(inside.from()), parts(to));
            let straight = |[a0, a]: [f64; 2], [b0, b]: [f64; 2], share: f64| {
                (1.0 - share) * (a - a0) + share * (b - b0)
            };
            for Moment { share, values: mut y, rates: mut r } in moments {
                for i in 0..y.len() {
                    y[i] += straight([from.0[i], before.0[i]], [end.0[i], values[i]], share);
                    r[i] += straight([from.1[i], before.1[i]], [end.1[i], rates[i]], share);
                }
                outputs.combine(&mut y, &mut r);
                if !trusted {
                    r.fill(f64::NAN);
                }
                let at = last.0 + share * length;
                observers.iter_mut().for_each(|o| o.between(at, &y, &r));
            }
        }
        if !trusted {
            rates.fill(f64::NAN);
        }
        inside.note(to, values);
    }

    /// Hands the values of the state shown last to the observers.
    #[inline]
    fn report(
        &mut self,
        state: &State,
        ledger: &Ledger,
        how: impl Fn(&mut dyn Observer, &Sample<'_>),
    ) {
        let overturned = self.overturned(state);
        let (t, side, output_step) = self.last;
        let shape = Figure {
            system: self.system,
            coordinates: &self.coordinates,
            state,
            loads: self.loads,
            bodies: &self.bodies,
            at: (t, side),
        };
        for observer in self.observers.iter_mut() {
            let sample = Sample {
                t,
                output_step,
                values: &self.values,
                rates: &self.rates,
                energy: &ledger.totals,
                contacts: &self.contacts,
                overturned,
                deformation: &state.d,
                force: &state.f,
                base_shear: self.base_shear,
                shape: &shape,
            };
            how(&mut **observer, &sample);
        }
    }

    /// Index of the element of the first body that has fallen over.
    #[inline]
    pub(crate) fn overturned(&self, state: &State) -> Option<usize> {
        if self.touching.is_empty() {
            return None;
        }
        let fallen = |(law, link): &(&dyn Link, &LinkInstance)| {
            let history = &state.history[link.history.clone()];
            blaming(link.element, || law.overturned(&standing(link, state), history))
        };
        self.touching.iter().find(|l| fallen(l)).map(|(_, link)| link.element)
    }

    /// Takes note of what the contacts do.
    fn touch(&mut self, state: &State) {
        self.contacts.clear();
        for (law, link) in &self.touching {
            let (history, f) = (&state.history[link.history.clone()], &state.f[link.range.clone()]);
            let own = &mut self.own;
            blaming(link.element, || law.contacts(&standing(link, state), history, f, own));
            self.contacts.extend(self.own.drain(..).map(|c| (link.element, c)));
        }
        self.pressed.see(&self.contacts);
    }
}

/// Bodies as they stand.
struct Standing<'a> {
    bodies: &'a [(&'a dyn Link, &'a LinkInstance)],
    state: &'a State,
}

impl Place for Standing<'_> {
    fn deformation(&self, body: usize) -> Option<&[f64]> {
        self.bodies.get(body).map(|(_, link)| &self.state.d[link.range.clone()])
    }

    fn outline(&self, body: usize) -> Option<Outline> {
        let (law, link) = self.bodies.get(body)?;
        let history = &self.state.history[link.history.clone()];
        blaming(link.element, || law.outline(&standing(link, self.state), history))
    }
}

/// A link as it stands, no step made.
fn standing<'a>(link: &LinkInstance, state: &'a State) -> Kinematics<'a> {
    let (d, v) = (&state.d[link.range.clone()], &state.v[link.range.clone()]);
    Kinematics::still(d, v)
}

/// Shows the end of a static case that holds these loads: one sample at t = 0.
pub(crate) fn show_static(
    model: &Model,
    system: &System,
    state: &State,
    energy: EnergyTotals,
    held: Vec<Load>,
    observers: &mut [&mut dyn Observer],
) -> Noticed {
    let loads = LoadSet { held, ..LoadSet::default() };
    let space = ReducedSystem::physical(system, &loads, &vec![0.0; system.links.len()], None);
    let mut viewer = Viewer::new(model, system, &loads, &space, observers);
    let ledger = Ledger::of(energy);
    viewer.start(0);
    viewer.show(0.0, Some(0), state, &ledger);
    viewer.end(state, &ledger);
    viewer.noticed()
}
