//! Convergence as fixed steps are halved: the observed order of every time rule.

use super::runs::{FNA, HHT, Method, RULES, largest, rms, run_fixed, slope};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study, Trace};
use std::fmt::Write;
use trilith_report::{Color, Figure, Stroke};

pub(super) const STUDIES: [Study; 5] = [
    Study {
        id: "CV-1",
        title: "Order of the time rules: smooth motion",
        source: "Damped oscillation in closed form; the chain against a run in steps 32 times finer; \
                 theory: Hughes 1987, ch. 9 (order two)",
        work: smooth,
    },
    Study {
        id: "CV-2",
        title: "Order of the time rules: impact on an elastic stop",
        source: "Half a sine of contact between free flights; a force with a kink in an otherwise \
                 smooth motion leaves a rule of order two at two",
        work: gap,
    },
    Study {
        id: "CV-3",
        title: "Order of the time rules: impact on a contact with a dashpot",
        source: "Damped contact between free flights (as IM-1a); a force that jumps inside a fixed step \
                 is an impulse error in proportion to the step: order one",
        work: jump,
    },
    Study {
        id: "CV-4",
        title: "Order of the time rules: Coulomb friction with pre-slip stiffness",
        source: "Stick and slip are both harmonic: closed form from event to event",
        work: friction,
    },
    Study {
        id: "CV-5",
        title: "FNA is exact for loads that are linear in the step",
        source: "Response of a damped oscillator to ramps, superposed (Chopra, Dynamics of Structures, \
                 §4.4)",
        work: piecewise_linear,
    },
];

/// Steps of a study: an output step cut into 1, 2, 4 … parts.
struct Steps {
    output: f64,
    halvings: u32,
}

impl Steps {
    fn all(&self) -> impl Iterator<Item = (usize, f64)> {
        (0..=self.halvings).map(|i| (1 << i, self.output / f64::from(1 << i)))
    }
}

/// Step and error of a rule.
fn errors(
    text: &str,
    method: Method,
    steps: &Steps,
    error: &dyn Fn(&Trace) -> f64,
) -> Result<Vec<(f64, f64)>, String> {
    steps.all().map(|(n, dt)| Ok((dt, error(&run_fixed(text, method, n)?)))).collect()
}

/// Measures all rules, draws their errors and claims their orders, fitted to the four finest steps.
fn study(
    found: &mut Findings,
    (name, text): (&str, &str),
    steps: &Steps,
    (order, tolerance): (f64, Tolerance),
    error: &dyn Fn(&Trace) -> f64,
) -> Result<(), String> {
    let mut figure = Figure::new(name, "step [s]", "error / size").log_log();
    let strokes = [Stroke::Rings, Stroke::Crosses, Stroke::Squares, Stroke::Line];
    let mut first = Vec::new();
    for (method, stroke) in RULES.into_iter().zip(strokes) {
        let points = errors(text, method, steps, error)?;
        let finest = &points[points.len().saturating_sub(4)..];
        let what = format!("{name}: observed order, {}", method.name);
        let value = slope(finest);
        found.check(what, "", (order, Kind::Theory), tolerance, method.solver.name(), value);
        figure = figure.series(method.name, stroke, points.iter().copied());
        if first.is_empty() {
            first = points;
        }
    }
    for power in [1, 2] {
        let (x1, y1) = first[0];
        let (x0, y0) = first[first.len() - 1];
        // Through the middle of the first curve.
        let (x, y) = ((x0 * x1).sqrt(), (y0 * y1).sqrt());
        let at = |t: f64| (t, y * (t / x).powi(power));
        let shade = Color(150, 150, 150);
        let stroke = if power == 1 { Stroke::Line } else { Stroke::Dashes };
        figure = figure.colored(format!("slope {power}"), stroke, shade, [at(x0), at(x1)]);
    }
    found.figure(figure);
    Ok(())
}

/// ü + 2 ζ ω u̇ + ω² u = 0 from u = 1, with the dashpot as a link.
const OSCILLATOR: &str = r#"(
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 1),
        "spring": Spring(node: "m", k2: "(2*3.141592653589793)^2"),
        "dashpot": Dashpot(node: "m", axis: U2, c: "2*0.1*2*3.141592653589793"),
    },
    cases: { "free": Dynamic(
        duration: "2 s", dt: "0.05 s", initial: [(node: "m", dof: Ux, displacement: 1)],
    ) },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

