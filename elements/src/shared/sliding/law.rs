//! The law of a sliding bearing over lanes; its equations stand in `bearing.rs`.

use super::bearing::{ALL, PLAIN, SlidingHistory};
use super::coefficient::{self, cone};
use super::incline::{Climb, Friction, Incline, Rows, add_plane};
use super::{Axial, Dish, Normal, Rubbing, Stop, Worn, radial_return, share_before};
use crate::shared::plane::{self, M2, V2};
use trilith_element::History;
use trilith_element::lanes::{LaneAt, LaneContact, LaneForce, LaneLaw, LaneStep, Real};

/// The numbers of a bearing over lanes.
pub(super) struct Numbers<'a, R: Real> {
    compression: Axial<R>,
    tension: Axial<R>,
    openings: [R; 2],
    has_tension: R::Mask,
    ks: R,
    mu: [R; 2],
    dish: Dish<R>,
    rise: R::Mask,
    has_stop: R::Mask,
    stop: Stop<R>,
    /// Those beyond a plain bearing: inclined, cₛ, the break-away, the coefficients of both sides.
    more: &'a [R],
}

/// The gap coordinate and its derivatives.
pub(super) struct Gap<R> {
    x: R,
    rate: R,
    by_d: [R; 3],
    rate_by_d: [R; 3],
}

/// Friction force at the end of a step, its derivatives, and what it remembers.
#[derive(Clone, Copy)]
pub(super) struct Rubs<R: Real> {
    slips: R::Mask,
    pub(super) tau: V2<R>,
    pub(super) by_stretch: M2<R>,
    pub(super) by_way: M2<R>,
    pub(super) by_speed: M2<R>,
    pub(super) by_normal: V2<R>,
    worn: Worn<R, 2>,
}

/// Motion of a closed side along its surface.
struct Motion<R> {
    /// Stretch if nothing slips.
    stretch: V2<R>,
    /// Way of the step.
    way: V2<R>,
    /// Speed at its end.
    speed: V2<R>,
}

impl<R: Real> Rubs<R> {
    /// Of what does not touch.
    #[inline(always)]
    pub(super) fn none(like: R) -> Self {
        let zero = like.of(0.0);
        Self {
            slips: zero.lt(zero),
            tau: [zero; 2],
            by_stretch: [[zero; 2]; 2],
            by_way: [[zero; 2]; 2],
            by_speed: [[zero; 2]; 2],
            by_normal: [zero; 2],
            worn: Worn { rate: zero, since: zero, damped: [zero; 2] },
        }
    }

    #[inline(always)]
    pub(super) fn select(mask: R::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            slips: (mask & yes.slips) | (!mask & no.slips),
            tau: plane::select(mask, yes.tau, no.tau),
            by_stretch: plane::select_matrix(mask, &yes.by_stretch, &no.by_stretch),
            by_way: plane::select_matrix(mask, &yes.by_way, &no.by_way),
            by_speed: plane::select_matrix(mask, &yes.by_speed, &no.by_speed),
            by_normal: plane::select(mask, yes.by_normal, no.by_normal),
            worn: Worn {
                rate: R::select(mask, yes.worn.rate, no.worn.rate),
                since: R::select(mask, yes.worn.since, no.worn.since),
                damped: plane::select(mask, yes.worn.damped, no.worn.damped),
            },
        }
    }
}

/// What presses.
pub(super) struct Pressed<R: Real> {
    /// 1 compression, −1 tension, 0 open.
    pub(super) side: R,
    normal: Normal<R>,
}

impl<R: Real> Pressed<R> {
    #[inline(always)]
    fn closed(&self) -> R::Mask {
        self.side.of(0.0).lt(self.side.abs())
    }

    /// Force of the dashpot along the gap.
    #[inline(always)]
    fn dashes(&self) -> R {
        self.normal.f + self.side * self.normal.spring
    }

    #[inline(always)]
    fn pulls(&self) -> R::Mask {
        self.side.lt(self.side.of(0.0))
    }
}

