//! Load-dependent Ritz vectors of ten equal storeys, against eigenvectors.

use crate::unit::{NUMBER, Unit};
use crate::{Case, Check, Solver, Trace, View};
use std::fmt::Write as _;

/// Unit masses and springs in a row, shaken at the base or pushed at the top.
fn chain(basis: &str, load: &str) -> String {
    let (mut nodes, mut supports, mut elements) = (String::new(), String::new(), String::new());
    for i in 0..=10 {
        let _ = writeln!(nodes, "        \"{i}\": ({i}, 0, 0),");
        let fixed = if i == 0 { "Fixed" } else { "(Uy, Uz, Rx, Ry, Rz)" };
        let _ = writeln!(supports, "        \"{i}\": {fixed},");
        if i > 0 {
            let before = i - 1;
            let _ = writeln!(
                elements,
                "        \"mass {i}\": Mass(node: \"{i}\", mass: 1),\n        \"spring {i}\": \
                 Spring(nodes: (\"{before}\", \"{i}\"), k1: 1),"
            );
        }
    }
    format!(
        r#"(
    title: "Ten equal storeys",
    nodes: {{
{nodes}    }},
    supports: {{
{supports}    }},
    elements: {{
{elements}    }},
    loads: {{ "top": [(node: "10", dof: Ux, force: 1)] }},
    functions: {{ "pulse": Constant(1) }},
    cases: {{ "pulse": Dynamic(duration: 1, dt: 0.1, basis: {basis}, {load}) }},
)"#
    )
}

const SHAKEN: &str = "base: [(direction: X, function: \"pulse\")]";
const PUSHED: &str = "forces: [(load: \"top\", function: \"pulse\")]";
const TOLERANCE: f64 = 1e-5;

fn mass(r: &Trace) -> f64 {
    r.basis.as_ref().map_or(f64::NAN, |b| b.mass_participation.iter().map(|m| m[0]).sum())
}

fn fixed(r: &Trace) -> f64 {
    let shares = r.basis.as_ref().and_then(|b| b.static_participation.first());
    shares.map_or(f64::NAN, |(_, x)| *x)
}

/// What a basis must show; frequencies from the number given, as far as they are printed.
struct Expected {
    id: &'static str,
    title: &'static str,
    basis: &'static str,
    load: &'static str,
    first: usize,
    omega: &'static [f64],
    mass: Option<f64>,
    fixed: f64,
}

fn case(e: &Expected) -> Case {
    // Printed digits are five to six: the tolerance is absolute.
    let mut checks: Vec<Check> = e
        .omega
        .iter()
        .enumerate()
        .map(|(i, w)| {
            let i = i + e.first;
            let quantity = format!("ω{}", i + 1);
            Check::new(quantity, Unit::si("rad/s"), *w, TOLERANCE, move |r| r.omega(i)).absolute()
        })
        .collect();
    checks.extend(e.mass.map(|m| Check::new("mass captured", NUMBER, m, TOLERANCE, mass)));
    checks.push(Check::new("static response captured", NUMBER, e.fixed, TOLERANCE, fixed));
    Case {
        id: e.id,
        title: e.title,
        source: "Wilson, Yuan, Dickens 1982: the algorithm, in another program",
        text: chain(e.basis, e.load),
        set: Vec::new(),
        solvers: &[Solver::Modes],
        checks: checks.into_iter().map(Check::other_code).collect(),
        view: View::Errors,
    }
}

pub(super) fn cases() -> Vec<Case> {
    let ritz = |id, title, basis, load, first, omega, mass| Expected {
        id,
        title,
        basis,
        load,
        first,
        omega,
        mass: Some(mass),
        fixed: 1.0,
    };
    let shaken = "Ritz vectors of a shaken chain";
    let pushed = "Ritz vectors of a chain pushed at its top";
    let mut all = vec![
        ritz("FN-1b", shaken, "Ritz(vectors: 1)", SHAKEN, 0, &[0.15041][..], 0.871_041),
        ritz("FN-1c", shaken, "Ritz(vectors: 2)", SHAKEN, 0, &[0.14946, 0.47369], 0.969_162),
        ritz(
            "FN-1d",
            shaken,
            "Ritz(vectors: 3)",
            SHAKEN,
            0,
            &[0.14946, 0.44570, 0.83604],
            0.992_994,
        ),
        ritz(
            "FN-1e",
            shaken,
            "Ritz(vectors: 5)",
            SHAKEN,
            2,
            &[0.73085, 1.02222, 1.48895],
            0.999_870,
        ),
        ritz("FN-1f", pushed, "Ritz(vectors: 1)", PUSHED, 0, &[0.16116], 0.785_714),
        ritz("FN-1g", pushed, "Ritz(vectors: 2)", PUSHED, 0, &[0.14949, 0.54296], 0.898_987),
        ritz(
            "FN-1h",
            pushed,
            "Ritz(vectors: 3)",
            PUSHED,
            0,
            &[0.14946, 0.44812, 0.94589],
            0.942_544,
        ),
        ritz(
            "FN-1i",
            pushed,
            "Ritz(vectors: 5)",
            PUSHED,
            2,
            &[0.73124, 1.03950, 1.55097],
            0.978_311,
        ),
    ];
    for (id, basis, load, fixed) in [
        ("FN-1j", "Eigen(vectors: 1)", SHAKEN, 0.985_929),
        ("FN-1k", "Eigen(vectors: 2)", SHAKEN, 0.997_916),
        ("FN-1l", "Eigen(vectors: 3)", SHAKEN, 0.999_420),
        ("FN-1m", "Eigen(vectors: 5)", SHAKEN, 0.999_917),
        ("FN-1n", "Eigen(vectors: 1)", PUSHED, 0.847_925),
        ("FN-1o", "Eigen(vectors: 2)", PUSHED, 0.939_333),
        ("FN-1p", "Eigen(vectors: 3)", PUSHED, 0.970_248),
        ("FN-1q", "Eigen(vectors: 5)", PUSHED, 0.992_021),
    ] {
        let title = "Eigenvectors hold less of the static response";
        let (first, omega, mass) = (0, &[][..], None);
        all.push(Expected { id, title, basis, load, first, omega, mass, fixed });
    }
    all.iter().map(case).collect()
}
