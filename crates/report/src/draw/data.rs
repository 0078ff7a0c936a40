//! The drawing of a figure as the script reads it.

use super::style::{Look, looks};
use super::{Frame, hex, position};
use crate::figure::{Axis, Figure, Series, Stroke};
use crate::thin::kept;
use serde::Serialize;
use std::borrow::Cow;
use trilith_model::visible;

/// Steps of a number over the span of its axis.
const STEPS: f64 = 4e5;
/// Digits of numbers on a logarithmic axis.
const DIGITS: usize = 5;

/// What the script is told: axes, series with their looks and points, marked peaks. It is written as it is, without a tree of
/// JSON values between: a page has some hundred thousand numbers, and a page that computes makes them for every answer.
#[derive(Serialize)]
pub(crate) struct Told<'a> {
    title: Cow<'a, str>,
    x: ToldAxis<'a>,
    y: ToldAxis<'a>,
    size: (u32, u32),
    series: Vec<ToldSeries<'a>>,
    #[serde(skip_serializing_if = "str::is_empty")]
    shared: Cow<'a, str>,
    #[serde(skip_serializing_if = "str::is_empty")]
    scale: Cow<'a, str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    settings: Option<[(Cow<'a, str>, Cow<'a, str>); 2]>,
    #[serde(skip_serializing_if = "is_not")]
    equal: bool,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    peaks: Vec<(usize, f64, f64)>,
}

#[derive(Serialize)]
struct ToldAxis<'a> {
    label: Cow<'a, str>,
    #[serde(skip_serializing_if = "is_not")]
    log: bool,
    #[serde(skip_serializing_if = "is_not")]
    whole: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    range: Option<(f64, f64)>,
}

#[derive(Serialize)]
struct ToldSeries<'a> {
    color: String,
    #[serde(skip_serializing_if = "str::is_empty")]
    name: Cow<'a, str>,
    #[serde(flatten)]
    look: ToldLook,
    px: Packed,
    py: Packed,
    #[serde(skip_serializing_if = "Option::is_none")]
    entries: Option<Vec<usize>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    times: Option<Packed>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum ToldLook {
    Line {
        #[serde(skip_serializing_if = "str::is_empty")]
        dash: &'static str,
        width: f64,
    },
    Marks {
        mark: &'static str,
        filled: bool,
    },
    Area {
        area: bool,
    },
}

/// Numbers; null where one has no place on its axis.
#[derive(Serialize)]
#[serde(untagged)]
enum Packed {
    /// As they are.
    Plain(Vec<Option<f64>>),
    /// Differences of whole multiples of a step.
    Steps { from: f64, step: f64, n: Vec<Option<i64>> },
}

// As `skip_serializing_if` calls it.
#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_not(it: &bool) -> bool {
    !it
}

/// A figure for the script. Lines may leave their points by `fine` pixels of the still figure.
pub(crate) fn drawing(figure: &Figure, fine: f64) -> Told<'_> {
    // Only where points are left out it matters where they are on the sheet.
    let frame = (fine > 0.0).then(|| Frame::new(figure));
    let series = figure.series.iter().zip(looks(figure));
    let peaks = figure.peaks.iter().filter(|(_, p)| p.0.is_finite() && p.1.is_finite());
    Told {
        title: visible(&figure.title),
        x: axis(&figure.x),
        y: axis(&figure.y),
        size: figure.size,
        series: series.map(|(s, look)| one(figure, frame.as_ref(), s, look, fine)).collect(),
        shared: visible(&figure.shared),
        scale: visible(&figure.scale),
        settings: figure
            .settings
            .as_ref()
            .map(|all| all.each_ref().map(|(name, unit)| (visible(name), visible(unit)))),
        equal: figure.equal,
        peaks: peaks.map(|(i, p)| (*i, p.0, p.1)).collect(),
    }
}

