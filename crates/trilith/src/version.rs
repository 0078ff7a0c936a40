//! What the program is.

/// Version.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Build, sixteen hexadecimal digits: a digest of the sources that Trilith is made from, the versions of its
/// dependencies included. Equal sources have equal builds on any machine. Links of other crates do not count.
pub const BUILD: &str = env!("TRILITH_BUILD");

/// Both, as `trilith --version` prints them.
pub const LONG_VERSION: &str =
    concat!(env!("CARGO_PKG_VERSION"), " (build ", env!("TRILITH_BUILD"), ")");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_build_is_sixteen_digits() {
        assert!(BUILD.len() == 16 && BUILD.bytes().all(|b| b.is_ascii_hexdigit()), "{BUILD}");
        assert_eq!(LONG_VERSION, format!("{VERSION} (build {BUILD})"));
    }
}
