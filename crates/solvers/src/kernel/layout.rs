//! Which coordinates the link equations are about.

use crate::vector::add;
use trilith_linalg::Panel;
use trilith_system::{Laws, LinkSet, Tangents};

/// The active link coordinates of a model, and what is known of each.
pub(crate) struct Layout<'a> {
    pub links: &'a LinkSet,
    /// Effective stiffness of the active coordinates.
    pub effective_k: Vec<f64>,
    /// Active coordinates of rate-dependent laws.
    pub rate_dependent: Vec<usize>,
    /// Active coordinates of laws that a rate alone can hold.
    pub damped: Vec<usize>,
    /// Active and flat index of those whose laws do not depend on rates: the [kernel](super::LinkKernel) leaves their rates
    /// to its caller.
    pub rate_independent: Vec<(usize, usize)>,
    /// Active index of each flat coordinate; none of the fixed ones.
    pub place: Vec<Option<usize>>,
    /// Index of the link of each active coordinate.
    pub owner: Vec<usize>,
    /// True where all coordinates are active.
    pub complete: bool,
}

impl<'a> Layout<'a> {
    /// `effective_k`: of the active coordinates.
    pub fn new(links: &'a LinkSet, laws: &Laws<'a>, effective_k: Vec<f64>) -> Self {
        let n = links.active.len();
        let mut place = vec![None; links.len()];
        for (a, flat) in links.active.iter().enumerate() {
            place[*flat] = Some(a);
        }
        let (mut owner, mut damped) = (vec![0; n], Vec::new());
        let (mut rate_dependent, mut rate_independent) = (Vec::new(), Vec::new());
        for (l, (law, link)) in laws.iter().enumerate() {
            for a in link.range.clone().filter_map(|flat| place[flat]) {
                owner[a] = l;
                if law.uses_rates() {
                    rate_dependent.push(a)
                } else {
                    rate_independent.push((a, links.active[a]))
                }
                if law.damps() {
                    damped.push(a);
                }
            }
        }
        let complete = n == links.len();
        Self {
            links,
            effective_k,
            rate_dependent,
            rate_independent,
            damped,
            place,
            owner,
            complete,
        }
    }

    /// Force of an active coordinate under deformations and rates of all, by k − k_e and c.
    pub fn linear(&self, a: usize, tangents: &Tangents, [d, v]: [&[f64]; 2]) -> f64 {
        self.tangents_of(a, tangents).map(|(b, k, c)| k * d[b] + c * v[b]).sum()
    }

    /// The row of k − k_e and c of an active coordinate: (other active, stiffness, damping).
    pub fn tangents_of(
        &self,
        a: usize,
        tangents: &Tangents,
    ) -> impl Iterator<Item = (usize, f64, f64)> {
        let Self { links, place, owner, effective_k, .. } = self;
        let link = &links.links[owner[a]];
        let (first, size) = (link.range.start, link.range.len());
        let at = link.block.start + (links.active[a] - first) * size;
        let (k, c) = (&tangents.k[at..at + size], &tangents.c[at..at + size]);
        (0..size).filter_map(move |j| {
            let b = place[first + j]?;
            let own = if a == b { effective_k[a] } else { 0.0 };
            let (k, c) = (k[j] - own, c[j]);
            (k != 0.0 || c != 0.0).then_some((b, k, c))
        })
    }
}

/// What the link equations move, in one row: deformations of the active coordinates, the rates that laws depend on, and
/// f̃. A factor of few coordinates moves all of it in one product.
pub(super) struct Unknowns {
    /// Number of active coordinates.
    n: usize,
    /// Number of rates that laws depend on.
    rate_dependent: usize,
    /// The row, with zeros behind it that fill up whole vectors.
    row: Vec<f64>,
}

impl Unknowns {
    pub fn new(n: usize, rate_dependent: usize) -> Self {
        Self { n, rate_dependent, row: vec![0.0; Self::length(n, rate_dependent)] }
    }

    /// Length of a row of so many coordinates and rates, with what fills it up.
    pub fn length(n: usize, rate_dependent: usize) -> usize {
        (2 * n + rate_dependent).next_multiple_of(Panel::GRAIN)
    }

    /// Where f̃ begins in a row of so many coordinates and rates.
    pub fn place_of_pseudo(n: usize, rate_dependent: usize) -> usize {
        n + rate_dependent
    }

    /// Deformations, these rates and f̃.
    pub fn parts(&mut self) -> [&mut [f64]; 3] {
        let Self { n, rate_dependent, .. } = *self;
        let (moves, pseudo) = self.row.split_at_mut(Self::place_of_pseudo(n, rate_dependent));
        let (d, v) = moves.split_at_mut(n);
        [d, &mut v[..rate_dependent], &mut pseudo[..n]]
    }

    /// f̃ in a row.
    pub fn pseudo_of<'r>(&self, row: &'r [f64]) -> &'r [f64] {
        &row[Self::place_of_pseudo(self.n, self.rate_dependent)..][..self.n]
    }

    pub fn pseudo(&self) -> &[f64] {
        self.pseudo_of(&self.row)
    }

    /// Deformations.
    pub fn d(&self) -> &[f64] {
        &self.row[..self.n]
    }

    /// Rates that laws depend on.
    pub fn v(&self) -> &[f64] {
        &self.row[self.n..][..self.rate_dependent]
    }

    /// The whole row, as a product moves it.
    pub fn row(&mut self) -> &mut [f64] {
        &mut self.row
    }

    /// Adds a change of the whole row.
    pub fn add(&mut self, change: &[f64]) {
        add(&mut self.row, change);
    }
}
