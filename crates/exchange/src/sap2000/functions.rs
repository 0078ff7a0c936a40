//! Functions of time.

use super::context::Context;
use super::database::Entry;
use crate::ron::{Ron, number};
use std::collections::HashMap;
use std::fmt::Write;
use std::path::Path;

/// Most samples of a function.
const MOST: usize = 4_000_000;
/// More points than these stand in a file of their own.
const INLINE: usize = 100;
const FILE: &str = "FUNCTION - TIME HISTORY - FROM FILE";

/// A function of time, without unit.
#[derive(Clone, Debug)]
enum Shape {
    Points(Vec<[f64; 2]>),
    Ramp { amplitude: f64, rise: f64 },
    Wave { kind: &'static str, amplitude: f64, period: f64, cycles: f64 },
}

/// Functions by name, and what is written of them.
pub struct Functions<'a> {
    shapes: HashMap<&'a str, Shape>,
    /// Why a record is not there, and its file.
    missing: HashMap<&'a str, (&'static str, &'a str)>,
    /// Files beside the model: names and contents.
    pub files: Vec<(String, String)>,
    stem: String,
}

/// Reads functions; records lie in the folder, `stem` is the beginning of the names of files that are written.
pub fn functions<'a>(cx: &mut Context<'a>, folder: Option<&Path>, stem: &str) -> Functions<'a> {
    let mut shapes: HashMap<&str, Shape> = HashMap::new();
    let mut missing = HashMap::new();
    let db = cx.db;
    for row in db.rows("FUNCTION - TIME HISTORY - USER") {
        let point = [row.need_number("Time"), row.need_number("Value")];
        let to = shapes.entry(row.need("Name")).or_insert(Shape::Points(Vec::new()));
        if let Shape::Points(all) = to {
            if all.last().is_some_and(|last| last[0] >= point[0]) {
                row.wrong_at("Time", "times that do not rise", "each later than the one before");
            }
            all.push(point);
        }
    }
    for row in db.rows("FUNCTION - TIME HISTORY - RAMP") {
        let (amplitude, rise) = (row.need_number("Amplitude"), positive(row, "RampTime"));
        shapes.insert(row.need("Name"), Shape::Ramp { amplitude, rise });
    }
    for (table, kind) in [("SINE", "Sine"), ("COSINE", "Cosine")] {
        for row in db.rows(&format!("FUNCTION - TIME HISTORY - {table}")) {
            let (amplitude, period) = (row.need_number("Amplitude"), positive(row, "Period"));
            let cycles = positive(row, "NumCycles");
            shapes.insert(row.need("Name"), Shape::Wave { kind, amplitude, period, cycles });
        }
    }
    for row in db.rows(FILE) {
        match record(row, folder) {
            Ok(points) => _ = shapes.insert(row.need("Name"), Shape::Points(points)),
            Err(why) => _ = missing.insert(row.need("Name"), (why, row.need("FileName"))),
        }
    }
    Functions { shapes, missing, files: Vec::new(), stem: stem.into() }
}

fn positive(row: Entry<'_>, key: &str) -> f64 {
    let x = row.need_number(key);
    if x <= 0.0 {
        row.wrong_at(key, &format!("`{key}` is not above zero"), "");
        return 1.0;
    }
    x
}

