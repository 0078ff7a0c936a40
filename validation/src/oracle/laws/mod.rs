//! The laws of links as differential equations of their own unknowns.
//!
//! ```text
//!   f = f(d, ḋ, z),   g(d, ḋ, z, ż) = 0
//! ```
//!
//! Slip of friction and of plastic elements is that of a very fast creep, τ ṡ = (overstress)/k along the
//! stress: with τ of 10⁻⁹ of a period it is the rate-independent law beyond all tolerances.
//! [Simo & Hughes 1998, ch. 2: viscoplastic regularisation]

mod hysteresis;
mod impact;
mod pendulum;
mod ring;
mod rocking;
mod sliding;

use super::number::Dual;
use super::spec::{Contact, Law, Rocking};
use hysteresis::straight;

/// What a law is asked about.
#[derive(Clone, Copy)]
pub struct At<'a> {
    /// Deformation.
    pub d: &'a [Dual],
    /// Its rate.
    pub v: &'a [Dual],
    /// Own unknowns.
    pub z: &'a [Dual],
    /// Their rates.
    pub w: &'a [Dual],
    /// Statics: nothing viscous.
    pub still: bool,
    /// Time of creep τ, s.
    pub creep: f64,
}

/// Rate below which a power less than 1 of a dashpot is linear, as its card says.
const LINEAR_BELOW: f64 = 1e-6;

