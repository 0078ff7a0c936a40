//! The law of a body on base points over [`Real`], for sweeps in lanes: the text of its scalar form, point by point.
//!
//! In a plane, X and Z, it has three coordinates: the others are zero, and are put beside them.

use super::RockingBody;
use super::law::{BASE, TURNED};
use crate::NLinkHistory;
use crate::nlink::{NLinkContact, PULL};
use crate::shared::lever::{Carried, Lever};
use crate::shared::spatial::{M3, Rotation, V3, angle, right_jacobian};
use crate::shared::wrench::gyroscopic;
use trilith_element::History;
use trilith_element::lanes::{LaneAt, LaneContact, LaneForce, LaneForm, LaneLaw, LaneStep, Real};

/// The contact under a point, in the axes Z, X, Y.
type Contact<const FLAGS: u8> = NLinkContact<2, FLAGS>;

const CONTACT: usize = NLinkHistory::FIELDS.len();
/// Parameters of a contact; those of the body before all contacts, and those of a point.
const NUMBERS: usize = 9;
const OWN: usize = 4;
const POINT: usize = 3;

/// Coordinates in a plane.
const PLANE: [usize; 3] = [0, 2, 4];

/// A body of `N` coordinates on `POINTS` base points; `FLAGS` of their contacts.
struct Standing<const N: usize, const POINTS: usize, const FLAGS: u8>;

/// The axes of a contact in global ones: along X is its second, along Y its third, along Z its first.
const AXES: [usize; 3] = [1, 2, 0];

/// The body at one moment.
struct Moment<R> {
    turn: Rotation<R>,
    /// φ since the start of the step.
    by: V3<R>,
    d: V3<R>,
    v: V3<R>,
    spin: V3<R>,
}

impl<R: Real> Moment<R> {
    #[inline(always)]
    fn lever(&self, r: &V3<R>) -> Lever<R> {
        Lever::new(r, &self.turn, [&self.d, &self.v, &self.spin])
    }
}

/// Way and rate of a point as the contact under it sees them.
#[inline(always)]
fn seen<R: Real>(x: &V3<R>) -> V3<R> {
    [x[2], x[0], x[1]]
}

impl<const N: usize, const POINTS: usize, const FLAGS: u8> Standing<N, POINTS, FLAGS> {
    /// All six of some coordinates.
    #[inline(always)]
    fn all<R: Real>(x: &[R]) -> [V3<R>; 2] {
        if N == 6 {
            return [[x[0], x[1], x[2]], [x[3], x[4], x[5]]];
        }
        let zero = x[0].of(0.0);
        [[x[0], zero, x[1]], [zero, x[2], zero]]
    }

    #[inline(always)]
    fn moment<R: Real>(history: &[R], d: &[R], v: &[R]) -> Moment<R> {
        let ([d, theta], [v, spin]) = (Self::all(d), Self::all(v));
        let by = [theta[0] - history[0], theta[1] - history[1], theta[2] - history[2]];
        let quaternion = [history[3], history[4], history[5], history[6]];
        Moment { turn: Rotation::new(&quaternion, &by), by, d, v, spin }
    }

    /// A point, and the parameters of its contact.
    #[inline(always)]
    fn point<R: Real>(parameters: &[R], i: usize) -> (V3<R>, [R; NUMBERS]) {
        let (own, points) = parameters.split_at(OWN + NUMBERS);
        let mut contact: [R; NUMBERS] = own[OWN..].try_into().expect("numbers of a contact");
        let [x, y, z] = points[POINT * i..][..POINT] else { unreachable!("three of a point") };
        // Its clearance: how high it is above the lowest.
        contact[1] = z - contact[1];
        ([x, y, z], contact)
    }

    #[inline(always)]
    fn history<R: Real>(of: &[R], i: usize) -> &[R] {
        &of[BASE + CONTACT * i..][..CONTACT]
    }

