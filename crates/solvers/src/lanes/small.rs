//! Small matrices, one in each lane.

use std::ops::{Deref, DerefMut};
use trilith_element::lanes::Real;

/// Sums of rows times coefficients, place by place.
#[inline(always)]
pub(super) fn combine<R: Real, const M: usize>(c: &[[R; M]; 4], x: [&[R; M]; 4]) -> [R; M] {
    let mut sum = *x[0];
    for j in 0..M {
        let first = c[1][j].mul_add(x[1][j], c[0][j] * x[0][j]);
        let second = c[3][j].mul_add(x[3][j], c[2][j] * x[2][j]);
        sum[j] = first + second;
    }
    sum
}

/// A matrix, column by column, times a vector: in two sums, as each waits for its last term.
#[inline(always)]
pub(super) fn times<R: Real, const A: usize, const B: usize>(
    columns: &[[R; A]; B],
    x: &[R; B],
) -> [R; A] {
    let mut sums = [[x[0].of(0.0); A]; 2];
    for b in 0..B {
        for a in 0..A {
            let term = (columns[b][a], x[b]);
            let sum = &mut sums[b % 2][a];
            *sum = if b < 2 { term.0 * term.1 } else { term.0.mul_add(term.1, *sum) };
        }
    }
    let [mut sum, second] = sums;
    for a in 0..A {
        sum[a] = sum[a] + second[a];
    }
    sum
}

/// x − y.
#[inline(always)]
pub(super) fn less<R: Real, const M: usize>(x: &[R; M], y: &[R; M]) -> [R; M] {
    let mut z = *x;
    for j in 0..M {
        z[j] = z[j] - y[j];
    }
    z
}

/// x + y.
#[inline(always)]
pub(super) fn more<R: Real, const M: usize>(x: &[R; M], y: &[R; M]) -> [R; M] {
    let mut z = *x;
    for j in 0..M {
        z[j] = z[j] + y[j];
    }
    z
}

/// Solves with the factors.
#[inline(always)]
pub(super) fn solve<R: Real, const L: usize>(lu: &[[R; L]; L], x: &mut [R; L]) {
    for i in 1..L {
        for j in 0..i {
            x[i] = (-lu[i][j]).mul_add(x[j], x[i]);
        }
    }
    for i in (0..L).rev() {
        for j in i + 1..L {
            x[i] = (-lu[i][j]).mul_add(x[j], x[i]);
        }
        x[i] = x[i] * lu[i][i];
    }
}

/// Factors in place, without pivots: J is I plus something that is positive for passive links.
#[inline(always)]
pub(super) fn factor<R: Real, const L: usize>(a: &mut [[R; L]; L]) {
    for i in 0..L {
        let inverse = a[i][i].of(1.0) / a[i][i];
        a[i][i] = inverse;
        for r in i + 1..L {
            let share = a[r][i] * inverse;
            a[r][i] = share;
            for j in i + 1..L {
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
#[derive(Clone, Copy)]
#[repr(align(32))]
pub(super) struct Aligned<T>(pub T);

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
