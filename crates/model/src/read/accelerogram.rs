//! Processing of records.

use super::context::{Context, Fields};
use super::functions::{Made, what};
use crate::schema;
use crate::tree::{Entry, Node};
use crate::{AfterEnd, Interpolation, Table, TimeFunction};
use std::sync::Arc;
use trilith_element::Range;
use trilith_element::dimension::{ACCELERATION, TIME};
use trilith_record::process::{Baseline, Filter, Padding, Processing, Resampling, scaled};

/// An accelerogram times a factor as a table, with its first sample at `start`.
pub(super) fn table_of(
    c: &Context<'_>,
    e: &Entry,
    record: &trilith_record::Record,
    factor: Option<f64>,
    start: f64,
    after_end: AfterEnd,
) -> Option<Made> {
    let times = record.times().map(|t| start + t).collect();
    let plain = &record.acceleration;
    let values = factor.map_or_else(|| plain.clone(), |f| scaled(plain, f));
    match Table::new(times, values, Interpolation::Linear, after_end) {
        Ok(table) => Some((TimeFunction::Table(Arc::new(table)), Some(ACCELERATION))),
        Err(error) => {
            let message = format!("{}: {error}", what(e));
            c.report(c.diagnostic("E0117", message, e.value.name_span()));
            None
        }
    }
}

/// `trim`, `baseline`, `taper`, `filter`, `resample`, `scale_to`, `scale`.
pub(super) fn processing(c: &Context<'_>, fields: &Fields<'_>, what: &str) -> Option<Processing> {
    let trim = match fields.get("trim") {
        None => Some(None),
        Some(n) => match n.items().as_slice() {
            [from, to] if n.is_list() => {
                let (from, to) = (c.number(from, TIME), c.number(to, TIME));
                from.zip(to).map(Some)
            }
            _ => c.wrong(n, "a pair `(from, to)` of times"),
        },
    };
    let baseline = fields.get("baseline").map_or(Some(None), |n| baseline(c, n, what).map(Some));
    let taper = fields.number_if(c, "taper");
    let filter = fields.get("filter").map_or(Some(None), |n| filter(c, n, what).map(Some));
    let resample = fields.get("resample").map_or(Some(None), |n| resampling(c, n, what).map(Some));
    let scale_to = fields.number_if(c, "scale_to");
    let scale = fields.number_if(c, "scale");
    Some(Processing {
        trim: trim?,
        baseline: baseline?,
        taper: taper?.unwrap_or(0.0),
        filter: filter?,
        resample: resample?,
        scale_to: scale_to?,
        scale: scale?,
    })
}

fn baseline(c: &Context<'_>, node: &Node, what: &str) -> Option<Baseline> {
    match c.choice(node, "baseline", &schema::BASELINE.names())? {
        0 => Some(Baseline::Mean),
        1 => Some(Baseline::Linear),
        2 => {
            let fields = c.block(node, &format!("the baseline of {what}"), &schema::POLYNOMIAL)?;
            let (n, order) = (fields.required(c, "order")?, fields.count(c, "order")?);
            if order > 20 {
                let message = format!("`order` = {order}: must be between 0 and 20");
                c.report(c.diagnostic("E0112", message, n.span.clone()));
                return None;
            }
            Some(Baseline::Polynomial(order))
        }
        _ => Some(Baseline::Rest),
    }
}

/// `Butterworth(highpass: "0.1 Hz", lowpass: "25 Hz", order: 4, causal: false, padding: Strip)`.
fn filter(c: &Context<'_>, node: &Node, what: &str) -> Option<Filter> {
    let kind = c.one_of(node, "filter", &schema::FILTER)?;
    let fields = c.block(node, &format!("the filter of {what}"), kind)?;
    let highpass = fields.number_if(c, "highpass");
    let lowpass = fields.number_if(c, "lowpass");
    let order = fields.count(c, "order");
    let causal = fields.flag(c, "causal");
    let padding = fields.choice(c, "padding", "padding");
    Some(Filter {
        highpass: highpass?,
        lowpass: lowpass?,
        order: order?,
        causal: causal?,
        padding: [Padding::None, Padding::Strip, Padding::Keep][padding?],
    })
}

/// `"5 ms"`, or `Linear(dt: "5 ms")`.
fn resampling(c: &Context<'_>, node: &Node, what: &str) -> Option<(f64, Resampling)> {
    if node.name().is_none() {
        let dt = c.ranged(node, "resample", TIME, Range::Positive)?;
        return Some((dt, Resampling::BandLimited));
    }
    let kind = c.one_of(node, "resampling", &schema::RESAMPLE)?;
    let fields = c.block(node, &format!("the resampling of {what}"), kind)?;
    let dt = fields.number(c, "dt")?;
    let linear = kind.name == "Linear";
    Some((dt, if linear { Resampling::Linear } else { Resampling::BandLimited }))
}
