//! Small models side by side, several to a core.

use crate::sweep::{Engine, Outcome, named};
use crate::{Analysis, Error};
use trilith_model::{Model, StepControl};
use trilith_results::Named;
use trilith_solvers::lanes::{self, LaneOutcome, LaneSetup, Tables};
use trilith_solvers::{Status, warnings_of_outputs};
use trilith_system::catch;

/// Why a model does not go side by side with others.
#[derive(Debug)]
pub enum Alone {
    /// It does not fit, for this reason.
    Unfit(String),
    /// Its lane found no equilibrium in however short a step.
    Lost,
    /// It ended as no model is meant to: the ordinary engine has something to say of it.
    Odd,
    /// It cannot be run at all.
    Failed(Error),
}

/// Runs models side by side where they fit (see [`solvers::lanes`](crate::solvers::lanes)). What their loads have in
/// common is made once.
#[derive(Debug)]
pub struct Lanes {
    tables: Tables,
    width: usize,
    integrals: Vec<(usize, Option<f64>)>,
}

impl Default for Lanes {
    fn default() -> Self {
        Self::new()
    }
}

impl Lanes {
    /// As many side by side as the machine's registers hold.
    #[must_use]
    pub fn new() -> Self {
        Self { tables: Tables::new(), width: lanes::width(), integrals: Vec::new() }
    }

    /// So many side by side at most: 1 runs each alone, with the same bits.
    #[must_use]
    pub fn at_most(self, width: usize) -> Self {
        Self { width: width.clamp(1, lanes::width()), ..self }
    }

    /// Outputs, by their index in the model, of which the time above a value is wanted, or, where there is none, the root
    /// of the mean square.
    #[must_use]
    pub fn over_time(self, outputs: Vec<(usize, Option<f64>)>) -> Self {
        Self { integrals: outputs, ..self }
    }

    /// How many go side by side at most.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Whether a case of a model fits; the reason where it does not.
    ///
    /// # Errors
    /// Where the case cannot be run at all.
    pub fn check(&self, model: &Model, case: usize) -> Result<Result<(), String>, Error> {
        Ok(self.prepare(model, case, None)?.map(drop))
    }

    /// Runs a case of each model. `substeps`: fixed steps, so many to an output step, whatever the models say.
    #[must_use]
    pub fn run(
        &self,
        cases: &[(&Model, usize)],
        substeps: Option<usize>,
    ) -> Vec<Result<Outcome, Alone>> {
        let mut all: Vec<_> = cases.iter().map(|_| Err(Alone::Lost)).collect();
        self.run_each(cases, substeps, &mut |i, outcome| {
            all[i] = outcome;
            true
        });
        all
    }

    /// The same; each outcome, with the index of its model, is `done` with as soon as it is there. Where that says no, no
    /// other is begun.
    pub fn run_each(
        &self,
        cases: &[(&Model, usize)],
        substeps: Option<usize>,
        done: &mut dyn FnMut(usize, Result<Outcome, Alone>) -> bool,
    ) {
        let setups = cases.iter().map(|(model, case)| {
            // The ordinary engine tells of a law that panics.
            match catch(|| self.prepare(model, *case, substeps)) {
                Ok(Ok(fit)) => fit.map(|s| s.take_over_time(&self.integrals)).map_err(Alone::Unfit),
                Ok(Err(e)) => Err(Alone::Failed(e)),
                Err(_) => Err(Alone::Unfit("a law that panics".into())),
            }
        });
        let mut ready: Vec<(usize, LaneSetup)> = Vec::with_capacity(cases.len());
        for (i, setup) in setups.enumerate() {
            match setup {
                Ok(setup) => ready.push((i, setup)),
                Err(alone) => {
                    if !done(i, Err(alone)) {
                        return;
                    }
                }
            }
        }
        let mut waiting: Vec<&(usize, LaneSetup)> = ready.iter().collect();
        let mut goes_on = true;
        while let Some((_, first)) = waiting.first().copied().filter(|_| goes_on) {
            let (group, rest): (Vec<_>, Vec<_>) =
                waiting.into_iter().partition(|(_, setup)| first.fits(setup));
            let own: Vec<&LaneSetup> = group.iter().map(|(_, setup)| setup).collect();
            lanes::march(&own, self.width, &mut |place, lane| {
                let (i, setup) = group[place];
                let (model, case) = cases[*i];
                goes_on = done(*i, outcome(model, case, setup, lane));
                goes_on
            });
            waiting = rest;
        }
    }

    fn prepare(
        &self,
        model: &Model,
        case: usize,
        substeps: Option<usize>,
    ) -> Result<Result<LaneSetup, String>, Error> {
        let trilith_model::Analysis::Dynamic(analysis) = &model.cases[case].analysis else {
            return Ok(Err("a static case".into()));
        };
        let fixed = substeps.map(|substeps| StepControl::Fixed { substeps });
        let control = fixed.unwrap_or(analysis.solution.step);
        let made = Analysis::new(model)?;
        Ok(lanes::prepare(model, made.system(), case, control, &self.tables)?)
    }
}

fn outcome(
    model: &Model,
    case: usize,
    setup: &LaneSetup,
    lane: LaneOutcome,
) -> Result<Outcome, Alone> {
    if lane.lost.is_some() {
        return Err(Alone::Lost);
    }
    let share = lane.energy.error_relative;
    // Of a law that does not account for its work the ordinary engine tells the name.
    if lane.noticed || share > setup.energy_limit && setup.asks_links() {
        return Err(Alone::Odd);
    }
    let names = model.outputs.iter().map(|o| o.name.clone());
    let status = if share > setup.energy_limit {
        Status::EnergyError { share, limit: setup.energy_limit }
    } else if let Some((t, body)) = lane.overturned {
        let body = model.elements.get(body).map(|e| e.name.clone()).unwrap_or_default();
        Status::Overturned { t, body }
    } else {
        Status::Converged
    };
    // A model that has run can be assembled.
    let warnings = warnings_of_outputs(model, case, (&status, &lane.outputs)).unwrap_or_default();
    Ok(Outcome {
        engine: Engine::Lanes,
        warnings,
        status,
        integrals: lane.integrals,
        outputs: Named(names.zip(lane.outputs).collect()),
        energy: lane.energy,
        link_energy: named(model, &lane.link_energy),
        contact: lane.contact,
        steps: lane.steps,
        iterations: lane.iterations,
    })
}
