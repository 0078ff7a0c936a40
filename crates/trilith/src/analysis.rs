//! An assembled model and its runs.

use crate::reduce::{ReduceError, Reduced, Request, reduce};
use crate::{CaseRun, Error};
use std::ops::Deref;
use std::path::{Path, PathBuf};
use trilith_model::{Analysis as CaseAnalysis, Model};
use trilith_results::{Files, Peak, Recorder, Summary};
use trilith_solvers::{
    BaseShear, BaseShearSummary, BasisReport, BearingSummary, CaseResult, ContactMode,
    ContactSummary, Linearised, LinkStiffness, Observer, RunOptions, SoFar, StopSummary, Survey,
};
use trilith_system::System;

/// A model, assembled once, for any number of runs.
///
/// It borrows the model (`Analysis::new(&model)`), or shares it: one of an `Arc<Model>` may go wherever it likes.
///
/// ```
/// # let text = r#"(
/// #     plane: XZ, nodes: { "m": (0, 0, 0) }, supports: { "m": (Uz, Ry) },
/// #     elements: { "mass": Mass(node: "m", mass: "2 t"), "stop": Gap(node: "m", k: "50 MN/m", axis1: (-1, 0, 0)) },
/// #     cases: { "push": Dynamic(duration: "0.1 s", dt: "1 ms", initial: [(node: "m", dof: Ux, velocity: "1 m/s")]) },
/// #     outputs: { "x": Displacement(node: "m", dof: Ux) },
/// # )"#;
/// use std::sync::Arc;
/// use trilith::{Analysis, SolverKind};
///
/// let model = Arc::new(trilith::read_text(text, "stop.ron", &trilith::registry(), &[])?);
/// let analysis = Analysis::new(Arc::clone(&model))?;
/// let runs = std::thread::spawn(move || {
///     let fna = analysis.case("push")?.run()?;
///     let hht = analysis.case("push")?.solver(SolverKind::Hht).dt(5e-4).run()?;
///     Ok::<_, trilith::Error>([fna, hht])
/// });
/// let [fna, hht] = runs.join().expect("a thread")?;
/// assert!((fna.peak("x")?.max / hht.peak("x")?.max - 1.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Analysis<M> {
    model: M,
    system: System,
    frames: usize,
    histories: bool,
    loops: bool,
}

impl<M: Deref<Target = Model>> Analysis<M> {
    /// Assembles a model.
    ///
    /// # Errors
    /// [`Error::Model`] where it refers to what does not exist, or holds numbers that cannot be; [`Error::Solve`] where its parts do not fit together, or where it buckles under the axial forces
    /// of its P-Δ case.
    pub fn new(model: M) -> Result<Self, Error> {
        model.check().map_err(Error::Model)?;
        Ok(Self {
            system: trilith_solvers::assemble(&model)?,
            model,
            frames: 0,
            histories: true,
            loops: false,
        })
    }

    /// Keeps up to so many deformed shapes of every run, evenly spaced in time.
    #[must_use]
    pub fn with_frames(mut self, limit: usize) -> Self {
        self.frames = limit;
        self
    }

    /// Keeps no histories, only the extremes of every output: the memory of a run then does not grow with
    /// its length.
    #[must_use]
    pub fn without_histories(mut self) -> Self {
        self.histories = false;
        self
    }

    /// Keeps deformation and force of the links, for the hysteresis loops of a report.
    #[must_use]
    pub fn with_loops(mut self) -> Self {
        self.loops = true;
        self
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The run of a case, to be told how and made.
    ///
    /// # Errors
    /// [`Error::UnknownCase`].
    pub fn case(&self, name: &str) -> Result<CaseRun<'_, M>, Error> {
        let case = self.model.case(name).ok_or_else(|| Error::unknown_case(&self.model, name))?;
        Ok(CaseRun::new(self, case))
    }

