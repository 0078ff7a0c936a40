//! Points of a body: how they move with its node, and what forces on them do to it.

use super::spatial::{
    self, M3, Rotation, V3, cross, cross_matrix, product, sum, times, transposed, transposed_times,
};
use trilith_element::lanes::Real;

/// How a point at `r` moves with the node, in global axes.
pub(crate) struct Lever<R> {
    pub r: V3<R>,
    /// Displacement and velocity of the point.
    pub way: V3<R>,
    pub rate: V3<R>,
    /// ∂v/∂Ω = −R \[r\]×; its transpose carries a force to a moment.
    arm: M3<R>,
}

impl<R: Real> Lever<R> {
    /// By displacement and velocity, turn and spin of the node.
    #[inline(always)]
    pub fn new(r: &V3<R>, turn: &Rotation<R>, [d, v, spin]: [&V3<R>; 3]) -> Self {
        let arm = product(&turn.matrix, &cross_matrix(&[-r[0], -r[1], -r[2]]));
        let (way, rate) = (sum(d, &turn.shift(r)), sum(v, &times(&arm, spin)));
        Self { r: *r, way, rate, arm }
    }
}

/// What points do to the node that they belong to, in global axes and those of the body. The tangents by its turn are
/// those by a rotation Jᵣ δφ until [`finish`](Self::finish).
pub(crate) struct Carried<R> {
    pub f: [R; 6],
    pub k: [[R; 6]; 6],
    pub c: [[R; 6]; 6],
}

impl<R: Real> Carried<R> {
    /// Nothing yet.
    #[inline(always)]
    pub fn nothing(zero: R) -> Self {
        Self { f: [zero; 6], k: [[zero; 6]; 6], c: [[zero; 6]; 6] }
    }

    /// Adds a force on a point of a node that turns with a spin, and its tangents by way and rate of the point.
    #[inline(always)]
    pub fn add(
        &mut self,
        (turn, spin): (&Rotation<R>, &V3<R>),
        lever: &Lever<R>,
        (f, k, c): (&V3<R>, &M3<R>, &M3<R>),
    ) {
        let (r, arm, down) = (&lever.r, &lever.arm, transposed(&lever.arm));
        let moment = times(&down, f);
        for i in 0..3 {
            self.f[i] = self.f[i] + f[i];
            self.f[3 + i] = self.f[3 + i] + moment[i];
        }
        // ∂v/∂φ, and the force that turns against the body's axes.
        let swing = cross(r, spin);
        let speed = product(&turn.matrix, &cross_matrix(&swing));
        let own = transposed_times(&turn.matrix, f);
        let turning = product(&cross_matrix(r), &cross_matrix(&own));
        let mut by_turn = product(k, arm);
        let damped = product(c, &speed);
        for i in 0..3 {
            by_turn[i] = sum(&by_turn[i], &damped[i]);
        }
        let by_spin = product(c, arm);
        spatial::add(&mut self.k, (0, 0), k);
        spatial::add(&mut self.k, (0, 3), &by_turn);
        spatial::add(&mut self.k, (3, 0), &product(&down, k));
        spatial::add(&mut self.k, (3, 3), &product(&down, &by_turn));
        spatial::add(&mut self.k, (3, 3), &turning);
        spatial::add(&mut self.c, (0, 0), c);
        spatial::add(&mut self.c, (0, 3), &by_spin);
        spatial::add(&mut self.c, (3, 0), &product(&down, c));
        spatial::add(&mut self.c, (3, 3), &product(&down, &by_spin));
    }

    /// Tangents by φ.
    #[inline(always)]
    pub fn finish(&mut self, jacobian: &M3<R>) {
        let back = transposed(jacobian);
        for row in &mut self.k {
            let by = times(&back, &[row[3], row[4], row[5]]);
            row[3..].copy_from_slice(&by);
        }
    }
}
