//! The links of a lane on all its modes, and which rule these go by.

use super::setup::LaneSetup;
use crate::modal::{FREE, LONGEST};
use crate::single_mode::{self, Mode};

/// Modes that hang on links too stiff for the exact rule go by average acceleration in a step of this length, s: as on
/// the ordinary engine, where that is decided anew in every step.
pub(super) fn average_where_held(modes: &mut [Mode], setup: &LaneSetup, length: f64) {
    if stiffness_ratio(&setup.rows, modes, &setup.engaged) <= LONGEST {
        return;
    }
    for (j, mode) in modes.iter_mut().enumerate() {
        let links = setup.rows.iter().zip(&setup.engaged);
        let held: f64 = links.map(|(row, k)| k * row[j] * row[j]).sum();
        if held * length * length / 6.0 > FREE {
            *mode = single_mode::average(setup.omega2[j], setup.damping[j], length);
        }
    }
}

/// Spectral radius of G k: the exact rule is stable below 2.
pub(super) fn stiffness_ratio(rows: &[Vec<f64>], modes: &[Mode], engaged: &[f64]) -> f64 {
    let mut x = vec![1.0; rows.len()];
    let mut ratio = 0.0;
    for _ in 0..50 {
        let mut s = vec![0.0; modes.len()];
        for (row, (x, k)) in rows.iter().zip(x.iter().zip(engaged)) {
            for (s, b) in s.iter_mut().zip(row) {
                *s += b * x * k;
            }
        }
        for (s, c) in s.iter_mut().zip(modes) {
            *s *= c[1][3];
        }
        let y: Vec<f64> =
            rows.iter().map(|row| row.iter().zip(&s).map(|(b, s)| b * s).sum()).collect();
        let size = y.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        if size == 0.0 || !size.is_finite() {
            return size;
        }
        let settled = (size - ratio).abs() <= 1e-3 * size;
        ratio = size;
        x = y.into_iter().map(|v| v / size).collect();
        if settled {
            break;
        }
    }
    ratio
}
