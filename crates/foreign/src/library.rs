//! Shared libraries of laws.

use crate::abi::{self, Table};
use crate::error::ForeignError;
use crate::kind::Kind;
use dlopen2::raw;
use std::path::Path;
use std::sync::Arc;

/// Most laws of a library: a list that does not end is no list.
const MOST: usize = 1000;

/// A shared library that exports laws as `trilith_link.h` says. It stays open as long as one of its laws is there.
pub struct Library;

impl Library {
    /// Opens a library; its kinds, in its order. The path is that of a file: none of the places is looked at where the system
    /// keeps libraries.
    ///
    /// What a library does is beyond all checks: opening it runs its code, as starting a program does.
    ///
    /// # Errors
    /// [`ForeignError`] where it cannot be opened or is no library of laws, or one of its laws cannot be.
    pub fn open(path: &Path) -> Result<Vec<Kind>, ForeignError> {
        let open = |e: dlopen2::Error| ForeignError::Open { path: path.into(), why: e.to_string() };
        // A name alone would be looked for elsewhere.
        let file = if path.is_absolute() { path.into() } else { Path::new(".").join(path) };
        let library = Arc::new(raw::Library::open(&file).map_err(open)?);
        let no_laws = || ForeignError::NoLaws { path: path.into() };
        let list = abi::exported(&library).ok_or_else(no_laws)?;
        let mut kinds = Vec::new();
        for index in 0..MOST {
            let table = |why: String| ForeignError::Table { path: path.into(), index, why };
            let Some(Table { declaration, function }) = list.at(index).map_err(table)? else {
                break;
            };
            let kind = Kind::new(&declaration, Arc::new(function));
            let wrong = |e| ForeignError::Declaration { path: path.into(), error: Box::new(e) };
            kinds.push(kind.map_err(wrong)?);
        }
        if kinds.is_empty() { Err(no_laws()) } else { Ok(kinds) }
    }
}
