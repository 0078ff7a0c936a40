//! Cross-sections and materials of members.

use super::Takes::{Number, One, Text, Words};
use super::{Block, Group, absent, needed, plain};
use trilith_element::Range::{NonNegative, Positive, Within};
use trilith_element::dimension as d;
use trilith_element::{Card, Category};

const OF_SECTION: &str = "`area` and what else the card has";
const OF_MATERIAL: &str = "`young` and what else the card has";

/// True for kinds that have a cross-section and a material.
pub(crate) fn is_member(card: &Card) -> bool {
    let has = |name: &str| card.parameter(name).is_some();
    card.category == Category::Linear && has("area") && has("young")
}

/// What elements take whose card has an area and a modulus.
pub static MEMBER: Block = Block {
    name: "",
    meaning: "What beams and trusses take beside the parameters of their card, in `properties` as well. Parameters given \
              beside them come first.",
    example: r#"Beam(nodes: ("base", "m"), section: "HEB 300", material: Steel)"#,
    fields: &[
        absent(
            "section",
            One(&SECTIONS),
            OF_SECTION,
            "The cross-section; a rolled one by its name in quotes, such as `\"HEB 300\"` or `\"W14x90\"`. It gives area, second moments, torsion constant and shear areas, so that shear deformation counts.",
        ),
        absent(
            "material",
            One(&MATERIALS),
            OF_MATERIAL,
            "The material, which gives modulus, Poisson's ratio, density (so that the member weighs) and expansion.",
        ),
    ],
};

/// A rolled section.
pub static ROLLED: Block = Block {
    name: "Section",
    meaning: "A rolled section by its name: European IPE, HEA, HEB and HEM (EN 10365), American W (ASTM A6/A6M); or a hollow one: \
              `\"SHS 150x8\"`, `\"RHS 200x100x8\"`, `\"CHS 219.1x10\"` in mm (EN 10210, with `cold` behind it EN 10219), `\"HSS 8x6x1/2\"` in \
              inches (ASTM A500). \
              `\"HEB 300\"` and `Section(\"HEB 300\")` say the same; blanks and capitals do not count. Everything is computed \
              from depth, width, thicknesses and root radius.",
    example: r#"Section(name: "IPE 300")"#,
    fields: &[needed("name", Text, "The name.")],
};
/// A pipe.
pub static PIPE: Block = Block {
    name: "Pipe",
    meaning: "A round pipe.",
    example: r#"Pipe(diameter: "323.9 mm", thickness: "10 mm")"#,
    fields: &[
        needed("diameter", Number(d::LENGTH, Positive), "Outer diameter."),
        needed("thickness", Number(d::LENGTH, Positive), "Of the wall; at most half the diameter."),
    ],
};
/// A hollow box.
pub static BOX: Block = Block {
    name: "Box",
    meaning: "A hollow box with sharp corners.",
    example: r#"Box(width: "200 mm", depth: "300 mm", thickness: "10 mm")"#,
    fields: &[
        needed("width", Number(d::LENGTH, Positive), "Outer width, along local 3."),
        needed("depth", Number(d::LENGTH, Positive), "Outer depth, along local 2."),
        needed("thickness", Number(d::LENGTH, Positive), "Of the walls along the depth."),
        absent(
            "flange",
            Number(d::LENGTH, Positive),
            "`thickness`",
            "Of the walls along the width.",
        ),
    ],
};
/// An I section.
pub static I_SHAPE: Block = Block {
    name: "IShape",
    meaning: "An I section with equal flanges.",
    example: r#"IShape(depth: "1 m", width: "300 mm", web: "12 mm", flange: "25 mm")"#,
    fields: &[
        needed("depth", Number(d::LENGTH, Positive), "Outer depth, along local 2."),
        needed("width", Number(d::LENGTH, Positive), "Of the flanges, along local 3."),
        needed("web", Number(d::LENGTH, Positive), "Thickness of the web."),
        needed("flange", Number(d::LENGTH, Positive), "Thickness of a flange."),
        plain("radius", Number(d::LENGTH, NonNegative), "0", "Radius at the roots of the web."),
    ],
};
/// A solid rectangle.
pub static RECTANGLE: Block = Block {
    name: "Rectangle",
    meaning: "A solid rectangle.",
    example: r#"Rectangle(width: "300 mm", depth: "500 mm")"#,
    fields: &[
        needed("width", Number(d::LENGTH, Positive), "Along local 3."),
        needed("depth", Number(d::LENGTH, Positive), "Along local 2."),
    ],
};
/// A solid circle.
pub static CIRCLE: Block = Block {
    name: "Circle",
    meaning: "A solid circle.",
    example: r#"Circle(diameter: "600 mm")"#,
    fields: &[needed("diameter", Number(d::LENGTH, Positive), "Diameter.")],
};
/// Cross-sections.
pub static SECTIONS: Group = Group {
    name: "section",
    meaning: "Cross-sections of members. Local 2 runs along the depth: where the file says nothing of local axes it points up, \
              and a level beam bends about its strong axis.",
    blocks: &[&ROLLED, &PIPE, &BOX, &I_SHAPE, &RECTANGLE, &CIRCLE],
};

