//! Base points: an `NLink` under each.

use super::RockingBody;
use super::law::Wrench;
use super::rotation::Turn;
use crate::NLinkHistory;
use nalgebra::{Matrix3, SMatrix, Vector3};
use trilith_element::{Contact, Energy, Field, History, Kinematics, Link, Response};

const CONTACT: usize = NLinkHistory::FIELDS.len();

/// Global components in the order of a link on the ground: Z, X, Y.
const ORDER: [usize; 3] = [2, 0, 1];

/// How a base point at `r` moves with the node.
struct Lever {
    /// Displacement and velocity of the point, global.
    d: Vector3<f64>,
    v: Vector3<f64>,
    /// ∂v/∂Ω = −R \[r\]×; its transpose carries a force to a moment.
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

pub(super) fn fields(count: usize) -> Vec<Field> {
    let of = |point: usize| {
        let name =
            move |f: &Field| Field { name: format!("{}_{point}", f.name).into(), unit: f.unit };
        NLinkHistory::FIELDS.iter().map(name)
    };
    (1..=count).flat_map(of).collect()
}

pub(super) fn at_rest(body: &RockingBody, at: &mut [f64]) {
    for (point, own) in body.base.iter().zip(at.chunks_mut(CONTACT)) {
        body.contact(*point).at_rest(own);
    }
}

/// Forces, tangents and energies over a step.
pub(super) fn respond(
    body: &RockingBody,
    at: &Kinematics<'_>,
    (start, turn): (&Turn, &Turn),
    committed: &[f64],
    trial: &mut [f64],
) -> Wrench {
    let spin = Vector3::new(at.v[3], at.v[4], at.v[5]);
    let mut out = Wrench::default();
    let histories = committed.chunks(CONTACT).zip(trial.chunks_mut(CONTACT));
    for (point, (committed, trial)) in body.base.iter().zip(histories) {
        let r = Vector3::from(*point);
        let before = Lever::new(r, start, at.d0, at.v0);
        let now = Lever::new(r, turn, at.d, at.v);
        let (mut f, mut k, mut c) = ([0.0; 3], [0.0; 9], [0.0; 9]);
        let mut energy = Energy::default();
        body.contact(*point).respond(
            &Kinematics {
                d: &Lever::ordered(&now.d),
                v: &Lever::ordered(&now.v),
                d0: &Lever::ordered(&before.d),
                v0: &Lever::ordered(&before.v),
                dt: at.dt,
            },
            committed,
            trial,
            &mut Response { f: &mut f, k: &mut k, c: &mut c, energy: &mut energy },
        );
        out.energy.stored += energy.stored;
        out.energy.hysteretic += energy.hysteretic;
        out.energy.viscous += energy.viscous;

        let f = Vector3::new(f[1], f[2], f[0]);
        let (k, c) = (matrix(&k), matrix(&c));
        let down = now.arm.transpose();
        let moment = down * f;
        for i in 0..3 {
            out.f[i] += f[i];
            out.f[3 + i] += moment[i];
        }
        // ∂d/∂φ, ∂v/∂φ, and the force that turns against the body's axes.
        let by_turn = now.arm * turn.jacobian;
        let speed_by_turn = -turn.matrix * spin.cross(&r).cross_matrix() * turn.jacobian;
        let turning =
            r.cross_matrix() * (turn.matrix.transpose() * f).cross_matrix() * turn.jacobian;
        let force_by_turn = k * by_turn + c * speed_by_turn;
        let add = |to: &mut SMatrix<f64, 6, 6>, i: usize, j: usize, block: Matrix3<f64>| {
            let mut view = to.fixed_view_mut::<3, 3>(3 * i, 3 * j);
            view += block;
        };
        add(&mut out.k, 0, 0, k);
        add(&mut out.k, 0, 1, force_by_turn);
        add(&mut out.k, 1, 0, down * k);
        add(&mut out.k, 1, 1, down * force_by_turn + turning);
        add(&mut out.c, 0, 0, c);
        add(&mut out.c, 0, 1, c * now.arm);
        add(&mut out.c, 1, 0, down * c);
        add(&mut out.c, 1, 1, down * c * now.arm);
    }
    out
}

/// How high the highest base point is above the ground that it stands on or hangs over, m.
pub(super) fn uplift(body: &RockingBody, d: &[f64], turn: &Turn) -> f64 {
    let gap = |point: &[f64; 3]| {
        d[2] + turn.shift(Vector3::from(*point)).z + body.contact(*point).opening
    };
    body.base.iter().map(gap).fold(f64::NEG_INFINITY, f64::max)
}

pub(super) fn contacts(
    body: &RockingBody,
    at: &Kinematics<'_>,
    turn: &Turn,
    history: &[f64],
    out: &mut Vec<Contact>,
) {
    for (point, history) in body.base.iter().zip(history.chunks(CONTACT)) {
        let now = Lever::new(Vector3::from(*point), turn, at.d, at.v);
        let (d, v) = (Lever::ordered(&now.d), Lever::ordered(&now.v));
        let at = Kinematics { d: &d, v: &v, d0: &d, v0: &v, dt: 0.0 };
        let contact = body.contact(*point);
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
