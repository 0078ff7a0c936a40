//! The law of the [`RockingBody`]: attitude, gyroscopic moment, and the contact of its base.

use super::moment::{Moment, posture};
use super::rim::{Rim, RimHistory};
use super::{RockingBody, outline};
use crate::shared::plane_contact::{self, Foot, GROUND};
use crate::shared::rotation::{Turn, Turned};
use crate::shared::two_bodies::{self, Turns, View};
use crate::shared::wrench::{Wrench, add_gyroscopic};
use nalgebra::{SMatrix, Vector3};
use std::borrow::Cow;
use trilith_element::lanes::LaneForm;
use trilith_element::{
    Contact, Coordinates, Field, Geometry, History, Kinematics, Link, Outline, ParameterError,
    Response, history, sub,
};

history! {
    /// How the body stands.
    pub(super) struct Posture {
        /// Angle between the body's vertical axis and the vertical.
        tilt: "rad",
        /// Horizontal part of the body's vertical axis, a vector of length 1: along X and Y.
        lean1: "1",
        lean2: "1",
        /// How high the highest point of the base is above the unloaded ground; below zero: pressed into it.
        uplift: "m",
    }
}

impl Posture {
    fn after(turn: &Turn, uplift: f64) -> Self {
        let [tilt, lean1, lean2, uplift] = posture(&turn.rotation(), uplift);
        Self { tilt, lean1, lean2, uplift }
    }
}

/// The history in its order: how the body has turned, its posture, its base, and how what it stands on has turned.
pub(super) const TURNED: usize = Turned::FIELDS.len();
pub(super) const BASE: usize = TURNED + Posture::FIELDS.len();

impl RockingBody {
    /// The rim, for a body with a circular base.
    pub(super) fn rim(&self) -> Option<Rim> {
        let Self { kn, damping, mu, arc_stiffness, .. } = *self;
        let (radius, depth) = (self.rim_radius?, self.rim_depth?);
        let ks = self.ks.unwrap_or_default();
        Some(Rim { radius, depth, kn, damping, mu, ks, arc_stiffness })
    }

    /// The base points.
    fn feet(&self) -> impl Iterator<Item = Foot> {
        self.base.iter().map(|r| Foot {
            r: Vector3::from(*r),
            contact: self.contact(*r),
            edge: None,
        })
    }

    /// How high the highest point of the base is above what it stands on, unloaded, m.
    fn uplift(&self, d: &[f64], turn: &Turn) -> f64 {
        match self.rim() {
            Some(rim) => rim.uplift(&[d[0], d[1], d[2]], &turn.rotation()),
            None => {
                plane_contact::gaps(&GROUND, self.feet(), d, turn).fold(f64::NEG_INFINITY, f64::max)
            }
        }
    }

    /// What the base does to the body as it moves over what it stands on.
    fn stand(
        &self,
        at: &Kinematics<'_>,
        turns: (&Turn, &Turn),
        committed: &[f64],
        trial: &mut [f64],
    ) -> Wrench {
        match self.rim() {
            Some(rim) => {
                let before = Moment::of(turns.0, at.d0, at.v0);
                let now = Moment::of(turns.1, at.d, at.v);
                let (base, step) = rim.respond((&before, &now), at.dt, committed, trial);
                Wrench::new(&base, step.into())
            }
            None => {
                plane_contact::respond(&GROUND, self.feet(), at, turns, committed, trial, false)
            }
        }
    }

    /// How both nodes have turned, for a body that stands on another.
    pub(super) fn both(&self, history: &[f64]) -> Option<(Vector3<f64>, [Turned; 2])> {
        let offset = self.above?;
        let support = Turned::load(&history[history.len() - TURNED..]);
        Some((Vector3::from(offset), [support, Turned::load(history)]))
    }

    /// First coordinate of the body.
    fn first(&self) -> usize {
        if self.above.is_some() { 6 } else { 0 }
    }

    /// The body as what it stands on sees it.
    fn seen<T>(
        &self,
        at: &Kinematics<'_>,
        history: &[f64],
        look: impl FnOnce(&Kinematics<'_>, &Turn) -> T,
    ) -> T {
        let Some((offset, turned)) = self.both(history) else {
            return look(at, &Turned::load(history).turn(&at.d[3..6]));
        };
        let turns = [turned[0].turn(&at.d[3..6]), turned[1].turn(&at.d[9..12])];
        let view = View::<0>::new(offset, turns.each_ref(), at.d, at.v, None);
        let [d, v] = view.values();
        look(&Kinematics::new([&d, &v], [&d, &v], at.dt), &view.turn)
    }
}

impl Link for RockingBody {
    fn place(&mut self, at: &Geometry<'_>) -> Result<(), ParameterError> {
        if let [support, body] = at.nodes {
            self.above = Some(sub(*body, *support));
        }
        Ok(())
    }

