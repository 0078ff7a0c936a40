//! The widest vectors that the processor has, or that it may use.
//!
//! Sums are in another order for every width, so the last bits of a result are those of the width.
//! `TRILITH_VECTORS` caps it: `none`, or `256` (bits); tests run with these as well. The matrix backend chooses its own.

use pulp::{Arch, Scalar, Simd, WithSimd};
use std::sync::OnceLock;

/// Runs a task with them. The task is a type of its own: a closure in its place would not be compiled for them.
#[inline(always)]
pub(crate) fn dispatch<T: WithSimd>(task: T) -> T::Output {
    static CHOSEN: OnceLock<Arch> = OnceLock::new();
    match CHOSEN.get_or_init(chosen) {
        Arch::Scalar => without(task),
        wide => wide.dispatch(task),
    }
}

/// The widest that the processor has, and that the environment allows.
#[cold]
fn chosen() -> Arch {
    match std::env::var("TRILITH_VECTORS").as_deref() {
        Ok("none") => Arch::Scalar,
        #[cfg(target_arch = "x86_64")]
        Ok("256") => pulp::x86::V3::try_new().map_or(Arch::Scalar, Arch::V3),
        _ => Arch::new(),
    }
}

/// Of a processor without any; apart from its caller, which else saved registers for it on every call.
#[cold]
#[inline(never)]
fn without<T: WithSimd>(task: T) -> T::Output {
    task.with_simd(Scalar::new())
}

/// Width of the vectors that sums go by, and of the widest that the processor has, which the matrix backend goes by, both
/// in bits: results of the same widths are the same to the bit.
#[must_use]
pub fn vectors() -> [usize; 2] {
    struct Width;
    impl WithSimd for Width {
        type Output = usize;
        fn with_simd<S: Simd>(self, _: S) -> usize {
            8 * size_of::<S::f64s>()
        }
    }
    [dispatch(Width), Arch::new().dispatch(Width)]
}
