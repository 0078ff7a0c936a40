//! The law of the [`NLink`].

use super::NLink;
use super::contact::{NLinkContact, PARAMETERS, RESTORING, UNDAMPED, VARIED};
use crate::shared::restitution::damping_ratio;
use std::borrow::Cow;
use trilith_element::lanes::{
    LaneAt, LaneContact, LaneForce, LaneForm, LaneLaw, LaneStep, respond,
};
use trilith_element::{
    Axis, Contact, ContactUse, Coordinates, Field, History, Impact, Kinematics, Link, Response,
    history,
};

history! {
    /// History of one contact.
    pub struct NLinkHistory {
        /// Anchor of the friction along U2: where the tangential spring is unstretched.
        pub anchor2: "m",
        /// Anchor of the friction along U3.
        pub anchor3: "m",
        /// Length of the slip path so far.
        pub slip: "m",
        /// 1 while closed; for records.
        pub closed: "1",
        /// Work of the restoring forces (post-slip spring and pendulum) so far.
        pub restoring: "J",
    }
}

history! {
    /// What a contact remembers beside its [`NLinkHistory`] where its friction looks at the slip or has a dashpot.
    pub struct NLinkRubbing {
        /// Rate of slip.
        pub slip_rate: "m/s",
        /// Length of the slip path since it last stuck.
        pub unstuck: "m",
        /// Force of the dashpot beside the spring along U2.
        pub damped2: "N",
        /// Force of the dashpot beside the spring along U3.
        pub damped3: "N",
    }
}

impl NLink {
    /// True for friction that looks at the slip or has a dashpot.
    fn is_varied(&self) -> bool {
        self.mu_slow.is_some() || self.mu_static.is_some() || self.cs > 0.0
    }

    /// Friction coefficients of slow and of fast slip.
    fn graded(&self) -> [f64; 2] {
        let mu = self.mu.unwrap_or(0.0);
        [self.mu_slow.unwrap_or(mu), self.mu_fast.unwrap_or(mu)]
    }

    /// Stiffness of the elastic–plastic branch, N/m; 0 without friction.
    fn elastic(&self) -> f64 {
        if self.has_friction() { self.ks.unwrap_or(0.0) - self.k_post } else { 0.0 }
    }
}

impl NLink {
    /// Which parts the contact has.
    fn flags(&self) -> u8 {
        let part = |is: bool, flag: u8| if is { flag } else { 0 };
        let restoring = part(self.k_post > 0.0 || self.radius > 0.0, RESTORING);
        if self.damping == 0.0 && !self.is_varied() {
            return UNDAMPED | restoring;
        }
        // Friction that is much to compute anyway has the restoring forces with it, of whatever size.
        if self.is_varied() { VARIED | RESTORING } else { restoring }
    }

    /// The parameters of the contact; what is not for its flags is left out.
    pub(crate) fn numbers(&self) -> ([f64; PARAMETERS[1]], usize) {
        let plain = [
            self.kn,
            self.opening,
            self.damping,
            self.elastic(),
            self.mu.unwrap_or(0.0),
            self.k_post,
            if self.radius > 0.0 { self.radius.recip() } else { 0.0 },
            self.kn.recip(),
            if self.elastic() > 0.0 { self.elastic().recip() } else { 0.0 },
            f64::from(u8::from(self.pull)),
        ];
        let mut all = [0.0; PARAMETERS[1]];
        all[..PARAMETERS[0]].copy_from_slice(&plain);
        if !self.is_varied() {
            return (all, PARAMETERS[0]);
        }
        let [slow, fast] = self.graded();
        let away = self.mu_static.map_or(0.0, |mu| mu - slow);
        let varied = [slow, fast, self.rate.unwrap_or(0.0), away, self.static_slip, self.cs];
        all[PARAMETERS[0]..].copy_from_slice(&varied);
        (all, PARAMETERS[1])
    }
}

/// Calls a function of the law with the flags as a constant.
macro_rules! with_flags {
    ($flags:expr, $t:literal, $law:ident => $call:expr) => {
        with_flags!(@ $flags, $t, $law, $call, 0 2 6 8 10)
    };
    (@ $flags:expr, $t:literal, $law:ident, $call:expr, $($flag:literal)*) => {
        match $flags {
            $($flag => { type $law = NLinkContact<$t, $flag>; $call })*
            _ => unreachable!("what `flags` gives"),
        }
    };
}

