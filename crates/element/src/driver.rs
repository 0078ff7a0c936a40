//! One law led along imposed deformations, step by step.

use crate::{Contact, Energy, Kinematics, Link, Response};

/// Everything that a law answers to one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Force, N or N·m; `n` entries.
    pub f: Vec<f64>,
    /// Tangent ∂f/∂d, row by row, `n²` entries.
    pub k: Vec<f64>,
    /// Tangent ∂f/∂ḋ, row by row, `n²` entries.
    pub c: Vec<f64>,
    /// Stored energy at the end of the step, and what became heat in it, J.
    pub energy: Energy,
    /// History at the end of the step. A variable that the law has not written is NaN.
    pub trial: Vec<f64>,
}

impl Answer {
    /// Asks a law once. One that does not [use rates](Link::uses_rates) is given NaN for them, as it is in a run.
    #[must_use]
    pub fn of(link: &dyn Link, at: &Kinematics<'_>, committed: &[f64]) -> Self {
        if link.uses_rates() {
            return Self::told_rates(link, at, committed);
        }
        let none = vec![f64::NAN; at.d.len()];
        Self::told_rates(link, &Kinematics { v: &none, v0: &none, ..*at }, committed)
    }

    /// [Why](Link::refusal) a law has no answer to a question, asked as in [`of`](Self::of).
    #[must_use]
    pub fn refusal(link: &dyn Link, at: &Kinematics<'_>, committed: &[f64]) -> Option<String> {
        if link.uses_rates() {
            return link.refusal(at, committed);
        }
        let none = vec![f64::NAN; at.d.len()];
        link.refusal(&Kinematics { v: &none, v0: &none, ..*at }, committed)
    }

    /// The same with rates, whatever the law says of them.
    pub(crate) fn told_rates(link: &dyn Link, at: &Kinematics<'_>, committed: &[f64]) -> Self {
        let n = at.d.len();
        let (mut f, mut k, mut c) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]);
        let (mut energy, mut trial) = (Energy::default(), vec![f64::NAN; committed.len()]);
        let mut out = Response { f: &mut f, k: &mut k, c: &mut c, energy: &mut energy };
        link.respond(at, committed, &mut trial, &mut out);
        Self { f, k, c, energy, trial }
    }
}

/// A law under imposed deformations: every step is committed, energies and work are added up. For
/// tests of a law against closed forms, beside the [conformance kit](crate::conformance).
///
/// ```
/// use trilith_element::Driver;
/// # use trilith_element::*;
/// # #[derive(Debug)] struct Slider;
/// # impl Link for Slider {
/// #     fn coordinates(&self) -> Coordinates { Coordinates::Local(vec![Axis::U1]) }
/// #     fn history(&self) -> std::borrow::Cow<'static, [Field]> { vec![Field::new("slip", "m")].into() }
/// #     fn engaged_stiffness(&self, k: &mut [f64]) { k[0] = 10.0 }
/// #     fn respond(&self, at: &Kinematics<'_>, was: &[f64], trial: &mut [f64], out: &mut Response<'_>) {
/// #         let elastic = 10.0 * (at.d[0] - was[0]);
/// #         out.f[0] = elastic.clamp(-5.0, 5.0);
/// #         out.k[0] = if elastic == out.f[0] { 10.0 } else { 0.0 };
/// #         trial[0] = at.d[0] - out.f[0] / 10.0;
/// #         out.energy.stored = 0.05 * out.f[0] * out.f[0];
/// #         out.energy.hysteretic = out.f[0] * (trial[0] - was[0]);
/// #     }
/// # }
/// // A spring of 10 N/m behind a slider that holds 5 N.
/// let mut driver = Driver::new(&Slider);
/// assert_eq!(driver.to(&[0.25]), [2.5]);
/// assert_eq!(driver.to(&[2.0]), [5.0]);
/// assert_eq!(driver.history, [1.5]);
/// assert_eq!(driver.energy.hysteretic, 5.0 * 1.5);
/// // Back with a rate of −1 m/s in a quarter of a second: nothing slips.
/// assert_eq!(driver.step(&[1.75], &[-1.0], 0.25), [2.5]);
/// assert_eq!(driver.k, [10.0]);
/// assert_eq!(driver.heat(), 7.5);
/// ```
#[derive(Clone, Debug)]
pub struct Driver<'a> {
    link: &'a dyn Link,
    /// Deformation at the end of the last step, m or rad.
    pub d: Vec<f64>,
    /// Rate there.
    pub v: Vec<f64>,
    /// Committed history.
    pub history: Vec<f64>,
    /// Force at the end of the last step, N or N·m.
    pub f: Vec<f64>,
    /// ∂f/∂d there, row by row.
    pub k: Vec<f64>,
    /// ∂f/∂ḋ there, row by row.
    pub c: Vec<f64>,
    /// Energy stored now; hysteretic and viscous heat of all steps, J.
    pub energy: Energy,
    /// Work of the force in all steps by the trapezoidal rule, J.
    pub work: f64,
    /// Sum of the absolute work of all steps, J: the measure of errors.
    pub turned_over: f64,
    /// Energy stored at the start, J.
    stored_before: f64,
}

