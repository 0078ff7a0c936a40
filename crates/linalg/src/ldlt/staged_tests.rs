use super::*;
use crate::Triplets;

/// A grid of springs, some of them to the ground; numbers that repeat.
fn grid(side: usize) -> Sparse {
    let n = side * side;
    let mut k = Triplets::new(n, n);
    let mut seed = 1u64;
    let mut random = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        0.5 + (seed >> 40) as f64 / (1u64 << 24) as f64
    };
    for i in 0..n {
        k.add(i, i, 0.01 * random());
        for other in [i + 1, i + side] {
            if other < n && (other != i + 1 || !other.is_multiple_of(side)) {
                let s = random();
                for (a, b, v) in [(i, i, s), (other, other, s), (i, other, -s), (other, i, -s)] {
                    k.add(a, b, v);
                }
                // A place that is stored and zero.
                k.add(i, n - 1 - i, 0.0);
            }
        }
    }
    k.build()
}

fn staged(a: &Sparse, last: &[usize]) {
    let n = a.rows();
    let plan = StagedPlan::new(&[a], last).unwrap();
    let factor = StagedLdlt::new(&plan, &[(2.0, a), (-1.0, a)]).unwrap();
    let mut work = vec![0.0; plan.workspace()];
    let b: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
    let mut change = vec![0.0; n];
    last.iter().for_each(|i| change[*i] = (*i as f64).cos());
    let place =
        |v: &[f64]| -> Vec<f64> { plan.equations().iter().map(|i| v[*i as usize]).collect() };
    let solved = |b: &[f64]| {
        let mut x = b.to_vec();
        factor.solve(&mut x);
        // Against the matrix itself.
        for (y, b) in a.mul(&x).iter().zip(b) {
            assert!((y - b).abs() < 1e-11, "{y} {b}");
        }
        place(&x)
    };
    let split = plan.split();
    assert_eq!(split + last.len(), n);
    let mut x = place(&b);
    factor.forward(&mut x, &mut work);
    let mut early = x[split..].to_vec();
    factor.tail_backward(&mut early, &mut work);
    let expected = solved(&b);
    for (x, y) in early.iter().zip(&expected[split..]) {
        assert!((x - y).abs() < 1e-10 * y.abs().max(1.0), "{x} {y}");
    }
    let mut more = place(&change)[split..].to_vec();
    factor.tail_forward(&mut more, &mut work);
    x[split..].iter_mut().zip(&more).for_each(|(x, y)| *x += y);
    factor.tail_backward(&mut x[split..], &mut work);
    factor.finish(&mut x, &mut work);
    let sum: Vec<f64> = b.iter().zip(&change).map(|(a, b)| a + b).collect();
    for (x, y) in x.iter().zip(&solved(&sum)) {
        assert!((x - y).abs() < 1e-10 * y.abs().max(1.0), "{x} {y}");
    }
}

#[test]
fn a_solution_in_stages_is_the_solution() {
    let a = grid(23);
    let n = a.rows();
    for last in [
        vec![],
        vec![7],
        (0..n).collect(),
        (0..40).collect(),
        (0..n).step_by(9).collect(),
        (0..n - 1).collect::<Vec<_>>(),
    ] {
        staged(&a, &last);
    }
}

#[test]
fn separate_parts_and_empty_matrices_are_solved() {
    let mut t = Triplets::new(30, 30);
    for i in 0..30 {
        t.add(i, i, 2.0 + i as f64);
        if !(i + 1usize).is_multiple_of(5) {
            t.add(i, i + 1, -1.0);
            t.add(i + 1, i, -1.0);
        }
    }
    let a = t.build();
    staged(&a, &[0, 7, 8, 29]);
    staged(&a, &(0..30).collect::<Vec<_>>());
    staged(&Triplets::new(0, 0).build(), &[]);
}

