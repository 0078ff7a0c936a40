//! The law of the [`NLink`].

use super::NLink;
use crate::shared::restitution::damping_ratio;
use crate::shared::sliding::{Axial, Normal, exponential, radial_return, share_before};
use nalgebra::Vector2;
use std::borrow::Cow;
use trilith_element::{
    Axis, Contact, Coordinates, Field, History, Impact, Kinematics, Link, Response, history,
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

impl NLink {
    fn normal(&self, d1: f64, v1: f64) -> Normal {
        let axial = Axial { kn: self.kn, damping: self.damping, pull: self.pull };
        axial.normal(d1 + self.opening, v1)
    }

    /// Friction coefficient and its derivative by the sliding speed.
    fn coefficient(&self, speed: f64) -> (f64, f64) {
        match (self.mu_slow, self.mu_fast, self.rate) {
            (Some(slow), Some(fast), Some(rate)) => exponential(slow, fast, rate, speed),
            _ => (self.mu.unwrap_or(0.0), 0.0),
        }
    }

    /// Stiffness of the elastic–plastic branch, N/m; 0 without friction.
    fn elastic(&self) -> f64 {
        if self.has_friction() { self.ks.unwrap_or(0.0) - self.k_post } else { 0.0 }
    }

    /// Restoring stiffness at a spring force, N/m.
    fn restoring(&self, spring: f64) -> f64 {
        self.k_post + if self.radius > 0.0 { spring / self.radius } else { 0.0 }
    }
}

/// Position of the anchor at the start of the step, or at the moment of closing within the step, and
/// its derivatives: by dₜ (a factor) and by d₁.
fn anchor(link: &NLink, at: &Kinematics<'_>, was: &NLinkHistory) -> ([f64; 2], f64, [f64; 2]) {
    let gap0 = at.d0[0] + link.opening;
    if gap0 <= 0.0 {
        return ([was.anchor2, was.anchor3], 0.0, [0.0; 2]);
    }
    // Closed at the end, so gap < = 0 < gap0 and the share of the step before contact is in (0, 1].
    let gap = at.d[0] + link.opening;
    let (share, by_gap) = share_before(gap0, gap);
    let delta = [at.d[1] - at.d0[1], at.d[2] - at.d0[2]];
    let start = [at.d0[1] + share * delta[0], at.d0[2] + share * delta[1]];
    (start, share, delta.map(|x| x * by_gap))
}

impl Link for NLink {
    fn coordinates(&self) -> Coordinates {
        let mut axes = vec![Axis::U1, Axis::U2, Axis::U3];
        axes.extend(self.rotational().map(|(axis, _)| axis));
        Coordinates::Local(axes)
    }

    fn history(&self) -> Cow<'static, [Field]> {
        NLinkHistory::FIELDS.into()
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
        let was = NLinkHistory::load(committed);
        let before = self.normal(at.d0[0], at.v0[0]);
        let now = self.normal(at.d[0], at.v[0]);
        let (dt0, dt1) = ([at.d0[1], at.d0[2]], [at.d[1], at.d[2]]);

        // Axial.
        out.f[0] = now.f;
        out.k[0] = now.f_d;
        out.c[0] = now.f_v;
        out.energy.stored = 0.5 * now.spring * now.spring / self.kn;
        out.energy.viscous = at.viscous_work(0, before.f + before.spring, now.f + now.spring);

        // Friction: radial return of the elastic trial force onto the cone.
        let ke = self.elastic();
        let old = [was.anchor2, was.anchor3];
        let tau0 =
            if before.closed { [ke * (dt0[0] - old[0]), ke * (dt0[1] - old[1])] } else { [0.0; 2] };
        let (mut start, mut end, mut tau1) = (if before.closed { old } else { dt0 }, dt1, [0.0; 2]);
        if now.closed {
            let (a, by_dt, by_d1) = anchor(self, at, &was);
            start = a;
            let tangents = self.friction(at, &now, ke, a);
            tau1 = tangents.tau;
            if ke > 0.0 {
                end = [dt1[0] - tau1[0] / ke, dt1[1] - tau1[1] / ke];
                if !tangents.slips {
                    end = a;
                }
            }
            for i in 0..2 {
                let row = (1 + i) * n;
                out.k[row] = tangents.by_d1[i];
                out.c[row] = tangents.by_v1[i];
                for j in 0..2 {
                    let stretch = tangents.by_xi[i][j];
                    out.k[row + 1 + j] = stretch * (1.0 - by_dt);
                    out.k[row] -= stretch * by_d1[j];
                    out.c[row + 1 + j] = tangents.by_vt[i][j];
                }
            }
        }

        // Restoring forces: post-slip spring and pendulum.
        let (kr0, kr1) = (
            if before.closed { self.restoring(before.spring) } else { 0.0 },
            if now.closed { self.restoring(now.spring) } else { 0.0 },
        );
        let by_spring = if now.closed && self.radius > 0.0 { self.kn / self.radius } else { 0.0 };
        let mut restoring = was.restoring;
        for i in 0..2 {
            out.f[1 + i] = tau1[i] + kr1 * dt1[i];
            out.k[(1 + i) * n + 1 + i] += kr1;
            out.k[(1 + i) * n] -= by_spring * dt1[i];
            restoring += 0.5 * (kr0 * dt0[i] + kr1 * dt1[i]) * (dt1[i] - dt0[i]);
        }
        let slip = [end[0] - start[0], end[1] - start[1]];
        let friction = 0.5 * ((tau0[0] + tau1[0]) * slip[0] + (tau0[1] + tau1[1]) * slip[1]);
        out.energy.hysteretic = friction.max(0.0);
        out.energy.stored += restoring;
        if ke > 0.0 {
            out.energy.stored += 0.5 * (tau1[0] * tau1[0] + tau1[1] * tau1[1]) / ke;
        }

        // Rotational springs.
        for (i, (_, r)) in self.rotational().enumerate() {
            let theta = at.d[3 + i];
            out.f[3 + i] = r * theta;
            out.k[(3 + i) * (n + 1)] = r;
            out.energy.stored += 0.5 * r * theta * theta;
        }

        let path = if now.closed && ke > 0.0 { slip[0].hypot(slip[1]) } else { 0.0 };
        NLinkHistory {
            anchor2: end[0],
            anchor3: end[1],
            slip: was.slip + path,
            closed: f64::from(u8::from(now.closed)),
            restoring,
        }
        .store(trial);
    }

    fn impact(&self) -> Option<Impact> {
        Some(Impact {
            coordinate: 0,
            stiffness: self.kn,
            damping: self.damping,
            restitution: self.restitution,
            mass: self.impact_mass,
        })
    }

    fn restituting(&self, restitution: f64, mass: f64) -> Option<Box<dyn Link>> {
        let damping = 2.0 * damping_ratio(restitution, self.pull) * (self.kn * mass).sqrt();
        Some(Box::new(Self { damping, restitution: None, impact_mass: None, ..self.clone() }))
    }

    fn contacts(&self, at: &Kinematics<'_>, _: &[f64], f: &[f64], out: &mut Vec<Contact>) {
        let now = self.normal(at.d[0], at.v[0]);
        let restoring = if now.closed { self.restoring(now.spring) } else { 0.0 };
        let tau = (f[1] - restoring * at.d[1]).hypot(f[2] - restoring * at.d[2]);
        let limit = self.coefficient(at.v[1].hypot(at.v[2])).0 * now.cone;
        out.push(Contact {
            gap: at.d[0] + self.opening,
            normal: now.cone,
            position: [at.d[1], at.d[2]],
            // The force at the limit was scaled onto it: equal up to rounding.
            slipping: now.cone > 0.0 && self.elastic() > 0.0 && tau >= limit * (1.0 - 1e-9),
        });
    }
}

