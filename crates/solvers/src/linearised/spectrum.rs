//! Response spectrum analysis: what a spectrum of the ground makes of the modes.
//!
//! ```text
//! rⱼ = (r of φⱼ) Γⱼ Sa(Tⱼ, ξⱼ) / ωⱼ²                 of one mode, for each direction of the ground
//! R² = Σ Σ ρᵢⱼ rᵢ rⱼ                                ρ = 1 for i = j, else 0 (SRSS) or as below (CQC)
//! ρ  = 8 √(ξᵢξⱼ) (ξᵢ + q ξⱼ) q^{3/2} / ((1−q²)² + 4 ξᵢξⱼ q (1+q²) + 4 (ξᵢ²+ξⱼ²) q²),   q = ωⱼ/ωᵢ
//! ```
//!
//! Displacements, deformations, forces and sums of these have such a peak, and absolute accelerations, for which a mode
//! gives φ Γ Sa. Velocities, histories of links, and outputs that are no sums of others have none.
//! Reference: \[Wilson, Der Kiureghian & Bayo 1981\]; directions: \[EN 1998-1:2004, 4.3.3.5\].

use super::{LinearModes, Linearised};
use crate::error::SolveError;
use crate::record::{Outputs, has_modal_peak};
use crate::structure::ReducedSystem;
use std::f64::consts::TAU;
use trilith_model::Side;
use trilith_system::LoadSet;

/// A share of what an output may be that is rounding.
const ROUNDING: f64 = 1e-9;

/// How the peaks of modes make one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CombineModes {
    /// With correlation.
    #[default]
    Cqc,
    /// Root of the sum of squares.
    Srss,
}

/// How the peaks under directions of the ground make one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CombineDirections {
    /// Root of the sum of squares.
    #[default]
    Srss,
    /// All of one and 30 % of the others, the worst of these sums.
    Thirty,
}

/// A question to a response spectrum.
pub struct SpectrumRequest<'a> {
    /// Pseudo-acceleration in m/s² at a period (s) and a damping ratio; `None` where the spectrum has none.
    pub acceleration: &'a dyn Fn(f64, f64) -> Option<f64>,
    /// First and last period that it has, s.
    pub range: [f64; 2],
    /// What acts along X, Y, Z, as a factor of it.
    pub along: [f64; 3],
    /// Damping ratio of the structure in every mode, to which that of links' cycles is added.
    pub damping: f64,
    /// How modes are put together.
    pub modes: CombineModes,
    /// How directions are.
    pub directions: CombineDirections,
}

/// What a spectrum makes of an output.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputMaximum {
    /// Peak under the ground along X, Y, Z, SI; 0 where nothing acts.
    pub along: [f64; 3],
    /// Of all directions.
    pub peak: f64,
}

/// Correlation of two modes with these circular frequencies and damping ratios.
fn correlation([wi, wj]: [f64; 2], [xi, xj]: [f64; 2]) -> f64 {
    let q = wj / wi;
    let square = (1.0 - q * q).powi(2);
    let below = square + 4.0 * xi * xj * q * (1.0 + q * q) + 4.0 * (xi * xi + xj * xj) * q * q;
    match below > 0.0 {
        true => 8.0 * (xi * xj).sqrt() * (xi + q * xj) * q.powf(1.5) / below,
        // The same mode, undamped.
        false => 1.0,
    }
}

impl CombineDirections {
    fn of(self, along: [f64; 3]) -> f64 {
        match self {
            Self::Srss => along.iter().map(|x| x * x).sum::<f64>().sqrt(),
            Self::Thirty => {
                let sum: f64 = along.iter().sum();
                along.iter().map(|x| x + 0.3 * (sum - x)).fold(0.0, f64::max)
            }
        }
    }
}

impl Linearised<'_> {
    /// Peaks of the model's outputs in its order, `None` of those that have none. Modes without stiffness are at rest:
    /// a ground that goes slowly enough leaves them behind.
    ///
    /// # Errors
    /// [`SolveError::OutsideSpectrum`] where a mode that moves has a period that the spectrum has not.
    pub fn spectrum(
        &self,
        modes: &LinearModes,
        request: &SpectrumRequest<'_>,
    ) -> Result<Vec<Option<OutputMaximum>>, SolveError> {
        let (model, system) = (self.model, self.system);
        let loads = LoadSet::default();
        let none = vec![0.0; system.links.len()];
        let space = ReducedSystem::physical(system, &loads, &none, None);
        let outputs = Outputs::new(model, system, &space);
        let count = model.outputs.len();
        let values = |u: &[f64], omega2: f64| {
            let mut values = vec![0.0; count];
            outputs.at((0.0, Side::After), &self.state(u, omega2), &loads).values(&mut values);
            values
        };
        let rest = values(&vec![0.0; system.order()], 0.0);
        // Of each mode that moves: ω, ξ, and Γ Sa / ω² with what its shape gives the outputs.
        let mut moving = Vec::new();
        for (j, omega2) in modes.omega2.iter().copied().enumerate() {
            let gamma = modes.participation[j];
            if omega2 <= 0.0 || gamma.iter().zip(&request.along).all(|(g, a)| g * a == 0.0) {
                continue;
            }
            let (omega, damping) = (omega2.sqrt(), request.damping + modes.damping[j]);
            let period = TAU / omega;
            let Some(acceleration) = (request.acceleration)(period, damping) else {
                let range = request.range;
                return Err(SolveError::OutsideSpectrum { mode: j + 1, period, range });
            };
            let shape = values(modes.shapes.column(j), omega2);
            let size = acceleration / omega2;
            let peaks: Vec<f64> = shape.iter().zip(&rest).map(|(x, r)| (x - r) * size).collect();
            moving.push((omega, damping, gamma, peaks));
        }
        let rho = |i: usize, j: usize| match request.modes {
            CombineModes::Cqc => {
                correlation([moving[i].0, moving[j].0], [moving[i].1, moving[j].1])
            }
            CombineModes::Srss => f64::from(u8::from(i == j)),
        };
        let n = moving.len();
        let correlations: Vec<f64> = (0..n * n).map(|at| rho(at / n, at % n)).collect();
        let has_peak = has_modal_peak(&outputs);
        let peak = |output: usize| {
            let along = [0, 1, 2].map(|axis: usize| {
                let of = |i: usize| moving[i].2[axis] * request.along[axis] * moving[i].3[output];
                let each: Vec<f64> = (0..n).map(of).collect();
                let pairs = (0..n * n).map(|at| correlations[at] * each[at / n] * each[at % n]);
                pairs.sum::<f64>().max(0.0).sqrt()
            });
            // What it would be if every mode were moved as it can be.
            let most = moving.iter().map(|(_, _, gamma, peaks)| {
                let gamma = gamma.iter().fold(0.0f64, |most, g| most.max(g.abs()));
                (gamma * peaks[output]).powi(2)
            });
            let rounding = ROUNDING * most.sum::<f64>().sqrt();
            let along = along.map(|x| if x <= rounding { 0.0 } else { x });
            OutputMaximum { along, peak: request.directions.of(along) }
        };
        Ok((0..count).map(|i| has_peak[i].then(|| peak(i))).collect())
    }
}
