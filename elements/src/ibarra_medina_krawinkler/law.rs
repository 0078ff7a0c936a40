//! The law over lanes.

use super::backbone::Backbone;
use super::way::{Aim, Way};
use trilith_element::Field;
use trilith_element::lanes::{LaneAt, LaneForce, LaneLaw, LaneStep, Real};

/// k, floor of the stiffness of unloading; of each side yield strength, slopes of hardening and of softening, residual
/// strength, intercept; capacities S, C, A, K; exponents; D of each side; pinching, κ_F, κ_D.
pub(super) const PARAMETERS: usize = 25;
const SIDES: usize = 2;
const CAPACITIES: usize = 12;
const EXPONENTS: usize = 16;
const RATES: usize = 20;
const PINCHING: usize = 22;

/// Where the history has what.
const SIDE: usize = 0;
const TOP: usize = 1;
pub(super) const STIFFNESS: usize = 2;
const STIFFNESS_START: usize = 3;
const HEAT: usize = 4;
const HEAT_START: usize = 5;
const ZERO: usize = 6;
/// From here on twice: upwards, downwards.
const STRENGTH: usize = 10;
const CAPPING: usize = 12;
const REACH: usize = 14;
const PEAK: usize = 16;
const PEAK_FORCE: usize = 18;
pub(super) const HISTORY: usize = 20;

/// Most turns of the search for the heat.
const TURNS: usize = 100;

/// The history variables; deformations and forces are counted outwards on their side.
pub(super) fn fields(rotational: bool) -> Vec<Field> {
    let (length, force, stiffness) =
        if rotational { ("rad", "N·m", "N·m/rad") } else { ("m", "N", "N/m") };
    let all = [
        ("side", "1"),
        ("top", length),
        ("stiffness", stiffness),
        ("stiffness_start", stiffness),
        ("heat", "J"),
        ("heat_start", "J"),
        ("zero", length),
        ("break_at", length),
        ("break_force", force),
        ("join", length),
        ("strength_up", "1"),
        ("strength_down", "1"),
        ("capping_up", "1"),
        ("capping_down", "1"),
        ("reach_up", length),
        ("reach_down", length),
        ("peak_up", length),
        ("peak_down", length),
        ("peak_force_up", force),
        ("peak_force_down", force),
    ];
    all.map(|(name, unit)| Field::new(name, unit)).into()
}

pub(super) fn at_rest(p: &[f64; PARAMETERS], at: &mut [f64]) {
    let k = p[0];
    at[SIDE] = 1.0;
    (at[STIFFNESS], at[STIFFNESS_START]) = (k, k);
    for i in 0..2 {
        let fy = p[SIDES + 5 * i];
        (at[STRENGTH + i], at[CAPPING + i]) = (1.0, 1.0);
        at[REACH + i] = fy / k;
    }
    let (fy, uy) = (p[SIDES], at[REACH]);
    // The first line ends at yield, where it is all elastic.
    at[TOP] = uy;
    at[ZERO..STRENGTH].copy_from_slice(&[0.0, uy, fy, uy]);
}

/// One of two numbers that lie side by side: upwards, downwards.
#[inline(always)]
fn of<R: Real>(up: R::Mask, from: &[R], place: usize) -> R {
    R::select(up, from[place], from[place + 1])
}

/// β of the energy `spent` of an excursion where there were `all` of `capacity`.
#[inline(always)]
fn damage<R: Real>(spent: R, all: R, capacity: R, exponent: R) -> R {
    let (zero, one) = (spent.of(0.0), spent.of(1.0));
    let left = capacity - all;
    let share = R::select(zero.lt(left), spent / left, one).min(one);
    share.powf(exponent)
}

/// A side in its present state.
#[derive(Clone, Copy)]
struct Standing<R> {
    strength: R,
    capping: R,
    reach: R,
}

impl<R: Real> Standing<R> {
    #[inline(always)]
    fn backbone(&self, at: &LaneAt<'_, R>, up: R::Mask) -> Backbone<R> {
        let given =
            |i: usize| R::select(up, at.parameters[SIDES + i], at.parameters[SIDES + 5 + i]);
        let (fy, hardening) = (self.strength * given(0), self.strength * given(1));
        Backbone {
            foot: fy - hardening * (fy / at.parameters[0]),
            hardening,
            intercept: self.capping * given(4),
            softening: given(2),
            residual: given(3),
        }
    }
}

