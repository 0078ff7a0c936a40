//! The recursion of Ritz vectors: loads, starts, links, and what comes next of each.

use super::Demands;
use super::condensation::Condensation;
use super::massless::{Following, StaticShapes};
use super::shapes::Shapes;
use super::solvable::{BLOCK, Solvable};
use super::span::{Origin, Span, Speed};
use crate::error::SolveError;
use crate::vector::dot;
use std::sync::Arc;
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

pub(super) fn enriched(
    system: &System,
    settings: &Basis,
    demands: &Demands,
    hat: &Solvable,
) -> Result<Enriched, SolveError> {
    let loads = &*demands.loads;
    // Who asks for no flexibility of the links gets no vectors for them.
    let links: &[usize] = if settings.adequacy > 0.0 { &system.links.active } else { &[] };
    let automatic = 20 * demands.count().max(2);
    // Links and what drives the structure share what there is: neither takes from the half of the other.
    let (ground, of_links) = match settings.vectors {
        None => (automatic, links.len()),
        Some(n) => {
            let of_links = links.len().min(n / 2);
            (n - of_links, of_links)
        }
    };
    let total = ground + of_links;
    let more = if demands.wider { total.div_ceil(WIDER).max(AT_LEAST) } else { 0 };
    let parts = hat.parts(system);
    let rows = Condensation::new(system, loads)?;
    // What follows without mass is beside the modes: in vectors it would look like modes that are far too fast, and
    // come with what is taken out of others.
    let stiffness = Sparse::combine(&parts);
    let statics = StaticShapes::new(system, &stiffness, loads)?;
    let following = Following::new(system, &stiffness, &rows)?;
    let mut span = Span::new(&rows, &system.mass, &parts, following, total + more);
    let own = |u: &Vec<f64>| rows.gather(u).into_owned();
    let mut block: Vec<Vec<f64>> = Vec::new();
    let mut modes: Vec<Vec<f64>> = Vec::new();
    block.extend(loads.iter().map(|(_, p)| own(p)));
    // What the run starts from must be there itself; masses in motion go on as loads.
    let start = |u: &Vec<f64>| {
        let (mut u, mut p) = (u.clone(), vec![0.0; u.len()]);
        parts.iter().for_each(|(factor, part)| part.mul_add(*factor, &u, &mut p));
        statics.out_of_answer(|psi| dot(psi, &p), &mut u);
        own(&u)
    };
    let mut starts: Vec<Vec<f64>> = demands.starts.iter().map(start).collect();
    let lowest = |count: usize| -> Result<Vec<Vec<f64>>, SolveError> {
        let count = count.min(system.order());
        let (_, vectors) = lowest_modes(&stiffness, &system.mass, count, 0.0)?;
        Ok((0..vectors.columns()).map(|j| own(&vectors.column(j).to_vec())).collect())
    };
    if settings.kind == BasisKind::Eigen {
        modes = lowest(ground + more)?;
        let beyond = modes.split_off(ground.min(modes.len()));
        span.take(std::mem::replace(&mut modes, beyond), Origin::Anywhere, Speed::Any);
    } else {
        starts.truncate(ground);
        let starts = std::mem::take(&mut starts);
        block.extend(span.take(starts, Origin::Anywhere, Speed::OfModes));
        block = recurse(&mut span, &rows, hat, &statics, block, ground, Speed::OfModes);
    }
    // A chain ends where its next vector is too fast; what loads and starts set in motion does not.
    let mut fast = Fast { left: span.left_out(), block: Vec::new() };
    let mut known = Vec::with_capacity(links.len());
    // Where there is no room for all, those taken are spread over all.
    let is_taken = |i: usize| (i + 1) * of_links / links.len() > i * of_links / links.len();
    let row = |i: usize| &system.links.rows[i];
    let beside = |i: usize, x: &[f64]| {
        let mut x = x.to_vec();
        statics.out_of_answer(|psi| row(i).iter().map(|(j, c)| c * psi[*j]).sum(), &mut x);
        rows.gather(&x).into_owned()
    };
    hat.static_shapes(system, links, |x, flexibility| {
        let i = known.len();
        known.push(flexibility);
        if span.len() < total && is_taken(i) {
            span.take(vec![beside(links[i], x)], Origin::Anywhere, Speed::OfModes);
        }
    });
    let known = (settings.adequacy > 0.0).then_some(known);
    if settings.vectors.is_some() {
        // So many were asked for, by the user or by an error that fewer made.
        fast.go_on(&mut span, &rows, hat, &statics, total);
    }
    let count = span.len();
    if more > 0 {
        if settings.kind == BasisKind::Eigen {
            // No few modes more hold what all that are left answer to slow loads.
            starts.truncate(more / 2);
            block.extend(span.take(starts, Origin::Anywhere, Speed::OfModes));
            block =
                recurse(&mut span, &rows, hat, &statics, block, count + more / 2, Speed::OfModes);
            fast.left.extend(span.left_out());
        }
        modes.truncate((count + more).saturating_sub(span.len()));
        span.take(modes, Origin::Anywhere, Speed::Any);
        // Links that were not taken are the first to lack something; where loads have shown all they can, links
        // and what they set in motion are all that is left.
        let untaken = system.links.active.len() - of_links;
        let mut of_links = beyond(system, hat, &mut span, &beside, count + untaken.min(more / 2));
        // Those of links are static shapes of places with next to no mass.
        drop(span.left_out());
        recurse(&mut span, &rows, hat, &statics, block, count + more, Speed::OfModes);
        fast.left.extend(span.left_out());
        of_links.extend(beyond(system, hat, &mut span, &beside, count + more));
        recurse(&mut span, &rows, hat, &statics, of_links, count + more, Speed::OfModes);
        // Only what is here is seen as missing.
        fast.go_on(&mut span, &rows, hat, &statics, count + more);
        if span.len() < count + more && span.len() + system.massless.len() < system.order() {
            // Dampers that couple modes and links that do may move what neither loads nor links alone do.
            span.take(lowest(count + more)?, Origin::Anywhere, Speed::Any);
        }
    }
    let all = span.into_dense();
    let rows = Arc::new(rows);
    if all.columns() == count {
        return Ok(Enriched { span: Shapes::new(rows, all), wider: None, known });
    }
    let first = all.values()[..count * all.rows()].to_vec();
    let first = Shapes::new(Arc::clone(&rows), Dense::from_columns(all.rows(), count, first));
    Ok(Enriched { span: first, wider: Some(Shapes::new(rows, all)), known })
}

