//! Named history variables of a link law.

use std::borrow::Cow;

/// One history variable: name and unit, as they appear in checkpoints and records.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Field {
    /// Name, unique within the law.
    pub name: Cow<'static, str>,
    /// SI unit, or `1`.
    pub unit: &'static str,
}

impl Field {
    /// A variable with a fixed name.
    #[must_use]
    pub const fn new(name: &'static str, unit: &'static str) -> Self {
        Self { name: Cow::Borrowed(name), unit }
    }

    /// A variable with a name that was put together.
    #[must_use]
    pub const fn named(name: String, unit: &'static str) -> Self {
        Self { name: Cow::Owned(name), unit }
    }
}

/// A struct of history variables that lives in a flat slice; made by [`history!`](crate::history).
pub trait History: Copy {
    /// The variables, in storage order.
    const FIELDS: &'static [Field];
    /// Reads the first `FIELDS.len()` values.
    fn load(from: &[f64]) -> Self;
    /// Writes the first `FIELDS.len()` values.
    fn store(&self, to: &mut [f64]);
}

/// Declares the history of a law as an ordinary struct of `f64` with units.
///
/// ```
/// use trilith_element::{History, history};
/// history! {
///     /// History of a friction contact.
///     pub struct Anchor {
///         /// Plastic slip along U2.
///         pub slip2: "m",
///         /// 1 while closed.
///         pub closed: "1",
///     }
/// }
/// let mut flat = [0.0; 2];
/// Anchor { slip2: 0.5, closed: 1.0 }.store(&mut flat);
/// assert_eq!(Anchor::load(&flat).slip2, 0.5);
/// ```
#[macro_export]
macro_rules! history {
    ($(#[$doc:meta])* $vis:vis struct $name:ident {
        $($(#[$field_doc:meta])* $field_vis:vis $field:ident : $unit:literal),* $(,)?
    }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        $vis struct $name { $($(#[$field_doc])* $field_vis $field: f64),* }

        impl $crate::History for $name {
            const FIELDS: &'static [$crate::Field] =
                &[$($crate::Field::new(stringify!($field), $unit)),*];
            fn load(from: &[f64]) -> Self {
                let mut values = from.iter().copied();
                Self { $($field: values.next().expect("history slice of FIELDS.len()")),* }
            }
            fn store(&self, to: &mut [f64]) {
                for (slot, value) in to.iter_mut().zip([$(self.$field),*]) {
                    *slot = value;
                }
            }
        }
    };
}
