//! Round bodies side by side, as the first sees the second.
//!
//! ```text
//!   p = s + R z e₃,   n = (p₁, p₂, 0)/|(p₁, p₂)|      the second's axis at a height, and the way to it
//!   gap = |(p₁, p₂)| − r₁ − r₂
//!   ρ = R z e₃ − r₂ n                                 from the second's node to where it touches
//!   t = e₃ × n                                        across
//!   Δ = Δs + ΔR r̄,  r̄: mean of Rᵀρ over the step      way of the material that is there; slip t·Δ and e₃·Δ
//! ```

use super::BodyContact;
use crate::NLinkHistory;
use crate::shared::dual::{Dual, Dual3, cross, dot, times, transposed_times};
use crate::shared::plane_contact::{Plane, stiffness};
use crate::shared::rotation::Turn;
use crate::shared::wrench::Wrench;
use nalgebra::{Matrix3, SMatrix, Vector3};
use trilith_element::{Contact, Energy, Field, History, Kinematics, Link, Response, history};

history! {
    /// Way of the material across and along the axis of the first body, after the contact's own variables.
    struct Way {
        across: "m",
        along: "m",
    }
}

const CONTACT: usize = NLinkHistory::FIELDS.len();
const OWN: usize = CONTACT + Way::FIELDS.len();

/// By u, φ, u̇ and Ω.
type Number = Dual<12>;
type V3 = Dual3<12>;

/// Two round bodies.
pub(super) struct Round<'a> {
    pub of: &'a BodyContact,
    pub radii: [f64; 2],
}

/// Where and how they touch at one height, at one moment.
struct Touch {
    u: V3,
    r: [V3; 3],
    /// Out of the first, and across.
    normal: V3,
    across: V3,
    gap: Number,
    /// From the second's node to the touch in the axes of the first, and in its own.
    lever: V3,
    point: V3,
    /// Rates along normal, across and axis.
    rate: V3,
}

