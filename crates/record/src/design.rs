//! Elastic response spectra of codes, and spectra given by points: pseudo-acceleration over period.

/// A design spectrum.
#[derive(Clone, Debug, PartialEq)]
pub enum DesignSpectrum {
    /// EN 1998-1:2004, 3.2.2.2: the horizontal elastic spectrum.
    Ec8(Ec8),
    /// ASCE/SEI 7-16, 11.4.6, reduced by the damping coefficient of its Table 17.5-1.
    Asce7(Asce7),
    /// Points, straight between them; the damping is that for which they were made.
    Points(Points),
}

/// Parameters of the spectrum of EN 1998-1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ec8 {
    /// Design ground acceleration on type A ground, m/s².
    pub ag: f64,
    /// S, and T_B, T_C, T_D in s.
    pub soil: [f64; 4],
}

/// Parameters of the spectrum of ASCE 7.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asce7 {
    /// S_DS, m/s².
    pub sds: f64,
    /// S_D1, m/s².
    pub sd1: f64,
    /// T_L, s.
    pub tl: f64,
}

/// Rising periods (s) with accelerations (m/s²).
#[derive(Clone, Debug, PartialEq)]
pub struct Points(Vec<[f64; 2]>);

/// Last period of the spectrum of EN 1998-1, s; beyond it its Annex A holds.
const EC8_END: f64 = 4.0;

/// Damping ratios and coefficients B_M \[ASCE/SEI 7-16, Table 17.5-1\].
const ASCE7_DAMPING: [[f64; 2]; 7] =
    [[0.02, 0.8], [0.05, 1.0], [0.10, 1.2], [0.20, 1.5], [0.30, 1.7], [0.40, 1.9], [0.50, 2.0]];

impl Ec8 {
    /// Of a type of spectrum (1 or 2) and a ground type (A to E) \[EN 1998-1:2004, Tables 3.2 and 3.3\].
    #[must_use]
    pub fn new(ag: f64, kind: u8, ground: char) -> Option<Self> {
        let soil = match (kind, ground) {
            (1, 'A') => [1.0, 0.15, 0.4, 2.0],
            (1, 'B') => [1.2, 0.15, 0.5, 2.0],
            (1, 'C') => [1.15, 0.20, 0.6, 2.0],
            (1, 'D') => [1.35, 0.20, 0.8, 2.0],
            (1, 'E') => [1.4, 0.15, 0.5, 2.0],
            (2, 'A') => [1.0, 0.05, 0.25, 1.2],
            (2, 'B') => [1.35, 0.05, 0.25, 1.2],
            (2, 'C') => [1.5, 0.10, 0.25, 1.2],
            (2, 'D') => [1.8, 0.10, 0.30, 1.2],
            (2, 'E') => [1.6, 0.05, 0.25, 1.2],
            _ => return None,
        };
        Some(Self { ag, soil })
    }

    fn at(&self, t: f64, damping: f64) -> f64 {
        let [s, tb, tc, td] = self.soil;
        let eta = (10.0 / (5.0 + 100.0 * damping)).sqrt().max(0.55);
        let most = 2.5 * eta * self.ag * s;
        match t {
            _ if t < tb => self.ag * s * (1.0 + t / tb * (2.5 * eta - 1.0)),
            _ if t <= tc => most,
            _ if t <= td => most * tc / t,
            _ => most * tc * td / (t * t),
        }
    }
}

impl Asce7 {
    fn at(&self, t: f64, damping: f64) -> f64 {
        let Self { sds, sd1, tl } = *self;
        let ts = sd1 / sds;
        let t0 = 0.2 * ts;
        let of_5_percent = match t {
            _ if t < t0 => sds * (0.4 + 0.6 * t / t0),
            _ if t <= ts => sds,
            _ if t <= tl => sd1 / t,
            _ => sd1 * tl / (t * t),
        };
        of_5_percent / straight(&ASCE7_DAMPING, damping)
    }
}

impl Points {
    /// Two points or more, with rising periods from 0 on and accelerations from 0 on.
    #[must_use]
    pub fn new(points: Vec<[f64; 2]>) -> Option<Self> {
        let rise = points.windows(2).all(|two| two[0][0] < two[1][0]);
        let sound = points.iter().flatten().all(|x| x.is_finite() && *x >= 0.0);
        (points.len() >= 2 && rise && sound).then_some(Self(points))
    }
}

