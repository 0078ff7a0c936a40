//! The recursion of Ritz vectors: loads, starts, links, and what comes next of each.

use super::Demands;
use super::attachment::{AttachmentVectors, Following};
use super::condensation::Condensation;
use super::link_shapes::{LinkShapes, OfLinks};
use super::orthonormal::{FrequencyCut, Origin, OrthonormalBasis};
use super::recursion::{Fast, beyond, following, recurse};
use super::shapes::Shapes;
use super::solvable::Solvable;
use crate::error::SolveError;
use crate::vector::dot;
use std::sync::Arc;
use trilith_linalg::threads::beside;
use trilith_linalg::{Dense, Sparse, lowest_modes};
use trilith_model::{Basis, BasisKind};
use trilith_system::System;

/// One vector in so many is added to make the wider basis, and so many at least.
const WIDER: usize = 4;
const AT_LEAST: usize = 16;

/// A span, one that holds more, and the flexibility of the links where it has been found on the way.
pub(super) struct Enriched {
    pub(super) span: Shapes,
    pub(super) wider: Option<Shapes>,
    pub(super) known: Option<Vec<f64>>,
}

/// The span of a run: as many vectors as are asked for, and behind them those of a wider one where it is wanted.
pub(super) fn enriched(
    system: &System,
    settings: &Basis,
    demands: &Demands,
    hat: &Solvable,
) -> Result<Enriched, SolveError> {
    let sizes = Sizes::new(system, settings, demands);
    let parts = hat.parts(system);
    let rows = Condensation::new(system, &demands.loads)?;
    // What follows without mass is beside the modes: in vectors it would look like modes that are far too fast, and
    // come with what is taken out of others.
    let stiffness = Sparse::combine(&parts);
    let statics = AttachmentVectors::new(system, &stiffness, &demands.loads)?;
    let following = Following::new(system, &stiffness, &rows)?;
    let span =
        OrthonormalBasis::new(&rows, &system.mass, &parts, following, sizes.total + sizes.more);
    let fast = Fast { left: Vec::new(), block: Vec::new() };
    let mut growing =
        Growing { system, rows: &rows, hat, statics: &statics, stiffness: &stiffness, span, fast };
    let (left, known) = growing.of_loads_and_links(settings, demands, &parts, &sizes)?;
    if settings.vectors.is_some() {
        // So many were asked for, by the user or by an error that fewer made.
        growing.go_on_fast(sizes.total);
    }
    let count = growing.span.len();
    if sizes.more > 0 {
        growing.wider(settings, left, count, &sizes)?;
    }
    let all = growing.span.into_dense();
    Ok(enriched_of(rows, all, count, known))
}

/// How many vectors there are to be.
struct Sizes {
    /// Of loads and starts, and of links.
    ground: usize,
    of_links: usize,
    /// Both.
    total: usize,
    /// Those that make the span wider.
    more: usize,
}

impl Sizes {
    fn new(system: &System, settings: &Basis, demands: &Demands) -> Self {
        let links = links(system, settings).len();
        let automatic = 20 * demands.count().max(2);
        // Links and what drives the structure share what there is: neither takes from the half of the other.
        let (ground, of_links) = match settings.vectors {
            None => (automatic, links),
            Some(n) => {
                let of_links = links.min(n / 2);
                (n - of_links, of_links)
            }
        };
        let total = ground + of_links;
        let more = if demands.wider { total.div_ceil(WIDER).max(AT_LEAST) } else { 0 };
        Self { ground, of_links, total, more }
    }
}

/// The link coordinates that get vectors: who asks for no flexibility of the links gets none for them.
fn links<'a>(system: &'a System, settings: &Basis) -> &'a [usize] {
    if settings.adequacy > 0.0 { &system.links.active } else { &[] }
}

