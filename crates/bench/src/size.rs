//! The six sizes of the frame, and how they must move.

use trilith::generate::Frame;

/// Peaks under the whole motion of 20 s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peaks {
    /// Largest displacement of any isolator in the plane at the output times, m.
    pub isolator: f64,
    /// Largest |roof − base| at the corner along X at the output times, m.
    pub roof: f64,
}

/// A size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Name of the preset.
    pub name: &'static str,
    /// By Newmark's constant average acceleration at dt = 0.005 s.
    pub newmark: Option<Peaks>,
    /// By the same with a step so fine that it counts as exact, and that step, s.
    pub fine: Option<(Peaks, f64)>,
    /// Steps that direct integration makes unless told otherwise; the whole motion has 4000.
    pub hht_steps: usize,
}

/// Where the peaks come from.
pub const SOURCE: &str = "Peaks: OpenSeesPy 3.7.1, Newmark γ = ½, β = ¼, increments below 1e-8, the frames \
    built from the same formulas by an independent program; at a fine step of P1e4: direct \
    integration here, which gives those of OpenSees to 1e-7 for P1e2 and P1e3 at either step";

const fn peaks(isolator: f64, roof: f64) -> Peaks {
    Peaks { isolator, roof }
}

/// All, by size.
pub const SIZES: [Size; 6] = [
    Size {
        name: "P1e2",
        newmark: Some(peaks(0.185_296_844_132_982_6, 0.009_501_030_953_279_03)),
        fine: Some((peaks(0.185_455_177_894_303_5, 0.009_477_484_361_750_29), 0.0005)),
        hht_steps: 4000,
    },
    Size {
        name: "P1e3",
        newmark: Some(peaks(0.170_595_285_092_761_3, 0.027_018_571_127_468_09)),
        fine: Some((peaks(0.170_686_828_032_179_05, 0.026_907_679_352_230_006), 0.00125)),
        hht_steps: 4000,
    },
    Size {
        name: "P1e4s",
        newmark: Some(peaks(0.170_918_540_157_334, 0.026_156_962_423_013_318)),
        fine: None,
        hht_steps: 4000,
    },
    Size {
        name: "P1e4",
        newmark: Some(peaks(0.210_000_132_052_326_87, 0.074_953_099_621_585_22)),
        fine: Some((peaks(0.210_199_721_671, 0.074_907_112_285), 0.00125)),
        hht_steps: 4000,
    },
    Size { name: "P5e4", newmark: None, fine: None, hht_steps: 400 },
    Size { name: "P1e5", newmark: None, fine: None, hht_steps: 200 },
];

/// The size of a name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Size> {
    SIZES.iter().find(|s| s.name.eq_ignore_ascii_case(name))
}

impl Size {
    /// The frame.
    #[must_use]
    pub fn frame(&self) -> Frame {
        Frame::preset(self.name).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_a_size() {
        assert_eq!(SIZES.map(|s| s.name), Frame::PRESETS);
        assert!(find("p1E3").is_some_and(|s| s.name == "P1e3"));
        assert_eq!(find("P1e9"), None);
    }
}
