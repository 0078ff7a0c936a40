//! Sets `TRILITH_MODELS`, the folder of the models that `trilith new` begins with: that of the workspace, or, in a crate that
//! was packaged, the copy that its link `models` has become.

use std::io::{Error, Result};
use std::path::PathBuf;

fn main() -> Result<()> {
    let own = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let own = own.ok_or_else(|| Error::other("CARGO_MANIFEST_DIR is not set: cargo runs this"))?;
    let folders = ["../../models", "models"].map(|folder| own.join(folder));
    let [folder, _] = &folders;
    let found = folders.iter().find(|f| f.join("rigid_block.ron").is_file());
    let found = found.ok_or_else(|| Error::other(format!("no models in {}", folder.display())))?;
    println!("cargo::rustc-env=TRILITH_MODELS={}", found.display());
    println!("cargo::rerun-if-changed=build.rs");
    Ok(())
}
