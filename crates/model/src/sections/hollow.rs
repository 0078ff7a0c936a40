//! Hollow sections by their names, which are their dimensions.
//!
//! | name | series | walls and corners of |
//! |---|---|---|
//! | `SHS 150x8`, `RHS 200x100x8`, `CHS 219.1x10` | hot finished, mm | EN 10210-2:2006 |
//! | `SHS 100x5 cold` … | cold formed, mm | EN 10219-2:2006 |
//! | `HSS 8x6x1/2`, `HSS 6.625x0.280` | American, in | ASTM A500, AISC 360-16, B4.2 |
//!
//! ```text
//!  A   = 2 t (b + h − 2 t) − (4 − π)(r_o² − r_i²)
//!  I   = b h³/12 − (b − 2t)(h − 2t)³/12 − corners(r_o, h) + corners(r_i, h − 2t),   as fillets of an I section
//!  J   = s t³/3 + 4 A_m² t/s,  s and A_m the length of the middle line and what it encloses, corners of (r_o + r_i)/2
//! ```
//!
//! Formulas: EN 10210-2:2006, Annex B. Outer and inner radius of a corner: 1.5 t and t where hot finished; 2 t and t up to 6 mm
//! of wall, 2.5 t and 1.5 t up to 10 mm, 3 t and 2 t beyond, where cold formed (EN 10219-2:2006, Annex B); 2 t and t for HSS,
//! whose wall is 0.93 of the nominal one. Shear: the walls along it, as of a box.

use super::shapes::pipe;
use super::{INCH, Section, Shape};
use std::f64::consts::PI;

/// The names of these series.
const SERIES: [&str; 4] = ["SHS", "RHS", "CHS", "HSS"];
/// Share of the nominal wall that a HSS is computed with \[AISC 360-16, B4.2\].
const DESIGN_WALL: f64 = 0.93;

/// The section of a plain name (capitals, no blanks); none where it is that of no hollow section, or has no room inside.
pub(super) fn hollow(plain: &str) -> Option<Section> {
    let series = SERIES.into_iter().find(|s| plain.starts_with(s))?;
    let (sizes, cold) = match plain[series.len()..].strip_suffix("COLD") {
        Some(sizes) => (sizes, true),
        None => (&plain[series.len()..], false),
    };
    if cold && series == "HSS" {
        return None;
    }
    let sizes = sizes.split('X').map(number).collect::<Option<Vec<f64>>>()?;
    let unit = if series == "HSS" { INCH } else { 1e-3 };
    let wall = if series == "HSS" { DESIGN_WALL } else { 1.0 };
    match (series, &sizes[..]) {
        ("CHS" | "HSS", [d, t]) if 2.0 * t < *d => Some(pipe(unit * d, unit * wall * t)),
        ("SHS", [b, t]) => tube([unit * b, unit * b, unit * t], corner(*t, cold)),
        ("RHS", [h, b, t]) | ("SHS", [h, b, t]) if series == "RHS" || h == b => {
            tube([unit * h, unit * b, unit * t], corner(*t, cold))
        }
        ("HSS", [h, b, t]) => tube([unit * h, unit * b, unit * wall * t], [2.0, 1.0]),
        _ => None,
    }
}

/// `8`, `0.28`, `5/16`.
fn number(text: &str) -> Option<f64> {
    let positive = |text: &str| text.parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0);
    match text.split_once('/') {
        Some((above, below)) => Some(positive(above)? / positive(below)?),
        None => positive(text),
    }
}

/// Outer and inner radius of a corner over the wall, which is given in mm.
fn corner(wall: f64, cold: bool) -> [f64; 2] {
    match wall {
        _ if !cold => [1.5, 1.0],
        t if t <= 6.0 => [2.0, 1.0],
        t if t <= 10.0 => [2.5, 1.5],
        _ => [3.0, 2.0],
    }
}

/// A tube of outer depth, outer width and wall, m, with the radii of its corners over the wall.
fn tube([h, b, t]: [f64; 3], radii: [f64; 2]) -> Option<Section> {
    let [outer, inner] = radii.map(|r| r * t);
    if h.min(b) <= 2.0 * outer {
        return None;
    }
    let share = 1.0 / 3.0 - PI / 16.0 - 1.0 / (9.0 * (4.0 - PI));
    let centre = (10.0 - 3.0 * PI) / (12.0 - 3.0 * PI);
    let corners = |r: f64, side: f64| {
        let arm = 0.5 * side - centre * r;
        4.0 * (share * r.powi(4) + (1.0 - PI / 4.0) * r * r * arm * arm)
    };
    let second = |h: f64, b: f64| {
        let full = (b * h.powi(3) - (b - 2.0 * t) * (h - 2.0 * t).powi(3)) / 12.0;
        full - corners(outer, h) + corners(inner, h - 2.0 * t)
    };
    let middle = 0.5 * (outer + inner);
    let around = 2.0 * (h + b - 2.0 * t) - 2.0 * middle * (4.0 - PI);
    let enclosed = (h - t) * (b - t) - middle * middle * (4.0 - PI);
    Some(Section {
        area: 2.0 * t * (b + h - 2.0 * t) - (4.0 - PI) * (outer * outer - inner * inner),
        i3: second(h, b),
        i2: second(b, h),
        torsion: around * t.powi(3) / 3.0 + 4.0 * enclosed * enclosed * t / around,
        shear_area_2: 2.0 * h * t,
        shear_area_3: 2.0 * b * t,
        shape: Shape::Rectangle { width: b, depth: h },
    })
}
