//! The contact itself over [`Real`]: one text for a single analysis and for sweeps in lanes.
//!
//! `T` tangential directions: 2 in space, 1 in a plane. `FLAGS` says which parts there are.

use super::{NLinkHistory, NLinkRubbing};
use crate::shared::sliding::{Cone, Rubbed, Rubbing, Worn};
use crate::shared::touch::hold;
use trilith_element::History;
use trilith_element::lanes::{LaneAt, LaneContact, LaneForce, LaneLaw, LaneStep, Real};

/// There is a post-slip spring or a pendulum.
pub(super) const RESTORING: u8 = 2;
/// Friction looks at the slip: at its rate, or for its break-away, or there is a dashpot beside its spring. It
/// remembers more than its anchor then. Always with [`RESTORING`].
pub(super) const VARIED: u8 = 4;
/// There is no dashpot, and friction does not look at rates either; alone or with [`RESTORING`].
pub(super) const UNDAMPED: u8 = 8;

/// The law without the rotational springs.
pub(crate) struct NLinkContact<const T: usize, const FLAGS: u8>;

/// Parameters in the order of their slice.
#[derive(Clone, Copy)]
struct Of<R> {
    kn: R,
    opening: R,
    damping: R,
    /// Stiffness of the elastic–plastic branch; 0 without friction.
    ke: R,
    mu: R,
    k_post: R,
    /// 1/R of the pendulum.
    curvature: R,
    /// 1/kₙ and 1/kₑ; 0 without friction.
    flexibility: [R; 2],
    /// 1 where the dashpot may pull while closed, else 0.
    pull: R,
    varied: Varied<R>,
}

/// Parameters of friction that looks at the slip.
#[derive(Clone, Copy)]
struct Varied<R> {
    slow: R,
    fast: R,
    rate: R,
    /// μ before it breaks away less that of slow slip, and the slip over which that is gone.
    away: R,
    over: R,
    /// Dashpot beside the spring.
    dashpot: R,
}

/// Numbers of parameters, without and with [`VARIED`].
pub(crate) const PARAMETERS: [usize; 2] = [10, 16];

impl<R: Real> Of<R> {
    #[inline(always)]
    fn read(p: &[R]) -> Self {
        let (plain, more) = p.split_at(PARAMETERS[0]);
        let plain: &[R; PARAMETERS[0]] = plain.try_into().expect("parameters of a contact");
        let [kn, opening, damping, ke, mu, k_post, curvature, fn_, fe, pull] = *plain;
        let zero = kn.of(0.0);
        let more: [R; 6] = more.try_into().unwrap_or([zero; 6]);
        let [slow, fast, rate, away, over, dashpot] = more;
        Self {
            kn,
            opening,
            damping,
            ke,
            mu,
            k_post,
            curvature,
            flexibility: [fn_, fe],
            pull,
            varied: Varied { slow, fast, rate, away, over, dashpot },
        }
    }
}

/// What the contact does along its normal; see [`Normal`](crate::shared::sliding::Normal).
#[derive(Clone, Copy)]
struct Pressed<R: Real> {
    open: R::Mask,
    spring: R,
    f: R,
    f_d: R,
    f_v: R,
    cone: R,
    cone_d: R,
    cone_v: R,
}

impl<const T: usize, const FLAGS: u8> NLinkContact<T, FLAGS> {
    #[inline(always)]
    fn pressed<R: Real>(it: &Of<R>, gap: R, rate: R) -> Pressed<R> {
        let zero = gap.of(0.0);
        let p = -gap;
        let open = p.lt(zero);
        let closed = !open;
        let (spring, kn) = ((it.kn * p).only(closed), it.kn.only(closed));
        if FLAGS & UNDAMPED != 0 {
            let f = (it.kn * gap).only(closed);
            let (cone, cone_d) = (spring, -kn);
            return Pressed { open, spring, f, f_d: kn, f_v: zero, cone, cone_d, cone_v: zero };
        }
        let (dashpot, [share, by_gap]) = (it.damping * rate, hold(gap, rate));
        let c = (it.damping * share).only(closed);
        let k = (it.kn + dashpot * by_gap).only(closed);
        // Zeros are kept from the sign that a subtraction of nothing would give them.
        let f = (dashpot * share - it.kn * p).only(closed);
        let pulls = zero.lt(it.pull);
        let holds = pulls | !zero.lt(f);
        let (f, f_d, f_v) = (f.only(holds), k.only(holds), c.only(holds));
        // Where the dashpot may pull, friction looks at the spring alone.
        let of = |spring: R, all: R| R::select(pulls, spring, -all);
        let (cone, cone_d, cone_v) = (of(spring, f), of(-kn, f_d), of(zero, f_v));
        Pressed { open, spring, f, f_d, f_v, cone, cone_d, cone_v }
    }

