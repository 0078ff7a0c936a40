//! Laws of shared libraries, `--laws`.

use crate::Failure;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use trilith::Registry;
use trilith::results::sha256;
use trilith_foreign::{ForeignError, Library};

/// The libraries of this process: they belong to what made its results, as the command line does.
static OPENED: OnceLock<Vec<PathBuf>> = OnceLock::new();

/// The registry with the laws of these libraries.
pub(crate) fn taken(mut registry: Registry, libraries: Vec<PathBuf>) -> Result<Registry, Failure> {
    for path in &libraries {
        let kinds = Library::open(path).map_err(|e| refused(&e))?;
        for kind in kinds {
            let name = kind.card().kind;
            if registry.card(name).is_some() {
                let message = format!(
                    "the library {} has a law `{name}`, and there is a kind of that name",
                    path.display()
                );
                return Err(Failure::input(&message, Some("each kind needs a name of its own")));
            }
            kind.register(&mut registry);
        }
    }
    OPENED.get_or_init(|| libraries);
    Ok(registry)
}

/// The libraries whose laws were taken.
pub(crate) fn opened() -> &'static [PathBuf] {
    OPENED.get().map_or(&[], Vec::as_slice)
}

/// SHA-256 of all that they hold, to go behind the build of the program; empty where there are none.
pub(crate) fn digest() -> Result<String, Failure> {
    let mut sums = String::new();
    for path in opened() {
        sums += &sha256(&read(path)?);
    }
    Ok(if sums.is_empty() { sums } else { format!("+{}", sha256(sums.as_bytes())) })
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let unreadable = |e| Failure::input(&format!("{} cannot be read: {e}", path.display()), None);
    std::fs::read(path).map_err(unreadable)
}

fn refused(error: &ForeignError) -> Failure {
    let help = match error {
        ForeignError::Open { .. } => {
            "`--laws` names a shared library, such as ./libmine.so, made for this machine"
        }
        ForeignError::Declaration { .. } => "the tables of the library say what its laws take",
        _ => "it is to be compiled with `trilith_link.h` of this version",
    };
    Failure::input(&error.to_string(), Some(help))
}
