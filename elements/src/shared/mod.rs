//! What several kinds share: pieces of laws, of matrices and of reading.

pub(crate) mod biaxial;
pub(crate) mod bouc_wen_plane;
pub(crate) mod dense;
#[cfg(test)]
mod derivatives;
pub(crate) mod dual;
pub(crate) mod lever;
pub(crate) mod multilinear;
pub(crate) mod parameters;
#[cfg(test)]
pub(crate) mod paths;
pub(crate) mod plane;
pub(crate) mod plane_contact;
pub(crate) mod relaxation;
pub(crate) mod restitution;
pub(crate) mod rotation;
pub(crate) mod series;
pub(crate) mod sliding;
pub(crate) mod spatial;
pub(crate) mod touch;
pub(crate) mod two_bodies;
pub(crate) mod wrench;
pub(crate) mod written;
