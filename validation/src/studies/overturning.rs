//! Overturning: the least pulse that overturns a rigid block, found by halving, under FNA and HHT.
//!
//! A block with slenderness α and p = √(3g/4R), R its half diagonal, under the shipped model of a body in
//! finite rotation; amplitudes in units of g α.

use super::runs::{FNA, HHT, Method};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use std::f64::consts::TAU;
use trilith::theory::half_sine_overturning;
use trilith::{Analysis, RunOptions};
use trilith_report::{Figure, Stroke};

const MODEL: &str = include_str!("../../../models/rocking_body.ron");
const G: f64 = 9.81;
const P: f64 = 2.14;

pub(super) const STUDIES: [Study; 2] = [
    Study {
        id: "RB-5",
        title: "Overturning by a half sine",
        source: "Linearised rigid block without impact: sin ψ = gα/a, (ω/p) sin ψ − cos ψ = e^(−(π−ψ)p/ω)",
        work: half_sine,
    },
    Study {
        id: "RB-6",
        title: "Overturning by one sine, with and without impact",
        source: "Zhang & Makris 2001 (block p = 2.14 rad/s, α = 0.25 rad, ω = 5 p); rigid block in finite \
                 rotation with η = 1 − 3/2 sin²α, integrated (independent code)",
        work: sine,
    },
];

/// A block and its pulse.
#[derive(Clone, Copy)]
struct Pulse {
    alpha: f64,
    /// ω/p.
    ratio: f64,
    cycles: f64,
    /// ks/kn: impacts want stiff shear, small steps want soft shear.
    shear: f64,
}

impl Pulse {
    /// Parameters of the model, for an amplitude in g α.
    fn parameters(self, amplitude: f64) -> [(&'static str, f64); 7] {
        let diagonal = 2.0 * 0.75 * G / (P * P);
        [
            ("width", diagonal * self.alpha.sin()),
            ("height", diagonal * self.alpha.cos()),
            ("mu", 20.0),
            ("ah", amplitude * self.alpha),
            ("frequency", self.ratio * P / TAU),
            ("cycles", self.cycles),
            // The pulse, and long enough for what is a thousandth off the border to part and to fall.
            ("duration", (TAU * self.cycles / self.ratio + 12.0) / P),
        ]
    }

    /// True where an amplitude (in g α) overturns the block.
    fn overturns(self, method: Method, amplitude: f64) -> Result<bool, String> {
        let mut set =
            self.parameters(amplitude).map(|(n, v)| (n.to_owned(), format!("{v:?}"))).to_vec();
        set.push(("ks".to_owned(), format!("{}*kn", self.shear)));
        let model = crate::trace::read(MODEL, "rocking_body", &set)?;
        let analysis = Analysis::new(&model).map_err(|e| e.to_string())?;
        let case = model.cases.len() - 1;
        let options = RunOptions { case, solver: Some(method.solver), ..RunOptions::default() };
        let run = analysis.run(options).map_err(|e| e.to_string())?;
        if !run.result.status.is_good() {
            return Err(format!("{}: {}", method.name, run.result.status.text()));
        }
        Ok(run.contact.is_some_and(|c| c.overturned))
    }

    /// The amplitude within 1 % of an expected one where the block begins to overturn (`rises`), or to
    /// survive again, as amplitudes grow; to an eighth of that. Not a number where there is none.
    fn border(self, method: Method, expected: f64, rises: bool) -> Result<f64, String> {
        let (mut low, mut high) = (0.99 * expected, 1.01 * expected);
        if self.overturns(method, low)? == rises || self.overturns(method, high)? != rises {
            return Ok(f64::NAN);
        }
        while high - low > 2.6e-3 * expected {
            let middle = 0.5 * (low + high);
            if self.overturns(method, middle)? == rises {
                high = middle;
            } else {
                low = middle;
            }
        }
        Ok(0.5 * (low + high))
    }
}

fn half_sine(found: &mut Findings) -> Result<(), String> {
    let alpha = 0.1;
    found.text(format!(
        "A slender block (α = {alpha} rad, p = {P} rad/s) does what the linearised theory says, up to α²/3. \
         It topples over its corner, under FNA as under direct integration: the geometry is in the link. \
         Small displacements would never let it overturn."
    ));
    let ratios = [1.0, 4.0, 10.0];
    let mut figure =
        Figure::new("Least half sine that overturns a slender block", "ω/p", "amplitude / (g α)")
            .reference(
                "theory",
                (10..=100).map(|i| (0.1 * f64::from(i), half_sine_overturning(0.1 * f64::from(i)))),
            );
    for (method, stroke) in [(FNA, Stroke::Squares), (HHT, Stroke::Crosses)] {
        let mut points = Vec::new();
        for ratio in ratios {
            let expected = half_sine_overturning(ratio);
            let border =
                Pulse { alpha, ratio, cycles: 0.5, shear: 2.0 }.border(method, expected, true)?;
            points.push((ratio, border));
            found.check(
                format!("a/(gα) at ω/p = {ratio}"),
                "",
                (expected, Kind::ClosedForm),
                Tolerance::Relative(1e-2),
                method.name,
                border,
            );
        }
        figure = figure.series(method.name, stroke, points);
    }
    found.figure(figure);
    Ok(())
}

fn sine(found: &mut Findings) -> Result<(), String> {
    let pulse = Pulse { alpha: 0.25, ratio: 5.0, cycles: 1.0, shear: 30.0 };
    found.text(
        "As the amplitude grows, the block overturns after one impact, survives again, and overturns \
         without impact. Impacts are those of the contacts: nothing in the model knows η.",
    );
    let borders = [
        ("overturns after one impact from", 2.9448, true),
        ("survives again from", 6.8265, false),
        ("overturns without impact from", 7.4930, true),
    ];
    for method in [FNA, HHT] {
        for (what, expected, rises) in borders {
            found.check(
                format!("a/(gα): {what}"),
                "",
                (expected, Kind::OtherCode),
                Tolerance::Relative(1e-2),
                method.name,
                pulse.border(method, expected, rises)?,
            );
        }
    }
    let shown = [
        (2.7, "2.7: survives"),
        (4.0, "4: overturns"),
        (7.2, "7.2: survives"),
        (8.0, "8: overturns"),
    ];
    let mut figure =
        Figure::new("One sine of ω = 5 p on a block of α = 0.25", "time [s]", "rotation / α");
    for (amplitude, name) in shown {
        figure = figure.series(name, Stroke::Line, history(pulse, amplitude)?);
    }
    found.figure(figure);
    Ok(())
}

/// (time, rotation/α) of a run under FNA, up to the fall.
fn history(pulse: Pulse, amplitude: f64) -> Result<Vec<(f64, f64)>, String> {
    let parameters = pulse.parameters(amplitude);
    let set = parameters.each_ref().map(|(n, v)| (*n, v as &dyn ToString));
    let trace = super::runs::run(MODEL, &set, FNA, |_| {})?;
    let all = trace.history("rotation").into_iter().map(|(t, y)| (t, y / pulse.alpha));
    Ok(all.take_while(|(_, y)| y.abs() < 3.0).collect())
}
