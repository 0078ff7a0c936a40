//! A frame given by its matrices is the frame: the matrices are assembled here from the textbook's, densely.

use trilith_model::SolverKind;
use trilith_solvers::{Observer, RunOptions, Sample, modes, run};
use trilith_system::{RIGID, System};
use trilith_tests::{parse, trace};

const YOUNG: f64 = 210e9;
const AREA: f64 = 0.012;
const INERTIA: f64 = 9e-5;
const DENSITY: f64 = 25_000.0;

/// Places of the nodes of the frame in the plane XZ; two columns with a joint at mid-height, a beam with one in its middle.
const NODES: [(&str, f64, f64); 7] = [
    ("a0", 0.0, 0.0),
    ("a1", 0.0, 2.0),
    ("a2", 0.0, 4.0),
    ("c", 2.5, 4.0),
    ("b2", 5.0, 4.0),
    ("b1", 5.0, 2.0),
    ("b0", 5.0, 0.0),
];

type Matrix = Vec<Vec<f64>>;

/// K and M of the frame, rows Ux, Uz and Ry of node after node. Euler–Bernoulli, consistent mass
/// [Cook et al. 2002, eqs. 2.3-5, 11.3-5].
fn frame() -> [Matrix; 2] {
    let n = 3 * NODES.len();
    let mut all = [vec![vec![0.0; n]; n], vec![vec![0.0; n]; n]];
    for (i, j) in (0..NODES.len() - 1).map(|i| (i, i + 1)) {
        let (dx, dz) = (NODES[j].1 - NODES[i].1, NODES[j].2 - NODES[i].2);
        let l = dx.hypot(dz);
        let (c, s) = (dx / l, dz / l);
        let (ea, ei) = (YOUNG * AREA / l, YOUNG * INERTIA / l.powi(3));
        let k = [
            [ea, 0.0, 0.0, -ea, 0.0, 0.0],
            [0.0, 12.0 * ei, 6.0 * ei * l, 0.0, -12.0 * ei, 6.0 * ei * l],
            [0.0, 6.0 * ei * l, 4.0 * ei * l * l, 0.0, -6.0 * ei * l, 2.0 * ei * l * l],
            [-ea, 0.0, 0.0, ea, 0.0, 0.0],
            [0.0, -12.0 * ei, -6.0 * ei * l, 0.0, 12.0 * ei, -6.0 * ei * l],
            [0.0, 6.0 * ei * l, 2.0 * ei * l * l, 0.0, -6.0 * ei * l, 4.0 * ei * l * l],
        ];
        let m0 = DENSITY * AREA * l / 420.0;
        let m = [
            [140.0, 0.0, 0.0, 70.0, 0.0, 0.0],
            [0.0, 156.0, 22.0 * l, 0.0, 54.0, -13.0 * l],
            [0.0, 22.0 * l, 4.0 * l * l, 0.0, 13.0 * l, -3.0 * l * l],
            [70.0, 0.0, 0.0, 140.0, 0.0, 0.0],
            [0.0, 54.0, 13.0 * l, 0.0, 156.0, -22.0 * l],
            [0.0, -13.0 * l, -3.0 * l * l, 0.0, -22.0 * l, 4.0 * l * l],
        ]
        .map(|row| row.map(|x| m0 * x));
        // Along, across (Z for a beam along X), and a turn from X to Z, which is −Ry.
        let turn = [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, -1.0]];
        let part = |a: usize, b: usize| if a / 3 == b / 3 { turn[a % 3][b % 3] } else { 0.0 };
        let at = |a: usize| if a < 3 { 3 * i + a } else { 3 * j + a - 3 };
        for (sum, own) in all.iter_mut().zip([k, m]) {
            for a in 0..6 {
                for b in 0..6 {
                    for p in 0..6 {
                        for q in 0..6 {
                            sum[at(a)][at(b)] += part(p, a) * own[p][q] * part(q, b);
                        }
                    }
                }
            }
        }
    }
    all
}

/// As a Matrix Market text that holds all entries.
fn market(a: &Matrix) -> String {
    let mut lines = Vec::new();
    for (i, row) in a.iter().enumerate() {
        let own = row.iter().enumerate().filter(|(_, x)| **x != 0.0);
        lines.extend(own.map(|(j, x)| format!("{} {} {x:e}", i + 1, j + 1)));
    }
    let n = a.len();
    format!(
        "%%MatrixMarket matrix coordinate real general\n{n} {n} {}\n{}\n",
        lines.len(),
        lines.join("\n")
    )
}

