//! A study of a mass that slides, for tests that kill it and go on with it.

/// A mass that slides on friction under one sine.
const MODEL: &str = r#"(
    title: "Sliding mass",
    plane: XZ, gravity: "9.81 m/s^2",
    parameters: { "mu": 0.3, "a": "1 m/s^2" },
    nodes: { "cg": (0, 0, 0) },
    elements: {
        "mass": Mass(node: "cg", mass: "1 t", inertia: (0, 1, 0)),
        "upright": Spring(node: "cg", r3: "1 MN*m"),
        "foot": NLink(node: "cg", kn: "10 MN/m", ks: "10 MN/m", mu: "mu", damping: "10 kN*s/m"),
    },
    functions: { "pulse": Sine(amplitude: "a", frequency: "2 Hz", cycles: 1) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "DURATION", dt: "10 ms",
            base: [(direction: X, function: "pulse")], energy_limit: 0.5),
    },
    outputs: { "slide": Displacement(node: "cg", dof: Ux) },
)"#;

/// The model, shaken so long.
pub fn model(duration: &str) -> String {
    MODEL.replace("DURATION", duration)
}

/// A folder with the model, which is shaken so long, and `study.ron` of so many values each of friction and amplitude.
pub fn folder(side: usize, duration: &str, more: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mass.ron"), model(duration)).unwrap();
    let study = format!(
        r#"(
    model: "mass.ron",
    axes: {{
        "a": Range(from: "1 m/s^2", to: "8 m/s^2", count: {side}),
        "mu": Range(from: 0.05, to: 0.95, count: {side}),
    }},
    columns: {{ "slide": Peak("slide"), "heat": Energy("link_hysteretic") }},
    {more}
)"#
    );
    std::fs::write(folder.path().join("study.ron"), study).unwrap();
    folder
}
