//! A circular base: contact along a rim, in closed form, so that the body rolls on it without corners.
//!
//! ```text
//!   w = Rᵀ e_z,  s = √(w₁² + w₂²)                   the vertical in the axes of the body, sine of the tilt
//!   a = −u_z − h (1 − w₃),  b = ρ s                  penetration of the rim: δ(ψ) = a + b cos ψ, ψ from its lowest point
//!   U = (kₙ/4π) ∫ δ² dψ over |ψ| < ψ꜀,  cos ψ꜀ = −a/b     ψ꜀ = π where the whole rim is pressed
//!   N = ∂U/∂a,  moment ∂U/∂w × w                    forces of the springs
//!   c/(2π) δ̇ over the same arc                      dashpots; they may pull
//!   r꜀ = (−w₁ g/N, −w₂ g/N, −h),  g = ∂U/∂b ρ²/b     centre of pressure in the axes of the body
//!   T ← T + kₛ Δs, |T| ≤ μ N                         friction there; Δs: way of the material point
//!   M ← M + kₛ ρ² Δϑ, |M| ≤ μ N ρ m                  torsion about the vertical, see `drilling.rs`
//! ```
//!
//! Rolling moves the centre of pressure along the rim without slip, because T follows the way of the
//! material that is there. A rim that closes within a step anchors where it is at its end.

use super::RockingBody;
use super::drilling;
use crate::shared::dual::{Dual, cross, dot, times, transposed_times};
use crate::shared::rotation::Turn;
use crate::shared::wrench::Wrench;
use std::f64::consts::PI;
use trilith_element::{Contact, Field, History, Kinematics, history};

history! {
    /// Friction of the rim.
    pub(super) struct RimHistory {
        /// Friction force along X and Y on the body's contact.
        traction1: "N",
        traction2: "N",
        /// Moment of friction about the vertical.
        torsion: "N*m",
        /// Slip along X and Y so far.
        slip1: "m",
        slip2: "m",
        /// 1 while closed; for records.
        closed: "1",
    }
}

/// Variables: u, φ, u̇ and Ω.
const ALL: usize = 12;
type Number = Dual<ALL>;
type V3<const N: usize = ALL> = [Dual<N>; 3];

/// The body at one moment, with the derivatives by all variables or none.
struct Motion<const N: usize> {
    u: V3<N>,
    /// R, row by row.
    r: [V3<N>; 3],
    /// 1 − w₃ with all its digits.
    sunk: Dual<N>,
    rate: V3<N>,
    spin: V3<N>,
}

impl<const N: usize> Motion<N> {
    fn new(turn: &Turn, d: &[f64], v: &[f64]) -> Self {
        let r: [V3<N>; 3] = turn.dual(3);
        let [_, x, y, _] = turn.quaternion;
        let sunk = r[2][2].map(2.0 * (x * x + y * y), -1.0);
        Self {
            u: Dual::variables(d, 0),
            r,
            sunk,
            rate: Dual::variables(&v[..3], 6),
            spin: Dual::variables(&v[3..], 9),
        }
    }
}

/// The arc that is pressed.
struct Arc<const N: usize> {
    /// How deep its plane is pressed in at the middle of the rim, and the square of the sine of the tilt.
    depth: Dual<N>,
    square: Dual<N>,
    /// Half of its angle, and sine and cosine of it.
    half: Dual<N>,
    sine: Dual<N>,
    cosine: Dual<N>,
    /// Direction from the centre to the lowest point in the axes of the body; none for the whole rim.
    low: Option<[Dual<N>; 2]>,
}

/// What the rim does at one moment.
struct Pressed<const N: usize> {
    /// Energy of the springs, J.
    energy: f64,
    /// Normal force of the springs.
    normal: Dual<N>,
    /// Height of the lowest point, negative while pressed.
    gap: f64,
    /// −N of springs and dashpots, and the force conjugate to w.
    lift: Dual<N>,
    q: V3<N>,
    /// Centre of pressure in the axes of the body.
    centre: V3<N>,
    arc: Arc<N>,
    /// Power of the dashpots, W.
    power: f64,
}

/// A circular base of a body.
pub(super) struct Rim<'a> {
    pub body: &'a RockingBody,
    pub radius: f64,
    pub depth: f64,
}

