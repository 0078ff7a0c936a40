//! Time series.

use super::args::{Args, Told, wrong};
use super::recorder::Recorder;
use super::tcl::{Number, Value};
use crate::ron::{Ron, number};
use std::fmt::Write;

/// Most samples of a series.
const MOST: usize = 2_000_000;
/// More points than these stand in a file of their own.
const INLINE: usize = 100;

/// How a series runs, without its factor.
#[derive(Clone, Debug)]
pub enum Shape {
    Constant,
    Linear,
    /// Samples; what comes behind them: the last one, or nothing.
    Path {
        points: Vec<[f64; 2]>,
        hold: bool,
    },
    Sine {
        start: f64,
        end: f64,
        period: f64,
        phase: f64,
    },
    Step {
        start: f64,
        end: f64,
    },
}

/// A series.
#[derive(Clone, Debug)]
pub struct Series {
    pub name: String,
    pub shape: Shape,
    pub factor: f64,
}

impl Series {
    /// Its value at a time.
    pub fn value(&self, t: f64) -> f64 {
        self.factor
            * match &self.shape {
                Shape::Constant => 1.0,
                Shape::Linear => t,
                Shape::Sine { start, end, period, phase } => {
                    let inside = t >= *start && t <= *end;
                    if inside {
                        (std::f64::consts::TAU * (t - start) / period + phase).sin()
                    } else {
                        0.0
                    }
                }
                Shape::Step { start, end } => f64::from(u8::from(t >= *start && t <= *end)),
                Shape::Path { points, hold } => path(points, *hold, t),
            }
    }

    /// True where it runs straight between two times.
    pub fn is_straight(&self, a: f64, b: f64) -> bool {
        match &self.shape {
            Shape::Constant | Shape::Linear => true,
            Shape::Sine { .. } | Shape::Step { .. } => false,
            Shape::Path { points, .. } => {
                let inside = points.iter().filter(|p| p[0] > a && p[0] < b);
                let (from, to) = (self.value(a), self.value(b));
                let size = from.abs().max(to.abs()).max(f64::MIN_POSITIVE);
                let last = points.last().map_or(0.0, |p| p[0]);
                b <= last * (1.0 + 1e-9)
                    && inside.clone().all(|p| {
                        let straight = from + (to - from) * (p[0] - a) / (b - a);
                        (p[1] * self.factor - straight).abs() <= 1e-9 * size
                    })
            }
        }
    }
}

fn path(points: &[[f64; 2]], hold: bool, t: f64) -> f64 {
    match points.partition_point(|p| p[0] <= t) {
        0 => 0.0,
        n if n == points.len() => {
            let last = points[n - 1];
            if hold || t <= last[0] * (1.0 + 1e-12) { last[1] } else { 0.0 }
        }
        n => {
            let (a, b) = (points[n - 1], points[n]);
            a[1] + (b[1] - a[1]) * (t - a[0]) / (b[0] - a[0])
        }
    }
}

