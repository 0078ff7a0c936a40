//! Laws that are made at run time: of a shared library, of an address, of a function in another language.
//!
//! A [`Declaration`] says what a law is called and takes, as the card of a kind does; a [`LawFunction`] answers for it.
//! Together they are a [`Kind`], which a registry takes as it takes the built-in ones, and whose links are [`CalledLaw`]s:
//!
//! | function | is |
//! |---|---|
//! | [`Library`] | laws of a shared library that fulfils `include/trilith_link.h`, the contract in C |
//! | [`Compiled`] | machine code by its address, such as a just-in-time compiler makes, with the same function in plain words for its errors |
//! | any other | what the application implements, such as a callback into an interpreter |
//!
//! What a law does not tell is found here, once for all of them: tangents by [central differences](CalledLaw), the energy as
//! [work that is counted as heat](CalledLaw), the engaged stiffness as the diagonal of the tangent at rest.
//!
//! ```no_run
//! use trilith_foreign::Library;
//! use trilith_model::Registry;
//!
//! let mut kinds = Registry::new();
//! for kind in Library::open("./libmine.so".as_ref())? {
//!     kind.register(&mut kinds);
//! }
//! # Ok::<(), trilith_foreign::ForeignError>(())
//! ```
//!
//! All that is unsafe is in `abi.rs`: calls through pointers, and what the tables of a library say.

mod abi;
mod called;
mod card;
mod declaration;
mod error;
mod function;
mod kind;
mod library;
#[cfg(test)]
mod tests;

pub use abi::{Compiled, RespondFunction};
pub use called::CalledLaw;
pub use declaration::{
    Declaration, DeclaredField, DeclaredParameter, DeclaredRange, DeclaredValue,
};
pub use error::{DeclarationError, ForeignError};
pub use function::{LawFunction, NoAnswer, Sizes};
pub use kind::Kind;
pub use library::Library;

/// The contract in C: the text of `trilith_link.h`.
pub const HEADER: &str = include_str!("../include/trilith_link.h");