/// Steel.
pub static STEEL: Block = Block {
    name: "Steel",
    meaning: "Structural steel (EN 1993-1-1, 3.2.6). American practice takes `Steel(young: \"29000 ksi\")`.",
    example: "Steel",
    fields: &[
        plain("young", Number(d::STRESS, Positive), r#""210 GPa""#, "Young's modulus."),
        plain("poisson", Number(d::NONE, Within(-0.99, 0.5)), "0.3", "Poisson's ratio."),
        plain("density", Number(d::DENSITY, NonNegative), r#""7850 kg/m^3""#, "Density."),
        plain("expansion", Number(d::NONE, NonNegative), "1.2e-5", "Strain by one kelvin."),
    ],
};
/// Concrete.
pub static CONCRETE: Block = Block {
    name: "Concrete",
    meaning: "Reinforced concrete, uncracked. `Concrete(\"C30/37\")` names the class alone.",
    example: r#"Concrete(class: "C30/37")"#,
    fields: &[
        absent(
            "class",
            Words("a strength class from C12/15 to C90/105"),
            "`strength`",
            "Class of EN 1992-1-1, table 3.1: E = 22 GPa (f_cm/10 MPa)^0.3, f_cm = f_ck + 8 MPa.",
        ),
        absent(
            "strength",
            Number(d::STRESS, Positive),
            "`class`",
            "Cylinder strength f'c instead: E = 4700 MPa √(f'c/MPa) (ACI 318-19, 19.2.2.1).",
        ),
        plain("poisson", Number(d::NONE, Within(-0.99, 0.5)), "0.2", "Poisson's ratio."),
        plain(
            "density",
            Number(d::DENSITY, NonNegative),
            r#""2500 kg/m^3""#,
            "Density, with steel.",
        ),
        plain("expansion", Number(d::NONE, NonNegative), "1e-5", "Strain by one kelvin."),
    ],
};
/// Aluminium.
pub static ALUMINIUM: Block = Block {
    name: "Aluminium",
    meaning: "Aluminium alloys (EN 1999-1-1, 3.2.5).",
    example: "Aluminium",
    fields: &[
        plain("young", Number(d::STRESS, Positive), r#""70 GPa""#, "Young's modulus."),
        plain("poisson", Number(d::NONE, Within(-0.99, 0.5)), "0.3", "Poisson's ratio."),
        plain("density", Number(d::DENSITY, NonNegative), r#""2700 kg/m^3""#, "Density."),
        plain("expansion", Number(d::NONE, NonNegative), "2.3e-5", "Strain by one kelvin."),
    ],
};
/// Materials.
pub static MATERIALS: Group = Group {
    name: "material",
    meaning: "Materials of members. Any other is given by `young`, `poisson` (or `shear_modulus`), `density` and `expansion` of \
              the element itself.",
    blocks: &[&STEEL, &CONCRETE, &ALUMINIUM],
};
