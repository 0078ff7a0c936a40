//! `summary.json`: the keys scripts rely on.

use crate::{DriftSummary, FloorSpectrum, ForceEnvelope, Peak, Recorder};
use serde::{Serialize, Serializer};
use serde_json::Value;
use trilith_model::{Model, Parameter, ParameterValue};
use trilith_solvers::{
    Adequacy, BaseShearSummary, BasisReport, BearingSummary, CaseResult, ContactSummary,
    EnergyTotals, LinkEnergy, OutputError, StopSummary, Work,
};

/// Results of one case, as `summary.json` has them. Numbers are in SI; one that is not finite is
/// written as `null`.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Version of the program.
    pub version: &'static str,
    /// Build of the program: a digest of the sources it is made from.
    pub build: &'static str,
    /// SHA-256 of all else that stands here but `work`, hexadecimal ([`Summary::digest`]): the same for a repetition
    /// of the run, another for any other run, or where a value has been altered.
    pub run_sha256: String,
    /// The model.
    pub model: ModelSummary,
    /// Parameters of the model with the values they had.
    pub parameters: Named<ParameterSummary>,
    /// Name of the case.
    pub case: String,
    /// Name of the solver.
    pub solver: &'static str,
    /// `converged`, or what failed.
    pub status: &'static str,
    /// The status in a sentence.
    pub message: String,
    /// Work.
    pub work: Work,
    /// Outputs by name.
    pub outputs: Named<OutputSummary>,
    /// Energies at the end, J.
    pub energy: EnergyTotals,
    /// Energies of every link at the end, by its name, J.
    pub link_energy: Named<LinkEnergy>,
    /// How the bodies that stand on contacts behaved; `null` for a model without such a body.
    pub contact: Option<ContactSummary>,
    /// How often and how hard stops were hit; `null` for a model without stops.
    pub stops: Option<StopSummary>,
    /// How far bearings travelled; `null` for a model without bearings.
    pub bearings: Option<BearingSummary>,
    /// The largest base shear of a structure whose base is shaken; else `null`.
    pub base_shear: Option<BaseShearSummary>,
    /// The largest drift among the outputs; `null` where none is one, or a body stands free.
    pub drift: Option<DriftSummary>,
    /// The basis; `null` for a solver on all DOFs.
    pub basis: Option<BasisSummary>,
    /// Floor spectra by name: their peaks. `spectra.csv` has the curves.
    pub spectra: Named<FloorSpectrum>,
    /// Forces along members: the extremes of every envelope, by its name and that of the force. `envelopes.csv` has all
    /// stations.
    pub envelopes: Named<Named<ForceEnvelope>>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// Which model it was.
#[derive(Clone, Debug, Serialize)]
pub struct ModelSummary {
    /// Title.
    pub title: String,
    /// SHA-256 of the model file, hexadecimal; where it includes others, of the list of the sums of all.
    pub sha256: String,
}

/// The value of a parameter.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum ParameterSummary {
    /// A number.
    Number {
        /// Value in SI.
        value: f64,
        /// SI unit; `1` for a pure number.
        unit: String,
    },
    /// A text, such as the name of a record.
    Text {
        /// The text.
        value: String,
    },
}

/// One output.
#[derive(Clone, Debug, Serialize)]
pub struct OutputSummary {
    /// SI unit.
    pub unit: String,
    /// Extremes; absent where nothing was recorded.
    #[serde(flatten)]
    pub peak: Option<Peak>,
    /// How far its values may be off, in its unit; absent for static cases.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<OutputError>,
}

/// The basis of a reduced solver in a few numbers.
#[derive(Clone, Debug, Serialize)]
pub struct BasisSummary {
    /// Number of vectors.
    pub vectors: usize,
    /// Static shapes of places without mass, beside them.
    pub static_shapes: usize,
    /// Lowest and highest frequency, Hz.
    pub frequency: [f64; 2],
    /// Share of the mass along X, Y, Z that all vectors carry.
    pub mass_participation: [f64; 3],
    /// Share of the static response of each load direction that the basis holds.
    pub static_participation: Named<f64>,
    /// The link coordinate whose flexibility the basis holds worst.
    pub worst: Option<Adequacy>,
}

