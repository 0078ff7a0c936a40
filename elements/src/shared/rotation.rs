//! Finite rotations.

use super::dual::{self, Dual3};
use super::spatial::{self, M3, Rotation, right_jacobian};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use trilith_element::history;

/// A rotation that goes on from one that is known, R = R₀ exp(φ), and what small changes of φ do to it.
pub(crate) struct Turn {
    /// R, from the axes of the body to global axes.
    pub matrix: Matrix3<f64>,
    /// The right Jacobian Jᵣ(φ): δR = R \[Jᵣ δφ\]×.
    pub jacobian: Matrix3<f64>,
    /// R as quaternion (w, x, y, z).
    pub quaternion: [f64; 4],
}

history! {
    /// The rotation of a node that turns finitely, at the end of a step.
    pub(crate) struct Turned {
        /// Rotations of the node that the quaternion belongs to.
        turned1: "rad",
        turned2: "rad",
        turned3: "rad",
        /// Quaternion of the rotation from the axes of the body to global ones.
        w: "1",
        x: "1",
        y: "1",
        z: "1",
    }
}

impl Turned {
    /// Not turned yet.
    pub fn upright() -> Self {
        Self { w: 1.0, ..Self::default() }
    }

    /// The rotation at the node's rotations `theta`.
    pub fn turn(&self, theta: &[f64]) -> Turn {
        let by =
            Vector3::new(theta[0] - self.turned1, theta[1] - self.turned2, theta[2] - self.turned3);
        Turn::new([self.w, self.x, self.y, self.z], by)
    }

    /// The node after a turn to its rotations `theta`.
    pub fn after(theta: &[f64], turn: &Turn) -> Self {
        let [w, x, y, z] = turn.quaternion;
        Self { turned1: theta[0], turned2: theta[1], turned3: theta[2], w, x, y, z }
    }
}

impl Turn {
    /// From the quaternion (w, x, y, z) of R₀ by the rotation vector φ in the axes of the body.
    pub fn new(start: [f64; 4], by: Vector3<f64>) -> Self {
        let by = by.into();
        let Rotation { matrix, quaternion } = Rotation::new(&start, &by);
        Self { matrix: of_rows(&matrix), jacobian: of_rows(&right_jacobian(&by)), quaternion }
    }

    /// Without its Jacobian.
    pub fn rotation(&self) -> Rotation<f64> {
        Rotation { matrix: rows(&self.matrix), quaternion: self.quaternion }
    }

    /// R r − r.
    pub fn shift(&self, r: Vector3<f64>) -> Vector3<f64> {
        spatial::shift(&self.quaternion, &r.into()).into()
    }

    /// Rᵀ r − r.
    pub fn shift_back(&self, r: Vector3<f64>) -> Vector3<f64> {
        let [w, x, y, z] = self.quaternion;
        spatial::shift(&[w, -x, -y, -z], &r.into()).into()
    }

    /// R₁ᵀ R₂ of two rotations, as one that goes on from `start`, and its φ; none: as one to start from.
    pub fn between(first: &Self, second: &Self, start: Option<&Self>) -> (Self, Vector3<f64>) {
        let unit =
            |[w, x, y, z]: [f64; 4]| UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
        let all = unit(first.quaternion).inverse() * unit(second.quaternion);
        let from = |start: &Self| logarithm(&(unit(start.quaternion).inverse() * all));
        let by = start.map_or_else(Vector3::zeros, from);
        let q = all.quaternion();
        let turn = Self {
            matrix: first.matrix.transpose() * second.matrix,
            jacobian: of_rows(&right_jacobian(&by.into())),
            quaternion: [q.w, q.i, q.j, q.k],
        };
        (turn, by)
    }

    /// R, row by row, with its derivatives by φ, which are the variables from `first` on, if there are any.
    pub fn dual<const N: usize>(&self, first: usize) -> [Dual3<N>; 3] {
        dual::rotation(&rows(&self.matrix), &rows(&self.jacobian), first)
    }
}

/// φ of exp(φ), at most half a turn.
fn logarithm(q: &UnitQuaternion<f64>) -> Vector3<f64> {
    let (w, axis) = (q.quaternion().w, q.quaternion().vector().into_owned());
    let sine = axis.norm();
    if sine == 0.0 {
        return Vector3::zeros();
    }
    let (w, axis) = if w < 0.0 { (-w, -axis) } else { (w, axis) };
    axis * (2.0 * sine.atan2(w) / sine)
}