/// Where the spring is after a step.
struct State<R: Real> {
    side: R,
    up: R::Mask,
    turned: R::Mask,
    /// Deformation, force and slope outwards.
    x: R,
    f: R,
    slope: R,
    /// Follows its way, and does not move on the line of unloading.
    flows: R::Mask,
    standing: Standing<R>,
    backbone: Backbone<R>,
    way: Way<R>,
    slopes: [R; 2],
    /// Where the line of unloading meets the way, and the force there.
    top: R,
    top_force: R,
    /// Peak on the side that was left; without force where it is the largest, which is aimed at anyway.
    left_peak: [R; 2],
}

impl<R: Real> State<R> {
    #[inline(always)]
    fn of(at: &LaneAt<'_, R>) -> Self {
        let h = at.history;
        let (zero, one) = (h[SIDE].of(0.0), h[SIDE].of(1.0));
        let (mut side, mut up) = (h[SIDE], zero.lt(h[SIDE]));
        let mut standing = Standing {
            strength: of(up, h, STRENGTH),
            capping: of(up, h, CAPPING),
            reach: of(up, h, REACH),
        };
        let mut backbone = standing.backbone(at, up);
        let [z, break_at, break_force, join] = [0, 1, 2, 3].map(|i| h[ZERO + i]);
        let mut way = Way { zero: z, break_at, break_force, join };
        let mut slopes = way.slopes(&backbone);
        let k = h[STIFFNESS];
        let mut x = side * at.d[0];
        let mut top = h[TOP];
        let mut top_force = way.at(top, slopes, &backbone).0;
        let inner = top.lt(standing.reach);
        let left_peak = [top, top_force.only(inner)];
        let mut foot = top - top_force / k;
        let turned = x.lt(foot);
        if x.any(turned) {
            // The other side, with what the excursion has cost it.
            let other = !up;
            let spent = (h[HEAT] - h[HEAT_START]).max(zero);
            let rate = R::select(other, at.parameters[RATES], at.parameters[RATES + 1]);
            let mut beta = [zero; 3];
            for (i, beta) in beta.iter_mut().enumerate() {
                let (most, exponent) =
                    (at.parameters[CAPACITIES + i], at.parameters[EXPONENTS + i]);
                *beta = rate * damage(spent, h[HEAT], most, exponent);
            }
            let entered = Standing {
                strength: of(other, h, STRENGTH) * (one - beta[0]),
                capping: of(other, h, CAPPING) * (one - beta[1]),
                reach: of(other, h, REACH) * (one + beta[2]),
            };
            let ahead = entered.backbone(at, other);
            let aim = Aim {
                reach: entered.reach,
                peak: [of(other, h, PEAK), of(other, h, PEAK_FORCE)],
                stiffness: k,
                pinching: [0, 1, 2].map(|i| at.parameters[PINCHING + i]),
            };
            let new = Way::new(-foot, &aim, &ahead);
            let each = |yes: R, no: R| R::select(turned, yes, no);
            standing = Standing {
                strength: each(entered.strength, standing.strength),
                capping: each(entered.capping, standing.capping),
                reach: each(entered.reach, standing.reach),
            };
            side = each(-side, side);
            up = zero.lt(side);
            backbone = standing.backbone(at, up);
            way = Way::select(turned, new, way);
            slopes = way.slopes(&backbone);
            (x, top, foot) = (each(-x, x), each(-foot, top), each(-foot, foot));
            top_force = top_force.only(!turned);
        }
        let flows = !x.lt(top);
        let (on_way, slope) = way.at(x, slopes, &backbone);
        let f = R::select(flows, on_way, k * (x - foot));
        let slope = R::select(flows, slope, k);
        Self {
            side,
            up,
            turned,
            x,
            f,
            slope,
            flows,
            standing,
            backbone,
            way,
            slopes,
            top,
            top_force,
            left_peak,
        }
    }

    /// Stiffness of unloading with so much heat, and how it falls with more.
    #[inline(always)]
    fn unloading(&self, at: &LaneAt<'_, R>, heat: R) -> [R; 2] {
        let h = at.history;
        let (zero, one) = (heat.of(0.0), heat.of(1.0));
        let floor = at.parameters[1];
        let begun = R::select(self.turned, h[STIFFNESS], h[STIFFNESS_START]);
        let start = R::select(self.turned, h[HEAT], h[HEAT_START]);
        let (capacity, exponent) = (at.parameters[CAPACITIES + 3], at.parameters[EXPONENTS + 3]);
        let spent = (heat - start).max(zero);
        let beta = damage(spent, heat, capacity, exponent);
        let left = capacity - heat;
        // β' = c β (1/spent + 1/left)
        let rate = exponent * beta * (one / spent + one / left);
        let k = begun * (one - beta);
        let held = k.lt(floor) | !zero.lt(spent);
        [k.max(floor).min(h[STIFFNESS]), (begun * rate).only(!held)]
    }

