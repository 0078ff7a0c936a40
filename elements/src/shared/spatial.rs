//! Vectors, matrices and finite rotations in space, of one analysis or of several side by side.

use trilith_element::lanes::Real;

/// A vector.
pub(crate) type V3<R> = [R; 3];
/// A matrix, row by row.
pub(crate) type M3<R> = [[R; 3]; 3];

/// `a + b`.
#[inline(always)]
pub(crate) fn sum<R: Real>(a: &V3<R>, b: &V3<R>) -> V3<R> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a × b`.
#[inline(always)]
pub(crate) fn cross<R: Real>(a: &V3<R>, b: &V3<R>) -> V3<R> {
    [minor(a, b, 1, 2), minor(a, b, 2, 0), minor(a, b, 0, 1)]
}

/// `aᵢ bⱼ − aⱼ bᵢ`.
#[inline(always)]
fn minor<R: Real>(a: &V3<R>, b: &V3<R>, i: usize, j: usize) -> R {
    a[i].mul_add(b[j], -(a[j] * b[i]))
}

/// `[a]×`, with `[a]× b = a × b`.
#[inline(always)]
pub(crate) fn cross_matrix<R: Real>(a: &V3<R>) -> M3<R> {
    let zero = a[0].of(0.0);
    [[zero, -a[2], a[1]], [a[2], zero, -a[0]], [-a[1], a[0], zero]]
}

/// `M x`.
#[inline(always)]
pub(crate) fn times<R: Real>(m: &M3<R>, x: &V3<R>) -> V3<R> {
    let mut y = *x;
    for i in 0..3 {
        y[i] = m[i][2].mul_add(x[2], m[i][1].mul_add(x[1], m[i][0] * x[0]));
    }
    y
}

/// `Mᵀ x`.
#[inline(always)]
pub(crate) fn transposed_times<R: Real>(m: &M3<R>, x: &V3<R>) -> V3<R> {
    times(&transposed(m), x)
}

/// `Mᵀ`.
#[inline(always)]
pub(crate) fn transposed<R: Real>(m: &M3<R>) -> M3<R> {
    let mut t = *m;
    for i in 0..3 {
        for j in 0..3 {
            t[i][j] = m[j][i];
        }
    }
    t
}

/// `A B`.
#[inline(always)]
pub(crate) fn product<R: Real>(a: &M3<R>, b: &M3<R>) -> M3<R> {
    let mut c = *a;
    for i in 0..3 {
        for j in 0..3 {
            c[i][j] = a[i][2].mul_add(b[2][j], a[i][1].mul_add(b[1][j], a[i][0] * b[0][j]));
        }
    }
    c
}

/// Adds a matrix to a block of three columns and rows.
#[inline(always)]
pub(crate) fn add<R: Real, const N: usize>(
    to: &mut [[R; N]; N],
    (i, j): (usize, usize),
    m: &M3<R>,
) {
    for row in 0..3 {
        for column in 0..3 {
            let x = &mut to[i + row][j + column];
            *x = *x + m[row][column];
        }
    }
}

/// The angle of a vector in a plane from the first axis, 0 … π: `across` ≥ 0 is its other part. From the tangent of
/// an eighth of it, of which the series of the arc tangent needs few terms.
#[inline(always)]
pub(crate) fn angle<R: Real>(along: R, across: R) -> R {
    let (zero, one) = (along.of(0.0), along.of(1.0));
    let mut tangent = across / (along.hypot(across) + along.abs());
    for _ in 0..2 {
        tangent = tangent / (one + tangent.mul_add(tangent, one).sqrt());
    }
    let square = -(tangent * tangent);
    let mut sum = along.of(1.0 / 23.0);
    for k in (0..11).rev() {
        sum = sum.mul_add(square, along.of(1.0 / f64::from(2 * k + 1)));
    }
    let angle = along.of(8.0) * (tangent * sum);
    R::select(along.lt(zero), along.of(std::f64::consts::PI) - angle, angle)
}

/// A rotation that goes on from one that is known, R = R₀ exp(φ), and what small changes of φ do to it.
#[derive(Clone, Copy)]
pub(crate) struct Rotation<R> {
    /// R, from the axes of the body to global axes.
    pub matrix: M3<R>,
    /// R as quaternion (w, x, y, z).
    pub quaternion: [R; 4],
}

impl<R: Real> Rotation<R> {
    /// From the quaternion of R₀ by the rotation vector φ in the axes of the body.
    #[inline(always)]
    pub fn new(start: &[R; 4], by: &V3<R>) -> Self {
        let [w, x, y, z] = *start;
        let (half, one, two) = (w.of(0.5), w.of(1.0), w.of(2.0));
        let square = by[0].mul_add(by[0], by[1].mul_add(by[1], by[2] * by[2]));
        // exp(φ/2), of every angle that a number can hold: a stiff contact at rest feels less than 4e-16.
        let [cosine, share] = cosine_and_share(w.of(0.25) * square);
        let share = half * share;
        let [a, b, c] = [share * by[0], share * by[1], share * by[2]];
        let [w, x, y, z] = [
            w * cosine - (x * a + y * b + z * c),
            w * a + x * cosine + (y * c - z * b),
            w * b + y * cosine + (z * a - x * c),
            w * c + z * cosine + (x * b - y * a),
        ];
        let [xx, yy, zz] = [x * x, y * y, z * z];
        let [xy, yz, zx] = [two * x * y, two * y * z, two * z * x];
        let [wx, wy, wz] = [two * w * x, two * w * y, two * w * z];
        let matrix = [
            [one - two * (yy + zz), xy - wz, zx + wy],
            [xy + wz, one - two * (zz + xx), yz - wx],
            [zx - wy, yz + wx, one - two * (xx + yy)],
        ];
        Self { matrix, quaternion: [w, x, y, z] }
    }

    /// R r − r.
    #[inline(always)]
    pub fn shift(&self, r: &V3<R>) -> V3<R> {
        shift(&self.quaternion, r)
    }
}

/// R r − r, from the quaternion of R: a stiff contact would see the rounding of the difference.
#[inline(always)]
pub(crate) fn shift<R: Real>([w, x, y, z]: &[R; 4], r: &V3<R>) -> V3<R> {
    let (axis, two) = ([*x, *y, *z], w.of(2.0));
    let across = cross(&axis, r);
    let twice = cross(&axis, &across);
    let mut d = *r;
    for i in 0..3 {
        d[i] = two * w.mul_add(across[i], twice[i]);
    }
    d
}

/// The right Jacobian Jᵣ(φ), δR = R \[Jᵣ δφ\]×: I − (1 − cos φ)/φ² \[φ\]× + (φ − sin φ)/φ³ \[φ\]×².
#[inline(always)]
pub(crate) fn right_jacobian<R: Real>(by: &V3<R>) -> M3<R> {
    let square = by[0].mul_add(by[0], by[1].mul_add(by[1], by[2] * by[2]));
    let (first, second) = (of_cosine(square), of_sine(square));
    let cross = cross_matrix(by);
    let twice = product(&cross, &cross);
    let mut j = cross;
    for i in 0..3 {
        for k in 0..3 {
            let own = first.of(f64::from(u8::from(i == k)));
            j[i][k] = second.mul_add(twice[i][k], (-first).mul_add(cross[i][k], own));
        }
    }
    j
}

/// Below this square of an angle the series have all digits.
const SMALL: f64 = 0.04;

/// A polynomial where x is small, and elsewhere what a function makes of x.
#[inline(always)]
fn series<R: Real, const N: usize>(x: R, terms: [f64; N], beyond: impl Fn(f64) -> f64) -> R {
    let mut sum = x.of(terms[N - 1]);
    for term in terms.iter().rev().skip(1) {
        sum = sum.mul_add(x, x.of(*term));
    }
    let small = x.lt(x.of(SMALL));
    if x.any(!small) { R::select(small, sum, x.map(beyond)) } else { sum }
}

/// cos a and sin(a)/a by a².
#[inline(always)]
fn cosine_and_share<R: Real>(x: R) -> [R; 2] {
    const COSINE: [f64; 8] = [
        1.0,
        -1.0 / 2.0,
        1.0 / 24.0,
        -1.0 / 720.0,
        1.0 / 40_320.0,
        -1.0 / 3_628_800.0,
        1.0 / 479_001_600.0,
        -1.0 / 87_178_291_200.0,
    ];
    const SHARE: [f64; 7] = [
        1.0,
        -1.0 / 6.0,
        1.0 / 120.0,
        -1.0 / 5040.0,
        1.0 / 362_880.0,
        -1.0 / 39_916_800.0,
        1.0 / 6_227_020_800.0,
    ];
    let share = |x: f64| x.sqrt().sin() / x.sqrt();
    [series(x, COSINE, |x| x.sqrt().cos()), series(x, SHARE, share)]
}

/// (1 − cos φ)/φ² by φ².
#[inline(always)]
fn of_cosine<R: Real>(x: R) -> R {
    const TERMS: [f64; 7] = [
        1.0 / 2.0,
        -1.0 / 24.0,
        1.0 / 720.0,
        -1.0 / 40_320.0,
        1.0 / 3_628_800.0,
        -1.0 / 479_001_600.0,
        1.0 / 87_178_291_200.0,
    ];
    series(x, TERMS, |x| (1.0 - x.sqrt().cos()) / x)
}

/// (φ − sin φ)/φ³ by φ².
#[inline(always)]
fn of_sine<R: Real>(x: R) -> R {
    const TERMS: [f64; 7] = [
        1.0 / 6.0,
        -1.0 / 120.0,
        1.0 / 5040.0,
        -1.0 / 362_880.0,
        1.0 / 39_916_800.0,
        -1.0 / 6_227_020_800.0,
        1.0 / 1_307_674_368_000.0,
    ];
    series(x, TERMS, |x| (x.sqrt() - x.sqrt().sin()) / (x * x.sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_is_that_of_the_library() {
        for i in 0..=2000 {
            let a = f64::from(i) * std::f64::consts::PI / 2000.0;
            for size in [1.0, 1e-170, 1e170] {
                let (along, across) = (size * a.cos(), size * a.sin());
                let (ours, theirs) = (angle(along, across), across.atan2(along));
                assert!(
                    (ours - theirs).abs() <= 8.0 * f64::EPSILON * theirs,
                    "{a}: {ours} {theirs}"
                );
            }
        }
        for small in [1e-300, 1e-16, 1e-8] {
            assert_eq!(angle(1.0, small), small);
        }
    }
}
