//! A tolerant look at the text of a model: blocks, their entries, and where the cursor is among them.
//!
//! While a text is typed it is no RON: brackets are open, quotes lack their end, commas are missing. So nothing is refused here.
//! What the reader of models would do with the text is not asked.
//!
//! - A text in plain quotes without an end ends with its line.
//! - An entry `"name": …` belongs to a map and `field: …` to parentheses: where one stands in another bracket, that bracket was
//!   not closed, and is from there on.

mod tokens;
mod tree;

#[cfg(test)]
mod tests;

pub(crate) use tokens::Span;
pub(crate) use tree::{Block, Bracket, Entry, ROOT, Tree, Value};
