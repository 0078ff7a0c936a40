//! What a model becomes in a script for OpenSeesPy: commands, and what has none.

use trilith_exchange::opensees::export::{Export, ExportError, ExportOptions, export};

fn exported(text: &str, options: &ExportOptions) -> Result<Export, ExportError> {
    let model = trilith::read_text(text, "model.ron", &trilith::registry(), &[]);
    let model = model.unwrap_or_else(|e| panic!("{e:?}\n{text}"));
    export(&model, model.cases.len() - 1, options)
}

/// A mass on the ground by a link along X.
fn oscillator(link: &str) -> String {
    format!(
        "(title: \"t\", nodes: {{ \"m\": (0, 0, 0) }}, supports: {{ \"m\": (Uy, Uz, Rx, Ry, Rz) }}, elements: {{ \
         \"mass\": Mass(node: \"m\", mass: 1000), \"link\": {link} }}, \
         cases: {{ \"run\": Dynamic(duration: 1, dt: 0.1) }}, \
         outputs: {{ \"x\": Displacement(node: \"m\", dof: Ux) }})"
    )
}

fn along(kind: &str, fields: &str) -> String {
    oscillator(&format!("{kind}(node: \"m\", axis1: (1, 0, 0), {fields})"))
}

fn materials(text: &str, near: bool) -> Result<Vec<String>, String> {
    let options = ExportOptions { near, ..ExportOptions::default() };
    match exported(text, &options) {
        Ok(made) => Ok(made
            .script
            .lines()
            .filter_map(|l| l.trim().strip_prefix("ops.uniaxialMaterial("))
            .map(|l| l.trim_end_matches(')').to_owned())
            .collect()),
        Err(ExportError::Refused(losses)) => Err(losses.text()),
        Err(e) => Err(e.to_string()),
    }
}

#[test]
fn every_law_with_a_counterpart_is_its_material() {
    let cases = [
        ("Gap", "k: 2e6", &["\"ENT\", 1, 2000000.0"][..]),
        ("Gap", "k: 2e6, opening: 0.01", &["\"ElasticPPGap\", 1, 2000000.0, -2000000000.0, -0.01"]),
        ("Hook", "k: 2e6, opening: 0.01", &["\"ElasticPPGap\", 1, 2000000.0, 2000000000.0, 0.01"]),
        (
            "ImpactKelvin",
            "k: 1e8, damping: 8e5, pull: true, opening: 0.02",
            &["\"ViscoelasticGap\", 1, 100000000.0, 800000.0, -0.02"],
        ),
        (
            "ImpactHertz",
            "k: 1e9, xi: 0.6, opening: 0.02",
            &["\"Hertzdamp\", 1, 1000000000.0, 0.6, -0.02, 1.5"],
        ),
        (
            "ImpactHertz",
            "k: 1e9, model: Jankowski, xi: 0.4, impact_mass: 5e4, opening: 0.02",
            &["\"JankowskiImpact\", 1, 1000000000.0, 0.4, 50000.0, -0.02, 1.5"],
        ),
        ("Dashpot", "c: 1e4", &["\"Elastic\", 1, 0.0, 10000.0"]),
        ("Dashpot", "c: 1e4, exponent: 0.5", &["\"Viscous\", 1, 10000.0, 0.5"]),
        (
            "Dashpot",
            "c: 1e4, when: InContact, pull: true, opening: 0.02",
            &["\"ViscoelasticGap\", 1, 0.0, 10000.0, -0.02"],
        ),
        (
            "MaxwellDamper",
            "k: 1e7, c: 1e5, exponent: 0.5",
            &["\"ViscousDamper\", 1, 10000000.0, 100000.0, 0.5"],
        ),
        (
            "BilinearDamper",
            "k: 1e7, c: 1e6, cy: 2e5, fl: 6e4",
            &["\"BilinearOilDamper\", 1, 10000000.0, 1000000.0, 60000.0, 0.2"],
        ),
        // β = γ = ½ (k/f_y)ⁿ.
        (
            "Wen",
            "k: 1e7, fy: 1e5, ratio: 0.1",
            &[
                "\"BoucWen\", 1, 0.1, 10000000.0, 2.0, 5000.0, 5000.0, 1.0, 0.0, 0.0, 0.0, 1e-10, 100",
            ],
        ),
        // β/d_yⁿ, and losses by the work (1 − α) k d_y² = 100 J.
        (
            "BoucWen",
            "k: 1e6, dy: 0.01, alpha: 0, n: 1, beta: 0.6, gamma: 0.4, delta_nu: 0.02",
            &["\"BoucWen\", 1, 0.0, 1000000.0, 1.0, 40.0, 60.0, 1.0, 0.0, 0.0002, 0.0, 1e-10, 100"],
        ),
        (
            "MultilinearElastic",
            "deformation: [-1, 0, 1], force: [-2, 0, 3]",
            &[
                "\"ElasticMultiLinear\", 1, 0.0, \"-strain\", -1.0, 0.0, 1.0, \"-stress\", -2.0, 0.0, 3.0",
            ],
        ),
        (
            "MultilinearPlastic",
            "deformation: [-2, -1, 0, 1, 2], force: [-3, -2, 0, 2, 3]",
            &["\"MultiLinear\", 1, 1.0, 2.0, 2.0, 3.0"],
        ),
        // 2 and then 1 N/m: the plastic modulus is 2·1/(2 − 1).
        (
            "MultilinearPlastic",
            "rule: Isotropic, deformation: [-2, -1, 0, 1, 2], force: [-3, -2, 0, 2, 3]",
            &["\"Hardening\", 1, 2.0, 2.0, 2.0, 0.0"],
        ),
        (
            "SoilSpring",
            "axis: U1, k: 2e7, ku: 5e7, pu: 1e5, opening: 0.002, sides: Negative",
            &["\"HyperbolicGapMaterial\", 1, 20000000.0, 50000000.0, 0.7, -70000.0, -0.002"],
        ),
        (
            "FrequencyIndependentViscoelastic",
            "k_inf: 10, stiffness: [20], time: [0.5]",
            &["\"Elastic\", 1, 10.0, 0.0", "\"Maxwell\", 2, 20.0, 10.0, 1.0, 1.0"],
        ),
        (
            "IbarraMedinaKrawinkler",
            "k: 1e6, fy: 1e4, capping: 1.2, plastic: 0.1, post_capping: 0.4",
            &[
                "\"IMKPeakOriented\", 1, 1000000.0, 0.1, 0.4, 500.0, 10000.0, 1.2, 0.0, 0.1, 0.4, 500.0, 10000.0, 1.2, 0.0, 1000000000000.0, 1000000000000.0, 1000000000000.0, 1000000000000.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0",
            ],
        ),
    ];
    for (kind, fields, wanted) in cases {
        assert_eq!(
            materials(&along(kind, fields), false).as_deref(),
            Ok(&wanted.iter().map(|w| (*w).to_owned()).collect::<Vec<_>>()[..]),
            "{kind}({fields})"
        );
    }
}