#[test]
fn right_hand_sides_together_are_solved_as_alone() {
    let a = grid(23);
    let (n, factor) = (a.rows(), StagedLdlt::alone(&[(1.0, &a)]).unwrap());
    let b: Vec<f64> = (0..6 * n).map(|i| (i as f64).sin()).collect();
    let mut together = b.clone();
    factor.solve(&mut together);
    for (x, b) in together.chunks(n).zip(b.chunks(n)) {
        // Alone sums are taken in another order; of four each has the bits that it has beside any others.
        let mut alone = b.to_vec();
        factor.solve(&mut alone);
        alone.iter().zip(x).for_each(|(a, x)| assert!((a - x).abs() < 1e-12, "{a} {x}"));
        let mut beside = [b, &vec![1.0; n], b].concat();
        factor.solve(&mut beside);
        assert!(x == &beside[..n] && x == &beside[2 * n..]);
        a.mul(x).iter().zip(b).for_each(|(y, b)| assert!((y - b).abs() < 1e-11, "{y} {b}"));
    }
}

/// Columns of many widths, with and without a tail: cut ones, and some that one piece takes from another.
#[test]
fn a_factor_is_that_of_the_dense_matrix_and_has_the_same_bits_on_any_number_of_threads() {
    let mut number = 0;
    let mut any = || {
        number += 1;
        ((number * 7919) % 1009) as f64 / 1009.0 - 0.5
    };
    for (n, band, last) in
        [(1, 0, vec![]), (60, 3, vec![5, 6]), (700, 40, vec![]), (420, 400, vec![0])]
    {
        let mut t = Triplets::new(n, n);
        for i in 0..n {
            t.add(i, i, 4.0 + any());
            for j in (i + 1..n.min(i + band + 1))
                .filter(|j| *j < i + 3 || (i + j) % 7 == 0 || band > 300)
            {
                let x = any() / band as f64;
                t.add(i, j, x);
                t.add(j, i, x);
            }
        }
        let a = t.build();
        let plan = StagedPlan::new(&[&a], &last).unwrap();
        let here = crate::threads::alone(|| StagedLdlt::new(&plan, &[(1.0, &a)]).unwrap());
        let there = StagedLdlt::new(&plan, &[(1.0, &a)]).unwrap();
        assert!(*here.values == *there.values && here.reciprocal == there.reciprocal, "{n}");
        // D and the solution of the dense matrix, in the same order, eliminated column by column.
        let order: Vec<usize> = plan.equations().iter().map(|i| *i as usize).collect();
        let mut dense = vec![vec![0.0; n]; n];
        for (i, row) in order.iter().enumerate() {
            for (j, column) in order.iter().enumerate() {
                let (rows, values) = a.column(*column);
                dense[i][j] = rows.binary_search(row).map_or(0.0, |at| values[at]);
            }
        }
        let b: Vec<f64> = (0..n).map(|_| any()).collect();
        let mut x: Vec<f64> = order.iter().map(|i| b[*i]).collect();
        for k in 0..n {
            for i in k + 1..n {
                let l = dense[i][k] / dense[k][k];
                if l != 0.0 {
                    (k..n).for_each(|j| dense[i][j] -= l * dense[k][j]);
                    x[i] -= l * x[k];
                }
            }
        }
        for k in (0..n).rev() {
            let known: f64 = (k + 1..n).map(|j| dense[k][j] * x[j]).sum();
            x[k] = (x[k] - known) / dense[k][k];
        }
        let close =
            |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b.abs().max(1.0), "{n}: {a} {b}");
        (0..n).for_each(|k| close(here.reciprocal[k].recip(), dense[k][k]));
        let mut solved = b;
        here.solve(&mut solved);
        order.iter().zip(&x).for_each(|(i, x)| close(solved[*i], *x));
    }
}

