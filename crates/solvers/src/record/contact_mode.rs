//! The response mode of bodies that stand on contacts: rest, slide, rock, slide-rock, flight.
//!
//! A body *slides* while every contact that carries load slips: a corner that unloads slips a little as
//! its normal force vanishes, and that is not sliding of the body. It *rocks* when some of its contacts
//! are open while others are closed, and *flies* when all are open. The initial mode is what it does
//! from rest to the first impact or slip reversal.
//!
//! Contacts that no body stands on are stops, which are hit, or bearings, which travel: see the summaries of these.

use super::observer::{Observer, Sample};
use crate::contacts::{BearingSummary, Bearings, Role, Roles, StopSummary, Stops};
use serde::{Deserialize, Serialize};
use trilith_element::Contact;
use trilith_model::Model;
use trilith_system::System;

/// Response mode and extremes of the contacts that bodies stand on.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ContactSummary {
    /// Mode in which the body leaves rest.
    pub initial_mode: &'static str,
    /// Mode over the whole run.
    pub mode: &'static str,
    /// Largest uplift: how high any point of contact was above what it touches, m; 0 where none left it.
    pub max_uplift: f64,
    /// Largest tangential distance of any contact from where it started, m.
    pub max_slip: f64,
    /// Largest tangential distance at the end, m.
    pub residual_slip: f64,
    /// True where a body has fallen over.
    pub overturned: bool,
}

/// What has been seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Seen {
    /// Path made while all loaded contacts slipped, and elastic tangential play for comparison, m.
    pub(crate) slid: f64,
    /// Largest gap while another contact was closed, m.
    pub(crate) rocked: f64,
    /// Largest of the smallest gaps, m: how high the whole body was.
    pub(crate) flew: f64,
}

impl Seen {
    pub(crate) fn mode(self, play: f64) -> &'static str {
        let slides = self.slid > play;
        // In flight the gaps of a body differ by rounding; it rocks where they differ visibly.
        let rocks = self.rocked > 0.05 * self.flew && self.rocked > 0.0;
        match (slides, rocks) {
            (true, true) => "slide-rock",
            (false, true) => "rock",
            _ if self.flew > 0.0 => "flight",
            (true, false) => "slide",
            (false, false) => "rest",
        }
    }
}

/// What a classification goes on from in a run that continues another one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ContactMemory {
    start: Vec<[f64; 2]>,
    /// Distance from the start of every contact where it last carried load, m: a corner that a large
    /// rotation lifts moves sideways without slipping.
    slip: Vec<f64>,
    direction: [f64; 2],
    initial: Seen,
    initial_over: bool,
    whole: Seen,
    play: f64,
    /// False for a model that stands on nothing, such as frames with stops between them; known from the first
    /// sample on.
    stands: Option<bool>,
    max_uplift: f64,
    max_slip: f64,
    residual_slip: f64,
    overturned: bool,
    #[serde(default)]
    stops: Stops,
    #[serde(default)]
    bearings: Bearings,
}

/// Observer that classifies the response of bodies on contacts, counts the hits of stops, and measures the travel of
/// bearings.
#[derive(Debug, Default)]
pub struct ContactMode {
    so_far: ContactMemory,
    before: Vec<Contact>,
    roles: Roles,
    /// The role of every contact of a sample, from the first one on.
    each: Vec<Role>,
}

impl ContactMode {
    /// Nothing seen yet.
    #[must_use]
    pub fn new(model: &Model, system: &System) -> Self {
        Self { roles: Roles::new(model, system), ..Self::default() }
    }

    /// Goes on from what an earlier part of the case left.
    #[must_use]
    pub fn after(mut self, so_far: ContactMemory) -> Self {
        self.so_far = so_far;
        self
    }

    /// What the next part of the case goes on from.
    #[must_use]
    pub fn memory(&self) -> ContactMemory {
        self.so_far.clone()
    }

    /// What the stops saw; `None` for a model without stops.
    #[must_use]
    pub fn stops(&self) -> Option<StopSummary> {
        self.so_far.stops.summary(|element| self.roles.name(element))
    }

    /// What the bearings saw; `None` for a model without bearings.
    #[must_use]
    pub fn bearings(&self) -> Option<BearingSummary> {
        self.so_far.bearings.summary(|element| self.roles.name(element))
    }