    /// Length of a tangential vector.
    #[inline(always)]
    fn length<R: Real>(x: [R; T]) -> R {
        if T == 1 { x[0].abs() } else { x[0].hypot(x[1]) }
    }

    #[inline(always)]
    fn tangential<R: Real>(x: &[R]) -> [R; T] {
        x[1..=T].try_into().expect("T tangential coordinates")
    }

    /// Restoring stiffness at a spring force.
    #[inline(always)]
    fn restoring<R: Real>(it: &Of<R>, spring: R) -> R {
        spring.mul_add(it.curvature, it.k_post)
    }

    /// Anchor at the start of the step, or at the moment of closing within the step, and its
    /// derivatives: by dₜ (a factor) and by d₁.
    #[inline(always)]
    fn anchor<R: Real>(it: &Of<R>, at: &LaneAt<'_, R>, now: &Pressed<R>) -> ([R; T], R, [R; T]) {
        let zero = it.kn.of(0.0);
        let old: [R; T] = [at.history[0], at.history[1]][..T].try_into().expect("T ≤ 2");
        let gap0 = at.d0[0] + it.opening;
        let closes = zero.lt(gap0) & !now.open;
        if !zero.any(closes) {
            return (old, zero, [zero; T]);
        }
        let gap = at.d[0] + it.opening;
        let left = gap0 - gap;
        let share = (gap0 / left).only(closes);
        let by_gap = (share / left).only(closes);
        let (mut a, mut by) = (old, [zero; T]);
        for i in 0..T {
            let delta = at.d[1 + i] - at.d0[1 + i];
            a[i] = R::select(closes, at.d0[1 + i] + share * delta, old[i]);
            by[i] = delta * by_gap;
        }
        (a, share, by)
    }
}

/// Friction that looks at the slip.
impl<const T: usize, const FLAGS: u8> NLinkContact<T, FLAGS> {
    /// What it remembers.
    #[inline(always)]
    fn worn<R: Real>(at: &LaneAt<'_, R>) -> Worn<R, T> {
        let own = &at.history[NLinkHistory::FIELDS.len()..];
        let damped = own[2..2 + T].try_into().expect("T ≤ 2");
        Worn { rate: own[0], since: own[1], damped }
    }

    /// The friction coefficient after a step.
    #[inline(always)]
    fn coefficient<R: Real>(it: &Of<R>, at: &LaneAt<'_, R>, now: &Pressed<R>) -> R {
        if FLAGS & VARIED == 0 {
            return it.mu;
        }
        let Varied { slow, fast, rate, away, over, .. } = it.varied;
        let (zero, one, two) = (slow.of(0.0), slow.of(1.0), slow.of(2.0));
        let worn = Self::worn(at);
        let mu = fast - (fast - slow) * (-rate * worn.rate).exp();
        let over = over.max(two * away * now.cone / it.ke);
        let left = (one - worn.since / over).max(zero);
        mu + (away * left).only(zero.lt(away))
    }