impl<'a, R: Real> Numbers<'a, R> {
    #[inline(always)]
    pub(super) fn of(p: &'a [R]) -> Self {
        let (half, damping) = (p[0].of(0.5), p[1]);
        let pull = half.lt(p[2]);
        Self {
            compression: Axial { kn: p[0], damping, pull },
            tension: Axial { kn: p[5], damping, pull },
            openings: [p[3], p[6]],
            has_tension: half.lt(p[4]),
            ks: p[7],
            mu: [p[8], p[9]],
            dish: Dish { radius: p[10], spherical: half.lt(p[11]) },
            rise: half.lt(p[12]),
            has_stop: half.lt(p[13]),
            stop: Stop { at: p[14], stiffness: p[15] },
            more: &p[PLAIN..],
        }
    }

    #[inline(always)]
    fn inclined(&self) -> R::Mask {
        self.ks.of(0.5).lt(self.more[0])
    }

    #[inline(always)]
    pub(super) fn gap(&self, d: &[R], v: &[R]) -> Gap<R> {
        let (zero, one) = (self.ks.of(0.0), self.ks.of(1.0));
        let mut it = Gap { x: d[0], rate: v[0], by_d: [one, zero, zero], rate_by_d: [zero; 3] };
        if zero.any(self.rise) {
            let height = self.dish.height([d[1], d[2]]);
            let vt = [v[1], v[2]];
            let bend = plane::times(&height.curvature, vt);
            it.x = R::select(self.rise, d[0] - height.h, it.x);
            let rate = v[0] - plane::dot(height.slope, vt);
            it.rate = R::select(self.rise, rate, it.rate);
            for j in 0..2 {
                it.by_d[1 + j] = (-height.slope[j]).only(self.rise);
                it.rate_by_d[1 + j] = (-bend[j]).only(self.rise);
            }
        }
        it
    }

    /// Clearance left on the side of compression and of tension; 0 or less while it is closed.
    #[inline(always)]
    fn clearances(&self, x: R) -> [R; 2] {
        [x + self.openings[0], self.openings[1] - x]
    }

    /// That of a side.
    #[inline(always)]
    fn clearance(&self, pulls: R::Mask, x: R) -> R {
        let [below, above] = self.clearances(x);
        R::select(pulls, above, below)
    }

    #[inline(always)]
    pub(super) fn pressed(&self, gap: &Gap<R>) -> Pressed<R> {
        let (zero, one) = (gap.x.of(0.0), gap.x.of(1.0));
        let [below, above] = self.clearances(gap.x);
        let normal = self.compression.normal(below, gap.rate);
        let mut it = Pressed { side: one.only(normal.closed), normal };
        let may_pull = self.has_tension & !normal.closed;
        if zero.any(may_pull) {
            let other = self.tension.normal(above, -gap.rate).mirrored();
            let pulls = may_pull & other.closed;
            it.side = R::select(pulls, -one, it.side);
            it.normal = Normal::select(pulls, &other, &it.normal);
        }
        it
    }

    /// Restoring force S ∇h without `rise`.
    #[inline(always)]
    fn restoring(&self, pressed: &Pressed<R>, slope: V2<R>) -> V2<R> {
        plane::only(plane::scaled(slope, pressed.side * pressed.normal.cone), !self.rise)
    }

    /// Friction of a closed side under a normal force.
    #[inline(always)]
    fn rub<const FULL: bool>(
        &self,
        at: &LaneAt<'_, R>,
        pulls: R::Mask,
        motion: &Motion<R>,
        normal: R,
    ) -> Rubs<R> {
        let none = Rubs::none(normal);
        let mu = R::select(pulls, self.mu[1], self.mu[0]);
        let it = radial_return(self.ks, motion.stretch, mu * normal);
        let (tau, by_normal) = (it.tau, plane::scaled(it.by_limit, mu));
        let coulomb = Rubs { slips: it.slips, tau, by_stretch: it.by_stretch, by_normal, ..none };
        if !FULL {
            return coulomb;
        }
        let h = at.history;
        let rubbing = Rubbing {
            spring: self.ks,
            dashpot: self.more[1],
            stretch: motion.stretch,
            way: motion.way,
            speed: motion.speed,
            dt: at.dt,
            was: Worn { rate: h[SLIP_RATE], since: h[UNSTUCK], damped: [h[DAMPED], h[DAMPED + 1]] },
        };
        let (first, second) = self.more[5..].split_at(coefficient::NUMBERS);
        let mut friction = [normal; coefficient::NUMBERS];
        for (i, one) in friction.iter_mut().enumerate() {
            *one = R::select(pulls, second[i], first[i]);
        }
        let (zero, half) = (normal.of(0.0), normal.of(0.5));
        let looks_at_slip = zero.lt(self.more[1]) | half.lt(self.more[2]);
        let plain = coefficient::is_constant(&friction) & !looks_at_slip;
        if !zero.any(!plain) {
            return coulomb;
        }
        let it = rubbing.on(&cone(&friction, &self.more[2..5], normal));
        let all = Rubs {
            slips: !it.sticks,
            tau: it.tau,
            by_stretch: it.by_stretch,
            by_way: it.by_way,
            by_speed: it.by_speed,
            by_normal: it.by_normal,
            worn: it.worn,
        };
        Rubs::select(plain, &coulomb, &all)
    }
}

