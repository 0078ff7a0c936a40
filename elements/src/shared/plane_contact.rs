//! Points of a body on a plane: an `NLink` under each.

use super::lever::{Carried, Lever};
use super::rotation::{Turn, rows};
use super::spatial::{Rotation, V3};
use super::wrench::Wrench;
use crate::{NLink, NLinkHistory};
use nalgebra::{Matrix3, SMatrix, Vector3};
use trilith_element::{Contact, Energy, Field, History, Kinematics, Link, Response};

const CONTACT: usize = NLinkHistory::FIELDS.len();

/// A plane: its normal, out of it, and two axes in it as rows.
pub(crate) struct Plane(pub Matrix3<f64>);

/// The ground: Z, X, Y, as a link on the ground has them.
pub(crate) const GROUND: Plane = Plane(Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0));

/// A point of the body and the contact under it.
pub(crate) struct Foot {
    /// From the node, in the axes of the body.
    pub r: Vector3<f64>,
    pub contact: NLink,
    /// Where the plane ends; none: nowhere. All feet of a body are alike in this.
    pub edge: Option<Edge>,
}

/// A plane that ends is a rectangle about its middle.
#[derive(Clone, Copy)]
pub(crate) struct Edge {
    /// Half widths along the axes in the plane, m.
    pub half: [f64; 2],
    /// Where the point is at rest, from the middle, m.
    pub from: [f64; 2],
}

impl Edge {
    /// True where a point that has moved by `d` is over the rectangle.
    fn holds(&self, d: &[f64; 3]) -> bool {
        (0..2).all(|i| (self.from[i] + d[1 + i]).abs() <= self.half[i])
    }
}

impl Foot {
    /// True where a point that has moved by `d` is behind the plane and has come there past the edge: nothing holds it
    /// until it has been in front again.
    fn is_past(&self, d: &[f64; 3], was: bool) -> bool {
        let Some(edge) = self.edge else { return false };
        d[0] + self.contact.opening < 0.0 && (was || !edge.holds(d))
    }

    /// The same motion in front of the plane.
    fn lifted(&self, d: [f64; 3], past: bool) -> [f64; 3] {
        if past { [1.0 - self.contact.opening, d[1], d[2]] } else { d }
    }
}

/// Variables of one point.
fn own(edged: bool) -> usize {
    CONTACT + usize::from(edged)
}

/// History of so many points; with an edge they remember whether they went past it.
pub(crate) fn fields(count: usize, edged: bool) -> Vec<Field> {
    let past = Field::new("past", "1");
    let all: Vec<Field> =
        NLinkHistory::FIELDS.iter().cloned().chain(edged.then_some(past)).collect();
    let of =
        |point: usize| all.iter().map(move |f| Field::named(format!("{}_{point}", f.name), f.unit));
    (1..=count).flat_map(of).collect()
}

pub(crate) fn at_rest(feet: impl Iterator<Item = Foot>, edged: bool, at: &mut [f64]) {
    for (foot, own) in feet.zip(at.chunks_mut(own(edged))) {
        foot.contact.at_rest(own);
    }
}

/// Forces, tangents and energies over a step.
pub(crate) fn respond(
    plane: &Plane,
    feet: impl Iterator<Item = Foot>,
    at: &Kinematics<'_>,
    (start, turn): (&Turn, &Turn),
    committed: &[f64],
    trial: &mut [f64],
    edged: bool,
) -> Wrench {
    let (before, now) = (Stand::new(start, at.d0, at.v0), Stand::new(turn, at.d, at.v));
    let mut out = Wrench::default();
    let mut all = Carried::nothing(0.0);
    let histories = committed.chunks(own(edged)).zip(trial.chunks_mut(own(edged)));
    for (foot, (committed, trial)) in feet.zip(histories) {
        let lever = now.lever(foot.r);
        let (d0, v0) = plane.seen(&before.lever(foot.r));
        let (d, v) = plane.seen(&lever);
        let was = edged && committed[CONTACT] != 0.0;
        let past = foot.is_past(&d, was);
        let (mut f, mut k, mut c) = ([0.0; 3], [0.0; 9], [0.0; 9]);
        let mut energy = Energy::default();
        foot.contact.respond(
            &Kinematics::new([&foot.lifted(d, past), &v], [&foot.lifted(d0, was), &v0], at.dt),
            committed,
            trial,
            &mut Response::new(&mut f, &mut k, &mut c, &mut energy),
        );
        if edged {
            trial[CONTACT] = f64::from(u8::from(past));
        }
        if past && !was {
            // What the spring held is lost where it slips over the edge.
            let pressed = (-d0[0] - foot.contact.opening).max(0.0);
            energy.hysteretic += 0.5 * foot.contact.kn * pressed * pressed;
        }
        out.count(&energy);

        let axes = plane.0.transpose();
        let block = |m: &[f64; 9]| rows(&(axes * Matrix3::from_row_slice(m) * plane.0));
        let f = (axes * Vector3::from(f)).into();
        all.add((&now.turn, &now.spin), &lever, (&f, &block(&k), &block(&c)));
    }
    all.finish(&rows(&turn.jacobian));
    Wrench::new(&all, out.energy)
}

