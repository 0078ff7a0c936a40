//! File URIs as paths, and back.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use lsp_types::Uri;

const SCHEME: &str = "file://";

/// The path of a file; of a text that is no file yet, a name in no folder.
pub(crate) fn path(uri: &Uri) -> PathBuf {
    let text = uri.as_str();
    let Some(rest) = text.strip_prefix(SCHEME) else {
        return PathBuf::from("untitled.ron");
    };
    // A host, which is hardly ever given.
    let path = rest.find('/').map_or(rest, |i| &rest[i..]);
    let path = decoded(path);
    // `/C:/folder` of Windows.
    let drive = path.as_bytes().get(2) == Some(&b':') && cfg!(windows);
    PathBuf::from(if drive { &path[1..] } else { &path })
}

fn decoded(text: &str) -> String {
    let text = text.as_bytes();
    let mut bytes = Vec::with_capacity(text.len());
    let mut at = 0;
    while let Some(&b) = text.get(at) {
        let digits = text.get(at + 1..at + 3).filter(|_| b == b'%');
        let digits = digits.and_then(|digits| std::str::from_utf8(digits).ok());
        match digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                at += 3;
            }
            None => {
                bytes.push(b);
                at += 1;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The URI of a file; none where the path cannot be one.
pub(crate) fn of_path(path: &Path) -> Option<Uri> {
    let path = std::path::absolute(path).ok()?;
    let text = path.to_str()?.replace('\\', "/");
    let mut uri = format!("{SCHEME}{}", if text.starts_with('/') { "" } else { "/" });
    for b in text.bytes() {
        if b.is_ascii_alphanumeric() || b"/-._~".contains(&b) {
            uri.push(char::from(b));
        } else {
            let _ = write!(uri, "%{b:02X}");
        }
    }
    Uri::from_str(&uri).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn paths_come_back() {
        for text in ["/a/fuß 🦶.ron", "/a b/100%.ron", "/a/#1?.ron"] {
            let uri = of_path(Path::new(text)).unwrap();
            assert_eq!(path(&uri), Path::new(text), "{}", uri.as_str());
        }
        let uri = Uri::from_str("file:///a/b%20c.ron").unwrap();
        assert_eq!(path(&uri), Path::new("/a/b c.ron"));
        let uri = Uri::from_str("untitled:Untitled-1").unwrap();
        assert_eq!(path(&uri), Path::new("untitled.ron"));
    }
}
