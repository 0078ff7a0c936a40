//! Numbers as a model file would have them, and as JSON that loses none.

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use trilith::element::Dimension;

/// A number that JSON brings back to the bit; those that it has no form for are texts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Number(pub f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() {
            to.serialize_f64(self.0)
        } else {
            to.serialize_str(&format!("{:016x}", self.0.to_bits()))
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Either {
            Number(f64),
            Bits(String),
        }
        match Either::deserialize(from)? {
            Either::Number(x) => Ok(Self(x)),
            Either::Bits(text) => u64::from_str_radix(&text, 16)
                .map(|bits| Self(f64::from_bits(bits)))
                .map_err(serde::de::Error::custom),
        }
    }
}

/// A number in SI with its unit, read back to the same bits.
pub(crate) fn written(x: f64, dimension: Dimension) -> String {
    if dimension.is_none() { format!("{x:?}") } else { format!("{x:?} {}", dimension.unit()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith::element::dimension as d;

    #[test]
    fn json_brings_every_number_back_to_the_bit() {
        for x in [0.1 + 0.2, -0.0, 5e-324, f64::MAX, 2.0, f64::NEG_INFINITY, -f64::NAN] {
            let text = serde_json::to_string(&Number(x)).unwrap();
            let back: Number = serde_json::from_str(&text).unwrap();
            assert_eq!(back.0.to_bits(), x.to_bits(), "{text}");
        }
    }

    #[test]
    fn numbers_come_back_to_the_bit_in_every_unit() {
        let odd = Dimension { mass: 1.0, length: 0.5, time: -1.5 };
        for dimension in [d::LENGTH, d::STIFFNESS, d::ROTATIONAL_DAMPING, d::AREA, d::NONE, odd] {
            for x in [0.1 + 0.2, -1e300, 3e-310, 1e21, 2.0] {
                let text = written(x, dimension);
                let back = trilith::model::quantity(&text, dimension);
                assert_eq!(back.map(f64::to_bits), Ok(x.to_bits()), "{text}");
            }
        }
    }
}