/// Three masses with a dashpot of power 1.5 between them and a contact that stays open.
const CHAIN: &str = r#"(
    nodes: { "a": (0, 0, 0), "b": (1, 0, 0), "c": (2, 0, 0) },
    supports: {
        "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz), "c": (Uy, Uz, Rx, Ry, Rz),
    },
    elements: {
        "mass a": Mass(node: "a", mass: 1),
        "mass b": Mass(node: "b", mass: 1),
        "mass c": Mass(node: "c", mass: 0.5),
        "ground": Spring(node: "a", k2: 300),
        "ab": Spring(nodes: ("a", "b"), k1: 200),
        "bc": Spring(nodes: ("b", "c"), k1: 150),
        "dashpot": Dashpot(nodes: ("b", "c"), c: 4, exponent: 1.5),
        "contact": NLink(nodes: ("a", "b"), kn: 1000, opening: 100),
    },
    damping: Modal(ratio: 0.02),
    loads: { "push": [(node: "c", dof: Ux, force: 10)] },
    functions: { "sine": Sine(amplitude: 1, frequency: 1.1) },
    cases: { "push": Dynamic(
        duration: "2 s", dt: "0.02 s", forces: [(load: "push", function: "sine")],
        initial: [(node: "a", dof: Ux, velocity: 1)],
    ) },
    outputs: {
        "a": Displacement(node: "a", dof: Ux), "b": Displacement(node: "b", dof: Ux),
        "c": Displacement(node: "c", dof: Ux),
    },
)"#;

fn smooth(found: &mut Findings) -> Result<(), String> {
    found.text(
        "The error is the root mean square of the difference at the output times. HHT with α = 0 is \
         Newmark's average acceleration; full-newton solves the same equations with another iteration, \
         so both curves lie on each other. FNA is exact for the structure; what it approximates is the \
         force of the link, as linear in the step.",
    );
    let order = (1.9, Tolerance::AtLeast);
    let (w, z) = (std::f64::consts::TAU, 0.1_f64);
    let wd = w * (1.0 - z * z).sqrt();
    let exact = |t: f64| (-z * w * t).exp() * ((wd * t).cos() + z * w / wd * (wd * t).sin());
    let error = |r: &Trace| {
        let times = (0..=40).map(|i| 0.05 * f64::from(i));
        rms(times.map(|t| r.at("u", t) - exact(t)))
    };
    let steps = Steps { output: 0.05, halvings: 5 };
    study(found, ("Oscillator with a dashpot", OSCILLATOR), &steps, order, &error)?;

    let steps = Steps { output: 0.02, halvings: 4 };
    let reference = run_fixed(CHAIN, FNA, 16 * 32)?;
    let error = |r: &Trace| {
        let of = |name: &'static str| {
            let times = (0..=100).map(|i| 0.02 * f64::from(i));
            times.map(move |t| (name, t))
        };
        let all = || ["a", "b", "c"].into_iter().flat_map(of);
        let size = rms(all().map(|(name, t)| reference.at(name, t)));
        rms(all().map(|(name, t)| r.at(name, t) - reference.at(name, t))) / size
    };
    study(found, ("Chain with a dashpot of power 1.5", CHAIN), &steps, order, &error)
}

/// Balls in flight: events fall at different shares of a step, so that none decides the order.
const BALLS: usize = 48;

/// Distance of a ball from its contact at the start, m. The golden section spreads them evenly.
fn distance(ball: usize) -> f64 {
    0.02 + 0.016 * (0.618_033_988_75 * ball as f64).fract()
}