impl<'a> Driver<'a> {
    /// Before anything has happened: undeformed and at rest.
    #[must_use]
    pub fn new(link: &'a dyn Link) -> Self {
        let zeros = vec![0.0; link.coordinates().len()];
        Self::starting_at(link, &zeros, &zeros)
    }

    /// Before anything has happened, at another deformation and rate. No step has been taken; force,
    /// tangents and stored energy are those that the law has there.
    ///
    /// # Panics
    /// Where `d` or `v` has not one entry for each coordinate.
    #[must_use]
    pub fn starting_at(link: &'a dyn Link, d: &[f64], v: &[f64]) -> Self {
        let n = link.coordinates().len();
        assert!(d.len() == n && v.len() == n, "{link:?} has {n} coordinates");
        let mut history = vec![0.0; link.history().len()];
        link.at_rest(&mut history);
        let start = Answer::of(link, &Kinematics { d, v, d0: d, v0: v, dt: 0.0 }, &history);
        let (d, v) = (d.to_vec(), v.to_vec());
        let energy = Energy { stored: start.energy.stored, ..Energy::default() };
        Self {
            link,
            d,
            v,
            history,
            f: start.f,
            k: start.k,
            c: start.c,
            energy,
            work: 0.0,
            turned_over: 0.0,
            stored_before: energy.stored,
        }
    }

