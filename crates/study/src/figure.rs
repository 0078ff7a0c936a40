//! What a page of a study shows.

mod draw;
mod fragile;
mod hazard;
mod modes;
mod overturning;
mod spread;

pub use draw::figures;
pub(crate) use draw::section;

use crate::Condition;

/// A figure that a study asks for. Names are those of columns or of varied parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Drawing {
    /// Response modes over friction and peak acceleration, with the closed forms of a rigid block.
    ModeChart {
        /// Friction coefficient.
        x: String,
        /// Peak acceleration in g.
        y: String,
        /// Height over width of the block.
        slenderness: f64,
    },
    /// Incremental dynamic analysis: intensity over demand, a line for each record.
    Ida {
        /// Demand.
        demand: String,
        /// Intensity.
        intensity: String,
    },
    /// Fragility: share of runs in which something happens over intensity, with a lognormal fit.
    Fragility {
        /// Intensity.
        intensity: String,
        /// What happens.
        event: Condition,
        /// Confidence of the band.
        confidence: f64,
        /// A curve for each value of this.
        by: Option<String>,
    },
    /// Survival and overturning over frequency and amplitude of a pulse.
    Overturning {
        /// ω/p.
        frequency: String,
        /// Amplitude over g tan α.
        amplitude: String,
        /// Draws the closed form of the linearised block under a half sine.
        half_sine: bool,
    },
    /// Demand exceeded against intensity, and how often in a year where the hazard is known.
    Hazard {
        /// Demand.
        demand: String,
        /// Intensity.
        intensity: String,
        /// Annual rates at which intensities are exceeded: (intensity, rate), rising intensities.
        rates: Vec<(f64, f64)>,
    },
    /// Medians and the band of 16 % to 84 % of the runs of each point.
    Spread {
        /// What distinguishes the points.
        x: String,
        /// What is shown.
        y: String,
    },
    /// A mark for each run.
    Points {
        /// Horizontal.
        x: String,
        /// Vertical.
        y: String,
        /// A colour for each value of this.
        by: Option<String>,
    },
}
