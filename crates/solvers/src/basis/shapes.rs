//! Vectors of a basis, of which only the rows are kept that the others follow from.
//!
//! ```text
//!   Φ = ( V T   Ψ )        V: vectors in the order in which they were found, shared by all bases of a structure
//!                          T: what turns them into modes;  Ψ: static shapes
//! ```
//!
//! V is as long as the structure has equations, T as the basis has vectors: rows, loads and forms of Φ are those of V
//! turned by T, and no basis needs a copy of V.

use super::condensation::Condensation;
use std::sync::Arc;
use trilith_linalg::threads::share;
use trilith_linalg::{Dense, Sparse};

/// Vectors completed together: those that two threads solve for at once.
const BLOCK: usize = 16;
/// Modes made of vectors together.
const TOGETHER: usize = 16;
/// Operations that completing takes for each equation, about.
const COMPLETING: usize = 20;

/// Vectors over the free DOFs: free DOFs × number.
#[derive(Clone, Debug)]
pub(crate) struct Shapes {
    rows: Arc<Condensation>,
    /// V and perhaps more behind them: rows that are kept × number.
    vectors: Arc<Dense>,
    /// T, which is square.
    turn: Dense,
    /// Ψ: rows that are kept × number.
    statics: Dense,
}

/// The free DOFs at these coordinates, which are themselves those where there is no shape.
pub(crate) fn expand(shape: Option<&Shapes>, q: &[f64]) -> Vec<f64> {
    shape.map_or_else(|| q.to_vec(), |shape| shape.expand(q))
}

impl Shapes {
    /// Of the rows that are kept.
    pub(crate) fn new(rows: Arc<Condensation>, kept: Dense) -> Self {
        let (turn, statics) = (Dense::identity(kept.columns()), Dense::zeros(kept.rows(), 0));
        Self { rows, vectors: Arc::new(kept), turn, statics }
    }

    /// The first of the vectors that these are sums of.
    pub(crate) fn first(&self, count: usize) -> Self {
        let (rows, vectors) = (Arc::clone(&self.rows), Arc::clone(&self.vectors));
        let statics = Dense::zeros(vectors.rows(), 0);
        Self { rows, vectors, turn: Dense::identity(count), statics }
    }

    /// The same sums of the same vectors, where other rows are kept for the same reasons; without static shapes.
    pub(crate) fn with_rows(&self, rows: Arc<Condensation>) -> Self {
        let vectors = Arc::clone(&self.vectors);
        let statics = Dense::zeros(vectors.rows(), 0);
        Self { rows, vectors, turn: self.turn.clone(), statics }
    }

    pub(crate) fn len(&self) -> usize {
        self.modes() + self.statics.columns()
    }

    /// Number of those that are no static shapes: they come first.
    fn modes(&self) -> usize {
        self.turn.columns()
    }

    pub(crate) fn rows(&self) -> &Condensation {
        &self.rows
    }

    /// Turns the first modes among themselves, as many as the orthogonal matrix has columns.
    pub(crate) fn turn(&mut self, among: &Dense) {
        self.turn.turn(among);
    }

    /// These turned among themselves by a matrix that is not orthogonal, as vectors of their own.
    pub(crate) fn turned(&self, among: &Dense) -> Self {
        let turn = self.turn.times(among);
        Self::new(Arc::clone(&self.rows), self.vectors.sums(&turn))
    }

    /// The vectors that modes are sums of.
    pub(crate) fn vectors(&self) -> impl Iterator<Item = &[f64]> {
        (0..self.modes()).map(|j| self.vectors.column(j))
    }

    /// What is kept of modes, one after the other: rows that are kept × number.
    pub(crate) fn kept(&self, modes: std::ops::Range<usize>) -> Dense {
        let m = self.modes();
        let turn = self.turn.values()[modes.start * m..modes.end * m].to_vec();
        self.vectors.sums(&Dense::from_columns(m, modes.len(), turn))
    }

    /// What is kept of a static shape.
    pub(crate) fn kept_static(&self, r: usize) -> &[f64] {
        self.statics.column(r)
    }

