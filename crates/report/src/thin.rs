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
        let far = (a + 1..b)
            .map(|i| (i, distance(points[i], points[a], points[b])))
            .fold((a, 0.0), |best, at| if at.1 > best.1 { at } else { best });
        if far.1 > tolerance {
            keep[far.0] = true;
            spans.extend([(a, far.0), (far.0, b)]);
        }
    }
    (0..points.len()).filter(|i| keep[*i]).collect()
}

/// Square of the distance of a point from a segment: roots are long, and millions of points are looked at.
fn distance(p: (f64, f64), a: (f64, f64), b: (f64, f64)) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length = dx * dx + dy * dy;
    let share = if length > 0.0 {
        (((p.0 - a.0) * dx + (p.1 - a.1) * dy) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let (x, y) = (p.0 - a.0 - share * dx, p.1 - a.1 - share * dy);
    x * x + y * y
}

#[cfg(test)]
mod tests {
    use super::thinned;

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
}
