//! Dampers that hold a spring in series: the cases of dashpots behind springs without a node between.

use crate::case::BOTH;
use crate::unit::{INCH, JOULE, NEWTON};
use crate::{Case, Check, Curve, View};
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

/// Elements between the ground and supports that are moved as `motions` say: name, element, function.
fn moved(
    title: &str,
    elements: &[(&str, String, &str)],
    functions: &str,
    [time, dt]: [&str; 2],
) -> String {
    let [mut nodes, mut supports, mut links, mut motions, mut outputs] =
        [const { String::new() }; 5];
    for (name, element, function) in elements {
        let _ = write!(nodes, "\"{name}\": (0, 0, 0), ");
        let _ = write!(supports, "\"{name}\": Fixed, ");
        let _ = writeln!(links, "        \"{name}\": {element},");
        let _ = writeln!(
            motions,
            "                (node: \"{name}\", dof: Ux, displacement: \"{function}\"),"
        );
        let _ = writeln!(outputs, "        \"{name}\": LinkForce(link: \"{name}\", axis: U2),");
    }
    format!(
        r#"(
    title: "{title}",
    nodes: {{ {nodes}"m": (1, 0, 0) }},
    supports: {{ {supports}"m": (Uy, Uz, Rx, Ry, Rz) }},
    elements: {{
{links}        // an oscillator at rest beside them: a dynamic case needs a mass
        "mass": Mass(node: "m", mass: "1 kg"),
        "spring": Spring(node: "m", k2: "1 N/m"),
    }},
    functions: {{ {functions} }},
    cases: {{
        "motion": Dynamic(
            duration: "{time}", dt: "{dt}",
            supports: [
{motions}            ],
        ),
    }},
    outputs: {{
{outputs}    }},
)"#
    )
}

fn case(id: &'static str, title: &'static str, source: &'static str, text: String) -> Case {
    let (set, checks, view) = (Vec::new(), Vec::new(), View::Errors);
    Case { id, title, source, text, set, solvers: BOTH, checks, view }
}

pub(super) fn cases() -> Vec<Case> {
    vec![dp1(), dp3(), dp5(), dp6(), bilinear(), loss_factor(), ring()]
}

fn dp1() -> Case {
    let points: String = (0..=250)
        .map(|i| {
            let t = 0.004 * f64::from(i);
            format!("({t:.3}, {:.17}), ", 0.1 * (10.0 * PI * t).sin())
        })
        .collect();
    // K₁ u(t) acts as a force on the node that K₁ and K₂ hold: the same equations.
    let text = format!(
        r#"(
    title: "Generalised Zener model under imposed motion",
    nodes: {{ "a": (0, 0, 0), "wall": (2, 0, 0), "m": (3, 0, 0) }},
    supports: {{
        "a": (Uy, Uz, Rx, Ry, Rz), "wall": Fixed, "m": (Uy, Uz, Rx, Ry, Rz),
    }},
    elements: {{
        "K1 + K2": Spring(nodes: ("a", "wall"), k1: "130 N/m"),
        "damper": MaxwellDamper(node: "a", axis: U2, k: "60 N/m", c: 1.7, exponent: 0.8),
        // a dynamic case needs a mass: an oscillator at rest
        "mass": Mass(node: "m", mass: "1 kg"),
        "spring": Spring(node: "m", k2: "1 N/m"),
    }},
    loads: {{ "K1": [(node: "a", dof: Ux, force: "120 N")] }},
    functions: {{ "motion": Points(points: [{points}]) }},
    cases: {{
        "motion": Dynamic(
            duration: "1 s", dt: "1 ms", forces: [(load: "K1", function: "motion")],
        ),
    }},
    outputs: {{
        "K2": Displacement(terms: [(node: "a", dof: Ux, factor: "10 N/m")]),
        "damper": LinkForce(link: "damper", axis: U2),
    }},
)"#
    );
    let values = [
        (0.02, 2.187_710_58),
        (0.06, 2.035_749_59),
        (0.10, -1.851_221_55),
        (0.132, -3.445_042_94),
        (0.316, -2.962_435_65),
        (1.0, 1.750_844_98),
    ];
    let check = |(t, f): (f64, f64)| {
        let measure = move |r: &crate::Trace| r.at("K2", t) + r.at("damper", t);
        Check::new(format!("force({t})"), NEWTON, f, 1e-4, measure).published()
    };
    Case {
        checks: values.map(check).into(),
        view: View::histories([Curve::new("damper", NEWTON)]),
        ..case("DP-1b", "Generalised Zener model with a Maxwell damper", "Code_Aster SSND101", text)
    }
}

