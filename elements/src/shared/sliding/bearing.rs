//! A sliding bearing: contact along its normal, friction and restoring force along its surface, a rim.
//!
//! ```text
//!   g  = d₁ − h(u)            gap with `rise` (the surface lifts the load), else g = d₁;   u = (d₂, d₃)
//!   F  = F(g, ġ)              compression side, and a tension side where there is one; N = |F|
//!   τ  = kₛ (u − a) + cₛ (u̇ − ȧ), |τ| ≤ L(N, |ȧ|)      a: anchor, slips at the limit
//!   f₁ = F
//!   fₜ = τ + S ∇h(u) + stop(u)            S = N in compression, −N in tension; with `rise` S = −F
//! ```
//!
//! `inclined` friction lies in the surface and follows the force normal to it; see `incline.rs`. The history is told by
//! lengths along the surface then: the anchor lies off u by the stretch.
//!
//! With `rise` normal force and restoring force come from one potential; without it (small
//! displacements) the restoring force has none where N changes, and its work is history.

use super::coefficient::BreakAway;
use super::incline::{Climb, Incline};
use super::{Axial, Coefficient, Dish, Normal, Rubbing, Stop, Worn, radial_return, share_before};
use nalgebra::{Matrix2, Matrix2x3, Matrix3, Vector2, Vector3};
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
        /// Rate of slip.
        pub slip_rate: "m/s",
        /// Length of the slip path since it last stuck.
        pub unstuck: "m",
        /// Force of the dashpot beside the pre-slip spring along U2.
        pub damped2: "N",
        /// Force of the dashpot beside the pre-slip spring along U3.
        pub damped3: "N",
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
    /// Dashpot beside the pre-slip spring, N·s/m.
    pub(crate) cs: f64,
    pub(crate) away: Option<BreakAway>,
    pub(crate) dish: Dish,
    pub(crate) rise: bool,
    /// Friction lies in the surface, of the force normal to it.
    pub(crate) inclined: bool,
    pub(crate) stop: Option<Stop>,
}

/// The gap coordinate and its derivatives.
struct Gap {
    x: f64,
    rate: f64,
    by_d: Vector3<f64>,
    rate_by_d: Vector3<f64>,
}

/// Friction force at the end of a step, its derivatives, and what it remembers.
pub(super) struct Rubs {
    slips: bool,
    pub(super) tau: Vector2<f64>,
    pub(super) by_stretch: Matrix2<f64>,
    pub(super) by_way: Matrix2<f64>,
    pub(super) by_speed: Matrix2<f64>,
    pub(super) by_normal: Vector2<f64>,
    worn: Worn<f64, 2>,
}

/// Motion of a closed side along its surface.
struct Motion {
    /// Stretch if nothing slips.
    stretch: Vector2<f64>,
    /// Way of the step.
    way: Vector2<f64>,
    /// Speed at its end.
    speed: Vector2<f64>,
    dt: f64,
}

impl Rubs {
    fn damped(&self) -> Vector2<f64> {
        self.worn.damped.into()
    }
}