/// Straight between points, and level beyond them.
fn straight(points: &[[f64; 2]], x: f64) -> f64 {
    let next = points.partition_point(|p| p[0] < x);
    if next == 0 {
        return points[0][1];
    }
    let Some([x1, y1]) = points.get(next) else { return points[points.len() - 1][1] };
    let [x0, y0] = points[next - 1];
    y0 + (y1 - y0) * (x - x0) / (x1 - x0)
}

impl DesignSpectrum {
    /// First and last period that it has, s.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        match self {
            Self::Ec8(_) => [0.0, EC8_END],
            Self::Asce7(_) => [0.0, f64::INFINITY],
            Self::Points(Points(points)) => [points[0][0], points[points.len() - 1][0]],
        }
    }

    /// Pseudo-acceleration at a period (s) and a damping ratio, m/s²; `None` beyond its [range](Self::range).
    ///
    /// ```
    /// use trilith_record::design::{DesignSpectrum, Ec8};
    ///
    /// let ground_b = DesignSpectrum::Ec8(Ec8::new(2.0, 1, 'B').expect("a ground type"));
    /// // On the plateau 2.5 η S a_g; η = √(10 / 15) at 10 % of critical damping.
    /// assert_eq!(ground_b.acceleration(0.3, 0.05), Some(2.5 * 1.2 * 2.0));
    /// let less = ground_b.acceleration(0.3, 0.10).expect("a value");
    /// assert!((less / 6.0 - (10.0f64 / 15.0).sqrt()).abs() < 1e-12);
    /// assert_eq!(ground_b.acceleration(4.5, 0.05), None);
    /// ```
    #[must_use]
    pub fn acceleration(&self, period: f64, damping: f64) -> Option<f64> {
        let [first, last] = self.range();
        if !(first..=last).contains(&period) {
            return None;
        }
        Some(match self {
            Self::Ec8(ec8) => ec8.at(period, damping),
            Self::Asce7(asce7) => asce7.at(period, damping),
            Self::Points(Points(points)) => straight(points, period),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand, from the formulas of the codes.
    #[test]
    fn spectra_of_codes_have_the_values_of_their_formulas() {
        let c = DesignSpectrum::Ec8(Ec8::new(1.0, 1, 'C').unwrap());
        for (t, wanted) in [
            (0.0, 1.15),
            (0.1, 1.15 * (1.0 + 0.5 * 1.5)),
            (0.2, 2.875),
            (0.6, 2.875),
            (1.2, 1.4375),
            (2.0, 0.8625),
            (4.0, 0.215_625),
        ] {
            let found = c.acceleration(t, 0.05).unwrap();
            assert!((found - wanted).abs() < 1e-12, "{t} s: {found}, not {wanted}");
        }
        // η is not below 0.55, at 28 % and more.
        let floor = c.acceleration(0.3, 0.5).unwrap();
        assert!((floor - 0.55 * 2.875).abs() < 1e-12, "{floor}");

        let a = DesignSpectrum::Asce7(Asce7 { sds: 10.0, sd1: 6.0, tl: 8.0 });
        for (t, damping, wanted) in [
            (0.0, 0.05, 4.0),
            (0.06, 0.05, 7.0),
            (0.4, 0.05, 10.0),
            (2.0, 0.05, 3.0),
            (2.0, 0.10, 2.5),
            (2.0, 0.15, 3.0 / 1.35),
            (16.0, 0.05, 6.0 * 8.0 / 256.0),
        ] {
            let found = a.acceleration(t, damping).unwrap();
            assert!((found - wanted).abs() < 1e-12, "{t} s: {found}, not {wanted}");
        }
    }

    #[test]
    fn points_are_joined_and_end() {
        assert_eq!(Points::new(vec![[0.0, 1.0]]), None);
        assert_eq!(Points::new(vec![[0.5, 1.0], [0.5, 2.0]]), None);
        assert_eq!(Points::new(vec![[0.0, 1.0], [0.5, f64::NAN]]), None);
        let points = Points::new(vec![[0.1, 1.0], [0.5, 3.0], [1.0, 2.0]]).unwrap();
        let points = DesignSpectrum::Points(points);
        assert_eq!(points.acceleration(0.3, 0.05), Some(2.0));
        assert_eq!(points.acceleration(1.0, 0.05), Some(2.0));
        assert_eq!(points.acceleration(0.05, 0.05), None);
        assert_eq!(points.acceleration(1.01, 0.05), None);
    }
}
