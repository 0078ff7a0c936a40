//! Axes: ends, ticks, numbers. The script draws the same.

use crate::figure::Axis;

/// Values that differ by less than this share are drawn as a constant.
const CONSTANT: f64 = 1e-3;
/// Largest magnitude that has a place on an axis: those of two such ends, and some room, are no overflow.
const FARTHEST: f64 = 1e300;
/// An axis has so many ticks at least, where it does not count.
const TICKS: usize = 3;

/// Position along an axis, the value or its decade; none where a value has no place.
pub(crate) fn position(axis: &Axis, value: f64) -> Option<f64> {
    let at = if axis.log { value.log10() } else { value };
    (at.abs() <= FARTHEST).then_some(at)
}

/// The ends of an axis, in positions.
pub(crate) fn ends(axis: &Axis, values: impl Iterator<Item = f64>) -> (f64, f64) {
    if let Some((a, b)) = axis.range.filter(|(a, b)| (b - a).is_normal())
        && let (Some(a), Some(b)) = (position(axis, a), position(axis, b))
    {
        return (a, b);
    }
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    if axis.log {
        // Narrow ranges are not blown up to whole decades.
        let room = 0.04 * (high - low).max(0.1);
        return (low - room, high + room);
    }
    let size = low.abs().max(high.abs());
    let room = match high - low {
        // An axis needs a length that can be told from none.
        _ if !(0.1 * size).is_normal() => 0.5,
        // A constant: without digits that are only noise.
        span if span < CONSTANT * size => 0.1 * size,
        span => 0.05 * span,
    };
    (low - room, high + room)
}

/// Positions of ticks and what is written there; about so many as there is room for, three at least.
pub(crate) fn ticks(axis: &Axis, ends: (f64, f64), room: usize) -> Vec<(f64, String)> {
    if axis.log { decades(ends, room) } else { even(axis.whole, ends, room) }
}

fn even(whole: bool, (from, to): (f64, f64), room: usize) -> Vec<(f64, String)> {
    let span = to - from;
    let raw = span / room.max(TICKS) as f64;
    let decade = 10f64.powi(raw.log10().floor() as i32);
    let steps = [10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05].map(|k| k * decade);
    let fits = |step: &f64| *step < raw * 0.999;
    // The smallest step that leaves room for its texts; a smaller one where it gives too few ticks.
    let first = steps.iter().position(fits).unwrap_or(steps.len()).saturating_sub(1);
    let mut found = Vec::new();
    for step in &steps[first..] {
        let step = if whole { step.round().max(1.0) } else { *step };
        found = multiples(step, (from, to));
        if found.len() >= TICKS || whole {
            let decimals = (-(step.log10() + 1e-9).floor()).max(0.0) as usize;
            return found.into_iter().map(|x| (x, text(x, span, decimals))).collect();
        }
    }
    found.into_iter().map(|x| (x, text(x, span, 0))).collect()
}

/// Multiples of a step between ends; nothing where the step is lost beside them.
fn multiples(step: f64, (from, to): (f64, f64)) -> Vec<f64> {
    let (first, last) = ((from / step - 1e-9).ceil(), (to / step + 1e-9).floor());
    let count = last - first;
    if !(0.0..200.0).contains(&count) {
        return Vec::new();
    }
    (0..=count as i32).map(|i| (first + f64::from(i)) * step).collect()
}

/// A number beside an even axis: with the decimals of its step, in one power of a thousand where these are many.
fn text(x: f64, span: f64, decimals: usize) -> String {
    if x.abs() < 1e-9 * span {
        return "0".into();
    }
    let size = x.abs().max(span).log10();
    let plain = if decimals <= 4 && size < 6.0 {
        format!("{x:.decimals$}")
    } else {
        let power = 3 * (span.log10() / 3.0).floor() as i32;
        let digits = (decimals as i32 + power).clamp(0, 17) as usize; // a double has no more
        format!("{:.digits$}e{power}", x / 10f64.powi(power))
    };
    plain.replace('-', "−")
}