/// Compares what pictures show with outputs: the first three are displacements of a node along X, Y and Z.
struct Shown {
    node: usize,
    all: Vec<f64>,
    largest: f64,
}

impl Observer for Shown {
    fn sample(&mut self, sample: &Sample<'_>) {
        sample.shape.displacements(&[sample.shape.pose()], &mut self.all);
        for (direction, value) in sample.values[..3].iter().enumerate() {
            let shown = self.all[6 * self.node + direction];
            assert!((shown - value).abs() < 1e-12, "{direction}: {shown} and {value}");
            self.largest = self.largest.max(value.abs());
        }
    }
}

/// A rod of forty rows, of which two are tied to nodes: pictures of it look at few of its equations.
#[test]
fn pictures_show_nodes_where_outputs_say_they_are() {
    let n = 40;
    let mut k = vec![vec![0.0; n]; n];
    for i in 0..n - 1 {
        (k[i][i], k[i + 1][i + 1]) = (k[i][i] + 4e8, k[i + 1][i + 1] + 4e8);
        (k[i][i + 1], k[i + 1][i]) = (-4e8, -4e8);
    }
    let mut m = vec![vec![0.0; n]; n];
    (0..n).for_each(|i| m[i][i] = 250.0);
    let text = format!(
        r#"(
        nodes: {{ "root": (0, 0, 0), "tip": (0, 0, 8) }},
        supports: {{ "root": Fixed, "tip": [Ux, Ry, Rx, Rz] }},
        elements: {{
            "rod": Superelement(nodes: {{ "a": "root", "b": "tip" }}, stiffness: Contents("k.mtx", "{}"),
                mass: Contents("m.mtx", "{}"), rows: Contents("rows.csv", "row,node,dof
1,a,Uz
{n},b,Uz
")),
            "beside": Spring(node: "tip", k2: "90 kN/m"),
            "head": Mass(node: "tip", mass: "300 kg"),
            "stop": Gap(node: "tip", k: "50 MN/m", opening: "0.1 mm"),
        }},
        functions: {{ "sine": Sine(amplitude: "0.5 g", frequency: "8 Hz", cycles: 3) }},
        cases: {{ "shaken": Dynamic(duration: 0.4, dt: 0.002,
            base: [(direction: Z, function: "sine"), (direction: Y, function: "sine")]) }},
        outputs: {{
            "x": Displacement(node: "tip", dof: Ux), "y": Displacement(node: "tip", dof: Uy),
            "z": Displacement(node: "tip", dof: Uz),
        }},
    )"#,
        market(&k),
        market(&m)
    );
    let (model, system) = parse(&text, &[]);
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let mut shown = Shown { node: 1, all: vec![0.0; 6 * model.nodes.len()], largest: 0.0 };
        let options = RunOptions { solver: Some(solver), ..RunOptions::default() };
        run(&model, &system, options, &mut [&mut shown]).unwrap();
        assert!(shown.largest > 1e-4, "{}", shown.largest);
    }
}

/// Rows that the table lists: those of the tied nodes, of `a1`, and Ux of `c`. Of the rest nothing is told.
fn table() -> String {
    let mut text = String::from("row,node,dof\n");
    for (i, (name, ..)) in NODES.iter().enumerate() {
        for (k, dof) in ["Ux", "Uz", "Ry"].iter().enumerate() {
            if ["a0", "b0", "a2", "a1"].contains(name) || (*name, *dof) == ("c", "Ux") {
                text += &format!("{},mesh {name},{dof}\n", 3 * i + k + 1);
            }
        }
    }
    text
}