fn axis(a: &Axis) -> ToldAxis<'_> {
    ToldAxis {
        label: visible(&a.label),
        log: a.log,
        whole: a.whole,
        range: a.range.filter(|(a, b)| (b - a).is_normal()),
    }
}

fn one<'a>(
    figure: &Figure,
    frame: Option<&Frame<'_>>,
    series: &'a Series,
    look: Look,
    fine: f64,
) -> ToldSeries<'a> {
    let chosen = frame.and_then(|frame| chosen(frame, series, fine));
    let count = series.points.len();
    ToldSeries {
        color: hex(series.color),
        name: visible(&series.name),
        look: match look {
            Look::Line(dash, width) => ToldLook::Line { dash, width },
            Look::Marks(shape, filled) => ToldLook::Marks { mark: shape.name(), filled },
            Look::Area => ToldLook::Area { area: true },
        },
        px: packed(&figure.x, some(&series.points, chosen.as_deref(), |p| p.0)),
        py: packed(&figure.y, some(&series.points, chosen.as_deref(), |p| p.1)),
        entries: (series.entries.len() == count && count > 0)
            .then(|| some(&series.entries, chosen.as_deref(), |e| *e)),
        times: (series.times.len() == count && count > 0).then(|| {
            let linear = Axis { label: String::new(), log: false, range: None, whole: false };
            packed(&linear, some(&series.times, chosen.as_deref(), |t| *t))
        }),
    }
}

/// Of all, or of those that are chosen.
fn some<T, U>(all: &[T], chosen: Option<&[usize]>, of: impl Fn(&T) -> U) -> Vec<U> {
    match chosen {
        None => all.iter().map(of).collect(),
        Some(chosen) => chosen.iter().map(|i| of(&all[*i])).collect(),
    }
}

/// Which points are told, by index: of lines those that can be seen. None: all of them.
fn chosen(frame: &Frame<'_>, series: &Series, fine: f64) -> Option<Vec<usize>> {
    let line = matches!(series.stroke, Stroke::Line | Stroke::Dashes);
    if !line || !series.entries.is_empty() {
        return None;
    }
    let mut all = Vec::new();
    let mut piece: Vec<(usize, (f64, f64))> = Vec::new();
    let mut end = |piece: &mut Vec<(usize, (f64, f64))>| {
        let pixels: Vec<_> = piece.iter().map(|p| p.1).collect();
        all.extend(kept(&pixels, fine).into_iter().map(|i| piece[i].0));
        piece.clear();
    };
    for (i, p) in series.points.iter().enumerate() {
        match frame.at(*p) {
            Some(at) => piece.push((i, at)),
            None => {
                // What has no place is told where it parts a line.
                end(&mut piece);
                piece.push((i, (0.0, 0.0)));
                end(&mut piece);
            }
        }
    }
    end(&mut piece);
    Some(all)
}

/// Numbers as differences of whole multiples of a step, which makes short texts; those of logarithmic axes with so many
/// digits. What has no place on the axis is null.
fn packed(axis: &Axis, values: Vec<f64>) -> Packed {
    let values: Vec<Option<f64>> =
        values.into_iter().map(|x| position(axis, x).map(|_| x)).collect();
    let there = || values.iter().flatten().copied();
    if axis.log {
        let short = |x: f64| format!("{x:.*e}", DIGITS - 1).parse::<f64>().unwrap_or(x);
        return Packed::Plain(values.iter().map(|x| x.map(short)).collect());
    }
    let (low, high) =
        there().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    if low > high {
        return Packed::Plain(vec![None; values.len()]);
    }
    let step = even(&values, high - low).unwrap_or((high - low) / STEPS);
    if !step.is_normal() {
        // All alike.
        let n = values.iter().map(|x| x.map(|_| 0)).collect();
        return Packed::Steps { from: low, step: 0.0, n };
    }
    let mut last = 0_i64;
    let n = values.iter().map(|x| {
        let at = nearest((*x)? / step - low / step);
        let delta = at - last;
        last = at;
        Some(delta)
    });
    Packed::Steps { from: low, step, n: n.collect() }
}

