//! Modes against closed forms, against dense eigensolutions, and by their definition.

use super::*;
use crate::{Triplets, all_modes};
use std::f64::consts::PI;

fn spring(k: &mut Triplets, i: usize, j: usize, s: f64) {
    for (a, b, v) in [(i, i, s), (j, j, s), (i, j, -s), (j, i, -s)] {
        k.add(a, b, v);
    }
}

fn diagonal(values: impl IntoIterator<Item = f64>) -> Sparse {
    let values: Vec<f64> = values.into_iter().collect();
    let mut m = Triplets::new(values.len(), values.len());
    values.iter().enumerate().filter(|(_, v)| **v != 0.0).for_each(|(i, v)| m.add(i, i, *v));
    m.build()
}

/// Springs one after the other from the ground on.
fn chain(springs: &[f64]) -> Sparse {
    let mut k = Triplets::new(springs.len(), springs.len());
    for (i, s) in springs.iter().enumerate() {
        if i == 0 { k.add(0, 0, *s) } else { spring(&mut k, i - 1, i, *s) }
    }
    k.build()
}

/// Number of modes with a smaller λ, by inertia.
fn slower(k: &Sparse, m: &Sparse, than: f64) -> usize {
    let mut count = 0;
    let factor = StagedLdlt::alone(&[(1.0, k), (-than, m)]).unwrap();
    factor.pivots(|_, d| count += usize::from(d < 0.0));
    count
}

/// Modes are M-orthonormal, satisfy the equation, and are complete by the inertia.
fn are_modes(k: &Sparse, m: &Sparse, (values, vectors): &(Vec<f64>, Dense)) {
    assert_eq!(values.len(), vectors.columns());
    assert!(values.windows(2).all(|w| w[0] <= w[1]), "{values:?}");
    let magnitude: Vec<f64> = k.row_sums();
    for (j, value) in values.iter().enumerate() {
        let x = vectors.column(j);
        let (left, right) = (k.mul(x), m.mul(x));
        let largest = x.iter().zip(&magnitude).map(|(x, s)| (x * s).abs()).fold(0.0, f64::max);
        for i in 0..x.len() {
            let residual = (left[i] - value * right[i]).abs();
            assert!(residual < 1e-9 * largest, "mode {j}, place {i}: {residual} of {largest}");
        }
        for i in 0..=j {
            let product = dot(vectors.column(i), &right);
            let expected = f64::from(u8::from(i == j));
            assert!((product - expected).abs() < 1e-11, "modes {i} {j}: {product}");
        }
    }
    let last = values.last().copied().unwrap_or(0.0);
    let below = last - 1e-5 * last.abs();
    let counted = slower(k, m, below);
    assert_eq!(values.iter().filter(|v| **v < below).count(), counted);
}

fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!((f - e).abs() <= tolerance * e.abs(), "mode {i}: {f:e} {e:e}");
    }
}

#[test]
fn the_chain_has_its_closed_form_frequencies() {
    let (n, m) = (8, diagonal([10.0; 8]));
    let mut k = Triplets::new(n, n);
    (0..n - 1).for_each(|i| spring(&mut k, i, i + 1, 1e5));
    [0, n - 1].iter().for_each(|i| k.add(*i, *i, 1e5));
    let exact = |j: usize| 4e4 * (PI * j as f64 / 18.0).sin().powi(2);
    for count in [1, 3, 8, 20] {
        let (found, _) = lowest_modes(&k.build(), &m, count, 0.0).unwrap();
        assert_eq!(found.len(), count.min(8));
        close(&found, &(1..=8).map(exact).collect::<Vec<_>>(), 1e-12);
    }
}

#[test]
fn close_frequencies_are_found() {
    let springs: Vec<f64> = (0..120).map(|i| 1e6 * 1.003_f64.powi(i)).collect();
    // One after the other, and each on its own: frequencies 0.15 % apart.
    for k in [chain(&springs), diagonal(springs.clone())] {
        let m = diagonal([100.0; 120]);
        let (all, _) = all_modes(&k, &m).unwrap();
        for count in [1, 10, 40, 119] {
            let found = lowest_modes(&k, &m, count, 0.0).unwrap();
            assert_eq!(found.0.len(), count);
            close(&found.0, &all, 1e-11);
            are_modes(&k, &m, &found);
        }
    }
}

#[test]
fn multiple_modes_are_found_as_often_as_they_are() {
    let (k, m) = (diagonal([400.0; 100]), diagonal([4.0; 100]));
    for count in [1, 30, 100] {
        let found = lowest_modes(&k, &m, count, 0.0).unwrap();
        assert_eq!(found.0.len(), count);
        close(&found.0, &[100.0; 100], 1e-13);
        are_modes(&k, &m, &found);
    }
    // Eleven towers of twenty masses: each mode eleven times.
    let (towers, n) = (11, 20);
    let mut k = Triplets::new(towers * n, towers * n);
    for tower in 0..towers {
        let start = tower * n;
        k.add(start, start, 1e4);
        (1..n).for_each(|i| spring(&mut k, start + i - 1, start + i, 1e4));
    }
    let (k, m) = (k.build(), diagonal(vec![1.0; towers * n]));
    let exact = |i: usize| {
        4e4 * (PI * (2 * (i / towers) + 1) as f64 / (2 * (2 * n + 1)) as f64).sin().powi(2)
    };
    let exact: Vec<f64> = (0..towers * n).map(exact).collect();
    for count in [12, 40, 66] {
        let found = lowest_modes(&k, &m, count, 0.0).unwrap();
        close(&found.0, &exact, 1e-11);
        are_modes(&k, &m, &found);
    }
}

