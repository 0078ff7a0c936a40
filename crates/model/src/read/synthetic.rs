//! Synthetic motions.

use super::accelerogram::table_of;
use super::context::Context;
use super::functions::{Made, what};
use super::tables::after_end;
use crate::AfterEnd;
use crate::schema;
use crate::tree::{Entry, Node};
use std::collections::HashSet;
use trilith_element::Range;
use trilith_element::dimension::{ACCELERATION, TIME};
use trilith_record::MOST_SAMPLES;
use trilith_record::synthetic::{Compatible, Envelope, KanaiTajimi, Target};

/// A synthetic motion as the file wants it.
struct Synthetic {
    start: KanaiTajimi,
    /// The spectrum that it meets.
    target: Option<Target>,
    scale: f64,
    after_end: AfterEnd,
}

impl Synthetic {
    /// What makes it.
    fn key(&self) -> String {
        format!("{:?} {:?}", self.start, self.target)
    }
}

/// The motions of a file may take as long as so many of the longest that meets a spectrum: some seconds.
const MOST_WORK: f64 = 5.0;
/// What the longest takes that meets none.
const PLAIN: f64 = 0.25;

/// Refuses the motions of a file that would take too long to make, before one is made; true where it does.
pub(super) fn too_much(c: &Context<'_>, entries: &[Entry]) -> bool {
    let mut work = 0.0;
    // What is made once for several functions counts once.
    let mut seen = HashSet::new();
    for e in entries.iter().filter(|e| e.value.name() == Some(schema::SYNTHETIC.name)) {
        let Some(motion) = described(c, e) else { continue };
        let new = seen.insert(motion.key());
        let Synthetic { start, target, .. } = motion;
        // What a single one has of errors is told where it is made.
        let own = match target {
            Some(target) => Compatible { target, start }.work().unwrap_or_default(),
            None => PLAIN * start.duration / start.dt / MOST_SAMPLES as f64,
        };
        work += if new && own <= 1.0 { own } else { 0.0 };
        if work > MOST_WORK {
            let message = format!(
                "with {} the motions of this file are too much: together they may take as long as {MOST_WORK} of the \
                 longest that meets a spectrum, or as {} of the longest that meets none",
                what(e),
                MOST_WORK / PLAIN
            );
            let help = "fewer or shorter ones, or a longer `dt`; `trilith record --synthetic` makes them once, for \
                        `Record`";
            c.report(c.diagnostic("E0112", message, e.value.name_span()).help(help));
            return true;
        }
    }
    false
}

/// Makes it.
pub(super) fn synthetic(c: &Context<'_>, e: &Entry) -> Option<Made> {
    let motion = described(c, e)?;
    let key = motion.key();
    let Synthetic { start, target, scale, after_end } = motion;
    let make = || match target {
        None => start.make(),
        Some(target) => Compatible { target, start }.make().map(|(record, _)| record),
    };
    match c.motions.records.get(key, make) {
        Ok(record) => table_of(c, e, &record, Some(scale), 0.0, after_end),
        Err(error) => {
            let message = format!("{}: {error}", what(e));
            c.report(c.diagnostic("E0112", message, e.value.name_span()));
            None
        }
    }
}

/// `Synthetic(seed: 1, peak: "0.3 g", …)`, or with `spectrum: [(period, acceleration), …]`.
fn described(c: &Context<'_>, e: &Entry) -> Option<Synthetic> {
    let fields = c.block(&e.value, &what(e), &schema::SYNTHETIC)?;
    let plain = KanaiTajimi::default();
    let seed = fields.count(c, "seed");
    let (duration, dt) = (fields.number(c, "duration"), fields.number(c, "dt"));
    let (frequency, damping) = (fields.number(c, "frequency"), fields.number(c, "damping"));
    let highpass = fields.number(c, "highpass");
    let highpass_damping = fields.number(c, "highpass_damping");
    let envelope =
        fields.get("envelope").map_or(Some(plain.envelope), |n| envelope(c, n, &what(e)));
    let after_end = after_end(c, &fields);
    let spectrum_damping = fields.number(c, "spectrum_damping");
    let scale = fields.number(c, "scale");
    let target = fields.get("spectrum").map_or(Some(None), |n| points(c, n).map(Some));
    let peak = match (fields.get("peak"), fields.get("spectrum")) {
        (Some(n), Some(_)) => {
            let message = format!("{} has `peak` and `spectrum`", what(e));
            let d = c.diagnostic("E0102", message, n.span.clone());
            c.report(d.help("the spectrum says how strong the motion is: leave `peak` out"));
            None
        }
        (None, Some(_)) => Some(plain.peak),
        (_, None) => fields.number(c, "peak"),
    };
    let start = KanaiTajimi {
        frequency: frequency?,
        damping: damping?,
        highpass: highpass?,
        highpass_damping: highpass_damping?,
        duration: duration?,
        dt: dt?,
        envelope: envelope?,
        peak: peak?,
        seed: seed? as u64,
    };
    let damping = spectrum_damping?;
    let target = target?.map(|points| Target { points, damping });
    Some(Synthetic { start, target, scale: scale?, after_end: after_end? })
}

/// Points `(period, acceleration)` of a spectrum.
fn points(c: &Context<'_>, list: &Node) -> Option<Vec<(f64, f64)>> {
    if !list.is_list() {
        return c.wrong(list, "a list of points `(period, acceleration)`");
    }
    let one = |item: &Node| {
        let pair = item.items();
        if !item.is_list() || pair.len() != 2 {
            return c.wrong(item, "a pair `(period, acceleration)`");
        }
        let period = c.ranged(pair[0], "period", TIME, Range::Positive);
        period.zip(c.ranged(pair[1], "acceleration", ACCELERATION, Range::Positive))
    };
    let read: Vec<_> = list.items().into_iter().map(one).collect();
    read.into_iter().collect()
}

/// `Jennings(rise: …, strong: …, decay: …)`, `SaragoniHart(peak_at: …, end: …)` or `Stationary`.
fn envelope(c: &Context<'_>, node: &Node, what: &str) -> Option<Envelope> {
    let what = format!("the envelope of {what}");
    let kind = c.one_of(node, "envelope", &schema::ENVELOPE)?;
    let fields = c.block(node, &what, kind)?;
    match kind.name {
        "Stationary" => Some(Envelope::Stationary),
        "Jennings" => {
            let (rise, strong) = (fields.number(c, "rise"), fields.number(c, "strong"));
            let decay = fields.number(c, "decay");
            Some(Envelope::Jennings { rise: rise?, strong: strong?, decay: decay? })
        }
        _ => {
            let (peak_at, end) = (fields.number(c, "peak_at"), fields.number(c, "end"));
            Some(Envelope::SaragoniHart { peak_at: peak_at?, end: end? })
        }
    }
}