    /// Forces and tangents; with a trial history the end of the step as well.
    #[inline(always)]
    fn stand<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        mut trial: Option<&mut [R]>,
    ) -> LaneStep<R> {
        let zero = at.dt.of(0.0);
        let before = Self::moment(at.history, at.d0, at.v0);
        let now = Self::moment(at.history, at.d, at.v);
        let mut all = Carried::nothing(zero);
        let mut sum = LaneStep::elastic(zero);
        let mut uplift = at.dt.of(f64::NEG_INFINITY);
        for i in 0..POINTS {
            let (r, numbers) = Self::point(at.parameters, i);
            let (start, end) = (before.lever(&r), now.lever(&r));
            let (d0, v0) = (seen(&start.way), seen(&start.rate));
            let (d, v) = (seen(&end.way), seen(&end.rate));
            let history = Self::history(at.history, i);
            let asked =
                LaneAt { parameters: &numbers, d: &d, v: &v, d0: &d0, v0: &v0, dt: at.dt, history };
            let (mut f, mut k, mut c) = ([zero; 3], [zero; 9], [zero; 9]);
            let mut force = LaneForce { f: &mut f, k: &mut k, c: &mut c };
            match &mut trial {
                None => Contact::<FLAGS>::force(&asked, &mut force),
                Some(trial) => {
                    let own = &mut trial[BASE + CONTACT * i..][..CONTACT];
                    let step = Contact::<FLAGS>::respond(&asked, &mut force, own);
                    sum.stored = sum.stored + step.stored;
                    sum.hysteretic = sum.hysteretic + step.hysteretic;
                    sum.viscous = sum.viscous + step.viscous;
                    uplift = uplift.max(d[0] + numbers[1]);
                }
            }
            let [x, y, z] = AXES;
            let (f, k, c) = ([f[x], f[y], f[z]], Self::block(&k), Self::block(&c));
            all.add((&now.turn, &now.spin), &end, (&f, &k, &c));
        }
        all.finish(&right_jacobian(&now.by));
        let inertia = [at.parameters[1], at.parameters[2], at.parameters[3]];
        let (moment, by_spin) = gyroscopic(&inertia, &now.spin);
        for i in 0..3 {
            all.f[3 + i] = all.f[3 + i] + moment[i];
            for j in 0..3 {
                all.c[3 + i][3 + j] = all.c[3 + i][3 + j] + by_spin[i][j];
            }
        }
        for i in 0..N {
            let row = if N == 6 { i } else { PLANE[i] };
            out.f[i] = all.f[row];
            for j in 0..N {
                let column = if N == 6 { j } else { PLANE[j] };
                out.k[N * i + j] = all.k[row][column];
                out.c[N * i + j] = all.c[row][column];
            }
        }
        if let Some(trial) = trial {
            let [_, theta] = Self::all(at.d);
            trial[..3].copy_from_slice(&theta);
            trial[3..TURNED].copy_from_slice(&now.turn.quaternion);
            let m = &now.turn.matrix;
            let axis = [m[0][2], m[1][2], m[2][2]];
            let tilt = angle(axis[2], axis[0].hypot(axis[1]));
            trial[TURNED..BASE].copy_from_slice(&[tilt, axis[0], axis[1], uplift]);
        }
        sum
    }

    /// A tangent of a contact in global axes.
    #[inline(always)]
    fn block<R: Real>(m: &[R; 9]) -> M3<R> {
        let mut block = [[m[0]; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                block[i][j] = m[3 * AXES[i] + AXES[j]];
            }
        }
        block
    }
}

impl<const N: usize, const POINTS: usize, const FLAGS: u8> LaneLaw for Standing<N, POINTS, FLAGS> {
    const COORDINATES: usize = N;
    const HISTORY: usize = BASE + CONTACT * POINTS;
    const PARAMETERS: usize = OWN + NUMBERS + POINT * POINTS;
    const CONTACTS: usize = POINTS;
    const FALLS: bool = true;