fn dp3() -> Case {
    // λ(α) = 4·2^α Γ(1 + α/2)²/Γ(2 + α).
    let lambda = [
        ("a 0.1", 0.1, 3.882_445),
        ("a 0.35", 0.35, 3.627_472),
        ("a 0.5", 0.5, 3.496_077),
        ("a 1", 1.0, PI),
        ("a 1.5", 1.5, 2.875_537),
        ("a 2", 2.0, 2.666_667),
    ];
    let elements = lambda.map(|(name, a, _)| {
        let law =
            format!("MaxwellDamper(node: \"{name}\", axis: U2, k: 1e9, c: 1000, exponent: {a})");
        (name, law, "motion")
    });
    let motion = "\"motion\": Sine(amplitude: \"0.1 m\", frequency: \"2 Hz\")";
    let text =
        moved("Stiff Maxwell dampers through one cycle", &elements, motion, ["0.5 s", "0.5 ms"]);
    let checks = lambda.map(|(name, a, lambda)| {
        let energy = lambda * 1000.0 * 0.1_f64.powf(1.0 + a) * (2.0 * TAU).powf(a);
        Check::new(format!("energy, α = {a}"), JOULE, energy, 1e-3, move |r| r.heat(name))
    });
    Case {
        checks: checks.into(),
        view: View::histories(lambda.map(|(name, ..)| Curve::new(name, NEWTON))),
        ..case(
            "DP-3b",
            "Energy of a cycle of power-law dashpots behind stiff springs",
            "Power-law dashpot led through u = X sin ωt: E = λ C X^(1+α) ω^α",
            text,
        )
    }
}

fn dp5() -> Case {
    let (k, tau): (f64, f64) = (100.0, 5.0 / 100.0);
    let motions = [("slow", 5.0), ("middle", 20.0), ("fast", 50.0)];
    let law = |name| format!("MaxwellDamper(node: \"{name}\", axis: U2, k: 100, c: 5)");
    let elements = motions.map(|(name, _)| (name, law(name), name));
    let functions: String = motions
        .iter()
        .map(|(name, w)| {
            format!(
                "\"{name}\": Sine(amplitude: \"1 m\", frequency: \"{w}/(2*3.141592653589793)\"), "
            )
        })
        .collect();
    let text =
        moved("Maxwell dampers under harmonic motion", &elements, &functions, ["2.6 s", "1 ms"]);
    let (mut checks, mut curves) = (Vec::new(), Vec::new());
    for (output, w) in motions {
        let x = (w * tau) * (w * tau);
        let (storage, loss) = (k * x / (1.0 + x), k * w * tau / (1.0 + x));
        // The transient e^(−t/τ) has gone by e^(−25) here.
        let whole = (1.25_f64 * w / TAU).ceil() * TAU / w;
        let quarter = whole + 0.25 * TAU / w;
        let name = format!("storage modulus, ω = {w}");
        checks.push(Check::new(name, NEWTON, storage, 1e-3, move |r| r.at(output, quarter)));
        let name = format!("loss modulus, ω = {w}");
        checks.push(Check::new(name, NEWTON, loss, 1e-3, move |r| r.at(output, whole)));
        curves.push(
            Curve::new(output, NEWTON).against(move |t| {
                storage * (w * t).sin() + loss * ((w * t).cos() - (-t / tau).exp())
            }),
        );
    }
    Case {
        checks,
        view: View::histories(curves),
        ..case(
            "DP-5b",
            "Maxwell dampers under harmonic motion",
            "K' = K (ωτ)²/(1 + (ωτ)²), K'' = K ωτ/(1 + (ωτ)²), τ = C/K",
            text,
        )
    }
}

