//! The reduction of matrices against its equations, done here with dense matrices by Gauss and by Jacobi.

use trilith_linalg::{Dense, Sparse, Triplets};
use trilith_solvers::{CraigBampton, FixedModes, ReductionError};

type Matrix = Vec<Vec<f64>>;

fn zeros(rows: usize, columns: usize) -> Matrix {
    vec![vec![0.0; columns]; rows]
}

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    let mut c = zeros(a.len(), b[0].len());
    for (row, sum) in a.iter().zip(&mut c) {
        for (x, other) in row.iter().zip(b) {
            sum.iter_mut().zip(other).for_each(|(s, y)| *s += x * y);
        }
    }
    c
}

fn transposed(a: &Matrix) -> Matrix {
    (0..a[0].len()).map(|j| a.iter().map(|row| row[j]).collect()).collect()
}

fn block(a: &Matrix, rows: &[usize], columns: &[usize]) -> Matrix {
    rows.iter().map(|i| columns.iter().map(|j| a[*i][*j]).collect()).collect()
}

/// A⁻¹ B by Gauss with row exchange.
fn solve(mut a: Matrix, mut b: Matrix) -> Matrix {
    let n = a.len();
    for p in 0..n {
        let pivot = (p..n).max_by(|i, j| a[*i][p].abs().total_cmp(&a[*j][p].abs())).unwrap();
        a.swap(p, pivot);
        b.swap(p, pivot);
        for i in (0..n).filter(|i| *i != p) {
            let factor = a[i][p] / a[p][p];
            for j in p..n {
                a[i][j] -= factor * a[p][j];
            }
            for j in 0..b[0].len() {
                b[i][j] -= factor * b[p][j];
            }
        }
    }
    (0..n).map(|i| b[i].iter().map(|x| x / a[i][i]).collect()).collect()
}

/// Eigenvalues, rising, and vectors as columns of a symmetric matrix: turns of two rows after Jacobi.
fn jacobi(mut a: Matrix) -> (Vec<f64>, Matrix) {
    let n = a.len();
    let mut v = zeros(n, n);
    (0..n).for_each(|i| v[i][i] = 1.0);
    for _ in 0..60 {
        for p in 0..n {
            for q in p + 1..n {
                if a[p][q] == 0.0 {
                    continue;
                }
                let theta = 0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p]);
                let (s, c) = theta.sin_cos();
                for k in 0..n {
                    let (x, y) = (a[k][p], a[k][q]);
                    (a[k][p], a[k][q]) = (c * x - s * y, s * x + c * y);
                }
                for k in 0..n {
                    let (x, y) = (a[p][k], a[q][k]);
                    (a[p][k], a[q][k]) = (c * x - s * y, s * x + c * y);
                    let (x, y) = (v[k][p], v[k][q]);
                    (v[k][p], v[k][q]) = (c * x - s * y, s * x + c * y);
                }
            }
        }
    }
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|i, j| a[*i][*i].total_cmp(&a[*j][*j]));
    let values = order.iter().map(|i| a[*i][*i]).collect();
    (values, v.iter().map(|row| order.iter().map(|j| row[*j]).collect()).collect())
}

/// T of the equations of Craig and Bampton, ω², for a mass of the inner rows that is diagonal and may be zero.
fn oracle(k: &Matrix, m: &Matrix, kept: &[usize], count: usize) -> (Matrix, Vec<f64>) {
    let rows = k.len();
    let inner: Vec<usize> = (0..rows).filter(|i| !kept.contains(i)).collect();
    let psi = solve(block(k, &inner, &inner), block(k, &inner, kept));
    // Rows without mass follow the others: K_aa − K_ab K_bb⁻¹ K_ba.
    let (heavy, light): (Vec<usize>, Vec<usize>) = inner.iter().partition(|i| m[**i][**i] > 0.0);
    let mut condensed = block(k, &heavy, &heavy);
    let mut follow = zeros(0, heavy.len());
    if !light.is_empty() {
        follow = solve(block(k, &light, &light), block(k, &light, &heavy));
        let less = times(&block(k, &heavy, &light), &follow);
        for (row, less) in condensed.iter_mut().zip(&less) {
            row.iter_mut().zip(less).for_each(|(x, y)| *x -= y);
        }
    }
    let root: Vec<f64> = heavy.iter().map(|i| m[*i][*i].sqrt()).collect();
    for (i, row) in condensed.iter_mut().enumerate() {
        row.iter_mut().zip(&root).for_each(|(x, r)| *x /= root[i] * r);
    }
    let (omega2, vectors) = jacobi(condensed);
    let mut t = zeros(rows, kept.len() + count);
    kept.iter().enumerate().for_each(|(j, i)| t[*i][j] = 1.0);
    for (i, row) in inner.iter().zip(&psi) {
        row.iter().enumerate().for_each(|(j, x)| t[*i][j] = -x);
    }
    for q in 0..count {
        let phi: Vec<f64> = vectors.iter().zip(&root).map(|(row, r)| row[q] / r).collect();
        heavy.iter().zip(&phi).for_each(|(i, x)| t[*i][kept.len() + q] = *x);
        for (i, row) in light.iter().zip(&follow) {
            t[*i][kept.len() + q] = -row.iter().zip(&phi).map(|(a, x)| a * x).sum::<f64>();
        }
    }
    (t, omega2[..count].to_vec())
}

