//! A step against the equations of the method, written with full matrices.

use super::Hht;
use super::newmark::newmark;
use crate::basis::LowRank;
use crate::kernel::{StepKey, Wanted};
use crate::step::{Forces, Propagator};
use crate::structure::{LinkMap, ReducedSystem};
use trilith_linalg::{Dense, DenseLu, Product, Sparse, Triplets};

const N: usize = 24;

fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 40) as f64 / (1u64 << 24) as f64 - 0.5
}

fn some(n: usize, seed: u64) -> Vec<f64> {
    let mut seed = seed;
    (0..n).map(|_| random(&mut seed)).collect()
}

/// Springs between every place and others; each third place has no mass.
fn space(modal: bool, links: LinkMap) -> ReducedSystem {
    let (mut mass, mut stiffness) = (Triplets::new(N, N), Triplets::new(N, N));
    let mut rest = Triplets::new(N, N);
    for i in 0..N {
        mass.add(i, i, if i % 3 == 0 { 0.0 } else { 2.0 + i as f64 });
        stiffness.add(i, i, 10.0);
        for j in [i + 1, i + 5] {
            if j < N {
                for (a, b, s) in [(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)] {
                    stiffness.add(a, b, s * (100.0 + 7.0 * i as f64));
                }
            }
        }
    }
    for (a, b, s) in [(3, 3, 5.0), (7, 7, 5.0), (3, 7, -5.0), (7, 3, -5.0)] {
        rest.add(a, b, s);
    }
    let (mass, stiffness) = (mass.build(), stiffness.build());
    let rayleigh = [0.3, 0.01];
    let low_rank = LowRank { u: Dense::from_columns(N, 2, some(2 * N, 3)), rate: vec![4.0, 9.0] };
    ReducedSystem {
        mass,
        damping: rest.build(),
        rayleigh,
        stiffness,
        modal: modal.then_some(low_rank),
        effective_k: vec![0.0; links.len()],
        links,
        forces: Product::new(Dense::zeros(N, 0)),
        shape: None,
        readers: Dense::zeros(N, 0),
        tied: 0,
    }
}

fn full(a: &Sparse) -> Dense {
    let mut d = Dense::zeros(a.rows(), a.columns());
    a.entries().for_each(|(i, j, v)| d[(i, j)] += v);
    d
}

fn close(a: &[f64], b: &[f64]) {
    assert_eq!(a.len(), b.len());
    let size = b.iter().fold(1e-3, |m: f64, x| m.max(x.abs()));
    for (x, y) in a.iter().zip(b) {
        assert!((x - y).abs() < 1e-10 * size, "{x} {y}");
    }
}

fn form(a: &Dense, x: &[f64]) -> f64 {
    let mut y = vec![0.0; x.len()];
    a.mul_add(1.0, x, &mut y);
    x.iter().zip(&y).map(|(a, b)| a * b).sum()
}

