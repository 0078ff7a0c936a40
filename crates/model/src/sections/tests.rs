//! Against what makers tabulate, and closed forms.

use super::*;

fn near(what: &str, got: f64, wanted: f64, share: f64) {
    assert!((got / wanted - 1.0).abs() < share, "{what}: {got:e} instead of {wanted:e}");
}

#[test]
fn european_sections_are_those_of_the_tables() {
    // A in cm², I₃, I₂ and J in cm⁴.
    for (name, a, i3, i2, j) in [
        ("IPE 80", 7.64, 80.14, 8.49, 0.70),
        ("IPE 300", 53.81, 8356.0, 603.8, 20.12),
        ("IPE 600", 156.0, 92080.0, 3387.0, 165.4),
        ("HEA 100", 21.24, 349.2, 133.8, 5.24),
        ("HEA 300", 112.5, 18260.0, 6310.0, 85.17),
        ("HEA 1000", 346.8, 553_800.0, 14000.0, 822.4),
        ("HEB 100", 26.04, 449.5, 167.3, 9.25),
        ("HEB 300", 149.1, 25170.0, 8563.0, 185.0),
        ("HEB 1000", 400.0, 644_700.0, 16280.0, 1254.0),
        ("HEM 300", 303.1, 59200.0, 19400.0, 1408.0),
        ("HEM 1000", 444.2, 722_300.0, 18460.0, 1701.0),
    ] {
        let s = rolled(name).unwrap_or_else(|| panic!("no {name}"));
        near(name, s.area, 1e-4 * a, 1e-3);
        near(name, s.i3, 1e-8 * i3, 1e-3);
        near(name, s.i2, 1e-8 * i2, 1e-3);
        near(name, s.torsion, 1e-8 * j, 5e-3);
    }
}

#[test]
fn american_sections_are_those_of_the_tables() {
    // A in in², I₃, I₂ and J in in⁴: dimensions have three digits there.
    for (name, a, i3, i2, j) in [
        ("W14x90", 26.5, 999.0, 362.0, 4.06),
        ("W14x730", 215.0, 14300.0, 4720.0, 1450.0),
        ("W12x50", 14.6, 391.0, 56.3, 1.71),
        ("W18x35", 10.3, 510.0, 15.3, 0.506),
        ("W24x76", 22.4, 2100.0, 82.5, 2.68),
        ("W36x150", 44.3, 9040.0, 270.0, 10.1),
        ("W8x31", 9.13, 110.0, 37.1, 0.536),
        ("W44x335", 98.5, 31100.0, 1200.0, 74.7),
    ] {
        let s = rolled(name).unwrap_or_else(|| panic!("no {name}"));
        near(name, s.area, INCH.powi(2) * a, 1e-2);
        near(name, s.i3, INCH.powi(4) * i3, 1e-2);
        near(name, s.i2, INCH.powi(4) * i2, 1e-2);
        near(name, s.torsion, INCH.powi(4) * j, 1.5e-2);
    }
}

#[test]
fn hollow_sections_are_those_of_the_tables() {
    // A in cm², I₃, I₂ and J in cm⁴: EN 10210-2 and EN 10219-2.
    for (name, a, i3, i2, j) in [
        ("RHS 200x100x8", 44.8, 2234.0, 739.0, 1804.0),
        ("RHS 300x200x10", 94.9, 11819.0, 6278.0, 12908.0),
        ("SHS 150x8", 44.8, 1491.0, 1491.0, 2351.0),
        ("SHS 100x100x5", 18.7, 279.0, 279.0, 439.0),
        ("SHS 100x5 cold", 18.4, 271.0, 271.0, 441.0),
        ("CHS 219.1x10", 65.7, 3598.0, 3598.0, 7197.0),
    ] {
        let s = rolled(name).unwrap_or_else(|| panic!("no {name}"));
        near(name, s.area, 1e-4 * a, 3e-3);
        near(name, s.i3, 1e-8 * i3, 2e-3);
        near(name, s.i2, 1e-8 * i2, 2e-3);
        near(name, s.torsion, 1e-8 * j, 2e-3);
    }
    // A in in², I₃, I₂ and J in in⁴: AISC, walls of three digits.
    for (name, a, i3, i2, j) in [
        ("HSS 8x6x5/16", 7.59, 68.3, 43.8, 85.8),
        ("HSS8X6X1/2", 11.6, 98.2, 62.5, 127.0),
        ("HSS 6x6x3/8", 7.58, 39.5, 39.5, 64.6),
        ("HSS 10x6x3/8", 10.4, 137.0, 61.8, 139.0),
        ("HSS 6.625x0.280", 5.20, 26.4, 26.4, 52.7),
    ] {
        let s = rolled(name).unwrap_or_else(|| panic!("no {name}"));
        near(name, s.area, INCH.powi(2) * a, 1e-2);
        near(name, s.i3, INCH.powi(4) * i3, 1e-2);
        near(name, s.i2, INCH.powi(4) * i2, 1e-2);
        near(name, s.torsion, INCH.powi(4) * j, 1e-2);
    }
    let wrong = [
        "RHS 200x100",
        "SHS 100",
        "SHS 100x90x5",
        "RHS 40x20x8",
        "CHS 100x50",
        "HSS 8x6x1/0",
        "HSS 8x6xcold",
        "HSS 8x6x1/2 cold",
        "RHS 200x-100x8",
        "RHS",
        "HSS 1x",
        "RHS 200xNaNx8",
        "CHS 1e400x1",
    ];
    for name in wrong {
        assert!(rolled(name).is_none(), "{name}");
    }
    // Walls that are thin have hardly any corners.
    let (s, sharp) = (rolled("RHS 300x200x0.5").unwrap(), hollow_box(0.2, 0.3, 5e-4, 5e-4));
    near("area", s.area, sharp.area, 1e-2);
    near("torsion", s.torsion, sharp.torsion, 1e-2);
}