/// A matrix of its rows.
pub(crate) fn of_rows(m: &M3<f64>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| m[i][j])
}

/// The rows of a matrix.
pub(crate) fn rows(m: &Matrix3<f64>) -> M3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_jacobian_is_the_derivative_of_the_rotation() {
        for by in [[0.3, -0.8, 0.5], [1e-3, 2e-3, -1e-3], [0.0; 3], [0.0, 2.5, 0.0]] {
            let by = Vector3::from(by);
            let turn = |v| Turn::new([1.0, 0.0, 0.0, 0.0], v);
            let here = turn(by);
            for i in 0..3 {
                let mut h = Vector3::zeros();
                h[i] = 1e-6;
                let quotient = (turn(by + h).matrix - turn(by - h).matrix) / 2e-6;
                let column = here.jacobian.column(i).into_owned();
                let given = here.matrix * column.cross_matrix();
                assert_relative_eq!(quotient, given, epsilon = 1e-8);
            }
        }
    }

    /// Down to angles whose squares vanish; across the change of formula against nalgebra.
    #[test]
    fn a_rotation_of_any_size_turns_by_its_angle() {
        let half = |angle: f64| Turn::new([1.0, 0.0, 0.0, 0.0], Vector3::new(0.0, angle, 0.0));
        for angle in [1e-300, 1e-18, 3e-16, 1e-9, 1.9e-4, 2.1e-4, 0.3, 3.0] {
            let sine = f64::sin(0.5 * angle);
            assert_relative_eq!(
                half(angle).quaternion[2],
                sine,
                epsilon = 0.0,
                max_relative = 1e-15
            );
        }
        for angle in [1.9e-4, 2.1e-4, 0.3, 3.0] {
            let by = angle * Vector3::new(0.6, 0.0, 0.8);
            let known = UnitQuaternion::from_scaled_axis(by);
            let [w, x, y, z] = Turn::new([1.0, 0.0, 0.0, 0.0], by).quaternion;
            assert!((Quaternion::new(w, x, y, z).coords - known.coords).norm() < 1e-15);
        }
    }

    #[test]
    fn the_shift_of_a_point_has_all_its_digits() {
        let r = Vector3::new(1.0, -2.0, 3.0);
        let turn = |angle| Turn::new([1.0, 0.0, 0.0, 0.0], Vector3::new(0.0, angle, 0.0));
        let large = turn(0.8);
        assert_relative_eq!(large.shift(r), large.matrix * r - r, max_relative = 1e-14);
        let tiny = turn(1e-13).shift(r);
        assert_relative_eq!(tiny[0], 3e-13, max_relative = 1e-12);
    }

    #[test]
    fn what_is_between_two_turns_leads_from_one_to_the_other() {
        let of = |q, by: [f64; 3]| Turn::new(q, Vector3::from(by));
        let rest = [1.0, 0.0, 0.0, 0.0];
        let (first, start) = (of(rest, [0.4, -0.2, 1.1]), of(rest, [-0.7, 0.3, 0.2]));
        for by in [[0.2, 0.5, -0.1], [1e-9, 0.0, 2e-9], [0.0; 3], [2.0, -1.0, 1.5]] {
            let second = of(start.quaternion, by);
            let (from, zero) = Turn::between(&first, &start, None);
            let (to, found) = Turn::between(&first, &second, Some(&from));
            // The same turn in the axes of the second body, whoever looks at it.
            assert_relative_eq!(found, Vector3::from(by), epsilon = 1e-15, max_relative = 1e-14);
            assert_relative_eq!(first.matrix * to.matrix, second.matrix, epsilon = 1e-14);
            let again = Turn::new(from.quaternion, found);
            assert_relative_eq!(again.matrix, to.matrix, epsilon = 1e-14);
            assert_eq!(zero, Vector3::zeros());
            let r = Vector3::new(1.0, 2.0, -0.5);
            assert_relative_eq!(to.shift_back(r), to.matrix.transpose() * r - r, epsilon = 1e-14);
        }
    }

    #[test]
    fn a_turn_in_a_plane_is_its_angle() {
        let a = Turn::new([1.0, 0.0, 0.0, 0.0], Vector3::new(0.0, 0.7, 0.0));
        let b = Turn::new(a.quaternion, Vector3::new(0.0, 0.5, 0.0));
        assert_relative_eq!(b.matrix[(2, 2)], 1.2_f64.cos(), max_relative = 1e-14);
        assert_relative_eq!(b.matrix[(0, 2)], 1.2_f64.sin(), max_relative = 1e-14);
    }
}