/// Values with names, in their own order; a map in JSON.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Named<T>(pub Vec<(String, T)>);

impl<T> Named<T> {
    /// The value of that name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&T> {
        self.0.iter().find(|(n, _)| n == name).map(|(_, v)| v)
    }
}

impl<T: Serialize> Serialize for Named<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl Summary {
    /// Puts together what a run left, but for what only further observers saw (stops, bearings, base shear), and not
    /// [sealed](Self::sealed); `build` is that of the program.
    #[must_use]
    pub fn new(
        build: &'static str,
        model: &Model,
        result: &CaseResult,
        record: &Recorder,
        contact: Option<ContactSummary>,
    ) -> Self {
        let output = |(i, o): (usize, &trilith_model::Output)| {
            let peak = record.peaks().get(i).copied();
            let error = result.errors.get(i).copied();
            (o.name.clone(), OutputSummary { unit: o.unit.clone(), peak, error })
        };
        let link = |(element, energy): &(usize, LinkEnergy)| {
            model.elements.get(*element).map(|e| (e.name.clone(), *energy))
        };
        // A body that stands free leans: its places have no storey between them.
        let drift =
            if contact.is_none() { crate::drift::largest(model, record.peaks()) } else { None };
        Self {
            version: env!("CARGO_PKG_VERSION"),
            build,
            run_sha256: String::new(),
            model: ModelSummary { title: model.title.clone(), sha256: model.sha256() },
            parameters: Named(model.parameters.iter().map(ParameterSummary::of).collect()),
            case: result.case.clone(),
            solver: result.solver,
            status: result.status.word(),
            message: result.status.text(),
            work: result.work,
            outputs: Named(model.shown().map(output).collect()),
            energy: result.energy,
            link_energy: Named(result.link_energy.iter().filter_map(link).collect()),
            contact,
            stops: None,
            bearings: None,
            base_shear: None,
            drift,
            basis: result.basis.as_ref().map(BasisSummary::new),
            spectra: Named(crate::spectra::all(model, record)),
            envelopes: crate::envelopes::extremes(model, record.peaks()),
            warnings: result.warnings.clone(),
        }
    }

    /// The same with `run_sha256`: where nothing is missing any more.
    #[must_use]
    pub fn sealed(mut self) -> Self {
        // As it will be read from the file. Names and numbers: nothing that JSON does not have.
        let text = serde_json::to_string(&self).unwrap_or_default();
        self.run_sha256 = Self::digest(&serde_json::from_str::<Value>(&text).unwrap_or_default());
        self
    }

    /// What `run_sha256` must be in a `summary.json` with these values, hexadecimal.
    #[must_use]
    pub fn digest(summary: &Value) -> String {
        crate::sha256_of_json(summary, &["run_sha256", "work"])
    }
}

impl ParameterSummary {
    fn of(parameter: &Parameter) -> (String, Self) {
        let value = match &parameter.value {
            ParameterValue::Number(x, d) => Self::Number { value: *x, unit: d.unit() },
            ParameterValue::Text(text) => Self::Text { value: text.clone() },
        };
        (parameter.name.clone(), value)
    }
}

impl BasisSummary {
    /// The few numbers of a report.
    #[must_use]
    pub fn new(report: &BasisReport) -> Self {
        let hertz = |omega: Option<&f64>| omega.map_or(f64::NAN, |w| w / std::f64::consts::TAU);
        let mass = [0, 1, 2].map(|a| report.mass_participation.iter().map(|m| m[a]).sum());
        Self {
            vectors: report.vectors,
            static_shapes: report.static_shapes,
            frequency: [hertz(report.omega.first()), hertz(report.omega.last())],
            mass_participation: mass,
            static_participation: Named(report.static_participation.clone()),
            worst: report.adequacy.first().cloned(),
        }
    }
}
