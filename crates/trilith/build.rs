//! Sets `TRILITH_BUILD`, a digest of the sources: two programs that may compute differently do not pass for one.
//!
//! In the workspace it goes over all crates that a result is made by and over the versions of their dependencies. A
//! crate that was packaged stands alone: there it goes over the crate itself, and the others are fixed by their
//! versions.

use std::fs;
use std::io::{Error, Result};
use std::path::{Path, PathBuf};

/// Parts of the workspace that results hang on.
const PARTS: [&str; 12] = [
    "crates/element",
    "crates/foreign",
    "crates/linalg",
    "crates/model",
    "crates/record",
    "crates/report",
    "crates/results",
    "crates/solvers",
    "crates/study",
    "crates/system",
    "crates/trilith",
    "elements",
];

/// What counts of each: tests beside the sources do not.
const OF_PART: [&str; 3] = ["Cargo.toml", "build.rs", "src"];

fn main() -> Result<()> {
    let own = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let own = own.ok_or_else(|| Error::other("CARGO_MANIFEST_DIR is not set: cargo runs this"))?;
    let workspace = own.join("../..");
    let whole = PARTS.iter().all(|part| workspace.join(part).join("Cargo.toml").is_file());
    let mut files = Vec::new();
    if whole {
        for part in PARTS {
            let folder = workspace.join(part);
            OF_PART.iter().try_for_each(|name| add(&folder.join(name), part, &mut files))?;
        }
        for name in ["Cargo.toml", "Cargo.lock"] {
            add(&workspace.join(name), "", &mut files)?;
        }
    } else {
        OF_PART.iter().try_for_each(|name| add(&own.join(name), "", &mut files))?;
    }
    files.sort();
    let mut digest = Fnv::default();
    for (name, path) in &files {
        let mut text = fs::read(path)?;
        // A checkout with other line ends is the same code.
        text.retain(|b| *b != b'\r');
        digest.add(name.as_bytes());
        digest.add(&[0]);
        digest.add(&(text.len() as u64).to_le_bytes());
        digest.add(&text);
    }
    println!("cargo::rustc-env=TRILITH_BUILD={:016x}", digest.0);
    Ok(())
}

/// Lists a file, or all files of a folder, as (name inside the workspace with `/`, path); what is not there is left
/// out.
fn add(path: &Path, inside: &str, files: &mut Vec<(String, PathBuf)>) -> Result<()> {
    let Some(name) = path.file_name().map(|name| name.to_string_lossy().into_owned()) else {
        return Ok(());
    };
    // Of editors.
    if name.starts_with('.') || name.ends_with('~') || !path.exists() {
        return Ok(());
    }
    let name = format!("{inside}/{name}");
    if path.is_dir() {
        // Seen again when anything inside changes, comes or goes.
        println!("cargo::rerun-if-changed={}", path.display());
        for entry in fs::read_dir(path)? {
            add(&entry?.path(), &name, files)?;
        }
    } else {
        println!("cargo::rerun-if-changed={}", path.display());
        files.push((name, path.to_owned()));
    }
    Ok(())
}

/// The digest FNV-1a with 64 bits. Nobody forges a build, and it needs no other crate.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}
