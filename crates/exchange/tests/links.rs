//! Every kind of link of SAP2000, and what the model file says of it.

mod common;

use common::{close, file, import, last, model};

#[test]
fn every_kind_of_link_becomes_the_link_of_the_same_law() {
    let import = import(&file("links.s2k"), None);
    let ron = import.draft.to_ron();
    for words in [
        "\"LIN\": LinearLink(stiffness: [[100, 0, 0, 0, 0, 0], [0, 10, 0, 0, 0, 0], ",
        "damping: [[0.5, 0, 0, 0, 0, 0], ",
        "shear_at: 15)",
        "\"CURVE\": MultilinearElastic(deformation: [-10, -1, 0, 1], force: [-20, -10, 0, 10], axis: U2)",
        "\"link 2\": MultilinearElastic(nodes: (\"A\", \"B\"), axis1: (0, 0, 1), axis2: (0, 1, 0), use: \"CURVE\")",
        "\"DAMP U1\": MaxwellDamper(k: 900, c: 3, exponent: 0.5)",
        "\"DAMP linear\": Spring(k3: 7)",
        "\"GAP\": Gap(k: 2000, opening: 0.25)",
        "\"HOOK\": Hook(k: 50, opening: 0.125, axis: U2, shear_at: 5)",
        "\"RUBBER\": RubberIsolator(k2: 10, fy2: 5, ratio2: 0.2, k3: 10, fy3: 6, ratio3: 0.2, kv: 3000)",
        "\"SLIDE\": FrictionPendulum(kn: 4000, damping: 2, pull: true, ks: 30, radius: 90, \
         friction_model: Velocity, mu_slow: 0.04, mu_fast: 0.06, rate: 1.1)",
        "\"BOTH\": TensionCompressionFriction(kn: 4000, kt: 1000, gap_compression: 0, gap_tension: 0.1, \
         ks: 30, radius: 0, mu: 0.05, mu_slow_tension: 0.08, mu_fast_tension: 0.1, rate_tension: 1)",
        "\"WEN\": Wen(k: 800, fy: 50, ratio: 0.1, exponent: 4, axis: R3)",
        "\"PIVOT\": MultilinearPlastic(deformation: [-3, -1, 0, 1, 3], force: [-30, -20, 0, 20, 30], \
         rule: Takeda, axis: U3)",
        "\"TRIPLE\": TriplePendulum(kn: 5000, ks: 60, radii: (88, 16, 16, 88), heights: (4, 3, 3, 4), \
         capacities: (14, 2, 2, 14), stop_stiffness: 60, mu: (0.08, 0.02, 0.02, 0.08))",
        "\"OIL\": BilinearDamper(k: 400, c: 15, cy: 0.6, fl: 17, axis: U3)",
        "\"RING\": FrictionSpring(k: 70, k1: 6, k2: 2, u0: 0.5, us: 6, direction: Tension)",
        "\"link 13 fixed\": RigidLink(nodes: (\"B\", \"C\"))",
        "\"link 14\": LinearLink(node: \"C\", use: \"LIN\")",
        // Half of a link's mass at each joint, the other half of a grounded one in the ground.
        "\"mass B\": Mass(node: \"B\", mass: 1.2, inertia: (10, 20, 30))",
        "\"mass C\": Mass(node: \"C\", mass: 1.2, inertia: (10, 10, 10))",
    ] {
        assert!(ron.contains(words), "{words} in\n{ron}");
    }
    assert_eq!(import.report.losses(), 0, "{}", import.report.text());
    model(&import);
}

#[test]
fn links_carry_their_own_weight() {
    let model = model(&import(&file("links.s2k"), None));
    let u = last(&model, "OWN", &["B Uz", "link 4 U1 force"]);
    assert!(u[0] < 0.0, "{u:?}");
    // Three kip in the links 1 and 14: half at B, half at C; what presses: two LIN, DAMP without rate, RUBBER, SLIDE,
    // BOTH and TRIPLE; GAP only beyond a quarter of an inch.
    let k = (100.0 + 3000.0 + 4000.0 + 4000.0 + 5000.0) * 4448.2216152605 / 0.0254;
    assert!(u[0].abs() < 3.0 * 4448.2216152605 / k, "{u:?} {k}");
    close(u[1] + 1.0, 1.0, 1e-12, "gap");
}