/// Steps of two sizes, one after the other, the way the link kernel makes them.
fn follows(alpha: f64, modal: bool, links: LinkMap) {
    let space = space(modal, links);
    let l = space.links.len();
    let (m, k) = (full(&space.mass), full(&space.stiffness));
    let [a0, a1] = space.rayleigh;
    let sum = [(a0, &space.mass), (a1, &space.stiffness), (1.0, &space.damping)];
    let mut c = full(&Sparse::combine(&sum));
    for (r, rate) in space.modal.iter().flat_map(|m| m.rate.iter().enumerate()) {
        let u = space.modal.as_ref().map_or(&[][..], |m| m.u.column(r));
        for i in 0..N {
            for j in 0..N {
                c[(i, j)] += rate * u[i] * u[j];
            }
        }
    }
    let mut b = Dense::zeros(l, N);
    for a in 0..l {
        space.links.row(a).for_each(|(i, x)| b[(a, i)] += x);
    }
    let (gamma, beta) = newmark(alpha);
    let w = 1.0 + alpha;
    let mut hht = Hht::new(space, alpha);
    let mut from = some(3 * N, 1);
    for (number, dt) in [(0, 0.02), (1, 0.05), (2, 0.02)] {
        let [load0, load1] = [4, 5].map(|s| some(N, s + number));
        let [pseudo0, guess, pseudo1] = [6, 8, 7].map(|s| some(l, s + number));
        let change: Vec<f64> = pseudo1.iter().zip(&guess).map(|(f, g)| f - g).collect();
        let (u, v, a) = (&from[..N], &from[N..2 * N], &from[2 * N..]);
        let balance = |p: &[f64], u: &[f64], v: &[f64], f: &[f64]| {
            let mut s = p.to_vec();
            c.mul_add(-1.0, v, &mut s);
            k.mul_add(-1.0, u, &mut s);
            b.transpose_mul_add(-1.0, f, &mut s);
            s
        };
        let ahead: Vec<f64> =
            (0..N).map(|i| u[i] + dt * v[i] + dt * dt * (0.5 - beta) * a[i]).collect();
        let rate: Vec<f64> = (0..N).map(|i| v[i] + dt * (1.0 - gamma) * a[i]).collect();
        let (s0, s1) = (balance(&load0, u, v, &pseudo0), balance(&load1, &ahead, &rate, &pseudo1));
        let mut matrix = Dense::zeros(N, N);
        for (i, x) in matrix.values_mut().iter_mut().enumerate() {
            let (c, k) = (c.values()[i], k.values()[i]);
            *x = m.values()[i] + w * (gamma * dt * c + beta * dt * dt * k);
        }
        let lu = DenseLu::new(&matrix);
        let mut now: Vec<f64> = s0.iter().zip(&s1).map(|(x, y)| w * y - alpha * x).collect();
        lu.solve(&mut now);
        let u1: Vec<f64> = (0..N).map(|i| ahead[i] + beta * dt * dt * now[i]).collect();
        let v1: Vec<f64> = (0..N).map(|i| rate[i] + gamma * dt * now[i]).collect();

        hht.prepare(&StepKey::exact(dt)).unwrap();
        let (mut d, mut velocity, mut to) = (vec![0.0; l], vec![0.0; l], vec![f64::NAN; 3 * N]);
        let before = Forces { loads: [&load0, &load1], pseudo0: &pseudo0, pseudo1: &guess };
        let all: Vec<usize> = (0..l).collect();
        let wanted = Wanted { d: &mut d, v: &mut velocity, rate_dependent: &all };
        hht.predict(&from, &before, &mut to, wanted);
        let compliance = hht.compliance();
        compliance.g.mul_add(-1.0, &change, &mut d);
        compliance.h.mul_add(-1.0, &change, &mut velocity);
        // G as it is defined.
        let mut image = b.transpose();
        lu.solve_columns(&mut image);
        let mut g = b.times(&image);
        g.values_mut().iter_mut().for_each(|x| *x *= w * beta * dt * dt);
        close(compliance.g.all().values(), g.values());
        let forces = Forces { pseudo1: &pseudo1, ..before };
        hht.correct(&from, &forces, &mut to);
        close(&to, &[u1.clone(), v1.clone(), now].concat());
        let (mut expected, mut expected_rate) = (vec![0.0; l], vec![0.0; l]);
        b.mul_add(1.0, &u1, &mut expected);
        b.mul_add(1.0, &v1, &mut expected_rate);
        close(&d, &expected);
        close(&velocity, &expected_rate);

        let work = hht.work(&from, &to, &forces);
        let moved: Vec<f64> = (0..N).map(|i| u1[i] - u[i]).collect();
        let mean: Vec<f64> = (0..N).map(|i| 0.5 * (v1[i] + v[i])).collect();
        let mut stretch = vec![0.0; l];
        b.mul_add(1.0, &moved, &mut stretch);
        let external: f64 = (0..N).map(|i| 0.5 * (load0[i] + load1[i]) * moved[i]).sum();
        let links: f64 = (0..l).map(|i| 0.5 * (pseudo0[i] + pseudo1[i]) * stretch[i]).sum();
        let damping = dt * form(&c, &mean);
        let (kinetic, strain) = (0.5 * form(&m, &v1), 0.5 * form(&k, &u1));
        let before = 0.5 * form(&m, v) + 0.5 * form(&k, u);
        let algorithmic = external - links - damping - (kinetic + strain - before);
        close(
            &[work.external, work.links, work.damping, work.kinetic, work.strain, work.algorithmic],
            &[external, links, damping, kinetic, strain, algorithmic],
        );
        from = to;
    }
    assert_eq!(hht.factorizations(), 2);
}

/// Rows of few terms: between places, on one place, on none.
fn few() -> LinkMap {
    LinkMap::Sparse(vec![
        vec![(2, 1.0), (9, -1.0)],
        vec![(17, 0.5)],
        vec![],
        vec![(9, 2.0), (3, 0.0)],
    ])
}

#[test]
fn a_step_solves_the_equations_of_the_method() {
    for alpha in [0.0, -0.1, -1.0 / 3.0] {
        for modal in [false, true] {
            follows(alpha, modal, few());
            follows(alpha, modal, LinkMap::full(Dense::from_columns(N, 3, some(3 * N, 2))));
            follows(alpha, modal, LinkMap::Sparse(Vec::new()));
        }
    }
}