/// What stands around the frame: a friction contact at its top, a mast to pound against, ground motion, weight.
fn around(frame: &str, others: &[usize], damping: &str) -> String {
    let names = NODES.iter().enumerate().filter(|(i, _)| others.contains(i));
    let nodes: Vec<String> =
        names.map(|(_, (n, x, z))| format!("\"{n}\": ({x:?}, 0, {z:?})")).collect();
    format!(
        r#"(
        plane: XZ,
        nodes: {{ {}, "foot": (-0.5, 0, 0), "mast": (-0.5, 0, 4) }},
        supports: {{ "a0": Fixed, "b0": Fixed, "foot": Fixed }},
        elements: {{
            {frame}
            "mast": Beam(nodes: ("foot", "mast"), young: "30 GPa", area: 0.04, i2: 1e-4, i3: 1e-4),
            "head": Mass(node: "mast", mass: "2 t"),
            "gap": Gap(nodes: ("mast", "a2"), k: "40 MN/m", opening: "4 mm"),
            "damper": Dashpot(nodes: ("mast", "a2"), c: "20 kN*s/m"),
        }},
        damping: {damping},
        functions: {{ "sine": Sine(amplitude: "0.4 g", frequency: "3 Hz", cycles: 3) }},
        loads: {{ "push": [(node: "a2", dof: Ux, force: "30 kN")] }},
        cases: {{
            "weight": Static(loads: [Gravity, (load: "push")]),
            "shaken": Dynamic(after: "weight", duration: 1.2, dt: 0.005,
                base: [(direction: X, function: "sine")]),
        }},
        outputs: {{
            "top": Displacement(node: "a2", dof: Ux), "sag": Displacement(node: "a2", dof: Uz),
            "turn": Displacement(node: "a2", dof: Ry),
            "acceleration": Acceleration(node: "a2", dof: Ux, absolute: true),
            "pounding": LinkForce(link: "gap", axis: U1),
            "foot": Reaction(node: "b0", dof: Ux), "bent": Reaction(node: "b0", dof: Ry),
            "pressed": Reaction(node: "b0", dof: Uz),
            // of all
            "shear": BaseShear(direction: X), "overturning": Overturning(direction: X, about: (0, 0, 0)),
        }},
    )"#,
        nodes.join(", ")
    )
}

fn of_beams(damping: &str) -> String {
    let beams: Vec<String> = NODES
        .windows(2)
        .map(|two| {
            let [(i, ..), (j, ..)] = [two[0], two[1]];
            format!(
                "\"{i} {j}\": Beam(nodes: (\"{i}\", \"{j}\"), young: {YOUNG:e}, area: {AREA:e}, i2: {INERTIA:e}, i3: {INERTIA:e}, density: {DENSITY:e}, mass_matrix: Consistent),"
            )
        })
        .collect();
    around(&beams.join("\n"), &[0, 1, 2, 3, 4, 5, 6], damping)
}

fn of_matrices(k: &Matrix, m: &Matrix, more: &str, damping: &str) -> String {
    let frame = format!(
        "\"frame\": Superelement(nodes: {{ \"mesh a0\": \"a0\", \"mesh b0\": \"b0\", \"mesh a2\": \"a2\" }}, stiffness: Contents(\"k.mtx\", \"{}\"), mass: Contents(\"m.mtx\", \"{}\"), rows: Contents(\"rows.csv\", \"{}\"), {more}),",
        market(k),
        market(m),
        table()
    );
    around(&frame, &[0, 2, 6], damping)
}

fn assert_near(what: &str, a: f64, b: f64, tolerance: f64, scale: f64) {
    assert!((a - b).abs() <= tolerance * scale, "{what}: {a:e} and {b:e}");
}

#[test]
fn a_frame_of_matrices_has_the_modes_of_the_frame() {
    let [k, m] = frame();
    let (beams, own) = parse(&of_beams("None"), &[]);
    let (whole, system) = parse(&of_matrices(&k, &m, "", "None"), &[]);
    assert_eq!((own.order(), system.order()), (18, 18));
    assert_eq!(system.inner.doubts, Vec::<String>::new());
    let [a, b] = [(&beams, &own), (&whole, &system)].map(|(m, s)| modes(m, s, None).unwrap());
    assert_eq!(a.omega.len(), b.omega.len());
    assert!(a.omega.len() > 12, "{}", a.omega.len());
    for (x, y) in a.omega.iter().zip(&b.omega) {
        assert_near("frequency", *x, *y, 1e-10, *x);
    }
    for (x, y) in a.mass_participation.iter().flatten().zip(b.mass_participation.iter().flatten()) {
        assert_near("participation", *x, *y, 1e-8, 1.0);
    }
    // How much moves, and where it is.
    let [a, b] = [own.mass_sum(&beams), system.mass_sum(&whole)];
    for i in 0..3 {
        assert_near("mass", a.mass[i], b.mass[i], if i == 1 { 1.0 } else { 1e-12 }, 1e4);
        assert_near("centre", a.centre[i], b.centre[i], 1e-9, 5.0);
    }
    assert_near("mass on supports", a.on_supports, b.on_supports, 1e-12, 1e4);
    assert_near("total", own.total_mass, system.total_mass, 1e-12, 1e4);
    for axis in [0, 2] {
        let [a, b] = [&own, &system].map(|s| s.mass_along(axis));
        assert_near("mass that is free", a, b, 1e-12, 1e4);
    }
}

