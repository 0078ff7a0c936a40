//! A language server for model files: editors show the errors of the reader while one types, complete names, fields and
//! units, and say what each of them means.
//!
//! The server speaks the [Language Server Protocol](https://microsoft.github.io/language-server-protocol/) of version 3.17
//! over two streams, one message after the other.
//!
//! | file | does |
//! |---|---|
//! | `messages` | messages of a stream, none too long |
//! | `server`, `looking` | what is asked and answered |
//! | `documents` | the texts that are open, and the files of a model |
//! | `check` | errors of the reader, beside the answers |
//! | `scan` | a text that need not be right, as blocks |
//! | `wanted`, `fields`, `place` | what may stand at the cursor, from the schema and the cards |
//! | `complete`, `explain`, `names` | candidates; meanings and definitions |
//! | `position`, `uri` | places and paths as the protocol writes them |

mod check;
mod complete;
mod documents;
mod explain;
mod fields;
mod looking;
mod messages;
mod names;
mod place;
mod position;
mod scan;
mod server;
mod uri;
mod wanted;

#[cfg(test)]
mod tests;

pub use messages::MessageError;
pub use server::serve;
