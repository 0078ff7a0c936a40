//! Force against deformation.

use super::Record;
use super::record::extremes;
use trilith_report::{Color, Figure, Stroke};

/// The way before the last cycle.
const BEFORE: Color = Color(150, 190, 220);
const LAST: Color = Color::PALETTE[0];

/// A unit in which numbers up to `peak` are easy to read, and 1 SI in it.
fn unit(peak: f64, units: &[(f64, &'static str)]) -> (f64, &'static str) {
    let fits = units.iter().find(|(size, _)| peak >= *size).or(units.last());
    fits.map_or((1.0, ""), |(size, name)| (1.0 / size, *name))
}

const LENGTH: &[(f64, &str)] = &[(1.0, "m"), (1e-3, "mm"), (1e-6, "µm")];
const ANGLE: &[(f64, &str)] = &[(1.0, "rad"), (1e-3, "mrad")];
const FORCE: &[(f64, &str)] = &[(1e6, "MN"), (1e3, "kN"), (1.0, "N")];
const MOMENT: &[(f64, &str)] = &[(1e6, "MN·m"), (1e3, "kN·m"), (1.0, "N·m")];

impl Record {
    /// A diagram of force against deformation for every coordinate that moves: the last cycle dark, the
    /// way to it light; all of a measured history dark.
    #[must_use]
    pub fn figures(&self) -> Vec<Figure> {
        (0..self.coordinates.len()).filter(|i| self.moves(*i)).map(|i| self.figure(i)).collect()
    }

    fn figure(&self, coordinate: usize) -> Figure {
        let c = &self.coordinates[coordinate];
        let (d, f) = (&self.deformation[coordinate], &self.force[coordinate]);
        let peak = |values| {
            let (low, high) = extremes(values);
            low.abs().max(high.abs())
        };
        let [lengths, forces] = if c.rotation { [ANGLE, MOMENT] } else { [LENGTH, FORCE] };
        let (x, x_unit) = unit(peak(d), lengths);
        let (y, y_unit) = unit(peak(f), forces);
        let what = if c.rotation { ["rotation", "moment"] } else { ["deformation", "force"] };
        let points = |range: std::ops::Range<usize>| {
            d[range.clone()].iter().zip(&f[range]).map(|(d, f)| (x * d, y * f)).collect::<Vec<_>>()
        };
        Figure::new(
            c.name.clone(),
            format!("{} {} [{x_unit}]", what[0], c.name),
            format!("{} [{y_unit}]", what[1]),
        )
        .colored("", Stroke::Line, BEFORE, points(0..self.last + 1))
        .colored("", Stroke::Line, LAST, points(self.last..d.len()))
        .sized(460, 320)
    }
}