impl Recorder<'_> {
    pub(super) fn time_series(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "timeSeries type tag …");
        let kind = a.word("its type")?;
        let tag = a.whole("its tag")?;
        if self.series.contains_key(&tag) {
            return wrong(
                2,
                format!("there are two time series {tag}"),
                "every series has a tag of its own",
            );
        }
        if let Some(series) = self.shape(kind, &format!("series {tag}"), &mut a)? {
            self.series.insert(tag, series);
        }
        Ok(())
    }

    /// The series that an argument names: a tag, a type, or a list with its type and arguments.
    pub(super) fn series_of(&mut self, a: &mut Args<'_>, name: &str) -> Told<Option<Series>> {
        let word = a.at();
        let value = a.value("its time series")?;
        if let Some(Number::Whole(tag)) = Number::read(value.str()) {
            return match self.series.get(&tag) {
                Some(series) => Ok(Some(series.clone())),
                None => wrong(
                    word,
                    format!("there is no time series {tag}"),
                    "`timeSeries` stands before what uses it",
                ),
            };
        }
        let Ok(items) = value.items() else {
            return wrong(
                word,
                "a time series that is no list",
                "its tag, or \"Path -dt 0.01 -filePath file\"",
            );
        };
        let Some(kind) = items.first() else {
            return wrong(word, "a time series without a type", "");
        };
        let mut inner = Args::new(&items, 1, "Path -dt 0.01 -filePath file -factor 1");
        self.shape(kind.str(), name, &mut inner).map_err(|e| super::args::Wrong { word, ..e })
    }

    /// A series by its type and arguments; none where it is lost.
    fn shape(&mut self, kind: &str, name: &str, a: &mut Args<'_>) -> Told<Option<Series>> {
        let mut factor = 1.0;
        let shape = match kind {
            "Constant" | "ConstantSeries" => Shape::Constant,
            "Linear" | "LinearSeries" => Shape::Linear,
            "Trig" | "Sine" | "TrigSeries" | "SineSeries" => {
                let [start, end] = a.numbers::<2>("tStart, tEnd")?;
                let period = a.positive("the period")?;
                let mut phase = 0.0;
                while let Some(option) = a.option() {
                    match option {
                        "-factor" => factor = a.number("the factor")?,
                        "-shift" | "-phaseShift" => phase = a.number("the phase")?,
                        other => self.unread(other),
                    }
                }
                Shape::Sine { start, end, period, phase }
            }
            "Rectangular" | "Rect" => {
                let [start, end] = a.numbers::<2>("tStart, tEnd")?;
                Shape::Step { start, end }
            }
            "Path" | "Series" | "PathSeries" | "PathTimeSeries" => return self.samples(name, a),
            _ => {
                self.lost("this time series is not read");
                return Ok(None);
            }
        };
        while let Some(option) = a.option() {
            match option {
                "-factor" => factor = a.number("the factor")?,
                other => self.unread(other),
            }
        }
        Ok(Some(Series { name: name.into(), shape, factor }))
    }

    fn samples(&mut self, name: &str, a: &mut Args<'_>) -> Told<Option<Series>> {
        let (mut dt, mut start, mut factor, mut hold, mut lead) = (None, 0.0, 1.0, false, false);
        let (mut values, mut times) = (None, None);
        while let Some(option) = a.option() {
            match option {
                "-dt" => dt = Some(a.positive("the step")?),
                "-startTime" => start = a.number("the start")?,
                "-factor" => factor = a.number("the factor")?,
                "-useLast" => hold = true,
                "-prependZero" => lead = true,
                "-values" => values = Some(self.numbers(a)?),
                "-time" => times = Some(self.numbers(a)?),
                "-filePath" => values = Some(self.file(a)?),
                "-fileTime" => times = Some(self.file(a)?),
                other => self.unread(other),
            }
        }
        let Some(mut values) = values.filter(|v| !v.is_empty()) else {
            return wrong(0, "a series without values", "-values {0 1 0}, or -filePath file");
        };
        if lead {
            values.insert(0, 0.0);
        }
        let points: Vec<[f64; 2]> = match (times, dt) {
            (Some(times), _) => {
                if times.len() != values.len() {
                    let message = format!("{} times and {} values", times.len(), values.len());
                    return wrong(0, message, "one for each");
                }
                times.iter().zip(&values).map(|(t, x)| [*t, *x]).collect()
            }
            (None, Some(dt)) => {
                values.iter().enumerate().map(|(i, x)| [start + i as f64 * dt, *x]).collect()
            }
            (None, None) => {
                return wrong(0, "a series without times", "-dt 0.01, or -time {0 1 2}");
            }
        };
        if points.windows(2).any(|w| w[1][0] <= w[0][0]) {
            return wrong(0, "a series whose times do not rise", "each later than the one before");
        }
        Ok(Some(Series { name: name.into(), shape: Shape::Path { points, hold }, factor }))
    }

    /// Numbers of a list, or of the words that follow.
    fn numbers(&mut self, a: &mut Args<'_>) -> Told<Vec<f64>> {
        let word = a.at();
        let first = a.value("a list of numbers")?;
        let items = first.items().unwrap_or_default();
        let mut out = Vec::new();
        for item in &items {
            match Number::read(item.str()) {
                Some(n) => out.push(n.real()),
                None => {
                    return wrong(
                        word,
                        format!("`{}` is no number", super::args::short(item.str())),
                        "a list of numbers",
                    );
                }
            }
        }
        if items.len() == 1 {
            out.extend(a.all());
        }
        Ok(out)
    }

    /// Numbers of a file in the folder of the script.
    fn file(&mut self, a: &mut Args<'_>) -> Told<Vec<f64>> {
        let word = a.at();
        let name = a.word("a file")?;
        let path = super::tcl::within(self.options.folder.as_deref(), name);
        let read = path
            .and_then(|p| std::fs::read(p).map_err(|e| format!("`{name}` cannot be read: {e}")));
        let bytes = match read {
            Ok(bytes) => bytes,
            Err(why) => {
                return wrong(
                    word,
                    why,
                    "a file of numbers in the folder of the script, or below it",
                );
            }
        };
        let text = String::from_utf8_lossy(&bytes);
        let mut out = Vec::new();
        for (line, row) in text.lines().enumerate() {
            for cell in row.split(|c: char| c.is_whitespace() || c == ',').filter(|c| !c.is_empty())
            {
                match cell.parse::<f64>() {
                    Ok(x) if x.is_finite() && out.len() < MOST => out.push(x),
                    _ => {
                        let cell = super::args::short(cell);
                        let message = format!(
                            "`{name}` line {}: `{cell}` is no number, or there are too many",
                            line + 1
                        );
                        return wrong(word, message, "numbers alone, without a head");
                    }
                }
            }
        }
        Ok(out)
    }

    /// Name of the function of a series from a time on, written on its first use.
    pub(super) fn function(
        &mut self,
        series: &Series,
        from: f64,
        duration: f64,
        smooth: bool,
    ) -> String {
        let mut block = self.function_block(series, from, duration);
        if smooth && matches!(block.name(), "Points" | "Table") {
            block = block.with("interpolation", Ron::word("Cubic"));
        }
        if let Some((name, _)) = self.draft.functions.iter().find(|(_, b)| *b == block) {
            return name.clone();
        }
        let mut tries = std::iter::once(series.name.clone())
            .chain((2..).map(|k| format!("{} {k}", series.name)));
        let name =
            tries.find(|n| !self.draft.functions.iter().any(|(m, _)| m == n)).unwrap_or_default();
        self.draft.functions.push((name.clone(), block));
        name
    }

    fn function_block(&mut self, series: &Series, from: f64, duration: f64) -> Ron {
        let f = series.factor;
        match &series.shape {
            Shape::Constant => Ron::block("Constant").with("value", f),
            Shape::Linear => {
                let ends = [[0.0, f * from], [duration, f * (from + duration)]];
                Ron::block("Points")
                    .with("points", Ron::List(ends.iter().map(|p| Ron::vector(p)).collect()))
                    .with("after_end", Ron::word("Hold"))
            }
            Shape::Step { start, end } => Ron::block("Step")
                .with("amplitude", f)
                .with("start", (start - from).max(0.0))
                .with("end", (end - from).max(1e-12)),
            Shape::Sine { start, end, period, phase } => {
                let late = (start - from).max(0.0);
                let gone = (from - start).max(0.0);
                let cycles = (end - start - gone) / period;
                if cycles <= 0.0 {
                    return Ron::block("Constant").with("value", 0.0);
                }
                let phase = (phase + std::f64::consts::TAU * (gone / period))
                    .rem_euclid(std::f64::consts::TAU);
                Ron::block("Sine")
                    .with("amplitude", f)
                    .with("frequency", 1.0 / period)
                    .with("cycles", cycles)
                    .maybe("start", (late != 0.0).then_some(late))
                    .maybe("phase", (phase != 0.0).then_some(phase))
            }
            Shape::Path { points, hold } => {
                let mut moved: Vec<[f64; 2]> = points
                    .iter()
                    .map(|p| [p[0] - from, f * p[1]])
                    .filter(|p| p[0] > 1e-12 * from.abs())
                    .collect();
                let first = points[0];
                if first[0] <= from {
                    moved.insert(0, [0.0, series.value(from)]);
                } else {
                    if first[1] != 0.0 {
                        self.lose("a series that begins with a jump begins with a ramp");
                    }
                    moved.insert(0, [0.0, 0.0]);
                }
                if moved.len() == 1 {
                    let value = if *hold { moved[0][1] } else { 0.0 };
                    return Ron::block("Constant").with("value", value);
                }
                let after = Ron::word(if *hold { "Hold" } else { "Zero" });
                self.table(&series.name, &moved).with("after_end", after)
            }
        }
    }

    fn table(&mut self, name: &str, points: &[[f64; 2]]) -> Ron {
        if points.len() <= INLINE {
            return Ron::block("Points")
                .with("points", Ron::List(points.iter().map(|p| Ron::vector(p)).collect()));
        }
        let mut text = String::from("t,value\n");
        for [t, x] in points {
            let _ = writeln!(text, "{},{}", number(*t), number(*x));
        }
        if let Some((file, _)) = self.files.iter().find(|(_, t)| *t == text) {
            return Ron::block("Table").with("file", Ron::text(file.clone()));
        }
        let plain = name.replace(' ', "_");
        let stem = format!("{}.{plain}", self.options.stem);
        let mut tries = std::iter::once(stem.clone()).chain((2..).map(|k| format!("{stem}_{k}")));
        let stem = tries
            .find(|s| !self.files.iter().any(|(f, _)| *f == format!("{s}.csv")))
            .unwrap_or_default();
        self.files.push((format!("{stem}.csv"), text));
        Ron::block("Table").with("file", Ron::text(format!("{stem}.csv")))
    }
}
