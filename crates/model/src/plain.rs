//! Fields that a struct holds under the names of its block: read and written from one list.

use crate::named::Named;
use crate::read::{Context, Fields};
use crate::resolved::BlockText;

/// What a field holds that the schema declares as a number, a count, a flag or a name.
pub(crate) trait Plain: Sized {
    /// From a file, or the default of the schema.
    fn read(fields: &Fields<'_>, c: &Context<'_>, key: &'static str) -> Option<Self>;

    /// Into a text.
    fn write(&self, text: BlockText, key: &'static str) -> BlockText;
}

macro_rules! plain {
    ($($type:ty: $read:ident, $write:ident;)*) => {$(
        impl Plain for $type {
            fn read(fields: &Fields<'_>, c: &Context<'_>, key: &'static str) -> Option<Self> {
                fields.$read(c, key)
            }

            fn write(&self, text: BlockText, key: &'static str) -> BlockText {
                text.$write(key, *self)
            }
        }
    )*};
}
plain! {
    f64: number, number;
    Option<f64>: number_if, number_if;
    usize: count, count;
    Option<usize>: count_if, count_if;
    bool: flag, flag;
}

impl<T: Named> Plain for T {
    fn read(fields: &Fields<'_>, c: &Context<'_>, key: &'static str) -> Option<Self> {
        fields.named(c, key, key)
    }

    fn write(&self, text: BlockText, key: &'static str) -> BlockText {
        text.choice(key, self.name())
    }
}

/// `plain_fields!(Type: field, …)`: both directions for fields that the schema declares under these names.
macro_rules! plain_fields {
    ($type:ident: $($field:ident),* $(,)?) => {
        impl $type {
            /// Takes what a file says, all of it before the first fault ends it.
            pub(crate) fn read(
                &mut self,
                c: &$crate::read::Context<'_>,
                fields: &$crate::read::Fields<'_>,
            ) -> Option<()> {
                $(let $field = $crate::plain::Plain::read(fields, c, stringify!($field));)*
                $(self.$field = $field?;)*
                Some(())
            }

            /// Writes them behind what a text has.
            pub(crate) fn write(
                &self,
                text: $crate::resolved::BlockText,
            ) -> $crate::resolved::BlockText {
                $(let text = $crate::plain::Plain::write(&self.$field, text, stringify!($field));)*
                text
            }
        }
    };
}
pub(crate) use plain_fields;