    #[inline(always)]
    fn force<R: Real>(at: &LaneAt<'_, R>, out: &mut LaneForce<'_, R>) {
        Self::stand(at, out, None);
    }

    #[inline(always)]
    fn commit<R: Real>(at: &LaneAt<'_, R>, _: &[R], trial: &mut [R]) -> LaneStep<R> {
        let zero = at.dt.of(0.0);
        let (mut f, mut k, mut c) = ([zero; N], [[zero; N]; N], [[zero; N]; N]);
        let (k, c) = (k.as_flattened_mut(), c.as_flattened_mut());
        Self::stand(at, &mut LaneForce { f: &mut f, k, c }, Some(trial))
    }

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        Self::stand(at, out, Some(trial))
    }

    #[inline(always)]
    fn contacts<R: Real>(at: &LaneAt<'_, R>, _: &[R], out: &mut [LaneContact<R>]) -> R {
        let (zero, one) = (at.dt.of(0.0), at.dt.of(1.0));
        let now = Self::moment(at.history, at.d, at.v);
        for (i, out) in out.chunks_mut(1).enumerate() {
            let (r, parameters) = Self::point(at.parameters, i);
            let lever = now.lever(&r);
            let (d, v) = (seen(&lever.way), seen(&lever.rate));
            let history = Self::history(at.history, i);
            let parameters = &parameters;
            let asked = LaneAt { parameters, d: &d, v: &v, d0: &d, v0: &v, dt: zero, history };
            let (mut f, mut k, mut c) = ([zero; 3], [zero; 9], [zero; 9]);
            let mut force = LaneForce { f: &mut f, k: &mut k, c: &mut c };
            Contact::<FLAGS>::force(&asked, &mut force);
            Contact::<FLAGS>::contacts(&asked, &f, out);
        }
        one.only(at.parameters[0].le(at.history[TURNED]))
    }
}

impl RockingBody {
    /// The body over lanes, where it has base points on the ground and moves in space or in X and Z.
    pub(super) fn form(&self, active: &[bool]) -> Option<LaneForm> {
        if self.above.is_some() || self.rim_radius.is_some() {
            return None;
        }
        let (contact, pulls) = (self.contact([0.0, 0.0, self.lowest()]), self.pull);
        let [j1, j2, j3] = self.inertia.unwrap_or_default();
        let (numbers, _) = contact.numbers();
        let mut parameters = vec![self.overturned, j1, j2, j3];
        parameters.extend(&numbers[..NUMBERS]);
        parameters[OWN + 1] = self.lowest();
        parameters.extend(self.base.iter().flatten());
        let plane = (0..6).all(|i| !active[i] || PLANE.contains(&i));
        let make = |law: fn(Vec<usize>, Vec<f64>) -> LaneForm, at: &[usize]| {
            Some(law(at.to_vec(), parameters))
        };
        let space = [0, 1, 2, 3, 4, 5];
        match (plane, self.base.len(), pulls) {
            (true, 2, false) => make(LaneForm::of::<Standing<3, 2, 0>>, &PLANE),
            (true, 2, true) => make(LaneForm::of::<Standing<3, 2, PULL>>, &PLANE),
            (true, 4, false) => make(LaneForm::of::<Standing<3, 4, 0>>, &PLANE),
            (true, 4, true) => make(LaneForm::of::<Standing<3, 4, PULL>>, &PLANE),
            (false, 4, false) => make(LaneForm::of::<Standing<6, 4, 0>>, &space),
            (false, 4, true) => make(LaneForm::of::<Standing<6, 4, PULL>>, &space),
            (false, 8, false) => make(LaneForm::of::<Standing<6, 8, 0>>, &space),
            (false, 8, true) => make(LaneForm::of::<Standing<6, 8, PULL>>, &space),
            _ => None,
        }
    }
}