impl Law {
    /// Number of own unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        match self {
            Self::Gap(..) | Self::Hook(..) | Self::Dashpot(..) => 0,
            Self::Elastic(..) | Self::Linear(..) => 0,
            Self::Maxwell(..) | Self::Bilinear(..) | Self::Wen(..) => 1,
            Self::Plastic(d, _) => d.len() - 2,
            Self::Contact(c) if c.slow > 0.0 => 2,
            Self::Contact(_) => 0,
            Self::Elastomeric(..) | Self::Pendulum(_) | Self::Tension(_) | Self::Shear(_) => 2,
            Self::Kelvin(_) => 0,
            Self::Hertz(h) => usize::from(h.slowest > 0.0),
            Self::Ring(_) => 1,
            Self::Degrading(_) => 2,
            Self::Branches(_, k, _) => k.len(),
            Self::Triple(_) => 14,
            Self::Rocking(r) => r.unknowns(),
        }
    }

    /// What it does before the first stage of a step counts: it remembers it, or its force jumps at touch, so that the
    /// whole step and its halves would both have that force from the start of the step.
    #[must_use]
    pub fn remembers_or_jumps(&self) -> bool {
        let jumps = match self {
            Self::Kelvin(i) => i.c > 0.0,
            Self::Contact(c) | Self::Rocking(Rocking { contact: c, .. }) => c.c > 0.0,
            _ => false,
        };
        jumps || self.unknowns() > 0
    }

    /// Size of an own unknown for a deformation of 1.
    #[must_use]
    pub fn own_size(&self) -> f64 {
        match self {
            Self::Wen(k, fy, ..) => k / fy,
            Self::Degrading(b) => 1.0 / b.dy,
            Self::Shear(s) => 1.0 / s.yields[0].min(s.yields[1]),
            _ => 1.0,
        }
    }

    /// A stiffness of the size that the law has, for each coordinate. `omega`: turns a dashpot into one.
    #[must_use]
    pub fn stiffness(&self, omega: f64) -> Vec<f64> {
        match self {
            Self::Gap(k, _) | Self::Hook(k, _) | Self::Maxwell(k, ..) | Self::Bilinear(k, ..) => {
                vec![0.1 * k]
            }
            Self::Dashpot(c, _) => vec![c * omega],
            Self::Elastic(d, f) | Self::Plastic(d, f) => vec![(f[1] - f[0]) / (d[1] - d[0])],
            Self::Wen(k, ..) => vec![*k],
            Self::Contact(c) if c.slow > 0.0 => vec![0.1 * c.kn, 0.1 * c.ks, 0.1 * c.ks],
            Self::Contact(c) => vec![0.1 * c.kn],
            Self::Linear(k, c) => (0..2).map(|i| k[i][i].abs() + omega * c[i][i].abs()).collect(),
            Self::Elastomeric(k, ..) => vec![*k, *k],
            Self::Pendulum(p) => p.stiffness(),
            Self::Kelvin(i) => vec![0.1 * i.k],
            // Of a depth of a millimetre.
            Self::Hertz(i) => vec![0.1 * i.k * 1e-3_f64.powf(i.n - 1.0)],
            Self::Ring(r) => vec![0.1 * r.k],
            Self::Degrading(b) => vec![b.k],
            Self::Branches(beside, k, _) => vec![beside + 0.1 * k.iter().sum::<f64>()],
            Self::Tension(t) => vec![0.1 * t.stiff[0], 0.1 * t.ks, 0.1 * t.ks],
            Self::Triple(t) => vec![0.1 * t.kn, 0.1 * t.ks, 0.1 * t.ks],
            Self::Rocking(r) => r.stiffness(),
            Self::Shear(s) => {
                let first = if s.axial > 0.0 { Some(s.axial) } else { None };
                let across = |i: usize| s.elastic[i] + s.strength[i] / s.yields[i];
                first.into_iter().chain([across(0), across(1)]).collect()
            }
        }
    }

    /// Own unknowns after a slow, straight deformation from rest: what slips has slipped.
    #[must_use]
    pub fn thrown(&self, d: &[f64]) -> Vec<f64> {
        let round = |u: &[f64], limit: f64| {
            let length = u[0].hypot(u[1]);
            let share = if length > limit { 1.0 - limit / length } else { 0.0 };
            vec![share * u[0], share * u[1]]
        };
        match self {
            Self::Plastic(points, _) => {
                let inner = &points[1..points.len() - 1];
                inner.iter().map(|p| d[0] - d[0].clamp(-p, *p)).collect()
            }
            Self::Elastomeric(k, fy, _) => round(d, fy / k),
            Self::Wen(k, fy, _, n) => {
                let [z] = straight([0.0], d[0].abs() * k / fy, &|[z]| [1.0 - z.abs().powf(*n)]);
                vec![d[0].signum() * z]
            }
            Self::Ring(r) => vec![r.thrown(d[0])],
            Self::Degrading(b) => b.thrown(d[0]),
            Self::Shear(s) => s.thrown(d),
            Self::Contact(c) if c.slow > 0.0 => {
                let normal = (c.kn * -(d[0] + c.opening)).max(0.0);
                round(&d[1..], c.slow * normal / c.ks)
            }
            _ => vec![0.0; self.unknowns()],
        }
    }

    /// Forces and residuals of the own equations. The answer is the branch of the law: tangents jump
    /// between branches alone.
    pub fn answer(&self, at: &At<'_>, f: &mut [Dual], g: &mut [Dual]) -> u32 {
        let (d, v) = (at.d, at.v);
        let mut branch = 0;
        match self {
            Self::Gap(k, open) => {
                let depth = -(d[0] + (*open).into());
                f[0] = -*k * depth.above_zero();
                branch = u32::from(depth.0 >= 0.0);
            }
            Self::Hook(k, slack) => {
                let beyond = d[0] - (*slack).into();
                f[0] = *k * beyond.above_zero();
                branch = u32::from(beyond.0 >= 0.0);
            }
            Self::Dashpot(c, p) => {
                f[0] = *c * if at.still { Dual::default() } else { power(v[0], *p) };
                branch = u32::from(*p < 1.0 && v[0].0.abs() < LINEAR_BELOW);
            }
            Self::Maxwell(k, c, p) => {
                // z: elongation of the spring.
                let z = at.z[0];
                f[0] = *k * z;
                g[0] = if at.still {
                    at.w[0]
                } else if *p <= 1.0 {
                    at.w[0] + ((*k / *c) * z).signed_power(1.0 / p) - v[0]
                } else {
                    (v[0] - at.w[0]).signed_power(*p) - (*k / *c) * z
                };
            }
            Self::Bilinear(k, c, cy, fl) => {
                let force = *k * at.z[0];
                f[0] = force;
                branch = u32::from(force.0 > *fl) + 2 * u32::from(force.0 < -*fl);
                let rate = if force.0.abs() <= *fl {
                    (1.0 / c) * force
                } else {
                    let sign = force.0.signum();
                    Dual::from(sign * fl / c) + (1.0 / cy) * (force - (sign * fl).into())
                };
                g[0] = if at.still { at.w[0] } else { at.w[0] + rate - v[0] };
            }
            Self::Elastic(points, forces) => {
                let i = points.partition_point(|x| *x <= d[0].0).clamp(1, points.len() - 1);
                let slope = (forces[i] - forces[i - 1]) / (points[i] - points[i - 1]);
                branch = i as u32;
                // From the nearer end: the curve goes through 0, where far ends would leave their rounding.
                let far = |j: usize| (d[0].0 - points[j]).abs();
                let from = if far(i) < far(i - 1) { i } else { i - 1 };
                f[0] = Dual::from(forces[from]) + slope * (d[0] - points[from].into());
            }
            Self::Plastic(points, forces) => {
                branch = plastic(points, forces, at, &mut f[0], g);
            }
            Self::Wen(k, fy, r, n) => {
                let z = at.z[0];
                f[0] = (r * k) * d[0] + ((1.0 - r) * fy) * z;
                let loading = v[0].0 * z.0 > 0.0;
                branch = u32::from(loading);
                let share = if loading {
                    Dual::from(1.0) - abs(z).signed_power(*n)
                } else {
                    Dual::from(1.0)
                };
                g[0] = at.w[0] - (k / fy) * v[0] * share;
            }
            Self::Contact(c) => branch = contact(c, at, f, g),
            Self::Linear(k, c) => {
                for i in 0..2 {
                    f[i] = k[i][0] * d[0] + k[i][1] * d[1];
                    if !at.still {
                        f[i] = f[i] + c[i][0] * v[0] + c[i][1] * v[1];
                    }
                }
            }
            Self::Pendulum(p) => branch = p.answer(at, f, g),
            Self::Kelvin(i) => branch = i.answer(at, &mut f[0]),
            Self::Hertz(i) => branch = i.answer(at, &mut f[0], g),
            Self::Ring(r) => branch = r.answer(at, &mut f[0], &mut g[0]),
            Self::Degrading(b) => branch = b.answer(at, &mut f[0], g),
            Self::Tension(t) => branch = t.answer(at, f, g),
            Self::Triple(t) => branch = t.answer(at, f, g),
            Self::Rocking(r) => branch = r.answer(at, f, g),
            Self::Shear(s) => branch = s.answer(at, f, g),
            Self::Branches(beside, stiff, time) => {
                // z: elongations of the springs.
                f[0] = *beside * d[0];
                for (i, (k, tau)) in stiff.iter().zip(time).enumerate() {
                    f[0] = f[0] + *k * at.z[i];
                    g[i] = at.w[i];
                    if !at.still {
                        g[i] = g[i] - v[0] + (1.0 / tau) * at.z[i];
                    }
                }
            }
            Self::Elastomeric(k, fy, r) => {
                let stiff = (1.0 - r) * k;
                branch = slip(stiff, &|_| Dual::from((1.0 - r) * fy), at, d, f, g);
                for i in 0..2 {
                    f[i] = f[i] + (r * k) * d[i];
                }
            }
        }
        branch
    }
}

