//! Curves of force over deformation through points, with straight lines between them; the lines at the
//! ends go on.

use trilith_element::ParameterError;

/// The points of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curve<'a> {
    pub(crate) d: &'a [f64],
    pub(crate) f: &'a [f64],
}

impl Curve<'_> {
    /// Ascending, through the origin, no force against its deformation, not falling beyond its ends.
    pub(crate) fn check(self) -> Result<(), ParameterError> {
        let (d, f) = (self.d, self.f);
        let wrong = |name: &str, message: String| Err(ParameterError::inconsistent(name, message));
        if d.len() != f.len() || d.len() < 2 {
            let (a, b) = (d.len(), f.len());
            let message = format!(
                "{a} deformations and {b} forces: give one force for each deformation, two or more"
            );
            return wrong("force", message);
        }
        if let Some(i) = (1..d.len()).find(|&i| d[i] <= d[i - 1]) {
            let message = format!(
                "deformation {} follows {}: they must ascend, from the most negative up",
                d[i],
                d[i - 1]
            );
            return wrong("deformation", message);
        }
        if let Some(i) = (0..d.len()).find(|&i| d[i] * f[i] < 0.0) {
            let message = format!(
                "force {} at deformation {}: a force must have the sign of its deformation",
                f[i], d[i]
            );
            return wrong("force", message);
        }
        let largest = f.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let (zero, _) = self.at(0.0);
        if zero.abs() > 1e-9 * largest || d[0] > 0.0 || d[d.len() - 1] < 0.0 {
            let message = format!(
                "the curve must pass through the origin: add the point (0, 0); force at 0: {zero}"
            );
            return wrong("deformation", message);
        }
        for i in [0, d.len() - 2] {
            if self.slope(i) < 0.0 {
                let message = format!(
                    "the line from ({}, {}) to ({}, {}) goes on for ever and must not fall: add a point \
                     beyond it with the force that remains",
                    d[i],
                    f[i],
                    d[i + 1],
                    f[i + 1]
                );
                return wrong("force", message);
            }
        }
        Ok(())
    }

    /// Slope of the line from point `i` to the next.
    fn slope(self, i: usize) -> f64 {
        (self.f[i + 1] - self.f[i]) / (self.d[i + 1] - self.d[i])
    }

    /// The largest slope of a line.
    pub(crate) fn stiffest(self) -> f64 {
        (0..self.d.len() - 1).map(|i| self.slope(i)).fold(0.0, f64::max)
    }

    /// Force and slope; at a point the slope of the line to the right.
    pub(crate) fn at(self, x: f64) -> (f64, f64) {
        let right = self.d.partition_point(|d| *d <= x).clamp(1, self.d.len() - 1);
        self.along(right - 1, x)
    }

    /// Force and slope on the line from point `i` to the next. Told from the nearest of its ends, so that the points
    /// themselves come out exactly, and of the origin where it passes through: forces of small deformations are no
    /// differences of large ones.
    fn along(self, i: usize, x: f64) -> (f64, f64) {
        let (slope, a, b) = (self.slope(i), self.d[i], self.d[i + 1]);
        let end = if 2.0 * x > a + b { i + 1 } else { i };
        let (mut d, mut f) = (self.d[end], self.f[end]);
        if a < 0.0 && b > 0.0 && x.abs() < (x - d).abs() {
            (d, f) = (0.0, self.f[i] - slope * a);
        }
        (f + slope * (x - d), slope)
    }

    /// ∫ f dd from 0.
    pub(crate) fn area(self, x: f64) -> f64 {
        let (low, high) = (x.min(0.0), x.max(0.0));
        let last = self.d.len() - 2;
        let part = |i: usize| {
            let a = if i == 0 { low } else { self.d[i].clamp(low, high) };
            let b = if i == last { high } else { self.d[i + 1].clamp(low, high) };
            if b > a { self.along(i, 0.5 * (a + b)).0 * (b - a) } else { 0.0 }
        };
        (0..=last).map(part).sum::<f64>() * if x < 0.0 { -1.0 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const CURVE: Curve<'_> =
        Curve { d: &[-2.0, -1.0, 0.0, 1.0, 3.0], f: &[-5.0, -4.0, 0.0, 2.0, 3.0] };

    #[test]
    fn goes_through_its_points_and_on_beyond_them() {
        for (d, f) in CURVE.d.iter().zip(CURVE.f) {
            assert_eq!(CURVE.at(*d).0, *f);
        }
        assert_eq!(CURVE.at(-4.0), (-7.0, 1.0));
        assert_eq!(CURVE.at(5.0), (4.0, 0.5));
        assert_eq!(CURVE.stiffest(), 4.0);
    }

    #[test]
    fn its_area_is_the_integral() {
        for x in [-4.0, -1.5, -0.3, 0.0, 0.4, 2.0, 6.0] {
            let n = 4000;
            let h = x / f64::from(n);
            let sum: f64 = (0..n).map(|i| CURVE.at((f64::from(i) + 0.5) * h).0 * h).sum();
            assert_relative_eq!(CURVE.area(x), sum, max_relative = 1e-6);
        }
    }

    /// Vibrations far below the points would be lost in the rounding of forces there.
    #[test]
    fn about_the_origin_forces_and_areas_are_exact_however_small() {
        let through = Curve { d: &[-0.3, 0.7], f: &[-0.9, 2.1] };
        for (curve, slopes) in [(CURVE, [4.0, 2.0]), (through, [3.0, 3.0])] {
            for x in [-1e-12, 1e-12] {
                let k = if x < 0.0 { slopes[0] } else { slopes[1] };
                // Where no point is at the origin, its own force is as exact as the points.
                let zero = curve.at(0.0).0;
                let force = (curve.at(x).0 - zero) / (k * x);
                let area = (curve.area(x) - zero * x) / (0.5 * k * x * x);
                assert!((force - 1.0).abs() < 1e-12, "{force}");
                assert!((area - 1.0).abs() < 1e-12, "{area}");
            }
        }
    }

    #[test]
    fn says_what_is_wrong_with_points() {
        let name = |d: &[f64], f: &[f64]| {
            Curve { d, f }.check().unwrap_err().parameter().unwrap_or_default().to_owned()
        };
        assert_eq!(name(&[0.0, 1.0], &[0.0]), "force");
        assert_eq!(name(&[0.0, 0.0], &[0.0, 1.0]), "deformation");
        assert_eq!(name(&[-1.0, 0.0, 1.0], &[1.0, 0.0, 1.0]), "force");
        assert_eq!(name(&[-1.0, 0.0, 1.0], &[-1.0, 0.5, 1.0]), "deformation");
        assert_eq!(name(&[1.0, 2.0], &[1.0, 2.0]), "deformation");
        assert_eq!(name(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.5]), "force");
        assert!(Curve { d: &[-1.0, 1.0], f: &[-2.0, 2.0] }.check().is_ok());
        assert!(CURVE.check().is_ok());
    }
}
