//! Laws whose energies do not close, however short the steps are.
//!
//! ```text
//! g = Σ ½ (f₀ + f₁)(d₁ − d₀) − Δstored − heat          of one link, in a step made whole (g) and in its halves (g′)
//! ```
//!
//! Of a law that accounts for its work g falls with the cube of the step, and g′ is a quarter of g; where a force jumps
//! inside, that is so again in the next step. Of a law that does not, g is a share of its work in every step, and
//! g′ = g. The march halves such steps in vain, millions of times. So once the energies of a step have not closed, the
//! links are watched, until a step closes: one whose g′ has not fallen below g in so many steps on end is to blame.

use crate::step::{Account, Culprit, State, StepEnergy, Wrong};
use crate::vector::larger;
use trilith_system::LinkSet;

/// Steps on end. Where a force as steep as that of |v|^0.1 goes through zero, sound laws have dozens of such steps, each
/// shorter than the one before; a law that is wrong has millions.
const ON_END: usize = 2000;
/// Share of its work that a law must leave out to be blamed.
const SHARE: f64 = 1e-3;
/// Share of the gap of a whole step that halves leave of it where it does not fall.
const STAYS: f64 = 0.6;

/// A step that was accepted: its start, and its end in one and in two halves with the energies of these.
pub(super) struct Made<'a> {
    pub from: &'a State,
    pub whole: (&'a State, &'a StepEnergy),
    pub first: (&'a State, &'a StepEnergy),
    pub second: (&'a State, &'a StepEnergy),
    /// What rounding may do to its energies, J.
    pub rounding: f64,
}

/// Watches the links while energies do not close.
#[derive(Debug, Default)]
pub(super) struct Closing {
    /// Since when, s; none: nobody is watched.
    since: Option<f64>,
    /// Steps on end in which each link has left out some of its work, and its account over these.
    links: Vec<(usize, Account)>,
}

impl Closing {
    /// The energies of a step from `t` have not closed.
    pub fn suspect(&mut self, t: f64, links: &LinkSet) {
        if self.since.is_none() {
            self.since = Some(t);
            self.links.clear();
            self.links.resize(links.links.len(), Default::default());
        }
    }

    /// True where links are watched.
    #[inline]
    pub fn is_watching(&self) -> bool {
        self.since.is_some()
    }

    /// Looks at an accepted step: the law that is to blame, if there is one by now.
    pub fn look(&mut self, links: &LinkSet, made: &Made<'_>) -> Option<Culprit> {
        let since = self.since?;
        let mut closes = true;
        let mut worst: Option<(usize, Account)> = None;
        for (i, (on_end, sum)) in self.links.iter_mut().enumerate() {
            let of = |from: &State, (to, energy): (&State, &StepEnergy)| {
                Account::of(&links.links[i], i, from, to, &energy.links[i])
            };
            let whole = of(made.from, made.whole);
            let mut halves = of(made.from, made.first);
            halves.add(&of(made.first.0, made.second));
            let (before, now) = (whole.gap(), halves.gap());
            let stays = now.abs() > STAYS * before.abs() && now * before > 0.0;
            if !stays || now.abs() <= larger(SHARE * halves.size, made.rounding) {
                (*on_end, *sum) = Default::default();
                continue;
            }
            closes = false;
            *on_end += 1;
            sum.add(&halves);
            let leaves_out = *on_end >= ON_END && sum.gap().abs() > SHARE * sum.size;
            if leaves_out && worst.is_none_or(|(_, w)| sum.gap().abs() > w.gap().abs()) {
                worst = Some((i, *sum));
            }
        }
        if closes {
            self.since = None;
        }
        worst.map(|(i, Account { work, accounted, .. })| Culprit {
            element: links.links[i].element,
            wrong: Wrong::Energies { since: Some(since), work, accounted },
        })
    }
}