    /// The friction of a contact that is closed at the end, with the anchor of the step.
    #[inline(always)]
    fn rubbed<R: Real>(
        it: &Of<R>,
        at: &LaneAt<'_, R>,
        now: &Pressed<R>,
        anchor: [R; T],
    ) -> Rubbed<R, T> {
        let Varied { slow, fast, rate, away, over, dashpot } = it.varied;
        let zero = it.kn.of(0.0);
        let of = |mu: R| [mu * now.cone, mu];
        let cone = Cone {
            fast: of(fast),
            less: of(fast - slow),
            pace: [rate, zero],
            more: of(away),
            over,
        };
        let (end, start) = (Self::tangential(at.d), Self::tangential(at.d0));
        let (mut stretch, mut way) = ([zero; T], [zero; T]);
        for i in 0..T {
            stretch[i] = end[i] - anchor[i];
            way[i] = end[i] - start[i];
        }
        let speed = Self::tangential(at.v);
        let was = Self::worn(at);
        Rubbing { spring: it.ke, dashpot, stretch, way, speed, dt: at.dt, was }.on(&cone)
    }

    #[inline(always)]
    fn varied_force<R: Real>(
        it: &Of<R>,
        at: &LaneAt<'_, R>,
        now: &Pressed<R>,
        out: &mut LaneForce<'_, R>,
    ) {
        let n = 1 + T;
        let one = it.kn.of(1.0);
        let (a, by_dt, by_d1) = Self::anchor(it, at, now);
        let it_rubs = Self::rubbed(it, at, now, a);
        let rubs = !now.open & it.kn.of(0.0).lt(it.ke);
        for i in 0..T {
            let row = (1 + i) * n;
            let by_normal = it_rubs.by_normal[i].only(rubs);
            out.f[1 + i] = it_rubs.tau[i].only(rubs);
            out.k[row] = by_normal * now.cone_d;
            out.c[row] = by_normal * now.cone_v;
            for j in 0..T {
                let stretch = it_rubs.by_stretch[i][j].only(rubs);
                out.k[row + 1 + j] = stretch * (one - by_dt) + it_rubs.by_way[i][j].only(rubs);
                out.k[row] = out.k[row] - stretch * by_d1[j];
                out.c[row + 1 + j] = it_rubs.by_speed[i][j].only(rubs);
            }
        }
    }

    /// Adds the forces that pull back.
    #[inline(always)]
    fn restore<R: Real>(
        it: &Of<R>,
        at: &LaneAt<'_, R>,
        now: &Pressed<R>,
        out: &mut LaneForce<'_, R>,
    ) {
        let n = 1 + T;
        let closed = !now.open;
        let kr = Self::restoring(it, now.spring).only(closed);
        for i in 0..T {
            let row = (1 + i) * n;
            out.f[1 + i] = out.f[1 + i] + kr * at.d[1 + i];
            out.k[row + 1 + i] = out.k[row + 1 + i] + kr;
            out.k[row] = out.k[row] - (it.kn * it.curvature).only(closed) * at.d[1 + i];
        }
    }
}

