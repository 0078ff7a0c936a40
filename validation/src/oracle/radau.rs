//! Radau IIA with three stages, order 5, and its transformation to one real and one complex system.
//!
//! [Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed., IV.5 and IV.8]

use nalgebra::{Complex, Matrix3, Vector3};

/// A complex number.
pub type C64 = Complex<f64>;

/// The constants.
#[derive(Clone, Debug)]
pub struct Radau {
    /// Nodes.
    pub c: [f64; 3],
    /// A⁻¹.
    pub inverse: Matrix3<f64>,
    /// Its real eigenvalue.
    pub real: f64,
    /// One of its complex pair.
    pub complex: C64,
    /// Its eigenvectors: of the real one, of the complex one.
    pub to: (Vector3<f64>, Vector3<C64>),
    /// The first two rows of the inverse of the matrix of eigenvectors.
    pub from: (Vector3<f64>, Vector3<C64>),
}

impl Radau {
    /// The constants.
    #[must_use]
    pub fn new() -> Self {
        let s = 6.0_f64.sqrt();
        let a = Matrix3::new(
            (88.0 - 7.0 * s) / 360.0,
            (296.0 - 169.0 * s) / 1800.0,
            (-2.0 + 3.0 * s) / 225.0,
            (296.0 + 169.0 * s) / 1800.0,
            (88.0 + 7.0 * s) / 360.0,
            (-2.0 - 3.0 * s) / 225.0,
            (16.0 - s) / 36.0,
            (16.0 + s) / 36.0,
            1.0 / 9.0,
        );
        let inverse = a.try_inverse().unwrap_or_default();
        // λ³ − 9 λ² + 36 λ − 60 = 0, from the denominator of the stability function.
        let mut x = 3.6;
        for _ in 0..20 {
            let value = ((x - 9.0) * x + 36.0) * x - 60.0;
            x -= value / ((3.0 * x - 18.0) * x + 36.0);
        }
        let (sum, product) = (9.0 - x, 60.0 / x);
        let complex = C64::new(sum / 2.0, (product - sum * sum / 4.0).sqrt());
        let wide = inverse.map(|v| C64::new(v, 0.0));
        let null = |l: C64| {
            let m = wide - Matrix3::identity() * l;
            let (r0, r1) = (m.row(0).transpose(), m.row(1).transpose());
            let v = r0.cross(&r1);
            v / v[2]
        };
        let (v0, v1) = (null(C64::new(x, 0.0)), null(complex));
        let all = Matrix3::from_columns(&[v0, v1, v1.map(|z| z.conj())]);
        let back = all.try_inverse().unwrap_or_default();
        Self {
            c: [(4.0 - s) / 10.0, (4.0 + s) / 10.0, 1.0],
            inverse,
            real: x,
            complex,
            to: (v0.map(|z| z.re), v1),
            from: (back.row(0).transpose().map(|z| z.re), back.row(1).transpose()),
        }
    }
}

impl Default for Radau {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_eigenvectors_turn_the_inverse_into_its_eigenvalues() {
        let it = Radau::new();
        for i in 0..3 {
            for j in 0..3 {
                let got = it.to.0[i] * it.real * it.from.0[j]
                    + 2.0 * (it.to.1[i] * it.complex * it.from.1[j]).re;
                assert!((got - it.inverse[(i, j)]).abs() < 1e-13, "{i} {j}");
            }
        }
        assert!((it.real - 3.637_834_252_744_496).abs() < 1e-12);
    }
}
