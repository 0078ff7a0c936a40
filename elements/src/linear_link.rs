//! Linear link: coupled stiffness and damping that may be unsymmetric or indefinite, as of seals and
//! journal bearings.
//!
//! ```text
//!   f = K d + C ḋ          d: deformations along U1, U2, U3 and about R1, R2, R3
//! ```
//!
//! At least one of both. Only directions with an entry are used. Where both matrices are symmetric and
//! positive semi-definite a [`Spring`](crate::Spring) does the same and is part of the structure, its
//! modes and its damping.
//!
//! Energies: `stored` is ½ dᵀ K_s d with the symmetric part of K, which is negative where that is
//! indefinite; `hysteretic` takes the work of the skew part (circulatory: not from a potential, and
//! without regard to rates), `viscous` that of C. Both can be negative: then the link gives energy, as
//! what drives the shaft does.
//!
//! Reference: \[Childs 1993\].

use nalgebra::DMatrix;
use serde::Deserialize;
use trilith_element::lanes::{LaneAt, LaneForce, LaneForm, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Dimension, Exercise, Kinematics, Link, NodeCount,
    ParameterError, Parameters, Response, Stroke,
};

/// A 6 × 6 matrix by rows.
type Matrix6 = [[f64; 6]; 6];

const AXES: [Axis; 6] = [Axis::U1, Axis::U2, Axis::U3, Axis::R1, Axis::R2, Axis::R3];

/// Coupled linear stiffness and damping.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct LinearLink {
    /// 6 × 6 matrix in local axes, by rows
    #[parameter("K", form = Matrix { size: 6, dimension: Dimension { mass: 1.0, length: 0.0, time: -2.0 }, symmetric: false })]
    pub stiffness: Option<Matrix6>,
    /// 6 × 6 matrix in local axes, by rows
    #[parameter("C", form = Matrix { size: 6, dimension: Dimension { mass: 1.0, length: 0.0, time: -1.0 }, symmetric: false })]
    pub damping: Option<Matrix6>,
}

impl Described for LinearLink {
    const CARD: Card = Card::new(
        "LinearLink",
        Category::Link,
        "Coupled stiffness and damping that may be unsymmetric, as of seals and bearings.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = K d + C ḋ")
    .source("Childs, Turbomachinery Rotordynamics, 1993")
    .example(r#""seal": LinearLink(nodes: ("a", "b"), stiffness: [[0, 0, 0, 0, 0, 0], [0, 2e6, 8e5, 0, 0, 0], [0, -8e5, 2e6, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]])"#)
    .exercise(Exercise::new(1.0, &[
            Stroke::about(0.0, 1e-3),
            Stroke::about(0.0, 1e-3).with_phase(0.25),
        ]));

    fn check(&self) -> Result<(), ParameterError> {
        if self.used().1 == 0 {
            let message = "give `stiffness`, `damping` or both, with at least one entry";
            return Err(ParameterError::inconsistent("stiffness", message));
        }
        Ok(())
    }
}

impl LinearLink {
    /// Directions with an entry in their row or column, and how many.
    fn used(&self) -> ([usize; 6], usize) {
        let (mut list, mut n) = ([0; 6], 0);
        for i in 0..6 {
            let touched = |a: &Matrix6| (0..6).any(|j| a[i][j] != 0.0 || a[j][i] != 0.0);
            if [&self.stiffness, &self.damping].into_iter().flatten().any(touched) {
                list[n] = i;
                n += 1;
            }
        }
        (list, n)
    }
}

/// Numbers of both matrices, at most.
const NUMBERS: usize = 2 * 6 * 6;

impl LinearLink {
    /// K and C over the used directions, by rows, one behind the other; and how many directions these are.
    fn numbers(&self) -> ([f64; NUMBERS], usize) {
        let (used, n) = self.used();
        let mut numbers = [0.0; NUMBERS];
        for (a, to) in
            [&self.stiffness, &self.damping].iter().zip(numbers.chunks_mut((n * n).max(1)))
        {
            let Some(a) = a else { continue };
            for (i, x) in to.iter_mut().enumerate() {
                *x = a[used[i / n]][used[i % n]];
            }
        }
        (numbers, n)
    }
}

/// The answer of `n` directions.
#[inline(always)]
fn answer<R: Real>(n: usize, at: &LaneAt<'_, R>, out: &mut LaneForce<'_, R>) -> LaneStep<R> {
    let (k, c) = at.parameters.split_at(n * n);
    let (zero, half) = (at.dt.of(0.0), at.dt.of(0.5));
    for i in 0..n {
        let mut f = zero;
        for j in 0..n {
            f = k[i * n + j].mul_add(at.d[j], f);
        }
        for j in 0..n {
            f = c[i * n + j].mul_add(at.v[j], f);
        }
        out.f[i] = f;
    }
    out.k.copy_from_slice(k);
    out.c.copy_from_slice(c);
    let (crossed, own) = (
        bilinear(zero, n, c, at.v0, at.v) + bilinear(zero, n, c, at.v, at.v0),
        bilinear(zero, n, c, at.v0, at.v0) + bilinear(zero, n, c, at.v, at.v),
    );
    LaneStep {
        stored: half * bilinear(zero, n, k, at.d, at.d),
        // ∫ ḋᵀ S d dt on a straight path from d₀ to d, S = (K − Kᵀ)/2.
        hysteretic: half * (bilinear(zero, n, k, at.d, at.d0) - bilinear(zero, n, k, at.d0, at.d)),
        viscous: at.dt * (own + own + crossed) / at.dt.of(6.0),
    }
}

/// Σ xᵢ aᵢⱼ yⱼ.
#[inline(always)]
fn bilinear<R: Real>(zero: R, n: usize, a: &[R], x: &[R], y: &[R]) -> R {
    let mut sum = zero;
    for i in 0..n {
        for j in 0..n {
            sum = (x[i] * a[i * n + j]).mul_add(y[j], sum);
        }
    }
    sum
}

/// The law over lanes, of links of few directions.
struct LinearLaw<const N: usize>;

impl<const N: usize> LaneLaw for LinearLaw<N> {
    const COORDINATES: usize = N;
    const HISTORY: usize = 0;
    const PARAMETERS: usize = 2 * N * N;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        _: &mut [R],
    ) -> LaneStep<R> {
        answer(N, at, out)
    }
}

