//! Functions of time in Python.

use super::command::number;
use std::fmt::Write;
use trilith_model::{AfterEnd, Harmonic, Interpolation, Model, Side, TimeFunction, visible_line};

/// Numbers on a line.
const PER_LINE: usize = 8;

/// What all functions are made with.
pub(super) const HELPERS: &str = "\
def table(t, times, values, after):
    \"\"\"A table, straight between its points; nought before the first, `after` behind the last.\"\"\"
    i = bisect_right(times, t)
    if i == 0:
        return 0.0
    if i == len(times):
        return values[-1] if t <= times[-1] * (1.0 + 1e-12) else after
    return values[i - 1] + (values[i] - values[i - 1]) * (t - times[i - 1]) / (times[i] - times[i - 1])
";

/// The functions of a model that a script uses, as `f1`, `f2`, ….
pub(super) fn functions(model: &Model, used: &[usize], h: f64, steps: usize) -> String {
    let mut out = String::new();
    for index in used {
        let f = &model.functions[*index];
        let _ = writeln!(out, "\n\ndef f{}(t):  # {}", index + 1, visible_line(&f.name));
        let _ = write!(out, "{}", body(&f.function, *index + 1, h, steps));
    }
    out
}

fn body(f: &TimeFunction, n: usize, h: f64, steps: usize) -> String {
    let within = |value: String, start: f64, end: f64| {
        let upper = if end.is_finite() { format!(" <= {}", number(end)) } else { String::new() };
        format!("    return {value} if {} <= t{upper} else 0.0\n", number(start))
    };
    let wave = |name: &str, w: &Harmonic| {
        let omega = std::f64::consts::TAU * w.frequency;
        let value = format!(
            "{} * math.{name}({} * (t - {}) + {})",
            number(w.amplitude),
            number(omega),
            number(w.start),
            number(w.phase)
        );
        within(value, w.start, w.end())
    };
    match f {
        TimeFunction::Constant(c) => format!("    return {}\n", number(*c)),
        TimeFunction::Step { amplitude, start, end } => {
            within(number(*amplitude), *start, end.unwrap_or(f64::INFINITY))
        }
        TimeFunction::Ramp { amplitude, start, rise } => format!(
            "    return {} * min(1.0, max(0.0, (t - {}) / {}))\n",
            number(*amplitude),
            number(*start),
            number(*rise)
        ),
        TimeFunction::Sine(w) => wave("sin", w),
        TimeFunction::Cosine(w) => wave("cos", w),
        TimeFunction::HalfSine { amplitude, duration, start } => {
            let value = format!(
                "{} * math.sin(math.pi * (t - {}) / {})",
                number(*amplitude),
                number(*start),
                number(*duration)
            );
            within(value, *start, start + duration)
        }
        TimeFunction::Ricker { amplitude, frequency, center } => format!(
            "    a = (math.pi * {} * (t - {})) ** 2\n    return {} * (1.0 - 2.0 * a) * math.exp(-a)\n",
            number(*frequency),
            number(*center),
            number(*amplitude)
        ),
        TimeFunction::Table(table) if table.interpolation() == Interpolation::Linear => {
            let after = match table.after_end() {
                AfterEnd::Zero => "0.0".to_owned(),
                AfterEnd::Hold | AfterEnd::Error => {
                    number(table.values().last().copied().unwrap_or(0.0))
                }
            };
            format!(
                "    return table(t, T{n}, V{n}, {after})\n\n\nT{n} = {}\nV{n} = {}\n",
                list(table.times()),
                list(table.values())
            )
        }
        // Curved: at the steps of the script, between which it is straight there in any case.
        TimeFunction::Table(_) | TimeFunction::Custom(_) => {
            let times: Vec<f64> = (0..=steps).map(|i| i as f64 * h).collect();
            let values: Vec<f64> = times.iter().map(|t| f.value(*t, Side::After)).collect();
            format!(
                "    return table(t, T{n}, V{n}, 0.0)\n\n\nT{n} = {}\nV{n} = {}\n",
                list(&times),
                list(&values)
            )
        }
    }
}

fn list(all: &[f64]) -> String {
    let lines: Vec<String> = all
        .chunks(PER_LINE)
        .map(|c| format!("    {},", c.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", ")))
        .collect();
    format!("[\n{}\n]", lines.join("\n"))
}