/// A span under construction.
struct Growing<'a> {
    system: &'a System,
    rows: &'a Condensation,
    hat: &'a Solvable,
    statics: &'a AttachmentVectors,
    /// K̂.
    stiffness: &'a Sparse,
    span: OrthonormalBasis<'a>,
    fast: Fast,
}

/// What loads and starts have left for a wider span.
struct Left {
    /// Right-hand sides with which the recursion goes on.
    block: Vec<Vec<f64>>,
    /// Modes and starts that were not taken.
    modes: Vec<Vec<f64>>,
    starts: Vec<Vec<f64>>,
}

impl<'a> Growing<'a> {
    /// The rows of a vector that are kept.
    fn own(&self, u: &[f64]) -> Vec<f64> {
        self.rows.gather(u).into_owned()
    }

    fn shapes(&self) -> LinkShapes<'a> {
        let Self { system, rows, hat, statics, .. } = *self;
        LinkShapes { system, rows, hat, statics }
    }

    /// The lowest modes.
    fn lowest(&self, count: usize) -> Result<Vec<Vec<f64>>, SolveError> {
        let count = count.min(self.system.order());
        let (_, vectors) = lowest_modes(self.stiffness, &self.system.mass, count, 0.0)?;
        Ok((0..vectors.columns()).map(|j| self.own(vectors.column(j))).collect())
    }

    fn recurse(&mut self, block: Vec<Vec<f64>>, count: usize) -> Vec<Vec<f64>> {
        recurse(
            &mut self.span,
            self.rows,
            self.hat,
            self.statics,
            block,
            count,
            FrequencyCut::Modes,
        )
    }

    /// Takes what was left out as too fast until `count` vectors are there.
    fn go_on_fast(&mut self, count: usize) {
        self.fast.go_on(&mut self.span, self.rows, self.hat, self.statics, count);
    }

    /// Eigenvectors, or what loads and starts set in motion.
    fn of_loads(
        &mut self,
        settings: &Basis,
        demands: &Demands,
        parts: &[(f64, &Sparse)],
        sizes: &Sizes,
    ) -> Result<Left, SolveError> {
        let mut block: Vec<Vec<f64>> = demands.loads.iter().map(|(_, p)| self.own(p)).collect();
        // What the run starts from must be there itself; masses in motion go on as loads.
        let start = |u: &Vec<f64>| {
            let (mut u, mut p) = (u.clone(), vec![0.0; u.len()]);
            parts.iter().for_each(|(factor, part)| part.mul_add(*factor, &u, &mut p));
            self.statics.out_of_answer(|psi| dot(psi, &p), &mut u);
            self.own(&u)
        };
        let mut starts: Vec<Vec<f64>> = demands.starts.iter().map(start).collect();
        let mut modes = Vec::new();
        if settings.kind == BasisKind::Eigen {
            let mut own = self.lowest(sizes.ground + sizes.more)?;
            modes = own.split_off(sizes.ground.min(own.len()));
            self.span.take(own, Origin::Anywhere, FrequencyCut::None);
        } else {
            starts.truncate(sizes.ground);
            let starts = std::mem::take(&mut starts);
            self.span.take(starts, Origin::Anywhere, FrequencyCut::Modes);
            block.extend(self.span.images_since(0));
            block = self.recurse(block, sizes.ground);
        }
        // A chain ends where its next vector is too fast; what loads and starts set in motion does not.
        self.fast.left = self.span.left_out();
        Ok(Left { block, modes, starts })
    }

    /// What loads and starts set in motion, and behind it one static vector for each link coordinate, as far as there is
    /// room; the flexibility of each link where somebody asks.
    fn of_loads_and_links(
        &mut self,
        settings: &Basis,
        demands: &Demands,
        parts: &[(f64, &Sparse)],
        sizes: &Sizes,
    ) -> Result<(Left, Option<Vec<f64>>), SolveError> {
        let (shapes, links) = (self.shapes(), links(self.system, settings));
        // Where there is no room for all, those taken are spread over all.
        let of_links = sizes.of_links;
        let is_taken = |i: usize| (i + 1) * of_links / links.len() > i * of_links / links.len();
        let of = |(first, block): (usize, &[usize])| shapes.of(block, |i| is_taken(first + i));
        let mut found: Vec<_> = shapes.blocks(links).map(|block| (block, None)).collect();
        // A chain of single vectors leaves other threads nothing to do, and shapes of links do not wait for it.
        let is_chain = settings.kind != BasisKind::Eigen && demands.count() == 1;
        let left = if is_chain && links.len() > sizes.ground {
            let pieces = found.iter_mut().collect();
            let of_loads = || self.of_loads(settings, demands, parts, sizes);
            beside(of_loads, pieces, |(block, found)| *found = Some(of(*block)))?
        } else {
            self.of_loads(settings, demands, parts, sizes)?
        };
        let mut known = Vec::with_capacity(links.len());
        for (block, found) in found {
            let OfLinks { taken, flexibility } = found.unwrap_or_else(|| of(block));
            self.span.take_until(sizes.total, taken, FrequencyCut::Modes);
            known.extend(flexibility);
        }
        Ok((left, (settings.adequacy > 0.0).then_some(known)))
    }

    /// Static shapes of links until `count` vectors are there; returns their images under M.
    fn more_links(&mut self, count: usize) -> Vec<Vec<f64>> {
        beyond(self.shapes(), &mut self.span, count)
    }

    /// The next vectors of the same sequence, behind the `count` that are there.
    fn wider(
        &mut self,
        settings: &Basis,
        left: Left,
        count: usize,
        sizes: &Sizes,
    ) -> Result<(), SolveError> {
        let Left { mut block, mut modes, mut starts } = left;
        let (more, all) = (sizes.more, count + sizes.more);
        if settings.kind == BasisKind::Eigen {
            // No few modes more hold what all that are left answer to slow loads.
            starts.truncate(more / 2);
            let first = self.span.len();
            self.span.take(starts, Origin::Anywhere, FrequencyCut::Modes);
            block.extend(self.span.images_since(first));
            block = self.recurse(block, count + more / 2);
            self.fast.left.extend(self.span.left_out());
        }
        modes.truncate(all.saturating_sub(self.span.len()));
        self.span.take(modes, Origin::Anywhere, FrequencyCut::None);
        // Links that were not taken are the first to lack something; where loads have shown all they can, links
        // and what they set in motion are all that is left.
        let untaken = self.system.links.active.len() - sizes.of_links;
        let mut of_links = self.more_links(count + untaken.min(more / 2));
        // Those of links are static shapes of DOFs with next to no mass.
        drop(self.span.left_out());
        // What loads go on with, and what follows from all vectors, links' among them.
        let one_block = self.span.len() + block.len();
        block = self.recurse(block, one_block.min(all));
        following(&mut self.span, self.rows, self.hat, self.statics, all);
        self.recurse(block, all);
        self.fast.left.extend(self.span.left_out());
        of_links.extend(self.more_links(all));
        self.recurse(of_links, all);
        // Only what is here is seen as missing.
        self.go_on_fast(all);
        if self.span.len() < all
            && self.span.len() + self.system.massless.len() < self.system.order()
        {
            // Dampers that couple modes and links that do may move what neither loads nor links alone do.
            let lowest = self.lowest(all)?;
            self.span.take(lowest, Origin::Anywhere, FrequencyCut::None);
        }
        Ok(())
    }
}

/// The first `count` of all vectors, and all of them where they are more.
fn enriched_of(rows: Condensation, all: Dense, count: usize, known: Option<Vec<f64>>) -> Enriched {
    let rows = Arc::new(rows);
    if all.columns() == count {
        return Enriched { span: Shapes::new(rows, all), wider: None, known };
    }
    let all = Shapes::new(rows, all);
    Enriched { span: all.first(count), wider: Some(all), known }
}
