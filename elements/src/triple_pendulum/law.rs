//! The law of the [`TriplePendulum`].

use super::TriplePendulum;
use super::series::{SURFACES, Series, Speed, Surface, solve};
use crate::shared::sliding::{Axial, Coefficient, Normal, Stop, engaged, share_before};
use nalgebra::{Vector2, Vector3};
use std::borrow::Cow;
use trilith_element::{
    Axis, Contact, ContactUse, Coordinates, Field, Impact, Kinematics, Link, Response,
};

/// Variables of the whole bearing: slip path, closed, number of sliding surfaces, restoring work.
const WHOLE: [(&str, &str); 4] =
    [("slip", "m"), ("closed", "1"), ("sliding", "1"), ("restoring", "J")];
/// Variables of a surface: displacement in series, anchor, sliding speed.
const EACH: [(&str, &str); 5] = [
    ("displacement2_", "m"),
    ("displacement3_", "m"),
    ("anchor2_", "m"),
    ("anchor3_", "m"),
    ("speed_", "m/s"),
];

/// History of a surface.
#[derive(Clone, Copy, Debug, Default)]
struct Past {
    displacement: Vector2<f64>,
    anchor: Vector2<f64>,
    speed: f64,
}

fn load(from: &[f64], i: usize) -> Past {
    let at = &from[WHOLE.len() + i * EACH.len()..];
    Past {
        displacement: Vector2::new(at[0], at[1]),
        anchor: Vector2::new(at[2], at[3]),
        speed: at[4],
    }
}

fn store(past: &Past, to: &mut [f64], i: usize) {
    let (w, a) = (past.displacement, past.anchor);
    let at = &mut to[WHOLE.len() + i * EACH.len()..][..EACH.len()];
    at.copy_from_slice(&[w.x, w.y, a.x, a.y, past.speed]);
}

fn tangential(d: &[f64]) -> Vector2<f64> {
    Vector2::new(d[1], d[2])
}

/// Penetration below which nothing is pressed, m: no force to speak of, and no stiffness to divide by.
const TOUCHING: f64 = 1e-15;

impl TriplePendulum {
    fn normal(&self, d: &[f64], v: &[f64]) -> Normal {
        let axial = Axial { kn: self.kn, damping: self.damping, pull: self.pull };
        axial.normal(d[0], v[0])
    }

    fn presses(&self, normal: &Normal) -> bool {
        normal.cone > TOUCHING * self.kn
    }

    fn friction(&self, i: usize) -> Coefficient {
        match (self.mu, self.mu_slow, self.mu_fast, self.rate) {
            (None, Some(slow), Some(fast), Some(rate)) => {
                Coefficient::Velocity { slow: slow[i], fast: fast[i], rate: rate[i] }
            }
            (mu, ..) => Coefficient::Constant { mu: mu.map_or(0.0, |mu| mu[i]) },
        }
    }

    /// The surfaces of a lifted bearing: its parts share the motion as their radii, up to their stops.
    fn lifted(&self, past: &[Past; SURFACES], total: Vector2<f64>) -> [Vector2<f64>; SURFACES] {
        let (radii, stops) = (self.radii_in_series(), self.stops());
        // Soft against the stops; nothing but the proportions matters.
        let soft = 1e-6 * self.stop_stiffness.unwrap_or(1.0) * radii.iter().sum::<f64>();
        let surfaces = std::array::from_fn(|i| Surface {
            restoring: 0.0,
            ks: soft / radii[i],
            friction: Coefficient::Constant { mu: f64::INFINITY },
            normal: 1.0,
            speed: Speed::Known(0.0),
            stop: stops[i],
            anchor: past[i].displacement,
        });
        let series = solve(&surfaces, total, [Vector2::zeros(); SURFACES]);
        series.states.map(|s| s.displacement)
    }

    /// The stop of a lifted bearing: all stops in series, where every surface has one.
    fn last_stop(&self) -> Option<Stop> {
        let mut last = Stop { at: 0.0, stiffness: self.stop_stiffness? / SURFACES as f64 };
        for stop in self.stops() {
            last.at += stop?.at;
        }
        Some(last)
    }
}