fn abs(x: Dual) -> Dual {
    if x.0 < 0.0 { -x } else { x }
}

fn power(v: Dual, p: f64) -> Dual {
    if p < 1.0 && v.0.abs() < LINEAR_BELOW {
        LINEAR_BELOW.powf(p - 1.0) * v
    } else {
        v.signed_power(p)
    }
}

/// Parallel elastic-perfectly-plastic elements, whose sum has the curve, and Masing's rules. [Iwan 1966]
fn plastic(points: &[f64], forces: &[f64], at: &At<'_>, f: &mut Dual, g: &mut [Dual]) -> u32 {
    let mut branch = 0;
    let slope = |i: usize| (forces[i + 1] - forces[i]) / (points[i + 1] - points[i]);
    let last = points.len() - 2;
    *f = slope(last) * at.d[0];
    for i in 0..last {
        let k = slope(i) - slope(i + 1);
        let stretch = at.d[0] - at.z[i];
        *f = *f + k * stretch;
        let over = (abs(stretch) - points[i + 1].into()).above_zero();
        g[i] = at.creep * at.w[i] - if stretch.0 < 0.0 { -over } else { over };
        let slips = if over.0 <= 0.0 { 0 } else { 1 + u32::from(stretch.0 < 0.0) };
        branch = 3 * branch + slips;
    }
    branch
}

