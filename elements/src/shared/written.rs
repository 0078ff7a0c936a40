//! A law that is written once, over lanes, and serves its link by that text.

use trilith_element::lanes::{LaneAt, LaneForce, LaneForm, LaneLaw, respond};
use trilith_element::{Kinematics, Response};

type Ask = fn(&LaneAt<'_, f64>, &mut [f64], &mut Response<'_>);

/// One of the laws that a link may have, by its parameters.
#[derive(Clone, Copy)]
pub(crate) struct Written {
    ask: Ask,
    form: fn(Vec<usize>, Vec<f64>) -> LaneForm,
    coordinates: usize,
    parameters: usize,
    /// It looks at rates.
    rate: bool,
}

/// The answers of a link that has a `law` and its `numbers`.
macro_rules! answers_by_law {
    () => {
        fn respond(
            &self,
            at: &trilith_element::Kinematics<'_>,
            committed: &[f64],
            trial: &mut [f64],
            out: &mut trilith_element::Response<'_>,
        ) {
            self.law().respond(&self.numbers(), (at, committed), trial, out);
        }

        fn lanes(&self, _: &[bool]) -> Option<trilith_element::lanes::LaneForm> {
            Some(self.law().lanes(&self.numbers()))
        }
    };
}
pub(crate) use answers_by_law;

impl Written {
    pub(crate) const fn of<L: LaneLaw>() -> Self {
        Self {
            ask: ask::<L>,
            form: LaneForm::of::<L>,
            coordinates: L::COORDINATES,
            parameters: L::PARAMETERS,
            rate: true,
        }
    }

    /// The same where it does not look at rates.
    pub(crate) const fn still(self) -> Self {
        Self { rate: false, ..self }
    }

    /// What the link answers. Of the numbers the law takes as many as it has parameters.
    pub(crate) fn respond(
        &self,
        numbers: &[f64],
        (at, committed): (&Kinematics<'_>, &[f64]),
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let asked = LaneAt::new(at, committed, &numbers[..self.parameters]);
        (self.ask)(&asked, trial, out);
    }

    /// The form of a link of which all coordinates matter.
    pub(crate) fn lanes(&self, numbers: &[f64]) -> LaneForm {
        let coordinates = (0..self.coordinates).collect();
        let form = (self.form)(coordinates, numbers[..self.parameters].to_vec());
        if self.rate { form } else { form.without_rate() }
    }
}

fn ask<L: LaneLaw>(at: &LaneAt<'_, f64>, trial: &mut [f64], out: &mut Response<'_>) {
    let mut force = LaneForce { f: out.f, k: out.k, c: out.c };
    *out.energy = respond::<L>(at, &mut force, trial).into();
}