impl Link for TriplePendulum {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U1, Axis::U2, Axis::U3])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        let mut all: Vec<_> = WHOLE.iter().map(|(name, unit)| Field::new(name, unit)).collect();
        for i in 1..=SURFACES {
            all.extend(EACH.iter().map(|(name, unit)| Field::named(format!("{name}{i}"), unit)));
        }
        all.into()
    }

    fn at_rest(&self, at: &mut [f64]) {
        at[1] = 1.0;
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        engaged(self.kn, self.ks / SURFACES as f64, k);
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let past: [_; SURFACES] = std::array::from_fn(|i| load(committed, i));
        let (before, now) = (self.normal(at.d0, at.v0), self.normal(at.d, at.v));
        let (was_pressed, pressed) = (self.presses(&before), self.presses(&now));
        let u1 = tangential(at.d);
        out.f[0] = now.f;
        out.k[0] = now.f_d;
        out.c[0] = now.f_v;
        out.energy.stored = 0.5 * now.spring * now.spring / self.kn;
        out.energy.viscous = at.viscous_work(0, before.f + before.spring, now.f + now.spring);

        let radii = self.radii_in_series();
        let mut next = past;
        let touch: [Vector2<f64>; SURFACES];
        if pressed {
            let engaged = self.pressed(at, &past, &now, was_pressed, out);
            touch = engaged.touch;
            for (next, state) in next.iter_mut().zip(&engaged.series.states) {
                next.displacement = state.displacement;
                next.anchor = state.displacement - state.tau / self.ks;
                next.speed = state.speed;
                out.energy.stored += 0.5 * state.tau.norm_squared() / self.ks + state.stop_energy;
            }
            trial[2] = engaged.series.states.iter().filter(|s| s.slips).count() as f64;
        } else {
            let places = self.lifted(&past, u1);
            touch = places;
            for (next, place) in next.iter_mut().zip(places) {
                *next = Past { displacement: place, anchor: place, speed: 0.0 };
            }
            if let Some(stop) = self.last_stop() {
                let (force, stiffness, energy) = stop.force(u1.into());
                out.energy.stored += energy;
                for i in 0..2 {
                    out.f[1 + i] = force[i];
                    for j in 0..2 {
                        out.k[3 * (1 + i) + 1 + j] = stiffness[i][j];
                    }
                }
            }
            trial[2] = 0.0;
        }

        let (mut heat, mut restoring, mut path) = (0.0, committed[3], 0.0);
        let (n0, n1) =
            (if was_pressed { before.cone } else { 0.0 }, if pressed { now.cone } else { 0.0 });
        for i in 0..SURFACES {
            let (old, new) = (&past[i], &next[i]);
            let tau = |p: &Past| (p.displacement - p.anchor) * self.ks;
            let (tau0, tau1) = (tau(old), tau(new));
            let from = if was_pressed { old.anchor } else { touch[i] };
            heat += 0.5 * (tau0 + tau1).dot(&(new.anchor - from));
            let moved = new.displacement - old.displacement;
            restoring +=
                0.5 * (old.displacement * n0 + new.displacement * n1).dot(&moved) / radii[i];
            if pressed {
                path += (new.anchor - from).norm();
            }
        }
        out.energy.hysteretic = heat.max(0.0);
        out.energy.stored += restoring;
        trial[0] = committed[0] + path;
        trial[1] = f64::from(u8::from(pressed));
        trial[3] = restoring;
        for (i, next) in next.iter().enumerate() {
            store(next, trial, i);
        }
    }

    fn contact_use(&self) -> ContactUse {
        ContactUse::Bearing
    }

    fn contacts(&self, at: &Kinematics<'_>, history: &[f64], _: &[f64], out: &mut Vec<Contact>) {
        out.push(
            Contact::new(at.d[0], self.normal(at.d, at.v).cone)
                .at([at.d[1], at.d[2]])
                .slipping(history[2] > 0.0),
        );
    }

    fn impact(&self) -> Option<Impact> {
        let (stiffness, damping) = (self.kn, self.damping);
        Some(Impact::new(0, stiffness, damping))
    }
}

/// The solution of a pressed bearing and where its anchors were at the start of the friction.
struct Engaged {
    series: Series,
    touch: [Vector2<f64>; SURFACES],
}

impl TriplePendulum {
    /// Solves the series and writes shear and tangents.
    fn pressed(
        &self,
        at: &Kinematics<'_>,
        past: &[Past; SURFACES],
        now: &Normal,
        was_pressed: bool,
        out: &mut Response<'_>,
    ) -> Engaged {
        let (radii, stops) = (self.radii_in_series(), self.stops());
        let all: f64 = radii.iter().sum();
        let (u0, u1) = (tangential(at.d0), tangential(at.d));
        // Where it touched: the motion until then is shared as the radii.
        let (mut touch, mut share, mut by_gap) = (past.map(|p| p.anchor), 0.0, 0.0);
        if !was_pressed {
            if at.d0[0] > 0.0 {
                (share, by_gap) = share_before(at.d0[0], at.d[0]);
            }
            for (i, touch) in touch.iter_mut().enumerate() {
                *touch = past[i].displacement + (u1 - u0) * (share * radii[i] / all);
            }
        }
        // Right after the start of a step the speed is that of the last one; a static step has none.
        let standing = at.dt == 0.0 && at.d == at.d0;
        let speed = |i: usize| match at.dt {
            dt if dt > 0.0 => Speed::PerSlip(self.slide_in_series(i) / dt),
            _ => Speed::Known(if standing { past[i].speed } else { 0.0 }),
        };
        let surfaces = std::array::from_fn(|i| Surface {
            restoring: now.cone / radii[i],
            ks: self.ks,
            friction: self.friction(i),
            normal: now.cone,
            speed: speed(i),
            stop: stops[i],
            anchor: touch[i],
        });
        let start = std::array::from_fn(|i| {
            if was_pressed { past[i].displacement - past[i].anchor } else { Vector2::zeros() }
        });
        let series = solve(&surfaces, u1, start);

        // dF = K (du − Σ da + Σ Kᵢ⁻¹ (∂gᵢ/∂N dN + ∂gᵢ/∂a daᵢ)).
        let mut by_cone = Vector2::zeros();
        let mut by_touch = -nalgebra::Matrix2::identity();
        for (i, state) in series.states.iter().enumerate() {
            let compliance = series.compliances[i];
            by_cone +=
                compliance * (state.displacement / radii[i] + state.along * state.limit.by_normal);
            by_touch += compliance * state.unrubbed * (radii[i] / all);
        }
        let by_cone = series.stiffness * by_cone;
        let by_touch = series.stiffness * by_touch;
        let by_u = series.stiffness + by_touch * share;
        let by_d1 = by_cone * now.cone_d + by_touch * ((u1 - u0) * by_gap);
        for i in 0..2 {
            out.f[1 + i] = series.force[i];
            let row = 3 * (1 + i);
            let k = Vector3::new(by_d1[i], by_u[(i, 0)], by_u[(i, 1)]);
            for j in 0..3 {
                out.k[row + j] = k[j];
            }
            out.c[row] = by_cone[i] * now.cone_v;
        }
        Engaged { series, touch }
    }
}
