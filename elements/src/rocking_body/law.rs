//! The law of the [`RockingBody`].

use super::RockingBody;
use super::rotation::Turn;
use crate::NLinkHistory;
use nalgebra::{Matrix3, SMatrix, Vector3};
use std::borrow::Cow;
use trilith_element::{
    Contact, Coordinates, Energy, Field, History, Kinematics, Link, Response, history,
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
    }
}

impl Attitude {
    /// The rotation at the node's rotations `theta`.
    fn turn(&self, theta: &[f64]) -> Turn {
        let by =
            Vector3::new(theta[0] - self.turned1, theta[1] - self.turned2, theta[2] - self.turned3);
        Turn::new([self.w, self.x, self.y, self.z], by)
    }

    /// Where the body is after a turn.
    fn after(theta: &[f64], turn: &Turn) -> Self {
        let [w, x, y, z] = turn.quaternion;
        // The angle by its sine where its cosine is flat.
        let axis = turn.matrix.column(2);
        let tilt = axis[0].hypot(axis[1]).atan2(axis[2]);
        Self { turned1: theta[0], turned2: theta[1], turned3: theta[2], w, x, y, z, tilt }
    }
}

const ATTITUDE: usize = Attitude::FIELDS.len();
const CONTACT: usize = NLinkHistory::FIELDS.len();

/// Global components in the order of a link on the ground: Z, X, Y.
const ORDER: [usize; 3] = [2, 0, 1];

/// How a base point at `r` moves with the node.
struct Lever {
    /// Displacement and velocity of the point, global.
    d: Vector3<f64>,
    v: Vector3<f64>,
    /// ∂v/∂Ω = −R [r]×; its transpose carries a force to a moment.
    arm: Matrix3<f64>,
}

impl Lever {
    fn new(r: Vector3<f64>, turn: &Turn, d: &[f64], v: &[f64]) -> Self {
        let arm = -turn.matrix * r.cross_matrix();
        let spin = Vector3::new(v[3], v[4], v[5]);
        Self {
            d: Vector3::new(d[0], d[1], d[2]) + turn.shift(r),
            v: Vector3::new(v[0], v[1], v[2]) + arm * spin,
            arm,
        }
    }

    fn ordered(v: &Vector3<f64>) -> [f64; 3] {
        ORDER.map(|i| v[i])
    }
}

/// From values in the order of the contact to global order.
fn matrix(values: &[f64; 9]) -> Matrix3<f64> {
    let mut out = Matrix3::zeros();
    for (p, i) in ORDER.into_iter().enumerate() {
        for (q, j) in ORDER.into_iter().enumerate() {
            out[(i, j)] = values[3 * p + q];
        }
    }
    out
}

