//! A sliding bearing: contact along its normal, friction and restoring force along its surface, a rim.
//!
//! ```text
//!   g  = d₁ − h(u)            gap with `rise` (the surface lifts the load), else g = d₁;   u = (d₂, d₃)
//!   F  = F(g, ġ)              compression side, and a tension side where there is one; N = |F|
//!   τ  = kₛ (u − a), |τ| ≤ L(N, |u̇|)      a: anchor, slips at the limit
//!   f₁ = F
//!   fₜ = τ + S ∇h(u) + stop(u)            S = N in compression, −N in tension; with `rise` S = −F
//! ```
//!
//! With `rise` normal force and restoring force come from one potential; without it (small
//! displacements) the restoring force has none where N changes, and its work is history.

use super::coefficient::Limit;
use super::{Axial, Coefficient, Dish, Normal, Stop, radial_return, share_before};
use nalgebra::{Matrix3, Vector2, Vector3};
use trilith_element::{Contact, Kinematics, Response, history};

history! {
    /// History of one sliding surface.
    pub struct SlidingHistory {
        /// Anchor of the friction along U2: where the tangential spring is unstretched.
        pub anchor2: "m",
        /// Anchor of the friction along U3.
        pub anchor3: "m",
        /// Length of the slip path so far.
        pub slip: "m",
        /// 1 while closed in compression, −1 in tension, 0 while open.
        pub side: "1",
        /// 1 while slipping; for records.
        pub slipping: "1",
        /// Work of the restoring force so far, without `rise`.
        pub restoring: "J",
    }
}

/// One side of the contact: after how much gap it closes, what presses and what rubs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) opening: f64,
    pub(crate) axial: Axial,
    pub(crate) friction: Coefficient,
}

/// The bearing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearing {
    pub(crate) compression: Side,
    pub(crate) tension: Option<Side>,
    pub(crate) ks: f64,
    pub(crate) dish: Dish,
    pub(crate) rise: bool,
    pub(crate) stop: Option<Stop>,
}

/// The gap coordinate and its derivatives.
struct Gap {
    x: f64,
    rate: f64,
    by_d: Vector3<f64>,
    rate_by_d: Vector3<f64>,
}

/// What presses.
struct Pressed {
    /// 1 compression, −1 tension, 0 open.
    side: f64,
    normal: Normal,
    friction: Coefficient,
}

fn tangential(d: &[f64]) -> Vector2<f64> {
    Vector2::new(d[1], d[2])
}

/// Stiffness of a bearing that is closed and sticks, along U1, U2 and U3.
pub(crate) fn engaged(kn: f64, ks: f64, k: &mut [f64]) {
    k[0] = kn;
    k[4] = ks;
    k[8] = ks;
}

impl Bearing {
    fn gap(&self, d: &[f64], v: &[f64]) -> Gap {
        if !self.rise {
            let rate_by_d = Vector3::zeros();
            return Gap { x: d[0], rate: v[0], by_d: Vector3::x(), rate_by_d };
        }
        let height = self.dish.height(tangential(d));
        let vt = tangential(v);
        let bend = height.curvature * vt;
        Gap {
            x: d[0] - height.h,
            rate: v[0] - height.slope.dot(&vt),
            by_d: Vector3::new(1.0, -height.slope.x, -height.slope.y),
            rate_by_d: Vector3::new(0.0, -bend.x, -bend.y),
        }
    }

    /// Clearance left on a side; 0 or less while it is closed.
    fn clearance(&self, side: f64, x: f64) -> f64 {
        match self.tension {
            Some(tension) if side < 0.0 => tension.opening - x,
            _ => x + self.compression.opening,
        }
    }

    fn pressed(&self, gap: &Gap) -> Pressed {
        let below = self.compression;
        let normal = below.axial.normal(self.clearance(1.0, gap.x), gap.rate);
        if normal.closed {
            return Pressed { side: 1.0, normal, friction: below.friction };
        }
        if let Some(above) = self.tension {
            let normal = above.axial.normal(self.clearance(-1.0, gap.x), -gap.rate).mirrored();
            if normal.closed {
                return Pressed { side: -1.0, normal, friction: above.friction };
            }
        }
        Pressed { side: 0.0, normal, friction: below.friction }
    }

    /// Restoring force S ∇h without `rise`.
    fn restoring(&self, pressed: &Pressed, u: Vector2<f64>) -> Vector2<f64> {
        if self.rise {
            return Vector2::zeros();
        }
        self.dish.height(u).slope * (pressed.side * pressed.normal.cone)
    }

    /// History before anything has happened.
    pub(crate) fn at_rest(&self) -> SlidingHistory {
        let zero = [0.0; 3];
        let side = self.pressed(&self.gap(&zero, &zero)).side;
        SlidingHistory { side, ..SlidingHistory::default() }
    }

