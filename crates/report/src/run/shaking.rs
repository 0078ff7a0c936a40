//! What shakes: the ground and the floors.

use super::data::{Ground, History, RunData, Shown, SpectrumChart, SpectrumCurve};
use super::reduce::{history, numbers};
use super::units::short;
use trilith_model::STANDARD_GRAVITY;
use trilith_results::{GROUND_DAMPING, GroundMotion, Summary};

/// Curves in one diagram.
const CURVES: usize = 6;

/// Accelerations of the ground and spectra are shown in g.
fn in_g() -> Shown {
    Shown { unit: "g".into(), factor: 1.0 / STANDARD_GRAVITY }
}

fn axis(motion: &GroundMotion) -> &'static str {
    motion.direction.name().trim_start_matches(['U', 'u'])
}

/// The motions over time.
pub(crate) fn ground(motions: &[GroundMotion]) -> Vec<Ground> {
    let one = |m: &GroundMotion| {
        let name = format!("ground acceleration {}", axis(m).to_uppercase());
        let history = history(name, "m/s^2", &m.time, &m.acceleration);
        Ground { history: History { shown: in_g(), ..history }, peak: m.peak.0, t_peak: m.peak.1 }
    };
    motions.iter().map(one).collect()
}

/// Their spectra in one chart.
pub(crate) fn ground_spectra(motions: &[GroundMotion]) -> Vec<SpectrumChart> {
    if motions.is_empty() {
        return Vec::new();
    }
    let curve = |m: &GroundMotion| SpectrumCurve {
        name: axis(m).to_uppercase(),
        period: numbers(m.periods.iter().copied()),
        y: numbers(m.psa.iter().copied()),
    };
    vec![SpectrumChart {
        title: format!("Spectrum of the ground motion, {} damping", damped(GROUND_DAMPING)),
        quantity: "PSA".into(),
        shown: in_g(),
        curves: motions.iter().map(curve).collect(),
    }]
}

impl RunData {
    /// Lays a spectrum over those of the ground motion: its name, and its pseudo-acceleration (m/s²) at a period (s) where it
    /// has one. False where no ground moves.
    pub fn lay_over_ground(&mut self, name: &str, at: impl Fn(f64) -> Option<f64>) -> bool {
        for chart in &mut self.ground_spectra {
            let Some(first) = chart.curves.first() else { continue };
            let points: Vec<(f64, f64)> =
                first.period.values().filter_map(|t| Some((t, at(t)?))).collect();
            chart.curves.push(SpectrumCurve {
                name: name.to_owned(),
                period: numbers(points.iter().map(|p| p.0)),
                y: numbers(points.iter().map(|p| p.1)),
            });
        }
        !self.ground_spectra.is_empty()
    }
}

/// The floor spectra that the model asks for: the places beside each other, a chart for each damping ratio.
pub(crate) fn floor_spectra(summary: &Summary) -> Vec<SpectrumChart> {
    let floors = &summary.spectra.0;
    let mut ratios: Vec<f64> = Vec::new();
    for s in floors.iter().flat_map(|(_, f)| &f.spectra) {
        if !ratios.contains(&s.damping) {
            ratios.push(s.damping);
        }
    }
    let mut charts = Vec::new();
    for ratio in ratios {
        let curve = |(name, floor): &(String, trilith_results::FloorSpectrum)| {
            let s = floor.spectra.iter().find(|s| s.damping == ratio && s.periods.len() > 1)?;
            // A file may list its periods in any order.
            let mut points: Vec<(f64, f64)> =
                s.periods.iter().copied().zip(s.responses.iter().map(|r| r.sa)).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            Some(SpectrumCurve {
                name: name.clone(),
                period: numbers(points.iter().map(|p| p.0)),
                y: numbers(points.iter().map(|p| p.1)),
            })
        };
        let curves: Vec<SpectrumCurve> = floors.iter().filter_map(curve).collect();
        for some in curves.chunks(CURVES) {
            charts.push(SpectrumChart {
                title: format!("Floor spectra, {} damping", damped(ratio)),
                quantity: "Sa".into(),
                shown: in_g(),
                curves: some.to_vec(),
            });
        }
    }
    charts
}

/// A damping ratio.
fn damped(ratio: f64) -> String {
    format!("{} %", short(100.0 * ratio, 3))
}
