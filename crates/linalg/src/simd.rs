//! The widest vectors that the processor has.

use pulp::{Arch, Scalar, WithSimd};

/// Runs a task with them. The task is a type of its own: a closure in its place would not be compiled for them.
#[inline(always)]
pub(crate) fn dispatch<T: WithSimd>(task: T) -> T::Output {
    match Arch::new() {
        Arch::Scalar => without(task),
        wide => wide.dispatch(task),
    }
}

/// Of a processor without any; apart from its caller, which else saved registers for it on every call.
#[cold]
#[inline(never)]
fn without<T: WithSimd>(task: T) -> T::Output {
    task.with_simd(Scalar::new())
}
