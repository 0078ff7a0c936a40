//! Units of the quantities in reports.

/// The unit a quantity is reported in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Name.
    pub name: &'static str,
    /// SI value of one.
    pub si: f64,
}

impl Unit {
    /// SI or no unit: the name is only a label.
    #[must_use]
    pub const fn si(name: &'static str) -> Self {
        Self { name, si: 1.0 }
    }
}

/// An inch.
pub const INCH: Unit = Unit { name: "in", si: 0.0254 };
/// A pound-force.
pub const POUND_FORCE: Unit = Unit { name: "lbf", si: 4.448_221_615_260_5 };
/// A thousand pounds-force.
pub const KIP: Unit = Unit { name: "kip", si: 4_448.221_615_260_5 };
/// A metre.
pub const METRE: Unit = Unit::si("m");
/// A second.
pub const SECOND: Unit = Unit::si("s");
/// A metre per second.
pub const SPEED: Unit = Unit::si("m/s");
/// A newton.
pub const NEWTON: Unit = Unit::si("N");
/// A joule.
pub const JOULE: Unit = Unit::si("J");
/// A radian.
pub const RADIAN: Unit = Unit::si("rad");
/// A pure number.
pub const NUMBER: Unit = Unit::si("");
/// A hertz.
pub const HERTZ: Unit = Unit { name: "Hz", si: std::f64::consts::TAU };