impl Round<'_> {
    fn touch(&self, height: f64, turn: &Turn, d: &[f64], v: &[f64]) -> Touch {
        let u: V3 = Number::variables(&d[..3], 0);
        let rate: V3 = Number::variables(&v[..3], 6);
        let spin: V3 = Number::variables(&v[3..6], 9);
        let r = turn.dual::<12>(3);
        let zero = Number::constant(0.0);
        let up = [zero, zero, Number::constant(1.0)];
        let axis = times(&r, &up).map(|x| x * height);
        let shift = turn.shift(Vector3::new(0.0, 0.0, height));
        let offset = self.of.offset;
        let place = |i: usize| u[i] + axis[i].map(shift[i], 1.0) + offset[i];
        let (x, y) = (place(0), place(1));
        // Bodies whose axes cross are past all contact; any direction will do.
        let apart = (x * x + y * y).sqrt();
        let normal = if apart.x > 0.0 { [x / apart, y / apart, zero] } else { [up[2], zero, zero] };
        let across = cross(&up, &normal);
        let [r1, r2] = self.radii;
        let lever: V3 = [0, 1, 2].map(|i| axis[i] - normal[i] * r2);
        let point = transposed_times(&r, &lever);
        let turning = times(&r, &cross(&spin, &point));
        let moving: V3 = [0, 1, 2].map(|i| rate[i] + turning[i]);
        Touch {
            gap: apart + -(r1 + r2),
            rate: [dot(&normal, &moving), dot(&across, &moving), moving[2]],
            u,
            r,
            normal,
            across,
            lever,
            point,
        }
    }

    pub fn fields(&self) -> Vec<Field> {
        let of = |place: usize| {
            let all = NLinkHistory::FIELDS.iter().chain(Way::FIELDS);
            all.map(move |f| Field::named(format!("{}_{place}", f.name), f.unit))
        };
        (1..=self.of.heights.len()).flat_map(of).collect()
    }

    pub fn at_rest(&self, at: &mut [f64]) {
        at.chunks_mut(OWN).for_each(|own| self.of.contact(0.0).at_rest(own));
    }

    /// The gap at each height, m.
    pub fn gaps(&self, at: &Kinematics<'_>, turn: &Turn) -> impl Iterator<Item = f64> {
        self.of.heights.iter().map(|height| self.touch(*height, turn, at.d, at.v).gap.x)
    }

    /// Stiffness of the second body at rest where it touches at all heights.
    pub fn stiffness(&self, shear: f64) -> SMatrix<f64, 6, 6> {
        let [x, y, _] = self.of.offset;
        let apart = x.hypot(y);
        let (x, y) = if apart > 0.0 { (x / apart, y / apart) } else { (1.0, 0.0) };
        let plane = Plane(Matrix3::new(x, y, 0.0, -y, x, 0.0, 0.0, 0.0, 1.0));
        let r2 = self.radii[1];
        let at = |z: &f64| Vector3::new(-r2 * x, -r2 * y, *z);
        self.of.heights.iter().map(|z| stiffness(&plane, at(z), self.of.kn, shear)).sum()
    }

    /// Forces, tangents and energies over a step.
    pub fn respond(
        &self,
        at: &Kinematics<'_>,
        (start, turn): (&Turn, &Turn),
        committed: &[f64],
        trial: &mut [f64],
    ) -> Wrench {
        let mut out = Wrench::default();
        let contact = self.of.contact(0.0);
        let histories = committed.chunks(OWN).zip(trial.chunks_mut(OWN));
        for (height, (committed, trial)) in self.of.heights.iter().zip(histories) {
            let before = self.touch(*height, start, at.d0, at.v0);
            let now = self.touch(*height, turn, at.d, at.v);
            let was = Way::load(&committed[CONTACT..]);
            let [across, along] = way(&before, &now);
            let d = [now.gap, across + was.across, along + was.along];
            let (mut f, mut k, mut c) = ([0.0; 3], [0.0; 9], [0.0; 9]);
            let mut energy = Energy::default();
            contact.respond(
                &Kinematics::new(
                    [&d.map(|x| x.x), &now.rate.map(|x| x.x)],
                    [&[before.gap.x, was.across, was.along], &before.rate.map(|x| x.x)],
                    at.dt,
                ),
                committed,
                trial,
                &mut Response::new(&mut f, &mut k, &mut c, &mut energy),
            );
            Way { across: d[1].x, along: d[2].x }.store(&mut trial[CONTACT..]);
            out.count(&energy);

            let part: V3 = [0, 1, 2].map(|i| {
                let mut sum = Number::constant(f[i]);
                for j in 0..3 {
                    for (x, (by_d, by_v)) in
                        sum.by.iter_mut().zip(d[j].by.iter().zip(&now.rate[j].by))
                    {
                        *x += k[3 * i + j] * by_d + c[3 * i + j] * by_v;
                    }
                }
                sum
            });
            let along = [Number::constant(0.0), Number::constant(0.0), part[2]];
            let force: V3 =
                [0, 1, 2].map(|i| now.normal[i] * part[0] + now.across[i] * part[1] + along[i]);
            let moment = transposed_times(&now.r, &cross(&now.lever, &force));
            for (i, x) in force.iter().chain(&moment).enumerate() {
                out.f[i] += x.x;
                for j in 0..6 {
                    out.k[(i, j)] += x.by[j];
                    out.c[(i, j)] += x.by[6 + j];
                }
            }
        }
        out
    }

    /// What each height does; `history`: the trial of the answer.
    pub fn contacts(
        &self,
        at: &Kinematics<'_>,
        turn: &Turn,
        history: &[f64],
        out: &mut Vec<Contact>,
    ) {
        let contact = self.of.contact(0.0);
        for (height, history) in self.of.heights.iter().zip(history.chunks(OWN)) {
            let now = self.touch(*height, turn, at.d, at.v);
            let way = Way::load(&history[CONTACT..]);
            let d = [now.gap.x, way.across, way.along];
            let v = now.rate.map(|x| x.x);
            let at = Kinematics::still(&d, &v);
            let (mut f, mut k, mut c) = ([0.0; 3], [0.0; 9], [0.0; 9]);
            let (mut energy, mut trial) = (Energy::default(), [0.0; CONTACT]);
            contact.respond(
                &at,
                history,
                &mut trial,
                &mut Response::new(&mut f, &mut k, &mut c, &mut energy),
            );
            contact.contacts(&at, history, &f, out);
        }
    }
}

/// Way of the material over a step, across and along.
fn way(before: &Touch, now: &Touch) -> [Number; 2] {
    let plain = |x: &V3| x.map(|x| Number::constant(x.x));
    let (u0, r0) = (plain(&before.u), before.r.each_ref().map(plain));
    let half = |a: &V3, b: &V3| -> V3 { [0, 1, 2].map(|i| (a[i] + b[i]) * 0.5) };
    let point = half(&plain(&before.point), &now.point);
    let across = half(&plain(&before.across), &now.across);
    let (to, from) = (times(&now.r, &point), times(&r0, &point));
    let way: V3 = [0, 1, 2].map(|i| now.u[i] - u0[i] + to[i] - from[i]);
    [dot(&across, &way), way[2]]
}