    /// The run of the last case, which is what the program runs where no case is named.
    ///
    /// # Errors
    /// [`Error::UnknownCase`] for a model without cases.
    pub fn last_case(&self) -> Result<CaseRun<'_, M>, Error> {
        let last = self.model.cases.len().checked_sub(1);
        let case = last.ok_or_else(|| Error::unknown_case(&self.model, "the last"))?;
        Ok(CaseRun::new(self, case))
    }

    /// The equations.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Runs a case and, before it, the cases that it continues. A run whose basis turns out too small is made
    /// again with more vectors, unless its case says otherwise.
    ///
    /// # Errors
    /// [`Error::Solve`] where the run cannot be made. A run that stops on the way is no error: its
    /// status says so.
    pub fn run(&self, options: RunOptions<'_>) -> Result<Run, Error> {
        self.observed(options, &mut [])
    }

    /// The same, shown to further observers.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn observed(
        &self,
        options: RunOptions<'_>,
        observers: &mut [&mut dyn Observer],
    ) -> Result<Run, Error> {
        if options.case >= self.model.cases.len() {
            return Err(Error::unknown_case(&self.model, &format!("#{}", options.case)));
        }
        let RunOptions {
            case,
            solver,
            dt,
            until,
            vectors,
            substeps,
            step_errors,
            from,
            mut progress,
            interrupt,
        } = options;
        // A run goes on with the basis it was made with.
        let before = from.as_ref().and_then(|end| end.vectors);
        let (mut vectors, mut round) = (vectors.or(before), 0);
        loop {
            let progress: Option<&mut dyn FnMut(f64)> = match &mut progress {
                Some(tell) => Some(&mut **tell),
                None => None,
            };
            let options = RunOptions {
                case,
                solver,
                dt,
                until,
                vectors,
                substeps,
                step_errors,
                from: from.clone(),
                progress,
                interrupt,
            };
            let mut run = self.once(options, observers)?;
            let more = run.result.enlarged(&self.model, round).filter(|_| from.is_none());
            let Some(n) = more else {
                if let Some(n) = vectors.filter(|_| round > 0) {
                    run.result.warnings.push(format!(
                        "the basis was enlarged to {n} vectors: with fewer, outputs were off by more than its `tolerance`"
                    ));
                }
                if let Some(from) = from.filter(|_| !run.result.errors.is_empty()) {
                    run.result.warnings.push(format!(
                        "how far the outputs may be off (±) is told of the part from t = {:.6} s on, peaks of all of it",
                        from.time
                    ));
                }
                return Ok(run);
            };
            vectors = Some(n);
            round += 1;
        }
    }

    /// One run.
    fn once(
        &self,
        options: RunOptions<'_>,
        observers: &mut [&mut dyn Observer],
    ) -> Result<Run, Error> {
        let mut record = Recorder::new(&self.model).with_frames(&self.model, self.frames);
        if self.loops {
            record = record.with_loops(&self.model);
        }
        if !self.histories {
            record = record.without_histories();
        }
        let mut contact = ContactMode::new(&self.model, &self.system);
        let mut shear = self.shakes(options.case).then(BaseShear::default);
        let (mut since, mut warnings) = (0.0, Vec::new());
        if let Some(from) = &options.from {
            let before = from.seen.clone();
            since = before.since;
            if before.peaks.len() == self.model.outputs.len() {
                record = record.after(before.peaks);
                contact = contact.after(before.contact.unwrap_or_default());
                shear = shear.map(|_| BaseShear::after(before.base_shear.unwrap_or_default()));
            } else {
                since = from.time;
            }
            if since > 0.0 {
                warnings.push(format!(
                    "the checkpoint holds no extremes: peaks and contacts count from t = {since} s on"
                ));
            }
            if !self.model.spectra.is_empty() {
                warnings.push(format!(
                    "floor spectra are made of the histories, which start at t = {} s",
                    from.time
                ));
            }
        }
        let mut all: Vec<&mut dyn Observer> = vec![&mut record, &mut contact];
        if let Some(shear) = &mut shear {
            all.push(shear);
        }
        for observer in observers {
            all.push(*observer);
        }
        let mut result = trilith_solvers::run(&self.model, &self.system, options, &mut all)?;
        result.warnings.extend(trilith_results::spectrum_warnings(&self.model, &record));
        result.warnings.extend(warnings);
        let peaks = record.peaks();
        if peaks.iter().all(Peak::is_finite) {
            let (peaks, contact) = (peaks.to_vec(), Some(contact.memory()));
            let base_shear = shear.as_ref().map(BaseShear::summary);
            result.end.seen = SoFar { peaks, contact, base_shear, since };
        }
        let (stops, bearings) = (contact.stops(), contact.bearings());
        let contact = contact.summary();
        // A body that is free has no base.
        let base_shear =
            shear.map(|s| s.summary()).filter(|s| contact.is_none() && s.max != [0.0; 2]);
        let names = self.model.outputs.iter().map(|o| o.name.clone()).collect();
        Ok(Run { result, record, contact, stops, bearings, base_shear, names })
    }

    /// True for a case that shakes the base.
    fn shakes(&self, case: usize) -> bool {
        let analysis = self.model.cases.get(case).map(|c| &c.analysis);
        matches!(analysis, Some(CaseAnalysis::Dynamic(d)) if !d.base.is_empty())
    }

    /// The model in figures: masses, freedoms, periods at rest, sums of loads.
    ///
    /// # Errors
    /// [`Error::Solve`] where the stiffness has numbers beyond all bounds.
    pub fn survey(&self) -> Result<Survey, Error> {
        Ok(trilith_solvers::survey(&self.model, &self.system)?)
    }

    /// The structure with its links made linear, at rest or at the end of a case (an index): for modes with links, and
    /// for response spectra.
    ///
    /// # Errors
    /// [`Error::Solve`] where that case does not come to its end, or a law has no finite stiffness there.
    pub fn linearised(
        &self,
        stiffness: &LinkStiffness,
        after: Option<usize>,
    ) -> Result<Linearised<'_>, Error> {
        Ok(trilith_solvers::linearised(&self.model, &self.system, stiffness, after)?)
    }

    /// The case at whose end the links are that a dynamic case (an index; the last one where none is given) begins with;
    /// none: they begin at rest.
    #[must_use]
    pub fn links_begin_after(&self, case: Option<usize>) -> Option<usize> {
        let cases = &self.model.cases;
        let is_dynamic = |c: &usize| matches!(cases[*c].analysis, CaseAnalysis::Dynamic(_));
        let last = || (0..cases.len()).rev().find(is_dynamic);
        case.or_else(last).and_then(|c| cases.get(c)?.after)
    }

    /// A superelement of few rows in place of a part of the model: see [`mod@crate::reduce`].
    ///
    /// # Errors
    /// [`ReduceError`] where the part is none, is not linear, or is not held by the nodes that are kept.
    pub fn reduce(&self, request: &Request) -> Result<Reduced<'_>, ReduceError> {
        reduce(&self.model, &self.system, request)
    }

    /// The lowest frequencies with the links as stiff as they are when engaged, Hz, rising; 0 for motions without
    /// stiffness.
    ///
    /// # Errors
    /// [`Error::Solve`] where they cannot be found.
    pub fn frequencies(&self, count: usize) -> Result<Vec<f64>, Error> {
        Ok(trilith_solvers::frequencies(&self.model, &self.system, count)?)
    }

    /// Modes and basis of a case (the last dynamic one where none is given).
    ///
    /// # Errors
    /// [`Error::Solve`] where the structure has no modes.
    pub fn modes(&self, case: Option<usize>) -> Result<BasisReport, Error> {
        Ok(trilith_solvers::modes(&self.model, &self.system, case)?)
    }
}

