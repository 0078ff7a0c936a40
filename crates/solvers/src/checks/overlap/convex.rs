//! Convex bodies by their corners, and how deep two of them are in each other.
//!
//! Two convex bodies are apart where along one axis they are. For bodies with plane faces, few axes need a look: the
//! normals of the faces of both, and the normals of every edge of one with every edge of the other. The least overlap
//! along all of them is how far one must move to be out of the other.

use trilith_element::{Outline, Vector3};

/// Directions closer than this are one.
const ONE: f64 = 1e-6;

/// What of a body does not change: axes in a frame that turns with it.
#[derive(Clone, Debug)]
pub(super) struct Convex {
    /// Points that give the frame.
    frame: [usize; 3],
    /// Normals of its faces; of a flat body the normals of its edges in its plane as well.
    normals: Vec<Vector3>,
    /// Directions of its edges.
    edges: Vec<Vector3>,
    /// The normal of a flat body.
    flat: Option<Vector3>,
    /// The smallest extent along a normal, m; of a flat body, in its plane.
    pub width: f64,
}

/// A body where it is.
#[derive(Debug)]
pub(super) struct Posed {
    points: Vec<Vector3>,
    normals: Vec<Vector3>,
    edges: Vec<Vector3>,
    flat: Option<Vector3>,
}

impl Convex {
    /// The hull of an outline whose lines are all edges and whose closed lines are faces; none for a point or a line.
    pub fn new(outline: &Outline) -> Option<Self> {
        let points = &outline.points;
        let frame = frame(points)?;
        let mut edges = Vec::new();
        for path in &outline.paths {
            let corners: Vec<Vector3> =
                path.iter().filter_map(|i| points.get(*i)).copied().collect();
            let closed = path.len() > 3 && path.first() == path.last();
            let corners = if closed { hull(&corners) } else { corners };
            corners.windows(2).for_each(|w| add(&mut edges, minus(w[1], w[0])));
        }
        let axes = axes(points, frame)?;
        let thick = extent(points, axes[2]);
        let size = extent(points, axes[0]);
        let flat = (thick <= ONE * size).then_some(axes[2]);
        let mut normals = Vec::new();
        match flat {
            Some(normal) => {
                normals.push(normal);
                edges.iter().for_each(|e| add(&mut normals, cross(normal, *e)));
            }
            None => {
                for (i, a) in edges.iter().enumerate() {
                    edges[..i].iter().for_each(|b| add(&mut normals, cross(*a, *b)));
                }
            }
        }
        let extents = normals.iter().map(|n| extent(points, *n)).filter(|x| *x > ONE * size);
        let width = extents.fold(size, f64::min);
        let turned = |all: Vec<Vector3>| all.into_iter().map(|v| into(axes, v)).collect();
        let flat = flat.map(|n| into(axes, n));
        Some(Self { frame, normals: turned(normals), edges: turned(edges), flat, width })
    }

    /// It where its points are these.
    pub fn posed(&self, points: Vec<Vector3>) -> Option<Posed> {
        let axes = axes(&points, self.frame)?;
        let turned = |all: &[Vector3]| all.iter().map(|v| out_of(axes, *v)).collect();
        Some(Posed {
            normals: turned(&self.normals),
            edges: turned(&self.edges),
            flat: self.flat.map(|n| out_of(axes, n)),
            points,
        })
    }
}