/// Of a link coordinate and its static shape, what goes into the span.
type OfLink<'a> = dyn Fn(usize, &[f64]) -> Vec<f64> + 'a;

/// Takes static shapes of links until `count` vectors are there, and returns their images under M.
fn beyond(
    system: &System,
    hat: &Solvable,
    span: &mut Span<'_>,
    beside: &OfLink<'_>,
    count: usize,
) -> Vec<Vec<f64>> {
    let mut images = Vec::new();
    for block in system.links.active.chunks(BLOCK) {
        if span.len() >= count {
            break;
        }
        let mut links = block.iter();
        hat.static_shapes(system, block, |x, _| {
            if let Some(link) = links.next()
                && span.len() < count
            {
                images.extend(span.take(vec![beside(*link, x)], Origin::Anywhere, Speed::OfModes));
            }
        });
    }
    images
}

/// What a recursion was about to go on with, but that is too fast for modes of interest.
struct Fast {
    /// Vectors that were left out.
    left: Vec<Vec<f64>>,
    /// Right-hand sides of what follows from those taken in the end.
    block: Vec<Vec<f64>>,
}

impl Fast {
    /// Takes them, and what follows from them, until `count` vectors are there.
    fn go_on(
        &mut self,
        span: &mut Span<'_>,
        rows: &Condensation,
        hat: &Solvable,
        statics: &StaticShapes,
        count: usize,
    ) {
        let room = count.saturating_sub(span.len()).min(self.left.len());
        let taken = self.left.drain(..room).collect();
        self.block.extend(span.take(taken, Origin::Anywhere, Speed::Any));
        let block = std::mem::take(&mut self.block);
        self.block = recurse(span, rows, hat, statics, block, count, Speed::Any);
    }
}

/// The load-dependent recursion from right-hand sides until `count` vectors are there or nothing new comes; returns
/// those it would go on with.
fn recurse(
    span: &mut Span<'_>,
    rows: &Condensation,
    hat: &Solvable,
    statics: &StaticShapes,
    mut block: Vec<Vec<f64>>,
    count: usize,
    speed: Speed,
) -> Vec<Vec<f64>> {
    let order = rows.order();
    while span.len() < count && !block.is_empty() {
        let mut next = Vec::new();
        span.next_block();
        while !block.is_empty() && span.len() < count {
            let rest = block.split_off(block.len().min(count - span.len()).min(BLOCK));
            let mut x = vec![0.0; order * block.len()];
            x.chunks_mut(order).zip(&block).for_each(|(x, p)| rows.scatter(p, x));
            drop(block);
            let p = if statics.len() > 0 { x.clone() } else { Vec::new() };
            hat.factor.solve(&mut x);
            for (p, x) in p.chunks(order).zip(x.chunks_mut(order)) {
                statics.out_of_answer(|psi| dot(psi, p), x);
            }
            let solved = x.chunks(order).map(|x| rows.gather(x).into_owned()).collect();
            drop(x);
            // Where the loads have shown all they can, what is left of a vector is rounding.
            next.extend(span.take(solved, Origin::Recursion, speed));
            block = rest;
        }
        block.extend(next);
    }
    block
}