    /// The summary; `None` for a model without a body that stands on contacts at the start, or falls onto them.
    #[must_use]
    pub fn summary(&self) -> Option<ContactSummary> {
        let seen = &self.so_far;
        (!seen.start.is_empty()).then(|| ContactSummary {
            initial_mode: seen.initial.mode(seen.play),
            mode: seen.whole.mode(seen.play),
            max_uplift: seen.max_uplift,
            max_slip: seen.max_slip,
            residual_slip: seen.residual_slip,
            overturned: seen.overturned,
        })
    }

    /// Movement of the loaded contacts in this step, if all of them slip.
    fn sliding(&self, now: &[Contact]) -> Option<[f64; 2]> {
        let mut mean = [0.0; 2];
        let mut count = 0.0;
        for (c, b) in now.iter().zip(&self.before) {
            if c.gap < 0.0 && c.normal > 0.0 {
                if !c.slipping {
                    return None;
                }
                for (m, (x, y)) in mean.iter_mut().zip(c.position.iter().zip(b.position)) {
                    *m += x - y;
                }
                count += 1.0;
            }
        }
        (count > 0.0).then(|| mean.map(|m| m / count))
    }

    fn enter(&mut self, now: &[Contact]) {
        let open = |c: &Contact| c.gap > 0.0;
        let impact = now.iter().zip(&self.before).any(|(c, b)| open(b) && !open(c));
        let moved = self.sliding(now);
        let reversal = moved.is_some_and(|m| {
            m[0] * self.so_far.direction[0] + m[1] * self.so_far.direction[1] < 0.0
        });
        if impact || reversal {
            self.so_far.initial_over = true;
        }
        let mut step = Seen::default();
        if let Some(m) = moved {
            step.slid = m[0].hypot(m[1]);
            if step.slid > 0.0 {
                self.so_far.direction = m;
            }
        }
        let highest = now.iter().map(|c| c.gap).fold(f64::MIN, f64::max);
        let lowest = now.iter().map(|c| c.gap).fold(f64::MAX, f64::min);
        if highest > 0.0 && lowest <= 0.0 {
            step.rocked = highest;
        } else if lowest > 0.0 {
            step.flew = lowest;
            step.rocked = highest - lowest;
        }
        let ContactMemory { whole, initial, initial_over, .. } = &mut self.so_far;
        let targets: &mut [&mut Seen] =
            if *initial_over { &mut [whole] } else { &mut [whole, initial] };
        for seen in targets {
            seen.slid += step.slid;
            seen.rocked = seen.rocked.max(step.rocked);
            seen.flew = seen.flew.max(step.flew);
        }
    }
}

impl Observer for ContactMode {
    fn sample(&mut self, sample: &Sample<'_>) {
        if sample.contacts.is_empty() {
            return;
        }
        let Self { so_far, roles, each, .. } = self;
        let stands = *so_far.stands.get_or_insert_with(|| roles.stand(sample.contacts));
        if each.is_empty() {
            *each = roles.each(sample.contacts, stands);
        }
        let each = &*each;
        let of = |role: Role| {
            let all = sample.contacts.iter().zip(each);
            all.filter(move |(_, own)| **own == role).map(|(contact, _)| *contact)
        };
        so_far.stops.enter(sample.t, of(Role::Stop));
        so_far.bearings.enter(sample.t, of(Role::Bearing));
        let now: Vec<Contact> = of(Role::Foot).map(|(_, c)| c).collect();
        if now.is_empty() {
            return;
        }
        if self.so_far.start.is_empty() {
            self.so_far.start = now.iter().map(|c| c.position).collect();
            self.so_far.slip = vec![0.0; now.len()];
            // Play: what the contacts give elastically, of the order of the static penetration.
            self.so_far.play = now.iter().map(|c| (-c.gap).max(0.0)).fold(0.0, f64::max);
        } else if !self.before.is_empty() {
            self.enter(&now);
        }
        let seen = &mut self.so_far;
        for ((c, s), slip) in now.iter().zip(&seen.start).zip(&mut seen.slip) {
            if c.normal > 0.0 {
                *slip = (c.position[0] - s[0]).hypot(c.position[1] - s[1]);
            }
            seen.max_uplift = seen.max_uplift.max(c.gap);
        }
        let slip = seen.slip.iter().fold(0.0_f64, |a, s| a.max(*s));
        seen.max_slip = seen.max_slip.max(slip);
        seen.residual_slip = slip;
        seen.overturned |= sample.overturned.is_some();
        self.before = now;
    }

    fn wants_rates(&self) -> bool {
        false
    }
}