/// q = k (d − z) within a circle whose radius may grow with the rate of slip; z creeps along q.
fn slip(
    k: f64,
    limit: &dyn Fn(Dual) -> Dual,
    at: &At<'_>,
    d: &[Dual],
    f: &mut [Dual],
    g: &mut [Dual],
) -> u32 {
    let stretch = [d[0] - at.z[0], d[1] - at.z[1]];
    let length = (stretch[0] * stretch[0] + stretch[1] * stretch[1]).root();
    // Slip goes along the stretch.
    let along = at.w[0] * stretch[0] + at.w[1] * stretch[1];
    let rate = if length.0 > 0.0 { along / length } else { Dual::default() };
    let over = (length - (1.0 / k) * limit(rate)).above_zero();
    for i in 0..2 {
        f[i] = k * stretch[i];
        g[i] = at.creep * at.w[i];
        if over.0 > 0.0 {
            g[i] = g[i] - over * stretch[i] / length;
        }
    }
    u32::from(over.0 > 0.0)
}

/// Friction coefficient at a rate of slip, of [slow, fast, rate]. Below zero the line goes on, for the sake of
/// Newton's method.
fn friction(&[slow, fast, by]: &[f64; 3], rate: Dual, still: bool) -> Dual {
    match rate {
        _ if by == 0.0 || still => Dual::from(slow),
        rate if rate.0 < 0.0 => Dual::from(slow) + (fast - slow) * by * rate,
        rate => Dual::from(fast) - (fast - slow) * (-by * rate).exp(),
    }
}

fn contact(c: &Contact, at: &At<'_>, f: &mut [Dual], g: &mut [Dual]) -> u32 {
    let mut branch = 0;
    let depth = -(at.d[0] + c.opening.into());
    let closed = depth.0 >= 0.0;
    let mut normal = Dual::default();
    f[0] = Dual::default();
    if closed {
        let dash = if at.still { Dual::default() } else { c.c * at.v[0] };
        f[0] = dash - c.kn * depth;
        if c.pull {
            normal = c.kn * depth;
            branch = 1;
        } else {
            branch = 1 + u32::from(f[0].0 > 0.0);
            f[0] = -(-f[0]).above_zero();
            normal = -f[0];
        }
    }
    if c.slow > 0.0 {
        let mu = |rate: Dual| friction(&[c.slow, c.fast, c.rate], rate, at.still);
        // An open contact has no strength: the anchor goes along.
        branch += 3 * slip(c.ks, &|rate| mu(rate) * normal, at, &at.d[1..], &mut f[1..], g);
        if normal.0 == 0.0 {
            // What is left is the creep of the anchor.
            f[1..].fill(Dual::default());
        }
    }
    branch
}