impl<const T: usize, const FLAGS: u8> NLinkContact<T, FLAGS> {
    /// Force and tangents.
    #[inline(always)]
    pub(crate) fn force<R: Real>(at: &LaneAt<'_, R>, out: &mut LaneForce<'_, R>) {
        let n = 1 + T;
        let it = Of::read(at.parameters);
        let zero = it.kn.of(0.0);
        let now = Self::pressed(&it, at.d[0] + it.opening, at.v[0]);
        let closed = !now.open;
        out.f[0] = now.f;
        out.k[0] = now.f_d;
        out.c[0] = now.f_v;
        for j in 1..n {
            out.k[j] = zero;
            out.c[j] = zero;
        }

        if FLAGS & VARIED != 0 {
            Self::varied_force(&it, at, &now, out);
            if FLAGS & RESTORING != 0 {
                Self::restore(&it, at, &now, out);
            }
            return;
        }

        // Friction: radial return of the elastic trial force onto the cone.
        let (a, by_dt, by_d1) = Self::anchor(&it, at, &now);
        let limit = it.mu * now.cone;
        let mut xi = Self::tangential(at.d);
        for i in 0..T {
            xi[i] = xi[i] - a[i];
        }
        let length = if T == 1 { xi[0].abs() } else { (xi[0] * xi[0] + xi[1] * xi[1]).sqrt() };
        let sticks = (it.ke * length).le(limit) & zero.lt(limit);
        let nowhere = length.le(zero);
        // Direction of the stretch; zero where there is none.
        let mut along = [zero; T];
        if T == 1 {
            let one = it.kn.of(1.0);
            along[0] = R::select(nowhere, zero, R::select(xi[0].lt(zero), -one, one));
        } else {
            for i in 0..T {
                along[i] = R::select(nowhere, zero, xi[i] / length);
            }
        }
        let turn = if T == 1 { zero } else { R::select(nowhere, zero, limit / length) };
        // Slips without friction too, with a force of zero.
        let rubs = closed & zero.lt(it.ke);
        for i in 0..T {
            let tau = R::select(sticks, xi[i] * it.ke, along[i] * limit).only(rubs);
            // By the limit: zero while it sticks.
            let by_limit = along[i].only(!sticks & rubs);
            let row = (1 + i) * n;
            let mut by_d1_total = by_limit * (it.mu * now.cone_d);
            out.c[row] = if FLAGS & UNDAMPED == 0 { by_limit * (it.mu * now.cone_v) } else { zero };
            for j in 0..T {
                let own = it.kn.of(f64::from(u8::from(i == j)));
                let across = if T == 1 { zero } else { (own - along[i] * along[j]) * turn };
                let stretch = R::select(sticks, own * it.ke, across).only(rubs);
                out.k[row + 1 + j] = stretch * (it.kn.of(1.0) - by_dt);
                by_d1_total = by_d1_total - stretch * by_d1[j];
                out.c[row + 1 + j] = zero;
            }
            out.f[1 + i] = tau;
            if FLAGS & RESTORING != 0 {
                let kr = Self::restoring(&it, now.spring).only(closed);
                out.f[1 + i] = tau + kr * at.d[1 + i];
                out.k[row + 1 + i] = out.k[row + 1 + i] + kr;
                by_d1_total = by_d1_total - (it.kn * it.curvature).only(closed) * at.d[1 + i];
            }
            out.k[row] = by_d1_total;
        }
    }

