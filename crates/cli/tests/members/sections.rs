//! Named sections and materials.

use super::{model, near};

#[test]
fn sections_and_materials_are_numbers_of_a_card() {
    let text = |beam: &str| {
        format!(
            r#"(
    nodes: {{ "i": (0, 0, 0), "j": (2, 0, 0) }},
    supports: {{ "i": Fixed }},
    parameters: {{ "size": Text("HEB 300"), "class": Text("C30/37") }},
    properties: {{ "p": Beam(section: "IPE 80", material: Aluminium, i2: "1 cm^4") }},
    elements: {{ "b": Beam(nodes: ("i", "j"), {beam}) }},
    cases: {{ "c": Static(loads: [Gravity]) }},
)"#
        )
    };
    let values = |beam: &str| model(&text(beam)).elements[0].values.clone();
    let get = |beam: &str, name: &str| -> f64 {
        let values = values(beam);
        let found = values.0.iter().find(|(n, _)| n == name).unwrap_or_else(|| panic!("no {name}"));
        match found.1 {
            trilith::element::Value::Number(x) => x,
            ref other => panic!("{other:?}"),
        }
    };
    let same = values(r#"section: "HEB 300", material: Steel"#);
    for beam in [
        r#"section: Section("heb300"), material: Steel(young: "210 GPa")"#,
        r#"section: Section(name: "HE 300 B"), material: "Steel""#,
        r#"section: "size", material: Steel"#,
        // What the element says comes before what its set says.
        r#"use: "p", section: "HEB 300", material: Steel, i2: 8.5628e-5"#,
    ] {
        let values = values(beam);
        for ((name, a), (_, b)) in values.0.iter().zip(&same.0) {
            if name != "i2" {
                assert_eq!(a, b, "{beam}: {name}");
            }
        }
    }
    near("i2 of the set", get(r#"use: "p""#, "i2"), 1e-8, 1e-20);
    near("density", get(r#"use: "p""#, "density"), 2700.0, 0.0);
    near(
        "E_cm",
        get(r#"section: Circle(diameter: 1), material: Concrete("class")"#, "young"),
        32.8e9,
        0.1e9,
    );
    let aci =
        get(r#"section: Circle(diameter: 1), material: Concrete(strength: "4 ksi")"#, "young");
    near("ACI", aci, 57000.0 * 4000.0_f64.sqrt() * 6894.757, 0.01 * aci);
    near(
        "box",
        get(
            r#"section: Box(width: 0.2, depth: 0.3, thickness: 0.01), young: 1, poisson: 0"#,
            "area",
        ),
        0.0096,
        1e-12,
    );
    let shear =
        r#"section: "HEB 300", material: Steel, shear_modulus: "80 GPa", shear_coefficient: 0.5"#;
    assert!(!values(shear).0.iter().any(|(n, _)| n == "poisson" || n == "shear_area_2"));
}