    /// The question of a step from here to `d` and `v` in `dt` (s).
    #[must_use]
    pub fn toward<'b>(&'b self, d: &'b [f64], v: &'b [f64], dt: f64) -> Kinematics<'b> {
        Kinematics { d, v, d0: &self.d, v0: &self.v, dt }
    }

    /// Asks from here without taking a step.
    #[must_use]
    pub fn ask(&self, at: &Kinematics<'_>) -> Answer {
        Answer::of(self.link, at, &self.history)
    }

    /// Why the law has no answer to a question from here, in its own words.
    #[must_use]
    pub fn refusal(&self, at: &Kinematics<'_>) -> Option<String> {
        Answer::refusal(self.link, at, &self.history)
    }

    /// Takes a step to deformation `d` (m or rad) and rate `v` in `dt` (s); the force at its end.
    ///
    /// # Panics
    /// Where `d` or `v` has not one entry for each coordinate.
    pub fn step(&mut self, d: &[f64], v: &[f64], dt: f64) -> &[f64] {
        let n = self.d.len();
        assert!(d.len() == n && v.len() == n, "{:?} has {n} coordinates", self.link);
        let answer = self.ask(&self.toward(d, v, dt));
        self.commit(d, v, answer);
        &self.f
    }

    /// Takes a static step: no time, no rates; the force at its end.
    ///
    /// # Panics
    /// Where `d` has not one entry for each coordinate.
    pub fn to(&mut self, d: &[f64]) -> &[f64] {
        self.step(d, &vec![0.0; d.len()], 0.0)
    }

    /// Takes the step whose answer is known.
    pub(crate) fn commit(&mut self, d: &[f64], v: &[f64], answer: Answer) {
        let ends = self.f.iter().zip(&answer.f);
        let moved = d.iter().zip(&self.d).map(|(d, d0)| d - d0);
        let work: f64 = ends.zip(moved).map(|((f0, f), moved)| 0.5 * (f0 + f) * moved).sum();
        self.work += work;
        self.turned_over += work.abs();
        self.energy.stored = answer.energy.stored;
        self.energy.hysteretic += answer.energy.hysteretic;
        self.energy.viscous += answer.energy.viscous;
        self.d.copy_from_slice(d);
        self.v.copy_from_slice(v);
        (self.history, self.f) = (answer.trial, answer.f);
        (self.k, self.c) = (answer.k, answer.c);
    }

    /// Hysteretic and viscous heat of all steps, J.
    #[must_use]
    pub fn heat(&self) -> f64 {
        self.energy.hysteretic + self.energy.viscous
    }

    /// Change of the stored energy since the start plus the heat of all steps, J: what
    /// [`work`](Self::work) must come to, up to the error of the steps.
    #[must_use]
    pub fn accounted(&self) -> f64 {
        self.energy.stored - self.stored_before + self.heat()
    }

    /// What the contacts of the law do now.
    #[must_use]
    pub fn contacts(&self) -> Vec<Contact> {
        let at = Kinematics { d: &self.d, v: &self.v, d0: &self.d, v0: &self.v, dt: 0.0 };
        let mut contacts = Vec::new();
        self.link.contacts(&at, &self.history, &self.f, &mut contacts);
        contacts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Axis, Coordinates, Field};
    use std::borrow::Cow;

    const K: f64 = 10.0;
    const YIELD: f64 = 5.0;
    const C: f64 = 2.0;

    /// An elastic–plastic spring beside a dashpot; by the way it forgets to write a second variable.
    #[derive(Debug)]
    struct Law;

    impl Link for Law {
        fn coordinates(&self) -> Coordinates {
            Coordinates::Local(vec![Axis::U1])
        }
        fn history(&self) -> Cow<'static, [Field]> {
            vec![Field::new("slip", "m"), Field::new("forgotten", "1")].into()
        }
        fn at_rest(&self, at: &mut [f64]) {
            at[1] = 7.0;
        }
        fn engaged_stiffness(&self, k: &mut [f64]) {
            k[0] = K;
        }
        fn respond(
            &self,
            at: &Kinematics<'_>,
            was: &[f64],
            trial: &mut [f64],
            out: &mut Response<'_>,
        ) {
            let spring = (K * (at.d[0] - was[0])).clamp(-YIELD, YIELD);
            trial[0] = at.d[0] - spring / K;
            out.f[0] = spring + C * at.v[0];
            out.c[0] = C;
            out.energy.stored = 0.5 * spring * spring / K;
            out.energy.hysteretic = spring * (trial[0] - was[0]);
            out.energy.viscous = at.viscous_work(0, C * at.v0[0], C * at.v[0]);
        }
        fn contacts(&self, at: &Kinematics<'_>, was: &[f64], f: &[f64], out: &mut Vec<Contact>) {
            out.push(Contact { gap: at.d[0] - was[0], normal: f[0], ..Contact::default() });
        }
    }

    #[test]
    fn a_start_is_no_step() {
        let driver = Driver::starting_at(&Law, &[0.25], &[1.0]);
        assert_eq!((driver.f[0], driver.c[0], driver.energy.stored), (4.5, 2.0, 0.3125));
        assert_eq!(driver.history, [0.0, 7.0]);
        assert_eq!((driver.work, driver.heat(), driver.accounted()), (0.0, 0.0, 0.0));
    }

    #[test]
    fn a_question_leaves_no_trace_and_a_step_does() {
        let mut driver = Driver::new(&Law);
        let answer = driver.ask(&driver.toward(&[2.0], &[0.0], 0.0));
        assert_eq!((answer.f[0], answer.trial[0]), (5.0, 1.5));
        assert_eq!((driver.d[0], driver.f[0], driver.history[0]), (0.0, 0.0, 0.0));
        driver.to(&[2.0]);
        assert_eq!((driver.d[0], driver.f[0], driver.history[0]), (2.0, 5.0, 1.5));
        assert!(driver.history[1].is_nan(), "what is not written shows");
        assert_eq!((driver.contacts()[0].gap, driver.contacts()[0].normal), (0.5, 5.0));
    }

    /// There and back at a constant rate: the spring slips by 1.5 m and by 1 m, the dashpot moves 4 m.
    #[test]
    fn work_stored_energy_and_heat_add_up() {
        let mut driver = Driver::starting_at(&Law, &[0.0], &[0.5]);
        for i in 1..=400 {
            driver.step(&[0.005 * f64::from(i)], &[0.5], 0.01);
        }
        let (work, over) = (driver.work, driver.turned_over);
        assert!((driver.energy.hysteretic - 5.0 * 1.5).abs() < 1e-9);
        assert!((driver.energy.viscous - C * 0.5 * 2.0).abs() < 1e-9);
        assert!((driver.energy.stored - 0.5 * YIELD * YIELD / K).abs() < 1e-9);
        assert!((work - (7.5 + 2.0 + 1.25)).abs() < 1e-9 && (over - work).abs() < 1e-9);
        // Back without rates: 0.5 m give the stored energy back, the rest slips.
        for i in (0..400).rev() {
            driver.to(&[0.005 * f64::from(i)]);
        }
        assert!((driver.energy.hysteretic - 5.0 * (1.5 + 1.0)).abs() < 1e-9);
        assert!((driver.work - driver.accounted()).abs() < 0.01, "{driver:?}");
        assert!((driver.turned_over - driver.work - 2.0 * 1.25).abs() < 0.01, "{driver:?}");
    }

    #[test]
    #[should_panic(expected = "Law has 1 coordinates")]
    fn a_step_of_another_size_is_refused() {
        Driver::new(&Law).to(&[0.0, 0.0]);
    }
}