/// A record from its file, or why there is none.
fn record(row: Entry<'_>, folder: Option<&Path>) -> Result<Vec<[f64; 2]>, &'static str> {
    let header = row.or_zero("HeaderLines").max(0.0) as usize;
    let prefix = row.or_zero("PrefixChars").max(0.0) as usize;
    let per_line = row.or_zero("PtsPerLine").max(0.0) as usize;
    let (kind, interval) = (row.text("DataType"), row.number("Interval"));
    if row.text("FormatType").is_some_and(|f| f != "Free") {
        return Err("a file with columns of fixed width");
    }
    let bytes = folder.and_then(|folder| find(folder, row.need("FileName")));
    let bytes = bytes.ok_or("the file of a function does not lie beside the model")?;
    let text = String::from_utf8_lossy(&bytes);
    let mut values = Vec::new();
    for line in text.lines().skip(header) {
        let rest: String = line.chars().skip(prefix).collect();
        let cells = rest.split(|c: char| c.is_whitespace() || c == ',').filter(|c| !c.is_empty());
        let most =
            if kind == Some("Time and Value") { per_line.saturating_mul(2) } else { per_line };
        for cell in cells.take(if most == 0 { usize::MAX } else { most }) {
            match cell.parse::<f64>() {
                Ok(x) if x.is_finite() && values.len() < MOST => values.push(x),
                _ => return Err("the file of a function holds no numbers, or too many"),
            }
        }
    }
    let points: Vec<[f64; 2]> = match (kind, interval) {
        (Some("Time and Value"), _) => values.chunks_exact(2).map(|p| [p[0], p[1]]).collect(),
        (_, Some(dt)) if dt > 0.0 => {
            values.iter().enumerate().map(|(i, x)| [i as f64 * dt, *x]).collect()
        }
        _ => Vec::new(),
    };
    if points.len() < 2 || points.windows(2).any(|w| w[1][0] <= w[0][0]) {
        return Err("the file of a function has no rising times");
    }
    Ok(points)
}

/// A file beside the model, whatever its folder was and however its letters are written.
fn find(folder: &Path, path: &str) -> Option<Vec<u8>> {
    let name = path.rsplit(['\\', '/']).next()?.to_lowercase();
    let mut found: Vec<_> = std::fs::read_dir(folder).ok()?.flatten().map(|e| e.path()).collect();
    found.sort();
    let same = |p: &std::path::PathBuf| {
        let own = p.file_name().map(|n| n.to_string_lossy().to_lowercase());
        own.is_some_and(|own| own == name || own.strip_suffix(".txt") == Some(&name))
    };
    std::fs::read(found.into_iter().find(|p| p.is_file() && same(p))?).ok()
}

impl Functions<'_> {
    /// Name of a function in the model file, stretched and late as a case has it; written on its first use.
    pub fn used(&mut self, cx: &mut Context<'_>, row: Entry<'_>, name: &str) -> Option<String> {
        let stretch = row.number("TimeFactor").unwrap_or(1.0);
        let late = row.or_zero("ArrivalTime");
        if stretch <= 0.0 || late < 0.0 {
            row.wrong("a time factor that is not above zero, or an arrival before zero", "");
            return None;
        }
        if let Some((why, file)) = self.missing.get(name) {
            cx.report.lose(FILE, why, &format!("{name}: {file}"));
        }
        let shape = self.shapes.get(name)?.clone();
        let mut told = name.to_owned();
        if stretch != 1.0 {
            told += &format!(" × {}", number(stretch));
        }
        if late != 0.0 {
            told += &format!(" from {}", number(late));
        }
        if cx.draft.functions.iter().any(|(n, _)| *n == told) {
            return Some(told);
        }
        let block = match shape {
            Shape::Ramp { amplitude, rise } => {
                let block =
                    Ron::block("Ramp").with("amplitude", amplitude).with("rise", rise * stretch);
                block.maybe("start", (late != 0.0).then_some(late))
            }
            Shape::Wave { kind, amplitude, period, cycles } => Ron::block(kind)
                .with("amplitude", amplitude)
                .with("frequency", 1.0 / (period * stretch))
                .with("cycles", cycles)
                .maybe("start", (late != 0.0).then_some(late)),
            Shape::Points(points) => {
                let points = moved(cx, name, &points, stretch, late);
                self.points(&told, &points)
            }
        };
        cx.draft.functions.push((told.clone(), block));
        Some(told)
    }

    /// The value at a time of a case.
    pub fn value(&self, row: Entry<'_>, name: &str, t: f64) -> Option<f64> {
        let t = (t - row.or_zero("ArrivalTime")) / row.number("TimeFactor").unwrap_or(1.0);
        let shape = self.shapes.get(name)?;
        Some(match shape {
            _ if t < 0.0 => 0.0,
            Shape::Ramp { amplitude, rise } => amplitude * (t / rise).min(1.0),
            Shape::Wave { kind, amplitude, period, cycles } => {
                let at = std::f64::consts::TAU * t / period;
                if t > cycles * period {
                    0.0
                } else {
                    amplitude * if *kind == "Sine" { at.sin() } else { at.cos() }
                }
            }
            Shape::Points(points) => match points.partition_point(|p| p[0] <= t) {
                0 => points.first().map_or(0.0, |p| p[1]),
                n if n == points.len() => points[n - 1][1],
                n => {
                    let (a, b) = (points[n - 1], points[n]);
                    a[1] + (b[1] - a[1]) * (t - a[0]) / (b[0] - a[0])
                }
            },
        })
    }

    fn points(&mut self, name: &str, points: &[[f64; 2]]) -> Ron {
        if points.len() <= INLINE {
            let pairs = points.iter().map(|p| Ron::vector(p)).collect();
            return Ron::block("Points")
                .with("points", Ron::List(pairs))
                .with("after_end", Ron::word("Hold"));
        }
        let plain: String = name
            .chars()
            .map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' })
            .collect();
        let file = format!("{}.{plain}.csv", self.stem);
        let mut text = String::from("t,value\n");
        for [t, x] in points {
            let _ = writeln!(text, "{},{}", number(*t), number(*x));
        }
        self.files.push((file.clone(), text));
        Ron::block("Table").with("file", Ron::Text(file)).with("after_end", Ron::word("Hold"))
    }
}

/// Samples stretched and late; nothing before the arrival.
fn moved(
    cx: &mut Context<'_>,
    name: &str,
    points: &[[f64; 2]],
    stretch: f64,
    late: f64,
) -> Vec<[f64; 2]> {
    let mut out: Vec<_> = points.iter().map(|p| [p[0] * stretch + late, p[1]]).collect();
    if let Some(first) = out.first().copied().filter(|p| p[0] > 0.0) {
        if first[1] != 0.0 {
            let what = "a function that begins with a jump after time 0 begins with a ramp";
            cx.report.lose("FUNCTION - TIME HISTORY", what, name);
        }
        out.insert(0, [0.0, 0.0]);
    }
    out
}
