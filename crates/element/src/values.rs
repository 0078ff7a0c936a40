//! Parameter values on their way from a model file into a typed law.

use crate::{FileText, ParameterError, SparseMatrix};
use serde::de::value::MapAccessDeserializer;
use serde::de::{
    DeserializeOwned, DeserializeSeed, EnumAccess, IntoDeserializer, MapAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use std::sync::Arc;

/// One value: a number is already in SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number in SI.
    Number(f64),
    /// A name, such as a choice among several, or a text.
    Text(String),
    /// A file, with what it holds.
    File(Arc<FileText>),
    /// A sparse matrix of a file; no field of a struct takes it, a kind reads it by [`Values::get`].
    Matrix(Arc<SparseMatrix>),
    /// Yes or no.
    Flag(bool),
    /// Several values.
    List(Vec<Value>),
}

/// The parameters of one element, by name, with the defaults of its card filled in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values(pub Vec<(String, Value)>);

impl Values {
    /// The value of a parameter, if it is given or has a default.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.0.iter().find(|(n, _)| n == name).map(|(_, v)| v)
    }

    /// The number of a parameter, if it is given and a number.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.get(name) {
            Some(Value::Number(x)) => Some(*x),
            _ => None,
        }
    }

    /// Reads a typed parameter struct.
    ///
    /// # Errors
    /// [`ParameterError::Form`] where a value has not the type of its field, [`ParameterError::File`] where a file does not
    /// hold what its field wants.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, ParameterError> {
        T::deserialize(MapAccessDeserializer::new(Pairs { rest: &self.0 }))
    }
}

/// Names and values one after the other.
struct Pairs<'a> {
    rest: &'a [(String, Value)],
}

impl<'de> MapAccess<'de> for Pairs<'_> {
    type Error = ParameterError;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, ParameterError> {
        let name = self.rest.first().map(|(name, _)| name.as_str());
        name.map(|name| seed.deserialize(name.into_deserializer())).transpose()
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(
        &mut self,
        seed: V,
    ) -> Result<V::Value, ParameterError> {
        let Some(((name, value), rest)) = self.rest.split_first() else {
            return Err(serde::de::Error::custom("a value without a name"));
        };
        self.rest = rest;
        seed.deserialize(value.clone()).map_err(|error| match value {
            Value::File(_) => {
                ParameterError::File { name: name.clone(), message: error.to_string() }
            }
            _ => error,
        })
    }
}

impl IntoDeserializer<'_, ParameterError> for Value {
    type Deserializer = Self;
    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> serde::Deserializer<'de> for Value {
    type Error = ParameterError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ParameterError> {
        match self {
            Self::Number(x) => visitor.visit_f64(x),
            Self::Text(s) => visitor.visit_string(s),
            Self::Flag(b) => visitor.visit_bool(b),
            Self::File(file) => visitor.visit_map(file.pairs()),
            Self::Matrix(matrix) => visitor.visit_string(matrix.name.clone()),
            Self::List(items) => {
                visitor.visit_seq(serde::de::value::SeqDeserializer::new(items.into_iter()))
            }
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ParameterError> {
        visitor.visit_some(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ParameterError> {
        visitor.visit_enum(Variant(self))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf
        unit unit_struct newtype_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}

/// A unit variant named by a text.
struct Variant(Value);

impl<'de> EnumAccess<'de> for Variant {
    type Error = ParameterError;
    type Variant = Unit;
    fn variant_seed<V: DeserializeSeed<'de>>(
        self,
        seed: V,
    ) -> Result<(V::Value, Unit), ParameterError> {
        seed.deserialize(self.0).map(|v| (v, Unit))
    }
}

struct Unit;

impl<'de> serde::de::VariantAccess<'de> for Unit {
    type Error = ParameterError;
    fn unit_variant(self) -> Result<(), ParameterError> {
        Ok(())
    }
    fn newtype_variant_seed<T: DeserializeSeed<'de>>(
        self,
        _seed: T,
    ) -> Result<T::Value, ParameterError> {
        Err(only_unit())
    }
    fn tuple_variant<V: Visitor<'de>>(self, _: usize, _: V) -> Result<V::Value, ParameterError> {
        Err(only_unit())
    }
    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, ParameterError> {
        Err(only_unit())
    }
}

fn only_unit() -> ParameterError {
    serde::de::Error::custom("a choice is a plain name")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Deserialize, Debug, PartialEq)]
    enum Side {
        Left,
        Right,
    }

    #[derive(Deserialize, Debug, PartialEq)]
    struct Law {
        k: f64,
        side: Side,
        up: Option<[f64; 3]>,
        on: bool,
    }

    #[test]
    fn a_typed_struct_reads_its_values() {
        let up = Value::List([0.0, 0.0, 1.0].map(Value::Number).to_vec());
        let values = Values(vec![
            ("k".into(), Value::Number(2.0)),
            ("side".into(), Value::Text("Right".into())),
            ("up".into(), up),
            ("on".into(), Value::Flag(true)),
        ]);
        let law: Law = values.read().unwrap();
        assert_eq!(law, Law { k: 2.0, side: Side::Right, up: Some([0.0, 0.0, 1.0]), on: true });
    }

    #[test]
    fn a_wrong_type_is_an_error() {
        let values = Values(vec![("k".into(), Value::Text("two".into()))]);
        assert!(values.read::<Law>().is_err());
    }
}
