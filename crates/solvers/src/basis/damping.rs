//! Modal damping of the structure alone, in its modes and beyond those of a basis.
//!
//! ```text
//!   C = M Φ diag(2 ζ ω − b ω²) Φᵀ M + b K        ΦᵀCΦ = diag(2 ζ ω)        b = min 2 ζ/ω
//! ```
//!
//! K is the stiffness of the structure without effective stiffnesses. Motion that the modes of the basis do not hold is damped
//! in proportion to its stiffness, with ratios b ω/2 that go on from the fastest mode's, so that nothing
//! rings undamped in direct integration; b is as large as it may be without taking damping from a mode. In the
//! modes themselves the two terms in b cancel. On a basis there is no b: static shapes of massless DOFs are no
//! modes and ring in no way, and what damped them by b would change with the number of vectors. A basis that
//! holds all modes there are leaves nothing beyond: b = 0.
//!
//! Reference: \[Chopra 2012, sec. 11.4\], \[Chopra & McKenna 2016\].

use super::Bases;
use trilith_linalg::Dense;
use trilith_model::{Damping, Model};
use trilith_system::System;

/// What is left of a mode's damping below this share is rounding.
const ROUNDING: f64 = 1e-12;

/// Ratio of modal damping at a circular frequency.
fn damping_ratio(damping: &Damping, omega: f64) -> f64 {
    match damping {
        Damping::Modal { ratio } => *ratio,
        Damping::ModalTable { points } => {
            let f = omega / std::f64::consts::TAU;
            let after = points.iter().position(|(x, _)| *x >= f).unwrap_or(points.len());
            match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
                (Some((x0, y0)), Some((x1, y1))) => y0 + (y1 - y0) * (f - x0) / (x1 - x0),
                (Some((_, y)), None) | (None, Some(&(_, y))) => y,
                (None, None) => 0.0,
            }
        }
        _ => 0.0,
    }
}

/// Modal damping over the modes of a basis and beyond them.
#[derive(Clone, Debug)]
pub(crate) struct ModalDamping {
    /// M Φ of the modes that are damped.
    pub u: Dense,
    /// 2 ζ ω of each, 1/s.
    pub rate: Vec<f64>,
    /// ω² of each, 1/s².
    omega2: Vec<f64>,
    /// b: share of the stiffness that damps what is beyond the modes, s.
    pub beyond: f64,
}

impl ModalDamping {
    /// Adds the damping force of a velocity; `reduced` leaves out what is beyond the modes.
    pub(crate) fn push(&self, system: &System, reduced: bool, v: &[f64], force: &mut [f64]) {
        let Self { u, rate, omega2, beyond } = self;
        let beyond = if reduced { 0.0 } else { *beyond };
        let mut share = vec![0.0; rate.len()];
        u.transpose_mul_add(1.0, v, &mut share);
        for (x, (rate, w2)) in share.iter_mut().zip(rate.iter().zip(omega2)) {
            *x *= rate - beyond * w2;
        }
        u.mul_add(1.0, &share, force);
        system.stiffness.mul_add(beyond, v, force);
    }

    /// What is to be added to b K of the whole structure.
    pub(crate) fn less_beyond(self) -> LowRank {
        let Self { u, mut rate, omega2, beyond } = self;
        if beyond == 0.0 {
            return LowRank { u, rate };
        }
        let full = rate.clone();
        rate.iter_mut().zip(&omega2).for_each(|(r, w2)| *r -= beyond * w2);
        // The mode that b was taken from is damped by b K alone.
        let kept: Vec<usize> = (0..rate.len()).filter(|j| rate[*j] > ROUNDING * full[*j]).collect();
        let columns = kept.iter().flat_map(|j| u.column(*j).to_vec()).collect();
        let u = Dense::from_columns(u.rows(), kept.len(), columns);
        LowRank { u, rate: kept.iter().map(|j| rate[*j]).collect() }
    }
}

/// True where damping is stated for modes.
pub(crate) fn is_modal(damping: &Damping) -> bool {
    matches!(damping, Damping::Modal { .. } | Damping::ModalTable { .. })
}

/// The damping of the structure, where the model states modal damping.
pub(crate) fn modal_damping(model: &Model, system: &System, bases: &Bases) -> Option<ModalDamping> {
    let modes = &bases.structural;
    let rates: Vec<f64> = modes
        .omega2
        .iter()
        .map(|w2| {
            let omega = w2.max(0.0).sqrt();
            2.0 * damping_ratio(&model.damping, omega) * omega
        })
        .collect();
    let kept: Vec<usize> = (0..rates.len()).filter(|j| rates[*j] > 0.0).collect();
    if kept.is_empty() {
        return None;
    }
    let mut u = Dense::zeros(system.order(), kept.len());
    let damped = modes.shapes.each_heavy().zip(&rates).filter(|(_, rate)| **rate > 0.0);
    for (j, (heavy, _)) in damped.enumerate() {
        system.mass.mul_add(1.0, &heavy, u.column_mut(j));
    }
    let elastic = || (0..rates.len()).filter(|j| modes.omega2[*j] > 0.0);
    let beyond = if is_complete(system, rates.len()) {
        0.0
    } else {
        elastic().map(|j| rates[j] / modes.omega2[j]).fold(f64::INFINITY, f64::min)
    };
    let of = |values: &[f64]| kept.iter().map(|j| values[*j]).collect();
    Some(ModalDamping { u, rate: of(&rates), omega2: of(&modes.omega2), beyond })
}

/// True where so many modes are all that the structure has: as many as the rank of its mass.
fn is_complete(system: &System, modes: usize) -> bool {
    modes + system.massless.len() >= system.order()
}

/// C += U diag(rate) Uᵀ: modal damping with what it has beyond its modes taken out.
#[derive(Clone, Debug)]
pub(crate) struct LowRank {
    pub u: Dense,
    pub rate: Vec<f64>,
}

impl LowRank {
    /// `p += s · U diag(rate) Uᵀ v`.
    pub(crate) fn mul_add(&self, s: f64, v: &[f64], p: &mut [f64]) {
        let mut y = vec![0.0; self.rate.len()];
        self.u.transpose_mul_add(1.0, v, &mut y);
        y.iter_mut().zip(&self.rate).for_each(|(a, r)| *a *= r);
        self.u.mul_add(s, &y, p);
    }
}
