//! The body in pictures.

use super::RockingBody;
use std::f64::consts::TAU;
use trilith_element::Outline;

/// Corners of a circle.
const CORNERS: usize = 32;

/// The body upright, from its centre of gravity. A circular base belongs to a cylinder and base points to
/// a prism, both as high above the centre of gravity as below; base points above it are corners themselves.
pub(super) fn upright(body: &RockingBody) -> Outline {
    if let (Some(radius), Some(depth)) = (body.rim_radius, body.rim_depth) {
        let corner = |i| {
            let (sin, cos) = (TAU * i as f64 / CORNERS as f64).sin_cos();
            [radius * cos, radius * sin]
        };
        let circle: Vec<_> = (0..CORNERS).map(corner).collect();
        return Outline::prism(&circle, -depth, depth);
    }
    let lowest = body.lowest();
    let highest = body.base.iter().map(|r| r[2]).fold(-lowest, f64::max);
    if body.is_plane() {
        let axis = usize::from(body.base.iter().all(|r| r[0].abs() <= r[1].abs()));
        let mut corners = body.base.clone();
        if body.base.iter().all(|r| r[2] <= 0.0) {
            corners.extend(body.base.iter().map(|r| [r[0], r[1], -r[2]]));
        }
        // Around the centre of gravity, which is inside.
        corners.sort_by(|p, q| p[2].atan2(p[axis]).total_cmp(&q[2].atan2(q[axis])));
        return Outline::face(corners);
    }
    let size = highest - lowest;
    let feet = body.base.iter().filter(|r| r[2] - lowest <= 1e-6 * size);
    let mut base: Vec<[f64; 2]> = feet.map(|r| [r[0], r[1]]).collect();
    base.sort_by(|p, q| p[1].atan2(p[0]).total_cmp(&q[1].atan2(q[0])));
    Outline::prism(&base, lowest, highest)
}