#[test]
fn free_bodies_move_without_stiffness() {
    // Three free chains of thirty masses.
    let (chains, n) = (3, 30);
    let mut k = Triplets::new(chains * n, chains * n);
    for c in 0..chains {
        (1..n).for_each(|i| spring(&mut k, c * n + i - 1, c * n + i, 2e5));
    }
    let (k, m) = (k.build(), diagonal(vec![5.0; chains * n]));
    let found = lowest_modes(&k, &m, 20, -10.0).unwrap();
    let exact = |i: usize| 1.6e5 * (PI * (i / chains) as f64 / (2 * n) as f64).sin().powi(2);
    for (i, value) in found.0.iter().enumerate() {
        assert!((value - exact(i)).abs() < 1e-9 * (10.0 + exact(i)), "{i}: {value} {}", exact(i));
    }
    // The residual of free motion is rounding.
    are_modes(&Sparse::combine(&[(1.0, &k), (10.0, &m)]), &m, &{
        (found.0.iter().map(|v| v + 10.0).collect(), found.1)
    });
}

fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 40) as f64 / (1u64 << 24) as f64
}

/// Springs between random places, few of them to the ground; masses on some places, some shared by two.
fn scattered(n: usize, share: f64, mut seed: u64) -> (Sparse, Sparse) {
    let seed = &mut seed;
    let (mut k, mut m) = (Triplets::new(n, n), Triplets::new(n, n));
    for i in 0..n {
        k.add(i, i, if i % 7 == 0 { 100.0 } else { 0.0 });
        for _ in 0..3 {
            let j = (random(seed) * n as f64) as usize;
            if j != i {
                spring(&mut k, i, j, 10.0_f64.powf(3.0 * random(seed)));
            }
        }
        if random(seed) < share {
            let (j, s) = ((i + 1) % n, random(seed));
            // A point mass on the line between two places: rank one.
            for (a, b, v) in [(i, i, s * s), (i, j, s), (j, i, s), (j, j, 1.0)] {
                m.add(a, b, 2.0 * v);
            }
        }
    }
    (k.build(), m.build())
}

#[test]
fn random_structures_have_the_modes_of_the_dense_solution() {
    for (n, share, seed) in [(30, 1.0, 1), (150, 0.5, 2), (150, 0.1, 3), (200, 0.8, 4)] {
        let (k, m) = scattered(n, share, seed);
        let (all, _) = all_modes(&k, &m).unwrap();
        assert!(share == 1.0 || all.len() < n, "masses are singular");
        for count in [1, 7, all.len() / 2, n] {
            let found = lowest_modes(&k, &m, count, 0.0).unwrap();
            assert_eq!(found.0.len(), count.min(all.len()));
            close(&found.0, &all, 1e-9);
            are_modes(&k, &m, &found);
        }
    }
}

#[test]
fn nothing_moves_without_mass() {
    let (values, vectors) = lowest_modes(&chain(&[1.0; 4]), &Sparse::zeros(4, 4), 3, 0.0).unwrap();
    assert_eq!((values.len(), vectors.rows(), vectors.columns()), (0, 4, 0));
}

#[test]
fn modes_over_many_decades_are_found_from_one_shift() {
    // Each ten times as fast as the one before, on a chain that hardly couples them.
    let n = 14;
    let k = chain(&[1e4; 14]);
    let m = diagonal((0..n).map(|i| 10.0_f64.powi(6 - i)));
    let (all, _) = all_modes(&k, &m).unwrap();
    let found = lowest_modes(&k, &m, n as usize, 0.0).unwrap();
    close(&found.0, &all, 1e-9);
    // Independent: λ from the determinant, of which each pivot is a term of a continued fraction.
    for value in &found.0 {
        let count = |at: f64| slower(&k, &m, at);
        assert_eq!(count(value * (1.0 + 1e-8)), count(value * (1.0 - 1e-8)) + 1, "{value}");
    }
}

#[test]
fn an_indefinite_stiffness_gives_the_modes_nearest_to_the_shift() {
    let (k, m) = (diagonal((0..50).map(|i| f64::from(i) - 9.8)), diagonal([1.0; 50]));
    let (found, _) = lowest_modes(&k, &m, 5, 0.0).unwrap();
    for (f, e) in found.iter().zip([-1.8, -0.8, 0.2, 1.2, 2.2]) {
        assert!((f - e).abs() < 1e-10, "{found:?}");
    }
}

/// A square membrane: most frequencies are double, λ = 4 sin²(iπ/2(n+1)) + 4 sin²(jπ/2(n+1)).
#[test]
fn a_membrane_of_two_thousand_equations_has_its_double_frequencies() {
    let n = 45;
    let mut k = Triplets::new(n * n, n * n);
    for i in 0..n {
        for j in 0..n {
            k.add(i * n + j, i * n + j, 4.0);
            for (a, b) in [(i + 1, j), (i, j + 1)] {
                if a < n && b < n {
                    k.add(i * n + j, a * n + b, -1.0);
                    k.add(a * n + b, i * n + j, -1.0);
                }
            }
        }
    }
    let (k, m) = (k.build(), diagonal(vec![1.0; n * n]));
    let of = |i: usize| 4.0 * (PI * i as f64 / (2 * (n + 1)) as f64).sin().powi(2);
    let mut exact: Vec<f64> = (0..n * n).map(|c| of(1 + c / n) + of(1 + c % n)).collect();
    exact.sort_by(f64::total_cmp);
    let start = std::time::Instant::now();
    for count in [20, 150] {
        let found = lowest_modes(&k, &m, count, 0.0).unwrap();
        eprintln!("{count} modes after {:.2?}", start.elapsed());
        close(&found.0, &exact, 1e-11);
        are_modes(&k, &m, &found);
    }
}
