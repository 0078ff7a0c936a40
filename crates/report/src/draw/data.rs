//! The drawing of a figure as the script reads it.

use super::style::{Look, looks};
use super::{Frame, hex, position};
use crate::figure::{Axis, Figure, Series, Stroke};
use crate::thin::kept;
use serde_json::{Value, json};

/// Steps of a number over the span of its axis.
const STEPS: f64 = 4e5;
/// Digits of numbers on a logarithmic axis.
const DIGITS: usize = 5;

/// JSON for the script: axes, series with their looks and points, marked peaks. Lines may leave their points by `fine`
/// pixels of the still figure.
pub(crate) fn drawing(figure: &Figure, fine: f64) -> Value {
    let frame = Frame::new(figure);
    let series = figure.series.iter().zip(looks(figure));
    let series: Vec<Value> = series.map(|(s, look)| one(&frame, s, look, fine)).collect();
    let mut out = json!({
        "title": figure.title,
        "x": axis(&figure.x),
        "y": axis(&figure.y),
        "size": [figure.size.0, figure.size.1],
        "series": series,
    });
    let mut say = |key: &str, value: Value| out[key] = value;
    if !figure.shared.is_empty() {
        say("shared", json!(figure.shared));
    }
    if !figure.scale.is_empty() {
        say("scale", json!(figure.scale));
    }
    if let Some(settings) = &figure.settings {
        say("settings", json!(settings));
    }
    if figure.equal {
        say("equal", json!(true));
    }
    if !figure.peaks.is_empty() {
        let peaks = figure.peaks.iter().filter(|(_, p)| p.0.is_finite() && p.1.is_finite());
        say("peaks", peaks.map(|(i, p)| json!([i, p.0, p.1])).collect());
    }
    out
}

fn axis(a: &Axis) -> Value {
    let mut out = json!({ "label": a.label });
    if a.log {
        out["log"] = json!(true);
    }
    if a.whole {
        out["whole"] = json!(true);
    }
    if let Some((from, to)) = a.range.filter(|(a, b)| (b - a).is_normal()) {
        out["range"] = json!([from, to]);
    }
    out
}

fn one(frame: &Frame<'_>, series: &Series, look: Look, fine: f64) -> Value {
    let mut out = json!({ "color": hex(series.color) });
    if !series.name.is_empty() {
        out["name"] = json!(series.name);
    }
    match look {
        Look::Line(dash, width) => {
            if !dash.is_empty() {
                out["dash"] = json!(dash);
            }
            out["width"] = json!(width);
        }
        Look::Marks(shape, filled) => {
            out["mark"] = json!(shape.name());
            out["filled"] = json!(filled);
        }
        Look::Area => out["area"] = json!(true),
    }
    let chosen = chosen(frame, series, fine);
    let points = || chosen.iter().map(|i| series.points[*i]);
    out["px"] = packed(&frame.figure.x, points().map(|p| p.0).collect());
    out["py"] = packed(&frame.figure.y, points().map(|p| p.1).collect());
    if series.entries.len() == series.points.len() {
        out["entries"] = chosen.iter().map(|i| json!(series.entries[*i])).collect();
    }
    if series.times.len() == series.points.len() {
        let linear = Axis { label: String::new(), log: false, range: None, whole: false };
        out["times"] = packed(&linear, chosen.iter().map(|i| series.times[*i]).collect());
    }
    out
}

/// Which points are told, by index: of lines those that can be seen.
fn chosen(frame: &Frame<'_>, series: &Series, fine: f64) -> Vec<usize> {
    let line = matches!(series.stroke, Stroke::Line | Stroke::Dashes);
    if !line || fine <= 0.0 || !series.entries.is_empty() {
        return (0..series.points.len()).collect();
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
    all
}

/// Numbers as differences of whole multiples of a step, which makes short texts; those of logarithmic axes with so many
/// digits. What has no place on the axis is null.
fn packed(axis: &Axis, values: Vec<f64>) -> Value {
    let values: Vec<Option<f64>> =
        values.into_iter().map(|x| position(axis, x).map(|_| x)).collect();
    let there = || values.iter().flatten().copied();
    if axis.log {
        let short = |x: f64| format!("{x:.*e}", DIGITS - 1).parse::<f64>().unwrap_or(x);
        return values.iter().map(|x| x.map_or(Value::Null, |x| json!(short(x)))).collect();
    }
    let (low, high) =
        there().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    if low > high {
        return values.iter().map(|_| Value::Null).collect();
    }
    let step = even(&values, high - low).unwrap_or((high - low) / STEPS);
    if !step.is_normal() {
        // All alike.
        return json!({ "from": low, "step": 0.0, "n": values.iter().map(|x| x.map(|_| 0)).collect::<Vec<_>>() });
    }
    let mut last = 0_i64;
    let n: Vec<Option<i64>> = values
        .iter()
        .map(|x| {
            let at = ((*x)? / step - low / step).round() as i64;
            let delta = at - last;
            last = at;
            Some(delta)
        })
        .collect();
    json!({ "from": low, "step": step, "n": n })
}

/// The step of values that are multiples of one.
fn even(values: &[Option<f64>], span: f64) -> Option<f64> {
    let gaps = values.windows(2).filter_map(|w| Some((w[1]? - w[0]?).abs()));
    let step = gaps.filter(|g| *g > 1e-9 * span).fold(f64::INFINITY, f64::min);
    let first = values.iter().flatten().next()?;
    let fits = |x: f64| {
        let n = (x - first) / step;
        (n - n.round()).abs() < 1e-4
    };
    (step.is_normal() && span / step < 1e7 && values.iter().flatten().all(|x| fits(*x)))
        .then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;

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