fn decades((from, to): (f64, f64), room: usize) -> Vec<(f64, String)> {
    let inside = |x: &f64| *x >= from - 1e-9 && *x <= to + 1e-9;
    let of = |within: &[f64]| -> Vec<f64> {
        let powers = (from.floor() as i32).max(-400)..=(to.ceil() as i32).min(400);
        let all = powers.flat_map(|p| within.iter().map(move |k| f64::from(p) + k.log10()));
        all.filter(inside).collect()
    };
    let whole = of(&[1.0]);
    let every = whole.len().div_ceil(room.max(TICKS)).max(1);
    let mut found: Vec<f64> = whole.into_iter().step_by(every).collect();
    for finer in [&[1.0, 2.0, 5.0][..], &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0]] {
        if found.len() < TICKS {
            found = of(finer);
        }
    }
    if found.len() < TICKS {
        let (low, high) = (10f64.powf(from), 10f64.powf(to));
        let linear = even(false, (low, high), room).into_iter();
        return linear.filter(|(x, _)| *x > 0.0).map(|(x, t)| (x.log10(), t)).collect();
    }
    found.into_iter().map(|x| (x, decade(x))).collect()
}

/// A number beside a logarithmic axis.
fn decade(at: f64) -> String {
    let power = (at + 1e-9).floor();
    let within = (10f64.powf(at - power) * 10.0).round() / 10.0;
    let text = match power as i32 {
        n @ -3..=4 => {
            let digits = usize::try_from(-n).unwrap_or(0) + usize::from(within.fract() > 0.0);
            format!("{:.digits$}", within * 10f64.powi(n))
        }
        n => format!("{within}e{n}"),
    };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(log: bool, whole: bool) -> Axis {
        Axis { label: String::new(), log, range: None, whole }
    }

    fn texts(log: bool, ends: (f64, f64), room: usize) -> Vec<String> {
        ticks(&axis(log, false), ends, room).into_iter().map(|t| t.1).collect()
    }

    #[test]
    fn an_axis_has_three_ticks_whatever_its_ends_and_room() {
        let spans =
            [(0.0, 1.0), (-0.31, 0.29), (9.97, 10.03), (0.95, 2.05), (-3e-7, 8e-7), (1e8, 3.1e8)];
        for ends in spans {
            for room in 1..12 {
                let found = texts(false, ends, room);
                assert!(
                    (3..=2 * room.max(3) + 1).contains(&found.len()),
                    "{ends:?} {room}: {found:?}"
                );
                let mut apart = found.clone();
                apart.dedup();
                assert_eq!(apart, found, "{ends:?} {room}");
            }
        }
        for ends in [(-2.0, 1.0), (0.1, 0.8), (0.41, 0.44), (-9.0, 3.0), (1.9, 3.2)] {
            for room in 1..12 {
                let found = texts(true, ends, room);
                assert!((3..=16).contains(&found.len()), "{ends:?} {room}: {found:?}");
            }
        }
    }

    #[test]
    fn numbers_are_as_short_as_their_distance_allows() {
        assert_eq!(texts(false, (0.0, 1.0), 5), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(texts(false, (-30.0, 30.0), 4), ["−20", "0", "20"]);
        assert_eq!(texts(false, (0.0, 4e-6), 4), ["0", "1e−6", "2e−6", "3e−6", "4e−6"]);
        assert_eq!(texts(true, (-2.0, 1.0), 5), ["0.01", "0.1", "1", "10"]);
        assert_eq!(texts(true, (0.0, 1.0), 5), ["1", "2", "5", "10"]);
        assert_eq!(texts(true, (-7.0, -3.0), 9), ["1e−7", "1e−6", "1e−5", "1e−4", "0.001"]);
        let counted: Vec<_> = ticks(&axis(false, true), (0.7, 4.3), 9);
        assert_eq!(counted.len(), 4);
    }
}