/// The symmetric part without its negative eigenvalues, by rows. Directions are first scaled to equal
/// size, so that units have no say.
fn semi_definite(a: &Matrix6, used: &[usize]) -> DMatrix<f64> {
    let n = used.len();
    let s = DMatrix::from_fn(n, n, |p, q| 0.5 * (a[used[p]][used[q]] + a[used[q]][used[p]]));
    // A direction without stiffness of its own is measured by its couplings.
    let size = |p: usize| {
        let own = s[(p, p)].abs();
        let coupled =
            (0..n).filter(|q| s[(*q, *q)] != 0.0).map(|q| s[(p, q)].powi(2) / s[(q, q)].abs());
        if own > 0.0 { own } else { coupled.fold(0.0, f64::max) }
    };
    let scale: Vec<f64> = (0..n).map(|p| size(p).sqrt()).collect();
    let inverse = |p: usize| if scale[p] > 0.0 { 1.0 / scale[p] } else { 0.0 };
    let scaled = DMatrix::from_fn(n, n, |p, q| inverse(p) * s[(p, q)] * inverse(q));
    let eigen = scaled.symmetric_eigen();
    let largest = eigen.eigenvalues.amax();
    let mut out = DMatrix::zeros(n, n);
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > 1e-12 * largest {
            out += *value * vector * vector.transpose();
        }
    }
    // Where nothing of a direction is left but rounding, nothing is left.
    let gone: Vec<bool> = (0..n).map(|p| out[(p, p)] < 1e-12 * largest).collect();
    DMatrix::from_fn(n, n, |p, q| {
        let both = 0.5 * (out[(p, q)] + out[(q, p)]);
        if gone[p] || gone[q] { 0.0 } else { scale[p] * both * scale[q] }
    })
}

impl Link for LinearLink {
    fn coordinates(&self) -> Coordinates {
        let (used, n) = self.used();
        Coordinates::Local(used[..n].iter().map(|i| AXES[*i]).collect())
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let (used, n) = self.used();
        if let Some(a) = &self.stiffness {
            let clipped = semi_definite(a, &used[..n]);
            k.iter_mut().enumerate().for_each(|(i, k)| *k = clipped[(i / n, i % n)]);
        }
    }

    fn respond(&self, at: &Kinematics<'_>, _: &[f64], _: &mut [f64], out: &mut Response<'_>) {
        let (numbers, n) = self.numbers();
        let asked = LaneAt::new(at, &[], &numbers[..2 * n * n]);
        let mut force = LaneForce { f: out.f, k: out.k, c: out.c };
        *out.energy = answer(n, &asked, &mut force).into();
    }

