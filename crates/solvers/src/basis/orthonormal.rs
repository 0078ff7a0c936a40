//! M-orthonormal vectors under construction.

use super::attachment::Following;
use super::block::{Block, Mass, Turned};
use super::condensation::Condensation;
use trilith_linalg::{Columns, Dense, Sparse};

/// A static shape of a DOF with next to no mass is not a mode: faster than this (rad/s) it would only
/// spoil the digits of the slow ones.
const FASTEST: f64 = 1e6;
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
    mass: Mass,
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
        let (sums, mass) = (rows.gather(&sums).into_owned(), Mass::new(rows.block(mass)));
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

    /// Images under M of all vectors from `first` on.
    pub(crate) fn images_since(&self, first: usize) -> Vec<Vec<f64>> {
        self.images((first..self.len()).map(|j| self.columns.column(j)))
    }

    /// Images under M of sums of the first vectors, as many as there are shares.
    pub(crate) fn images_of(&self, shares: &Dense) -> Vec<Vec<f64>> {
        let sums = self.columns.times(shares);
        self.images((0..sums.columns()).map(|j| sums.column(j)))
    }

    fn images<'b>(&self, x: impl Iterator<Item = &'b [f64]>) -> Vec<Vec<f64>> {
        self.mass.images(&x.collect::<Vec<_>>())
    }

    /// Orthonormalises vectors, of which the rows that are kept are given, and takes them up until `count` are there, but
    /// for those of which nothing is left, and those of which what is left would be too fast.
    pub(crate) fn take_until(&mut self, count: usize, mut x: Vec<Vec<f64>>, cut: FrequencyCut) {
        while !x.is_empty() && self.len() < count {
            let rest = x.split_off(x.len().min(count - self.len()));
            self.take(x, Origin::Anywhere, cut);
            x = rest;
        }
    }

    /// The same of all: what they have in common with those before is taken out, then what they have in common with each
    /// other, and both once more, which leaves rounding. \[Barlow & Smoktunowicz 2013\]
    pub(crate) fn take(&mut self, x: Vec<Vec<f64>>, origin: Origin, cut: FrequencyCut) {
        let first = if origin == Origin::Recursion { self.starts[0] } else { 0 };
        let mut block = Block::new(x, &self.mass);
        while !block.is_empty() {
            block.project(&self.columns, first, &self.mass);
            let (mut later, turned) = block.untangle();
            block.turn_images(&turned, &self.mass);
            if cut == FrequencyCut::Modes {
                later.extend(self.leave_out_fast(&mut block, &turned));
            }
            while block.project_again(&self.columns, &self.mass) {
                let (more, turned) = block.untangle();
                block.turn_images(&turned, &self.mass);
                later.extend(more);
            }
            later.extend(block.untangle().0);
            block.x.iter_mut().for_each(|x| self.place(x));
            self.columns.extend(&block.x);
            block = later;
            block.look(&self.mass);
        }
    }

    /// Puts massless directions of a vector in their place.
    fn place(&self, x: &mut Vec<f64>) {
        if let Some(following) = &self.following {
            let mut all = self.rows.complete(x);
            following.place(&mut all);
            *x = self.rows.gather(&all).into_owned();
        }
    }

    /// Leaves out the first of orthonormal vectors that is too fast, and gives back those behind it as they were before
    /// what they have in common with it was taken out.
    fn leave_out_fast(&mut self, block: &mut Block, turned: &Turned) -> Block {
        let is_fast = |x: &Vec<f64>| {
            if self.following.is_none() {
                return self.is_too_fast(x);
            }
            let mut x = x.clone();
            self.place(&mut x);
            self.is_too_fast(&x)
        };
        let Some(at) = block.x.iter().position(is_fast) else { return Block::default() };
        let mut fast = block.split_off(at);
        fast.untangled(at, turned);
        let behind = fast.split_off(1);
        for mut x in fast.x {
            self.place(&mut x);
            self.left_out.push(x);
        }
        behind
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
        let mut take = |x| {
            let before = span.len();
            span.take(x, Origin::Anywhere, FrequencyCut::None);
            span.len() - before
        };
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

    /// What a vector has in common with one that is left out stays in it.
    #[test]
    fn those_behind_one_that_is_too_fast_are_kept_whole() {
        let diagonal = |values: [f64; 4]| {
            let mut t = Triplets::new(4, 4);
            values.iter().enumerate().for_each(|(i, v)| t.add(i, i, *v));
            t.build()
        };
        let (mass, k) = (diagonal([1.0; 4]), diagonal([1e3, 1.5e12, 1e3, 2e3]));
        let stiffness = [(1.0, &k)];
        let all = Condensation::none(4);
        let mut span = OrthonormalBasis::new(&all, &mass, &stiffness, None, 4);
        let block = [[1.0, 0.0, 0.0, 0.0], [1.0, 2.0, 0.0, 0.0], [0.0, 3.0, 3.0, 0.0]];
        let block = block.map(|x| x.to_vec()).to_vec();
        span.take(block, Origin::Anywhere, FrequencyCut::Modes);
        let (left_out, half) = (span.left_out(), 0.5f64.sqrt());
        assert_eq!((left_out.len(), span.len()), (1, 2));
        let v = span.into_dense();
        for (found, expected) in [
            (v.column(0), [1.0, 0.0, 0.0, 0.0]),
            (v.column(1), [0.0, half, half, 0.0]),
            (&left_out[0], [0.0, 1.0, 0.0, 0.0]),
        ] {
            found.iter().zip(expected).for_each(|(x, e)| assert!((x - e).abs() < 1e-14, "{x} {e}"));
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
        let mut kept = |x: [f64; 5], cut| {
            let before = span.len();
            span.take(vec![x.to_vec()], Origin::Anywhere, cut);
            span.len() > before
        };
        let unit = |i: usize| std::array::from_fn(|j| if i == j { 3.0 } else { 0.0 });
        // ω² of 1e11, 3e12 and 3.9e12/4.
        assert_eq!([0, 1, 2].map(|i| kept(unit(i), FrequencyCut::Modes)), [true, false, true]);
        assert!(kept(unit(1), FrequencyCut::None));
        // Two that move with each other, and against each other: in the bound that is the same.
        assert!(kept([0.0, 0.0, 0.0, 1.0, 1.0], FrequencyCut::Modes));
        assert!(!kept([0.0, 0.0, 0.0, 1.0, -1.0], FrequencyCut::Modes));
    }
}
