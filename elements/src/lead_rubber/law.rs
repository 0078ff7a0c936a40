//! The law over lanes.

use super::LeadHistory;
use super::cooling::Cooling;
use crate::shared::bouc_wen_plane::{self, Shaped};
use trilith_element::History;
use trilith_element::lanes::{LaneAt, LaneForce, LaneLaw, LaneStep, Real};

/// k_r, Y, k_v, A σ₀, E, 1 where it heats up, ρ c A h, the three numbers of the cooling, shape.
pub(super) const PARAMETERS: usize = SHAPE + bouc_wen_plane::NUMBERS;
const HISTORY: usize = LeadHistory::FIELDS.len();
const COOLING: usize = 7;
const SHAPE: usize = 10;
/// z along U2 and U3, and then these.
const TEMPERATURE: usize = 2;
const HEATED: usize = 3;
const STRETCH: usize = 4;

/// Temperature at the end of a step, its derivative by the loss, and the heat.
struct Warmed<R> {
    temperature: R,
    by_loss: R,
    heat: R,
}

/// Force of the core at a temperature rise.
#[inline(always)]
fn strength<R: Real>(p: &[R], temperature: R) -> R {
    p[3] * (-p[4] * temperature).exp_by_vectors()
}

/// A step with this loss Σ ∫ zᵢ (ωᵢ − żᵢ) du; `before`: force of the core at its start.
#[inline(always)]
fn warmed<R: Real>(at: &LaneAt<'_, R>, before: R, loss: R) -> Warmed<R> {
    let p = at.parameters;
    let (zero, half, one) = (loss.of(0.0), loss.of(0.5), loss.of(1.0));
    let (y, e, capacity) = (p[1], p[4], p[6]);
    let old = at.history[TEMPERATURE];
    let cold = Warmed { temperature: old, by_loss: zero, heat: before * y * loss };
    let heats = half.lt(p[5]) & zero.lt(at.dt);
    if !zero.any(heats) {
        return cold;
    }
    let cooling = Cooling { rate: p[COOLING], diffusion: p[COOLING + 1], shims: p[COOLING + 2] };
    let (t, middle) = (at.history[HEATED], at.history[HEATED] + half * at.dt);
    let start = old * (-cooling.over(t, middle)).exp_by_vectors();
    // ρ c A h dT = Q₀ e^(−E T) Y dl
    let slope = strength(p, start) * y / capacity;
    let rise = (e * slope * loss).ln_1p() / e;
    let later = (-cooling.over(middle, t + at.dt)).exp_by_vectors();
    Warmed {
        temperature: R::select(heats, (start + rise) * later, old),
        by_loss: (later * slope / (one + e * slope * loss)).only(heats),
        heat: R::select(heats, capacity * rise, cold.heat),
    }
}

/// The law, with z in closed form or by steps.
pub(super) struct Law<const CLOSED: bool>;

impl<const CLOSED: bool> LaneLaw for Law<CLOSED> {
    const COORDINATES: usize = 3;
    const HISTORY: usize = HISTORY;
    const PARAMETERS: usize = PARAMETERS;
    const IS_LONG: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let (p, h) = (at.parameters, at.history);
        let (kr, y, kv, softening) = (p[0], p[1], p[2], p[4]);
        let (zero, half) = (kr.of(0.0), kr.of(0.5));
        let z0 = [h[0], h[1]];
        let omega = [(at.d[1] - at.d0[1]) / y, (at.d[2] - at.d0[2]) / y];
        let shape = Shaped::of(&p[SHAPE..]);
        let moved = shape.advance::<2, CLOSED>(z0, omega, [at.v[1], at.v[2]]);
        let loss = moved.loss[0] + moved.loss[1];
        let before = strength(p, h[TEMPERATURE]);
        let Warmed { temperature, by_loss, heat } = warmed(at, before, loss.x);
        let q = strength(p, temperature);
        let z = [moved.z[0].x, moved.z[1].x];

        out.k.fill(zero);
        out.c.fill(zero);
        out.f[0] = kv * at.d[0];
        out.k[0] = kv;
        let mut stored = half * kv * at.d[0] * at.d[0];
        for i in 0..2 {
            let d = at.d[i + 1];
            out.f[i + 1] = kr * d + q * z[i];
            stored = stored + half * kr * d * d;
            for j in 0..2 {
                let weaker = -softening * q * by_loss * loss.by[j];
                out.k[3 * (i + 1) + j + 1] = (q * moved.z[i].by[j] + z[i] * weaker) / y;
            }
            out.k[4 * (i + 1)] = out.k[4 * (i + 1)] + kr;
            trial[i] = z[i];
        }

        let square = z[0] * z[0] + z[1] * z[1];
        let change = half * y * (square - (z0[0] * z0[0] + z0[1] * z0[1]));
        let stretched = h[STRETCH] + half * (before + q) * change;
        let stretch = stretched.min(half * q * y * square);
        trial[TEMPERATURE] = temperature;
        trial[HEATED] = (h[HEATED] + at.dt).only(zero.lt(temperature));
        trial[STRETCH] = stretch;
        LaneStep { hysteretic: heat + (stretched - stretch), ..LaneStep::elastic(stored + stretch) }
    }
}
