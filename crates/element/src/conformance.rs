//! Conformance kits: does a link keep the [contract](crate::Link)? Is a linear element or a constraint what it says?
//!
//! # Links
//!
//! The kit leads a law along random smooth paths of deformation (periodic, starting at rest) and checks
//!
//! | property | claim |
//! |----------|-------|
//! | shape    | coordinates, history and dummy fit together; the dummy is symmetric and positive semi-definite |
//! | purity   | equal questions get equal answers, bit for bit, whatever was asked in between (so a step can be reverted) |
//! | writing  | every history variable of the trial is written and everything is finite |
//! | restart  | at the start of a step, with dt = 0, the force is that of the end of the last step, and nothing dissipates |
//! | tangents | `k` and `c` are the central difference quotients of `f`, away from kinks |
//! | forms    | what the law says over lanes, and as the constant of a dashpot, is what it answers, up to rounding |
//! | energy   | work = Δ stored + hysteretic + viscous at all times, under refinement; the last two never fall (unless [`Kit::active`], or the law does not [account](Link::accounts) for its work) |
//! | passive  | nowhere on three cycles has more energy come out than went in (unless [`Kit::active`]) |
//! | rates    | a law declared [`Kit::rate_independent`] does not see the speed, nor the step on a straight path |
//!
//! ```
//! use trilith_element::conformance::Kit;
//! # use trilith_element::*;
//! # #[derive(Debug)] struct Spring;
//! # impl Link for Spring {
//! #     fn coordinates(&self) -> Coordinates { Coordinates::Local(vec![Axis::U1]) }
//! #     fn engaged_stiffness(&self, k: &mut [f64]) { k[0] = 2.0 }
//! #     fn respond(&self, at: &Kinematics<'_>, _: &[f64], _: &mut [f64], out: &mut Response<'_>) {
//! #         out.f[0] = 2.0 * at.d[0];
//! #         out.k[0] = 2.0;
//! #         out.energy.stored = at.d[0] * at.d[0];
//! #     }
//! # }
//! // Deformations of about 10 mm, run through twice in a second.
//! let report = Kit::new(&[0.01], 2.0).rate_independent().check(&Spring)?;
//! assert!(report.tangents > 100);
//! # Ok::<(), trilith_element::conformance::ConformanceError>(())
//! ```
//!
//! [`Kit::lane_speed`] measures what a form for lanes gains.
//!
//! # Linear elements and constraints
//!
//! [`ElementKit`] asks for matrices that are finite, symmetric and positive semi-definite, that let rigid bodies move,
//! that are the same in every place, and, of members, the same in one piece and in two. [`ConstraintKit`] asks for
//! equations that every motion as a rigid body satisfies.

mod energy;
mod error;
mod forms;
mod path;
mod probe;
mod properties;
mod speed;
mod structure;
#[cfg(test)]
mod tests;

pub use error::ConformanceError;
pub use speed::LaneSpeed;
pub use structure::{ConstraintKit, ElementKit, StructureError};

use crate::{Exercise, Link};
use path::Path;

/// How a link is examined; see the [module](self).
#[derive(Clone, Debug)]
pub struct Kit {
    deformation: Vec<f64>,
    mean: Vec<f64>,
    frequency: f64,
    seed: u64,
    paths: usize,
    passive: bool,
    rate_independent: bool,
    energy_tolerance: f64,
    quick: bool,
}

/// What was examined.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Tangent columns compared with difference quotients.
    pub tangents: usize,
    /// Tangent columns skipped at kinks.
    pub skipped: usize,
    /// Largest error of the energy balance at any time of a path, relative to the work done and taken.
    pub energy_error: f64,
}

impl Kit {
    /// A kit that deforms by about `deformation` (m or rad, one for each coordinate; 0 stays at rest), at
    /// `frequency` cycles in a second.
    #[must_use]
    pub fn new(deformation: &[f64], frequency: f64) -> Self {
        Self {
            deformation: deformation.to_vec(),
            mean: vec![0.0; deformation.len()],
            frequency,
            seed: 1,
            paths: 8,
            passive: true,
            rate_independent: false,
            energy_tolerance: 2e-3,
            quick: false,
        }
    }

