//! Bytes as a text of 85 digits: a fifth longer than the bytes, where base 64 is a third.
//!
//! The code of ASCII85 with an alphabet like that of Z85 (ZeroMQ RFC 32): no quote, no backslash, and none of the three
//! characters that HTML reads.

/// The digits.
pub(crate) const DIGITS: &str =
    "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-:+=^!/*?_,;()[]{}@%$#";

/// Four bytes in five digits, the most significant first; of the last ones, one digit more than bytes.
pub(crate) fn digits(bytes: &[u8]) -> String {
    let mut out = String::with_capacity(bytes.len() / 4 * 5 + 5);
    for block in bytes.chunks(4) {
        let mut word = [0; 4];
        word[..block.len()].copy_from_slice(block);
        let word = u32::from_be_bytes(word);
        let digit = |k: u32| char::from(DIGITS.as_bytes()[(word / 85u32.pow(4 - k) % 85) as usize]);
        out.extend((0..=block.len() as u32).map(digit));
    }
    out
}

/// The bytes again, as the page reads them.
#[cfg(test)]
pub(crate) fn bytes(text: &str) -> Vec<u8> {
    let value = |c: u8| DIGITS.bytes().position(|d| d == c).unwrap() as u64;
    let mut out = Vec::new();
    for block in text.as_bytes().chunks(5) {
        let digit = |k: usize| block.get(k).map_or(84, |c| value(*c));
        let word = (0..5).fold(0, |word, k| 85 * word + digit(k));
        out.extend_from_slice(&(word as u32).to_be_bytes()[..block.len() - 1]);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_of_any_length_come_back() {
        let all: Vec<u8> = (0..=255).chain((0..=255).rev()).chain([255; 9]).collect();
        for n in 0..all.len() {
            let text = digits(&all[all.len() - n..]);
            assert_eq!(bytes(&text), all[all.len() - n..], "{n} bytes");
            assert!(!text.contains(['<', '>', '&', '"', '\'', '\\']));
        }
    }

    /// The example of RFC 32, whose digits are among those that both alphabets have.
    #[test]
    fn the_example_of_the_code_is_met() {
        assert_eq!(digits(&[0x86, 0x4f, 0xd2, 0x6f, 0xb5, 0x59, 0xf7, 0x5b]), "HelloWorld");
    }
}
