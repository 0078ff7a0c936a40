//! `trilith lsp`.

use crate::{Answer, Failure};
use trilith::Registry;

/// Answers an editor until it says `exit`.
pub(crate) fn lsp(registry: &Registry) -> Result<Answer, Failure> {
    match trilith_lsp::serve(registry, std::io::stdin(), std::io::stdout()) {
        // As the protocol wants it: 1 where the editor has not said `shutdown` before.
        Ok(orderly) => Ok(Answer { text: String::new(), status: i32::from(!orderly) }),
        Err(error) => Err(Failure::input(
            &format!("no conversation with an editor: {error}"),
            Some(
                "`trilith lsp` is started by an editor, which speaks the Language Server Protocol with it",
            ),
        )),
    }
}
