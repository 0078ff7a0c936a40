//! The way out of everything that the program says.

use crate::diagnostics;
use std::io::{Error, ErrorKind, Write};
use trilith::model::visible;

/// Exit status where an answer was found and could not be printed.
const UNPRINTED: i32 = 1;

/// Prints an answer on stdout. The status to end with: the given one, or another where the answer did not arrive.
pub(crate) fn print(text: &str, status: i32) -> i32 {
    let mut out = std::io::stdout().lock();
    let printed = out.write_all(visible(text).as_bytes()).and_then(|()| out.flush());
    drop(out);
    ended(printed, status)
}

/// Says something on stderr.
pub(crate) fn tell(text: &str) {
    // Where stderr takes nothing there is nobody to be told so.
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}

/// Prints help and version as an answer, and tells wrong arguments. The status to end with.
pub(crate) fn usage(said: &clap::Error) -> i32 {
    let status = said.exit_code();
    if !said.use_stderr() {
        return ended(said.print().and_then(|()| std::io::stdout().flush()), status);
    }
    let obeyed = |arg: std::ffi::OsString| {
        let arg = arg.to_string_lossy();
        visible(&arg) != arg
    };
    if std::env::args_os().any(obeyed) {
        // Without colours: among them what the arguments hold could not be told apart.
        tell(&visible(&said.render().to_string()));
    } else {
        // As in `tell`.
        let _ = said.print();
    }
    status
}

/// The status to end with after printing.
fn ended(printed: Result<(), Error>, status: i32) -> i32 {
    match printed {
        // A reader that has gone away (`trilith … | head`) is no error.
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            let message = format!("the answer cannot be printed: {e}");
            tell(&diagnostics::plain(&message, None));
            if status == 0 { UNPRINTED } else { status }
        }
        _ => status,
    }
}
