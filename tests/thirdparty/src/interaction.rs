//! How far a steel section is used by an axial force and two moments.
//!
//! ```text
//!   n = |N|/N_c    m = |M₂|/M_c2 + |M₃|/M_c3
//!   y = n + 8/9 m   where n ≥ 0.2,    y = n/2 + m   elsewhere
//! ```
//!
//! Reference: \[AISC 360-16, equations H1-1a and H1-1b\].

use serde::Deserialize;
use trilith_element::dimension::{FORCE, MOMENT, NONE};
use trilith_element::{
    Card, Category, DerivedOutput, Described, Dimension, Exercise, NodeCount, ParameterError,
    Parameters,
};

/// The section. The fields are the parameters of model files.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Interaction {
    /// axial strength
    #[parameter("N_c", unit = "N", range = Positive)]
    pub nc: f64,
    /// strength about local 2
    #[parameter("M_c2", unit = "N·m", range = Positive)]
    pub mc2: f64,
    /// strength about local 3
    #[parameter("M_c3", unit = "N·m", range = Positive)]
    pub mc3: f64,
}

impl Described for Interaction {
    const CARD: Card = Card::new(
        "Interaction",
        Category::Output,
        "How far a steel section is used by an axial force and two moments; 1 is its strength.",
    )
    .nodes(NodeCount::NONE)
    .parameters(Self::PARAMETERS)
    .law("n + 8/9 m where n ≥ 0.2, n/2 + m elsewhere;  n = |N|/N_c, m = |M₂|/M_c2 + |M₃|/M_c3")
    .source("AISC 360-16, equations H1-1a and H1-1b")
    .example(r#""foot used": Interaction(of: ["N", "M2", "M3"], nc: "2 MN", mc2: "150 kN*m", mc3: "400 kN*m")"#)
    .exercise(Exercise::NONE);
}

impl Interaction {
    /// Shares of the three strengths.
    fn shares(&self, of: &[f64]) -> [f64; 3] {
        [of[0] / self.nc, of[1] / self.mc2, of[2] / self.mc3]
    }
}

impl DerivedOutput for Interaction {
    fn dimension(&self, of: &[Dimension]) -> Result<Dimension, ParameterError> {
        let wanted = [FORCE, MOMENT, MOMENT];
        let fits = of.len() == 3 && of.iter().zip(wanted).all(|(of, wanted)| of.matches(wanted));
        if fits {
            return Ok(NONE);
        }
        let message = "`of` must name an axial force and two moments, about local 2 and 3";
        Err(ParameterError::inconsistent("of", message))
    }

    fn value(&self, of: &[f64]) -> f64 {
        let [n, m2, m3] = self.shares(of).map(f64::abs);
        let m = m2 + m3;
        if n >= 0.2 { n + 8.0 / 9.0 * m } else { 0.5 * n + m }
    }

    fn derivatives(&self, of: &[f64], by: &mut [f64]) -> bool {
        let shares = self.shares(of);
        let [axial, bending] = if shares[0].abs() >= 0.2 { [1.0, 8.0 / 9.0] } else { [0.5, 1.0] };
        by[0] = (axial / self.nc).copysign(shares[0]);
        by[1] = (bending / self.mc2).copysign(shares[1]);
        by[2] = (bending / self.mc3).copysign(shares[2]);
        true
    }
}