    fn lanes(&self, _: &[bool]) -> Option<LaneForm> {
        let (numbers, n) = self.numbers();
        let of = match n {
            1 => LaneForm::of::<LinearLaw<1>>,
            2 => LaneForm::of::<LinearLaw<2>>,
            3 => LaneForm::of::<LinearLaw<3>>,
            _ => return None,
        };
        Some(of((0..n).collect(), numbers[..2 * n * n].to_vec()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::read;
    use approx::assert_relative_eq;
    use trilith_element::conformance::Kit;
    use trilith_element::{Driver, Value};

    fn rows(a: &Matrix6) -> Value {
        let row = |r: &[f64; 6]| Value::List(r.iter().map(|x| Value::Number(*x)).collect());
        Value::List(a.iter().map(row).collect())
    }

    fn law(k: Option<Matrix6>, c: Option<Matrix6>) -> LinearLink {
        let given = [("stiffness", k), ("damping", c)];
        let given: Vec<_> =
            given.iter().filter_map(|(n, a)| a.as_ref().map(|a| (*n, rows(a)))).collect();
        read(&given).unwrap()
    }

    /// Direct and cross-coupled terms of U2 and U3.
    fn seal(direct: f64, cross: f64) -> Matrix6 {
        let mut a = [[0.0; 6]; 6];
        (a[1][1], a[2][2], a[1][2], a[2][1]) = (direct, direct, cross, -cross);
        a
    }

    #[test]
    fn conforms_symmetric_unsymmetric_and_indefinite() {
        let (bearing, damping) = (seal(2e6, 8e5), seal(3e3, 1e2));
        Kit::new(&[1e-3; 2], 20.0).assert(&law(Some(seal(2e6, 0.0)), Some(damping)));
        Kit::new(&[1e-3; 2], 20.0).assert(&law(None, Some(damping)));
        Kit::new(&[1e-3; 2], 20.0).active().rate_independent().assert(&law(Some(bearing), None));
        Kit::new(&[1e-3; 2], 20.0).active().assert(&law(Some(bearing), Some(damping)));
        Kit::new(&[1e-3; 2], 20.0)
            .active()
            .assert(&law(Some(seal(-1e6, 8e5)), Some(seal(-1e3, 0.0))));
        let full: Matrix6 = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let arm = |n: usize| if n > 2 { 0.1 } else { 1.0 };
                let value = ((7 * i + 3 * j) % 11) as f64 - 4.0;
                1e6 * value * arm(i) * arm(j)
            })
        });
        let scale = [1e-3, 1e-3, 1e-3, 1e-2, 1e-2, 1e-2];
        Kit::new(&scale, 5.0)
            .active()
            .assert(&law(Some(full), Some(full.map(|r| r.map(|x| 1e-3 * x)))));
    }

    #[test]
    fn a_passive_kit_refuses_a_seal_with_cross_coupling() {
        let law = law(Some(seal(2e6, 8e5)), None);
        assert!(Kit::new(&[1e-3; 2], 20.0).check(&law).is_err());
    }

    #[test]
    fn only_directions_with_an_entry_are_used() {
        assert_eq!(
            law(Some(seal(1.0, 0.0)), None).coordinates(),
            Coordinates::Local(vec![Axis::U2, Axis::U3])
        );
        let mut one = [[0.0; 6]; 6];
        one[3][0] = 1.0;
        assert_eq!(
            law(None, Some(one)).coordinates(),
            Coordinates::Local(vec![Axis::U1, Axis::R1])
        );
    }

    /// A circle of radius r against the sense of the coupling costs 2π r² times the skew term.
    #[test]
    fn a_circle_takes_the_circulatory_work_and_gives_it_backward() {
        let (cross, r) = (8e5, 1e-3);
        let law = law(Some(seal(2e6, cross)), None);
        for sense in [1.0, -1.0] {
            let n = 4000;
            let at = |i: i32| {
                let a = std::f64::consts::TAU * f64::from(i) / f64::from(n);
                [r * a.cos(), r * sense * a.sin()]
            };
            let mut driver = Driver::starting_at(&law, &at(0), &[0.0; 2]);
            for i in 1..=n {
                driver.step(&at(i), &[0.0; 2], 1e-3);
            }
            // f₂ = cross d₃, f₃ = −cross d₂: work −2π r² cross for the positive sense.
            let exact = -sense * std::f64::consts::TAU * r * r * cross;
            assert_relative_eq!(driver.energy.hysteretic, exact, max_relative = 1e-5);
        }
    }

    #[test]
    fn the_dummy_of_an_indefinite_matrix_is_its_positive_part() {
        // Eigenvalues 3 and −1 with vectors (1, 1) and (1, −1): what is left is 1.5 everywhere.
        let mut a = [[0.0; 6]; 6];
        (a[0][0], a[1][1], a[0][1], a[1][0]) = (1.0, 1.0, 2.5, 1.5);
        let mut k = [0.0; 4];
        law(Some(a), None).engaged_stiffness(&mut k);
        k.iter().for_each(|x| assert_relative_eq!(*x, 1.5, max_relative = 1e-12));
    }

    #[test]
    fn refuses_matrices_without_an_entry() {
        // Made by hand it is no link, and answers nothing.
        let none = LinearLink { stiffness: None, damping: None };
        assert_eq!((none.coordinates().len(), Driver::new(&none).f.len()), (0, 0));
        assert!(none.lanes(&[]).is_none());
        assert!(read::<LinearLink>(&[]).is_err());
        assert!(read::<LinearLink>(&[("stiffness", rows(&[[0.0; 6]; 6]))]).is_err());
    }
}
