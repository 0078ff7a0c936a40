//! A measured history that a link is led along.

use super::Coordinate;
use crate::element::dimension::{LENGTH, NONE, TIME};
use crate::model::quantity;

/// Deformations at times, for every coordinate of a law. Between two samples runs a cubic whose rate is continuous
/// and which has no extreme of its own, so that the turning points are those of the samples (Steffen 1990).
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Times, s, rising; two or more.
    pub time: Vec<f64>,
    /// Deformations of each coordinate, m or rad.
    pub deformation: Vec<Vec<f64>>,
    /// Names of the columns of the file that are not used.
    pub unused: Vec<String>,
    /// Rates of each coordinate at the samples.
    rate: Vec<Vec<f64>>,
}

/// Why a text is no history.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HistoryError {
    /// A head names no time.
    #[error("the first line names no column `t`")]
    NoTime,
    /// A head names no coordinate.
    #[error("the first line names none of the coordinates {}", .0.join(", "))]
    NoCoordinate(Vec<String>),
    /// Two columns for one.
    #[error("two columns are named `{0}`")]
    Twice(String),
    /// The unit of a column is none that fits.
    #[error("column `{column}`: {why}")]
    Unit {
        /// The column.
        column: String,
        /// What is wrong.
        why: String,
    },
    /// A line with another number of cells.
    #[error("line {line} has {found} of {wanted} columns")]
    Cells {
        /// The line, from 1.
        line: usize,
        /// Cells in it.
        found: usize,
        /// Columns in the first line.
        wanted: usize,
    },
    /// A cell that is no number.
    #[error("line {line}, column `{column}`: `{text}` is no finite number")]
    NotANumber {
        /// The line, from 1.
        line: usize,
        /// The column.
        column: String,
        /// What stands there.
        text: String,
    },
    /// Time stands or goes back.
    #[error("line {line}: time must rise")]
    Order {
        /// The line, from 1.
        line: usize,
    },
    /// Fewer than two samples.
    #[error("a history needs at least two samples, this one has {0}")]
    TooShort(usize),
}

/// `U1 [mm]` → (`U1`, `mm`).
fn head(cell: &str) -> (&str, Option<&str>) {
    match cell.trim().trim_end_matches(']').split_once('[') {
        Some((name, unit)) => (name.trim(), Some(unit.trim())),
        None => (cell.trim(), None),
    }
}

/// What a unit is in SI; SI where there is none.
fn factor(cell: &str, rotation: Option<bool>) -> Result<f64, HistoryError> {
    let dimension = match rotation {
        None => TIME,
        Some(true) => NONE,
        Some(false) => LENGTH,
    };
    let Some(unit) = head(cell).1 else { return Ok(1.0) };
    quantity(&format!("1 {unit}"), dimension)
        .map_err(|why| HistoryError::Unit { column: head(cell).0.to_owned(), why })
}

impl History {
    /// Reads comma-separated values. The first line names the columns: `t`, and coordinates of the law (also as `d U1`,
    /// as the path of an exercise has them), each with its unit behind it, such as `U1 [mm]`, or in SI. Coordinates
    /// without a column do not move. Empty lines and those that begin with `#` are left out.
    ///
    /// # Errors
    /// [`HistoryError`] with the line.
    pub fn parse(text: &str, coordinates: &[Coordinate]) -> Result<Self, HistoryError> {
        let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
        let lines = lines.map(|(i, l)| (i + 1, l.trim()));
        let mut lines = lines.filter(|(_, l)| !l.is_empty() && !l.starts_with('#'));
        let heads: Vec<&str> = lines.next().map_or(Vec::new(), |(_, l)| l.split(',').collect());
        let names: Vec<&str> = heads.iter().map(|cell| head(cell).0).collect();
        let column = |name: &str| -> Result<Option<usize>, HistoryError> {
            let bare =
                |n: &str| n == name || n.strip_prefix("d ").is_some_and(|n| n.trim() == name);
            let mut places = (0..names.len()).filter(|k| bare(names[*k]));
            match (places.next(), places.next()) {
                (_, Some(_)) => Err(HistoryError::Twice(name.to_owned())),
                (place, None) => Ok(place),
            }
        };
        let at_time = column("t")?.ok_or(HistoryError::NoTime)?;
        let of: Vec<Option<usize>> =
            coordinates.iter().map(|c| column(&c.name)).collect::<Result<_, _>>()?;
        if of.iter().all(Option::is_none) {
            let names = coordinates.iter().map(|c| c.name.clone()).collect();
            return Err(HistoryError::NoCoordinate(names));
        }
        let seconds = factor(heads[at_time], None)?;
        let factors: Vec<f64> = of
            .iter()
            .zip(coordinates)
            .map(|(k, c)| k.map_or(Ok(0.0), |k| factor(heads[k], Some(c.rotation))))
            .collect::<Result<_, _>>()?;
        let used = |k: usize| k == at_time || of.contains(&Some(k));
        let unused = (0..names.len()).filter(|k| !used(*k)).map(|k| names[k].to_owned()).collect();
        let mut time: Vec<f64> = Vec::new();
        let mut deformation: Vec<Vec<f64>> = vec![Vec::new(); coordinates.len()];
        for (line, text) in lines {
            let cells: Vec<&str> = text.split(',').map(str::trim).collect();
            if cells.len() != heads.len() {
                let (found, wanted) = (cells.len(), heads.len());
                return Err(HistoryError::Cells { line, found, wanted });
            }
            let number = |k: usize| match cells[k].parse::<f64>() {
                Ok(x) if x.is_finite() => Ok(x),
                _ => Err(HistoryError::NotANumber {
                    line,
                    column: names[k].to_owned(),
                    text: cells[k].to_owned(),
                }),
            };
            let t = seconds * number(at_time)?;
            if time.last().is_some_and(|before| t <= *before) {
                return Err(HistoryError::Order { line });
            }
            time.push(t);
            for ((list, k), factor) in deformation.iter_mut().zip(&of).zip(&factors) {
                list.push(k.map_or(Ok(0.0), |k| number(k).map(|x| factor * x))?);
            }
        }
        if time.len() < 2 {
            return Err(HistoryError::TooShort(time.len()));
        }
        let rate = deformation.iter().map(|d| slopes(&time, d)).collect();
        Ok(Self { time, deformation, unused, rate })
    }

