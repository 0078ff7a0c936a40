//! One sound law, an elastic–plastic spring beside a dashpot, and the ways in which it can be wrong.
//!
//! f = s + c ḋ,  s = k (d − p),  |s| ≤ fᵧ

use serde::Deserialize;
use std::borrow::Cow;
use std::sync::atomic::{AtomicU64, Ordering};
use trilith::element::lanes::LaneForm;
use trilith::element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, Kinematics, Link, NodeCount,
    Parameters, Response,
};

const K: f64 = 2e4;
const YIELD: f64 = 200.0;
const C: f64 = 50.0;

macro_rules! faults {
    ($($name:ident: $what:literal,)*) => {
        /// What is wrong.
        #[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
        pub enum Fault { $($name,)* }

        impl Fault {
            pub const ALL: &[Self] = &[$(Self::$name,)*];
            pub const NAMES: &[&str] = &[$(stringify!($name),)*];

            /// True where the law keeps something of its own from call to call.
            pub fn remembers(self) -> bool {
                matches!(self, Self::MemoryOfItsOwn | Self::CountsCalls)
            }

            /// In words.
            pub fn what(self) -> &'static str {
                match self { $(Self::$name => $what,)* }
            }
        }
    };
}

faults! {
    Nothing: "nothing",
    ForceNan: "the force is NaN once it slips",
    ForceInfinite: "the force is infinite once it slips",
    ForceOfNegativeRoot: "the force is a root, NaN under push",
    StiffnessNan: "∂f/∂d is NaN once it slips",
    StiffnessInfinite: "∂f/∂d is infinite once it slips",
    DampingNan: "∂f/∂ḋ is NaN once it slips",
    HistoryNan: "its history is NaN once it slips",
    StoredNan: "stored energy is NaN once it slips",
    StoredInfinite: "stored energy is infinite once it slips",
    HystereticNan: "hysteretic energy is NaN once it slips",
    ViscousNan: "viscous energy is NaN once it slips",
    RestNan: "its history is NaN at rest",
    AlwaysNan: "the force is NaN at all times",
    HeatTwice: "hysteretic energy counts twice",
    HeatNone: "no hysteretic energy",
    HeatNegative: "hysteretic energy has the wrong sign",
    HeatMore: "2 % too much hysteretic energy",
    HeatTotal: "hysteretic energy as a total of all steps",
    StoredTwice: "stored energy counts twice",
    StoredNone: "no stored energy",
    StoredNegative: "stored energy has the wrong sign",
    StoredWhole: "stored energy ½ k d², slip and all",
    StoredChange: "stored energy as the change in the step",
    ViscousTwice: "viscous energy counts twice",
    ViscousNone: "no viscous energy",
    ViscousNegative: "viscous energy has the wrong sign",
    HistoryUnwritten: "history is not written",
    HistoryForgotten: "history is set back to rest",
    HistoryKept: "history never moves",
    MemoryOfItsOwn: "the slip is kept in the law itself",
    CountsCalls: "the force grows with the number of calls",
    NoRatesButForce: "`uses_rates` is false, the force uses them",
    NoRatesButEnergy: "`uses_rates` is false, the viscous energy uses them",
    NotADashpot: "`damping_constant` is that of another law",
    StartsElsewhere: "the force hangs on the step: other at its start than at the end before",
    PanicOfSlip: "it panics once it slips",
    IndexOfSlip: "an index is out of range once it slips",
    PanicAlways: "it panics at all times",
    PanicEngaged: "its engaged stiffness panics",
    EngagedNan: "its engaged stiffness is NaN",
    EngagedNegative: "its engaged stiffness is negative",
    TangentHalf: "∂f/∂d is half of what it should be",
    TangentTwice: "∂f/∂d is twice what it should be",
    TangentNone: "∂f/∂d is zero",
    TangentNegative: "∂f/∂d has the wrong sign",
    DampingTangentNone: "∂f/∂ḋ is zero",
    StepLate: "it asks whether it slips a step late",
}

/// The law with its fault.
#[derive(Debug, Deserialize, Parameters)]
#[parameters(crate = trilith::element)]
#[serde(deny_unknown_fields)]
pub struct Wrong {
    /// what is wrong
    #[parameter(choices = Fault::NAMES, default = "Nothing")]
    pub fault: Fault,
    #[serde(skip)]
    memory: AtomicU64,
}

impl Wrong {
    pub fn new(fault: Fault) -> Self {
        Self { fault, memory: AtomicU64::new(0) }
    }

    fn has(&self, fault: Fault) -> bool {
        self.fault == fault
    }
}

