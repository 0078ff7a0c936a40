//! The law of the [`RockingBody`]: attitude, gyroscopic moment, and the contact of its base.

use super::rim::Rim;
use super::rotation::Turn;
use super::{RockingBody, outline, points};
use nalgebra::{Matrix3, SMatrix, Vector3};
use std::borrow::Cow;
use trilith_element::{
    Contact, Coordinates, Energy, Field, History, Kinematics, Link, Outline, Response, history,
};

history! {
    /// Attitude of the body.
    struct Attitude {
        /// Rotations of the node that the quaternion belongs to.
        turned1: "rad",
        turned2: "rad",
        turned3: "rad",
        /// Quaternion of the rotation from the axes of the body to global ones.
        w: "1",
        x: "1",
        y: "1",
        z: "1",
        /// Angle between the body's vertical axis and the vertical.
        tilt: "rad",
        /// Horizontal part of the body's vertical axis, a vector of length 1: along X and Y.
        lean1: "1",
        lean2: "1",
        /// How high the highest point of the base is above the unloaded ground; below zero: pressed into it.
        uplift: "m",
    }
}

impl Attitude {
    /// The rotation at the node's rotations `theta`.
    fn turn(&self, theta: &[f64]) -> Turn {
        let by =
            Vector3::new(theta[0] - self.turned1, theta[1] - self.turned2, theta[2] - self.turned3);
        Turn::new([self.w, self.x, self.y, self.z], by)
    }

    /// Where the body is after a turn, with the uplift of its base.
    fn after(theta: &[f64], turn: &Turn, uplift: f64) -> Self {
        let [w, x, y, z] = turn.quaternion;
        // The angle by its sine where its cosine is flat.
        let axis = turn.matrix.column(2);
        let tilt = axis[0].hypot(axis[1]).atan2(axis[2]);
        Self {
            turned1: theta[0],
            turned2: theta[1],
            turned3: theta[2],
            w,
            x,
            y,
            z,
            tilt,
            lean1: axis[0],
            lean2: axis[1],
            uplift,
        }
    }
}

const ATTITUDE: usize = Attitude::FIELDS.len();

/// Force and moment on the node with their tangents by d and ḋ, and energies.
#[derive(Default)]
pub(super) struct Wrench {
    pub f: [f64; 6],
    pub k: SMatrix<f64, 6, 6>,
    pub c: SMatrix<f64, 6, 6>,
    pub energy: Energy,
}

impl RockingBody {
    /// The rim, for a body with a circular base.
    fn rim(&self) -> Option<Rim<'_>> {
        let (radius, depth) = (self.rim_radius?, self.rim_depth?);
        Some(Rim { body: self, radius, depth })
    }

    /// How high the highest point of the base is above the unloaded ground, m.
    fn uplift(&self, d: &[f64], turn: &Turn) -> f64 {
        match self.rim() {
            Some(rim) => rim.uplift(d, turn),
            None => points::uplift(self, d, turn),
        }
    }

    /// Ω × J Ω and its derivative by Ω.
    fn gyroscopic(&self, spin: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let inertia = Matrix3::from_diagonal(&Vector3::from(self.inertia.unwrap_or_default()));
        let momentum = inertia * spin;
        (spin.cross(&momentum), spin.cross_matrix() * inertia - momentum.cross_matrix())
    }
}

impl Link for RockingBody {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Nodal { nodes: 1 }
    }

    fn history(&self) -> Cow<'static, [Field]> {
        let mut fields = Attitude::FIELDS.to_vec();
        fields.extend(match self.rim() {
            Some(_) => Rim::fields(),
            None => points::fields(self.base.len()),
        });
        fields.into()
    }

    fn at_rest(&self, at: &mut [f64]) {
        let upright = Attitude { w: 1.0, ..Attitude::default() };
        let uplift = self.uplift(&[0.0; 6], &upright.turn(&[0.0; 3]));
        Attitude { uplift, ..upright }.store(at);
        match self.rim() {
            Some(rim) => rim.at_rest(&mut at[ATTITUDE..]),
            None => points::at_rest(self, &mut at[ATTITUDE..]),
        }
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let mut sum = SMatrix::<f64, 6, 6>::zeros();
        let shear = if self.mu > 0.0 { self.ks.unwrap_or(0.0) } else { 0.0 };
        let contact = Matrix3::from_diagonal(&Vector3::new(shear, shear, self.kn));
        let stand = |r: Vector3<f64>| {
            let mut map = SMatrix::<f64, 3, 6>::zeros();
            map.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
            map.fixed_view_mut::<3, 3>(0, 3).copy_from(&-r.cross_matrix());
            map.transpose() * contact * map
        };
        if let Some(rim) = self.rim() {
            sum += stand(Vector3::new(0.0, 0.0, -rim.depth));
            let square = rim.radius * rim.radius;
            sum[(3, 3)] += 0.5 * self.kn * square;
            sum[(4, 4)] += 0.5 * self.kn * square;
            sum[(5, 5)] += shear * square;
        }
        for point in self.base.iter().filter(|r| r[2] <= self.lowest()) {
            sum += stand(Vector3::from(*point));
        }
        for i in 0..6 {
            for j in 0..6 {
                k[6 * i + j] = 0.5 * (sum[(i, j)] + sum[(j, i)]);
            }
        }
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let was = Attitude::load(committed);
        let (start, turn) = (was.turn(&at.d0[3..6]), was.turn(&at.d[3..6]));
        let (from, to) = (&committed[ATTITUDE..], &mut trial[ATTITUDE..]);
        let base = match self.rim() {
            Some(rim) => rim.respond(at, (&start, &turn), from, to),
            None => points::respond(self, at, (&start, &turn), from, to),
        };
        let (moment, by_spin) = self.gyroscopic(Vector3::new(at.v[3], at.v[4], at.v[5]));
        out.f.copy_from_slice(&base.f);
        for i in 0..6 {
            for j in 0..6 {
                out.k[6 * i + j] = base.k[(i, j)];
                out.c[6 * i + j] = base.c[(i, j)];
            }
        }
        for i in 0..3 {
            out.f[3 + i] += moment[i];
            for j in 0..3 {
                out.c[6 * (3 + i) + 3 + j] += by_spin[(i, j)];
            }
        }
        *out.energy = base.energy;
        Attitude::after(&at.d[3..6], &turn, self.uplift(at.d, &turn)).store(trial);
    }

    fn contacts(&self, at: &Kinematics<'_>, history: &[f64], _: &[f64], out: &mut Vec<Contact>) {
        let turn = Attitude::load(history).turn(&at.d[3..6]);
        let own = &history[ATTITUDE..];
        match self.rim() {
            Some(rim) => rim.contacts(at, &turn, own, out),
            None => points::contacts(self, at, &turn, own, out),
        }
    }

    fn outline(&self, at: &Kinematics<'_>, history: &[f64]) -> Option<Outline> {
        let turn = Attitude::load(history).turn(&at.d[3..6]);
        let mut body = outline::upright(self);
        for point in &mut body.points {
            let moved = Vector3::from(*point) + turn.shift(Vector3::from(*point));
            *point = [0, 1, 2].map(|i| at.d[i] + moved[i]);
        }
        Some(body)
    }

    fn overturned(&self, _: &Kinematics<'_>, history: &[f64]) -> bool {
        Attitude::load(history).tilt >= self.overturned
    }
}