    /// Number of samples.
    pub(super) fn len(&self) -> usize {
        self.time.len()
    }

    /// Deformations and rates a share (0 … 1) of the way from a sample to the next.
    pub(super) fn between(&self, sample: usize, share: f64) -> (Vec<f64>, Vec<f64>) {
        let h = self.time[sample + 1] - self.time[sample];
        let one = |(d, v): (&Vec<f64>, &Vec<f64>)| {
            let (a, b) = (d[sample], d[sample + 1]);
            // At a sample it is the sample, to the bit.
            if share >= 1.0 {
                return (b, v[sample + 1]);
            }
            let (va, vb, s) = (v[sample], v[sample + 1], share);
            let (rise, x) = ((b - a) / h, h * s);
            let c2 = 3.0 * rise - 2.0 * va - vb;
            let c3 = va + vb - 2.0 * rise;
            (a + x * (va + s * (c2 + s * c3)), va + s * (2.0 * c2 + 3.0 * s * c3))
        };
        self.deformation.iter().zip(&self.rate).map(one).unzip()
    }
}

/// Rates at the samples: those of a parabola through three, no steeper than what keeps the cubics between the samples
/// from turning on the way.
fn slopes(t: &[f64], d: &[f64]) -> Vec<f64> {
    let steps: Vec<(f64, f64)> = t
        .windows(2)
        .zip(d.windows(2))
        .map(|(t, d)| (t[1] - t[0], (d[1] - d[0]) / (t[1] - t[0])))
        .collect();
    let inside = steps.windows(2).map(|w| {
        let ((h0, s0), (h1, s1)) = (w[0], w[1]);
        if s0 * s1 <= 0.0 {
            return 0.0;
        }
        let parabola = (s0 * h1 + s1 * h0) / (h0 + h1);
        2.0 * s0.signum() * s0.abs().min(s1.abs()).min(0.5 * parabola.abs())
    });
    let mut all = vec![steps[0].1];
    all.extend(inside);
    all.push(steps[steps.len() - 1].1);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn coordinates() -> [Coordinate; 2] {
        let one = |name: &str, rotation| Coordinate { name: name.into(), rotation };
        [one("U1", false), one("R3", true)]
    }

    #[test]
    fn columns_are_found_by_name_and_read_in_their_units() {
        let text = "# made up\nt [ms], F [kN], U1 [mm]\n0,1,0\n\n500,2,2.5\n1000,3,-1\n";
        let history = History::parse(text, &coordinates()).unwrap();
        assert_eq!(history.time, [0.0, 0.5, 1.0]);
        assert_eq!(history.deformation[1], [0.0; 3]);
        assert!((history.deformation[0][1] - 2.5e-3).abs() < 1e-18, "{history:?}");
        assert_eq!(history.unused, ["F"]);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        let wrong = |text: &str| History::parse(text, &coordinates()).unwrap_err().to_string();
        for (text, part) in [
            ("", "no column `t`"),
            ("t,x\n0,1\n", "none of the coordinates U1, R3"),
            ("t,U1,d U1\n0,1,1\n", "two columns are named `U1`"),
            ("t,U1 [kN]\n0,1\n1,1\n", "column `U1`: "),
            ("t,U1\n0,1\n1\n", "line 3 has 1 of 2 columns"),
            ("t,U1\n0,1\n1,x\n", "line 3, column `U1`: `x`"),
            ("t,U1\n0,1\n\n0,2\n", "line 4: time must rise"),
            ("t,U1\n0,1\n", "at least two samples"),
        ] {
            assert!(wrong(text).contains(part), "{text}: {}", wrong(text));
        }
    }

    #[test]
    fn between_samples_nothing_turns_and_rates_are_derivatives() {
        let text = "t,U1\n0,0\n1,0.1\n1.5,0.4\n2,0.4\n4,-0.3\n";
        let history = History::parse(text, &coordinates()).unwrap();
        for sample in 0..history.len() - 1 {
            let d = &history.deformation[0];
            let (low, high) = (d[sample].min(d[sample + 1]), d[sample].max(d[sample + 1]));
            let step = history.time[sample + 1] - history.time[sample];
            for k in 1..100 {
                let share = f64::from(k) / 100.0;
                let at = |s: f64| history.between(sample, s);
                let (d, v) = at(share);
                assert!(d[0] >= low - 1e-15 && d[0] <= high + 1e-15, "{sample} {share} {d:?}");
                let quotient = (at(share + 1e-6).0[0] - at(share - 1e-6).0[0]) / (2e-6 * step);
                assert!((quotient - v[0]).abs() < 1e-8, "{sample} {share}: {quotient} {v:?}");
            }
        }
        assert_eq!(history.between(1, 1.0).0[0], 0.4);
    }
}