const FRESH: Worn<f64, 2> = Worn { rate: 0.0, since: 0.0, damped: [0.0; 2] };

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

    /// Friction of a closed side under a normal force.
    fn rub(
        &self,
        friction: &Coefficient,
        motion: &Motion,
        normal: f64,
        was: &SlidingHistory,
    ) -> Rubs {
        if let Coefficient::Constant { mu } = *friction
            && self.cs == 0.0
            && self.away.is_none()
        {
            let it = radial_return(self.ks, motion.stretch, mu * normal);
            return Rubs {
                slips: it.slips,
                tau: it.tau,
                by_stretch: it.by_stretch,
                by_way: Matrix2::zeros(),
                by_speed: Matrix2::zeros(),
                by_normal: it.by_limit * mu,
                worn: FRESH,
            };
        }
        let rubbing = Rubbing {
            spring: self.ks,
            dashpot: self.cs,
            stretch: motion.stretch.into(),
            way: motion.way.into(),
            speed: motion.speed.into(),
            dt: motion.dt,
            was: Worn {
                rate: was.slip_rate,
                since: was.unstuck,
                damped: [was.damped2, was.damped3],
            },
        };
        let it = rubbing.on(&friction.cone(normal, self.away));
        let matrix = |rows: [[f64; 2]; 2]| Matrix2::from(rows).transpose();
        Rubs {
            slips: !it.sticks,
            tau: it.tau.into(),
            by_stretch: matrix(it.by_stretch),
            by_way: matrix(it.by_way),
            by_speed: matrix(it.by_speed),
            by_normal: it.by_normal.into(),
            worn: it.worn,
        }
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

        // Friction; on an incline places are told by lengths along the surface, from the start of the step.
        let vt = tangential(at.v);
        let climb = self.inclined.then(|| Climb::new(&self.dish, u0, u1, vt));
        let reached = climb.map_or(u1, |climb| u0 + climb.way);
        let old = Vector2::new(was.anchor2, was.anchor3);
        let (stretched0, damped0) = if before.side == 0.0 {
            (Vector2::zeros(), Vector2::zeros())
        } else {
            (u0 - old, Vector2::new(was.damped2, was.damped3))
        };
        let tau0 = stretched0 * self.ks + damped0;
        let (mut touch, mut end, mut tau1) =
            (if before.side == 0.0 { u0 } else { old }, reached, Vector2::zeros());
        let (mut slips, mut worn) = (false, FRESH);
        if now.side != 0.0 {
            let cleared = self.clearance(now.side, gap0.x);
            let reached_by_u = climb.map_or_else(Matrix2::identity, |climb| climb.way_by_place);
            let mut stretch_by_d = Matrix2x3::<f64>::zeros();
            for i in 0..2 {
                for j in 0..2 {
                    stretch_by_d[(i, 1 + j)] = reached_by_u[(i, j)];
                }
            }
            // The anchor moves with the end of the step where contact begins within it.
            if cleared > 0.0 {
                let clearance = self.clearance(now.side, gap.x);
                let (share, by_gap) = share_before(cleared, clearance);
                touch = u0 + (reached - u0) * share;
                stretch_by_d = stretch_by_d * (1.0 - share)
                    - (reached - u0) * (gap.by_d * (by_gap * now.side)).transpose();
            }
            let motion = Motion {
                stretch: reached - touch,
                way: reached - u0,
                speed: climb.map_or(vt, |climb| climb.speed),
                dt: at.dt,
            };
            let under = |normal: f64| self.rub(&now.friction, &motion, normal, was);
            let it = match &climb {
                Some(climb) => climb.end.press(n.cone, under),
                None => under(n.cone),
            };
            (tau1, slips, worn) = (it.tau, it.slips, it.worn);
            end = if slips { reached - (tau1 - it.damped()) / self.ks } else { touch };
            let cone_by_d = gap.by_d * n.cone_d + gap.rate_by_d * n.cone_v;
            let cone_by_v = gap.by_d * n.cone_v;
            let (shear, rows, rates) = if let Some(climb) = &climb {
                let (rows, rates) =
                    climb.tangents(&it, &stretch_by_d, n.cone, &cone_by_d, &cone_by_v);
                (climb.end.along(tau1), rows, rates)
            } else {
                let mut rows = it.by_stretch * stretch_by_d + it.by_normal * cone_by_d.transpose();
                let mut rates = it.by_normal * cone_by_v.transpose();
                for i in 0..2 {
                    for j in 0..2 {
                        rows[(i, 1 + j)] += it.by_way[(i, j)];
                        rates[(i, 1 + j)] += it.by_speed[(i, j)];
                    }
                }
                (tau1, rows, rates)
            };
            for i in 0..2 {
                f[1 + i] += shear[i];
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

        let damped1 = Vector2::from(worn.damped);
        let mut stored = restoring + 0.5 * (tau1 - damped1).norm_squared() / self.ks;
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
        let (rate, rate0) = ([gap.rate], [gap0.rate]);
        let along_gap = Kinematics::new([&[], &rate], [&[], &rate0], at.dt);
        let damped = |p: &Pressed| p.normal.f + p.side * p.normal.spring;
        let stretching = 0.5 * (damped0 + damped1).dot(&(reached - end - stretched0));
        out.energy.viscous =
            along_gap.viscous_work(0, damped(&before), damped(&now)) + stretching.max(0.0);
        write(out, &f, &k, &c);

        let path = if now.side == 0.0 { 0.0 } else { (end - touch).norm() };
        let anchor = if self.inclined { end + (u1 - reached) } else { end };
        SlidingHistory {
            anchor2: anchor.x,
            anchor3: anchor.y,
            slip: was.slip + path,
            side: now.side,
            slipping: f64::from(u8::from(slips && n.cone > 0.0)),
            restoring,
            slip_rate: worn.rate,
            unstuck: worn.since,
            damped2: worn.damped[0],
            damped3: worn.damped[1],
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
        let load = self.pressed(&gap).normal.cone;
        let normal = if self.inclined && load > 0.0 {
            let (u, h) = (tangential(at.d), history);
            let stretch = u - Vector2::new(h.anchor2, h.anchor3);
            let tau = stretch * self.ks + Vector2::new(h.damped2, h.damped3);
            Incline::at(&self.dish, u).normal(load, tau)
        } else {
            load
        };
        Contact::new(clearance, normal).at([at.d[1], at.d[2]]).slipping(history.slipping > 0.0)
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