impl Described for Wrong {
    const CARD: Card = Card::new(
        "Wrong",
        Category::Link,
        "An elastic–plastic spring beside a dashpot, wrong on purpose.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = s + c ḋ")
    .source("wrong on purpose")
    .example(r#""w": Wrong(node: "m", fault: Nothing)"#)
    .exercise(Exercise::NONE);
}

impl Link for Wrong {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U1])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        vec![Field::new("slip", "m"), Field::new("heat", "J")].into()
    }

    fn at_rest(&self, at: &mut [f64]) {
        if self.has(Fault::RestNan) {
            at[0] = f64::NAN;
        }
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = match self.fault {
            Fault::PanicEngaged => panic!("no stiffness of this law is known"),
            Fault::EngagedNan => f64::NAN,
            Fault::EngagedNegative => -K,
            _ => K,
        };
    }

    fn uses_rates(&self) -> bool {
        !matches!(self.fault, Fault::NoRatesButForce | Fault::NoRatesButEnergy)
    }

    fn damping_constant(&self) -> Option<f64> {
        self.has(Fault::NotADashpot).then_some(2.0 * C)
    }

    fn lanes(&self, _: &[bool]) -> Option<LaneForm> {
        None
    }

    fn respond(&self, at: &Kinematics<'_>, was: &[f64], trial: &mut [f64], out: &mut Response<'_>) {
        let slip = match self.fault {
            Fault::MemoryOfItsOwn => f64::from_bits(self.memory.load(Ordering::Relaxed)),
            _ => was[0],
        };
        let slips = match self.fault {
            // Rounding of what has just slipped does not count.
            Fault::StepLate => (K * (at.d0[0] - slip)).abs() > (1.0 + 1e-6) * YIELD,
            _ => (K * (at.d[0] - slip)).abs() > YIELD,
        };
        let elastic = K * (at.d[0] - slip);
        let s = if slips { YIELD.copysign(elastic) } else { elastic };
        let next = at.d[0] - s / K;
        let heat = s * (next - slip);
        if !self.has(Fault::HistoryUnwritten) {
            trial.copy_from_slice(&[next, was[1] + heat]);
        }
        out.f[0] = s + C * at.v[0];
        out.k[0] = if slips { 0.0 } else { K };
        out.c[0] = C;
        out.energy.stored = 0.5 * s * s / K;
        out.energy.hysteretic = heat;
        out.energy.viscous = at.viscous_work(0, C * at.v0[0], C * at.v[0]);
        if self.has(Fault::MemoryOfItsOwn) {
            self.memory.store(next.to_bits(), Ordering::Relaxed);
        }
        self.spoil(at, was, slips, trial, out);
    }
}

impl Wrong {
    fn spoil(
        &self,
        at: &Kinematics<'_>,
        was: &[f64],
        slips: bool,
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let once = |x: f64, now: f64| if slips { x } else { now };
        match self.fault {
            Fault::ForceNan => out.f[0] = once(f64::NAN, out.f[0]),
            Fault::ForceInfinite => out.f[0] = once(f64::INFINITY, out.f[0]),
            Fault::ForceOfNegativeRoot => out.f[0] += (at.d[0] - 1e-4).sqrt() * 0.0,
            Fault::StiffnessNan => out.k[0] = once(f64::NAN, out.k[0]),
            Fault::StiffnessInfinite => out.k[0] = once(f64::INFINITY, out.k[0]),
            Fault::DampingNan => out.c[0] = once(f64::NAN, out.c[0]),
            Fault::HistoryNan => trial[0] = once(f64::NAN, trial[0]),
            Fault::StoredNan => out.energy.stored = once(f64::NAN, out.energy.stored),
            Fault::StoredInfinite => out.energy.stored = once(f64::INFINITY, out.energy.stored),
            Fault::HystereticNan => out.energy.hysteretic = once(f64::NAN, out.energy.hysteretic),
            Fault::ViscousNan => out.energy.viscous = once(f64::NAN, out.energy.viscous),
            Fault::AlwaysNan => out.f[0] = f64::NAN,
            Fault::HeatTwice => out.energy.hysteretic *= 2.0,
            Fault::HeatNone => out.energy.hysteretic = 0.0,
            Fault::HeatNegative => out.energy.hysteretic *= -1.0,
            Fault::HeatMore => out.energy.hysteretic *= 1.02,
            Fault::HeatTotal => out.energy.hysteretic = trial[1],
            Fault::StoredTwice => out.energy.stored *= 2.0,
            Fault::StoredNone => out.energy.stored = 0.0,
            Fault::StoredNegative => out.energy.stored *= -1.0,
            Fault::StoredWhole => out.energy.stored = 0.5 * K * at.d[0] * at.d[0],
            Fault::StoredChange => {
                let before = K * (at.d0[0] - was[0]);
                out.energy.stored -= 0.5 * before * before / K;
            }
            Fault::ViscousTwice => out.energy.viscous *= 2.0,
            Fault::ViscousNone => out.energy.viscous = 0.0,
            Fault::ViscousNegative => out.energy.viscous *= -1.0,
            Fault::HistoryForgotten => trial.fill(0.0),
            Fault::HistoryKept => trial.copy_from_slice(was),
            Fault::CountsCalls => {
                let calls = self.memory.fetch_add(1, Ordering::Relaxed);
                out.f[0] *= 1.0 + 1e-3 * calls as f64;
            }
            Fault::NoRatesButEnergy => {
                out.f[0] -= C * at.v[0];
                out.c[0] = 0.0;
            }
            Fault::StartsElsewhere => out.f[0] += 0.2 * YIELD * (1.0 - (-100.0 * at.dt).exp()),
            Fault::PanicOfSlip => assert!(!slips, "a slip that nobody has thought of"),
            Fault::IndexOfSlip => trial[0] = trial[if slips { 7 } else { 0 }],
            Fault::PanicAlways => panic!("it does not want to"),
            Fault::TangentHalf => out.k[0] *= 0.5,
            Fault::TangentTwice => out.k[0] *= 2.0,
            Fault::TangentNone => out.k[0] = 0.0,
            Fault::TangentNegative => out.k[0] *= -1.0,
            Fault::DampingTangentNone => out.c[0] = 0.0,
            _ => {}
        }
    }
}
