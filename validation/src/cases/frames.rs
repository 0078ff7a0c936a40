//! Base-isolated frames in space beside OpenSees.

use crate::unit::METRE;
use crate::{Case, Check, Curve, Solver, Trace, View};
use trilith::generate::Frame;

const SOURCE: &str = "OpenSeesPy 3.7.1: elasticBeamColumn, Bidirectional sections, Viscous dampers, Rayleigh \
                      damping, Newmark average acceleration, dt 5 ms";

/// What OpenSees found: largest displacement of an isolator in the plane, along X and along Y; largest
/// displacement of the roof against the base along X and along Y, m.
struct Peaks {
    isolators: usize,
    values: [f64; 5],
}

const P1E2: Peaks = Peaks {
    isolators: 4,
    values: [
        0.185_296_844_132_982_59,
        0.149_006_506_030_936_6,
        0.117_599_175_920_098_22,
        0.009_501_030_953_279_033,
        0.007_219_474_769_942_696,
    ],
};
const P1E3: Peaks = Peaks {
    isolators: 30,
    values: [
        0.170_595_285_092_761_3,
        0.147_606_651_167_698_06,
        0.104_184_713_913_347_08,
        0.027_018_571_127_468_09,
        0.022_670_386_160_267_34,
    ],
};
/// With modified Newton iterations: seven digits.
const P1E4S: Peaks = Peaks {
    isolators: 30,
    values: [
        0.170_918_540_157_334,
        0.146_804_390_052_724_97,
        0.105_390_694_511_122_96,
        0.026_156_962_423_013_318,
        0.022_861_650_077_076_176,
    ],
};

/// Largest of the vectors with components of these outputs, over all outputs and times.
fn largest(trace: &Trace, outputs: &[Vec<String>]) -> f64 {
    let mut most = 0.0_f64;
    for names in outputs {
        let components: Vec<_> = names.iter().map(|n| trace.history(n)).collect();
        for i in 0..components[0].len() {
            let square: f64 = components.iter().map(|c| c[i].1 * c[i].1).sum();
            most = most.max(square.sqrt());
        }
    }
    most
}

fn case(
    (id, title): (&'static str, &'static str),
    preset: &str,
    solvers: &'static [Solver],
    peaks: &Peaks,
    [isolators, roof]: [f64; 2],
) -> Case {
    let of = |axes: &[&str]| -> Vec<Vec<String>> {
        let one = |n: usize| axes.iter().map(|axis| format!("iso {n} {axis}")).collect();
        (0..peaks.isolators).map(one).collect()
    };
    let drift = |axis: &str| vec![vec![format!("roof_{axis}")]];
    let measured = [
        ("isolator, in the plane", of(&["x", "y"]), isolators),
        // A component is not at its own peak where sliding turns: small differences show twice as large.
        ("isolator, along X", of(&["x"]), 2.0 * isolators),
        ("isolator, along Y", of(&["y"]), 2.0 * isolators),
        ("roof against base, along X", drift("x"), roof),
        ("roof against base, along Y", drift("y"), roof),
    ];
    let checks = measured.into_iter().zip(peaks.values).map(|((name, outputs, p), reference)| {
        Check::new(format!("largest {name}"), METRE, reference, p, move |r| largest(r, &outputs))
            .other_code()
    });
    Case {
        id,
        title,
        source: SOURCE,
        text: Frame::preset(preset).map(text).unwrap_or_default(),
        set: Vec::new(),
        solvers,
        checks: checks.collect(),
        view: View::histories([Curve::new("iso 0 x", METRE), Curve::new("roof_x", METRE)]),
    }
}

/// With the tolerance of the program for the links: equal to nine digits is more than a preset asks for.
fn text(preset: Frame) -> String {
    Frame { link_tolerance: None, ..preset }.to_ron()
}

/// Direct integration is the same equations: equal to the digits of the other iteration. FNA works with
/// another basis and another rule in time.
pub(super) fn cases() -> Vec<Case> {
    let (hht, fna): (&[Solver], &[Solver]) = (&[Solver::Hht], &[Solver::Fna]);
    let (same, near) = ([1e-9; 2], [1e-3, 1e-2]);
    vec![
        case(("FR-1", "Isolated frame of 96 equations, Newmark"), "P1e2", hht, &P1E2, same),
        case(("FR-2", "Isolated frame of 96 equations, FNA"), "P1e2", fna, &P1E2, near),
        case(("FR-3", "Isolated frame of 1 080 equations, Newmark"), "P1e3", hht, &P1E3, same),
        case(("FR-4", "Isolated frame of 1 080 equations, FNA"), "P1e3", fna, &P1E3, near),
        case(("FR-5", "Isolated frame of 9 072 equations, FNA"), "P1e4s", fna, &P1E4S, near),
    ]
}