    /// What is kept at these coordinates.
    fn kept_at(&self, q: &[f64]) -> Vec<f64> {
        let (q, of_statics) = q.split_at(self.modes());
        let mut sums = vec![0.0; self.vectors.columns()];
        self.turn.mul_add(1.0, q, &mut sums[..q.len()]);
        let mut u = vec![0.0; self.rows.kept()];
        self.vectors.mul_add(1.0, &sums, &mut u);
        self.statics.mul_add(1.0, of_statics, &mut u);
        u
    }

    /// The free DOFs at these coordinates with zeros where they are not kept: enough for products with masses and links.
    pub(crate) fn heavy(&self, q: &[f64]) -> Vec<f64> {
        let mut u = vec![0.0; self.rows.order()];
        self.rows.scatter(&self.kept_at(q), &mut u);
        u
    }

    /// Φ q.
    pub(crate) fn expand(&self, q: &[f64]) -> Vec<f64> {
        let u = self.kept_at(q);
        if self.rows.is_none() { u } else { self.rows.complete(&u) }
    }

    /// Φ Q, column by column.
    pub(crate) fn expand_each(&self, q: &Dense) -> Vec<Vec<f64>> {
        let of_modes = q.leading(self.modes(), q.columns());
        let kept = self.vectors.sums(&self.turn.times(&of_modes));
        let mut all = vec![Vec::new(); q.columns()];
        let numbers = self.rows.order() * q.columns();
        share(COMPLETING * numbers, all.iter_mut().enumerate().collect(), |(j, u)| {
            *u = kept.column(j).to_vec();
            self.statics.mul_add(1.0, &q.column(j)[self.modes()..], u);
            if !self.rows.is_none() {
                *u = self.rows.complete(u);
            }
        });
        all
    }

    /// Some modes, found together.
    pub(crate) fn some(&self, modes: std::ops::Range<usize>) -> Vec<Vec<f64>> {
        let kept = self.kept(modes);
        (0..kept.columns()).map(|j| self.rows.complete(kept.column(j))).collect()
    }

