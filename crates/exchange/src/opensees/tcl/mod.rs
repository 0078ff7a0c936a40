//! A small Tcl: enough for scripts that build models, and nothing that reaches out of their folder.

mod control;
mod expr;
mod files;
mod functions;
mod interpreter;
mod lists;
mod parse;
mod strings;
mod value;
mod variables;

pub use files::within;
pub use interpreter::{Call, Host, Interpreter, Reply, Settings};
pub use value::{Number, Value};
