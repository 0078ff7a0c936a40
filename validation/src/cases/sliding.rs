//! Friction.

use super::set;
use crate::case::BOTH;
use crate::unit::{INCH, METRE};
use crate::{Case, Check, Curve, View};
use std::f64::consts::{PI, TAU};

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
    vec![sl1(), sl2(), without_friction()]
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
        source: "Code_Aster SDND100",
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
        source: "ANSYS VM73; Tse, Morse, Hinkle, p. 175",
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