impl RockingBody {
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
        for point in 1..=self.base.len() {
            fields.extend(
                NLinkHistory::FIELDS
                    .iter()
                    .map(|f| Field { name: format!("{}_{point}", f.name).into(), unit: f.unit }),
            );
        }
        fields.into()
    }

    fn at_rest(&self, at: &mut [f64]) {
        Attitude { w: 1.0, ..Attitude::default() }.store(at);
        for (point, own) in self.base.iter().zip(at[ATTITUDE..].chunks_mut(CONTACT)) {
            self.contact(*point).at_rest(own);
        }
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let mut sum = SMatrix::<f64, 6, 6>::zeros();
        let shear = if self.mu > 0.0 { self.ks.unwrap_or(0.0) } else { 0.0 };
        let contact = Matrix3::from_diagonal(&Vector3::new(shear, shear, self.kn));
        for point in self.base.iter().filter(|r| r[2] <= self.lowest()) {
            let mut map = SMatrix::<f64, 3, 6>::zeros();
            map.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
            map.fixed_view_mut::<3, 3>(0, 3).copy_from(&-Vector3::from(*point).cross_matrix());
            sum += map.transpose() * contact * map;
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
        let spin = Vector3::new(at.v[3], at.v[4], at.v[5]);
        let (mut moment, by_spin) = self.gyroscopic(spin);
        let mut force = Vector3::zeros();
        let mut k = SMatrix::<f64, 6, 6>::zeros();
        let mut c = SMatrix::<f64, 6, 6>::zeros();
        c.fixed_view_mut::<3, 3>(3, 3).copy_from(&by_spin);

        let histories = committed[ATTITUDE..].chunks(CONTACT);
        let trials = trial[ATTITUDE..].chunks_mut(CONTACT);
        for ((point, committed), trial) in self.base.iter().zip(histories).zip(trials) {
            let r = Vector3::from(*point);
            let before = Lever::new(r, &start, at.d0, at.v0);
            let now = Lever::new(r, &turn, at.d, at.v);
            let (mut f, mut kp, mut cp) = ([0.0; 3], [0.0; 9], [0.0; 9]);
            let mut energy = Energy::default();
            self.contact(*point).respond(
                &Kinematics {
                    d: &Lever::ordered(&now.d),
                    v: &Lever::ordered(&now.v),
                    d0: &Lever::ordered(&before.d),
                    v0: &Lever::ordered(&before.v),
                    dt: at.dt,
                },
                committed,
                trial,
                &mut Response { f: &mut f, k: &mut kp, c: &mut cp, energy: &mut energy },
            );
            out.energy.stored += energy.stored;
            out.energy.hysteretic += energy.hysteretic;
            out.energy.viscous += energy.viscous;

            let f = Vector3::new(f[1], f[2], f[0]);
            let (kp, cp) = (matrix(&kp), matrix(&cp));
            let down = now.arm.transpose();
            force += f;
            moment += down * f;
            // ∂d/∂φ, ∂v/∂φ, and the force that turns against the body's axes.
            let by_turn = now.arm * turn.jacobian;
            let speed_by_turn = -turn.matrix * spin.cross(&r).cross_matrix() * turn.jacobian;
            let turning =
                r.cross_matrix() * (turn.matrix.transpose() * f).cross_matrix() * turn.jacobian;
            let force_by_turn = kp * by_turn + cp * speed_by_turn;
            let add = |to: &mut SMatrix<f64, 6, 6>, i: usize, j: usize, block: Matrix3<f64>| {
                let mut view = to.fixed_view_mut::<3, 3>(3 * i, 3 * j);
                view += block;
            };
            add(&mut k, 0, 0, kp);
            add(&mut k, 0, 1, force_by_turn);
            add(&mut k, 1, 0, down * kp);
            add(&mut k, 1, 1, down * force_by_turn + turning);
            add(&mut c, 0, 0, cp);
            add(&mut c, 0, 1, cp * now.arm);
            add(&mut c, 1, 0, down * cp);
            add(&mut c, 1, 1, down * cp * now.arm);
        }

        for i in 0..3 {
            out.f[i] = force[i];
            out.f[3 + i] = moment[i];
        }
        for i in 0..6 {
            for j in 0..6 {
                out.k[6 * i + j] = k[(i, j)];
                out.c[6 * i + j] = c[(i, j)];
            }
        }
        Attitude::after(&at.d[3..6], &turn).store(trial);
    }

    fn contacts(&self, at: &Kinematics<'_>, history: &[f64], _: &[f64], out: &mut Vec<Contact>) {
        let turn = Attitude::load(history).turn(&at.d[3..6]);
        for (point, history) in self.base.iter().zip(history[ATTITUDE..].chunks(CONTACT)) {
            let now = Lever::new(Vector3::from(*point), &turn, at.d, at.v);
            let (d, v) = (Lever::ordered(&now.d), Lever::ordered(&now.v));
            let at = Kinematics { d: &d, v: &v, d0: &d, v0: &v, dt: 0.0 };
            let contact = self.contact(*point);
            let (mut f, mut k, mut c) = ([0.0; 3], [0.0; 9], [0.0; 9]);
            let (mut energy, mut trial) = (Energy::default(), [0.0; CONTACT]);
            contact.respond(
                &at,
                history,
                &mut trial,
                &mut Response { f: &mut f, k: &mut k, c: &mut c, energy: &mut energy },
            );
            contact.contacts(&at, history, &f, out);
        }
    }

    fn overturned(&self, _: &Kinematics<'_>, history: &[f64]) -> bool {
        Attitude::load(history).tilt >= self.overturned
    }
}
