//! What the page calls: a memory for a question, and one for the answer.
//!
//! The page asks for room, writes the question there as UTF-8, asks, and reads as many bytes of the answer as it is told.

use std::sync::{Mutex, MutexGuard, PoisonError};

static QUESTION: Mutex<Vec<u8>> = Mutex::new(Vec::new());
static ANSWER: Mutex<Vec<u8>> = Mutex::new(Vec::new());

fn of(memory: &'static Mutex<Vec<u8>>) -> MutexGuard<'static, Vec<u8>> {
    memory.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Where the question goes, which has so many bytes.
// A name is unsafe where two of one name meet: there are no other libraries here.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *mut u8 {
    let mut question = of(&QUESTION);
    question.clear();
    question.resize(bytes, 0);
    question.as_mut_ptr()
}

/// Answers the question: the number of bytes of the answer.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn ask() -> usize {
    let question = String::from_utf8_lossy(&of(&QUESTION)).into_owned();
    // What a panic says is the answer: the page reads it after the trap.
    std::panic::set_hook(Box::new(|info| *of(&ANSWER) = info.to_string().into_bytes()));
    let answer = crate::answer(&question);
    let mut memory = of(&ANSWER);
    *memory = answer.into_bytes();
    memory.len()
}

/// Where the answer is.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn answer_at() -> *const u8 {
    of(&ANSWER).as_ptr()
}

/// How many bytes the answer has.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn answer_bytes() -> usize {
    of(&ANSWER).len()
}
