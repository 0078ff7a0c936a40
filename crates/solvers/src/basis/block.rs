//! Vectors on their way into a basis: a block that becomes orthonormal.
//!
//! ```text
//!   Xᵀ M X = S L Lᵀ S,  S the norms      X ← X S⁻¹ L⁻ᵀ                 what they have in common with each other
//! ```
//!
//! A vector that is nearly a sum of others before it waits until these are taken: the Gram matrix squares what is
//! left of it, and so its digits.

use std::cell::RefCell;
use trilith_linalg::threads::share;
use trilith_linalg::{Columns, Dense, Sparse, dot, mutual_products, turn_each};

/// Share of its M-norm that a new vector must keep to be more than rounding. It may be small: on soft
/// effective stiffnesses every static shape is mostly a rigid motion, which the vectors before it hold already.
const KEEP: f64 = 1e-8;
/// Where a vector keeps this share of its norm when its shares in others are taken out, what is left is
/// orthogonal to the others to rounding. \[Daniel, Gragg, Kaufman & Stewart 1976\]
const ORTHOGONAL: f64 = 0.5;
/// A vector of whose square others in its block leave less than this waits for them.
const APART: f64 = 1e-6;
/// An image of which less is left than this, of its square, is made anew.
const CLEAN: f64 = 1e-2;

/// A mass matrix, and memory for its products from one to the next.
pub(super) struct Mass {
    of: Sparse,
    room: RefCell<Vec<f64>>,
}

impl Mass {
    pub(super) fn new(of: Sparse) -> Self {
        Self { of, room: RefCell::default() }
    }

    /// M X.
    pub(super) fn images(&self, x: &[impl AsRef<[f64]>]) -> Vec<Vec<f64>> {
        self.of.symmetric_images_in(x, &mut self.room.borrow_mut())
    }
}

/// Vectors, of which the rows that are kept are given.
#[derive(Debug, Default)]
pub(super) struct Block {
    pub(super) x: Vec<Vec<f64>>,
    /// M X.
    images: Vec<Vec<f64>>,
    /// M-norms now, and at first.
    norms: Vec<f64>,
    before: Vec<f64>,
}

/// How vectors became orthonormal: those that there were are these times an upper triangle.
pub(super) struct Turned {
    upper: Dense,
    /// Its inverse.
    turn: Dense,
    /// Norms at first of those that there were.
    before: Vec<f64>,
}

impl Block {
    /// Of any size; what is zero or no number is left out.
    pub(super) fn new(x: Vec<Vec<f64>>, mass: &Mass) -> Self {
        let mut each: Vec<(Vec<f64>, bool)> = x.into_iter().map(|x| (x, true)).collect();
        let numbers = each.iter().map(|(x, _)| x.len()).sum::<usize>();
        share(4 * numbers, each.iter_mut().collect(), |(x, is_kept)| {
            let size = x.iter().fold(0.0f64, |a, b| a.max(b.abs()));
            *is_kept = size > 0.0 && x.iter().all(|v| v.is_finite());
            x.iter_mut().for_each(|v| *v /= size);
        });
        let x = each.into_iter().filter(|(_, is_kept)| *is_kept).map(|(x, _)| x).collect();
        let mut block = Self { x, ..Self::default() };
        block.look(mass);
        block.before.clone_from(&block.norms);
        block.retain(|_, before| before > 0.0);
        block
    }

    pub(super) fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Images and norms anew.
    pub(super) fn look(&mut self, mass: &Mass) {
        self.images = mass.images(&self.x);
        self.measure();
    }

    /// Norms anew.
    fn measure(&mut self) {
        self.norms = vec![0.0; self.x.len()];
        let operations = 2 * self.x.iter().map(Vec::len).sum::<usize>();
        let each = self.norms.iter_mut().zip(self.x.iter().zip(&self.images));
        share(operations, each.collect(), |(norm, (x, m))| *norm = dot(x, m).max(0.0).sqrt());
    }

    /// Keeps those whose norms now and at first are so.
    fn retain(&mut self, is_kept: impl Fn(f64, f64) -> bool) {
        let which =
            (0..self.x.len()).filter(|i| is_kept(self.norms[*i], self.before[*i])).collect();
        *self = self.pick(which);
    }

    /// Takes some of them out, in their order.
    fn pick(&mut self, which: Vec<usize>) -> Self {
        let take =
            |of: &mut Vec<Vec<f64>>| which.iter().map(|i| std::mem::take(&mut of[*i])).collect();
        let of = |of: &[f64]| which.iter().map(|i| of[*i]).collect();
        Self {
            x: take(&mut self.x),
            images: take(&mut self.images),
            norms: of(&self.norms),
            before: of(&self.before),
        }
    }

    /// More behind these.
    pub(super) fn extend(&mut self, more: Self) {
        self.x.extend(more.x);
        self.images.extend(more.images);
        self.norms.extend(more.norms);
        self.before.extend(more.before);
    }