    /// Force, tangents and energies; the answer is the trial history.
    pub(crate) fn respond(
        &self,
        at: &Kinematics<'_>,
        was: &SlidingHistory,
        out: &mut Response<'_>,
    ) -> SlidingHistory {
        let (u0, u1) = (tangential(at.d0), tangential(at.d));
        let (gap0, gap) = (self.gap(at.d0, at.v0), self.gap(at.d, at.v));
        let (before, now) = (self.pressed(&gap0), self.pressed(&gap));
        let height = self.dish.height(u1);
        let n = now.normal;
        let mut f = gap.by_d * n.f;
        let mut k = gap.by_d * (gap.by_d * n.f_d + gap.rate_by_d * n.f_v).transpose();
        let mut c = gap.by_d * gap.by_d.transpose() * n.f_v;
        if self.rise {
            add(&mut k, height.curvature * -n.f);
        }

        // Friction.
        let old = Vector2::new(was.anchor2, was.anchor3);
        let tau0 = if before.side == 0.0 { Vector2::zeros() } else { (u0 - old) * self.ks };
        let (mut touch, mut end, mut tau1) =
            (if before.side == 0.0 { u0 } else { old }, u1, Vector2::zeros());
        let mut slips = false;
        if now.side != 0.0 {
            let cleared = self.clearance(now.side, gap0.x);
            // The anchor moves with the end of the step where contact begins within it.
            let mut anchor_by_d = nalgebra::Matrix2x3::zeros();
            if cleared > 0.0 {
                let clearance = self.clearance(now.side, gap.x);
                let (share, by_gap) = share_before(cleared, clearance);
                touch = u0 + (u1 - u0) * share;
                anchor_by_d = (u1 - u0) * (gap.by_d * (by_gap * now.side)).transpose();
                anchor_by_d[(0, 1)] += share;
                anchor_by_d[(1, 2)] += share;
            }
            let vt = tangential(at.v);
            let speed = vt.norm();
            let limit: Limit = now.friction.limit(n.cone, speed);
            let it = radial_return(self.ks, u1 - touch, limit.force);
            (tau1, slips) = (it.tau, it.slips);
            end = if slips { u1 - tau1 / self.ks } else { touch };
            let mut stretch_by_d = -anchor_by_d;
            stretch_by_d[(0, 1)] += 1.0;
            stretch_by_d[(1, 2)] += 1.0;
            let cone_by_d = gap.by_d * n.cone_d + gap.rate_by_d * n.cone_v;
            let rows = it.by_stretch * stretch_by_d
                + it.by_limit * cone_by_d.transpose() * limit.by_normal;
            let mut rates = it.by_limit * gap.by_d.transpose() * (limit.by_normal * n.cone_v);
            if speed > 0.0 {
                let along = Vector3::new(0.0, vt.x, vt.y) / speed;
                rates += it.by_limit * along.transpose() * limit.by_speed;
            }
            for i in 0..2 {
                f[1 + i] += tau1[i];
                for j in 0..3 {
                    k[(1 + i, j)] += rows[(i, j)];
                    c[(1 + i, j)] += rates[(i, j)];
                }
            }
        }

        // Restoring force; with `rise` it is in the gap already.
        let (back0, back1) = (self.restoring(&before, u0), self.restoring(&now, u1));
        if !self.rise {
            add(&mut k, height.curvature * (now.side * n.cone));
            for i in 0..2 {
                f[1 + i] += back1[i];
                k[(1 + i, 0)] += height.slope[i] * now.side * n.cone_d;
                c[(1 + i, 0)] += height.slope[i] * now.side * n.cone_v;
            }
        }
        let restoring = was.restoring + 0.5 * (back0 + back1).dot(&(u1 - u0));

        let mut stored = restoring + 0.5 * tau1.norm_squared() / self.ks;
        if now.side != 0.0 {
            let kn = if now.side > 0.0 {
                self.compression
            } else {
                self.tension.unwrap_or(self.compression)
            };
            stored += 0.5 * n.spring * n.spring / kn.axial.kn;
        }
        if let Some(stop) = self.stop {
            let (force, stiffness, energy) = stop.force(u1);
            add(&mut k, stiffness);
            f[1] += force.x;
            f[2] += force.y;
            stored += energy;
        }

        // Exact for a trapezoidal step that stays on its side.
        let heat = if before.side == now.side {
            0.5 * (tau0 + tau1).dot(&(end - old))
        } else if now.side == 0.0 {
            0.5 * tau0.dot(&(end - touch))
        } else {
            0.5 * (tau0.dot(&(touch - old)) + tau1.dot(&(end - touch)))
        };
        out.energy.stored = stored;
        out.energy.hysteretic = heat.max(0.0);
        let along_gap = Kinematics { d: &[], v: &[gap.rate], d0: &[], v0: &[gap0.rate], dt: at.dt };
        let damped = |p: &Pressed| p.normal.f + p.side * p.normal.spring;
        out.energy.viscous = along_gap.viscous_work(0, damped(&before), damped(&now));
        write(out, &f, &k, &c);

        let path = if now.side == 0.0 { 0.0 } else { (end - touch).norm() };
        SlidingHistory {
            anchor2: end.x,
            anchor3: end.y,
            slip: was.slip + path,
            side: now.side,
            slipping: f64::from(u8::from(slips && n.cone > 0.0)),
            restoring,
        }
    }

    /// What the contact does.
    pub(crate) fn contact(&self, at: &Kinematics<'_>, history: &SlidingHistory) -> Contact {
        let gap = self.gap(at.d, at.v);
        let compression = self.clearance(1.0, gap.x);
        let clearance = match self.tension {
            Some(_) => compression.min(self.clearance(-1.0, gap.x)),
            None => compression,
        };
        Contact {
            gap: clearance,
            normal: self.pressed(&gap).normal.cone,
            position: [at.d[1], at.d[2]],
            slipping: history.slipping > 0.0,
        }
    }
}

/// Adds a block of the tangential coordinates.
fn add(to: &mut Matrix3<f64>, block: nalgebra::Matrix2<f64>) {
    for i in 0..2 {
        for j in 0..2 {
            to[(1 + i, 1 + j)] += block[(i, j)];
        }
    }
}

fn write(out: &mut Response<'_>, f: &Vector3<f64>, k: &Matrix3<f64>, c: &Matrix3<f64>) {
    for i in 0..3 {
        out.f[i] = f[i];
        for j in 0..3 {
            out.k[3 * i + j] = k[(i, j)];
            out.c[3 * i + j] = c[(i, j)];
        }
    }
}