impl Rim<'_> {
    /// Forces of springs and dashpots; none while open.
    fn pressed<const N: usize>(&self, m: &Motion<N>) -> Result<Pressed<N>, f64> {
        let (rho, h) = (self.radius, self.depth);
        let per_angle = self.body.kn / (2.0 * PI);
        let w = m.r[2];
        let a = -m.u[2] - m.sunk * h;
        let square = w[0] * w[0] + w[1] * w[1];
        let b = rho * square.x.sqrt();
        if a.x <= -b {
            return Err(-(a.x + b));
        }
        let (normal, g, energy, arc);
        if a.x >= b {
            normal = a * self.body.kn;
            g = Dual::constant(0.5 * self.body.kn * rho * rho);
            energy = 0.5 * self.body.kn * (a.x * a.x + 0.5 * b * b);
            arc = Arc {
                depth: a,
                square,
                half: Dual::constant(PI),
                sine: Dual::constant(0.0),
                cosine: Dual::constant(-1.0),
                low: None,
            };
        } else {
            let tilt = square.sqrt();
            let b = tilt * rho;
            let cosine = -(a / b);
            // Where the arc begins or closes its angle has no slope; what is made of it has.
            let sine = (1.0 - cosine.x * cosine.x).max(0.0).sqrt();
            let psi = cosine.x.acos();
            let slope = -1.0 / sine.max(1e-6);
            let both = psi + sine * cosine.x;
            let by = |x: f64, by_a: f64, by_b: f64| {
                a.with(b, per_angle * x, per_angle * by_a, per_angle * by_b)
            };
            normal = by(2.0 * (a.x * psi + b.x * sine), 2.0 * psi, 2.0 * sine);
            let by_b = by(2.0 * a.x * sine + b.x * both, 2.0 * sine, both);
            g = by_b * (rho * rho) / b;
            energy = 0.5 * (a.x * normal.x + b.x * by_b.x);
            arc = Arc {
                depth: a,
                square,
                half: cosine.map(psi, slope),
                sine: cosine.map(sine, cosine.x * slope),
                cosine,
                low: Some([-(w[0] / tilt), -(w[1] / tilt)]),
            };
        }
        let (damped, q2, power) = self.dashpots(m, &w, &arc);
        let total = normal + damped;
        Ok(Pressed {
            energy,
            normal,
            gap: -(a.x + b),
            lift: -total,
            q: [g * w[0] + q2[0], g * w[1] + q2[1], total * h],
            centre: [-(w[0] * g / normal), -(w[1] * g / normal), Dual::constant(-h)],
            arc,
            power,
        })
    }

    /// Mean distance of what presses from its centre, over the radius.
    fn arm(&self, Pressed { normal, arc, .. }: &Pressed<ALL>) -> Number {
        let circle = |a: Number| {
            let flat = arc.square * (self.radius * self.radius) / (a * a);
            let (m, slope) = drilling::of_circle(flat.x);
            flat.map(m, slope)
        };
        let piece = |half: Number| {
            let (m, slope) = drilling::of_arc(half.x);
            half.map(m, slope)
        };
        let Some(stiffness) = self.body.arc_stiffness else {
            return if arc.low.is_some() { piece(arc.half) } else { circle(arc.depth) };
        };
        // As deep as it would be pressed in.
        let depth = *normal * stiffness.recip();
        if depth.x * depth.x >= arc.square.x * self.radius * self.radius {
            return circle(depth);
        }
        let share = depth * PI / (arc.square.sqrt() * self.radius);
        let (half, slope) = drilling::arc(share.x);
        piece(share.map(half, slope))
    }

    /// No more than that, at once.
    fn least_arm(&self, Pressed { normal, arc, .. }: &Pressed<ALL>) -> f64 {
        let Some(stiffness) = self.body.arc_stiffness else {
            return drilling::least_of_arc(arc.half.x);
        };
        let share = normal.x * PI / (stiffness * arc.square.x.sqrt() * self.radius);
        // A half angle in which a rim of this stiffness carries less: sin ψ − ψ cos ψ ≤ ψ³/3.
        drilling::least_of_arc((3.0 * share).cbrt().min(PI))
    }

    /// Normal force of the dashpots, their force conjugate to (w₁, w₂), and their power.
    fn dashpots<const N: usize>(
        &self,
        m: &Motion<N>,
        w: &V3<N>,
        arc: &Arc<N>,
    ) -> (Dual<N>, [Dual<N>; 2], f64) {
        let c = self.body.damping / (2.0 * PI);
        let turning = cross(w, &m.spin);
        let sinking = turning[2] * self.depth - m.rate[2];
        let Some(low) = arc.low else {
            let q = [turning[0], turning[1]].map(|x| x * (c * PI * self.radius * self.radius));
            let normal = sinking * (2.0 * PI * c);
            let power = normal * sinking + q[0] * turning[0] + q[1] * turning[1];
            return (normal, q, power.x);
        };
        let across = [-low[1], low[0]];
        let along = |e: &[Dual<N>; 2]| -(turning[0] * e[0] + turning[1] * e[1]) * self.radius;
        let (first, second) = (along(&low), along(&across));
        let product = arc.sine * arc.cosine;
        let (even, odd) = (arc.half + product, arc.half - product);
        let normal = (sinking * arc.half + first * arc.sine) * (2.0 * c);
        let towards = (sinking * arc.sine * 2.0 + first * even) * c;
        let sideways = second * odd * c;
        let q = [0, 1].map(|i| -(towards * low[i] + sideways * across[i]) * self.radius);
        let power = normal * sinking + towards * first + sideways * second;
        (normal, q, power.x)
    }

    pub fn fields() -> Vec<Field> {
        RimHistory::FIELDS.to_vec()
    }

    pub fn at_rest(&self, at: &mut [f64]) {
        RimHistory { closed: 1.0, ..RimHistory::default() }.store(at);
    }

    /// Forces, tangents and energies over a step.
    pub fn respond(
        &self,
        at: &Kinematics<'_>,
        (start, turn): (&Turn, &Turn),
        committed: &[f64],
        trial: &mut [f64],
    ) -> Wrench {
        let was = RimHistory::load(committed);
        let before = Motion::<0>::new(start, at.d0, at.v0);
        let now = Motion::<ALL>::new(turn, at.d, at.v);
        let first = self.pressed(&before).ok();
        let Ok(p) = self.pressed(&now) else {
            // What the friction held goes where the contact opens.
            let held = self.held([was.traction1, was.traction2], was.torsion);
            RimHistory { traction1: 0.0, traction2: 0.0, torsion: 0.0, closed: 0.0, ..was }
                .store(trial);
            let mut out = Wrench::default();
            out.energy.hysteretic = if first.is_some() { held } else { 0.0 };
            out.energy.viscous = 0.5 * at.dt * first.map_or(0.0, |f| f.power);
            return out;
        };
        let w = now.r[2];
        let (traction, torsion, slip, heat) = match &first {
            Some(f) if self.body.mu > 0.0 => self.friction(&was, (&before, f), (&now, &p), at),
            _ => ([Number::constant(0.0); 2], Number::constant(0.0), [0.0; 2], 0.0),
        };
        let sideways = [traction[0], traction[1], Number::constant(0.0)];
        let arm = cross(&p.centre, &transposed_times(&now.r, &sideways));
        let springs = cross(&p.q, &w);
        let moment: V3 = std::array::from_fn(|i| springs[i] + arm[i] + torsion * w[i]);
        let force = [traction[0], traction[1], p.lift];
        let mut out = Wrench::default();
        for (i, f) in force.iter().chain(&moment).enumerate() {
            out.f[i] = f.x;
            for j in 0..6 {
                out.k[(i, j)] = f.by[j];
                out.c[(i, j)] = f.by[6 + j];
            }
        }
        let held = self.held(traction.map(|t| t.x), torsion.x);
        out.energy.stored = p.energy + held;
        out.energy.hysteretic = heat;
        out.energy.viscous = 0.5 * at.dt * (first.map_or(0.0, |f| f.power) + p.power);
        RimHistory {
            traction1: traction[0].x,
            traction2: traction[1].x,
            torsion: torsion.x,
            slip1: was.slip1 + slip[0],
            slip2: was.slip2 + slip[1],
            closed: 1.0,
        }
        .store(trial);
        out
    }

    /// Elastic energy of the friction.
    fn held(&self, traction: [f64; 2], torsion: f64) -> f64 {
        let Some(ks) = self.body.ks.filter(|_| self.body.mu > 0.0) else { return 0.0 };
        let across = traction[0] * traction[0] + traction[1] * traction[1];
        0.5 * (across + (torsion / self.radius).powi(2)) / ks
    }

    /// Friction force, torsion, slip and heat of a step that is closed at both ends.
    fn friction(
        &self,
        was: &RimHistory,
        (before, first): (&Motion<0>, &Pressed<0>),
        (now, p): (&Motion<ALL>, &Pressed<ALL>),
        at: &Kinematics<'_>,
    ) -> ([Number; 2], Number, [f64; 2], f64) {
        let ks = self.body.ks.unwrap_or(0.0);
        let kt = ks * self.radius * self.radius;
        let plain = |x: &V3<0>| x.map(|x| Number::constant(x.x));
        let middle: V3 = {
            let start = plain(&first.centre);
            std::array::from_fn(|i| (start[i] + p.centre[i]) * 0.5)
        };
        let (u0, r0) = (plain(&before.u), before.r.each_ref().map(plain));
        let to = times(&now.r, &middle);
        let from: V3 = std::array::from_fn(|i| dot(&r0[i], &middle));
        let way: [Number; 2] = std::array::from_fn(|i| now.u[i] - u0[i] + to[i] - from[i]);
        let (w0, w1) = (plain(&before.r[2]), now.r[2]);
        let mut turn = Number::constant(0.0);
        for i in 0..3 {
            let mut by = Number::constant(at.d[3 + i] - at.d0[3 + i]);
            by.by[3 + i] = 1.0;
            turn = turn + (w0[i] + w1[i]) * 0.5 * by;
        }

        let limit = p.normal * self.body.mu;
        let old = [was.traction1, was.traction2];
        let mut traction: [Number; 2] = std::array::from_fn(|i| way[i] * ks + old[i]);
        let size = traction[0].x.hypot(traction[1].x);
        if size > limit.x {
            let length = (traction[0] * traction[0] + traction[1] * traction[1]).sqrt();
            traction = traction.map(|t| t / length * limit);
        }
        let mut torsion = turn * kt + was.torsion;
        if torsion.x.abs() > limit.x * self.least_arm(p) * self.radius {
            let most = limit * self.arm(p) * self.radius;
            if torsion.x.abs() > most.x {
                torsion = if torsion.x > 0.0 { most } else { -most };
            }
        }
        let slip = [0, 1].map(|i| way[i].x - (traction[i].x - old[i]) / ks);
        let spin = turn.x - (torsion.x - was.torsion) / kt;
        let heat = 0.5
            * ((old[0] + traction[0].x) * slip[0]
                + (old[1] + traction[1].x) * slip[1]
                + (was.torsion + torsion.x) * spin);
        (traction, torsion, slip, heat.max(0.0))
    }

    /// How high the highest point of the rim is above the ground, m.
    pub fn uplift(&self, d: &[f64], turn: &Turn) -> f64 {
        let [_, x, y, _] = turn.quaternion;
        let sunk = 2.0 * (x * x + y * y);
        let tilt = turn.matrix[(2, 0)].hypot(turn.matrix[(2, 1)]);
        d[2] + self.depth * sunk + self.radius * tilt
    }

    /// What the lowest point of the rim does, which carries the body, and the highest, which lifts off.
    pub fn contacts(
        &self,
        at: &Kinematics<'_>,
        turn: &Turn,
        history: &[f64],
        out: &mut Vec<Contact>,
    ) {
        let it = RimHistory::load(history);
        let motion = Motion::<0>::new(turn, at.d, at.v);
        let position = [it.slip1, it.slip2];
        let low = match self.pressed(&motion) {
            Err(gap) => Contact { gap, position, ..Contact::default() },
            Ok(p) => {
                let size = it.traction1.hypot(it.traction2);
                let slipping = size > 0.0 && size >= self.body.mu * p.normal.x * (1.0 - 1e-9);
                Contact { gap: p.gap, normal: p.normal.x.max(0.0), position, slipping }
            }
        };
        let rise = 2.0 * self.radius * motion.r[2][0].x.hypot(motion.r[2][1].x);
        out.extend([low, Contact { gap: low.gap + rise, position, ..Contact::default() }]);
    }
}
