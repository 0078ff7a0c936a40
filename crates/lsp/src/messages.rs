//! Messages of a stream: a head with the length of each, and its JSON.

use lsp_server::Message;
use std::io::{BufRead, Read};

/// Bytes of the longest message that is read, 64 MiB.
const MOST: usize = 64 << 20;
/// Bytes of the longest line of a head, and lines of the longest head.
const LINE: usize = 4096;
const LINES: usize = 64;

/// What ends a conversation early.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MessageError {
    /// The stream itself.
    #[error("the client cannot be heard: {0}")]
    Stream(#[from] std::io::Error),
    /// A head that is none.
    #[error(
        "the head of a message is damaged: {0}; it should be `Content-Length: N` and an empty line"
    )]
    Head(String),
    /// More than is read.
    #[error("a message of {bytes} bytes is too long: at most {MOST} are read")]
    TooLong {
        /// As its head says.
        bytes: u64,
    },
    /// The stream ended within a message.
    #[error("the stream ended within a message, {missing} bytes before its end")]
    Cut {
        /// Bytes that did not come.
        missing: usize,
    },
    /// What is no message of JSON-RPC.
    #[error("a message is none of JSON-RPC: {0}")]
    Json(#[from] serde_json::Error),
    /// The client has gone away without a word.
    #[error("the stream ended before `exit` came")]
    Gone,
}

/// The next message; none at the end of the stream.
///
/// # Errors
/// A message that cannot be read: what follows it cannot be found.
pub(crate) fn read(stream: &mut impl BufRead) -> Result<Option<Message>, MessageError> {
    let Some(length) = head(stream)? else { return Ok(None) };
    // As it comes: a length that is only said takes no memory.
    let mut body = Vec::new();
    (&mut *stream).take(length as u64).read_to_end(&mut body)?;
    if body.len() < length {
        return Err(MessageError::Cut { missing: length - body.len() });
    }
    Ok(Some(serde_json::from_slice(&body)?))
}

/// The length that a head tells; none at the end of the stream.
fn head(stream: &mut impl BufRead) -> Result<Option<usize>, MessageError> {
    let mut length = None;
    for n in 0..LINES {
        let mut line = Vec::new();
        (&mut *stream).take(LINE as u64).read_until(b'\n', &mut line)?;
        if line.is_empty() && n == 0 {
            return Ok(None);
        }
        let damaged = |line: &[u8]| {
            let few: String = String::from_utf8_lossy(line).chars().take(60).collect();
            MessageError::Head(format!("{few:?}"))
        };
        let Some(text) = line.strip_suffix(b"\n").and_then(|l| std::str::from_utf8(l).ok()) else {
            return Err(damaged(&line));
        };
        let text = text.trim_end_matches('\r');
        if text.is_empty() {
            return length.map(Some).ok_or_else(|| MessageError::Head("it tells no length".into()));
        }
        let Some((name, value)) = text.split_once(':') else { return Err(damaged(&line)) };
        if name.eq_ignore_ascii_case("Content-Length") {
            let bytes: u64 = value.trim().parse().map_err(|_| damaged(&line))?;
            let fits = usize::try_from(bytes).ok().filter(|n| *n <= MOST);
            length = Some(fits.ok_or(MessageError::TooLong { bytes })?);
        }
    }
    Err(MessageError::Head(format!("it has more than {LINES} lines")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(bytes: &[u8]) -> String {
        match read(&mut &bytes[..]) {
            Ok(Some(message)) => format!("{message:?}"),
            Ok(None) => "end".into(),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn damaged_messages_are_told() {
        let right = b"content-length: 33\r\nX: y\r\n\r\n{\"jsonrpc\":\"2.0\",\"method\":\"exit\"}";
        assert!(told(right).contains("exit"), "{}", told(right));
        let deep = format!("{{\"method\":\"a\",\"params\":{}", "[".repeat(100_000));
        let deep = format!("Content-Length: {}\r\n\r\n{deep}", deep.len());
        for (bytes, part) in [
            (&b""[..], "end"),
            (b"Content-Length: 5\r\n\r\n{}", "3 bytes before its end"),
            (b"Content-Length: 2\r\n\r\n{}", "none of JSON-RPC"),
            (b"Content-Length: 4\r\n\r\n\xff\xff\xff\xff", "none of JSON-RPC"),
            (b"Content-Length: -1\r\n\r\n", "damaged"),
            (b"Content-Length: 99999999999\r\n\r\n{", "99999999999 bytes is too long"),
            (b"Content-Length: 99999999999999999999999\r\n\r\n{", "damaged"),
            (b"GET / HTTP/1.1\r\n\r\n", "damaged"),
            (b"\r\n\r\n", "tells no length"),
            (deep.as_bytes(), "none of JSON-RPC"),
            (&[b'a'; 10_000], "damaged"),
            ("a: b\n".repeat(100).as_bytes(), "more than 64 lines"),
        ] {
            let told = told(bytes);
            assert!(told.contains(part), "{part}: {told}");
        }
    }
}
