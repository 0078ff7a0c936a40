//! Pages in the browser of whoever runs the program.

use crate::text::shown;
use crate::{Failure, output};
use std::path::Path;

/// Opens a page where that is wanted. What was found is there without a browser as well.
pub(crate) fn show(wanted: bool, page: &Path) {
    if !wanted {
        return;
    }
    if let Err(failure) = open(page, "") {
        output::tell(&failure.text);
    }
}

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
        // Windows has backslashes, letters of drives, and a prefix of its own for whole paths.
        let path =
            if cfg!(windows) { path.trim_start_matches(r"\\?\").replace('\\', "/") } else { path };
        format!("file:///{}{place}", path.trim_start_matches('/')).into()
    };
    open::that_detached(target).map_err(|e| told(&e))
}