    /// Those from one on.
    pub(super) fn split_off(&mut self, at: usize) -> Self {
        Self {
            x: self.x.split_off(at),
            images: self.images.split_off(at),
            norms: self.norms.split_off(at),
            before: self.before.split_off(at),
        }
    }

    /// Takes their shares in columns from `first` on out, and lets go of what has nothing left.
    pub(super) fn project(&mut self, columns: &Columns, first: usize, mass: &Mass) {
        columns.take_out(first, &mut self.x, &self.images);
        self.look(mass);
        self.retain(|now, before| now > KEEP * before);
    }

    /// The same in all columns. True where one of them has lost so much that it may still have shares in them; where none
    /// has, the images stay those of before. Products with them are right all the same, as what was taken out has none:
    /// (x − V s)ᵀ M x = (x − V s)ᵀ M (x − V s).
    pub(super) fn project_again(&mut self, columns: &Columns, mass: &Mass) -> bool {
        columns.take_out(0, &mut self.x, &self.images);
        let earlier = std::mem::take(&mut self.norms);
        self.measure();
        if self.norms.iter().zip(earlier).all(|(now, earlier)| *now >= ORTHOGONAL * earlier) {
            return false;
        }
        self.look(mass);
        self.retain(|now, before| now > KEEP * before);
        true
    }

    /// Makes them orthonormal among each other; their images stay those of before. Those that are nearly sums of others
    /// before them are taken out, and returned as they are, with how the others have been turned.
    pub(super) fn untangle(&mut self) -> (Self, Turned) {
        let gram = mutual_products(&self.x, &self.images);
        let (apart, near, lower) = independent(&gram);
        let later = self.pick(near);
        *self = self.pick(apart);
        let count = self.x.len();
        let mut upper = Dense::zeros(count, count);
        for j in 0..count {
            (0..=j).for_each(|i| upper[(i, j)] = lower[(j, i)] * self.norms[j]);
        }
        // U⁻¹, column by column.
        let mut turn = Dense::identity(count);
        for j in 0..count {
            for i in (0..=j).rev() {
                let sum: f64 = (i + 1..=j).map(|l| upper[(i, l)] * turn[(l, j)]).sum();
                turn[(i, j)] = (turn[(i, j)] - sum) / upper[(i, i)];
            }
        }
        turn_each(&mut self.x, &turn);
        let before = self.before.clone();
        for j in 0..count {
            self.before[j] /= upper[(j, j)];
            self.norms[j] = 1.0;
        }
        (later, Turned { upper, turn, before })
    }

    /// Turns their images as they have been turned.
    pub(super) fn turn_images(&mut self, turned: &Turned, mass: &Mass) {
        let norm = |j: usize| turned.upper.column(j).iter().map(|u| u * u).sum::<f64>();
        let is_clean = |j: usize| turned.upper[(j, j)].powi(2) > CLEAN * norm(j);
        if (0..self.x.len()).all(is_clean) {
            turn_each(&mut self.images, &turned.turn);
        } else {
            // The last digits of an image from which much was taken are gone.
            self.images = mass.images(&self.x);
        }
    }

    /// Makes these, the last of a block from `at` on, what they were before it was untangled, but for those before them.
    /// Images and norms stay as they are.
    pub(super) fn untangled(&mut self, at: usize, turned: &Turned) {
        let count = self.x.len();
        let mut back = Dense::zeros(count, count);
        for j in 0..count {
            (0..=j).for_each(|i| back[(i, j)] = turned.upper[(at + i, at + j)]);
        }
        turn_each(&mut self.x, &back);
        self.before = turned.before[at..].to_vec();
    }
}

/// Which vectors with this Gram matrix are no sums of others before them, which nearly are, and L of the former, whose
/// Gram matrix is L Lᵀ once they are scaled to unit norms.
fn independent(gram: &Dense) -> (Vec<usize>, Vec<usize>, Dense) {
    let count = gram.columns();
    let norms: Vec<f64> = (0..count).map(|i| gram[(i, i)].max(0.0).sqrt()).collect();
    let (mut apart, mut near): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut lower = Dense::zeros(count, count);
    for j in 0..count {
        let row = apart.len();
        for (i, other) in apart.iter().enumerate() {
            let sum: f64 = (0..i).map(|l| lower[(i, l)] * lower[(row, l)]).sum();
            let cosine = gram[(j, *other)] / (norms[j] * norms[*other]);
            lower[(row, i)] = (cosine - sum) / lower[(i, i)];
        }
        let left = 1.0 - (0..row).map(|l| lower[(row, l)].powi(2)).sum::<f64>();
        if left > APART {
            lower[(row, row)] = left.sqrt();
            apart.push(j);
        } else {
            near.push(j);
        }
    }
    (apart, near, lower)
}
