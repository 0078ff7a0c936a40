//! A linear spring and a sliding link, only to be read, and a function of time.

use crate::Registry;
use std::borrow::Cow;
use trilith_element::dimension as d;
use trilith_element::*;

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only read")]
struct Spring {
    stiffness: f64,
    #[serde(default)]
    inertia: Option<[f64; 3]>,
}

const fn parameter(name: &'static str, form: Form, range: Range, default: Default) -> Parameter {
    Parameter::new(name, "x", form, default, "a made-up number").within(range)
}

impl Described for Spring {
    const CARD: Card = Card::new("Spring", Category::Linear, "A spring.")
        .nodes(NodeCount { min: 1, max: 3 })
        .parameters(&[
            parameter("stiffness", Form::Number(d::STIFFNESS), Range::Positive, Default::Required),
            parameter(
                "inertia",
                Form::Numbers { dimension: d::INERTIA, count: Some(3) },
                Range::NonNegative,
                Default::Absent,
            ),
        ])
        .law("f = k d")
        .source("")
        .example("")
        .exercise(Exercise::NONE);
}

impl LinearElement for Spring {
    fn matrices(&self, _: &Geometry<'_>) -> Result<ElementMatrices, ParameterError> {
        Ok(ElementMatrices::zeros(Vec::new()))
    }
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only read")]
struct Slider {
    kn: f64,
    mu: f64,
    c: f64,
    exponent: f64,
    dash: String,
    pull: bool,
    axes: Vec<Axis>,
}

impl Described for Slider {
    const CARD: Card = Card::new("Slider", Category::Link, "A sliding link.")
        .nodes(NodeCount::GROUND_OR_TWO)
        .parameters(&[
            parameter("kn", Form::Number(d::STIFFNESS), Range::Positive, Default::Required),
            parameter("mu", Form::Number(d::NONE), Range::Within(0.0, 2.0), Default::Number(0.5)),
            parameter(
                "c",
                Form::Power { base: d::FORCE, over: d::VELOCITY, exponent: "exponent" },
                Range::NonNegative,
                Default::Number(0.0),
            ),
            parameter("exponent", Form::Number(d::NONE), Range::Positive, Default::Number(1.0)),
            parameter(
                "dash",
                Form::Choice(&["contact", "always"]),
                Range::Any,
                Default::Choice("contact"),
            ),
            parameter("pull", Form::Flag, Range::Any, Default::Flag(true)),
            parameter("axes", Form::Choices(Axis::NAMES), Range::Any, Default::Choice("U1")),
        ])
        .law("f = k d")
        .source("")
        .example("")
        .exercise(Exercise::NONE);
    fn check(&self) -> Result<(), ParameterError> {
        if self.mu == 0.0 && self.c > 0.0 {
            return Err(ParameterError::inconsistent("c", "a dashpot needs friction here"));
        }
        Ok(())
    }
}

impl Link for Slider {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(self.axes.clone())
    }
    fn history(&self) -> Cow<'static, [Field]> {
        vec![Field::new("slip2", "m")].into()
    }
    fn engaged_stiffness(&self, _: &mut [f64]) {}
    fn respond(&self, _: &Kinematics<'_>, _: &[f64], _: &mut [f64], _: &mut Response<'_>) {}
}

/// y = e^(−(t − start)/time), from the start on.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Decay {
    time: f64,
    start: f64,
}

impl Described for Decay {
    const CARD: Card = Card::new("Decay", Category::Function, "A shock that decays.")
        .nodes(NodeCount::NONE)
        .parameters(&[
            parameter("time", Form::Number(d::TIME), Range::Positive, Default::Required),
            parameter("start", Form::Number(d::TIME), Range::Any, Default::Number(0.0)),
        ])
        .law("y = e^(−(t − start)/time)")
        .source("")
        .example("")
        .exercise(Exercise::NONE);
}

impl Waveform for Decay {
    fn at(&self, t: f64, side: Side) -> [f64; 3] {
        if !side.is_past(t, self.start) {
            return [0.0; 3];
        }
        let y = (-(t - self.start) / self.time).exp();
        [y, -y / self.time, y / (self.time * self.time)]
    }
    fn breaks(&self) -> Vec<f64> {
        vec![self.start]
    }
    fn stretch(&self) -> Option<Stretch> {
        let end = self.start + 15.0 * self.time;
        Some(Stretch::of_curvature(self.start, end, 1.0 / (self.time * self.time)))
    }
    fn peak_until(&self, end: f64) -> f64 {
        if end > self.start { 1.0 } else { 0.0 }
    }
}

pub(super) fn registry() -> Registry {
    let mut registry = Registry::new();
    registry.linear::<Spring>();
    registry.link::<Slider>();
    registry.function::<Decay>();
    registry
}
