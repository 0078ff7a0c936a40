//! The law of the [`BodyContact`].

use super::BodyContact;
use super::round::Round;
use crate::shared::plane_contact::{self, stiffness};
use crate::shared::rotation::{Turn, Turned};
use crate::shared::two_bodies::{self, Turns, View};
use crate::shared::wrench::Wrench;
use nalgebra::{SMatrix, Vector3};
use std::borrow::Cow;
use trilith_element::{
    Contact, ContactUse, Coordinates, Field, Geometry, History, Kinematics, Link, ParameterError,
    Response, history,
};

history! {
    /// How near the bodies are.
    struct Near {
        /// Smallest gap of all points or heights; below zero: pressed in, or beside a face and behind it.
        gap: "m",
    }
}

/// The history in its order: how near both are, how they have turned, what each point or height remembers.
const TURNED: usize = Turned::FIELDS.len();
const FIRST: usize = Near::FIELDS.len();
const TOUCH: usize = FIRST + 2 * TURNED;
/// A face whose normal is as steep as this is stood on.
const STEEP: f64 = 0.5;

impl BodyContact {
    fn round(&self) -> Option<Round<'_>> {
        self.radii.map(|radii| Round { of: self, radii })
    }

    /// A face that ends remembers which points are past its edge.
    fn edged(&self) -> bool {
        self.extent.is_some()
    }

    fn both(history: &[f64]) -> [Turned; 2] {
        [0, 1].map(|i| Turned::load(&history[FIRST + i * TURNED..]))
    }

    /// The smallest gap of all points or heights, m.
    fn gap(&self, at: &Kinematics<'_>, turn: &Turn) -> f64 {
        let smallest = |gaps: &mut dyn Iterator<Item = f64>| gaps.fold(f64::INFINITY, f64::min);
        match self.round() {
            Some(round) => smallest(&mut round.gaps(at, turn)),
            None => smallest(&mut plane_contact::gaps(&self.plane(), self.feet(), at.d, turn)),
        }
    }

    /// What touches, as the first body sees the second.
    fn touch(
        &self,
        at: &Kinematics<'_>,
        turns: (&Turn, &Turn),
        committed: &[f64],
        trial: &mut [f64],
    ) -> Wrench {
        match self.round() {
            Some(round) => round.respond(at, turns, committed, trial),
            None => {
                let (plane, feet) = (self.plane(), self.feet());
                plane_contact::respond(&plane, feet, at, turns, committed, trial, self.edged())
            }
        }
    }
}

impl Link for BodyContact {
    fn place(&mut self, at: &Geometry<'_>) -> Result<(), ParameterError> {
        self.set_places(at.nodes)
    }

    fn coordinates(&self) -> Coordinates {
        Coordinates::Nodal { nodes: 2 }
    }

    fn history(&self) -> Cow<'static, [Field]> {
        let turned = |which: &'static str| {
            let name = move |f: &Field| format!("{which}_{}", f.name);
            Turned::FIELDS.iter().map(move |f| Field::named(name(f), f.unit))
        };
        let near = Near::FIELDS.iter().cloned();
        let mut fields: Vec<Field> = near.chain(turned("first")).chain(turned("second")).collect();
        fields.extend(match self.round() {
            Some(round) => round.fields(),
            None => plane_contact::fields(self.points.len(), self.edged()),
        });
        fields.into()
    }

    fn at_rest(&self, at: &mut [f64]) {
        let upright = Turned::upright();
        (0..2).for_each(|i| upright.store(&mut at[FIRST + i * TURNED..]));
        let zero = [0.0; 6];
        let still = Kinematics::still(&zero, &zero);
        Near { gap: self.gap(&still, &upright.turn(&[0.0; 3])) }.store(at);
        match self.round() {
            Some(round) => round.at_rest(&mut at[TOUCH..]),
            None => plane_contact::at_rest(self.feet(), self.edged(), &mut at[TOUCH..]),
        }
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let shear = if self.mu > 0.0 { self.ks.unwrap_or(0.0) } else { 0.0 };
        let sum: SMatrix<f64, 6, 6> = match self.round() {
            Some(round) => round.stiffness(shear),
            None => {
                let plane = self.plane();
                self.feet().map(|foot| stiffness(&plane, foot.r, self.kn, shear)).sum()
            }
        };
        two_bodies::stiffness(Vector3::from(self.offset), &sum, k);
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let turns = Turns::new(&Self::both(committed), at);
        let mut gap = 0.0;
        let touch = |seen: &Kinematics<'_>, between: (&Turn, &Turn)| {
            gap = self.gap(seen, between.1);
            self.touch(seen, between, &committed[TOUCH..], &mut trial[TOUCH..])
        };
        two_bodies::respond(Vector3::from(self.offset), &turns, at, touch, out);
        Near { gap }.store(trial);
        for (i, turn) in turns.end.iter().enumerate() {
            let theta = &at.d[6 * i + 3..6 * i + 6];
            Turned::after(theta, turn).store(&mut trial[FIRST + i * TURNED..]);
        }
    }

    fn contacts(&self, at: &Kinematics<'_>, history: &[f64], _: &[f64], out: &mut Vec<Contact>) {
        let [first, second] = Self::both(history);
        let turns = [first.turn(&at.d[3..6]), second.turn(&at.d[9..12])];
        let view = View::<0>::new(Vector3::from(self.offset), turns.each_ref(), at.d, at.v, None);
        let [d, v] = view.values();
        let seen = Kinematics::still(&d, &v);
        let touch = &history[TOUCH..];
        match self.round() {
            Some(round) => round.contacts(&seen, &view.turn, touch, out),
            None => {
                let (plane, feet) = (self.plane(), self.feet());
                plane_contact::contacts(&plane, feet, &seen, &view.turn, touch, self.edged(), out);
            }
        }
    }

    fn contact_use(&self) -> ContactUse {
        let stood_on = self.radii.is_none() && self.frame().0[0][2] > STEEP;
        if stood_on { ContactUse::Standing } else { ContactUse::Stop }
    }
}
