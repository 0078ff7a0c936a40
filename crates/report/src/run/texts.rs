//! Whether any text in data holds what a page may not show, without a copy of the data.

use serde::ser::{self, Serialize};
use std::fmt::Display;
use trilith_model::visible;

/// True where a text or a name of a key would be written otherwise by [`visible`].
pub(crate) fn any_to_write_out(data: &impl Serialize) -> bool {
    data.serialize(Search).is_err()
}

/// Passes all values, reads texts alone, and fails at the first that is not as it may be shown.
struct Search;

/// There is such a text.
#[derive(Debug)]
struct Found;

impl Display for Found {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a text with control characters")
    }
}

impl std::error::Error for Found {}

impl ser::Error for Found {
    fn custom<T: Display>(_: T) -> Self {
        Self
    }
}

macro_rules! passed {
    ($($name:ident: $type:ty),*) => { $(
        #[inline(always)]
        fn $name(self, _: $type) -> Result<(), Found> {
            Ok(())
        }
    )* };
}

impl ser::Serializer for Search {
    type Ok = ();
    type Error = Found;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Self;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    passed!(serialize_bool: bool, serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64,
        serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64, serialize_f32: f32,
        serialize_f64: f64, serialize_bytes: &[u8], serialize_unit_struct: &'static str);

    fn serialize_char(self, c: char) -> Result<(), Found> {
        self.serialize_str(c.encode_utf8(&mut [0; 4]))
    }

    fn serialize_str(self, text: &str) -> Result<(), Found> {
        if visible(text) == text { Ok(()) } else { Err(Found) }
    }

    fn serialize_none(self) -> Result<(), Found> {
        Ok(())
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), Found> {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), Found> {
        Ok(())
    }

    fn serialize_unit_variant(self, _: &str, _: u32, _: &str) -> Result<(), Found> {
        Ok(())
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &str,
        value: &T,
    ) -> Result<(), Found> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &str,
        _: u32,
        _: &str,
        value: &T,
    ) -> Result<(), Found> {
        value.serialize(self)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Self, Found> {
        Ok(self)
    }

    fn serialize_tuple(self, _: usize) -> Result<Self, Found> {
        Ok(self)
    }

    fn serialize_tuple_struct(self, _: &str, _: usize) -> Result<Self, Found> {
        Ok(self)
    }

    fn serialize_tuple_variant(self, _: &str, _: u32, _: &str, _: usize) -> Result<Self, Found> {
        Ok(self)
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Self, Found> {
        Ok(self)
    }

    fn serialize_struct(self, _: &str, _: usize) -> Result<Self, Found> {
        Ok(self)
    }

    fn serialize_struct_variant(self, _: &str, _: u32, _: &str, _: usize) -> Result<Self, Found> {
        Ok(self)
    }
}

macro_rules! all_of {
    ($($part:ident: $one:ident),*) => { $(
        impl ser::$part for Search {
            type Ok = ();
            type Error = Found;

            fn $one<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Found> {
                value.serialize(Search)
            }

            fn end(self) -> Result<(), Found> {
                Ok(())
            }
        }
    )* };
}

all_of!(SerializeSeq: serialize_element, SerializeTuple: serialize_element,
    SerializeTupleStruct: serialize_field, SerializeTupleVariant: serialize_field);

macro_rules! fields_of {
    ($($part:ident),*) => { $(
        // Names of fields are those of the program.
        impl ser::$part for Search {
            type Ok = ();
            type Error = Found;

            fn serialize_field<T: Serialize + ?Sized>(&mut self, _: &'static str, value: &T) -> Result<(), Found> {
                value.serialize(Search)
            }

            fn end(self) -> Result<(), Found> {
                Ok(())
            }
        }
    )* };
}

fields_of!(SerializeStruct, SerializeStructVariant);

impl ser::SerializeMap for Search {
    type Ok = ();
    type Error = Found;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Found> {
        key.serialize(Search)
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Found> {
        value.serialize(Search)
    }

    fn end(self) -> Result<(), Found> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use std::collections::BTreeMap;

    #[test]
    fn a_control_character_is_found_wherever_it_stands() {
        let odd = "a\u{9b}b";
        for data in [json!(odd), json!([1, [odd]]), json!({ "a": { "b": odd } }), json!({ odd: 1 })]
        {
            assert!(any_to_write_out(&data), "{data}");
        }
        assert!(any_to_write_out(&(1, Some(odd))) && any_to_write_out(&BTreeMap::from([(odd, 1)])));
        assert!(any_to_write_out(&'\u{1b}'));
        let plain = json!({ "a \"b\" \\": [1, 2.5, null, true, "ü\nb"] });
        assert!(!any_to_write_out(&plain), "{plain}");
    }
}
