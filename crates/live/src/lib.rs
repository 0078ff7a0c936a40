//! The engine in a page: runs, parameters and messages of a model for a browser that has neither files nor network.
//!
//! [`answer`] takes a question as JSON and gives an answer as JSON. Compiled for WebAssembly, its library has a memory
//! for both, which the page writes to and reads from (`exports`). [`page`] makes the page: the model, the files that it
//! reads, and the engine.

mod answer;
mod digits;
mod draft;
#[cfg(target_family = "wasm")]
mod exports;
mod page;

pub use answer::answer;
pub use page::{AnyModel, Live, page};
