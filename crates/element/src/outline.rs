//! What a body looks like in a picture.

use crate::Vector3;

/// Lines and faces that show a body in pictures; they enter no computation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Points, m, in global axes.
    pub points: Vec<Vector3>,
    /// Lines over the points; one that ends where it starts is a face.
    pub paths: Vec<Vec<usize>>,
}

impl Outline {
    /// One face through all points in their order.
    #[must_use]
    pub fn face(points: Vec<Vector3>) -> Self {
        let round = (0..points.len()).chain([0]).collect();
        Self { points, paths: vec![round] }
    }

    /// A prism along Z: the polygon at the bottom, in its order, and the same at the top.
    #[must_use]
    pub fn prism(polygon: &[[f64; 2]], bottom: f64, top: f64) -> Self {
        let n = polygon.len();
        let at = |z: f64| polygon.iter().map(move |p| [p[0], p[1], z]);
        let round = |first: usize| (0..n).chain([0]).map(|i| first + i).collect();
        let mut paths: Vec<Vec<usize>> = vec![round(0), round(n)];
        // A circle of many corners gets a few lines along it only.
        let step = if n > 8 { n.div_ceil(8) } else { 1 };
        paths.extend((0..n).step_by(step).map(|i| vec![i, n + i]));
        Self { points: at(bottom).chain(at(top)).collect(), paths }
    }
}
