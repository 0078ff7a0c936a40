//! Two bodies in finite rotation: a law that knows a body on the ground asks about the second as the first sees it.
//!
//! ```text
//!   s = R₁ᵀ (X + u₂ − u₁),   R = R₁ᵀ R₂              where the second is, in the axes of the first; X: at rest
//!   ṡ = R₁ᵀ (u̇₂ − u̇₁) − Ω₁ × s,   Ω = Ω₂ − Rᵀ Ω₁
//!   law (s − X, R, ṡ, Ω) → f in the axes of the first, m in those of the second
//!   F₂ = R₁ f,   M₂ = m                              on the second
//!   F₁ = −R₁ f,  M₁ = −s × f − R m                   on the first
//! ```
//!
//! Forces are opposite and act at one place, so that momentum and moment of momentum of both bodies together stay what
//! they are: F₁ + F₂ = 0, and about any point their moments cancel.
//!
//! Reference: relative motion of rigid bodies, \[Goldstein, Classical Mechanics, ch. 4\].

use super::dual::{Dual, Dual3, cross, times, transposed_times};
use super::rotation::{Turn, Turned};
use super::wrench::Wrench;
use nalgebra::{SMatrix, Vector3};
use trilith_element::{Kinematics, Response};

/// Coordinates of two nodes.
const COUNT: usize = 12;
/// By the coordinates and their rates.
type Number = Dual<{ 2 * COUNT }>;

/// The second body as the first sees it.
pub(crate) struct View<const N: usize> {
    /// Displacement, and the turn φ from the start of the step on.
    d: [Dual<N>; 6],
    /// Velocity and spin.
    v: [Dual<N>; 6],
    /// Its rotation.
    pub turn: Turn,
    /// R₁, R and s.
    first: [Dual3<N>; 3],
    between: [Dual3<N>; 3],
    place: Dual3<N>,
}

impl<const N: usize> View<N> {
    /// Of nodes that are `offset` apart at rest. The turn counts from `start` on; none: from here.
    pub fn new(
        offset: Vector3<f64>,
        [first, second]: [&Turn; 2],
        d: &[f64],
        v: &[f64],
        start: Option<&Turn>,
    ) -> Self {
        let (turn, by) = Turn::between(first, second, start);
        let [r1, r2] = [first.dual::<N>(3), second.dual::<N>(9)];
        let minus = |a: Dual3<N>, b: Dual3<N>| [0, 1, 2].map(|i| a[i] - b[i]);
        let apart = minus(Dual::variables(&d[6..9], 6), Dual::variables(&d[..3], 0));
        let speed = minus(Dual::variables(&v[6..9], COUNT + 6), Dual::variables(&v[..3], COUNT));
        let spin1: Dual3<N> = Dual::variables(&v[3..6], COUNT + 3);
        let spin2: Dual3<N> = Dual::variables(&v[9..12], COUNT + 9);

        let at_rest = [0, 1, 2].map(|i| Dual::constant(offset[i]));
        let back = first.shift_back(offset);
        let turned = transposed_times(&r1, &at_rest);
        let moved = transposed_times(&r1, &apart);
        let shift: Dual3<N> = [0, 1, 2].map(|i| moved[i] + turned[i].map(back[i], 1.0));
        let place = [0, 1, 2].map(|i| shift[i] + offset[i]);
        let columns: [Dual3<N>; 3] =
            [0, 1, 2].map(|j| transposed_times(&r1, &[r2[0][j], r2[1][j], r2[2][j]]));
        let between = [0, 1, 2].map(|i| [0, 1, 2].map(|j| columns[j][i]));
        let rate = minus(transposed_times(&r1, &speed), cross(&spin1, &place));
        let spin = minus(spin2, transposed_times(&between, &spin1));

        // ψ₂ − Rᵀ ψ₁ in the axes of the second, then φ.
        let mut turns = [0, 1, 2].map(|i| Dual::constant(by[i]));
        if N > 0 {
            let inverse = turn.jacobian.try_inverse().unwrap_or_else(nalgebra::Matrix3::identity);
            let by_first = -inverse * turn.matrix.transpose() * first.jacobian;
            let by_second = inverse * second.jacobian;
            for (i, x) in turns.iter_mut().enumerate() {
                for j in 0..3 {
                    x.by[3 + j] = by_first[(i, j)];
                    x.by[9 + j] = by_second[(i, j)];
                }
            }
        }
        let six = |a: Dual3<N>, b: Dual3<N>| [a[0], a[1], a[2], b[0], b[1], b[2]];
        Self { d: six(shift, turns), v: six(rate, spin), turn, first: r1, between, place }
    }

