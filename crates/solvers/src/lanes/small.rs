//! Small matrices, one in each lane.
//!
//! A matrix has room for so many rows and columns, which a march is compiled for. Where the room is small all of it is
//! taken, and loops over it are written out; where it is larger, loops go over what there is of it.

use std::ops::{Deref, DerefMut};
use trilith_element::lanes::Real;

/// Room up to which all of it is taken.
pub(super) const SMALL: usize = 6;

/// How many places of some room are taken, where so many are needed.
#[inline(always)]
pub(super) fn taken<const ROOM: usize>(needed: usize) -> usize {
    if const { ROOM <= SMALL } { ROOM } else { needed.min(ROOM) }
}

/// Sums of rows times coefficients, for `n` places.
#[inline(always)]
pub(super) fn combine<R: Real, const M: usize>(
    n: usize,
    c: &[[R; M]; 4],
    x: [&[R; M]; 4],
) -> [R; M] {
    let mut sum = [c[0][0].of(0.0); M];
    for j in 0..n {
        let first = c[1][j].mul_add(x[1][j], c[0][j] * x[0][j]);
        let second = c[3][j].mul_add(x[3][j], c[2][j] * x[2][j]);
        sum[j] = first + second;
    }
    sum
}

/// Rows that are summed at once where there may be many.
const ROWS: usize = 4;

/// A matrix of so many rows and columns, column by column, times a vector: in two sums, as each waits for its last term.
#[inline(always)]
pub(super) fn times<R: Real, const A: usize, const B: usize>(
    (rows, count): (usize, usize),
    columns: &[[R; A]; B],
    x: &[R; B],
) -> [R; A] {
    if const { A <= SMALL } {
        return sums(0, count, columns, x);
    }
    let mut all = [x[0].of(0.0); A];
    for block in 0..rows.div_ceil(ROWS) {
        let first = block * ROWS;
        let some: [R; ROWS] = sums(first, count, columns, x);
        for k in 0..ROWS {
            if first + k < A {
                all[first + k] = some[k];
            }
        }
    }
    all
}

/// The rows from one on, `K` of them.
#[inline(always)]
fn sums<R: Real, const A: usize, const B: usize, const K: usize>(
    first: usize,
    count: usize,
    columns: &[[R; A]; B],
    x: &[R; B],
) -> [R; K] {
    // Always so: what a compiler knows it need not look at in each place.
    let first = first.min(A.saturating_sub(K));
    let mut sums = [[x[0].of(0.0); K]; 2];
    for b in 0..count {
        for k in 0..K {
            let term = (columns[b][first + k], x[b]);
            let sum = &mut sums[b % 2][k];
            *sum = if b < 2 { term.0 * term.1 } else { term.0.mul_add(term.1, *sum) };
        }
    }
    let [mut sum, second] = sums;
    for k in 0..K {
        sum[k] = sum[k] + second[k];
    }
    sum
}

/// x − y, for `n` places.
#[inline(always)]
pub(super) fn less<R: Real, const M: usize>(n: usize, x: &[R; M], y: &[R; M]) -> [R; M] {
    let mut z = [x[0].of(0.0); M];
    for j in 0..n {
        z[j] = x[j] - y[j];
    }
    z
}

/// x + y, for `n` places.
#[inline(always)]
pub(super) fn more<R: Real, const M: usize>(n: usize, x: &[R; M], y: &[R; M]) -> [R; M] {
    let mut z = [x[0].of(0.0); M];
    for j in 0..n {
        z[j] = x[j] + y[j];
    }
    z
}

/// Solves `n` equations with the factors.
#[inline(always)]
pub(super) fn solve<R: Real, const L: usize>(n: usize, lu: &[[R; L]; L], x: &mut [R; L]) {
    for i in 1..n {
        for j in 0..i {
            x[i] = (-lu[i][j]).mul_add(x[j], x[i]);
        }
    }
    for i in (0..n).rev() {
        for j in i + 1..n {
            x[i] = (-lu[i][j]).mul_add(x[j], x[i]);
        }
        x[i] = x[i] * lu[i][i];
    }
}

/// Factors `n` equations in place, without pivots: J is I plus something that is positive for passive links.
#[inline(always)]
pub(super) fn factor<R: Real, const L: usize>(n: usize, a: &mut [[R; L]; L]) {
    for i in 0..n {
        let inverse = a[i][i].of(1.0) / a[i][i];
        a[i][i] = inverse;
        for r in i + 1..n {
            let share = a[r][i] * inverse;
            a[r][i] = share;
            for j in i + 1..n {
                a[r][j] = (-share).mul_add(a[i][j], a[r][j]);
            }
        }
    }
}

/// Sum of products.
#[inline(always)]
pub(super) fn dot<R: Real>(zero: R, row: &[R], x: &[R]) -> R {
    let mut y = zero;
    for (c, x) in row.iter().zip(x) {
        y = c.mul_add(*x, y);
    }
    y
}

/// What the registers read and write as a whole: so that no number lies across two lines of the cache.
#[repr(align(32))]
pub(super) struct Aligned<T>(pub T);

// Copied as a whole: a derived clone would go over all entries one by one.
impl<T: Copy> Copy for Aligned<T> {}

impl<T: Copy> Clone for Aligned<T> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: Copy, const K: usize> Aligned<[T; K]> {
    /// The same in all places. By a call: where it stands inside others the compiler writes out place after place.
    #[inline(never)]
    pub fn filled(x: T) -> Self {
        Self([x; K])
    }
}

impl<T: Copy, const K: usize, const L: usize> Aligned<[[T; K]; L]> {
    /// The same in all places of a matrix.
    #[inline(never)]
    pub fn full_of(x: T) -> Self {
        Self([[x; K]; L])
    }
}

impl<T> Deref for Aligned<T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T> DerefMut for Aligned<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut T {
        &mut self.0
    }
}
