//! Pages in the browser of whoever runs the program.

use crate::Failure;
use crate::text::shown;
use std::path::Path;

/// Opens a page, at a place in it (`#…`) where one is given.
///
/// # Errors
/// Where there is no browser.
pub(crate) fn open(page: &Path, place: &str) -> Result<(), Failure> {
    let told = |e: &dyn std::fmt::Display| {
        Failure::input(&format!("{} cannot be opened: {e}", shown(page)), Some("open it by hand"))
    };
    let whole = std::fs::canonicalize(page).map_err(|e| told(&e))?;
    let target = if place.is_empty() {
        whole.into_os_string()
    } else {
        // What ends a path in an address, or begins an escape in it.
        let path =
            whole.to_string_lossy().replace('%', "%25").replace('#', "%23").replace('?', "%3F");
        format!("file://{path}{place}").into()
    };
    open::that_detached(target).map_err(|e| told(&e))
}
