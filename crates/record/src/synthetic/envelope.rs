//! How strong a motion is over time.

use super::{SyntheticError, positive};

/// An envelope with the largest value 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Envelope {
    /// 1 throughout.
    Stationary,
    /// (t/t₁)² up to t₁, 1 up to t₂, e^(−c(t − t₂)) from there \[Jennings, Housner & Tsai 1968\].
    Jennings {
        /// End of the rise t₁, s.
        rise: f64,
        /// End of the strong part t₂, s.
        strong: f64,
        /// Decay c, 1/s.
        decay: f64,
    },
    /// a (t/T)^b e^(−ct/T) with the largest value 1 at t = εT and η at t = T
    /// \[Saragoni & Hart 1974, in the form of Boore 1983\].
    SaragoniHart {
        /// ε: share of the duration at which it is largest.
        peak_at: f64,
        /// η: value at the end.
        end: f64,
    },
}

impl Envelope {
    /// Its value at a time of a motion of a duration, s.
    #[must_use]
    pub fn at(&self, t: f64, duration: f64) -> f64 {
        match *self {
            Self::Stationary => 1.0,
            Self::Jennings { rise, .. } if t < rise => (t / rise).powi(2),
            Self::Jennings { strong, decay, .. } if t > strong => (-decay * (t - strong)).exp(),
            Self::Jennings { .. } => 1.0,
            Self::SaragoniHart { peak_at: e, end } => {
                let b = -e * end.ln() / (1.0 + e * (e.ln() - 1.0));
                let s = t / (e * duration);
                if s <= 0.0 { 0.0 } else { (b * (s.ln() + 1.0 - s)).exp() }
            }
        }
    }

    pub(super) fn check(&self, duration: f64) -> Result<(), SyntheticError> {
        let share = |name, value: f64| {
            if value > 0.0 && value < 1.0 {
                return Ok(());
            }
            Err(SyntheticError::Range { name, value, range: "between 0 and 1" })
        };
        match *self {
            Self::Stationary => Ok(()),
            Self::Jennings { rise, strong, decay } => {
                positive("rise", rise)?;
                positive("decay", decay)?;
                if strong >= rise && strong <= duration {
                    return Ok(());
                }
                let range = "between `rise` and the duration";
                Err(SyntheticError::Range { name: "strong", value: strong, range })
            }
            Self::SaragoniHart { peak_at, end } => {
                share("peak_at", peak_at).and_then(|()| share("end", end))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_peak_at_one_where_they_should() {
        let s = Envelope::SaragoniHart { peak_at: 0.2, end: 0.05 };
        assert!((s.at(4.0, 20.0) - 1.0).abs() < 1e-14 && (s.at(20.0, 20.0) - 0.05).abs() < 1e-12);
        assert!(s.at(3.9, 20.0) < 1.0 && s.at(4.1, 20.0) < 1.0 && s.at(0.0, 20.0) == 0.0);
        let j = Envelope::Jennings { rise: 2.0, strong: 8.0, decay: 0.5 };
        assert_eq!([j.at(1.0, 20.0), j.at(2.0, 20.0), j.at(8.0, 20.0)], [0.25, 1.0, 1.0]);
        assert!((j.at(10.0, 20.0) - (-1.0f64).exp()).abs() < 1e-15);
        assert!(Envelope::Jennings { rise: 9.0, strong: 8.0, decay: 0.5 }.check(20.0).is_err());
    }
}
