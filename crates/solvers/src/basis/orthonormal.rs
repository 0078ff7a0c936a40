//! M-orthonormal vectors under construction.

use super::attachment::Following;
use super::condensation::Condensation;
use crate::vector::dot;
use trilith_linalg::{Columns, Dense, Sparse};

/// Share of its M-norm that a new vector must keep to be more than rounding. It may be small: on soft
/// effective stiffnesses every static shape is mostly a rigid motion, which the vectors before it hold already.
const KEEP: f64 = 1e-8;
/// A static shape of a DOF with next to no mass is not a mode: faster than this (rad/s) it would only
/// spoil the digits of the slow ones.
const FASTEST: f64 = 1e6;
/// Where a vector keeps this share of its norm when its shares in others are taken out, what is left is
/// orthogonal to the others to rounding. \[Daniel, Gragg, Kaufman & Stewart 1976\]
const ORTHOGONAL: f64 = 0.5;

/// Where new vectors come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// K̂⁻¹M of the block before: K̂⁻¹M is symmetric in the product of M, so only the two blocks before
    /// have more than rounding in common with them.
    Recursion,
    /// Anything.
    Anywhere,
}

/// How fast new vectors may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FrequencyCut {
    /// As fast as modes of interest.
    Modes,
    None,
}

/// M-orthonormal vectors, block after block.
pub(super) struct OrthonormalBasis<'a> {
    rows: &'a Condensation,
    /// Of the rows that are kept.
    mass: Sparse,
    /// The stiffness as a sum, and a bound of the sum of magnitudes in each of its rows that are kept: what follows
    /// from them takes from the strain energy.
    stiffness: &'a [(f64, &'a Sparse)],
    sums: Vec<f64>,
    /// What puts massless directions in their place.
    following: Option<Following<'a>>,
    columns: Columns,
    /// First vectors of the two blocks before, and of this one.
    starts: [usize; 3],
    /// What was too fast for a mode of interest.
    left_out: Vec<Vec<f64>>,
}

