//! Modes with links and response spectra against closed forms and against a dense solution that shares no code.

use std::f64::consts::TAU;
use std::fmt::Write;
use trilith::{Analysis, RunOptions};
use trilith_model::SolverKind;
use trilith_solvers::{
    CombineDirections, CombineModes, LinkStiffness, SolveError, SpectrumRequest, linearised,
};
use trilith_tests::{output, parse, trace};

/// A weight on a sliding pendulum.
const PENDULUM: &str = r#"(
    gravity: 9.81,
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "100 t"),
        "bearing": FrictionPendulum(node: "m", kn: "2e9 N/m", ks: "80 MN/m", radius: "1.5 m", mu: 0.06),
    },
    cases: { "gravity": Static(loads: [Gravity]) },
    outputs: {
        "travel": LinkDeformation(link: "bearing", axis: U2),
        "shear": LinkForce(link: "bearing", axis: U2),
        "base": BaseShear(direction: X),
        "travel y": LinkDeformation(link: "bearing", axis: U3),
        "away": Norm(terms: ["travel", "travel y"]),
        "rate": Velocity(node: "m", dof: Ux),
    },
)"#;

const MASS: f64 = 1e5;
const WEIGHT: f64 = MASS * 9.81;
const AMPLITUDE: f64 = 0.2;
/// Secant of the pendulum, N/m: N/R + μN/D.
const SECANT: f64 = WEIGHT / 1.5 + 0.06 * WEIGHT / AMPLITUDE;
const CYCLE: LinkStiffness = LinkStiffness::Secant { displacement: AMPLITUDE, of: None };

