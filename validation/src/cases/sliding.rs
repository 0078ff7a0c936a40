//! Friction.

use super::set;
use crate::case::BOTH;
use crate::unit::{INCH, METRE, NUMBER, SECOND, SPEED, Unit};
use crate::{Case, Check, Curve, View};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const G: f64 = 9.80665;

/// A mass on a spring and a friction contact, let go from a distance.
const FREE: &str = r#"(
    title: "Free vibration with friction",
    parameters: {
        "mass": "1 kg", "k": "1e4 N/m", "mu": 0.1, "normal": "10 N", "ks": "1e8 N/m", "u0": "0.85 mm",
        "duration": "0.2 s", "dt": "0.1 ms",
    },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "mass"),
        "spring": Spring(node: "m", k2: "k"),
        "friction": NLink(node: "m", kn: "ks", ks: "ks", mu: "mu"),
    },
    loads: { "press": [(node: "m", dof: Uz, force: "-normal")] },
    cases: {
        "press": Static(loads: ["press"]),
        "free": Dynamic(
            after: "press", duration: "duration", dt: "dt",
            initial: [(node: "m", dof: Ux, displacement: "u0")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

/// A block on a moving base; the contact is so stiff that its play before slip is 2 nm.
const BLOCK: &str = r#"(
    title: "Sliding block",
    parameters: {
        "mu": 0.2, "a": "1.5 g", "frequency": "5 Hz", "cycles": 1, "duration": "0.6 s",
    },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1 t"),
        "friction": NLink(node: "m", kn: "1e12 N/m", ks: "1e12 N/m", mu: "mu"),
    },
    functions: { "shaking": Sine(amplitude: "a", frequency: "frequency", cycles: "cycles") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shaking": Dynamic(
            after: "gravity", duration: "duration", dt: "0.5 ms",
            base: [(direction: X, function: "shaking")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux), "v": Velocity(node: "m", dof: Ux) },
)"#;

const PULSE: &str = r#"(
    title: "Sliding block under a rectangular pulse",
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1 t"),
        "friction": NLink(node: "m", kn: "1e12 N/m", ks: "1e12 N/m", mu: 0.2),
    },
    functions: { "pulse": Step(amplitude: "0.5 g", end: "0.1 s") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "pulse": Dynamic(
            after: "gravity", duration: "0.4 s", dt: "0.5 ms",
            base: [(direction: X, function: "pulse")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux), "v": Velocity(node: "m", dof: Ux) },
)"#;