impl Link for NLink {
    fn coordinates(&self) -> Coordinates {
        let mut axes = vec![Axis::U1, Axis::U2, Axis::U3];
        axes.extend(self.rotational().map(|(axis, _)| axis));
        Coordinates::Local(axes)
    }

    fn history(&self) -> Cow<'static, [Field]> {
        if self.is_varied() {
            [NLinkHistory::FIELDS, NLinkRubbing::FIELDS].concat().into()
        } else {
            NLinkHistory::FIELDS.into()
        }
    }

    fn at_rest(&self, at: &mut [f64]) {
        let closed = f64::from(u8::from(self.opening <= 0.0));
        NLinkHistory { closed, ..Default::default() }.store(at);
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let n = self.coordinates().len();
        // A pendulum without friction is held by the weight on it, which is not known here.
        let shear = match self.elastic() + self.k_post {
            k if k == 0.0 && self.radius > 0.0 => 1e-3 * self.kn,
            k => k,
        };
        k[0] = self.kn;
        k[n + 1] = shear;
        k[2 * n + 2] = shear;
        for (i, (_, r)) in self.rotational().enumerate() {
            k[(3 + i) * (n + 1)] = r;
        }
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let n = at.d.len();
        let (numbers, count) = self.numbers();
        let asked = LaneAt {
            parameters: &numbers[..count],
            d: &at.d[..3],
            v: &at.v[..3],
            d0: &at.d0[..3],
            v0: &at.v0[..3],
            dt: at.dt,
            history: committed,
        };
        let (mut k, mut c) = ([0.0; 9], [0.0; 9]);
        let mut force = LaneForce { f: &mut out.f[..3], k: &mut k, c: &mut c };
        let step: LaneStep<f64> = with_flags!(self.flags(), 2, Law => {
            respond::<Law>(&asked, &mut force, trial)
        });
        for i in 0..3 {
            out.k[i * n..i * n + 3].copy_from_slice(&k[3 * i..3 * i + 3]);
            out.c[i * n..i * n + 3].copy_from_slice(&c[3 * i..3 * i + 3]);
        }
        *out.energy = step.into();

        // Rotational springs.
        for (i, (_, r)) in self.rotational().enumerate() {
            let theta = at.d[3 + i];
            out.f[3 + i] = r * theta;
            out.k[(3 + i) * (n + 1)] = r;
            out.energy.stored += 0.5 * r * theta * theta;
        }
    }

    fn lanes(&self, active: &[bool]) -> Option<LaneForm> {
        if self.rotational().next().is_some() {
            return None;
        }
        let (numbers, count) = self.numbers();
        let numbers = numbers[..count].to_vec();
        let form = if active[2] {
            with_flags!(self.flags(), 2, Law => LaneForm::of::<Law>(vec![0, 1, 2], numbers))
        } else {
            with_flags!(self.flags(), 1, Law => LaneForm::of::<Law>(vec![0, 1], numbers))
        };
        Some(if self.flags() & UNDAMPED == 0 { form } else { form.without_rate() })
    }

    fn impact(&self) -> Option<Impact> {
        Some(Impact::new(0, self.kn, self.damping).restituting(self.restitution, self.impact_mass))
    }

    fn restituting(&self, restitution: f64, mass: f64) -> Option<Box<dyn Link>> {
        let damping = 2.0 * damping_ratio(restitution, self.pull) * (self.kn * mass).sqrt();
        Some(Box::new(Self { damping, restitution: None, impact_mass: None, ..self.clone() }))
    }

    fn contact_use(&self) -> ContactUse {
        // A pendulum surface is no floor that a body rocks on.
        if self.radius > 0.0 { ContactUse::Bearing } else { ContactUse::Standing }
    }

    fn contacts(&self, at: &Kinematics<'_>, history: &[f64], f: &[f64], out: &mut Vec<Contact>) {
        let (numbers, count) = self.numbers();
        let asked = LaneAt { parameters: &numbers[..count], ..LaneAt::new(at, history, &[]) };
        let mut own = [LaneContact::smooth(0.0, 0.0)];
        with_flags!(self.flags(), 2, Law => Law::contacts(&asked, f, &mut own));
        out.extend(own.map(Contact::from));
    }
}