/// The closed side, as what [`Incline::press`] asks of it.
struct Side<'a, R: Real, const FULL: bool> {
    of: &'a Numbers<'a, R>,
    at: &'a LaneAt<'a, R>,
    pulls: R::Mask,
    motion: &'a Motion<R>,
}

impl<R: Real, const FULL: bool> Friction<R> for Side<'_, R, FULL> {
    #[inline(always)]
    fn under(&self, normal: R) -> Rubs<R> {
        self.of.rub::<FULL>(self.at, self.pulls, self.motion, normal)
    }
}

/// Where the history has what.
const ANCHOR: usize = 0;
const SLIP: usize = 2;
const SIDE: usize = 3;
const SLIPPING: usize = 4;
const RESTORING: usize = 5;
const SLIP_RATE: usize = 6;
const UNSTUCK: usize = 7;
const DAMPED: usize = 8;
const HISTORY: usize = SlidingHistory::FIELDS.len();

/// The law over lanes: all of it, or that of a plain bearing.
pub(super) struct Law<const FULL: bool>;

/// Adds a block of the tangential coordinates where `mask` says so.
#[inline(always)]
fn add<R: Real>(to: &mut [[R; 3]; 3], block: &M2<R>, mask: R::Mask) {
    for i in 0..2 {
        for j in 0..2 {
            to[1 + i][1 + j] = to[1 + i][1 + j] + block[i][j].only(mask);
        }
    }
}

impl<const FULL: bool> LaneLaw for Law<FULL> {
    const COORDINATES: usize = 3;
    const HISTORY: usize = HISTORY;
    const PARAMETERS: usize = if FULL { ALL } else { PLAIN };
    const CONTACTS: usize = 1;
    const IS_LONG: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let it = Numbers::of(at.parameters);
        let h = at.history;
        let (zero, half, one) = (at.dt.of(0.0), at.dt.of(0.5), at.dt.of(1.0));
        let (u0, u1) = ([at.d0[1], at.d0[2]], [at.d[1], at.d[2]]);
        let vt = [at.v[1], at.v[2]];
        let (gap0, gap) = (it.gap(at.d0, at.v0), it.gap(at.d, at.v));
        let (before, now) = (it.pressed(&gap0), it.pressed(&gap));
        let (was_closed, closed) = (before.closed(), now.closed());
        let flat = !it.rise;
        let height = it.dish.height(u1);
        let n = now.normal;
        let mut f = [gap.by_d[0] * n.f, gap.by_d[1] * n.f, gap.by_d[2] * n.f];
        let (mut k, mut c) = ([[zero; 3]; 3], [[zero; 3]; 3]);
        for i in 0..3 {
            for j in 0..3 {
                k[i][j] = gap.by_d[i] * (gap.by_d[j] * n.f_d + gap.rate_by_d[j] * n.f_v);
                c[i][j] = gap.by_d[i] * gap.by_d[j] * n.f_v;
            }
        }
        add(&mut k, &plane::of(&height.curvature, -n.f), it.rise);