/// How deep two bodies are in each other, m, where that is more than `least`. `axis` is where they were apart before,
/// which is looked at first, and becomes where they are apart now.
pub(super) fn overlap(a: &Posed, b: &Posed, least: f64, axis: &mut Option<Vector3>) -> Option<f64> {
    if axis.is_some_and(|axis| along(a, b, axis) <= least) {
        return None;
    }
    // In one plane they cannot leave each other across it: that would take no way at all.
    let plane = a.flat.filter(|n| b.flat.is_some_and(|m| parallel(*n, m)) && coplanar(a, b, *n));
    let own = a.normals.iter().chain(&b.normals).copied();
    let both = a.edges.iter().flat_map(|e| b.edges.iter().map(|f| cross(*e, *f)));
    let mut deepest = f64::INFINITY;
    for candidate in own.chain(both).filter_map(unit) {
        if plane.is_some_and(|n| parallel(n, candidate)) {
            continue;
        }
        let depth = along(a, b, candidate);
        if depth <= least {
            *axis = Some(candidate);
            return None;
        }
        deepest = deepest.min(depth);
    }
    deepest.is_finite().then_some(deepest)
}

/// How far the shadows of two bodies on an axis are in each other; below 0 where they are apart.
fn along(a: &Posed, b: &Posed, axis: Vector3) -> f64 {
    let ([low, high], [from, to]) = (shadow(&a.points, axis), shadow(&b.points, axis));
    (high - from).min(to - low)
}

fn shadow(points: &[Vector3], axis: Vector3) -> [f64; 2] {
    let whole = [f64::INFINITY, f64::NEG_INFINITY];
    points.iter().map(|p| dot(*p, axis)).fold(whole, |[low, high], x| [low.min(x), high.max(x)])
}

fn extent(points: &[Vector3], axis: Vector3) -> f64 {
    let [low, high] = shadow(points, axis);
    high - low
}

fn coplanar(a: &Posed, b: &Posed, normal: Vector3) -> bool {
    let all: Vec<Vector3> = a.points.iter().chain(&b.points).copied().collect();
    let size = all.iter().map(|p| norm(minus(*p, all[0]))).fold(0.0, f64::max);
    extent(&all, normal) <= ONE * size
}

/// Three points far from one line: the first, the farthest from it, and the farthest from the line of both.
fn frame(points: &[Vector3]) -> Option<[usize; 3]> {
    let farthest = |of: &dyn Fn(Vector3) -> f64| {
        (0..points.len()).max_by(|i, j| of(points[*i]).total_cmp(&of(points[*j])))
    };
    let first = *points.first()?;
    let second = farthest(&|p| norm(minus(p, first)))?;
    let line = unit(minus(points[second], first))?;
    let beside = |p: Vector3| norm(cross(line, minus(p, first)));
    let third = farthest(&beside)?;
    let long = norm(minus(points[second], first));
    (beside(points[third]) > ONE * long).then_some([0, second, third])
}

/// Axes of the frame: along its line, across it in the plane of its points, and normal to that.
fn axes(points: &[Vector3], [i, j, k]: [usize; 3]) -> Option<[Vector3; 3]> {
    let (first, second, third) = (points.get(i)?, points.get(j)?, points.get(k)?);
    let x = unit(minus(*second, *first))?;
    let z = unit(cross(x, minus(*third, *first)))?;
    Some([x, cross(z, x), z])
}

/// The hull of points in a plane, closed: wrapped from corner to corner.
fn hull(points: &[Vector3]) -> Vec<Vector3> {
    let Some(axes) = frame(points).and_then(|f| axes(points, f)) else { return points.to_vec() };
    let flat: Vec<[f64; 2]> = points.iter().map(|p| [dot(*p, axes[0]), dot(*p, axes[1])]).collect();
    let lowest = (0..flat.len())
        .min_by(|i, j| flat[*i].partial_cmp(&flat[*j]).unwrap_or(std::cmp::Ordering::Equal));
    let Some(start) = lowest else { return Vec::new() };
    let (mut corners, mut at) = (vec![points[start]], start);
    for _ in 0..points.len() {
        let mut next = at;
        for i in 0..flat.len() {
            let way = |k: usize| [flat[k][0] - flat[at][0], flat[k][1] - flat[at][1]];
            let (u, v) = (way(next), way(i));
            let (turn, length) = (u[0] * v[1] - u[1] * v[0], |w: [f64; 2]| w[0].hypot(w[1]));
            if next == at || turn < 0.0 || (turn == 0.0 && length(v) > length(u)) {
                next = i;
            }
        }
        corners.push(points[next]);
        at = next;
        if points[at] == points[start] {
            break;
        }
    }
    corners
}

