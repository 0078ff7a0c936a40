//! What bodies, elements and constraints look like in a picture.

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

/// Lines and faces that show a linear element or a constraint in pictures; they enter no computation. Every point goes with
/// one of its nodes, as a part of a rigid body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodalOutline {
    /// Index into its nodes, and place from that node without displacement, m, in global axes.
    pub points: Vec<(usize, Vector3)>,
    /// Lines over the points; one that ends where it starts is a face.
    pub paths: Vec<Vec<usize>>,
}

impl NodalOutline {
    /// Of so many nodes: the same where all that it names is there, else nothing.
    #[must_use]
    pub fn checked(self, nodes: usize) -> Option<Self> {
        let of_nodes =
            self.points.iter().all(|(node, at)| *node < nodes && at.iter().all(|x| x.is_finite()));
        let of_points = self.paths.iter().flatten().all(|i| *i < self.points.len());
        (of_nodes && of_points).then_some(self)
    }

    /// Adds the same shape at two nodes, corner by corner, and the edges between them: a prism, or a pyramid without its
    /// tip where one end is smaller. The corners count from their node, m.
    #[must_use]
    pub fn and_prism(mut self, [i, j]: [usize; 2], [here, there]: [&[Vector3]; 2]) -> Self {
        let first = self.points.len();
        let n = here.len().min(there.len());
        self.points.extend(here[..n].iter().map(|p| (i, *p)));
        self.points.extend(there[..n].iter().map(|p| (j, *p)));
        let round = |first: usize| (0..n).chain([0]).map(|k| first + k).collect();
        self.paths.extend([round(first), round(first + n)]);
        self.paths.extend((0..n).map(|k| vec![first + k, first + n + k]));
        self
    }

    /// Adds a face about a node; its corners count from there, m.
    #[must_use]
    pub fn and_face(mut self, node: usize, corners: &[Vector3]) -> Self {
        let first = self.points.len();
        self.points.extend(corners.iter().map(|p| (node, *p)));
        self.paths.push((0..corners.len()).chain([0]).map(|k| first + k).collect());
        self
    }
}

impl From<Outline> for NodalOutline {
    /// All of it with the first node.
    fn from(Outline { points, paths }: Outline) -> Self {
        Self { points: points.into_iter().map(|p| (0, p)).collect(), paths }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_are_put_together_and_what_is_not_there_is_seen() {
        let square = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, -1.0]];
        let it = NodalOutline::default().and_face(1, &square).and_prism([0, 1], [&square, &square]);
        assert_eq!(it.points.len(), 9);
        assert_eq!(it.points[3], (0, square[0]));
        assert_eq!(it.points[8], (1, square[2]));
        assert_eq!(it.paths[..3], [vec![0, 1, 2, 0], vec![3, 4, 5, 3], vec![6, 7, 8, 6]]);
        assert_eq!(it.paths[3..], [vec![3, 6], vec![4, 7], vec![5, 8]]);
        assert_eq!(it.clone().checked(2).as_ref(), Some(&it));
        assert_eq!(it.clone().checked(1), None);
        assert_eq!(NodalOutline { paths: vec![vec![9]], ..it.clone() }.checked(2), None);
        let lost = NodalOutline { points: vec![(0, [f64::NAN; 3])], paths: Vec::new() };
        assert_eq!(lost.checked(2), None);
        let body = NodalOutline::from(Outline::face(square.to_vec()));
        assert_eq!((body.points[2], &body.paths[..]), ((0, square[2]), &[vec![0, 1, 2, 0]][..]));
    }
}
