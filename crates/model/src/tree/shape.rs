//! One level of a RON value.

use ron::value::RawValue;
use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// One level of a value; what is inside stays raw.
pub(super) enum Shape<'a> {
    Number(f64),
    Flag(bool),
    Text(String),
    Unit,
    Some(&'a RawValue),
    List(Vec<&'a RawValue>),
    Entries(Vec<(Key<'a>, &'a RawValue)>),
}

pub(super) enum Key<'a> {
    Borrowed(&'a str),
    Owned(String),
}

impl Key<'_> {
    pub(super) fn into_string(self) -> String {
        match self {
            Self::Borrowed(k) => k.to_owned(),
            Self::Owned(k) => k,
        }
    }
}

impl<'de: 'a, 'a> Deserialize<'de> for Key<'a> {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        struct Names;
        impl<'de> Visitor<'de> for Names {
            type Value = Key<'de>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a name")
            }
            fn visit_borrowed_str<E>(self, s: &'de str) -> Result<Key<'de>, E> {
                Ok(Key::Borrowed(s))
            }
            fn visit_str<E>(self, s: &str) -> Result<Key<'de>, E> {
                Ok(Key::Owned(s.to_owned()))
            }
        }
        d.deserialize_any(Names)
    }
}

impl<'de: 'a, 'a> Deserialize<'de> for Shape<'a> {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        d.deserialize_any(Shapes)
    }
}

struct Shapes;

impl<'de> Visitor<'de> for Shapes {
    type Value = Shape<'de>;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }
    fn visit_bool<E>(self, b: bool) -> Result<Shape<'de>, E> {
        Ok(Shape::Flag(b))
    }
    fn visit_f64<E>(self, x: f64) -> Result<Shape<'de>, E> {
        Ok(Shape::Number(x))
    }
    fn visit_i64<E>(self, x: i64) -> Result<Shape<'de>, E> {
        Ok(Shape::Number(x as f64))
    }
    fn visit_u64<E>(self, x: u64) -> Result<Shape<'de>, E> {
        Ok(Shape::Number(x as f64))
    }
    fn visit_str<E>(self, s: &str) -> Result<Shape<'de>, E> {
        Ok(Shape::Text(s.to_owned()))
    }
    fn visit_unit<E>(self) -> Result<Shape<'de>, E> {
        Ok(Shape::Unit)
    }
    fn visit_none<E>(self) -> Result<Shape<'de>, E> {
        Ok(Shape::Unit)
    }
    fn visit_some<D: Deserializer<'de>>(self, d: D) -> Result<Shape<'de>, D::Error> {
        <&RawValue>::deserialize(d).map(Shape::Some)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Shape<'de>, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = seq.next_element()? {
            items.push(item);
        }
        Ok(Shape::List(items))
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Shape<'de>, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = map.next_entry()? {
            entries.push(entry);
        }
        Ok(Shape::Entries(entries))
    }
}