/// Numbers between 0 and 1, the same every time.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Masses between springs, every one held by some others: K, M and C; some are without mass.
fn structure(seed: u64, rows: usize) -> [Matrix; 3] {
    let mut numbers = Numbers(seed);
    let mut all = [zeros(rows, rows), zeros(rows, rows), zeros(rows, rows)];
    let tie = |a: &mut Matrix, i: usize, j: usize, x: f64| {
        a[i][i] += x;
        a[j][j] += x;
        a[i][j] -= x;
        a[j][i] -= x;
    };
    for i in 1..rows {
        for _ in 0..3 {
            let j = (numbers.next() * i as f64) as usize;
            tie(&mut all[0], i, j, 1e6 * (0.1 + numbers.next()));
            tie(&mut all[2], i, j, 1e3 * numbers.next());
        }
    }
    for i in 0..rows {
        if i % 5 != 3 {
            all[1][i][i] = 100.0 * (0.2 + numbers.next());
        }
    }
    all
}

fn sparse(a: &Matrix) -> Sparse {
    let mut t = Triplets::new(a.len(), a.len());
    for (i, row) in a.iter().enumerate() {
        row.iter().enumerate().filter(|(_, x)| **x != 0.0).for_each(|(j, x)| t.add(i, j, *x));
    }
    t.build()
}

/// Entries agree, those of modes up to their signs.
fn agree(what: &str, found: &Dense, wanted: &Matrix, own: usize, signs: &[f64]) {
    let most = wanted.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (i, row) in wanted.iter().enumerate() {
        for (j, x) in row.iter().enumerate() {
            let sign = |i: usize| if i < own { 1.0 } else { signs[i - own] };
            let y = sign(i) * sign(j) * found[(i, j)];
            assert!((x - y).abs() <= 1e-9 * most, "{what} ({i}, {j}): {x:e} and {y:e}");
        }
    }
}

#[test]
fn matrices_are_those_of_the_equations() {
    for (seed, rows) in [(1, 12), (2, 23), (3, 31)] {
        let all = structure(seed, rows);
        let [k, m, c] = all.each_ref().map(sparse);
        let kept = [0, 4, rows - 2];
        for count in [0, 3, 7] {
            let cb = CraigBampton::new([&k, &m, &c], &kept, FixedModes::Count(count)).unwrap();
            let (t, omega2) = oracle(&all[0], &all[1], &kept, count);
            assert_eq!(cb.omega.len(), count);
            for (x, y) in cb.omega.iter().zip(&omega2) {
                assert!((x * x / y - 1.0).abs() < 1e-10, "{x} and {}", y.sqrt());
            }
            let signs: Vec<f64> = (0..count)
                .map(|q| {
                    (0..rows).map(|i| t[i][3 + q] * cb.shapes[(i, 3 + q)]).sum::<f64>().signum()
                })
                .collect();
            for (name, own, found) in [
                ("K", &all[0], &cb.stiffness),
                ("M", &all[1], &cb.mass),
                ("C", &all[2], &cb.damping),
            ] {
                agree(name, found, &times(&transposed(&t), &times(own, &t)), 3, &signs);
            }
        }
    }
}