/// Adds a direction unless it is there; one of no length is none.
fn add(all: &mut Vec<Vector3>, direction: Vector3) {
    if let Some(direction) = unit(direction)
        && !all.iter().any(|d| parallel(*d, direction))
    {
        all.push(direction);
    }
}

fn parallel(a: Vector3, b: Vector3) -> bool {
    norm(cross(a, b)) < ONE
}

fn unit(v: Vector3) -> Option<Vector3> {
    let length = norm(v);
    (length > ONE * ONE).then(|| v.map(|x| x / length))
}

fn into(axes: [Vector3; 3], v: Vector3) -> Vector3 {
    axes.map(|a| dot(a, v))
}

fn out_of(axes: [Vector3; 3], v: Vector3) -> Vector3 {
    [0, 1, 2].map(|i| axes[0][i] * v[0] + axes[1][i] * v[1] + axes[2][i] * v[2])
}

fn minus(a: Vector3, b: Vector3) -> Vector3 {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn dot(a: Vector3, b: Vector3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn norm(a: Vector3) -> f64 {
    dot(a, a).sqrt()
}

fn cross(a: Vector3, b: Vector3) -> Vector3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_1_SQRT_2, TAU};

    const SQUARE: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

    fn cube() -> Outline {
        Outline::prism(&SQUARE, -1.0, 1.0)
    }

    fn cylinder() -> Outline {
        let corner = |i: u32| (TAU * f64::from(i) / 32.0).sin_cos();
        let circle: Vec<_> = (0..32).map(corner).map(|(s, c)| [c, s]).collect();
        Outline::prism(&circle, -3.0, 3.0)
    }

    /// Moved, after a turn about Z, and one about X.
    fn at(outline: &Outline, turns: [f64; 2], moved: Vector3) -> Posed {
        let ((s, c), (t, d)) = (turns[0].sin_cos(), turns[1].sin_cos());
        let place = |p: &Vector3| {
            let [x, y, z] = [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]];
            [x + moved[0], d * y - t * z + moved[1], t * y + d * z + moved[2]]
        };
        let shape = Convex::new(outline).unwrap();
        shape.posed(outline.points.iter().map(place).collect()).unwrap()
    }

    fn depth(a: &Posed, b: &Posed) -> Option<f64> {
        let turned = overlap(b, a, 0.0, &mut None);
        let found = overlap(a, b, 0.0, &mut None);
        assert_eq!(found.is_some(), turned.is_some());
        found
    }

    #[track_caller]
    fn close(found: Option<f64>, wanted: f64) {
        let found = found.unwrap();
        assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
    }

    #[test]
    fn cubes_meet_at_faces_edges_and_corners() {
        let still = at(&cube(), [0.0; 2], [0.0; 3]);
        close(depth(&still, &at(&cube(), [0.0; 2], [1.9, 0.3, -0.2])), 0.1);
        assert_eq!(depth(&still, &at(&cube(), [0.0; 2], [2.0 + 1e-9, 0.3, -0.2])), None);
        // An edge against a face: half the diagonal of a face reaches √2.
        let turned = |x: f64| at(&cube(), [TAU / 8.0, 0.0], [x, 0.0, 0.0]);
        close(depth(&still, &turned(2.4)), 2.0f64.sqrt() - 1.4);
        assert_eq!(depth(&still, &turned(2.42)), None);
        // An edge against an edge, crosswise: only their common normal tells.
        let upper = at(&cube(), [0.0, TAU / 8.0], [0.0; 3]);
        let way = |x: f64| x * FRAC_1_SQRT_2;
        let crosswise = |x: f64| {
            let turned = at(&cube(), [TAU / 8.0, 0.0], [0.0; 3]);
            // From an edge along X to one along Z, both on top of Y.
            let points = turned.points.iter().map(|p| [p[0], p[1] + x, p[2]]).collect();
            Convex::new(&cube()).unwrap().posed(points).unwrap()
        };
        close(depth(&upper, &crosswise(way(3.9))), way(4.0) - way(3.9));
        assert_eq!(depth(&upper, &crosswise(way(4.01))), None);
    }

    #[test]
    fn cylinders_side_by_side_and_one_that_leans() {
        let still = at(&cylinder(), [0.0; 2], [0.0; 3]);
        // Across a side of the 32, not from corner to corner.
        let side = (TAU / 64.0).cos();
        close(depth(&still, &at(&cylinder(), [0.0; 2], [1.9, 0.0, 1.0])), 0.1 * side);
        assert_eq!(depth(&still, &at(&cylinder(), [0.0; 2], [2.001, 0.0, 1.0])), None);
        // Its bounding sphere is far in the other, and it is not.
        let leaning = |y: f64| at(&cylinder(), [0.0, 0.3], [0.0, y, 0.0]);
        let touches = 1.0 + 0.3f64.cos() + 3.0 * 0.3f64.sin();
        assert!(depth(&still, &leaning(touches - 0.05)).is_some());
        assert_eq!(depth(&still, &leaning(touches + 1e-6)), None);
    }

    #[test]
    fn what_is_flat_overlaps_in_its_plane_and_with_what_it_cuts() {
        let corners = |points: [[f64; 2]; 4]| points.map(|p| [p[0], 0.0, p[1]]).to_vec();
        let face = Outline::face(corners(SQUARE));
        let still = at(&face, [0.0; 2], [0.0; 3]);
        close(depth(&still, &at(&face, [0.0; 2], [1.8, 0.0, 0.5])), 0.2);
        assert_eq!(depth(&still, &at(&face, [0.0; 2], [2.1, 0.0, 0.5])), None);
        assert_eq!(depth(&still, &at(&face, [0.0; 2], [0.5, 0.01, 0.5])), None);
        close(depth(&still, &at(&cube(), [0.0; 2], [0.0, 0.7, 0.0])), 0.3);
        assert_eq!(Convex::new(&face).unwrap().width, 2.0);
    }

    #[test]
    fn corners_that_stand_back_belong_to_the_hull() {
        // An arrow: its fourth corner is inside the triangle of the others.
        let arrow = [[-1.0, -1.0], [0.0, -0.2], [1.0, -1.0], [0.0, 1.0]];
        let a = at(&Outline::prism(&arrow, 0.0, 1.0), [0.0; 2], [0.0; 3]);
        let below = |y: f64| at(&cube(), [0.0; 2], [0.0, y, 0.5]);
        assert_eq!(depth(&a, &below(-2.01)), None);
        close(depth(&a, &below(-1.9)), 0.1);
    }

    #[test]
    fn where_they_were_apart_is_looked_at_first() {
        let still = at(&cube(), [0.0; 2], [0.0; 3]);
        let mut axis = None;
        assert_eq!(overlap(&still, &at(&cube(), [0.0; 2], [0.0, 2.5, 0.0]), 0.1, &mut axis), None);
        assert!(axis.is_some_and(|a| parallel(a, [0.0, 1.0, 0.0])), "{axis:?}");
        assert_eq!(overlap(&still, &at(&cube(), [0.0; 2], [0.0, 1.95, 0.0]), 0.1, &mut axis), None);
        assert!(overlap(&still, &at(&cube(), [0.0; 2], [0.0, 1.8, 0.0]), 0.1, &mut axis).is_some());
    }

    #[test]
    fn points_and_lines_are_no_bodies() {
        for points in [vec![], vec![[1.0; 3]], vec![[0.0; 3], [1.0; 3], [2.0; 3]]] {
            assert!(Convex::new(&Outline::face(points)).is_none());
        }
    }
}