/// A page shows the modes that links make, which the structure has not without them.
#[test]
fn a_page_has_modes_with_engaged_links() {
    let page = |links: &str| {
        let text = format!(
            r#"(
                nodes: {{ "m": (0, 0, 0) }},
                supports: {{ "m": (Rx, Ry, Rz) }},
                elements: {{ "mass": Mass(node: "m", mass: "100 t"), {links} }},
                functions: {{ "wave": Sine(amplitude: "1 m/s^2", frequency: "1 Hz") }},
                cases: {{ "shake": Dynamic(duration: "0.1 s", dt: "10 ms", base: [(direction: X, function: "wave")]) }},
                outputs: {{ "x": Displacement(node: "m", dof: Ux) }},
            )"#
        );
        let model = parse(&text, &[]).0;
        let analysis = Analysis::new(&model).unwrap();
        let modes = analysis.run(RunOptions::default()).unwrap().report(&analysis, &[], &[]).modes;
        modes.iter().map(|m| (m.with_links, m.frequency * TAU, m.participation)).collect::<Vec<_>>()
    };
    let wen = |axis, k| {
        format!(r#""{axis}": Wen(node: "m", axis: {axis}, k: "{k}", fy: "20 kN", ratio: 0.1),"#)
    };
    let links = wen("U1", "4 GN/m") + &wen("U2", "10 MN/m") + &wen("U3", "90 MN/m");
    let modes = page(&links);
    // Of a link on the ground local 1 is +Z, local 2 is +X, local 3 is +Y.
    let expected = [(10e6, [1.0, 0.0, 0.0]), (90e6, [0.0, 1.0, 0.0]), (4e9, [0.0, 0.0, 1.0])];
    assert_eq!(modes.len(), 3, "{modes:?}");
    for ((with_links, omega, shares), (k, along)) in modes.into_iter().zip(expected) {
        assert!(with_links && (omega / f64::sqrt(k / MASS) - 1.0).abs() < 1e-9, "{omega}");
        assert!(shares.iter().zip(along).all(|(a, b)| (a - b).abs() < 1e-9), "{shares:?}");
    }
    // A dashpot is not stiff.
    let spring = r#""spring": Spring(node: "m", k1: "1 MN/m", k2: "1 MN/m", k3: "1 MN/m"),"#;
    let modes = page(&format!(r#"{spring} "dashpot": Dashpot(node: "m", c: "1 kN s/m")"#));
    assert!(!modes.is_empty() && modes.iter().all(|m| !m.0), "{modes:?}");
}

#[test]
fn a_pendulum_swings_as_its_state_says() {
    let (model, system) = parse(PENDULUM, &[]);
    let lowest = |stiffness, after| -> [f64; 3] {
        let modes = linearised(&model, &system, &stiffness, after).unwrap().modes(3).unwrap();
        [0, 1, 2].map(|j| modes.omega2[j] * MASS)
    };
    assert_eq!(lowest(LinkStiffness::Open, None), [0.0; 3]);
    let near = |found: f64, exact: f64| (found / exact - 1.0).abs() < 1e-6;
    // It sticks under its weight, and the dish pushes back.
    let stuck = lowest(LinkStiffness::Tangent, Some(0));
    assert!(near(stuck[0], 80e6 + WEIGHT / 1.5) && near(stuck[1], stuck[0]), "{stuck:?}");
    assert!(near(stuck[2], 2e9), "{stuck:?}");
    let moved = lowest(CYCLE, Some(0));
    assert!(near(moved[0], SECANT) && near(moved[1], SECANT) && near(moved[2], 2e9), "{moved:?}");

    let linear = linearised(&model, &system, &CYCLE, Some(0)).unwrap();
    let slide = AMPLITUDE - 0.06 * WEIGHT / 80e6;
    let damping = 4.0 * 0.06 * WEIGHT * slide / (TAU * SECANT * AMPLITUDE * AMPLITUDE);
    assert_eq!(linear.secants.len(), 2);
    for cycle in &linear.secants {
        assert!((cycle.damping.unwrap() / damping - 1.0).abs() < 1e-3, "{cycle:?} {damping}");
    }
    // All energy of the mode is the bearing's.
    let modes = linear.modes(2).unwrap();
    assert!((modes.damping[0] / linear.secants[0].damping.unwrap() - 1.0).abs() < 1e-9);
    assert!((modes.mass_share[0][0] + modes.mass_share[1][0] - 1.0).abs() < 1e-9);
    // Lifted off, nothing holds it.
    let (model, system) = parse(&PENDULUM.replace("[Gravity]", "[]"), &[]);
    let open = linearised(&model, &system, &CYCLE, Some(0)).unwrap();
    assert!(
        open.secants.iter().all(|s| s.stiffness == 0.0 && s.damping.is_none()),
        "{:?}",
        open.secants
    );
}

#[test]
fn a_spectrum_moves_a_single_mass_by_its_value() {
    let (model, system) = parse(PENDULUM, &[]);
    let linear = linearised(&model, &system, &CYCLE, Some(0)).unwrap();
    let modes = linear.modes(3).unwrap();
    let damping = 0.02 + linear.secants[0].damping.unwrap();
    let asked = |along, range: [f64; 2]| {
        let acceleration = |period: f64, ratio: f64| {
            let vertical = period < 0.1;
            assert!(vertical || (ratio / damping - 1.0).abs() < 1e-9, "{ratio} {damping}");
            (range[0]..range[1]).contains(&period).then_some(3.0)
        };
        let request = SpectrumRequest {
            acceleration: &acceleration,
            range,
            along,
            damping: 0.02,
            modes: CombineModes::Cqc,
            directions: CombineDirections::Srss,
        };
        linear.spectrum(&modes, &request)
    };
    let found = asked([1.0, 0.5, 0.0], [0.0, 10.0]).unwrap();
    for (name, exact) in
        [("travel", 3.0 * MASS / SECANT), ("shear", 3.0 * MASS), ("base", 3.0 * MASS)]
    {
        let peak = found[output(&model, name)].as_ref().unwrap();
        assert!((peak.along[0] / exact - 1.0).abs() < 1e-6, "{name}: {peak:?} {exact}");
        assert!(peak.along[1] < 1e-6 * exact && peak.along[2] == 0.0, "{name}: {peak:?}");
    }
    // What is no sum, and rates, have no such peak.
    assert!(["away", "rate"].iter().all(|name| found[output(&model, name)].is_none()));
    match asked([1.0, 0.0, 0.0], [0.0, 1.0]) {
        Err(SolveError::OutsideSpectrum { mode: 1 | 2, period, range: [0.0, 1.0] }) => {
            assert!((period - TAU * (MASS / SECANT).sqrt()).abs() < 1e-6);
        }
        other => panic!("{other:?}"),
    }
}

/// Numbers that look random, from 0 to 1.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// A chain of masses along X above the ground, each held to the one below by a spring, a link, or both, and some to the
/// ground: masses and stiffnesses by pairs of places, 0 is the ground.
struct Chain {
    masses: Vec<f64>,
    springs: Vec<(usize, usize, f64, bool)>,
}

impl Chain {
    fn random(draw: &mut Draw) -> Self {
        let n = 2 + (6.0 * draw.next()) as usize;
        let mut springs = Vec::new();
        for i in 1..=n {
            springs.push((i - 1, i, 10f64.powf(draw.between(5.0, 7.0)), draw.next() < 0.5));
            if draw.next() < 0.3 {
                springs.push((i / 2, i, 10f64.powf(draw.between(4.0, 7.0)), draw.next() < 0.7));
            }
        }
        Self { masses: (0..n).map(|_| draw.between(500.0, 5000.0)).collect(), springs }
    }

    fn text(&self) -> String {
        let (mut nodes, mut elements, mut outputs) = (String::new(), String::new(), String::new());
        let _ = write!(nodes, "\"0\": (0, 0, 0),");
        for (i, mass) in self.masses.iter().enumerate() {
            let i = i + 1;
            let _ = write!(nodes, "\"{i}\": (0, 0, 0),");
            let _ = write!(elements, "\"m{i}\": Mass(node: \"{i}\", mass: {mass:?}),");
            let _ = write!(outputs, "\"u{i}\": Displacement(node: \"{i}\", dof: Ux),");
            let _ =
                write!(outputs, "\"a{i}\": Acceleration(node: \"{i}\", dof: Ux, absolute: true),");
        }
        for (s, (a, b, k, is_link)) in self.springs.iter().enumerate() {
            let nodes = format!("nodes: (\"{a}\", \"{b}\")");
            let _ = match is_link {
                // Elastic up to 1 cm.
                true => write!(
                    elements,
                    "\"k{s}\": MultilinearPlastic({nodes}, axis: U2, rule: Kinematic, deformation: [-1, -0.01, 0, 0.01, 1],
                        force: [{}, {}, 0, {}, {}]),",
                    -0.02 * k, -0.01 * k, 0.01 * k, 0.02 * k
                ),
                false => write!(elements, "\"k{s}\": Spring({nodes}, k2: {k:?}),"),
            };
        }
        format!(
            "(nodes: {{ {nodes} }}, supports: {{ \"0\": Fixed, \"*\": (Uy, Uz, Rx, Ry, Rz) }}, elements: {{ {elements} }},
              outputs: {{ {outputs} \"base\": BaseShear(direction: X) }}, cases: {{ \"none\": Static(loads: []) }})"
        )
        .replace(
            "\"*\": (Uy, Uz, Rx, Ry, Rz)",
            &(1..=self.masses.len())
                .map(|i| format!("\"{i}\": (Uy, Uz, Rx, Ry, Rz)"))
                .collect::<Vec<_>>()
                .join(", "),
        )
    }

    /// ω² and mass-normalised shapes by Jacobi rotations of M^{-1/2} K M^{-1/2}.
    fn modes(&self) -> (Vec<f64>, Vec<Vec<f64>>) {
        let n = self.masses.len();
        let mut a = vec![vec![0.0; n]; n];
        for (p, q, k, _) in &self.springs {
            let ends = [(*p, -1.0), (*q, 1.0)];
            for (i, si) in ends.iter().filter(|e| e.0 > 0) {
                for (j, sj) in ends.iter().filter(|e| e.0 > 0) {
                    a[i - 1][j - 1] +=
                        k * si * sj / (self.masses[i - 1] * self.masses[j - 1]).sqrt();
                }
            }
        }
        let mut v: Vec<Vec<f64>> =
            (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
        for _ in 0..100 {
            for p in 0..n {
                for q in p + 1..n {
                    if a[p][q].abs() < 1e-300 {
                        continue;
                    }
                    let theta = 0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p]);
                    let (s, c) = theta.sin_cos();
                    for row in a.iter_mut().chain(v.iter_mut()) {
                        (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                    }
                    for j in 0..n {
                        (a[p][j], a[q][j]) = (c * a[p][j] - s * a[q][j], s * a[p][j] + c * a[q][j]);
                    }
                }
            }
        }
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|i, j| a[*i][*i].total_cmp(&a[*j][*j]));
        let shape = |j: &usize| (0..n).map(|i| v[i][*j] / self.masses[i].sqrt()).collect();
        (order.iter().map(|j| a[*j][*j]).collect(), order.iter().map(shape).collect())
    }
}

/// Pseudo-acceleration of a spectrum, m/s².
fn ground(period: f64, damping: f64) -> f64 {
    4.0 / (0.3 + period) / (1.0 + 5.0 * damping)
}

/// Peak of Σ over modes by the complete quadratic combination, written out as in \[Wilson 2002, 15.5\] for equal damping.
fn cqc(parts: &[f64], omega: &[f64], z: f64) -> f64 {
    let mut sum = 0.0;
    for (a, wa) in parts.iter().zip(omega) {
        for (b, wb) in parts.iter().zip(omega) {
            let r = wa / wb;
            let above = 8.0 * z * z * (1.0 + r) * r.powf(1.5);
            let below = (1.0 - r * r).powi(2) + 4.0 * z * z * r * (1.0 + r).powi(2);
            sum += a * b * above / below;
        }
    }
    sum.sqrt()
}

#[test]
fn random_chains_have_the_modes_and_peaks_of_a_dense_solution() {
    let mut draw = Draw(20_260);
    for round in 0..60 {
        let chain = Chain::random(&mut draw);
        let (model, system) = parse(&chain.text(), &[]);
        let stiffness = [LinkStiffness::Engaged, LinkStiffness::Tangent][round % 2].clone();
        let linear = linearised(&model, &system, &stiffness, None).unwrap();
        let n = chain.masses.len();
        let modes = linear.modes(n + 3).unwrap();
        let (omega2, shapes) = chain.modes();
        assert_eq!(modes.omega2.len(), n);
        let gamma: Vec<f64> = shapes
            .iter()
            .map(|shape| shape.iter().zip(&chain.masses).map(|(x, m)| x * m).sum())
            .collect();
        let total: f64 = chain.masses.iter().sum();
        for j in 0..n {
            let (found, exact) = (modes.omega2[j], omega2[j]);
            assert!((found - exact).abs() < 1e-8 * omega2[n - 1], "{round}: {found} {exact}");
            let share = gamma[j] * gamma[j] / total;
            assert!((modes.mass_share[j][0] - share).abs() < 1e-6, "{round}");
        }
        let z = draw.between(0.01, 0.2);
        let omega: Vec<f64> = omega2.iter().map(|w| w.sqrt()).collect();
        let combined = [CombineModes::Cqc, CombineModes::Srss][round / 2 % 2];
        let request = SpectrumRequest {
            acceleration: &|period, damping| Some(ground(period, damping)),
            range: [0.0, f64::INFINITY],
            along: [1.0, 0.0, 0.0],
            damping: z,
            modes: combined,
            directions: CombineDirections::Srss,
        };
        let found = linear.spectrum(&modes, &request).unwrap();
        let of = |value: &dyn Fn(usize) -> f64| {
            let parts: Vec<f64> = (0..n).map(|j| value(j) * gamma[j]).collect();
            match combined {
                CombineModes::Cqc => cqc(&parts, &omega, z),
                CombineModes::Srss => parts.iter().map(|x| x * x).sum::<f64>().sqrt(),
            }
        };
        let sa: Vec<f64> = omega.iter().map(|w| ground(TAU / w, z)).collect();
        let on_ground = |j: usize| -> f64 {
            let held = chain.springs.iter().filter(|s| s.0 == 0);
            held.map(|(_, i, k, _)| k * shapes[j][i - 1]).sum::<f64>() * sa[j] / omega2[j]
        };
        let mut wanted = vec![("base".to_owned(), of(&on_ground))];
        for i in 0..n {
            wanted.push((format!("u{}", i + 1), of(&|j| shapes[j][i] * sa[j] / omega2[j])));
            wanted.push((format!("a{}", i + 1), of(&|j| shapes[j][i] * sa[j])));
        }
        for (name, exact) in wanted {
            let peak = found[output(&model, &name)].as_ref().unwrap();
            assert!((peak.peak / exact - 1.0).abs() < 1e-6, "{round} {name}: {peak:?} {exact}");
        }
    }
}

/// Swings of the building on its bearings, free, have the period that its modes say.
#[test]
fn a_run_swings_with_the_period_of_its_modes() {
    let text = r#"(
        nodes: { "m": (0, 0, 0) },
        supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
        elements: {
            "mass": Mass(node: "m", mass: 1000),
            "k": MultilinearPlastic(node: "m", axis: U2, rule: Kinematic, deformation: [-1, -0.01, 0, 0.01, 1],
                force: [-300, -100, 0, 100, 300]),
        },
        damping: None,
        cases: { "swing": Dynamic(duration: 20, dt: 0.005, initial: [(node: "m", dof: Ux, displacement: "9 mm")]) },
        outputs: { "u": Displacement(node: "m", dof: Ux) },
    )"#;
    let (model, system) = parse(text, &[]);
    let linear = linearised(&model, &system, &LinkStiffness::Tangent, None).unwrap();
    let period = TAU / linear.modes(1).unwrap().omega2[0].sqrt();
    let (seen, _) = trace(&model, &system, SolverKind::Fna);
    let up = |w: &[Vec<f64>]| w[0][0] < 0.0 && w[1][0] >= 0.0;
    let crossings: Vec<f64> = seen
        .history
        .windows(2)
        .zip(&seen.time)
        .filter(|(w, _)| up(w))
        .map(|(w, t)| t + 0.005 * w[0][0] / (w[0][0] - w[1][0]))
        .collect();
    let swung = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
    assert!((swung / period - 1.0).abs() < 1e-5, "{swung} {period}");
}