/// Friction force and its derivatives.
#[derive(Default)]
struct Friction {
    slips: bool,
    tau: [f64; 2],
    /// By the elastic trial deformation ξ = dₜ − a.
    by_xi: [[f64; 2]; 2],
    /// By ḋₜ, through the friction coefficient.
    by_vt: [[f64; 2]; 2],
    /// By d₁ and ḋ₁, through the normal force.
    by_d1: [f64; 2],
    by_v1: [f64; 2],
}

impl NLink {
    fn friction(&self, at: &Kinematics<'_>, now: &Normal, ke: f64, a: [f64; 2]) -> Friction {
        if ke <= 0.0 {
            return Friction::default();
        }
        let vt = [at.v[1], at.v[2]];
        let speed = vt[0].hypot(vt[1]);
        let (mu, mu_v) = self.coefficient(speed);
        let stretch = Vector2::new(at.d[1] - a[0], at.d[2] - a[1]);
        let it = radial_return(ke, stretch, mu * now.cone);
        let along = it.by_limit;
        let mut out = Friction {
            slips: it.slips,
            tau: it.tau.into(),
            by_d1: (along * (mu * now.cone_d)).into(),
            by_v1: (along * (mu * now.cone_v)).into(),
            ..Friction::default()
        };
        for i in 0..2 {
            for j in 0..2 {
                out.by_xi[i][j] = it.by_stretch[(i, j)];
                if speed > 0.0 {
                    out.by_vt[i][j] = along[i] * now.cone * mu_v * vt[j] / speed;
                }
            }
        }
        out
    }
}
