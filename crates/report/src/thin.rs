//! Leaves out points of a line that nobody would see.

/// Keeps the points that a line needs to stay within `tolerance` (in the unit of the points) of the
/// original: Ramer 1972, Douglas and Peucker 1973. Works for loops too.
pub(crate) fn thinned(points: &[(f64, f64)], tolerance: f64) -> Vec<(f64, f64)> {
    kept(points, tolerance).into_iter().map(|i| points[i]).collect()
}

/// The same as indices.
pub(crate) fn kept(points: &[(f64, f64)], tolerance: f64) -> Vec<usize> {
    if points.len() < 3 {
        return (0..points.len()).collect();
    }
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[points.len() - 1] = true;
    let mut spans = vec![(0, points.len() - 1)];
    let tolerance = tolerance * tolerance;
    while let Some((a, b)) = spans.pop() {
        let (far, most) = farthest(points, a, b);
        if most > tolerance {
            keep[far] = true;
            spans.extend([(a, far), (far, b)]);
        }
    }
    (0..points.len()).filter(|i| keep[*i]).collect()
}

/// The point between two that is farthest from the segment s between them, and the square of its distance:
///
/// ```text
///   beside s:  (p × s)²/s²        before it:  p²        behind it:  (p − s)²          all times s², without roots
/// ```
///
/// Millions of points are looked at; written out, as this crate is compiled quickly.
fn farthest(points: &[(f64, f64)], a: usize, b: usize) -> (usize, f64) {
    let (start, end) = (points[a], points[b]);
    let (dx, dy) = (end.0 - start.0, end.1 - start.1);
    let length = dx * dx + dy * dy;
    let is_point = length <= 0.0;
    let scale = if is_point { 1.0 } else { length };
    let (mut far, mut most) = (a, 0.0);
    let mut i = a + 1;
    while i < b {
        let (x, y) = (points[i].0 - start.0, points[i].1 - start.1);
        let along = x * dx + y * dy;
        let distance = if is_point || along < 0.0 {
            (x * x + y * y) * scale
        } else if along > length {
            let (x, y) = (x - dx, y - dy);
            (x * x + y * y) * scale
        } else {
            let across = x * dy - y * dx;
            across * across
        };
        if distance > most {
            (far, most) = (i, distance);
        }
        i += 1;
    }
    (far, most / scale)
}

#[cfg(test)]
mod tests {
    use super::{farthest, thinned};

    #[test]
    fn a_straight_line_keeps_its_ends() {
        let line: Vec<_> = (0..1000).map(|i| (i as f64, 2.0 * i as f64)).collect();
        assert_eq!(thinned(&line, 0.1), [line[0], line[999]]);
    }

    #[test]
    fn a_spike_and_a_loop_stay() {
        let mut spike: Vec<_> = (0..1000).map(|i| (i as f64, 0.0)).collect();
        spike[500].1 = 5.0;
        assert!(thinned(&spike, 0.1).contains(&(500.0, 5.0)));
        let ring: Vec<_> =
            (0..=1000).map(|i| (std::f64::consts::TAU * i as f64 / 1e3).sin_cos()).collect();
        let kept = thinned(&ring, 1e-3);
        assert!(kept.len() > 30 && kept.len() < 200, "{}", kept.len());
    }

    /// Against the distance from the nearest of many points of the segment.
    #[test]
    fn the_farthest_point_is_that() {
        let number = |k: usize| ((k * 7919) % 1009) as f64 / 1009.0 - 0.5;
        for n in 3..60 {
            let mut points: Vec<_> =
                (0..n).map(|i| (number(3 * i + n), number(7 * i + 1))).collect();
            if n % 5 == 0 {
                points[n - 1] = points[0];
            }
            let (a, b) = (points[0], points[n - 1]);
            let to = |p: (f64, f64)| {
                let at =
                    |s: f64| ((a.0 + s * (b.0 - a.0)) - p.0).hypot((a.1 + s * (b.1 - a.1)) - p.1);
                (0..=4000).map(|k| at(f64::from(k) / 4e3)).fold(f64::INFINITY, f64::min)
            };
            let most = points.iter().map(|p| to(*p)).fold(0.0, f64::max);
            let (far, square) = farthest(&points, 0, n - 1);
            assert!((square.sqrt() - most).abs() < 1e-6 && to(points[far]) > most - 1e-6, "{n}");
        }
    }
}
