//! Power laws by least squares.

/// y ≈ factor · x^exponent.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Power {
    /// Factor.
    pub factor: f64,
    /// Exponent.
    pub exponent: f64,
}

impl Power {
    /// The law that is nearest to the points in logarithms; `None` with fewer than two different places.
    #[must_use]
    pub fn through(points: &[(f64, f64)]) -> Option<Self> {
        let logs: Vec<(f64, f64)> = points
            .iter()
            .filter(|(x, y)| *x > 0.0 && *y > 0.0)
            .map(|(x, y)| (x.ln(), y.ln()))
            .collect();
        let n = logs.len() as f64;
        let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
        let (a, b) = (mean(|p| p.0), mean(|p| p.1));
        let spread: f64 = logs.iter().map(|(x, _)| (x - a) * (x - a)).sum();
        if spread.is_nan() || spread < 1e-12 {
            return None;
        }
        let exponent = logs.iter().map(|(x, y)| (x - a) * (y - b)).sum::<f64>() / spread;
        Some(Self { factor: (b - exponent * a).exp(), exponent })
    }

    /// Its value.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::Power;

    #[test]
    fn a_power_law_is_found() {
        let points = [1.0, 3.0, 10.0, 50.0].map(|x: f64| (x, 2.5 * x.powf(1.25)));
        let law = Power::through(&points).unwrap();
        assert!(
            (law.exponent - 1.25).abs() < 1e-12
                && (law.at(2.0) - points[0].1 * 2f64.powf(1.25)).abs() < 1e-12
        );
        assert_eq!(Power::through(&points[..1]), None);
        assert_eq!(Power::through(&[(1.0, 2.0), (1.0, 3.0)]), None);
    }

    #[test]
    fn noise_is_averaged() {
        let points = [(1.0, 1.1), (10.0, 9.0), (100.0, 110.0), (1000.0, 900.0)];
        let law = Power::through(&points).unwrap();
        assert!((law.exponent - 1.0).abs() < 0.05, "{law:?}");
    }
}