#[test]
fn modes_are_as_many_as_there_are_masses_and_as_lie_below_a_limit() {
    let all = structure(5, 24);
    let [k, m, c] = all.each_ref().map(sparse);
    let kept = [1, 2];
    let of = |modes| CraigBampton::new([&k, &m, &c], &kept, modes).unwrap().omega;
    let everything = of(FixedModes::All);
    let heavy = (0..24).filter(|i| i % 5 != 3 && !kept.contains(i)).count();
    assert_eq!(everything.len(), heavy);
    assert_eq!(of(FixedModes::Count(100)), everything);
    for wanted in [0, 1, 6, heavy] {
        let above = everything.get(wanted).copied().unwrap_or(2.0 * everything[heavy - 1]);
        let below = if wanted > 0 { everything[wanted - 1] } else { 0.0 };
        let limit = 0.5 * (above + below) / std::f64::consts::TAU;
        let found = of(FixedModes::UpTo(limit));
        assert_eq!(found.len(), wanted, "below {limit} Hz");
        assert!(found.iter().zip(&everything).all(|(x, y)| (x / y - 1.0).abs() < 1e-9));
    }
}

/// A rod of n pieces with its masses at the nodes, one end held: ωₛ = 2 n c/L sin((2s − 1) π / 4n).
#[test]
fn a_rod_that_is_held_at_one_end_has_the_frequencies_of_the_closed_form() {
    let (n, stiffness, mass) = (40_usize, 3e8, 50.0);
    let (mut k, mut m) = (zeros(n + 1, n + 1), zeros(n + 1, n + 1));
    for i in 0..n {
        for (a, b, x) in [(i, i, 1.0), (i + 1, i + 1, 1.0), (i, i + 1, -1.0), (i + 1, i, -1.0)] {
            k[a][b] += x * stiffness;
        }
        m[i][i] += 0.5 * mass;
        m[i + 1][i + 1] += 0.5 * mass;
    }
    let [k, m] = [k, m].map(|a| sparse(&a));
    let none = Sparse::zeros(n + 1, n + 1);
    let cb = CraigBampton::new([&k, &m, &none], &[0], FixedModes::Count(12)).unwrap();
    for (s, omega) in cb.omega.iter().enumerate() {
        let angle = (2.0 * s as f64 + 1.0) * std::f64::consts::PI / (4.0 * n as f64);
        let closed = 2.0 * (stiffness / mass).sqrt() * angle.sin();
        assert!((omega / closed - 1.0).abs() < 1e-11, "{omega} and {closed}");
    }
    // Moved at its end it moves as a whole: no stiffness, all of its mass, and what a continuous rod has in its modes,
    // 8 / ((2s − 1)² π²) of it.
    assert!(cb.stiffness[(0, 0)].abs() < 1e-6 * stiffness);
    assert!((cb.mass[(0, 0)] / (n as f64 * mass) - 1.0).abs() < 1e-12);
    let (each, all) = cb.effective_mass(&m, &[1.0]).unwrap();
    assert!((all / ((n as f64 - 0.5) * mass) - 1.0).abs() < 1e-12);
    for (s, found) in each.iter().take(3).enumerate() {
        let odd = (2 * s + 1) as f64 * std::f64::consts::PI;
        let closed = 8.0 / (odd * odd) * n as f64 * mass;
        assert!((found / closed - 1.0).abs() < 0.01, "{found} and {closed}");
    }
}

#[test]
fn rows_that_nothing_holds_are_told() {
    let mut all = structure(7, 10);
    // Row 9 hangs on nothing, rows 0 to 8 on what is kept.
    for i in 0..10 {
        all[0][9][i] = 0.0;
        all[0][i][9] = 0.0;
    }
    let [k, m, c] = all.each_ref().map(sparse);
    let error = CraigBampton::new([&k, &m, &c], &[0], FixedModes::Count(2)).unwrap_err();
    // What pulled at row 9 holds the others now against the ground, if softly.
    assert_eq!(error, ReductionError::Loose(vec![9]));
    let mut turned = all[0].clone();
    turned[4][4] -= 1e8;
    let error = CraigBampton::new([&sparse(&turned), &m, &c], &[0, 9], FixedModes::Count(2));
    assert!(matches!(error, Err(ReductionError::Negative(_))), "{error:?}");
}