/// The whole number beside a number of moderate size: `round` without the call that it is on many processors.
pub(crate) fn nearest(x: f64) -> i64 {
    (x + 0.5_f64.copysign(x)) as i64
}

/// The step of values that are multiples of one.
fn even(values: &[Option<f64>], span: f64) -> Option<f64> {
    let gaps = values.windows(2).filter_map(|w| Some((w[1]? - w[0]?).abs()));
    let step = gaps.filter(|g| *g > 1e-9 * span).fold(f64::INFINITY, f64::min);
    let first = values.iter().flatten().next()?;
    let fits = |x: f64| {
        let n = (x - first) / step;
        (n - nearest(n) as f64).abs() < 1e-4
    };
    (step.is_normal() && span / step < 1e7 && values.iter().flatten().all(|x| fits(*x)))
        .then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    fn drawing(figure: &Figure, fine: f64) -> Value {
        serde_json::to_value(super::drawing(figure, fine)).unwrap()
    }

    /// As the script unpacks it.
    fn unpacked(v: &Value) -> Vec<Option<f64>> {
        if let Some(all) = v.as_array() {
            return all.iter().map(Value::as_f64).collect();
        }
        let (from, step) = (v["from"].as_f64().unwrap(), v["step"].as_f64().unwrap());
        let mut at = 0;
        let n = v["n"].as_array().unwrap().iter();
        n.map(|n| {
            at += n.as_i64()?;
            Some(from + at as f64 * step)
        })
        .collect()
    }

    #[test]
    fn the_script_gets_the_points_back() {
        let wave: Vec<(f64, f64)> =
            (0..400).map(|i| f64::from(i) * 0.005).map(|t| (t, 1e-4 * (9.0 * t).sin())).collect();
        let gap = (f64::NAN, f64::NAN);
        let with_gap = wave[..9].iter().copied().chain([gap]).chain(wave[9..].iter().copied());
        let figure = Figure::new("f", "t [s]", "u [m]").line("a", with_gap.clone());
        let told = drawing(&figure, 0.0);
        let s = &told["series"][0];
        let (x, y) = (unpacked(&s["px"]), unpacked(&s["py"]));
        assert_eq!(s["px"]["n"][1], 1, "even times are counted");
        for (i, p) in with_gap.enumerate() {
            if p.0.is_nan() {
                assert_eq!((x[i], y[i]), (None, None));
            } else {
                assert!((x[i].unwrap() - p.0).abs() < 1e-9 && (y[i].unwrap() - p.1).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn what_cannot_be_seen_is_not_told_and_the_peak_is() {
        let spike = |i: i32| if i == 777 { 5.0 } else { 0.01 * f64::from(i % 2) };
        let line = (0..5000).map(|i| (f64::from(i), spike(i)));
        let figure = Figure::new("f", "t", "u").line("", line).peaks();
        let told = drawing(&figure, 0.2);
        let y = unpacked(&told["series"][0]["py"]);
        assert!(y.len() < 5000 && y.iter().flatten().any(|y| (y - 5.0).abs() < 1e-4));
        assert_eq!(told["peaks"], json!([[0, 777.0, 5.0]]));
    }

    #[test]
    fn a_logarithmic_axis_has_no_place_for_zero() {
        let figure = Figure::new("f", "x", "y").line("", [(0.0, 1.0), (1.234567, 2.0)]).log_log();
        let told = drawing(&figure, 0.0);
        assert_eq!(told["series"][0]["px"], json!([null, 1.2346]));
        let flat = Figure::new("f", "x", "y").line("", [(0.0, 3.0), (1.0, 3.0)]);
        let y = &drawing(&flat, 0.0)["series"][0]["py"];
        assert_eq!(unpacked(y), [Some(3.0), Some(3.0)]);
    }
}
