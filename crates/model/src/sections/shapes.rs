//! Section properties from dimensions.
//!
//! ```text
//!  I section     A   = 2 b t_f + h_w t_w + (4 − π) r²,   h_w = h − 2 t_f
//!                I₃  = (b h³ − (b − t_w) h_w³)/12 + 4 (I_r + A_r (h_w/2 − c)²)
//!                I₂  = 2 t_f b³/12 + h_w t_w³/12 + 4 (I_r + A_r (t_w/2 + c)²)
//!                A_r = (1 − π/4) r²,  c = r (10 − 3π)/(12 − 3π),  I_r = r⁴ (1/3 − π/16 − 1/(9 (4 − π)))
//!                J   = flanges and web as thin plates, and the circles that fit where they meet
//!                A₂  = h t_w,  A₃ = 5/3 b t_f
//!  pipe          J = I₂ + I₃;  A₂ = A₃ = A · 6 (1 + m²)² / (7 (1 + m²)² + 20 m²),  m = d_i/d
//!  box           J = 4 A_m² / Σ (s/t)  [Bredt];  A₂ = 2 h t_w,  A₃ = 2 b t_f
//!  rectangle     J = a s³ (1/3 − 0.21 (s/a) (1 − s⁴/(12 a⁴))),  A₂ = A₃ = 5/6 A
//! ```
//!
//! Torsion of rolled sections: \[El Darwish & Johnston 1965\], of which makers in Europe use a shorter fit than those in
//! America; each series has that of its makers. Shear of solid and round sections: \[Cowper 1966\] with ν = 0; of I sections
//! and boxes the plates along the shear. Rectangle: Roark.

use super::{Section, Shape};
use std::f64::consts::PI;

/// What the last column of a table says of the root fillets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fillets {
    /// Their radius.
    Radius,
    /// How far from the outer face of the flange they end.
    FromFlange,
}

/// Dimensions of a rolled section, m: depth, width, web, flange, and what tells of the fillets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rolled {
    pub sizes: [f64; 5],
    pub fillets: Fillets,
}

pub(super) fn i_section(rolled: &Rolled) -> Section {
    let [h, b, tw, tf, last] = rolled.sizes;
    let r = match rolled.fillets {
        Fillets::Radius => last,
        Fillets::FromFlange => last - tf,
    };
    let web = h - 2.0 * tf;
    let (area, c) = ((1.0 - PI / 4.0) * r * r, r * (10.0 - 3.0 * PI) / (12.0 - 3.0 * PI));
    let own = r.powi(4) * (1.0 / 3.0 - PI / 16.0 - 1.0 / (9.0 * (4.0 - PI)));
    let fillets = |arm: f64| 4.0 * (own + area * arm * arm);
    let strong = (b * h.powi(3) - (b - tw) * web.powi(3)) / 12.0;
    let weak = (2.0 * tf * b.powi(3) + web * tw.powi(3)) / 12.0;
    Section {
        area: 2.0 * b * tf + web * tw + 4.0 * area,
        i3: strong + fillets(web / 2.0 - c),
        i2: weak + fillets(tw / 2.0 + c),
        torsion: twist(rolled.sizes, r, rolled.fillets),
        shear_area_2: h * tw,
        shear_area_3: 5.0 / 3.0 * b * tf,
        shape: Shape::I { depth: h, width: b, web: tw, flange: tf },
    }
}

fn twist([h, b, tw, tf, _]: [f64; 5], r: f64, series: Fillets) -> f64 {
    let web = (h - 2.0 * tf) * tw.powi(3) / 3.0;
    match series {
        Fillets::Radius => {
            let flanges = 2.0 / 3.0 * (b - 0.63 * tf) * tf.powi(3);
            let share = 2.0 * tw / tf * (0.145 + 0.1 * r / tf);
            let circle = ((r + tw / 2.0).powi(2) + (r + tf).powi(2) - r * r) / (2.0 * r + tf);
            flanges + web + share * circle.powi(4)
        }
        Fillets::FromFlange => {
            let flanges = 2.0 / 3.0 * b * tf.powi(3) - 0.42 * tf.powi(4);
            let (x, y) = (tw / tf, r / tf);
            let share = -0.042 + 0.2204 * x + 0.1355 * y - 0.0865 * x * y - 0.0725 * x * x;
            let circle = ((tf + r).powi(2) + (r + tw / 4.0) * tw) / (2.0 * r + tf);
            flanges + web + 2.0 * share * circle.powi(4)
        }
    }
}

/// A pipe of an outer diameter and a wall thickness, m.
#[must_use]
pub fn pipe(diameter: f64, thickness: f64) -> Section {
    let inner = diameter - 2.0 * thickness;
    let area = PI / 4.0 * (diameter * diameter - inner * inner);
    let i = PI / 64.0 * (diameter.powi(4) - inner.powi(4));
    let m = (inner / diameter).powi(2);
    let q = (1.0 + m).powi(2);
    let shear = area * 6.0 * q / (7.0 * q + 20.0 * m);
    Section {
        area,
        i2: i,
        i3: i,
        torsion: 2.0 * i,
        shear_area_2: shear,
        shear_area_3: shear,
        shape: Shape::Round { diameter },
    }
}

/// A solid circle, m.
#[must_use]
pub fn circle(diameter: f64) -> Section {
    pipe(diameter, diameter / 2.0)
}

/// A solid rectangle: width along local 3, depth along local 2, m.
#[must_use]
pub fn rectangle(width: f64, depth: f64) -> Section {
    let (a, s) = (width.max(depth), width.min(depth));
    let q = s / a;
    let area = width * depth;
    Section {
        area,
        i2: depth * width.powi(3) / 12.0,
        i3: width * depth.powi(3) / 12.0,
        torsion: a * s.powi(3) * (1.0 / 3.0 - 0.21 * q * (1.0 - q.powi(4) / 12.0)),
        shear_area_2: 5.0 / 6.0 * area,
        shear_area_3: 5.0 / 6.0 * area,
        shape: Shape::Rectangle { width, depth },
    }
}

/// A box with sharp corners: outer width and depth, thickness of the walls along the depth and across it, m.
#[must_use]
pub fn hollow_box(width: f64, depth: f64, web: f64, flange: f64) -> Section {
    let (b, h) = (width - 2.0 * web, depth - 2.0 * flange);
    let (bm, hm) = (width - web, depth - flange);
    Section {
        area: width * depth - b * h,
        i2: (depth * width.powi(3) - h * b.powi(3)) / 12.0,
        i3: (width * depth.powi(3) - b * h.powi(3)) / 12.0,
        torsion: 4.0 * (bm * hm).powi(2) / (2.0 * hm / web + 2.0 * bm / flange),
        shear_area_2: 2.0 * depth * web,
        shear_area_3: 2.0 * width * flange,
        shape: Shape::Rectangle { width, depth },
    }
}