impl<'a> OrthonormalBasis<'a> {
    /// None yet, with room for so many; the stiffness as a sum.
    pub(crate) fn new(
        rows: &'a Condensation,
        mass: &Sparse,
        stiffness: &'a [(f64, &'a Sparse)],
        following: Option<Following<'a>>,
        most: usize,
    ) -> Self {
        let order = mass.rows();
        let mut sums = vec![0.0; order];
        for (factor, part) in stiffness.iter().filter(|(factor, _)| *factor != 0.0) {
            let own = part.row_sums();
            sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += factor.abs() * own);
        }
        let (sums, mass) = (rows.gather(&sums).into_owned(), rows.block(mass));
        let columns = Columns::with_capacity(rows.kept(), most.min(rows.kept()));
        let (starts, left_out) = ([0; 3], Vec::new());
        Self { rows, mass, stiffness, sums, following, columns, starts, left_out }
    }

    pub(crate) fn len(&self) -> usize {
        self.columns.len()
    }

    pub(crate) fn into_dense(self) -> Dense {
        self.columns.into_dense()
    }

    /// What follows in the recursion is a new block.
    pub(crate) fn next_block(&mut self) {
        self.starts = [self.starts[1], self.starts[2], self.len()];
    }

    /// What was left out as too fast since this was asked last.
    pub(crate) fn left_out(&mut self) -> Vec<Vec<f64>> {
        std::mem::take(&mut self.left_out)
    }

    fn norms(&self, x: &[Vec<f64>]) -> (Vec<Vec<f64>>, Vec<f64>) {
        let images = self.mass.symmetric_images(x);
        let norms = x.iter().zip(&images).map(|(x, m)| dot(x, m).max(0.0).sqrt()).collect();
        (images, norms)
    }

    /// Orthonormalises vectors, of which the rows that are kept are given, and takes them up until `count` are there, but
    /// for those of which nothing is left, and those of which what is left would be too fast. Returns the images under M
    /// of those taken.
    pub(crate) fn take_until(
        &mut self,
        count: usize,
        mut x: Vec<Vec<f64>>,
        cut: FrequencyCut,
    ) -> Vec<Vec<f64>> {
        let mut images = Vec::new();
        while !x.is_empty() && self.len() < count {
            let rest = x.split_off(x.len().min(count - self.len()));
            images.extend(self.take(x, Origin::Anywhere, cut));
            x = rest;
        }
        images
    }

    /// The same of all.
    pub(crate) fn take(
        &mut self,
        mut x: Vec<Vec<f64>>,
        origin: Origin,
        cut: FrequencyCut,
    ) -> Vec<Vec<f64>> {
        let size = |x: &[f64]| x.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        x.retain(|x| x.iter().all(|v| v.is_finite()) && size(x) > 0.0);
        for x in &mut x {
            let scale = size(x);
            x.iter_mut().for_each(|v| *v /= scale);
        }
        let (mut images, before) = self.norms(&x);
        let first = if origin == Origin::Recursion { self.starts[0] } else { 0 };
        self.columns.take_out(first, &mut x, &images);
        let mut norms;
        (images, norms) = self.norms(&x);
        loop {
            self.columns.take_out(0, &mut x, &images);
            let earlier = norms;
            (images, norms) = self.norms(&x);
            let lost = |i: usize| norms[i] < ORTHOGONAL * earlier[i] && norms[i] > KEEP * before[i];
            if !(0..x.len()).any(lost) {
                break;
            }
        }
        let start = self.len();
        let mut kept: Vec<Vec<f64>> = Vec::with_capacity(x.len());
        for (((x, image), norm), before) in x.into_iter().zip(images).zip(norms).zip(before) {
            if before > 0.0 && norm > KEEP * before {
                kept.extend(self.keep([x, image], [norm, before], (start, &kept), cut));
            }
        }
        kept
    }

    /// Keeps a vector that is orthogonal to those before `start`, of which the images under M from there on are given;
    /// given with its own image, and with its norm now and at first.
    fn keep(
        &mut self,
        [mut x, mut image]: [Vec<f64>; 2],
        [mut norm, before]: [f64; 2],
        (start, others): (usize, &[Vec<f64>]),
        cut: FrequencyCut,
    ) -> Option<Vec<f64>> {
        if start < self.len() {
            let earlier = norm;
            for (j, other) in (start..).zip(others) {
                let share = dot(self.columns.column(j), &image);
                let less = |x: &mut [f64], of: &[f64]| {
                    x.iter_mut().zip(of).for_each(|(x, of)| *x -= share * of);
                };
                less(&mut x, self.columns.column(j));
                less(&mut image, other);
            }
            norm = dot(&x, &image).max(0.0).sqrt();
            if norm <= KEEP * before {
                return None;
            }
            if norm < ORTHOGONAL * earlier {
                // What was lost has brought shares in all others back to light.
                norm = self.again([&mut x, &mut image], norm, before)?;
            }
        }
        x.iter_mut().for_each(|v| *v /= norm);
        if let Some(following) = &self.following {
            let mut all = self.rows.complete(&x);
            following.place(&mut all);
            x = self.rows.gather(&all).into_owned();
        }
        if cut == FrequencyCut::Modes && self.is_too_fast(&x) {
            self.left_out.push(x);
            return None;
        }
        image.iter_mut().for_each(|v| *v /= norm);
        self.columns.push(&x);
        Some(image)
    }

    /// Takes the shares in all others out of a vector until it loses nothing by it; returns its norm, none where nothing
    /// is left of it.
    fn again(&self, [x, image]: [&mut Vec<f64>; 2], mut norm: f64, before: f64) -> Option<f64> {
        loop {
            // The last digits of an image from which much was taken are gone.
            *image = self.mass.mul(x);
            self.columns.take_out(0, std::slice::from_mut(x), std::slice::from_ref(image));
            *image = self.mass.mul(x);
            let earlier = norm;
            norm = dot(x, image).max(0.0).sqrt();
            if norm <= KEEP * before {
                return None;
            }
            if norm >= ORTHOGONAL * earlier {
                return Some(norm);
            }
        }
    }

    /// True for an M-orthonormal vector that is faster than any mode of interest.
    fn is_too_fast(&self, x: &[f64]) -> bool {
        let bound: f64 = x.iter().zip(&self.sums).map(|(x, sum)| x * x * sum).sum();
        // Most vectors need no closer look.
        let omega2 = || {
            let all = self.rows.complete(x);
            self.stiffness.iter().map(|(s, part)| s * part.bilinear(&all, &all)).sum::<f64>()
        };
        bound > FASTEST * FASTEST && omega2() > FASTEST * FASTEST
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_linalg::Triplets;

    #[test]
    fn vectors_that_are_nearly_alike_become_orthonormal_and_copies_are_left_out() {
        let n = 400;
        let mut mass = Triplets::new(n, n);
        (0..n / 2).for_each(|i| mass.add(2 * i, 2 * i, 1.0 + i as f64));
        let mass = mass.build();
        let number = |i: usize| ((i * 7919) % 1009) as f64 / 1009.0 - 0.5;
        let base: Vec<f64> = (0..n).map(number).collect();
        // A millionth apart: one pass would leave shares of 1e-10.
        let near = |c: usize| -> Vec<f64> {
            base.iter().enumerate().map(|(i, x)| x + 1e-6 * number(31 * i + c)).collect()
        };
        let all = Condensation::none(n);
        let mut span = OrthonormalBasis::new(&all, &mass, &[], None, 8);
        let mut take = |x| span.take(x, Origin::Anywhere, FrequencyCut::None).len();
        let sizes = [
            take(vec![base.clone()]),
            take(vec![near(1), near(2), base.clone()]),
            take(vec![near(3), near(1), vec![0.0; n]]),
        ];
        assert_eq!((sizes, span.len()), ([1, 2, 1], 4));
        let v = span.into_dense();
        for i in 0..4 {
            for j in 0..4 {
                let expected = if i == j { 1.0 } else { 0.0 };
                let found = mass.bilinear(v.column(i), v.column(j));
                assert!((found - expected).abs() < 1e-13, "{i} {j} {found}");
            }
        }
    }

    #[test]
    fn what_is_faster_than_any_mode_of_interest_is_left_out() {
        let matrix = |diagonal: [f64; 5], coupled: f64| {
            let mut t = Triplets::new(5, 5);
            diagonal.iter().enumerate().for_each(|(i, v)| t.add(i, i, *v));
            t.add(3, 4, coupled);
            t.add(4, 3, coupled);
            t.build()
        };
        let mass = matrix([1.0, 1.0, 4.0, 1.0, 1.0], 0.0);
        let k = matrix([1e11, 2e12, 1e12, 9e12, 9e12], -9e12);
        let more = matrix([1.0, 1e12, 2.9e12, 0.0, 0.0], 0.0);
        let stiffness = [(1.0, &k), (1.0, &more)];
        let all = Condensation::none(5);
        let mut span = OrthonormalBasis::new(&all, &mass, &stiffness, None, 5);
        let mut kept =
            |x: [f64; 5], cut| span.take(vec![x.to_vec()], Origin::Anywhere, cut).len() == 1;
        let unit = |i: usize| std::array::from_fn(|j| if i == j { 3.0 } else { 0.0 });
        // ω² of 1e11, 3e12 and 3.9e12/4.
        assert_eq!([0, 1, 2].map(|i| kept(unit(i), FrequencyCut::Modes)), [true, false, true]);
        assert!(kept(unit(1), FrequencyCut::None));
        // Two that move with each other, and against each other: in the bound that is the same.
        assert!(kept([0.0, 0.0, 0.0, 1.0, 1.0], FrequencyCut::Modes));
        assert!(!kept([0.0, 0.0, 0.0, 1.0, -1.0], FrequencyCut::Modes));
    }
}