    fn coordinates(&self) -> Coordinates {
        Coordinates::Nodal { nodes: if self.above.is_some() { 2 } else { 1 } }
    }

    fn turning_node(&self) -> Option<usize> {
        Some(usize::from(self.above.is_some()))
    }

    fn history(&self) -> Cow<'static, [Field]> {
        let mut fields = [Turned::FIELDS, Posture::FIELDS].concat();
        fields.extend(match self.rim() {
            Some(_) => RimHistory::FIELDS.to_vec(),
            None => plane_contact::fields(self.base.len(), false),
        });
        if self.above.is_some() {
            let of = |f: &Field| Field::named(format!("support_{}", f.name), f.unit);
            fields.extend(Turned::FIELDS.iter().map(of));
        }
        fields.into()
    }

    fn at_rest(&self, at: &mut [f64]) {
        let upright = Turned::upright();
        upright.store(at);
        if self.above.is_some() {
            let end = at.len() - TURNED;
            upright.store(&mut at[end..]);
        }
        let uplift = self.uplift(&[0.0; 6], &upright.turn(&[0.0; 3]));
        Posture { uplift, ..Posture::default() }.store(&mut at[TURNED..]);
        match self.rim() {
            Some(_) => RimHistory::closed().store(&mut at[BASE..]),
            None => plane_contact::at_rest(self.feet(), false, &mut at[BASE..]),
        }
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let mut sum = SMatrix::<f64, 6, 6>::zeros();
        let shear = if self.mu > 0.0 { self.ks.unwrap_or(0.0) } else { 0.0 };
        let stand = |r| plane_contact::stiffness(&GROUND, r, self.kn, shear);
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
        match self.above {
            Some(offset) => two_bodies::stiffness(Vector3::from(offset), &sum, k),
            None => {
                for i in 0..6 {
                    for j in 0..6 {
                        k[6 * i + j] = 0.5 * (sum[(i, j)] + sum[(j, i)]);
                    }
                }
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
        let base = BASE..committed.len() - if self.above.is_some() { TURNED } else { 0 };
        let first = self.first();
        let theta = &at.d[first + 3..first + 6];
        let (turn, uplift);
        if let Some((offset, was)) = self.both(committed) {
            let turns = Turns::new(&was, at);
            let mut high = 0.0;
            let law = |seen: &Kinematics<'_>, between: (&Turn, &Turn)| {
                high = self.uplift(seen.d, between.1);
                self.stand(seen, between, &committed[base.clone()], &mut trial[base.clone()])
            };
            two_bodies::respond(offset, &turns, at, law, out);
            let [support, own] = turns.end;
            Turned::after(&at.d[3..6], &support).store(&mut trial[base.end..]);
            (turn, uplift) = (own, high);
        } else {
            let was = Turned::load(committed);
            let (start, end) = (was.turn(&at.d0[3..6]), was.turn(theta));
            self.stand(at, (&start, &end), &committed[base.clone()], &mut trial[base.clone()])
                .write(out);
            uplift = self.uplift(at.d, &end);
            turn = end;
        }
        let inertia = self.inertia.unwrap_or_default();
        add_gyroscopic(inertia, &at.v[first + 3..first + 6], first + 3, out);
        Turned::after(theta, &turn).store(trial);
        Posture::after(&turn, uplift).store(&mut trial[TURNED..]);
    }

    fn lanes(&self, active: &[bool]) -> Option<LaneForm> {
        self.form(active)
    }

    fn contacts(&self, at: &Kinematics<'_>, history: &[f64], _: &[f64], out: &mut Vec<Contact>) {
        let base = &history[BASE..];
        self.seen(at, history, |at, turn| match self.rim() {
            Some(rim) => {
                out.extend(rim.contacts(&Moment::of(turn, at.d, at.v), base).map(Contact::from));
            }
            None => plane_contact::contacts(&GROUND, self.feet(), at, turn, base, false, out),
        });
    }

    fn outline(&self, at: &Kinematics<'_>, history: &[f64]) -> Option<Outline> {
        let d = &at.d[self.first()..];
        let turn = Turned::load(history).turn(&d[3..6]);
        let above = self.above.unwrap_or_default();
        let mut body = outline::upright(self);
        for point in &mut body.points {
            let moved = Vector3::from(*point) + turn.shift(Vector3::from(*point));
            *point = [0, 1, 2].map(|i| above[i] + d[i] + moved[i]);
        }
        Some(body)
    }

    fn overturned(&self, _: &Kinematics<'_>, history: &[f64]) -> bool {
        Posture::load(&history[TURNED..]).tilt >= self.overturned
    }
}
