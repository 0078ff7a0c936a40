//! Newton's method for the links of a step.
//!
//! Matrices are kept over iterations and over steps of one size. One serves while the laws are on the
//! branches that it was made on, and while the residual falls fast with it. One
//! that was just made may be followed by shorter steps along a line, or by a whole one where none helps.

use super::dense::{Factor, add_product, dot};
use super::stages::{Known, Room, Tangent, Values};

/// Share of the size of an unknown of the links within which the method stops.
const ACCURACY: f64 = 1e-12;
/// Share of the largest deformation that may be rounding.
const ROUNDING: f64 = 1e-15;
/// A kept matrix serves while it leaves no more than this share of the residual.
const SERVES: f64 = 0.05;
/// Matrices kept for a step size, at most.
const MATRICES: usize = 4;
/// Whole steps at most that are made where no shorter one helps, and the shortest share of a step.
const LEAPS: usize = 6;
const SHORTEST: f64 = 0.05;
/// Iterations at most.
const MOST: usize = 60;

/// A matrix of the method.
pub struct Kept {
    links: Vec<Tangent>,
    /// Unknown deformations whose links give forces, and the system over them.
    active: Vec<usize>,
    factor: Option<Factor>,
    /// Weights of the residuals.
    weights: Vec<f64>,
    /// Branches of the laws that it was made on.
    branches: Vec<u32>,
}

/// Deformations and own unknowns at the stages, and forces there.
pub struct Settled {
    /// By stages.
    pub x: Vec<f64>,
    /// By stages.
    pub f: Vec<f64>,
    /// Branches of the laws, by stages.
    pub branches: Vec<u32>,
}

/// Room for the numbers of an iteration, and the work done in it.
#[derive(Default)]
pub struct Space {
    room: Room,
    a: Vec<f64>,
    b: Vec<f64>,
    /// Multiplications or so.
    pub work: f64,
}

/// Places of the deformations of a link at the three stages.
fn places(at: [usize; 4], l: usize) -> impl Iterator<Item = usize> + Clone {
    let [first, m, ..] = at;
    (0..3).flat_map(move |stage| (0..m).map(move |c| stage * l + first + c))
}

/// Places of the own unknowns of a link at the three stages, from the first of all.
fn own_places(at: [usize; 4], nz: usize) -> impl Iterator<Item = usize> + Clone {
    let [_, _, own, k] = at;
    (0..3).flat_map(move |stage| (0..k).map(move |c| stage * nz + own + c))
}

impl Kept {
    fn new(known: &Known<'_>, x: &[f64], branches: &[u32], space: &mut Space) -> Option<Self> {
        let links = known.tangents(x, &mut space.room)?;
        let (l, nz) = known.count;
        let (l3, big) = (3 * l, &known.response.links);
        let mut weights = vec![1.0; 3 * (l + nz)];
        let mut active = Vec::with_capacity(l3);
        for link in &links {
            if link.f.iter().any(|x| *x != 0.0) {
                active.extend(places(link.at, l));
            }
            for (i, size) in own_places(link.at, nz).zip(&link.sizes) {
                weights[l3 + i] = if *size > 0.0 { size.recip() } else { 1.0 };
            }
        }
        let n = active.len();
        space.work += (n as f64).powi(3) / 3.0 + 20.0 * (n * n) as f64 + 500.0 * links.len() as f64;
        let mut a = vec![0.0; n * n];
        for (row, i) in a.chunks_exact_mut(n.max(1)).zip(&active) {
            let of = &big[i * l3..(i + 1) * l3];
            let mut column = 0;
            for link in links.iter().filter(|t| t.f.iter().any(|x| *x != 0.0)) {
                let m3 = 3 * link.at[1];
                for (k, place) in places(link.at, l).enumerate() {
                    let share = of[place];
                    let to = &mut row[column..column + m3];
                    to.iter_mut().zip(&link.f[k * m3..]).for_each(|(x, f)| *x += share * f);
                }
                column += m3;
            }
        }
        for (j, i) in active.iter().enumerate() {
            a[j * n + j] += 1.0;
            let size = a[j * n..(j + 1) * n].iter().fold(1.0_f64, |s, x| s.max(x.abs()));
            weights[*i] = size.recip();
            // Rows of one size, for the choice of pivots.
            a[j * n..(j + 1) * n].iter_mut().for_each(|x| *x /= size);
        }
        let factor = Factor::with_loose(a, n);
        Some(Self { links, active, factor, weights, branches: branches.to_vec() })
    }