fn peaks_agree(beams: &str, matrices: &str) {
    let [one, two] = [beams, matrices].map(|text| parse(text, &[]));
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let [(a, of_a), (b, of_b)] = [&one, &two].map(|(m, s)| trace(m, s, solver));
        for (i, output) in one.0.outputs.iter().enumerate() {
            let scale = a.peak(i);
            assert!(scale > 0.0, "{}", output.name);
            assert_near(&output.name, a.max[i], b.max[i], 1e-8, scale);
            assert_near(&output.name, a.min[i], b.min[i], 1e-8, scale);
        }
        // It has pounded.
        assert!(a.peak(4) > 1e4, "{}", a.peak(4));
        let [e, f] = [of_a, of_b].map(|r| r.energy);
        let scale = e.input.abs();
        for (what, x, y) in [
            ("input", e.input, f.input),
            ("kinetic", e.kinetic, f.kinetic),
            ("strain", e.strain, f.strain),
            ("modal damping", e.modal_damping, f.modal_damping),
            ("potential", e.potential, f.potential),
        ] {
            assert_near(what, x, y, 1e-7, scale);
        }
    }
}

#[test]
fn it_runs_as_the_frame_does_with_links_weight_and_ground_motion() {
    let [k, m] = frame();
    let modal = "Modal(ratio: 0.03)";
    peaks_agree(&of_beams(modal), &of_matrices(&k, &m, "", modal));
}

#[test]
fn a_matrix_of_damping_is_what_rayleigh_makes_of_the_frame() {
    let [k, m] = frame();
    let rayleigh = "Rayleigh(mass: 0.3, stiffness: 0.002)";
    peaks_agree(&of_beams(rayleigh), &of_matrices(&k, &m, "", rayleigh));
    // Of the frame by a file, of the mast, which is massless, by an element that acts as much: none.
    let c: Matrix = k
        .iter()
        .zip(&m)
        .map(|(k, m)| k.iter().zip(m).map(|(k, m)| 0.3 * m + 0.002 * k).collect())
        .collect();
    let by_file = format!("damping: Contents(\"c.mtx\", \"{}\")", market(&c));
    let (one, all) = parse(&of_matrices(&k, &m, "", rayleigh), &[]);
    let (_, own) = parse(&of_matrices(&k, &m, &by_file, "None"), &[]);
    assert_eq!(one.elements.len(), 5);
    let mast = |i: usize| all.direction(&one, i).0 == "mast";
    for (i, j, x) in all.damping().entries().filter(|(i, j, _)| !mast(*i) && !mast(*j)) {
        let (rows, values) = own.element_damping.column(j);
        let y = rows.binary_search(&i).map_or(0.0, |at| values[at]);
        assert_near("damping", x, y, 1e-12, x.abs().max(1e3));
    }
}

/// Gauss with row exchange.
fn solve(mut a: Matrix, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for p in 0..n {
        let pivot = (p..n).max_by(|i, j| a[*i][p].abs().total_cmp(&a[*j][p].abs())).unwrap();
        a.swap(p, pivot);
        b.swap(p, pivot);
        for i in p + 1..n {
            let f = a[i][p] / a[p][p];
            let upper = a[p].clone();
            a[i].iter_mut().zip(upper).for_each(|(x, u)| *x -= f * u);
            b[i] -= f * b[p];
        }
    }
    for p in (0..n).rev() {
        b[p] = (b[p] - (p + 1..n).map(|j| a[p][j] * b[j]).sum::<f64>()) / a[p][p];
    }
    b
}

