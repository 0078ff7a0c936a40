//! Actuator: pushes its ends apart by a force that grows after it is switched on. A law that looks at the clock.
//!
//! ```text
//!   f = −F s(t)        s = 0 before `on`, rises evenly over `rise`, 1 after that
//! ```
//!
//! A law is told how long a step is, not when: it counts the time in a variable of its history, from the first
//! dynamic case of a chain on. So checkpoints have it, a step that is tried again begins where it began, and a static case, in
//! which no time passes, finds the force that there was. The work that it does is entered as what the law gives, below zero
//! where it puts energy into the structure.
//!
//! Reference: elementary.

use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Kinematics, Link,
    NodeCount, Parameters, Response, Stroke, history,
};

/// A force that grows after it is switched on. The fields are the parameters of model files, in SI.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Actuator {
    /// force at last; > 0 pushes the ends apart
    #[parameter("F", unit = "N")]
    pub force: f64,
    /// when it is switched on
    #[parameter("t₀", unit = "s", range = NonNegative, default = 0.0)]
    pub on: f64,
    /// how long the force grows
    #[parameter("t_r", unit = "s", range = Positive)]
    pub rise: f64,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U1")]
    pub axis: Axis,
}

history! {
    /// What an actuator knows.
    pub struct Clock {
        /// Time since the first dynamic case began.
        pub time: "s",
    }
}

impl Described for Actuator {
    const CARD: Card = Card::new(
        "Actuator",
        Category::Link,
        "Force that grows after it is switched on.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = −F s(t),  s = 0 before t₀, (t − t₀)/t_r, 1 after t₀ + t_r")
    .source("elementary")
    .example(
        r#""jack": Actuator(nodes: ("base", "floor"), force: "20 kN", on: "0.5 s", rise: "0.2 s")"#,
    )
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.01)]));
}

impl Actuator {
    /// The force at a time.
    fn at(&self, time: f64) -> f64 {
        -self.force * ((time - self.on) / self.rise).clamp(0.0, 1.0)
    }
}

impl Link for Actuator {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        Clock::FIELDS.into()
    }

    /// It holds nothing.
    fn engaged_stiffness(&self, _: &mut [f64]) {}

    fn uses_rates(&self) -> bool {
        false
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let Clock { time: start } = Clock::load(committed);
        let time = start + at.dt;
        out.f[0] = self.at(time);
        out.energy.hysteretic = 0.5 * (self.at(start) + out.f[0]) * (at.d[0] - at.d0[0]);
        Clock { time }.store(trial);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_element::Driver;
    use trilith_element::conformance::Kit;

    fn jack() -> Actuator {
        Actuator { force: 1e3, on: 0.5, rise: 0.2, axis: Axis::U1 }
    }

    /// It gives energy by itself: an active law.
    #[test]
    fn conforms_as_an_active_law() {
        Kit::new(&[0.01], 1.0).active().assert(&jack());
    }

    #[test]
    fn waits_grows_and_holds() {
        let jack = jack();
        let mut driver = Driver::new(&jack);
        let mut forces = Vec::new();
        for _ in 0..8 {
            forces.push(driver.step(&[0.0], &[0.0], 0.1)[0]);
        }
        let expected = [0.0, 0.0, 0.0, 0.0, 0.0, -500.0, -1e3, -1e3];
        for (f, expected) in forces.iter().zip(expected) {
            assert!((f - expected).abs() < 1e-9, "{forces:?}");
        }
        // No time passes in a look, nor in a static step.
        assert_eq!(driver.step(&[0.0], &[0.0], 0.0)[0], forces[7]);
    }
}
