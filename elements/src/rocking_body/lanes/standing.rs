//! A body on base points over [`Real`], for sweeps in lanes: the text of its scalar form, point by point.

use super::{OWN, PLANE, SPACE, answer, moment, store};
use crate::NLinkHistory;
use crate::nlink::{CONTACT_PARAMETERS, NLinkContact};
use crate::rocking_body::RockingBody;
use crate::rocking_body::law::{BASE, TURNED};
use crate::rocking_body::moment::Moment;
use crate::shared::lever::{Carried, Lever};
use crate::shared::spatial::{M3, V3};
use trilith_element::History;
use trilith_element::lanes::{LaneAt, LaneContact, LaneForce, LaneForm, LaneLaw, LaneStep, Real};

/// The contact under a point, in the axes Z, X, Y.
type Contact = NLinkContact<2, 0>;

const CONTACT: usize = NLinkHistory::FIELDS.len();
/// Parameters of a contact, and those of a point.
const NUMBERS: usize = CONTACT_PARAMETERS[0];
const POINT: usize = 3;

/// A body of `N` coordinates on `POINTS` base points.
struct Standing<const N: usize, const POINTS: usize>;

/// The axes of a contact in global ones: along X is its second, along Y its third, along Z its first.
const AXES: [usize; 3] = [1, 2, 0];

#[inline(always)]
fn lever<R: Real>(of: &Moment<R>, r: &V3<R>) -> Lever<R> {
    Lever::new(r, &of.turn, [&of.d, &of.v, &of.spin])
}

/// Way and rate of a point as the contact under it sees them.
#[inline(always)]
fn seen<R: Real>(x: &V3<R>) -> V3<R> {
    [x[2], x[0], x[1]]
}

impl<const N: usize, const POINTS: usize> Standing<N, POINTS> {
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

impl<const N: usize, const POINTS: usize> LaneLaw for Standing<N, POINTS> {
    const COORDINATES: usize = N;
    const HISTORY: usize = BASE + CONTACT * POINTS;
    const PARAMETERS: usize = OWN + NUMBERS + POINT * POINTS;
    const CONTACTS: usize = POINTS;
    const FALLS: bool = true;
    const IS_LONG: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let zero = at.dt.of(0.0);
        let before = moment::<N, R>(at.history, at.d0, at.v0);
        let now = moment::<N, R>(at.history, at.d, at.v);
        let mut all = Carried::nothing(zero);
        let mut sum = LaneStep::elastic(zero);
        let mut uplift = at.dt.of(f64::NEG_INFINITY);
        for i in 0..POINTS {
            let (r, numbers) = Self::point(at.parameters, i);
            let (start, end) = (lever(&before, &r), lever(&now, &r));
            let (d0, v0) = (seen(&start.way), seen(&start.rate));
            let (d, v) = (seen(&end.way), seen(&end.rate));
            let history = Self::history(at.history, i);
            let asked =
                LaneAt { parameters: &numbers, d: &d, v: &v, d0: &d0, v0: &v0, dt: at.dt, history };
            let (mut f, mut k, mut c) = ([zero; 3], [zero; 9], [zero; 9]);
            let mut force = LaneForce { f: &mut f, k: &mut k, c: &mut c };
            let own = &mut trial[BASE + CONTACT * i..][..CONTACT];
            let step = Contact::respond(&asked, &mut force, own);
            sum.stored = sum.stored + step.stored;
            sum.hysteretic = sum.hysteretic + step.hysteretic;
            sum.viscous = sum.viscous + step.viscous;
            uplift = uplift.max(d[0] + numbers[1]);
            let [x, y, z] = AXES;
            let (f, k, c) = ([f[x], f[y], f[z]], Self::block(&k), Self::block(&c));
            all.add((&now.turn, &now.spin), &end, (&f, &k, &c));
        }
        all.finish(&now.jacobian);
        answer::<N, R>(all, at.parameters, &now.spin, out);
        store(&now, uplift, &mut trial[..BASE]);
        sum
    }

    #[inline(always)]
    fn contacts<R: Real>(at: &LaneAt<'_, R>, _: &[R], out: &mut [LaneContact<R>]) -> R {
        let (zero, one) = (at.dt.of(0.0), at.dt.of(1.0));
        let now = moment::<N, R>(at.history, at.d, at.v);
        for (i, out) in out.chunks_mut(1).enumerate() {
            let (r, parameters) = Self::point(at.parameters, i);
            let lever = lever(&now, &r);
            let (d, v) = (seen(&lever.way), seen(&lever.rate));
            let history = Self::history(at.history, i);
            let parameters = &parameters;
            let asked = LaneAt { parameters, d: &d, v: &v, d0: &d, v0: &v, dt: zero, history };
            let (mut f, mut k, mut c) = ([zero; 3], [zero; 9], [zero; 9]);
            let mut force = LaneForce { f: &mut f, k: &mut k, c: &mut c };
            Contact::force(&asked, &mut force);
            Contact::contacts(&asked, &f, out);
        }
        one.only(at.parameters[0].le(at.history[TURNED]))
    }
}

/// A body on base points, with the parameters of every body.
pub(super) fn form(body: &RockingBody, mut parameters: Vec<f64>, plane: bool) -> Option<LaneForm> {
    let (numbers, _) = body.contact([0.0, 0.0, body.lowest()]).numbers();
    parameters.extend(&numbers[..NUMBERS]);
    parameters[OWN + 1] = body.lowest();
    parameters.extend(body.base.iter().flatten());
    let make = |law: fn(Vec<usize>, Vec<f64>) -> LaneForm, at: &[usize]| {
        Some(law(at.to_vec(), parameters))
    };
    match (plane, body.base.len()) {
        (true, 2) => make(LaneForm::of::<Standing<3, 2>>, &PLANE),
        (true, 4) => make(LaneForm::of::<Standing<3, 4>>, &PLANE),
        (false, 4) => make(LaneForm::of::<Standing<6, 4>>, &SPACE),
        (false, 8) => make(LaneForm::of::<Standing<6, 8>>, &SPACE),
        _ => None,
    }
}