/// Unit masses that fly at 1 m/s against contacts; `contact` is what stands in the file for node {n}.
fn balls(contact: &str) -> String {
    let mut parts: [String; 5] = Default::default();
    let [nodes, supports, elements, initial, outputs] = &mut parts;
    for i in 0..BALLS {
        let _ = write!(nodes, r#""{i}": ({i}, 0, 0), "#);
        let _ = write!(supports, r#""{i}": (Ux, Uy, Rx, Ry, Rz), "#);
        let contact = contact.replace("{n}", &i.to_string());
        let _ = write!(elements, r#""ball {i}": Mass(node: "{i}", mass: 1), "c{i}": {contact}, "#);
        let at = distance(i);
        let _ = write!(initial, r#"(node: "{i}", dof: Uz, displacement: {at}, velocity: -1), "#);
        let _ = write!(outputs, r#""u{i}": Displacement(node: "{i}", dof: Uz), "#);
    }
    format!(
        r#"(
        nodes: {{ {nodes} }}, supports: {{ {supports} }}, elements: {{ {elements} }},
        cases: {{ "impact": Dynamic(duration: 0.1, dt: 0.005, initial: [{initial}]) }},
        outputs: {{ {outputs} }},
    )"#
    )
}

/// Position of the balls at the end against what contact time and restitution say, as share of 1 cm.
fn at_end(contact_time: f64, restitution: f64) -> impl Fn(&Trace) -> f64 {
    move |r| {
        rms((0..BALLS).map(|i| {
            let exact = restitution * (0.1 - distance(i) - contact_time);
            (r.last(&format!("u{i}")) - exact) / 0.01
        }))
    }
}

fn gap(found: &mut Findings) -> Result<(), String> {
    found.text(
        "Forty-eight balls hit elastic stops at different shares of a step. The force of a stop grows from \
         zero: it has a kink, no jump. Where in a \
         step a stop opens follows from where it closed, the same for all balls: the points scatter about \
         the slope. The error is that of the position after the impact, as root mean \
         square over the balls.",
    );
    let text = balls(r#"Gap(node: "{n}", k: 1e4)"#);
    let error = at_end(std::f64::consts::PI / 100.0, 1.0);
    let steps = Steps { output: 0.005, halvings: 6 };
    study(found, ("Elastic stop", &text), &steps, (1.9, Tolerance::AtLeast), &error)
}

fn jump(found: &mut Findings) -> Result<(), String> {
    found.text(
        "The same balls on contacts with a dashpot of 20 % of critical that may pull. On closing, and \
         on opening, the force jumps. With fixed steps no rule knows where in the step: all of them \
         fall to order one. (With adaptive steps the march brackets the event: see ST-3.)",
    );
    let text = balls(r#"NLink(node: "{n}", kn: 1e4, damping: 40, pull: true)"#);
    let z = 0.2_f64;
    let s = (1.0 - z * z).sqrt();
    let pi = std::f64::consts::PI;
    let error = at_end(pi / (100.0 * s), (-pi * z / s).exp());
    let steps = Steps { output: 0.005, halvings: 7 };
    study(found, ("Contact with a dashpot", &text), &steps, (1.0, Tolerance::Absolute(0.1)), &error)
}

/// Mass, spring, pre-slip stiffness and friction force of the sliders.
const SLIDER: (f64, f64, f64, f64) = (1.0, 1e4, 1e6, 1.0);
const SLIDERS: usize = 8;

fn start(slider: usize) -> f64 {
    8e-4 + 1e-4 * (0.618_033_988_75 * slider as f64).fract()
}

/// Masses on springs and friction contacts, let go from different distances.
fn sliders() -> String {
    let mut parts: [String; 6] = Default::default();
    let [nodes, supports, elements, press, initial, outputs] = &mut parts;
    for i in 0..SLIDERS {
        let _ = write!(nodes, r#""{i}": ({i}, 0, 0), "#);
        let _ = write!(supports, r#""{i}": (Uy, Rx, Ry, Rz), "#);
        let _ = write!(
            elements,
            r#""mass {i}": Mass(node: "{i}", mass: 1), "spring {i}": Spring(node: "{i}", k2: 1e4),
            "friction {i}": NLink(node: "{i}", kn: 1e6, ks: 1e6, mu: 0.1), "#
        );
        let _ = write!(press, r#"(node: "{i}", dof: Uz, force: -10), "#);
        let _ = write!(initial, r#"(node: "{i}", dof: Ux, displacement: {}), "#, start(i));
        let _ = write!(outputs, r#""u{i}": Displacement(node: "{i}", dof: Ux), "#);
    }
    format!(
        r#"(
        nodes: {{ {nodes} }}, supports: {{ {supports} }}, elements: {{ {elements} }},
        loads: {{ "press": [{press}] }},
        cases: {{
            "press": Static(loads: ["press"]),
            "free": Dynamic(after: "press", duration: 0.112, dt: 0.0016, initial: [{initial}]),
        }},
        outputs: {{ {outputs} }},
    )"#
    )
}

/// m ẍ + k x + τ = 0, τ = kₛ (x − a) up to ±F, in closed form from event to event. Starts at rest with
/// the friction at its limit. Returns x at rising times.
fn slider(x0: f64, times: &[f64]) -> Vec<f64> {
    let (m, k, ks, limit) = SLIDER;
    let play = limit / ks;
    let (mut t0, mut x0, mut v0, mut anchor) = (0.0, x0, 0.0_f64, x0 - play);
    let mut slip = 0.0;
    let mut found = Vec::new();
    while found.len() < times.len() {
        // x = centre + p cos ωt + q sin ωt until the end of the phase.
        let stiffness = if slip == 0.0 { k + ks } else { k };
        let pull = if slip == 0.0 { ks * anchor } else { -slip * limit };
        let (w, centre) = ((stiffness / m).sqrt(), pull / stiffness);
        let (p, q) = (x0 - centre, v0 / w);
        let size = p.hypot(q);
        let phase = q.atan2(p);
        let turn = std::f64::consts::TAU;
        let end = if slip == 0.0 {
            // First passage outwards through one of the limits.
            [1.0_f64, -1.0]
                .into_iter()
                .filter_map(|side| {
                    let c = (anchor + side * play - centre) / size;
                    // x moves outwards where its rate has the sign of the side.
                    (c.abs() <= 1.0).then(|| (phase - side * c.acos()).rem_euclid(turn))
                })
                // 0 is where the phase began.
                .map(|angle| if angle < 1e-9 { turn } else { angle } / w)
                .fold(f64::INFINITY, f64::min)
        } else {
            // Velocity −p sin + q cos is zero.
            let angle = q.atan2(p).rem_euclid(std::f64::consts::PI);
            if angle < 1e-12 { std::f64::consts::PI / w } else { angle / w }
        };
        while let Some(t) = times.get(found.len()).filter(|t| **t <= t0 + end) {
            let (s, c) = (w * (t - t0)).sin_cos();
            found.push(centre + p * c + q * s);
        }
        if !end.is_finite() {
            break;
        }
        let (s, c) = (w * end).sin_cos();
        (x0, v0, t0) = (centre + p * c + q * s, w * (q * c - p * s), t0 + end);
        if slip == 0.0 {
            slip = v0.signum();
        } else {
            anchor = x0 - slip * play;
            (slip, v0) = (0.0, 0.0);
        }
    }
    found
}

fn friction(found: &mut Findings) -> Result<(), String> {
    let times: Vec<f64> = (0..=70).map(|i| 0.0016 * f64::from(i)).collect();
    let exact: Vec<Vec<f64>> = (0..SLIDERS).map(|i| slider(start(i), &times)).collect();
    found.text(
        "Eight masses let go from different distances slide to and fro on springs. Friction begins as a \
         spring of 1 MN/m and is limited: its force has a kink where slip begins and none where it \
         ends, as the speed is zero there. So the order stays two, as long as the step resolves the \
         pre-slip period of 6.2 ms. The classical decay by 2 μN/k a half cycle bounds the closed form.",
    );
    // Without pre-slip, u turns at u₀ − 2 n μN/k; the play F/kₛ of 1 µm moves that by about itself.
    let turn = slider(start(0), &[std::f64::consts::PI / 100.0])[0];
    let rigid = (-1e3 * (start(0) - 2e-4), Kind::ClosedForm);
    let what = "first turn with pre-slip stiffness against that without";
    found.check(what, "mm", rigid, Tolerance::Absolute(3e-3), "closed form", 1e3 * turn);
    let error = |r: &Trace| {
        let of = |i: usize| {
            let (r, name) = (&r, format!("u{i}"));
            let pairs = times.iter().zip(&exact[i]);
            pairs.map(|(t, x)| r.at(&name, *t) - x).collect::<Vec<_>>()
        };
        rms((0..SLIDERS).flat_map(of)) / 8.5e-4
    };
    let steps = Steps { output: 0.0016, halvings: 6 };
    let order = (1.9, Tolerance::AtLeast);
    study(found, ("Coulomb friction", &sliders()), &steps, order, &error)
}

/// Undamped to strongly damped, slow to fast: ω (rad/s) and ζ.
const OSCILLATORS: [(f64, f64); 3] = [(3.0, 0.05), (20.0, 0.02), (300.0, 0.1)];
/// Corners of the load (s, N).
const CORNERS: [(f64, f64); 5] = [(0.0, 0.0), (0.5, 1.0), (1.0, -0.6), (2.0, 0.4), (3.0, 0.0)];

/// u of ü + 2ζωu̇ + ω²u = p(t) from rest, p through the corners.
fn ramps(w: f64, z: f64, t: f64) -> f64 {
    let wd = w * (1.0 - z * z).sqrt();
    let ramp = |t: f64| {
        if t <= 0.0 {
            return 0.0;
        }
        let (s, c) = (wd * t).sin_cos();
        let free = (-z * w * t).exp() * (2.0 * z / w * c + (2.0 * z * z - 1.0) / wd * s);
        (t - 2.0 * z / w + free) / (w * w)
    };
    let mut before = 0.0;
    let mut u = 0.0;
    for pair in CORNERS.windows(2) {
        let slope = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
        u += (slope - before) * ramp(t - pair[0].0);
        before = slope;
    }
    u
}

fn piecewise_linear(found: &mut Findings) -> Result<(), String> {
    let mut parts: [String; 5] = Default::default();
    let [nodes, supports, elements, load, outputs] = &mut parts;
    for (i, (w, z)) in OSCILLATORS.iter().enumerate() {
        let _ = write!(nodes, r#""{i}": ({i}, 0, 0), "#);
        let _ = write!(supports, r#""{i}": (Uy, Uz, Rx, Ry, Rz), "#);
        let spring = format!("Spring(node: \"{i}\", k2: {}, c2: {})", w * w, 2.0 * z * w);
        let _ = write!(elements, r#""m{i}": Mass(node: "{i}", mass: 1), "k{i}": {spring}, "#);
        let _ = write!(load, r#"(node: "{i}", dof: Ux, force: 1), "#);
        let _ = write!(outputs, r#""u{i}": Displacement(node: "{i}", dof: Ux), "#);
    }
    let points: Vec<String> = CORNERS.iter().map(|(t, p)| format!("({t}, {p})")).collect();
    let text = format!(
        r#"(
        nodes: {{ {nodes} }}, supports: {{ {supports} }}, elements: {{ {elements} }},
        loads: {{ "push": [{load}] }},
        functions: {{ "f": Points(points: [{}]) }},
        cases: {{ "push": Dynamic(
            duration: 3, dt: 0.5, forces: [(load: "push", function: "f")],
        ) }},
        outputs: {{ {outputs} }},
    )"#,
        points.join(", ")
    );
    // At the output times, every one of which is the end of a step.
    let error = |r: &Trace| {
        let one = |i: usize| {
            let (w, z) = OSCILLATORS[i];
            let size = rms((1..=6).map(|n| ramps(w, z, 0.5 * f64::from(n))));
            let name = format!("u{i}");
            let miss = |n: u32| r.at(&name, 0.5 * f64::from(n)) - ramps(w, z, 0.5 * f64::from(n));
            rms((1..=6).map(miss)) / size
        };
        largest((0..OSCILLATORS.len()).map(one))
    };
    let parts = [1, 2, 5, 10, 50, 250];
    let mut figure =
        Figure::new("Linear structure, load linear between corners", "step [s]", "error / size")
            .log_log();
    let mut worst = 0.0;
    for method in [FNA, HHT] {
        let mut points = Vec::new();
        for n in parts {
            points.push((0.5 / n as f64, error(&run_fixed(&text, method, n)?)));
        }
        if method.name == FNA.name {
            worst = largest(points.iter().map(|p| p.1));
        }
        // What is exactly zero has no place on a logarithmic axis.
        let shown = points.into_iter().map(|(x, y)| (x, y.max(1e-17)));
        figure = figure.series(method.name, Stroke::Rings, shown);
    }
    found.text(
        "Three oscillators of 0.5, 3 and 48 Hz under one load. The steps reach from 0.5 s, 24 periods of \
         the fastest, to 2 ms.",
    );
    found.figure(figure);
    let what = "largest error of FNA over all steps, share of the response";
    let reference = (1e-11, Kind::Theory);
    found.check(what, "", reference, Tolerance::AtMost, "fna", worst);
    Ok(())
}