#[test]
fn subtrees_by_themselves_give_the_solution_on_any_number_of_threads() {
    let a = grid(47);
    let n = a.rows();
    let plan = StagedPlan::new(&[&a], &[]).unwrap();
    let factor = StagedLdlt::new(&plan, &[(1.0, &a)]).unwrap();
    let subtrees = Subtrees::new(&plan.elimination, &plan.front).expect("several subtrees");
    let b = [0, 1].map(|k| (0..n).map(|i| ((3 * i + k) as f64).sin()).collect::<Vec<f64>>());
    let solved = |pair: bool| {
        let mut x = b.clone();
        match (&mut x, pair) {
            ([x, y], true) => factor.solve_by_subtrees(&subtrees, [x, y]),
            (each, _) => each.iter_mut().for_each(|x| factor.solve_by_subtrees(&subtrees, [x])),
        }
        x
    };
    let x = solved(true);
    // Each has the bits that it has by itself.
    assert!(x == solved(false) && x == crate::threads::alone(|| solved(true)));
    for (x, b) in x.iter().zip(&b) {
        a.mul(x).iter().zip(b).for_each(|(y, b)| assert!((y - b).abs() < 1e-11, "{y} {b}"));
    }
}

#[test]
fn a_part_that_is_not_counted_may_have_entries_anywhere() {
    let a = grid(23);
    let n = a.rows();
    let mut t = Triplets::new(n, n);
    for i in 0..n {
        for j in (0..n).step_by(17) {
            t.add(i, j, 1.0);
            t.add(j, i, 1.0);
        }
    }
    let x = |parts: &[(f64, &Sparse)]| {
        let mut x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        StagedLdlt::alone(parts).unwrap().solve(&mut x);
        x
    };
    assert_eq!(x(&[(1.0, &a), (0.0, &t.build())]), x(&[(1.0, &a)]));
}

#[test]
fn a_zero_pivot_is_named() {
    let mut t = Triplets::new(3, 3);
    t.add(0, 0, 1.0);
    t.add(2, 2, 1.0);
    let a = t.build();
    let plan = StagedPlan::new(&[&a], &[0]).unwrap();
    let error = StagedLdlt::new(&plan, &[(1.0, &a)]).unwrap_err();
    assert_eq!(error, LinalgError::Singular { equation: 1 });
}

/// The first of several in the order of elimination, wherever threads come across them.
#[test]
fn of_several_zero_pivots_the_first_is_named_and_what_overflows_is_no_singular_matrix() {
    let with = |at: &[(usize, f64)]| {
        let a = grid(23);
        let mut t = Triplets::new(a.rows(), a.rows());
        a.entries().for_each(|(i, j, v)| t.add(i, j, v));
        let change = |t: &mut Triplets, i: usize, v: f64| {
            let own = a.column(i);
            let free = |j: &&usize| **j != i;
            own.0.iter().filter(free).for_each(|j| {
                let k = a.column(*j).1[a.column(*j).0.binary_search(&i).unwrap()];
                t.add(i, *j, -k);
                t.add(*j, i, -k);
            });
            t.add(i, i, v - own.1[own.0.binary_search(&i).unwrap()]);
        };
        at.iter().for_each(|(i, v)| change(&mut t, *i, *v));
        let a = t.build();
        let plan = StagedPlan::new(&[&a], &[]).unwrap();
        let failed = StagedLdlt::new(&plan, &[(1.0, &a)]).unwrap_err();
        assert_eq!(
            failed,
            crate::threads::alone(|| StagedLdlt::new(&plan, &[(1.0, &a)]).unwrap_err())
        );
        let place = |i: usize| plan.equations().iter().position(|e| *e as usize == i).unwrap();
        let first = at.iter().map(|(i, _)| *i).min_by_key(|i| place(*i)).unwrap();
        (failed, first)
    };
    let (failed, equation) = with(&[(400, 0.0), (30, 0.0), (250, 0.0)]);
    assert_eq!(failed, LinalgError::Singular { equation });
    let (failed, equation) = with(&[(77, f64::INFINITY)]);
    assert_eq!(failed, LinalgError::NotFinite { equation });
}
