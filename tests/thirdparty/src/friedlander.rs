//! Friedlander wave: the pressure of an explosion on a surface.
//!
//! ```text
//!   y(t) = (1 − x) e^(−b x)      x = (t − t₀)/T ≥ 0, zero before t₀
//! ```
//!
//! Reference: \[Kinney & Graham, Explosive Shocks in Air, 1985, ch. 6\].

use serde::Deserialize;
use trilith_element::{
    Card, Category, Described, Exercise, NodeCount, Parameters, Side, Stretch, Waveform,
};

/// A shock that decays. The fields are the parameters of model files.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Friedlander {
    /// time of overpressure; suction follows
    #[parameter("T", unit = "s", range = Positive)]
    pub duration: f64,
    /// how fast it falls; below 0.5 suction would be no less than pressure for long
    #[parameter("b", unit = "1", range = Within(0.5, 50.0), default = 1.0)]
    pub decay: f64,
    /// arrival of the shock, a jump from 0 to 1
    #[parameter("t₀", unit = "s", default = 0.0)]
    pub start: f64,
}

impl Described for Friedlander {
    const CARD: Card = Card::new(
        "Friedlander",
        Category::Function,
        "Shock of an explosion: a jump that decays into suction.",
    )
    .nodes(NodeCount::NONE)
    .parameters(Self::PARAMETERS)
    .law("y = (1 − x) e^(−b x),  x = (t − t₀)/T ≥ 0")
    .source("Kinney & Graham, Explosive Shocks in Air, 1985, ch. 6")
    .example(r#""blast": Friedlander(amplitude: "50 kPa", duration: "20 ms", decay: 1.5)"#)
    .exercise(Exercise::NONE);
}

impl Friedlander {
    /// Value and derivatives by x, behind the shock.
    fn behind(&self, x: f64) -> [f64; 3] {
        let (b, e) = (self.decay, (-self.decay * x).exp());
        let y = 1.0 - x;
        [y * e, -(1.0 + b * y) * e, b * (2.0 + b * y) * e]
    }
}

impl Waveform for Friedlander {
    fn at(&self, t: f64, side: Side) -> [f64; 3] {
        if !side.is_past(t, self.start) {
            return [0.0; 3];
        }
        let [y, first, second] = self.behind((t - self.start) / self.duration);
        [y, first / self.duration, second / (self.duration * self.duration)]
    }

    fn breaks(&self) -> Vec<f64> {
        vec![self.start]
    }

    /// As a sine that is bent as sharply as the wave at its shock, until a millionth is left.
    fn stretch(&self) -> Option<Stretch> {
        let bend = self.behind(0.0)[2] / (self.duration * self.duration);
        let end = self.start + self.duration * (1.0 + 17.0 / self.decay);
        Some(Stretch::of_curvature(self.start, end, bend))
    }

    fn peak_until(&self, end: f64) -> f64 {
        if end <= self.start {
            return 0.0;
        }
        // Suction is deepest at x = 1 + 1/b.
        let deepest = (1.0 + 1.0 / self.decay).min((end - self.start) / self.duration);
        self.behind(deepest)[0].abs().max(1.0)
    }
}