#[test]
fn in_statics_inner_rows_are_what_condensation_makes_of_them() {
    let [k, m] = frame();
    // Tied: all of a0, a2 and b0.
    let tied: Vec<usize> = [0, 1, 2, 6, 7, 8, 18, 19, 20].to_vec();
    let inner: Vec<usize> = (0..21).filter(|i| !tied.contains(i)).collect();
    let pick = |a: &Matrix, rows: &[usize], columns: &[usize]| -> Matrix {
        rows.iter().map(|i| columns.iter().map(|j| a[*i][*j]).collect()).collect()
    };
    // Columns of K_ii⁻¹ K_it, and of K_ii⁻¹ p_i for the weight of inner rows; all that stands up has the mass below it.
    let up: Vec<f64> = (0..21).map(|i| f64::from(u8::from(i % 3 == 1))).collect();
    let weight: Vec<f64> = m
        .iter()
        .map(|row| -9.80665 * row.iter().zip(&up).map(|(m, u)| m * u).sum::<f64>())
        .collect();
    let kii = pick(&k, &inner, &inner);
    let mut condensed = pick(&k, &tied, &tied);
    let mut load: Vec<f64> = tied.iter().map(|i| weight[*i]).collect();
    let kti = pick(&k, &tied, &inner);
    for (a, column) in tied.iter().enumerate() {
        let x = solve(kii.clone(), inner.iter().map(|i| k[*i][*column]).collect());
        for (b, row) in kti.iter().enumerate() {
            condensed[b][a] -= row.iter().zip(&x).map(|(k, x)| k * x).sum::<f64>();
        }
    }
    let y = solve(kii, inner.iter().map(|i| weight[*i]).collect());
    for (b, row) in kti.iter().enumerate() {
        load[b] -= row.iter().zip(&y).map(|(k, y)| k * y).sum::<f64>();
    }
    // What is free is a2, pushed by 30 kN.
    let free: Vec<usize> = vec![3, 4, 5];
    let p = vec![load[3] + 30e3, load[4], load[5]];
    let u = solve(pick(&condensed, &free, &free), p);
    let text = of_matrices(&k, &m, "", "None").replace("opening: \"4 mm\"", "opening: \"40 mm\"");
    let (model, system) = parse(&text, &[]);
    let case = trilith_solvers::RunOptions { case: 0, ..Default::default() };
    let result = trilith_solvers::run(&model, &system, case, &mut []).unwrap();
    for (k, wanted) in u.iter().enumerate() {
        let full = 6 * model.nodes.iter().position(|n| n.name == "a2").unwrap() + [0, 2, 4][k];
        let place = system.reduction.expand(full)[0].0;
        assert_near("displacement", result.end.displacement[place], *wanted, 1e-9, wanted.abs());
    }
}

#[test]
fn one_that_nothing_else_holds_moves_as_a_rigid_body() {
    let [k, m] = frame();
    let text = of_matrices(&k, &m, "", "None");
    let text = text
        .replace("\"a0\": Fixed, \"b0\": Fixed, \"foot\": Fixed", "\"foot\": Fixed")
        .replace(
            &text[text.find("\"foot\": Reaction").unwrap()..text.find("// of all").unwrap()],
            "",
        )
        .replace(
            "\"gap\": Gap",
            "\"hold\": Spring(node: \"a2\", k1: 1, k2: 1, k3: 1), \"gap\": Gap",
        );
    let (model, system) = parse(&text, &[]);
    let spring = System::without_axial_forces(&model).unwrap().stiffness;
    let free = system.rigid_freedoms(&model, &spring, [0.0; 3]);
    assert_eq!(free.into_iter().map(|i| RIGID[i]).collect::<Vec<_>>(), Vec::<&str>::new());
    // Rᵀ M R of the frame by hand: Σ ρ A L, and where its centre is.
    let mass = DENSITY * AREA * 13.0;
    let sum = system.mass_sum(&model);
    let mast = 2000.0;
    assert_near("mass", sum.mass[2], mass + mast, 1e-12, mass);
    let height = (DENSITY * AREA * (2.0 * 4.0 * 2.0 + 5.0 * 4.0) + mast * 4.0) / (mass + mast);
    assert_near("height", sum.centre[2], height, 1e-9, 4.0);
    let across = (mass * 2.5 - mast * 0.5) / (mass + mast);
    assert_near("place", sum.centre[0], across, 1e-9, 4.0);
}

