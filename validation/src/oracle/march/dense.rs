//! Small dense systems by rows, with partial pivoting.

/// L U of a matrix.
#[derive(Clone, Debug, Default)]
pub struct Factor {
    n: usize,
    rows: Vec<f64>,
    order: Vec<usize>,
}

impl Factor {
    /// Of a square matrix by rows; none where it is singular.
    #[must_use]
    pub fn new(a: Vec<f64>, n: usize) -> Option<Self> {
        Self::factored(a, n, false)
    }

    /// The same, but an unknown that is in no equation that is left is its own right side; none where the
    /// numbers are not finite.
    #[must_use]
    pub fn with_loose(a: Vec<f64>, n: usize) -> Option<Self> {
        Self::factored(a, n, true)
    }

    fn factored(mut a: Vec<f64>, n: usize, loose: bool) -> Option<Self> {
        let mut order: Vec<usize> = (0..n).collect();
        for j in 0..n {
            let size = |i: &usize| a[i * n + j].abs();
            let best = (j..n).max_by(|x, y| size(x).total_cmp(&size(y)))?;
            if size(&best) == 0.0 && loose {
                a[j * n + j] = 1.0;
                continue;
            }
            if !(size(&best) > 0.0 && size(&best).is_finite()) {
                return None;
            }
            if best != j {
                order.swap(best, j);
                let (top, low) = a.split_at_mut(best * n);
                top[j * n..j * n + n].swap_with_slice(&mut low[..n]);
            }
            let (top, low) = a.split_at_mut((j + 1) * n);
            let pivot = &top[j * n..];
            let share = pivot[j].recip();
            for row in low.chunks_exact_mut(n) {
                let s = row[j] * share;
                row[j] = s;
                if s != 0.0 {
                    row[j + 1..].iter_mut().zip(&pivot[j + 1..]).for_each(|(x, p)| *x -= s * p);
                }
            }
        }
        Some(Self { n, rows: a, order })
    }

    /// Solves for a right side, which `x` takes the place of; `room` is overwritten.
    pub fn solve(&self, x: &mut [f64], room: &mut Vec<f64>) {
        let n = self.n;
        room.clear();
        room.extend(self.order.iter().map(|i| x[*i]));
        for i in 0..n {
            let row = &self.rows[i * n..i * n + i];
            let sum: f64 = row.iter().zip(&room[..i]).map(|(a, b)| a * b).sum();
            room[i] -= sum;
        }
        for i in (0..n).rev() {
            let row = &self.rows[i * n..i * n + n];
            let sum: f64 = row[i + 1..].iter().zip(&room[i + 1..]).map(|(a, b)| a * b).sum();
            room[i] = (room[i] - sum) / row[i];
        }
        x.copy_from_slice(room);
    }
}

/// y += A x for A by rows.
pub fn add_product(y: &mut [f64], a: &[f64], x: &[f64]) {
    if x.is_empty() {
        return;
    }
    for (y, row) in y.iter_mut().zip(a.chunks_exact(x.len())) {
        *y += dot(row, x);
    }
}

/// Sum of products, in four sums side by side.
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a4.zip(b4) {
        for i in 0..4 {
            sums[i] += x[i] * y[i];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_that_needs_its_rows_in_another_order_is_solved() {
        let a = vec![0.0, 2.0, 1.0, 1.0, -1.0, 3.0, 4.0, 0.5, 0.25];
        let exact = [1.5, -2.0, 0.75];
        let mut x = vec![0.0; 3];
        add_product(&mut x, &a, &exact);
        Factor::new(a, 3).unwrap().solve(&mut x, &mut Vec::new());
        x.iter().zip(exact).for_each(|(x, e)| assert!((x - e).abs() < 1e-14));
        let singular = vec![1.0, 2.0, 2.0, 4.0];
        assert!(Factor::new(singular.clone(), 2).is_none());
        // The first is held by what is left of it, the second by nothing.
        let mut x = vec![3.0, 6.0];
        Factor::with_loose(singular, 2).unwrap().solve(&mut x, &mut Vec::new());
        assert_eq!(x, [3.0, 0.0]);
    }
}