#[test]
fn what_has_no_counterpart_is_named_with_its_reason() {
    let cases = [
        ("Gap", "k: 2e6, opening: -0.01", "pressed at rest"),
        ("ImpactKelvin", "k: 1e8, damping: 8e5", "`pull: true`"),
        (
            "ImpactKelvin",
            "k: 1e8, restitution: 0.5, impact_mass: 1000, pull: true",
            "give `damping`",
        ),
        ("Dashpot", "c: 1e4, when: InContact", "`pull: true`"),
        (
            "MultilinearPlastic",
            "rule: Takeda, deformation: [-2, -1, 0, 1, 2], force: [-3, -2, 0, 2, 3]",
            "`Takeda`",
        ),
        (
            "MultilinearPlastic",
            "deformation: [-2, -1, 0, 1, 2], force: [-4, -2, 0, 2, 3]",
            "sides differ",
        ),
        ("FrictionSpring", "k: 1e6, k1: 1e5, k2: 5e4", "SelfCentering"),
        ("SoilSpring", "axis: U1, k: 2e7, pu: 1e5", "in compression alone"),
    ];
    for (kind, fields, why) in cases {
        let said = materials(&along(kind, fields), true).expect_err(fields);
        assert!(said.contains(&format!("{kind} \"link\"")) && said.contains(why), "{said}");
    }
    let worn = along(
        "IbarraMedinaKrawinkler",
        "k: 1e6, fy: 1e4, capping: 1.2, plastic: 0.1, post_capping: 0.4, lambda_s: 1",
    );
    assert!(materials(&worn, false).is_err_and(|said| said.contains("only near: what wears out")));
    assert_eq!(materials(&worn, true).map(|m| m.len()), Ok(1));
    let left = ExportOptions { leave_out: true, ..ExportOptions::default() };
    let nothing = exported(&along("Gap", "k: 2e6, opening: -0.01"), &left);
    assert!(matches!(nothing, Err(ExportError::Empty)), "{nothing:?}");
}

