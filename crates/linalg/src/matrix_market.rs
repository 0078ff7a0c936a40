//! Matrix Market export, for use in other programs.

use crate::Sparse;

/// The matrix as a Matrix Market text (`general`, coordinates).
///
/// # Errors
/// Where the writer fails.
pub fn matrix_market(a: &Sparse) -> std::io::Result<String> {
    let mut bytes = Vec::new();
    sprs::io::write_matrix_market_to_bufwrite(&mut bytes, &a.to_sprs())?;
    String::from_utf8(bytes).map_err(std::io::Error::other)
}