fn dp6() -> Case {
    let text = r#"(
    title: "Damper with a series spring at resonance",
    units: (length: "in", force: "kip", time: "s"),
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 1),
        "spring": Spring(node: "m", k2: 100),
        "damper": MaxwellDamper(node: "m", axis: U2, k: 1e4, c: 1),
    },
    loads: { "push": [(node: "m", dof: Ux, force: 10)] },
    functions: { "sine": Sine(amplitude: 1, frequency: "10/(2*3.141592653589793)") },
    cases: {
        "shaking": Dynamic(
            duration: 15, dt: 0.01, step: Adaptive(tolerance: 1e-6),
            forces: [(load: "push", function: "sine")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;
    // The published problem is a dashpot without the spring; 1 % allows for it.
    let values = [
        (0.5, -0.104_876),
        (1.0, 0.309_863),
        (2.0, -0.232_983),
        (5.0, -0.888_582),
        (10.0, -0.857_185),
    ];
    Case {
        checks: values.map(|(t, u)| Check::at("u", INCH, t, u, 1e-2)).into(),
        view: View::histories([Curve::new("u", INCH)]),
        ..case(
            "DP-6b",
            "Damper link with a series stiffness at resonance",
            "CSI Software Verification 6-005; Chopra",
            text.to_owned(),
        )
    }
}

fn bilinear() -> Case {
    let (k, c, cy, fl, v) = (2e7, 1e6, 1e5, 1e5, 0.3);
    let element = (
        "damper",
        "BilinearDamper(node: \"damper\", axis: U2, k: 2e7, c: 1e6, cy: 1e5, fl: 1e5)".to_owned(),
        "pull",
    );
    let motion = "\"pull\": Points(points: [(0, 0), (1, 0.3)], interpolation: Cubic)";
    let text = moved("Bilinear damper at constant speed", &[element], motion, ["50 ms", "0.1 ms"]);
    let opens = -c / k * (1.0_f64 - fl / (c * v)).ln();
    let exact = move |t: f64| {
        let last = fl + cy * (v - fl / c);
        if t < opens {
            c * v * (1.0 - (-t * k / c).exp())
        } else {
            last + (fl - last) * (-(t - opens) * k / cy).exp()
        }
    };
    Case {
        checks: [0.01, 0.022, 0.025, 0.03, 0.05]
            .map(|t| Check::at("damper", NEWTON, t, exact(t), 1e-4))
            .into(),
        view: View::histories([Curve::new("damper", NEWTON).against(exact)]),
        ..case(
            "DP-9",
            "Bilinear damper behind its spring at constant speed",
            "One exponential after the other: time constants c/k, and c_y/k from f = f_l on",
            text,
        )
    }
}

fn loss_factor() -> Case {
    let (k, eta, x): (f64, f64, f64) = (5e6, 0.4, 0.01);
    let bands = [("0.2 Hz", 0.2, 36.25), ("1 Hz", 1.0, 39.25), ("5 Hz", 5.0, 39.05)];
    let law = |name| {
        format!(
            "FrequencyIndependentViscoelastic(node: \"{name}\", axis: U2, k: 5e6, loss_factor: 0.4, \
             f_min: \"0.2 Hz\", f_max: \"5 Hz\")"
        )
    };
    let elements = bands.map(|(name, ..)| (name, law(name), name));
    let functions: String = bands
        .iter()
        .map(|(name, f, _)| {
            format!("\"{name}\": Sine(amplitude: \"10 mm\", frequency: \"{f} Hz\"), ")
        })
        .collect();
    let text = moved("Viscoelastic dampers in a band", &elements, &functions, ["40 s", "2 ms"]);
    let beta = 2.0 / PI * eta.atan();
    let mut checks = Vec::new();
    // Late peaks of the motion; at 40 s all of them pass zero, rising. The fit is within 0.2 %, and of
    // the slowest branches 1 % of a small start is left.
    for (name, f, peak) in bands {
        let (storage, zero) = (k * f64::powf(f, beta), 40.0);
        checks.push(Check::new(format!("K' at {name}"), NEWTON, storage * x, 5e-3, move |r| {
            r.at(name, peak)
        }));
        checks.push(Check::new(
            format!("K'' at {name}"),
            NEWTON,
            eta * storage * x,
            5e-3,
            move |r| r.at(name, zero),
        ));
    }
    Case {
        checks,
        view: View::histories(bands.map(|(name, ..)| Curve::new(name, NEWTON).over(35.0, 40.0))),
        ..case(
            "DP-10",
            "Viscoelastic damper with a constant loss factor",
            "Springpot: K' = k (f/f₀)^β, K'' = η K', β = (2/π) atan η",
            text,
        )
    }
}

fn ring() -> Case {
    let (k, k1, k2, u0, x): (f64, f64, f64, f64, f64) = (5e7, 6e6, 2e6, 0.005, 0.04);
    let element = (
        "ring",
        "FrictionSpring(node: \"ring\", axis: U2, k: 5e7, k1: 6e6, k2: 2e6, u0: 0.005)".to_owned(),
        "motion",
    );
    let motion = "\"motion\": Sine(amplitude: \"40 mm\", frequency: \"1 Hz\")";
    let text = moved("Ring spring through two cycles", &[element], motion, ["2 s", "1 ms"]);
    // Corners of the flag: start of slip, top, end of the drop, end of unloading slip.
    let drop = (k * x - k1 * (x + u0) + k2 * u0) / (k - k2);
    let (a, b) = (k1 * u0 / (k - k1), k2 * u0 / (k - k2));
    let flag = [(a, k * a), (x, k1 * (x + u0)), (drop, k2 * (drop + u0)), (b, k * b)];
    let area: f64 = (0..4)
        .map(|i| {
            let ((x0, y0), (x1, y1)) = (flag[i], flag[(i + 1) % 4]);
            0.5 * (x1 * y0 - x0 * y1)
        })
        .sum();
    Case {
        checks: vec![
            Check::new("energy of two cycles", JOULE, 4.0 * area, 1e-3, |r| r.heat("ring")),
            Check::new("largest force", NEWTON, k1 * (x + u0), 1e-6, |r| r.peak("ring", 0.0, 2.0)),
            Check::new("force at u = 20 mm, let go", NEWTON, k2 * (0.02 + u0), 1e-3, |r| {
                r.at("ring", 5.0 / 12.0)
            }),
            Check::new("force at the end", NEWTON, 0.0, 1.0, |r| r.last("ring")).absolute(),
        ],
        view: View::histories([Curve::new("ring", NEWTON)]),
        ..case("FS-1", "Ring spring through its flag", "Area and corners of the flag", text)
    }
}
