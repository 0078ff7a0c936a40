//! How wide vectors of the processor may be: `TRILITH_VECTORS`, which the last bits of a result hang on.

use crate::Failure;

const NAME: &str = "TRILITH_VECTORS";

/// What is asked for, where anything is.
pub(crate) fn asked() -> Option<String> {
    std::env::var_os(NAME).map(|v| v.to_string_lossy().into_owned())
}

/// Refuses what nothing would follow.
pub(crate) fn check() -> Result<(), Failure> {
    match asked().as_deref() {
        None | Some("none" | "256") => Ok(()),
        Some(other) => {
            let message = format!("the environment variable {NAME} is `{other}`");
            let help = "it must be `none` (no vectors) or `256` (no wider ones than of 256 bits), or not be set";
            Err(Failure::input(&message, Some(help)))
        }
    }
}