const BODY: &str = r#"(title: "b", plane: XZ, nodes: { "cg": (0, 0, 1), "foot": (-1, 0, 0), "top": (0, 0, 2) }, elements: {
    "body": RigidBody(nodes: ("cg", "foot")), "mast": RigidLink(nodes: ("foot", "top")),
    "mass": Mass(node: "cg", mass: 1000, inertia: (1, 300, 1)), "tip": Mass(node: "top", mass: 10),
    "foot": NLink(node: "foot", kn: 1e8, ks: 1e7, mu: 0.3, damping: 1e4, pull: true),
    "stay": Spring(node: "top", k2: 1e5),
}, damping: Modal(ratio: 0.02), functions: { "f": Sine(amplitude: 1, frequency: 1) },
cases: { "weight": Static(loads: [Gravity]), "run": Dynamic(after: "weight", duration: 1, dt: 0.1, alpha: -0.1, solver: Hht,
    base: [(direction: X, function: "f", factor: 2)], initial: [(node: "cg", dof: Ry, velocity: 0.5)]) },
outputs: { "x": Displacement(node: "top", dof: Ux), "n": LinkForce(link: "foot", axis: U1, factor: -1),
    "seen": Acceleration(node: "top", dof: Ux, absolute: true), "base": BaseShear(direction: X) })"#;

#[test]
fn bodies_contacts_and_cases_are_said_as_opensees_says_them() {
    let made = exported(BODY, &ExportOptions { substeps: 4, ..ExportOptions::default() })
        .expect("a script");
    assert!(!made.losses.matter(), "{}", made.losses.text());
    for line in [
        // Bodies that hang on each other are one, and what nobody moves is held by springs where others follow.
        "ops.rigidLink(\"beam\", 1, 2)  # body",
        "ops.rigidLink(\"beam\", 1, 3)  # mast",
        "ops.element(\"zeroLength\", 4, 6, 1, \"-mat\", 7, 7, 7, \"-dir\", 2, 4, 6)",
        // Masses out of the plane would have modes of their own there.
        "ops.mass(1, 1000.0, 0.0, 1000.0, 0.0, 300.0, 0.0)  # cg",
        "ops.fix(4, 1, 1, 1, 1, 1, 1)  # ground",
        // Friction counts the spring alone: the dashpot stands beside it.
        "ops.frictionModel(\"Coulomb\", 1, 0.3)",
        "ops.uniaxialMaterial(\"ViscoelasticGap\", 6, 0.0, 10000.0, 0.0)",
        "\"-P\", 2, \"-T\", 3, \"-My\", 4, \"-Mz\", 5, \"-orient\", 0.0, 0.0, 1.0, 1.0, 0.0, 0.0",
        "ops.load(1, 0.0, 0.0, -9806.65, 0.0, 0.0, 0.0)",
        "ops.load(3, 0.0, 0.0, -98.0664999",
        "ops.pattern(\"UniformExcitation\", 2, 1, \"-accel\", 3, \"-fact\", 2.0)",
        // What follows a velocity at the start has one as well: ω × r.
        "ops.setNodeVel(1, 5, 0.5, \"-commit\")",
        "ops.setNodeVel(2, 1, -0.5, \"-commit\")",
        "ops.setNodeVel(2, 3, 0.5, \"-commit\")",
        "ALPHA = 0.9  #",
        "SUBSTEPS = 4  #",
        "o1 = -basic(2, 0) - stress(3, 1)  # n",
        "o2 = accel(3, 1) + 1.0 * ground(0, t)  # seen",
        "return (2.0 * f1(t), 0.0, 0.0)[direction]",
        "hertz, ratios = [1.0], [0.02]",
        "static_case(10)",
    ] {
        assert!(made.script.contains(line), "{line}\n{}", made.script);
    }
}

#[test]
fn what_opensees_cannot_follow_is_refused() {
    let why = |from: &str, to: &str| {
        assert!(BODY.contains(from), "{from}");
        match exported(&BODY.replace(from, to), &ExportOptions::default()) {
            Err(ExportError::Refused(losses)) => losses.text(),
            other => panic!("{other:?}"),
        }
    };
    let held = why("elements: {", "supports: { \"cg\": (Ux) }, elements: {");
    assert!(held.contains("support \"cg\": a node that others follow"), "{held}");
    let twice = why(
        "\"foot\": NLink",
        "\"again\": EqualDof(nodes: (\"cg\", \"top\"), dofs: (Uy)), \"foot\": NLink",
    );
    assert!(twice.contains("follows two others"), "{twice}");
    let speed = why("mu: 0.3", "mu_slow: 0.1, mu_fast: 0.3, rate: 20");
    assert!(speed.contains("only near: friction by the speed of the bearing"), "{speed}");
    let stiff = why("damping: Modal", "p_delta: \"weight\", damping: Modal");
    assert!(stiff.contains("P-Δ"), "{stiff}");
}
