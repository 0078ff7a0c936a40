//! Cross-sections: rolled ones by name, others by their dimensions.
//!
//! The files beside this one hold outer dimensions as standards state them; everything else is computed here.
//!
//! | file | series | dimensions of |
//! |---|---|---|
//! | `european.csv` | IPE, HEA, HEB, HEM | EN 10365:2017 |
//! | `american.csv` | W | ASTM A6/A6M |
//!
//! Hollow sections need no table: their names are their dimensions (`hollow.rs`).
//!
//! Local 2 is along the depth, local 3 along the width: I₃ is of the strong axis.

mod hollow;
mod outline;
mod shapes;
#[cfg(test)]
mod tests;

pub use outline::Shape;
use shapes::{Fillets, Rolled, i_section};
pub use shapes::{circle, hollow_box, pipe, rectangle};
use std::collections::BTreeMap;
use std::sync::OnceLock;

const INCH: f64 = 0.0254;

/// What a beam takes of its cross-section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Area A, m².
    pub area: f64,
    /// Second moment about local 2, m⁴.
    pub i2: f64,
    /// Second moment about local 3, m⁴.
    pub i3: f64,
    /// Torsion constant J, m⁴.
    pub torsion: f64,
    /// Effective area for shear along local 2, m².
    pub shear_area_2: f64,
    /// Effective area for shear along local 3, m².
    pub shear_area_3: f64,
    /// What it looks like.
    pub shape: Shape,
}

/// The names of the series.
pub const SERIES: [&str; 9] = ["IPE", "HEA", "HEB", "HEM", "W", "SHS", "RHS", "CHS", "HSS"];

type Known = BTreeMap<String, (&'static str, Rolled)>;

/// All rolled sections by their plain names.
fn known() -> &'static Known {
    static KNOWN: OnceLock<Known> = OnceLock::new();
    KNOWN.get_or_init(|| {
        let mut all = Known::new();
        for (text, unit, fillets) in [
            (include_str!("european.csv"), 1e-3, Fillets::Radius),
            (include_str!("american.csv"), INCH, Fillets::FromFlange),
        ] {
            for line in text.lines().filter(|l| !l.starts_with('#')).skip(1) {
                let mut cells = line.split(',');
                let name = cells.next().unwrap_or_default();
                let sizes: Vec<f64> = cells.filter_map(|x| x.parse().ok()).collect();
                if let [h, b, tw, tf, last] = sizes[..] {
                    let sizes = [h, b, tw, tf, last].map(|x| unit * x);
                    all.insert(plain(name), (name, Rolled { sizes, fillets }));
                }
            }
        }
        all
    })
}

/// A name without blanks, in capitals: `W 14 × 90` is `W14X90`, `HE 300 B` is `HEB300`.
fn plain(name: &str) -> String {
    let bare: String = name.chars().filter(|c| !c.is_whitespace()).collect();
    let bare = bare.to_uppercase().replace('×', "X");
    let turned = bare.strip_prefix("HE").and_then(|rest| {
        let (size, kind) = rest.split_at_checked(rest.len().checked_sub(1)?)?;
        let number = !size.is_empty() && size.bytes().all(|b| b.is_ascii_digit());
        (number && matches!(kind, "A" | "B" | "M")).then(|| format!("HE{kind}{size}"))
    });
    turned.unwrap_or(bare)
}

/// The rolled or hollow section of a name, such as `HEB 300`, `W14x90` or `RHS 200x100x8`; blanks and capitals do not count.
#[must_use]
pub fn rolled(name: &str) -> Option<Section> {
    let name = plain(name);
    known().get(&name).map(|(_, rolled)| i_section(rolled)).or_else(|| hollow::hollow(&name))
}

/// An I section of outer depth, width of the flanges, web, flange and root radius, m.
#[must_use]
pub fn i_shape(sizes: [f64; 5]) -> Section {
    i_section(&Rolled { sizes, fillets: Fillets::Radius })
}

/// The names of the rolled sections of the series whose name a text begins with; none where it is that of no series.
#[must_use]
pub fn names(like: &str) -> Vec<&'static str> {
    let of = |name: &str| {
        SERIES.into_iter().find(|s| plain(name).strip_prefix(s).is_some_and(starts_with_digit))
    };
    let Some(wanted) = of(like) else { return Vec::new() };
    let all = known().values().map(|(name, _)| *name);
    all.filter(|name| of(name) == Some(wanted)).collect()
}

fn starts_with_digit(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit())
}
