//! Random samples and ensembles.

use super::axes::{MOST, map};
use super::setting::Settings;
use crate::number::written;
use crate::{Distribution, Ensemble, Samples, draw, schema};
use trilith::element::dimension::NONE;
use trilith::element::{Dimension, Range};
use trilith::model::file::{Context, Entry, Node};

/// `LatinHypercube(count: 200, of: { "mu": Uniform(from: 0.2, to: 0.8) })`, or `Random(…)`.
pub(super) fn samples(
    c: &Context<'_>,
    node: &Node,
    seed: u64,
    settings: &mut Settings,
) -> Option<Samples> {
    let kind = c.one_of(node, "kind of samples", &schema::SAMPLES)?;
    let latin = kind.name == "LatinHypercube";
    let fields = c.block(node, "`samples`", kind)?;
    let count = fields.required(c, "count").and_then(|n| c.count_up_to(n, "count", 1, MOST));
    let of = fields.required(c, "of")?;
    let entries = map(c, of, "of")?;
    if entries.is_empty() {
        c.report(c.diagnostic("E0104", "`of` names no parameter", of.span.clone()));
    }
    let read: Vec<_> = entries.iter().map(|e| distribution(c, e)).collect();
    let count = count?;
    let mut samples = Samples { names: Vec::new(), values: vec![Vec::new(); count] };
    for (e, (distribution, dimension)) in
        entries.iter().zip(read.into_iter().collect::<Option<Vec<_>>>()?)
    {
        let at = written(distribution.quantile(0.5), dimension);
        settings.add("samples", (&e.key, &e.key_span), &at, &e.value.span);
        samples.names.push(e.key.clone());
        let draws = if latin {
            draw::stratified(seed, &e.key, count)
        } else {
            draw::independent(seed, "random", &e.key, count)
        };
        for (row, u) in samples.values.iter_mut().zip(draws) {
            row.push(written(distribution.quantile(u), dimension));
        }
    }
    Some(samples)
}

fn distribution(c: &Context<'_>, e: &Entry) -> Option<(Distribution, Dimension)> {
    let node = &e.value;
    let kind = c.choice(node, "distribution", &schema::DISTRIBUTIONS.names())?;
    let what = format!("the distribution of `{}`", e.key);
    let block = schema::DISTRIBUTIONS.blocks[kind];
    let fields = c.block(node, &what, block)?;
    let first = fields.required(c, block.fields[0].name)?;
    let q = c.quantity(first)?;
    let dimension = if q.measured { q.dimension } else { NONE };
    let same = |key: &str, range: Range| match fields.get(key) {
        None => Some(None),
        Some(n) => c.ranged(n, key, dimension, range).map(Some),
    };
    let wrong = |message: &str| -> Option<(Distribution, Dimension)> {
        c.report(c.diagnostic("E0112", format!("{what}: {message}"), node.span.clone()));
        None
    };
    let found = match kind {
        0 | 1 => {
            fields.required(c, "to")?;
            let (from, to) = (q.value, same("to", Range::Any)??);
            if from >= to {
                return wrong("`from` must be below `to`");
            }
            if kind == 1 && from <= 0.0 {
                return wrong("`from` must be above 0");
            }
            if kind == 0 {
                Distribution::Uniform { from, to }
            } else {
                Distribution::LogUniform { from, to }
            }
        }
        2 => {
            fields.required(c, "deviation")?;
            let deviation = same("deviation", Range::Positive);
            let (from, to) = (same("from", Range::Any)?, same("to", Range::Any)?);
            let (from, to) = (from.unwrap_or(f64::NEG_INFINITY), to.unwrap_or(f64::INFINITY));
            if from >= to {
                return wrong("`from` must be below `to`");
            }
            Distribution::Normal { mean: q.value, deviation: deviation??, from, to }
        }
        _ => {
            let dispersion = fields.number(c, "dispersion");
            let (from, to) = (same("from", Range::Positive)?, same("to", Range::Positive)?);
            let (from, to) = (from.unwrap_or(0.0), to.unwrap_or(f64::INFINITY));
            if q.value <= 0.0 {
                return wrong("`median` must be above 0");
            }
            if from >= to {
                return wrong("`from` must be below `to`");
            }
            Distribution::LogNormal { median: q.value, dispersion: dispersion?, from, to }
        }
    };
    Some((found, dimension))
}

/// `(members: 40, of: { "mu": 0.01, "height": 0.01 })`: factors with a median of 1 and this dispersion, cut off
/// at three dispersions. The first member is the nominal case.
pub(super) fn ensemble(
    c: &Context<'_>,
    node: &Node,
    seed: u64,
    settings: &mut Settings,
) -> Option<Ensemble> {
    let fields = c.block(node, "`ensemble`", schema::ENSEMBLE.blocks[0])?;
    let members = fields.required(c, "members").and_then(|n| c.count_up_to(n, "members", 2, MOST));
    let of = fields.required(c, "of")?;
    let entries = map(c, of, "of")?;
    if entries.is_empty() {
        c.report(c.diagnostic("E0104", "`of` names no parameter", of.span.clone()));
    }
    let scatter: Vec<_> =
        entries.iter().map(|e| c.ranged(&e.value, &e.key, NONE, Range::Positive)).collect();
    let (members, scatter) = (members?, scatter.into_iter().collect::<Option<Vec<f64>>>()?);
    let mut ensemble = Ensemble {
        names: entries.iter().map(|e| e.key.clone()).collect(),
        factors: vec![Vec::new(); members],
        scatter: scatter.clone(),
    };
    for (e, dispersion) in entries.iter().zip(scatter) {
        settings.add("ensemble", (&e.key, &e.key_span), "", &e.value.span);
        let reach = (3.0 * dispersion).exp();
        let factor =
            Distribution::LogNormal { median: 1.0, dispersion, from: 1.0 / reach, to: reach };
        ensemble.factors[0].push(1.0);
        let draws = draw::independent(seed, "ensemble", &e.key, members - 1);
        for (row, u) in ensemble.factors[1..].iter_mut().zip(draws) {
            row.push(factor.quantile(u));
        }
    }
    Some(ensemble)
}