const TABLE: &str = r#"(
    title: "Block on a vibrating table",
    parameters: { "a": "15 m/s^2" },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1 kg"),
        "friction": NLink(node: "m", kn: "1e9 N/m", ks: "1e9 N/m", mu: 0.1),
    },
    loads: { "press": [(node: "m", dof: Uz, force: "-10 N")] },
    functions: { "shaking": Sine(amplitude: "a", frequency: "1 Hz") },
    cases: {
        "press": Static(loads: ["press"]),
        "shaking": Dynamic(
            after: "press", duration: "12 s", dt: "1 ms",
            base: [(direction: X, function: "shaking")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

const DEN_HARTOG: &str = r#"(
    title: "Steady vibration with friction",
    parameters: { "ratio": 0.8, "friction": 0.5 },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1 kg"),
        "spring": Spring(node: "m", k2: "1e4 N/m"),
        "friction": NLink(node: "m", kn: "1e10 N/m", ks: "1e10 N/m", mu: "friction"),
    },
    loads: {
        "press": [(node: "m", dof: Uz, force: "-100 N")],
        "shake": [(node: "m", dof: Ux, force: "100 N")],
    },
    functions: { "shaking": Cosine(amplitude: 1, frequency: "ratio*100/(2*3.141592653589793)") },
    cases: {
        "press": Static(loads: ["press"]),
        "shaking": Dynamic(
            after: "press", duration: "150*2*3.141592653589793/(100*ratio)", dt: "1 ms",
            forces: [(load: "shake", function: "shaking")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

/// Free vibration with Coulomb friction: let go at `u0`, friction / stiffness `d`.
pub(super) fn coulomb(u0: f64, d: f64, w: f64) -> impl Fn(f64) -> f64 + Copy {
    move |t| {
        // At rest at the first turning point from which the spring cannot pull it away.
        let size = |n: f64| u0.abs() - 2.0 * n * d;
        let last = ((u0.abs() / d - 1.0) / 2.0).ceil().max(0.0);
        let n = (w * t / PI).floor();
        let sign = |n: f64| if n % 2.0 == 0.0 { u0.signum() } else { -u0.signum() };
        if n >= last {
            return sign(last) * size(last);
        }
        sign(n) * (d + (size(n) - d) * (w * t - n * PI).cos())
    }
}

/// A rigid block with friction on a base that moves with the acceleration a sin ωt up to `end`:
/// displacement on the base, slip after slip.
pub(super) struct Slider {
    a: f64,
    w: f64,
    end: f64,
    friction: f64,
    /// (start, displacement there, direction; 0: sticks) of each phase.
    phases: Vec<(f64, f64, f64)>,
}

impl Slider {
    /// Friction is a deceleration.
    pub(super) fn new(a: f64, w: f64, end: f64, friction: f64, duration: f64) -> Self {
        let mut all = Self { a, w, end, friction, phases: vec![(0.0, 0.0, 0.0)] };
        let step = TAU / w / 500.0;
        while let Some(&(start, u, direction)) = all.phases.last() {
            // Positive until the phase ends.
            let left = |t: f64| match direction {
                0.0 => friction - all.acceleration(t).abs(),
                s => s * all.rate(start, s, t),
            };
            let mut low = start + 1e-3 * step;
            while low < duration && left(low + step) > 0.0 {
                low += step;
            }
            if low >= duration {
                break;
            }
            let mut high = low + step;
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if left(middle) > 0.0 { low = middle } else { high = middle }
            }
            let push = all.acceleration(high);
            let next = if push.abs() < friction { 0.0 } else { -push.signum() };
            let at = u + all.slip(start, direction, high);
            all.phases.push((high, at, next));
        }
        all
    }

    fn acceleration(&self, t: f64) -> f64 {
        if t < self.end { self.a * (self.w * t).sin() } else { 0.0 }
    }

    /// Speed and displacement of the base.
    fn base(&self, t: f64) -> (f64, f64) {
        let (v, at) = (self.a / self.w, t.min(self.end));
        let speed = v * (1.0 - (self.w * at).cos());
        (speed, v * (at - (self.w * at).sin() / self.w) + speed * (t - at))
    }

    /// Speed at `t` of a slip that starts at `from`.
    fn rate(&self, from: f64, direction: f64, t: f64) -> f64 {
        self.base(from).0 - self.base(t).0 - direction * self.friction * (t - from)
    }

    /// Displacement since the start of the phase.
    fn slip(&self, from: f64, direction: f64, t: f64) -> f64 {
        if direction == 0.0 {
            return 0.0;
        }
        let (start, now, tau) = (self.base(from), self.base(t), t - from);
        start.1 + start.0 * tau - now.1 - direction * self.friction * tau * tau / 2.0
    }

    /// Displacement on the base.
    pub(super) fn at(&self, t: f64) -> f64 {
        let i = self.phases.partition_point(|p| p.0 <= t).saturating_sub(1);
        let (start, u, direction) = self.phases[i];
        u + self.slip(start, direction, t)
    }
}

pub(super) fn cases() -> Vec<Case> {
    vec![sl1(), sl2(), without_friction(), sl4(), sl5(), sl6(), sl8()]
}

fn sl1() -> Case {
    let turn = |n: u32| {
        let size = 8.5e-4 - 2.0 * f64::from(n) * 1e-4;
        let t = f64::from(n) * PI / 100.0;
        let reference = if n.is_multiple_of(2) { size } else { -size };
        let tolerance = if n == 4 { 1e-2 } else { 1e-3 };
        Check::new(format!("u at turning point {n}"), METRE, reference, tolerance, move |r| {
            r.at("u", t)
        })
        .published()
        .mark("u", t)
    };
    let mut checks: Vec<Check> = (1..=4).map(turn).collect();
    checks.push(Check::new("u at rest", METRE, 5e-5, 1e-2, |r| r.last("u")).mark("u", 0.2));
    Case {
        id: "SL-1",
        title: "Free vibration with Coulomb friction",
        source: "Code_Aster V5.01.100 (SDND100)",
        text: FREE.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([Curve::new("u", METRE).against(coulomb(8.5e-4, 1e-4, 100.0))]),
        checks,
    }
}

fn sl2() -> Case {
    let at = |t: f64, reference: f64| Check::at("u", INCH, t, reference, 2e-3).published();
    let u = coulomb(-1.0, 0.1875 * 10.0 / 30.0, (30.0 * 386.0 / 10.0_f64).sqrt());
    Case {
        id: "SL-2",
        title: "Free vibration with Coulomb friction, US units",
        source: "ANSYS VM73; Tse, Morse, Hinkle 1963, p. 175",
        text: FREE.into(),
        set: vec![
            set("mass", "(10/386)*(1 lbf*s^2/in)"),
            set("k", "30 lbf/in"),
            set("mu", 0.1875),
            set("normal", "10 lbf"),
            set("ks", "1e6 lbf/in"),
            set("u0", "-1 in"),
        ],
        solvers: BOTH,
        view: View::histories([Curve::new("u", INCH).against(u)]),
        checks: vec![at(0.09, 0.87208), at(0.102, 0.83132), at(0.183, -0.74874)],
    }
}

/// Property (e) of the FNA list: no damping is no damping.
fn without_friction() -> Case {
    let u = |t: f64| 8.5e-4 * (100.0 * t).cos();
    let period = TAU / 100.0;
    let shown =
        |from: f64, to: f64| Curve::new("u", METRE).against(u).over(from * period, to * period);
    Case {
        id: "FN-2e",
        title: "Free vibration without friction keeps its amplitude",
        source: "u = u₀ cos ωt; the tolerance is that of an exact rule",
        text: FREE.into(),
        set: vec![
            set("mu", 0),
            set("duration", 100.0 * TAU / 100.0),
            set("dt", TAU / 100.0 / 40.0),
        ],
        solvers: &[crate::Solver::Fna],
        view: View::histories([shown(0.0, 3.0), shown(97.0, 100.01)]),
        checks: vec![
            Check::new("u after 100 periods", METRE, 8.5e-4, 1e-10, |r| r.last("u"))
                .mark("u", 100.0 * period),
        ],
    }
}

/// Stick and slip of a block on a table, by the mean of N |v| from 4 s to 12 s.
fn sl4() -> Case {
    // One amplitude a case would be four models; the slipping ones tell regimes apart.
    let watt = Unit::si("W");
    let shown = |from: f64, to: f64| {
        let slider = Slider::new(1.5, TAU, f64::INFINITY, 1.0, to);
        Curve::new("u", METRE).against(move |t| slider.at(t)).over(from, to)
    };
    Case {
        id: "SL-4",
        title: "Block on a vibrating table, stick-slip",
        source: "Code_Aster V5.01.104 (SDND104)",
        text: TABLE.into(),
        set: vec![set("a", "1.5 m/s^2")],
        solvers: BOTH,
        view: View::histories([shown(0.0, 3.0), shown(10.0, 12.0)]),
        checks: vec![
            Check::new("mean of N |v|", watt, 0.409062, 1e-3, |r| {
                (r.friction_heat(12.0) - r.friction_heat(4.0)) / 8.0 / 0.1
            })
            .published(),
            // a = 1.5, μ g = 1: slip from asin(1/1.5)/ω to the next root of the relative velocity.
            Check::new("slip per half cycle", METRE, 0.020_453_12, 1e-3, |r| {
                (r.at("u", 10.6) - r.at("u", 10.1)).abs()
            }),
        ],
    }
}

fn sl5() -> Case {
    let tolerance = 2e-3;
    let (mu, a, w) = (0.2 * G, 1.5 * G, 10.0 * PI);
    // Steady slip range 2 (A/ω²) √(1 − (π μ g/2A)²).
    let shown = |from: f64, to: f64| {
        let slider = Slider::new(a, w, f64::INFINITY, mu, to);
        Curve::new("u", METRE).against(move |t| slider.at(t)).over(from, to)
    };
    let range = 2.0 * a / (w * w) * (1.0 - (FRAC_PI_2 * mu / a).powi(2)).sqrt();
    Case {
        id: "SL-5",
        title: "Block sliding under 1.5 g, 5 Hz, steady range",
        source: "Westermo, Udwadia 1983; exact slip-slip motion",
        text: BLOCK.into(),
        set: vec![set("cycles", 60), set("duration", "12 s")],
        solvers: BOTH,
        view: View::histories([shown(0.0, 1.0), shown(11.0, 12.0)]),
        checks: vec![
            Check::new("slip range", METRE, range, tolerance, |r| {
                r.max("u", 11.6, 11.8) - r.min("u", 11.6, 11.8)
            }),
            // First slip: u = −[A/ω² (sin ωt₀ − sin ωt) + A/ω (t − t₀) cos ωt₀ − μg (t − t₀)²/2].
            Check::new("first reversal", SECOND, 0.160_874_7, tolerance, |r| {
                r.extreme("u", -1.0, 0.0, 0.25).0
            }),
            Check::new("u at first reversal", METRE, -0.064_654_2, tolerance, |r| {
                r.min("u", 0.0, 0.25)
            })
            .mark("u", 0.160_874_7),
        ],
    }
}

fn sl6() -> Case {
    let (a, mu, tp) = (0.5, 0.2, 0.1);
    let v = move |t: f64| -G * (a * t.min(tp) - mu * t.min(tp * a / mu));
    let u = move |t: f64| {
        let (pulse, slip) = (t.min(tp), t.min(tp * a / mu));
        -G * (a * pulse * (slip - pulse / 2.0) - mu * slip * slip / 2.0)
    };
    Case {
        id: "SL-6",
        title: "Sliding block under a rectangular pulse",
        source: "Newmark 1965",
        text: PULSE.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([
            Curve::new("u", METRE).against(u),
            Curve::new("v", SPEED).against(v),
        ]),
        checks: vec![
            Check::new("largest speed", SPEED, (a - mu) * G * tp, 1e-3, |r| r.peak("v", 0.0, 0.4)),
            Check::new("slip", METRE, G * tp * tp * (a - mu) * a / (2.0 * mu), 1e-3, |r| {
                r.last("u").abs()
            }),
            Check::new("end of slip", SECOND, tp * a / mu, 1e-3, |r| r.crossing("v", 0.0, 0))
                .mark_time("v", 0.0),
        ],
    }
}

fn sl8() -> Case {
    let (r, f): (f64, f64) = (0.8, 0.5);
    let v = 1.0 / (1.0 - r * r);
    let u = (PI / r).sin() / (r * (1.0 + (PI / r).cos()));
    let amplitude = (v * v - f * f * u * u).sqrt();
    // Half a cycle from a turning point on, in units of P/k and of 1/ω₀; the load leads by `lead`.
    let lead = (-f * u / v).asin();
    let half = move |t: f64| v * (r * t + lead).cos() + f * (1.0 - t.cos() - r * u * t.sin());
    let steady = move |t: f64| {
        let phase = (100.0 * r * t - lead).rem_euclid(TAU);
        0.01 * if phase < PI { half(phase / r) } else { -half((phase - PI) / r) }
    };
    let last = 150.0 * TAU / (100.0 * r);
    let shown = Curve::new("u", METRE).against(steady).over(0.98 * last, last);
    Case {
        id: "SL-8",
        title: "Steady vibration with Coulomb friction, motion without stops",
        source: "Den Hartog 1931",
        text: DEN_HARTOG.into(),
        set: vec![set("ratio", r), set("friction", f)],
        solvers: BOTH,
        view: View::histories([shown]),
        checks: vec![Check::new("amplitude k/P", NUMBER, amplitude, 5e-3, move |t| {
            let end = 150.0 * TAU / (100.0 * r);
            t.peak("u", end * 0.98, end) * 1e4 / 100.0
        })],
    }
}
