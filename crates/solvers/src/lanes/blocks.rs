//! Tangents of all links: the blocks ∂f/∂d or ∂f/∂ḋ, one behind the other.

use super::small::Aligned;
use std::ops::Range;

/// A row for each of `L` link coordinates. Rows have as many numbers as the widest link has coordinates, `N` at most, and
/// no room between them: laws write the blocks of several links at once.
#[derive(Clone, Copy)]
pub(super) struct Blocks<R: Copy, const N: usize, const L: usize>(Aligned<[[R; N]; L]>);

impl<R: Copy, const N: usize, const L: usize> Blocks<R, N, L> {
    /// The same in all places.
    pub fn filled(x: R) -> Self {
        Self(Aligned::full_of(x))
    }

    /// The row of a coordinate, of `n` numbers.
    #[inline(always)]
    pub fn row(&self, n: usize, a: usize) -> &[R] {
        self.rows(n, a..a + 1)
    }

    /// The number that a coordinate has for itself.
    #[inline(always)]
    pub fn own(&self, n: usize, a: usize) -> R {
        self.row(n, a)[a % n]
    }

    /// The rows of some coordinates.
    #[inline(always)]
    pub fn rows(&self, n: usize, of: Range<usize>) -> &[R] {
        &self.0.as_flattened()[of.start * n..of.end * n]
    }

    /// The same, to be written.
    #[inline(always)]
    pub fn rows_mut(&mut self, n: usize, of: Range<usize>) -> &mut [R] {
        &mut self.0.as_flattened_mut()[of.start * n..of.end * n]
    }
}