    /// Displacement and turn, velocity and spin.
    pub fn values(&self) -> [[f64; 6]; 2] {
        [self.d.map(|x| x.x), self.v.map(|x| x.x)]
    }
}

/// How two nodes turn in a step.
pub(crate) struct Turns {
    /// At its start and at its end, of the first and of the second.
    pub start: [Turn; 2],
    pub end: [Turn; 2],
}

impl Turns {
    /// By how they had turned at the start.
    pub fn new(was: &[Turned; 2], at: &Kinematics<'_>) -> Self {
        let both = |d: &[f64]| [was[0].turn(&d[3..6]), was[1].turn(&d[9..12])];
        Self { start: both(at.d0), end: both(at.d) }
    }
}

/// The answer for two nodes of a law of one.
pub(crate) fn respond(
    offset: Vector3<f64>,
    turns: &Turns,
    at: &Kinematics<'_>,
    law: impl FnOnce(&Kinematics<'_>, (&Turn, &Turn)) -> Wrench,
    out: &mut Response<'_>,
) {
    let before = View::<0>::new(offset, turns.start.each_ref(), at.d0, at.v0, None);
    let now =
        View::<{ 2 * COUNT }>::new(offset, turns.end.each_ref(), at.d, at.v, Some(&before.turn));
    let ([d0, v0], [d, v]) = (before.values(), now.values());
    let seen = Kinematics::new([&d, &v], [&d0, &v0], at.dt);
    let wrench = law(&seen, (&before.turn, &now.turn));

    let answer = |i: usize| {
        let mut sum = Number::constant(wrench.f[i]);
        for j in 0..6 {
            let (k, c) = (wrench.k[(i, j)], wrench.c[(i, j)]);
            for (x, (by_d, by_v)) in sum.by.iter_mut().zip(now.d[j].by.iter().zip(&now.v[j].by)) {
                *x += k * by_d + c * by_v;
            }
        }
        sum
    };
    let (f, m) = ([0, 1, 2].map(answer), [3, 4, 5].map(answer));
    let force = times(&now.first, &f);
    let (lever, turned) = (cross(&now.place, &f), times(&now.between, &m));
    for i in 0..3 {
        let rows = [-force[i], -(lever[i] + turned[i]), force[i], m[i]];
        for (part, x) in rows.iter().enumerate() {
            let row = 3 * part + i;
            out.f[row] = x.x;
            out.k[COUNT * row..COUNT * (row + 1)].copy_from_slice(&x.by[..COUNT]);
            out.c[COUNT * row..COUNT * (row + 1)].copy_from_slice(&x.by[COUNT..]);
        }
    }
    *out.energy = wrench.energy;
}

/// The stiffness of two nodes at rest from that of the second on a first that does not move: every motion of the first
/// moves the second against it as a rigid lever would.
pub(crate) fn stiffness(offset: Vector3<f64>, k: &SMatrix<f64, 6, 6>, out: &mut [f64]) {
    let mut map = SMatrix::<f64, 6, COUNT>::zeros();
    map.fixed_view_mut::<6, 6>(0, 6).fill_with_identity();
    map.fixed_view_mut::<6, 6>(0, 0).fill_diagonal(-1.0);
    map.fixed_view_mut::<3, 3>(0, 3).copy_from(&offset.cross_matrix());
    let all = map.transpose() * k * map;
    for i in 0..COUNT {
        for j in 0..COUNT {
            out[COUNT * i + j] = 0.5 * (all[(i, j)] + all[(j, i)]);
        }
    }
}
