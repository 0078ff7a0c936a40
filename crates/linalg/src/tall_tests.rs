//! Projections and congruences against products by hand.

use super::*;
use crate::Triplets;

fn number(i: usize) -> f64 {
    ((i * 7919) % 1009) as f64 / 1009.0 - 0.5
}

fn sample(rows: usize, columns: usize) -> Dense {
    Dense::from_columns(rows, columns, (0..rows * columns).map(number).collect())
}

#[test]
fn shares_are_taken_out_of_few_vectors_and_of_many() {
    let n = 9500;
    let v = sample(n, 7);
    let mut columns = Columns::with_capacity(n, 7);
    (0..7).for_each(|j| columns.push(v.column(j)));
    assert_eq!((columns.len(), columns.is_empty()), (7, false));
    for count in [1, 2, 3, 11, 12, 31, 32, 50] {
        let y: Vec<Vec<f64>> =
            (0..count).map(|c| (0..n).map(|i| number(3 * i + c)).collect()).collect();
        let mut x = y.clone();
        let shares = columns.take_out(2, &mut x, &y);
        assert_eq!(shares.len(), 5 * count);
        for ((x, y), shares) in x.iter().zip(&y).zip(shares.chunks(5)) {
            let mut expected = y.clone();
            for j in 2..7 {
                let share: f64 = v.column(j).iter().zip(y).map(|(a, b)| a * b).sum();
                assert!((share - shares[j - 2]).abs() < 1e-10, "{share} {shares:?}");
                expected.iter_mut().zip(v.column(j)).for_each(|(e, a)| *e -= share * a);
            }
            for (x, e) in x.iter().zip(&expected) {
                assert!((x - e).abs() < 1e-10 * (1.0 + e.abs()), "{x} {e}");
            }
        }
    }
    let q = sample(3, 2);
    let product = columns.times(&q);
    for j in 0..2 {
        for i in (0..n).step_by(7) {
            let expected: f64 = (0..3).map(|k| v[(i, k)] * q[(k, j)]).sum();
            assert!((product[(i, j)] - expected).abs() < 1e-14);
        }
    }
    assert_eq!(columns.column(4), v.column(4));
    assert_eq!(columns.into_dense(), v);
}

#[test]
fn a_congruence_and_sums_of_columns_are_the_products_by_hand() {
    let (n, m) = (600, 37);
    let mut t = Triplets::new(n, n);
    for i in 0..n {
        t.add(i, i, 2.0 + number(i));
        if i > 2 {
            t.add(i, i - 3, number(i));
            t.add(i - 3, i, number(i));
        }
    }
    let (a, v) = (t.build(), sample(n, m));
    for count in [m, 20, 1, 0] {
        let c = v.congruence(&a, count);
        for i in 0..count {
            for j in 0..count {
                let expected = a.bilinear(v.column(i), v.column(j));
                assert!((c[(i, j)] - expected).abs() < 1e-10, "{} {expected}", c[(i, j)]);
            }
        }
        let shares = sample(count, 5);
        let sums = v.sums(&shares);
        for j in 0..5 {
            for i in (0..n).step_by(13) {
                let expected: f64 = (0..count).map(|k| v[(i, k)] * shares[(k, j)]).sum();
                assert!((sums[(i, j)] - expected).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn threads_change_no_bit_and_images_of_many_are_those_of_each() {
    let (n, m) = (20_000, 70);
    let mut t = Triplets::new(n, n);
    for i in 0..n {
        t.add(i, i, 2.0 + number(i));
        for j in (i + 1..n).step_by(997).take(12) {
            t.add(i, j, number(i + j));
            t.add(j, i, number(i + j));
        }
    }
    let (a, v) = (t.build(), sample(n, m));
    let mut columns = Columns::with_capacity(n, m);
    (0..m).for_each(|j| columns.push(v.column(j)));
    for count in [1, 2, 7] {
        let x: Vec<Vec<f64>> =
            (0..count).map(|c| (0..n).map(|i| number(3 * i + c)).collect()).collect();
        let all = || {
            let (images, mut left) = (a.symmetric_images(&x), x.clone());
            let shares = columns.take_out(0, &mut left, &images);
            (images, left, shares)
        };
        let (images, left, shares) = all();
        assert_eq!(crate::threads::alone(all), (images.clone(), left, shares));
        for (x, image) in x.iter().zip(&images) {
            let pairs = a.mul(x).into_iter().zip(image);
            pairs.for_each(|(y, own)| assert!((y - own).abs() < 1e-13, "{y} {own}"));
        }
    }
    let both = || (v.congruence(&a, m), v.sums(&sample(m, m)));
    assert_eq!(crate::threads::alone(both), both());
}
