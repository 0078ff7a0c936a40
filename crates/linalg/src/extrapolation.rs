//! What a sequence of vectors goes on to.

use crate::simd::dispatch;
use pulp::{Simd, WithSimd};

/// What the polynomials through the last 1, 2 … `P` vectors of a sequence go on to, a row for each, from those of the
/// vector before:
///
/// ```text
/// S¹ₙ = xₙ        Sᵖ⁺¹ₙ = Sᵖₙ + ∇ᵖxₙ        ∇ᵖxₙ = xₙ − Sᵖₙ₋₁
/// ```
///
/// The first of `rows` holds xₙ on entry. Gives the largest magnitudes of xₙ and of ∇¹xₙ … ∇ᴾxₙ, the backward differences:
/// how far each row of `before` missed xₙ.
///
/// # Panics
/// Where the rows differ in length.
pub fn extrapolate<const P: usize>(before: [&[f64]; P], rows: [&mut [f64]; P]) -> (f64, [f64; P]) {
    let n = rows.first().map_or(0, |row| row.len());
    let fits = before.iter().all(|row| row.len() == n) && rows.iter().all(|row| row.len() == n);
    assert!(fits, "rows of extrapolations");
    let (mut size, mut misses) = (0.0, [0.0; P]);
    dispatch(Extrapolate { before, rows, size: &mut size, misses: &mut misses });
    (size, misses)
}

struct Extrapolate<'a, const P: usize> {
    before: [&'a [f64]; P],
    rows: [&'a mut [f64]; P],
    size: &'a mut f64,
    misses: &'a mut [f64; P],
}

impl<const P: usize> WithSimd for Extrapolate<'_, P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        // No closures: what they call would not have the instructions of this function.
        let Self { before, rows, size, misses } = self;
        let n = before.first().map_or(0, |row| row.len());
        let whole = n - n % S::F64_LANES;
        let (mut most, mut largest) = ([simd.splat_f64s(0.0); P], simd.splat_f64s(0.0));
        for i in (0..whole).step_by(S::F64_LANES) {
            let here = i..i + S::F64_LANES;
            let x = S::as_simd_f64s(&rows[0][here.clone()]).0[0];
            largest = simd.max_f64s(largest, simd.abs_f64s(x));
            let mut next = x;
            for p in 0..P {
                let before = S::as_simd_f64s(&before[p][here.clone()]).0[0];
                let missed = simd.sub_f64s(x, before);
                most[p] = simd.max_f64s(most[p], simd.abs_f64s(missed));
                next = simd.add_f64s(next, missed);
                if p + 1 < P {
                    S::as_mut_simd_f64s(&mut rows[p + 1][here.clone()]).0[0] = next;
                }
            }
        }
        *size = simd.reduce_max_f64s(largest);
        for p in 0..P {
            misses[p] = simd.reduce_max_f64s(most[p]);
        }
        for i in whole..n {
            let x = rows[0][i];
            *size = size.max(x.abs());
            let mut next = x;
            for p in 0..P {
                let missed = x - before[p][i];
                misses[p] = misses[p].max(missed.abs());
                next += missed;
                if p + 1 < P {
                    rows[p + 1][i] = next;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_gone_on_with_at_every_length() {
        for n in [1, 2, 7, 8, 9, 16, 19] {
            let x = |k: usize, i: usize| (((i + 31 * k) * 7919 + 13) % 101) as f64 / 50.0 - 1.0;
            let mut tables = vec![[(); 3].map(|()| vec![0.0; n]); 5];
            let mut last = (f64::NAN, [f64::NAN; 3]);
            for k in 1..5 {
                let (before, here) = tables.split_at_mut(k);
                (0..n).for_each(|i| here[0][0][i] = x(k, i));
                let before = before[k - 1].each_ref().map(|row| &row[..]);
                last = extrapolate(before, here[0].each_mut().map(|row| &mut row[..]));
            }
            let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "{n}: {a} {b}");
            let mut sizes = [0.0_f64; 4];
            for i in 0..n {
                let [a, b, c, d] = [4, 3, 2, 1].map(|k| x(k, i));
                let own = [a, 2.0 * a - b, 3.0 * a - 3.0 * b + c];
                own.iter().zip(&tables[4]).for_each(|(own, row)| close(row[i], *own));
                let missed = [a, a - b, a - 2.0 * b + c, a - 3.0 * b + 3.0 * c - d];
                sizes.iter_mut().zip(missed).for_each(|(s, m)| *s = s.max(m.abs()));
            }
            close(last.0, sizes[0]);
            last.1.iter().zip(&sizes[1..]).for_each(|(a, b)| close(*a, *b));
        }
        assert_eq!(extrapolate([&[], &[]], [&mut [], &mut []]), (0.0, [0.0; 2]));
    }
}
