//! SHA-256 of files and of what they say.

use serde_json::Value;
use sha2::{Digest, Sha256};

/// SHA-256 of bytes, hexadecimal.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect()
}

/// SHA-256 of a JSON value without some of its outermost keys, hexadecimal. It hangs on no order of keys and on no
/// blanks, and numbers count to the last bit.
#[must_use]
pub fn sha256_of_json(value: &Value, without: &[&str]) -> String {
    let mut text = String::new();
    write(value, without, &mut text);
    sha256(text.as_bytes())
}

fn write(value: &Value, without: &[&str], text: &mut String) {
    match value {
        Value::Object(map) => {
            let mut all: Vec<(&String, &Value)> = map.iter().collect();
            all.sort_by_key(|(key, _)| *key);
            text.push('{');
            for (key, value) in all.into_iter().filter(|(key, _)| !without.contains(&key.as_str()))
            {
                *text += &Value::from(key.as_str()).to_string();
                text.push(':');
                write(value, &[], text);
                text.push(',');
            }
            text.push('}');
        }
        Value::Array(items) => {
            text.push('[');
            for item in items {
                write(item, &[], text);
                text.push(',');
            }
            text.push(']');
        }
        plain => *text += &plain.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn bytes_have_the_published_digest() {
        // FIPS 180-2, appendix B.1.
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256(b"abc"), abc);
    }

    #[test]
    fn the_order_of_keys_does_not_count_and_the_last_bit_does() {
        let of = |text: &str| {
            let value: Value = serde_json::from_str(text).unwrap();
            sha256_of_json(&value, &["work"])
        };
        let plain = of(r#"{"a": [0.1, -0.0, "x"], "b": {"work": 1}}"#);
        assert_eq!(plain, of(r#"{"b":{"work":1},"work":7,"a":[0.1,-0.0,"x"]}"#));
        for other in [
            r#"{"a": [0.10000000000000002, -0.0, "x"], "b": {"work": 1}}"#,
            r#"{"a": [0.1, 0.0, "x"], "b": {"work": 1}}"#,
            r#"{"a": [0.1, -0.0, "y"], "b": {"work": 1}}"#,
            r#"{"a": [0.1, -0.0, "x"], "b": {"work": 2}}"#,
            r#"{"a": [0.1, -0.0, "x"]}"#,
        ] {
            assert_ne!(plain, of(other), "{other}");
        }
    }

    #[test]
    fn what_is_written_and_read_again_has_the_same_digest() {
        let value = json!({ "x": 0.1 + 0.2, "least": 1e-310, "whole": 5.0, "n": 7, "none": null });
        let again: Value = serde_json::from_str(&value.to_string()).unwrap();
        assert_eq!(sha256_of_json(&value, &[]), sha256_of_json(&again, &[]));
    }
}