/// How a node stands and moves.
struct Stand {
    turn: Rotation<f64>,
    d: V3<f64>,
    v: V3<f64>,
    spin: V3<f64>,
}

impl Stand {
    fn new(turn: &Turn, d: &[f64], v: &[f64]) -> Self {
        let three = |x: &[f64]| [x[0], x[1], x[2]];
        Self { turn: turn.rotation(), d: three(d), v: three(v), spin: three(&v[3..]) }
    }

    fn lever(&self, r: Vector3<f64>) -> Lever<f64> {
        Lever::new(&r.into(), &self.turn, [&self.d, &self.v, &self.spin])
    }
}

impl Plane {
    /// Displacement and velocity of a point in its axes.
    fn seen(&self, lever: &Lever<f64>) -> ([f64; 3], [f64; 3]) {
        let own = |x: V3<f64>| (self.0 * Vector3::from(x)).into();
        (own(lever.way), own(lever.rate))
    }
}

/// Stiffness of a body at rest by one closed contact at `r`: `kn` along the normal, `shear` across.
pub(crate) fn stiffness(plane: &Plane, r: Vector3<f64>, kn: f64, shear: f64) -> SMatrix<f64, 6, 6> {
    let own = Matrix3::from_diagonal(&Vector3::new(kn, shear, shear));
    let mut map = SMatrix::<f64, 3, 6>::zeros();
    map.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
    map.fixed_view_mut::<3, 3>(0, 3).copy_from(&-r.cross_matrix());
    map.transpose() * (plane.0.transpose() * own * plane.0) * map
}

/// How far each point is from the plane that it stands on or hangs over, unloaded, m.
pub(crate) fn gaps(
    plane: &Plane,
    feet: impl Iterator<Item = Foot>,
    d: &[f64],
    turn: &Turn,
) -> impl Iterator<Item = f64> {
    feet.map(|foot| {
        let moved = Vector3::new(d[0], d[1], d[2]) + turn.shift(foot.r);
        (plane.0 * moved)[0] + foot.contact.opening
    })
}

/// What each point does; `history`: the trial of the answer.
pub(crate) fn contacts(
    plane: &Plane,
    feet: impl Iterator<Item = Foot>,
    at: &Kinematics<'_>,
    turn: &Turn,
    history: &[f64],
    edged: bool,
    out: &mut Vec<Contact>,
) {
    let now = Stand::new(turn, at.d, at.v);
    for (foot, history) in feet.zip(history.chunks(own(edged))) {
        let (d, v) = plane.seen(&now.lever(foot.r));
        let d = foot.lifted(d, edged && history[CONTACT] != 0.0);
        let at = Kinematics::still(&d, &v);
        let (mut f, mut k, mut c) = ([0.0; 3], [0.0; 9], [0.0; 9]);
        let (mut energy, mut trial) = (Energy::default(), [0.0; CONTACT]);
        foot.contact.respond(
            &at,
            history,
            &mut trial,
            &mut Response::new(&mut f, &mut k, &mut c, &mut energy),
        );
        foot.contact.contacts(&at, history, &f, out);
    }
}