        // Friction; on an incline places are told by lengths along the surface, from the start of the step.
        let inclines = FULL && zero.any(it.inclined());
        let climb =
            if inclines { Some(Climb::new(&it.dish, it.inclined(), [u0, u1], vt)) } else { None };
        let (mut reached, mut reached_by_u, mut speed) = (u1, plane::diagonal(one), vt);
        if let Some(climb) = &climb {
            reached = plane::select(it.inclined(), plane::add(u0, climb.way), u1);
            (reached_by_u, speed) = (climb.way_by_place, climb.speed);
        }
        let old = [h[ANCHOR], h[ANCHOR + 1]];
        let stretched0 = plane::only(plane::sub(u0, old), was_closed);
        let damped0 = plane::only([h[DAMPED], h[DAMPED + 1]], was_closed);
        let tau0 = plane::add(plane::scaled(stretched0, it.ks), damped0);
        let mut touch = plane::select(was_closed, old, u0);
        let (mut end, mut rub) = (reached, Rubs::none(zero));
        if zero.any(closed) {
            let cleared = it.clearance(now.pulls(), gap0.x);
            let mut stretch_by_d: Rows<R> = [[zero; 3]; 2];
            add_plane(&mut stretch_by_d, &reached_by_u);
            // The anchor moves with the end of the step where contact begins within it.
            let begins = closed & zero.lt(cleared);
            if zero.any(begins) {
                let clearance = it.clearance(now.pulls(), gap.x);
                let (share, by_gap) = share_before(cleared, clearance);
                let moved = plane::sub(reached, u0);
                let met = plane::add(u0, plane::scaled(moved, share));
                touch = plane::select(begins, met, touch);
                for i in 0..2 {
                    for j in 0..3 {
                        let later = stretch_by_d[i][j] * (one - share)
                            - moved[i] * (gap.by_d[j] * (by_gap * now.side));
                        stretch_by_d[i][j] = R::select(begins, later, stretch_by_d[i][j]);
                    }
                }
            }
            let motion =
                Motion { stretch: plane::sub(reached, touch), way: plane::sub(reached, u0), speed };
            let pulls = now.pulls();
            let mut cone_by_d = gap.by_d;
            let mut cone_by_v = gap.by_d;
            for j in 0..3 {
                cone_by_d[j] = gap.by_d[j] * n.cone_d + gap.rate_by_d[j] * n.cone_v;
                cone_by_v[j] = gap.by_d[j] * n.cone_v;
            }
            let (shear, rows, rates);
            if let Some(climb) = &climb {
                let side = Side::<_, FULL> { of: &it, at, pulls, motion: &motion };
                rub = climb.end.press(n.cone, &side);
                (rows, rates) = climb.tangents(&rub, &stretch_by_d, n.cone, &cone_by_d, &cone_by_v);
                shear = climb.end.along(rub.tau);
            } else {
                rub = it.rub::<FULL>(at, pulls, &motion, n.cone);
                let (mut by_d, mut by_v) = ([[zero; 3]; 2], [[zero; 3]; 2]);
                for i in 0..2 {
                    for j in 0..3 {
                        let [b0, b1] = rub.by_stretch[i];
                        by_d[i][j] = b0 * stretch_by_d[0][j]
                            + b1 * stretch_by_d[1][j]
                            + rub.by_normal[i] * cone_by_d[j];
                        by_v[i][j] = rub.by_normal[i] * cone_by_v[j];
                    }
                }
                add_plane(&mut by_d, &rub.by_way);
                add_plane(&mut by_v, &rub.by_speed);
                (shear, rows, rates) = (rub.tau, by_d, by_v);
            }
            rub = Rubs::select(closed, &rub, &Rubs::none(zero));
            let back = plane::sub(rub.tau, rub.worn.damped);
            let slid = [reached[0] - back[0] / it.ks, reached[1] - back[1] / it.ks];
            let ended = plane::select(rub.slips, slid, touch);
            end = plane::select(closed, ended, end);
            for i in 0..2 {
                f[1 + i] = f[1 + i] + shear[i].only(closed);
                for j in 0..3 {
                    k[1 + i][j] = k[1 + i][j] + rows[i][j].only(closed);
                    c[1 + i][j] = c[1 + i][j] + rates[i][j].only(closed);
                }
            }
        }
        let (tau1, worn) = (rub.tau, rub.worn);

        // Restoring force; with `rise` it is in the gap already.
        let back0 = it.restoring(&before, it.dish.height(u0).slope);
        let back1 = it.restoring(&now, height.slope);
        add(&mut k, &plane::of(&height.curvature, now.side * n.cone), flat);
        for i in 0..2 {
            f[1 + i] = f[1 + i] + back1[i];
            k[1 + i][0] = k[1 + i][0] + (height.slope[i] * now.side * n.cone_d).only(flat);
            c[1 + i][0] = c[1 + i][0] + (height.slope[i] * now.side * n.cone_v).only(flat);
        }
        let moved = plane::sub(u1, u0);
        let restoring =
            h[RESTORING] + plane::dot(plane::scaled(plane::add(back0, back1), half), moved);