#[test]
fn doubtful_matrices_are_told() {
    let [mut k, m] = frame();
    k[9][9] += 1e7;
    let (_, system) = parse(&of_matrices(&k, &m, "", "None"), &[]);
    let told = &system.inner.doubts[..];
    let [one] = told else { panic!("{told:?}") };
    let wanted = "check the model: \"frame\" resists a motion as a rigid body along X, about Y: ";
    assert!(one.starts_with(wanted), "{one}");
    // A joint that hangs by its rotation alone.
    let [mut k, m] = frame();
    for at in [12, 13, 14] {
        (0..21).for_each(|j| (k[at][j], k[j][at]) = (0.0, 0.0));
    }
    let (model, system) = parse(&of_matrices(&k, &m, "", "None"), &[]);
    let error = system.check_supported(&model, false).unwrap_err().to_string();
    assert!(error.contains("\"row 13 of frame\""), "{error}");
}

#[test]
fn matrices_with_negative_energies_are_refused_by_the_assembly() {
    let refused = |k: &Matrix, m: &Matrix| {
        let text = of_matrices(k, m, "", "None");
        let registry = trilith_tests::registry();
        let model = trilith_model::read_text(&text, "test.ron", &registry, &[]).expect("a model");
        System::without_axial_forces(&model).unwrap_err().to_string()
    };
    let [k, m] = frame();
    // Every two rows are fine, three are not.
    let mut soft = k.clone();
    soft[10][10] *= 0.17;
    let error = refused(&soft, &m);
    assert!(
        error.starts_with("element \"frame\": its stiffness (k.mtx) is not positive"),
        "{error}"
    );
    let mut light = m.clone();
    light[10][10] *= 0.1;
    let error = refused(&k, &light);
    assert!(error.starts_with("element \"frame\": its mass (m.mtx) is not positive"), "{error}");
}

/// Masses by one point of each bar, as elements with few points have them, in a file of seven digits: what is negative of them
/// is rounding.
#[test]
fn masses_of_less_than_full_rank_are_taken() {
    let [k, _] = frame();
    let refused = |share: f64| {
        let mut m = vec![vec![0.0; k.len()]; k.len()];
        for i in 0..NODES.len() - 1 {
            for (a, b) in [(0, 0), (0, 3), (3, 0), (3, 3), (1, 1), (1, 4), (4, 1), (4, 4)] {
                let less = if a == b { 1.0 - share } else { 1.0 };
                m[3 * i + a][3 * i + b] += less * DENSITY * AREA / 4.0;
            }
        }
        let text = of_matrices(&k, &m, "", "None");
        let registry = trilith_tests::registry();
        let model = trilith_model::read_text(&text, "test.ron", &registry, &[]).expect("a model");
        System::without_axial_forces(&model).is_err()
    };
    assert!(!refused(0.0) && !refused(1e-7));
    assert!(refused(1e-5));
}

/// In JSON the map is an object, which looks as fields do elsewhere.
#[test]
fn nodes_by_labels_are_read_from_json_as_well() {
    let text = |right: &str| {
        format!(
            r#"{{ "plane": "XZ",
            "nodes": {{ "left": [0, 0, 0], "right": [3, 0, 0], "top": [1.5, 0, 6] }},
            "elements": {{
                "wall": {{ "Superelement": {{
                    "nodes": {{ "1": "left", "79": "{right}", "52": "top" }},
                    "stiffness": "superelements/wall_k.mtx", "mass": "superelements/wall_m.mtx",
                    "rows": "superelements/wall_rows.csv" }} }},
                "feet": {{ "Gap": {{ "node": "left", "k": "2 GN/m" }} }} }},
            "cases": {{ "weight": {{ "Static": {{ "loads": ["Gravity"] }} }} }},
            "outputs": {{ "x": {{ "Displacement": {{ "node": "top", "dof": "Ux" }} }} }} }}"#
        )
    };
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/wall.json");
    let read = |right: &str| trilith::read_text(&text(right), &path, &trilith::registry(), &[]);
    let model = read("right").expect("a model");
    let system = trilith::Analysis::new(&model).expect("a structure").system().order();
    assert_eq!(system, 182);
    let told = read("rihgt").unwrap_err().to_string();
    assert!(told.contains("wall.json:5:") && told.contains("rihgt"), "{told}");
}
