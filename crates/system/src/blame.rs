//! Whose law panicked.
//!
//! A law that panics unwinds through the solver. Who catches that wants the name of the link; so each is asked under a
//! guard that is forgotten when the law answers, and does something on the way of a panic alone: a question costs
//! nothing more.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use trilith_element::LawFailed;

thread_local! {
    static BLAMED: Cell<Option<usize>> = const { Cell::new(None) };
}

/// Takes note of the element in whose law a panic began.
struct Blame(usize);

impl Drop for Blame {
    fn drop(&mut self) {
        BLAMED.set(Some(self.0));
    }
}

/// Asks the law of an element (its index in the model): a panic there is [caught](catch) with it.
#[inline(always)]
pub fn blaming<T>(element: usize, ask: impl FnOnce() -> T) -> T {
    let blame = Blame(element);
    let answer = ask();
    std::mem::forget(blame);
    answer
}

/// A panic in a law: the element, and what it said.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Panicked {
    /// Index of the element in the model.
    pub element: usize,
    /// What the panic said.
    pub message: String,
    /// True where the law told what is wrong by [`LawFailed`].
    pub told: bool,
}

/// Runs what asks laws; a panic in one of them is an error. Any other panic goes on.
///
/// # Errors
/// [`Panicked`] where a law that was asked by [`blaming`] panicked.
pub fn catch<T>(run: impl FnOnce() -> T) -> Result<T, Panicked> {
    BLAMED.set(None);
    catch_unwind(AssertUnwindSafe(run)).map_err(|payload| match BLAMED.take() {
        Some(element) => {
            let told = payload.is::<LawFailed>();
            Panicked { element, message: said(&*payload), told }
        }
        None => resume_unwind(payload),
    })
}

/// What an element or a constraint answers, or what its panic said.
pub(crate) fn answered<T>(ask: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(ask)).map_err(|payload| said(&*payload))
}

/// What a panic said.
fn said(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    let text = text.or_else(|| payload.downcast_ref::<LawFailed>().map(|told| told.0.as_str()));
    text.unwrap_or("a panic without a message").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_in_a_law_is_caught_with_its_element_and_others_go_on() {
        assert_eq!(catch(|| blaming(3, || 7)), Ok(7));
        let deep = catch(|| blaming(3, || Vec::<f64>::new()[2]));
        let Err(Panicked { element: 3, message, told: false }) = deep else { panic!("{deep:?}") };
        assert!(message.contains("index out of bounds"), "{message}");
        let told = || resume_unwind(Box::new(LawFailed("torn".into())));
        let failed = Panicked { element: 4, message: "torn".into(), told: true };
        assert_eq!(catch(|| blaming(4, || -> () { told() })), Err(failed));
        // One who was asked before and answered is not to blame.
        let other = catch_unwind(|| {
            catch(|| {
                blaming(3, || ());
                panic!("of ours")
            })
        });
        assert_eq!(said(&*other.unwrap_err()), "of ours");
    }
}
