//! A function of time from another crate, with its amplitude.

use std::sync::Arc;
use trilith_element::{Card, Side, Stretch, Values, Waveform};

/// `amplitude · y(t)` of a [`Waveform`].
#[derive(Clone, Debug)]
pub struct Custom {
    /// Factor of the waveform.
    pub amplitude: f64,
    /// Its card.
    pub card: &'static Card,
    /// The parameters it was made from.
    pub values: Arc<Values>,
    /// What it does in time.
    pub waveform: Arc<dyn Waveform>,
}

/// The same kind with the same parameters: a waveform has no memory.
impl PartialEq for Custom {
    fn eq(&self, other: &Self) -> bool {
        self.amplitude == other.amplitude
            && self.card.kind == other.card.kind
            && self.values == other.values
    }
}

/// Places between two breaks that are looked at.
const LOOKS: usize = 64;

impl Custom {
    /// Value and first two derivatives at t (s).
    #[must_use]
    pub fn at(&self, t: f64, side: Side) -> [f64; 3] {
        self.waveform.at(t, side).map(|y| self.amplitude * y)
    }

    /// Largest |value| up to a time, s.
    #[must_use]
    pub fn peak_until(&self, end: f64) -> f64 {
        self.amplitude.abs() * self.waveform.peak_until(end)
    }

    /// What the waveform says of itself that cannot be, by looks at its breaks and between them.
    #[must_use]
    pub fn fault(&self) -> Option<String> {
        let y = self.waveform.as_ref();
        let mut times = y.breaks();
        if let Some(t) = times.iter().find(|t| t.is_nan()) {
            return Some(format!("`breaks` has a time that is {t}"));
        }
        if let Some(Stretch { from, to, step }) = y.stretch() {
            let good = from <= to && step > 0.0 && from.is_finite();
            if !good {
                return Some(format!(
                    "`stretch` is from {from} s to {to} s in steps of {step} s: must be forward in time with a positive step"
                ));
            }
            times.extend([from, to, from + 32.0 * step]);
        }
        times.retain(|t| t.is_finite() && *t >= 0.0);
        times.extend([0.0, 1.0]);
        times.sort_by(f64::total_cmp);
        times.dedup();
        let peak = y.peak_until(f64::INFINITY);
        if !(peak >= 0.0 && peak.is_finite()) {
            return Some(format!("`peak_until` is {peak} for all times"));
        }
        let between = times.windows(2).flat_map(|two| {
            (0..=LOOKS).map(|i| two[0] + (two[1] - two[0]) * i as f64 / LOOKS as f64)
        });
        for t in between {
            for side in [Side::Before, Side::After] {
                let [value, first, second] = y.at(t, side);
                if let Some(x) = [value, first, second].iter().find(|x| !x.is_finite()) {
                    return Some(format!("a value or a derivative is {x} at {t} s"));
                }
                if value.abs() > peak * (1.0 + 1e-9) {
                    return Some(format!(
                        "the value at {t} s is {value}, but `peak_until` is {peak} for all times"
                    ));
                }
            }
        }
        None
    }
}