    /// Heat and stiffness of unloading with all that came in: heat + f²/2K(heat) = energy.
    #[inline(always)]
    fn heat(&self, at: &LaneAt<'_, R>, energy: R) -> [R; 2] {
        let h = at.history;
        let (zero, one, half) = (energy.of(0.0), energy.of(1.0), energy.of(0.5));
        let elastic = half * self.f * self.f;
        let (mut low, mut high) = (h[HEAT], (energy - elastic / h[STIFFNESS]).max(h[HEAT]));
        let mut heat = high;
        let small = energy.of(1e-15) * (energy.abs() + elastic / h[STIFFNESS]);
        // Where a line is steeper than K would be, nothing is spent and K is what holds all that came in.
        let kept = low;
        let held = (energy + small).lt(low + elastic / self.unloading(at, low)[0]);
        // Newton's method from above, within brackets; what is found stays as it is, whatever its neighbours do.
        let mut open = self.flows & !held;
        for _ in 0..TURNS {
            if !energy.any(open) {
                break;
            }
            let [k, fall] = self.unloading(at, heat);
            let lack = heat + elastic / k - energy;
            let slope = one + elastic * fall / (k * k);
            let below = lack.lt(zero);
            (low, high) = (R::select(below, heat, low), R::select(below, high, heat));
            let next = heat - lack / slope;
            let inside = low.le(next) & next.le(high);
            let next = R::select(inside, next, half * (low + high));
            let goes_on = open & small.lt((next - heat).abs());
            heat = R::select(open, next, heat);
            open = goes_on;
        }
        let heat = R::select(self.flows & !held, heat, kept);
        let k = R::select(held, elastic / (energy - kept), self.unloading(at, heat)[0]);
        [heat, R::select(self.flows, k, h[STIFFNESS])]
    }
}

/// The law over lanes.
pub(super) struct Law;

impl LaneLaw for Law {
    const COORDINATES: usize = 1;
    const HISTORY: usize = HISTORY;
    const PARAMETERS: usize = PARAMETERS;
    const IS_LONG: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let it = State::of(at);
        (out.f[0], out.k[0], out.c[0]) = (it.side * it.f, it.slope, it.f.of(0.0));
        finished(at, &it, trial)
    }
}

/// History and energies at the end of a step.
#[inline(always)]
fn finished<R: Real>(at: &LaneAt<'_, R>, it: &State<R>, trial: &mut [R]) -> LaneStep<R> {
    let h = at.history;
    let (zero, half) = (it.f.of(0.0), it.f.of(0.5));
    let elastic = half * it.top_force * it.top_force / h[STIFFNESS];
    let area = |x: R| it.way.area(x, it.slopes, &it.backbone);
    let done = h[HEAT] + elastic + (area(it.x) - area(it.top)).only(it.flows);
    let [heat, stiffness] = it.heat(at, done);
    let heat = heat.max(h[HEAT]);
    trial[SIDE] = it.side;
    trial[TOP] = R::select(it.flows, it.x, it.top);
    trial[STIFFNESS] = stiffness;
    trial[STIFFNESS_START] = R::select(it.turned, h[STIFFNESS], h[STIFFNESS_START]);
    trial[HEAT] = heat;
    trial[HEAT_START] = R::select(it.turned, h[HEAT], h[HEAT_START]);
    let Way { zero: z, break_at, break_force, join } = it.way;
    trial[ZERO..STRENGTH].copy_from_slice(&[z, break_at, break_force, join]);
    let reach = R::select(it.flows, it.standing.reach.max(it.x), it.standing.reach);
    // The peak that was left, unless nothing was loaded there.
    let left = it.turned & h[ZERO].lt(h[TOP]);
    for (i, here) in [(0, it.up), (1, !it.up)] {
        let own = |place: usize, value: R| R::select(here, value, h[place + i]);
        trial[STRENGTH + i] = own(STRENGTH, it.standing.strength);
        trial[CAPPING + i] = own(CAPPING, it.standing.capping);
        trial[REACH + i] = own(REACH, reach);
        let kept = |place: usize, value: R| R::select(left & !here, value, h[place + i]);
        trial[PEAK + i] = kept(PEAK, it.left_peak[0]);
        trial[PEAK_FORCE + i] = kept(PEAK_FORCE, it.left_peak[1]);
    }
    let stored = half * it.f * it.f / stiffness;
    LaneStep { stored, hysteretic: heat - h[HEAT], viscous: zero }
}