    /// History and energies, where the force is known.
    #[inline(always)]
    fn finish<R: Real>(at: &LaneAt<'_, R>, f: &[R], trial: &mut [R]) -> LaneStep<R> {
        let it = Of::read(at.parameters);
        let (zero, half) = (it.kn.of(0.0), it.kn.of(0.5));
        let before = Self::pressed(&it, at.d0[0] + it.opening, at.v0[0]);
        let now = Self::pressed(&it, at.d[0] + it.opening, at.v[0]);
        let (was, closed) = (!before.open, !now.open);
        let rubs = closed & zero.lt(it.ke);
        let (a, _, _) = Self::anchor(&it, at, &now);
        let (d0, d1) = (Self::tangential::<R>(at.d0), Self::tangential::<R>(at.d));
        let rubbed = if FLAGS & VARIED == 0 { None } else { Some(Self::rubbed(&it, at, &now, a)) };
        let mut xi = d1;
        for i in 0..T {
            xi[i] = d1[i] - a[i];
        }
        let sticks = match &rubbed {
            Some(rubbed) => rubbed.sticks,
            None => {
                let limit = it.mu * now.cone;
                let length =
                    if T == 1 { xi[0].abs() } else { (xi[0] * xi[0] + xi[1] * xi[1]).sqrt() };
                (it.ke * length).le(limit) & zero.lt(limit)
            }
        };
        let kr0 = Self::restoring(&it, before.spring).only(was);
        let kr1 = Self::restoring(&it, now.spring).only(closed);
        let [by_kn, by_ke] = it.flexibility;

        let (mut restoring, mut friction, mut sum) = (at.history[4], zero, zero);
        let mut damped = zero;
        let (mut tau, mut slip) = ([zero; T], [zero; T]);
        for i in 0..T {
            tau[i] = if FLAGS & RESTORING == 0 { f[1 + i] } else { f[1 + i] - kr1 * d1[i] };
            tau[i] = tau[i].only(rubs);
            let mut tau0 = (it.ke * (d0[i] - at.history[i])).only(was);
            let mut spring = tau[i];
            let dashpot = rubbed.map(|r| {
                let q0 = Self::worn(at).damped[i].only(was);
                let q1 = r.worn.damped[i].only(rubs);
                tau0 = tau0 + q0;
                tau[i] = r.tau[i].only(rubs);
                spring = tau[i] - q1;
                (q0, q1)
            });
            // Where it starts from, and where the spring is unstretched at the end.
            let start = R::select(closed, a[i], R::select(was, at.history[i], d0[i]));
            let slid = R::select(sticks, a[i], d1[i] - spring * by_ke);
            let end = R::select(rubs, slid, d1[i]);
            slip[i] = end - start;
            trial[i] = end;
            friction = friction + (tau0 + tau[i]) * slip[i];
            sum = sum + spring * spring;
            if let Some((q0, q1)) = dashpot {
                let stretched = (d1[i] - end) - (d0[i] - at.history[i]).only(was);
                damped = damped + (q0 + q1) * stretched;
            }
            if FLAGS & RESTORING != 0 {
                restoring = restoring + half * (kr0 * d0[i] + kr1 * d1[i]) * (d1[i] - d0[i]);
            }
        }
        if T == 1 {
            trial[1] = zero;
        }
        trial[2] = at.history[2] + Self::length(slip).only(rubs);
        trial[3] = it.kn.of(1.0).only(closed);
        trial[4] = restoring;
        // Of the dashpot, where there is one.
        let mut viscous = zero;
        if FLAGS & UNDAMPED == 0 && zero.any(zero.lt(it.damping)) {
            viscous = at.viscous_work(0, before.f + before.spring, now.f + now.spring);
        }
        if let Some(rubbed) = rubbed {
            let own = &mut trial[NLinkHistory::FIELDS.len()..];
            own[0] = rubbed.worn.rate.only(rubs);
            own[1] = rubbed.worn.since.only(rubs);
            own[3] = zero;
            for i in 0..T {
                own[2 + i] = rubbed.worn.damped[i].only(rubs);
            }
            viscous = viscous + (half * damped).max(zero);
        }
        LaneStep {
            stored: half * now.spring * now.spring * by_kn + restoring + half * sum * by_ke,
            hysteretic: (half * friction).max(zero),
            viscous,
        }
    }
}

impl<const T: usize, const FLAGS: u8> LaneLaw for NLinkContact<T, FLAGS> {
    const COORDINATES: usize = 1 + T;
    const HISTORY: usize = NLinkHistory::FIELDS.len()
        + if FLAGS & VARIED == 0 { 0 } else { NLinkRubbing::FIELDS.len() };
    const PARAMETERS: usize = PARAMETERS[if FLAGS & VARIED == 0 { 0 } else { 1 }];
    const CONTACTS: usize = 1;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        Self::force(at, out);
        Self::finish(at, out.f, trial)
    }

    #[inline(always)]
    fn contacts<R: Real>(at: &LaneAt<'_, R>, f: &[R], out: &mut [LaneContact<R>]) -> R {
        let it = Of::read(at.parameters);
        let zero = it.kn.of(0.0);
        let now = Self::pressed(&it, at.d[0] + it.opening, at.v[0]);
        let d: [R; T] = Self::tangential(at.d);
        let kr = Self::restoring(&it, now.spring).only(!now.open);
        let mut tau = [zero; T];
        for i in 0..T {
            tau[i] = if FLAGS & RESTORING == 0 { f[1 + i] } else { f[1 + i] - kr * d[i] };
        }
        // The force at the limit was scaled onto it: equal up to rounding.
        let most = Self::coefficient(&it, at, &now) * now.cone * it.kn.of(1.0 - 1e-9);
        let slips = zero.lt(now.cone) & zero.lt(it.ke) & most.le(Self::length(tau));
        out[0] = LaneContact {
            gap: at.d[0] + it.opening,
            normal: now.cone,
            position: [d[0], if T == 1 { zero } else { d[T - 1] }],
            slipping: it.kn.of(1.0).only(slips),
        };
        zero
    }
}