        let damped1 = worn.damped;
        let elastic = plane::sub(tau1, damped1);
        let mut stored = restoring + half * plane::dot(elastic, elastic) / it.ks;
        let kn = R::select(now.pulls(), it.tension.kn, it.compression.kn);
        stored = stored + (half * n.spring * n.spring / kn).only(closed);
        if zero.any(it.has_stop) {
            let (force, stiffness, energy) = it.stop.force(u1);
            add(&mut k, &stiffness, it.has_stop);
            f[1] = f[1] + force[0].only(it.has_stop);
            f[2] = f[2] + force[1].only(it.has_stop);
            stored = stored + energy.only(it.has_stop);
        }

        // Exact for a trapezoidal step that stays on its side.
        let same = before.side.le(now.side) & now.side.le(before.side);
        let whole = plane::dot(plane::scaled(plane::add(tau0, tau1), half), plane::sub(end, old));
        let lifted = plane::dot(plane::scaled(tau0, half), plane::sub(end, touch));
        let until = plane::dot(tau0, plane::sub(touch, old));
        let since = plane::dot(tau1, plane::sub(end, touch));
        let apart = R::select(closed, half * (until + since), lifted);
        let heat = R::select(same, whole, apart);
        let (g0, g1) = (before.dashes(), now.dashes());
        let two = at.dt.of(2.0);
        let sum = g0 * (two * gap0.rate + gap.rate) + g1 * (gap0.rate + two * gap.rate);
        let along_gap = at.dt * sum / at.dt.of(6.0);
        let stretched = plane::sub(plane::sub(reached, end), stretched0);
        let both = plane::scaled(plane::add(damped0, damped1), half);
        let viscous = along_gap.max(zero) + plane::dot(both, stretched).max(zero);

        let path = plane::norm(plane::sub(end, touch)).only(closed);
        let mut anchor = end;
        if FULL && inclines {
            let leans = plane::add(end, plane::sub(u1, reached));
            anchor = plane::select(it.inclined(), leans, end);
        }
        (trial[ANCHOR], trial[ANCHOR + 1]) = (anchor[0], anchor[1]);
        trial[SLIP] = h[SLIP] + path;
        trial[SIDE] = now.side;
        trial[SLIPPING] = one.only(rub.slips & zero.lt(n.cone));
        trial[RESTORING] = restoring;
        (trial[SLIP_RATE], trial[UNSTUCK]) = (worn.rate, worn.since);
        (trial[DAMPED], trial[DAMPED + 1]) = (damped1[0], damped1[1]);
        for i in 0..3 {
            out.f[i] = f[i];
            for j in 0..3 {
                out.k[3 * i + j] = k[i][j];
                out.c[3 * i + j] = c[i][j];
            }
        }
        LaneStep { stored, hysteretic: heat.max(zero), viscous }
    }

    #[inline(always)]
    fn contacts<R: Real>(at: &LaneAt<'_, R>, _: &[R], out: &mut [LaneContact<R>]) -> R {
        let it = Numbers::of(at.parameters);
        let (h, zero, half) = (at.history, at.dt.of(0.0), at.dt.of(0.5));
        let gap = it.gap(at.d, at.v);
        let [below, above] = it.clearances(gap.x);
        let load = it.pressed(&gap).normal.cone;
        let mut normal = load;
        if FULL && zero.any(it.inclined()) {
            let u = [at.d[1], at.d[2]];
            let stretch = plane::sub(u, [h[ANCHOR], h[ANCHOR + 1]]);
            let tau = plane::add(plane::scaled(stretch, it.ks), [h[DAMPED], h[DAMPED + 1]]);
            let pressed = Incline::at(&it.dish, it.inclined(), u).normal(load, tau);
            normal = R::select(it.inclined() & zero.lt(load), pressed, load);
        }
        out[0] = LaneContact {
            gap: R::select(it.has_tension, below.min(above), below),
            normal,
            position: [at.d[1], at.d[2]],
            slipping: at.dt.of(1.0).only(half.lt(h[SLIPPING])),
        };
        zero
    }
}
