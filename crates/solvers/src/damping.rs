//! Modal damping of the structure alone: C = M Φ diag(2 ζ ω) Φᵀ M over the modes of a basis.

use crate::basis::Bases;
use crate::space::LowRank;
use trilith_linalg::Dense;
use trilith_model::{Damping, Model};
use trilith_system::System;

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

/// The low-rank damping matrix, where the model states modal damping.
pub(crate) fn modal_damping(model: &Model, system: &System, bases: &Bases) -> Option<LowRank> {
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
    for (new, old) in kept.iter().enumerate() {
        system.mass.mul_add(1.0, &modes.shapes.heavy(*old), u.column_mut(new));
    }
    Some(LowRank { u, rate: kept.iter().map(|j| rates[*j]).collect() })
}