/// Second moment of half the outline of an I section, by strips.
fn by_strips(sizes: [f64; 5], about_3: bool) -> (f64, f64) {
    let [h, b, tw, tf, r] = sizes;
    let half_width = |y: f64| {
        let up = (h / 2.0 - tf) - y;
        match up {
            u if u < 0.0 => b / 2.0,
            u if u < r => tw / 2.0 + r - (r * r - (r - u).powi(2)).sqrt(),
            _ => tw / 2.0,
        }
    };
    // Web and flange by themselves: the outline jumps between them.
    let (n, inner) = (100_000, h / 2.0 - tf);
    let (mut area, mut i) = (0.0, 0.0);
    for (from, to) in [(0.0, inner - r), (inner - r, inner), (inner, h / 2.0)] {
        let dy = (to - from) / f64::from(n);
        for k in 0..n {
            let y = from + (f64::from(k) + 0.5) * dy;
            let w = half_width(y);
            area += 4.0 * w * dy;
            i += if about_3 { 4.0 * w * dy * y * y } else { 4.0 * w.powi(3) / 3.0 * dy };
        }
    }
    (area, i)
}

#[test]
fn fillets_are_where_a_sum_of_strips_finds_them() {
    for (name, (_, of)) in known().iter().filter(|(_, (_, r))| r.fillets == Fillets::Radius) {
        let s = i_section(of);
        let (area, i3) = by_strips(of.sizes, true);
        let (_, i2) = by_strips(of.sizes, false);
        near(name, s.area, area, 1e-6);
        near(name, s.i3, i3, 1e-6);
        near(name, s.i2, i2, 1e-6);
    }
}

#[test]
fn names_are_found_however_they_are_written() {
    let one = rolled("HEB 300").unwrap();
    for name in ["heb300", "HE 300 B", "HE300B", "HEB  300"] {
        assert_eq!(rolled(name), Some(one), "{name}");
    }
    let one = rolled("W14x90").unwrap();
    assert!(rolled("W 14 × 90") == Some(one) && rolled("w14X90") == Some(one));
    assert!(rolled("HEB 310").is_none() && rolled("HE").is_none() && rolled("").is_none());
    assert!(rolled("HEé").is_none() && rolled("W6x8.5").is_some());
    assert_eq!(known().len(), 18 + 3 * 24 + 289);
    assert!(names("HEB 310").iter().all(|n| n.starts_with("HEB")) && names("x").is_empty());
}

#[test]
fn thin_walls_and_solid_bars_have_their_closed_forms() {
    use std::f64::consts::PI;
    let (d, t) = (0.5, 1e-4);
    let s = pipe(d, t);
    near("pipe", s.i3, PI * (d / 2.0).powi(3) * t, 1e-3);
    near("shear of a thin pipe", s.shear_area_2, 0.5 * s.area, 1e-3);
    let s = circle(0.2);
    near("circle", s.torsion, PI / 32.0 * 0.2_f64.powi(4), 1e-12);
    near("shear of a bar", s.shear_area_3, 6.0 / 7.0 * s.area, 1e-12);
    let s = hollow_box(0.3, 0.3, t, t);
    near("box", s.torsion, 0.3_f64.powi(3) * t, 2e-3);
    near("box", s.i2, s.i3, 1e-12);
    // A wall as thick as half the box leaves nothing hollow.
    let (full, solid) = (hollow_box(0.2, 0.4, 0.1, 0.2), rectangle(0.2, 0.4));
    near("solid", full.area, solid.area, 1e-12);
    near("solid", full.i3, solid.i3, 1e-12);
    near("square in torsion", rectangle(1.0, 1.0).torsion, 0.1406, 2e-3);
}