    /// A kit that moves about the means of an exercise, by about its amplitudes and at its frequency. A
    /// coordinate with a mean and no amplitude moves by its mean, so that contacts open.
    #[must_use]
    pub fn of(exercise: &Exercise) -> Self {
        let size =
            |s: &crate::Stroke| if s.amplitude == 0.0 { s.mean.abs() } else { s.amplitude.abs() };
        let deformation: Vec<_> = exercise.strokes.iter().map(size).collect();
        let mean = exercise.strokes.iter().map(|s| s.mean).collect();
        Self { mean, ..Self::new(&deformation, exercise.frequency) }
    }

    /// Moves about these deformations, m or rad, one for each coordinate.
    #[must_use]
    pub fn about(mut self, mean: &[f64]) -> Self {
        self.mean = mean.to_vec();
        self
    }

    /// All deformations and means so many times as large.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.deformation.iter_mut().chain(&mut self.mean).for_each(|x| *x *= factor);
        self
    }

    /// Takes few steps first and many only where the energy balance asks for them, and does not ask
    /// whether kinks are rare: for thousands of paths. What must hold is the same.
    #[must_use]
    pub fn quick(mut self) -> Self {
        self.quick = true;
        self
    }

    /// Another seed of the random paths.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Another number of paths.
    #[must_use]
    pub fn paths(mut self, paths: usize) -> Self {
        self.paths = paths;
        self
    }

    /// The law may give energy in a closed cycle, and enter it as negative dissipation.
    #[must_use]
    pub fn active(mut self) -> Self {
        self.passive = false;
        self
    }

    /// The law must not depend on rates.
    #[must_use]
    pub fn rate_independent(mut self) -> Self {
        self.rate_independent = true;
        self
    }

    /// Admissible error of the energy balance with thousands of steps, relative to the work.
    #[must_use]
    pub fn energy_tolerance(mut self, relative: f64) -> Self {
        self.energy_tolerance = relative;
        self
    }

    /// Examines a link.
    ///
    /// # Errors
    /// The first property that does not hold, with its numbers.
    pub fn check(&self, link: &dyn Link) -> Result<Report, ConformanceError> {
        properties::shape(self, link)?;
        let mut report = Report::default();
        let paths: Vec<_> = (0..self.paths).map(|number| self.path(number)).collect();
        for path in &paths {
            properties::answers(link, path)?;
            forms::forms(link, path)?;
            properties::tangents(self, link, path, &mut report)?;
        }
        let turnover = energy::turnover(self, link, &paths)?;
        for path in &paths {
            energy::balance(self, link, path, &mut report, turnover)?;
            if self.rate_independent {
                properties::rates(link, path)?;
            }
        }
        // Kinks are rare on a random path; a law that is all kinks has not been examined.
        let seen = report.tangents + report.skipped;
        if !self.quick && 4 * report.skipped > seen {
            return Err(ConformanceError::Kinks { skipped: report.skipped, of: seen });
        }
        Ok(report)
    }

    fn path(&self, number: usize) -> Path {
        Path::random(&self.deformation, &self.mean, self.frequency, self.seed, number)
    }

    /// How long the answers of a link take on this machine, alone and over lanes, along the first path; none for a link
    /// without a form for lanes. To be measured in a release build.
    #[must_use]
    pub fn lane_speed(&self, link: &dyn Link) -> Option<LaneSpeed> {
        speed::lane_speed(link, &self.path(0))
    }

    /// [`check`](Self::check) for tests.
    ///
    /// # Panics
    /// Where the link does not conform, with what is wrong.
    #[track_caller]
    pub fn assert(&self, link: &dyn Link) {
        if let Err(error) = self.check(link) {
            panic!("{link:?} does not conform: {error}");
        }
    }
}

/// Examines a passive link that may depend on rates, for tests.
///
/// # Panics
/// Where the link does not conform, with what is wrong.
#[track_caller]
pub fn assert_conforms(link: &dyn Link, deformation: &[f64], frequency: f64) {
    Kit::new(deformation, frequency).assert(link);
}
