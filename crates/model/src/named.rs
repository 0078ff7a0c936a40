//! What a file writes as one of a few names.

use crate::{AfterEnd, BasisKind, Interpolation, Kernel, Plane};

/// One of a few names, in the order of the schema.
pub(crate) trait Named: Copy + PartialEq + 'static {
    /// All of them.
    const ALL: &'static [Self];
    /// Their names.
    const NAMES: &'static [&'static str];

    /// Its place among them.
    fn index(self) -> usize {
        Self::ALL.iter().position(|it| *it == self).unwrap_or_else(|| unreachable!("all of them"))
    }

    /// Its name.
    fn name(self) -> &'static str {
        Self::NAMES[self.index()]
    }
}

/// The variants of an enum under the names that they have in code: schema, reader and resolved text take them from here.
macro_rules! named {
    ($($type:ident: $($variant:ident),*;)*) => {$(
        impl Named for $type {
            const ALL: &'static [Self] = &[$(Self::$variant),*];
            const NAMES: &'static [&'static str] = &[$(stringify!($variant)),*];
        }
    )*};
}

named! {
    AfterEnd: Error, Zero, Hold;
    BasisKind: Ritz, Eigen, Complete;
    Interpolation: Linear, Cubic;
    Kernel: Newton, FixedPoint;
    Plane: XZ, YZ, XY;
}