    /// The step that the residual asks for; none where the matrix is singular.
    fn step(&self, known: &Known<'_>, r: &[f64], space: &mut Space) -> Option<Vec<f64>> {
        let (l, nz) = known.count;
        let (l3, big) = (3 * l, &known.response.links);
        let factor = self.factor.as_ref()?;
        let mut out: Vec<f64> = r.iter().map(|x| -x).collect();
        let mut forces = vec![0.0; l3];
        // Own unknowns alone, and the forces they give.
        for link in self.links.iter().filter(|t| t.own.is_some()) {
            let own = link.own.as_ref()?;
            space.a.clear();
            space.a.extend(own_places(link.at, nz).map(|i| -r[l3 + i]));
            own.solve(&mut space.a, &mut space.b);
            own_places(link.at, nz).zip(&space.a).for_each(|(i, x)| out[l3 + i] = *x);
            let k3 = space.a.len();
            for (i, row) in places(link.at, l).zip(link.f_by_own.chunks_exact(k3)) {
                forces[i] -= dot(row, &space.a);
            }
        }
        let nonzero = forces.iter().any(|x| *x != 0.0);
        if nonzero {
            add_product(&mut out[..l3], big, &forces);
        }
        let mut some: Vec<f64> = self.active.iter().map(|i| out[*i] * self.weights[*i]).collect();
        factor.solve(&mut some, &mut space.b);
        for (i, x) in self.active.iter().zip(&some) {
            out[*i] = *x;
        }
        // What the forces of the active ones do to the rest.
        if self.active.len() < l3 {
            forces.fill(0.0);
            let mut from = 0;
            for link in self.links.iter().filter(|t| t.f.iter().any(|x| *x != 0.0)) {
                let m3 = 3 * link.at[1];
                for (i, row) in places(link.at, l).zip(link.f.chunks_exact(m3)) {
                    forces[i] -= dot(row, &some[from..from + m3]);
                }
                from += m3;
            }
            let mut is = vec![false; l3];
            self.active.iter().for_each(|i| is[*i] = true);
            for i in (0..l3).filter(|i| !is[*i]) {
                out[i] += dot(&big[i * l3..(i + 1) * l3], &forces);
            }
        }
        for link in self.links.iter().filter(|t| t.own.is_some()) {
            space.a.clear();
            space.a.extend(places(link.at, l).map(|i| out[i]));
            let m3 = space.a.len();
            for (i, row) in own_places(link.at, nz).zip(link.follow.chunks_exact(m3)) {
                out[l3 + i] -= dot(row, &space.a);
            }
        }
        space.work += 2.0 * (self.active.len() as f64).powi(2);
        out.iter().all(|x| x.is_finite()).then_some(out)
    }
}

/// Solves the links of a step from a guess; `sizes`: what unknowns are measured against.
pub fn solve(
    known: &Known<'_>,
    guess: Vec<f64>,
    sizes: &[f64],
    kept: &mut Vec<Kept>,
    space: &mut Space,
) -> Option<Settled> {
    let l3 = 3 * known.count.0;
    let mut x = guess;
    let (mut it, mut trial) = (Values::default(), Values::default());
    let (mut r, mut rest, mut next) = (Vec::new(), Vec::new(), x.clone());
    known.values(&x, &mut space.room, &mut it);
    known.residual(&x, &it, &mut r);
    // The matrix was just made; it was seen to serve.
    let (mut fresh, mut proved) = (false, false);
    let (mut refine, mut leapt) = (0, 0);
    for _ in 0..MOST {
        space.work += (l3 * l3) as f64 + 300.0 * l3 as f64;
        match kept.iter().position(|k| k.branches == it.branches) {
            Some(i) => kept.swap(0, i),
            None => {
                kept.insert(0, Kept::new(known, &x, &it.branches, space)?);
                kept.truncate(MATRICES);
                fresh = true;
            }
        }
        let matrix = &kept[0];
        let largest = (0..l3).map(|i| sizes[i].max(x[i].abs())).fold(1e-300, f64::max);
        let limit = |i: usize| (ACCURACY * sizes[i].max(x[i].abs())).max(ROUNDING * largest);
        let limits: Vec<f64> = (0..x.len()).map(limit).collect();
        // Where a matrix is not finite, the residual itself is the step.
        let step = matrix.step(known, &r, space).unwrap_or_else(|| {
            r.iter().enumerate().map(|(i, r)| if i < l3 { -r } else { 0.0 }).collect()
        });
        let size = |r: &[f64]| {
            let share = |i: usize| r[i] * matrix.weights[i] / limits[i];
            (0..r.len()).map(|i| share(i).powi(2)).sum::<f64>().sqrt()
        };
        let within = |much: f64| step.iter().zip(&limits).all(|(s, t)| s.abs() <= much * t);
        let (before, done, small) = (size(&r), within(1.0), within(1e3));
        let (mut share, mut leaps) = (1.0, false);
        // Whether it serves, and the share of the residual that a whole step leaves.
        let (serves, left) = loop {
            next.iter_mut().zip(x.iter().zip(&step)).for_each(|(n, (x, s))| *n = x + share * s);
            known.values(&next, &mut space.room, &mut trial);
            known.residual(&next, &trial, &mut rest);
            let after = size(&rest);
            let fell = after <= SERVES * before;
            let left = if after == 0.0 { 0.0 } else { after / before };
            if !fresh {
                break (fell || (proved && (done || after < 1.0)), left);
            }
            let falls = after <= before * (1.0 - 0.1 * share);
            if small || falls || leaps || share < 0.02 || after < 1.0 {
                proved = fell;
                break (true, left);
            }
            if share < SHORTEST && leapt < LEAPS {
                // Residuals of other branches have other sizes: a whole step may lead to the right one.
                (share, leaps, leapt) = (1.0, true, leapt + 1);
                continue;
            }
            share *= 0.5;
        };
        if !serves {
            // Another matrix, from the same place.
            kept.remove(0);
            proved = false;
            continue;
        }
        let stays = share == 1.0 && matrix.branches == trial.branches;
        // The next step would be as much shorter as the residual is.
        let done = done || (stays && left < SERVES && within(0.1 / left.max(1e-12)));
        refine += usize::from(small || before < 1.0);
        // A matrix that was just made serves on after whole steps.
        if share < 1.0 {
            kept.remove(0);
        }
        proved |= !fresh;
        fresh = false;
        std::mem::swap(&mut x, &mut next);
        std::mem::swap(&mut it, &mut trial);
        std::mem::swap(&mut r, &mut rest);
        if !x.iter().all(|v| v.is_finite()) {
            break;
        }
        // Rounding: steps that no longer shrink but are small, or follow a residual that is.
        if done || refine > 4 {
            return Some(Settled { x, f: it.f, branches: it.branches });
        }
    }
    kept.clear();
    None
}