    /// The modes, one after the other.
    pub(crate) fn each(&self) -> impl Iterator<Item = Vec<f64>> + '_ {
        self.each_kept().map(|kept| self.rows.complete(&kept))
    }

    /// The same with zeros where they are not kept.
    pub(crate) fn each_heavy(&self) -> impl Iterator<Item = Vec<f64>> + '_ {
        self.each_kept().map(|kept| {
            let mut u = vec![0.0; self.rows.order()];
            self.rows.scatter(&kept, &mut u);
            u
        })
    }

    /// What is kept of each.
    pub(crate) fn each_kept(&self) -> impl Iterator<Item = Vec<f64>> + '_ {
        let count = self.modes();
        (0..count).step_by(TOGETHER).flat_map(move |start| {
            let kept = self.kept(start..count.min(start + TOGETHER));
            let each: Vec<Vec<f64>> =
                (0..kept.columns()).map(|j| kept.column(j).to_vec()).collect();
            each
        })
    }

    /// A row over the free DOFs as a row over the vectors.
    pub(crate) fn row(&self, free: &[(usize, f64)]) -> Vec<f64> {
        let row = self.rows.row(free);
        let of = |column: &[f64]| -> f64 { row.iter().map(|(i, c)| c * column[*i]).sum() };
        let own: Vec<f64> = (0..self.modes()).map(|j| of(self.vectors.column(j))).collect();
        let mut q = vec![0.0; self.len()];
        let (modes, statics) = q.split_at_mut(own.len());
        self.turn.transpose_mul_add(1.0, &own, modes);
        statics.iter_mut().enumerate().for_each(|(r, q)| *q = of(self.statics.column(r)));
        q
    }

    /// Φᵀ p.
    pub(crate) fn load(&self, p: &[f64]) -> Vec<f64> {
        self.load_kept(&self.rows.condense(p))
    }

    /// The same of a load on the rows that are kept.
    fn load_kept(&self, p: &[f64]) -> Vec<f64> {
        let mut own = vec![0.0; self.vectors.columns()];
        self.vectors.transpose_mul_add(1.0, p, &mut own);
        let mut q = vec![0.0; self.len()];
        let (modes, statics) = q.split_at_mut(self.modes());
        self.turn.transpose_mul_add(1.0, &own[..modes.len()], modes);
        self.statics.transpose_mul_add(1.0, p, statics);
        q
    }

    /// Φᵀ P.
    pub(crate) fn loads(&self, p: &Dense) -> Dense {
        let kept = self.rows.condense(p.values()).into_owned();
        let kept = Dense::from_columns(self.rows.kept(), p.columns(), kept);
        let own = self.vectors.transpose_times(&kept).leading(self.modes(), p.columns());
        let (modes, statics) =
            (self.turn.transpose_times(&own), self.statics.transpose_times(&kept));
        let both = (0..p.columns()).flat_map(|j| [modes.column(j), statics.column(j)].concat());
        Dense::from_columns(self.len(), p.columns(), both.collect())
    }

    /// Φᵀ A Φ for a symmetric A.
    pub(crate) fn congruence(&self, a: &Sparse) -> Dense {
        let mut all = Dense::zeros(self.len(), self.len());
        if a.stored() == 0 {
            return all;
        }
        let bring = |p: &[f64], image: &mut [f64]| image.copy_from_slice(&self.rows.condense(p));
        let own = self.reduced(&self.vectors, self.modes(), a, bring);
        let own = self.turn.transpose_times(&own.times(&self.turn));
        for j in 0..self.modes() {
            all.column_mut(j)[..own.rows()].copy_from_slice(own.column(j));
        }
        for r in 0..self.statics.columns() {
            let j = self.modes() + r;
            let own = self.load(&a.mul(&self.rows.complete(self.statics.column(r))));
            for (i, value) in own.into_iter().enumerate() {
                (all[(i, j)], all[(j, i)]) = (value, value);
            }
        }
        all
    }

    /// Vᵀ K V of the stiffness, with or without effective stiffnesses: no force is left on what follows.
    pub(crate) fn stiffness_of_vectors(&self, k: &Sparse) -> Dense {
        self.reduced(&self.vectors, self.modes(), k, |p, image| self.gather(p, image))
    }

    /// Φᵀ K Φ of the first modes, from themselves: without the rounding of what T takes the difference of.
    pub(crate) fn stiffness(&self, k: &Sparse, count: usize) -> Dense {
        self.reduced(&self.kept(0..count), count, k, |p, image| self.gather(p, image))
    }

    fn gather(&self, p: &[f64], image: &mut [f64]) {
        let pairs = p.chunks(self.rows.order()).zip(image.chunks_mut(self.rows.kept()));
        share(p.len(), pairs.collect(), |(p, image)| {
            image.copy_from_slice(&self.rows.gather(p));
        });
    }

    /// Xᵀ A X of the first of some vectors, with the images A X brought to the rows that are kept.
    fn reduced(
        &self,
        kept: &Dense,
        count: usize,
        a: &Sparse,
        bring: impl Fn(&[f64], &mut [f64]),
    ) -> Dense {
        if self.rows.is_none() {
            return kept.congruence(a, count);
        }
        let rows = self.rows.kept().max(1);
        // Room for all blocks: new memory comes page by page from the system.
        let (mut others, mut all, mut own) = (Vec::new(), Vec::new(), Vec::new());
        kept.congruence_by(count, |x, images| {
            for (x, image) in x.chunks(BLOCK * rows).zip(images.chunks_mut(BLOCK * rows)) {
                self.rows.complete_into(x, &mut others, &mut all);
                own.resize(all.len(), 0.0);
                a.symmetric_products(&all, &mut own);
                bring(&own, image);
            }
        })
    }

    /// Takes static shapes out of the vectors, before any of them is turned: of each shape its own rows, and the share
    /// that each vector has in it.
    pub(crate) fn less(self, shapes: &[(Vec<f64>, Vec<f64>)]) -> Self {
        if shapes.is_empty() {
            return self;
        }
        let mut vectors = Arc::unwrap_or_clone(self.vectors);
        for (own, shares) in shapes {
            for (j, share) in shares.iter().enumerate() {
                vectors.column_mut(j).iter_mut().zip(own).for_each(|(v, x)| *v -= share * x);
            }
        }
        Self { vectors: Arc::new(vectors), ..self }
    }

    /// Static shapes over the free DOFs behind the modes.
    pub(crate) fn beside(self, statics: &Dense) -> Self {
        let kept =
            (0..statics.columns()).flat_map(|j| self.rows.gather(statics.column(j)).into_owned());
        let statics = Dense::from_columns(self.rows.kept(), statics.columns(), kept.collect());
        Self { statics, ..self }
    }
}