/// What a run left.
#[derive(Clone, Debug)]
pub struct Run {
    /// Status, work, energies, basis, warnings and the state at the end.
    pub result: CaseResult,
    /// Histories, peaks and deformed shapes.
    pub record: Recorder,
    /// How the bodies that stand on contacts behaved, for models with such bodies.
    pub contact: Option<ContactSummary>,
    /// How often and how hard stops were hit, for models with stops.
    pub stops: Option<StopSummary>,
    /// How far bearings travelled, for models with bearings.
    pub bearings: Option<BearingSummary>,
    /// The largest base shear, for structures whose base is shaken.
    pub base_shear: Option<BaseShearSummary>,
    names: Vec<String>,
}

impl Run {
    /// The output times, s; none where no histories were kept.
    #[must_use]
    pub fn time(&self) -> &[f64] {
        self.record.time()
    }

    /// Values of an output at the output times, SI.
    ///
    /// # Errors
    /// [`Error::UnknownOutput`].
    pub fn history(&self, output: &str) -> Result<&[f64], Error> {
        self.index(output).and_then(|i| self.record.history(i)).ok_or_else(|| unknown(output))
    }

    /// Extremes of an output over all substeps, SI.
    ///
    /// # Errors
    /// [`Error::UnknownOutput`], also where nothing was recorded.
    pub fn peak(&self, output: &str) -> Result<Peak, Error> {
        let peak = self.index(output).and_then(|i| self.record.peaks().get(i));
        peak.copied().ok_or_else(|| unknown(output))
    }

    /// `summary.json` as a value. `model` is the model that ran.
    #[must_use]
    pub fn summary(&self, model: &Model) -> Summary {
        let contact = self.contact.clone();
        Summary {
            stops: self.stops.clone(),
            bearings: self.bearings.clone(),
            base_shear: self.base_shear.clone(),
            ..Summary::new(crate::BUILD, model, &self.result, &self.record, contact)
        }
        .sealed()
    }

    /// Writes summary, histories, resolved model and deformed shapes into a folder and returns the
    /// files written.
    ///
    /// # Errors
    /// [`Error::File`] with the path.
    pub fn write(&self, model: &Model, dir: impl AsRef<Path>) -> Result<Vec<PathBuf>, Error> {
        let summary = self.summary(model);
        Ok(Files { model, record: &self.record, summary: &summary }.write(dir)?)
    }

    fn index(&self, output: &str) -> Option<usize> {
        self.names.iter().position(|n| n == output)
    }
}

fn unknown(output: &str) -> Error {
    Error::UnknownOutput(output.to_owned())
}
