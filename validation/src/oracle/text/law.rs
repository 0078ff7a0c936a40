//! The text of a link's law.

use super::list;
use crate::oracle::spec::{Hertz, Kelvin, Law, Ring};
use std::fmt::Write as _;

/// Name of the element, and its fields.
pub(super) fn law(law: &Law, axis: &str, rotation: bool) -> (&'static str, String) {
    match law {
        Law::Gap(k, g) => ("Gap", format!("k: {k:?}, opening: {g:?}, {axis}")),
        Law::Hook(k, g) => ("Hook", format!("k: {k:?}, opening: {g:?}, {axis}")),
        Law::Dashpot(c, a) => {
            let name = if rotation { "cr" } else { "c" };
            ("Dashpot", format!("{name}: {c:?}, exponent: {a:?}, {axis}"))
        }
        Law::Maxwell(k, c, a) => {
            ("MaxwellDamper", format!("k: {k:?}, c: {c:?}, exponent: {a:?}, {axis}"))
        }
        Law::Bilinear(k, c, cy, fl) => {
            ("BilinearDamper", format!("k: {k:?}, c: {c:?}, cy: {cy:?}, fl: {fl:?}, {axis}"))
        }
        Law::Elastic(d, f) => {
            ("MultilinearElastic", format!("deformation: {}, force: {}, {axis}", list(d), list(f)))
        }
        Law::Plastic(d, f) => {
            let both = |x: &[f64]| -> Vec<f64> {
                x[1..].iter().rev().map(|v| -v).chain(x.iter().copied()).collect()
            };
            let (d, f) = (list(&both(d)), list(&both(f)));
            ("MultilinearPlastic", format!("deformation: {d}, force: {f}, rule: Kinematic, {axis}"))
        }
        Law::Wen(k, fy, r, n) => {
            ("Wen", format!("k: {k:?}, fy: {fy:?}, ratio: {r:?}, exponent: {n:?}, {axis}"))
        }
        Law::Contact(c) => {
            let mut s = format!(
                "kn: {:?}, opening: {:?}, damping: {:?}, pull: {}",
                c.kn, c.opening, c.c, c.pull
            );
            if c.slow > 0.0 && c.rate > 0.0 {
                let (slow, fast, rate) = (c.slow, c.fast, c.rate);
                let _ = write!(s, ", mu_slow: {slow:?}, mu_fast: {fast:?}, rate: {rate:?}");
            } else if c.slow > 0.0 {
                let _ = write!(s, ", mu: {:?}", c.slow);
            }
            if c.slow > 0.0 {
                let _ = write!(s, ", ks: {:?}", c.ks);
            }
            ("NLink", s)
        }
        Law::Linear(k, c) => {
            let whole = |m: &[[f64; 2]; 2]| {
                let mut rows = vec![vec![0.0; 6]; 6];
                for i in 0..2 {
                    for j in 0..2 {
                        rows[i][j] = m[i][j];
                    }
                }
                let rows: Vec<String> = rows.iter().map(|r| list(r)).collect();
                format!("[{}]", rows.join(", "))
            };
            ("LinearLink", format!("stiffness: {}, damping: {}", whole(k), whole(c)))
        }
        Law::Pendulum(p) => (
            "FrictionPendulum",
            format!(
                "kn: {:?}, ks: {:?}, radius: {:?}, friction_model: Velocity, mu_slow: {:?}, \
                 mu_fast: {:?}, rate: {:?}",
                p.kn, p.ks, p.radius, p.slow, p.fast, p.rate
            ),
        ),
        Law::Kelvin(i) => {
            let when = if i.approach { "Approach" } else { "Contact" };
            let Kelvin { k, c, opening, pull, .. } = i;
            let all = format!(
                "k: {k:?}, damping: {c:?}, opening: {opening:?}, damps: {when}, pull: {pull}, {axis}"
            );
            ("ImpactKelvin", all)
        }
        Law::Hertz(i) => {
            let model = if i.slowest > 0.0 {
                format!("model: Hertzdamp, min_speed: {:?}", i.slowest)
            } else {
                format!("model: Jankowski, impact_mass: {:?}", i.mass)
            };
            let Hertz { k, n, xi, opening, .. } = i;
            let all = format!(
                "k: {k:?}, exponent: {n:?}, xi: {xi:?}, opening: {opening:?}, {model}, {axis}"
            );
            ("ImpactHertz", all)
        }
        Law::Ring(r) => {
            let us = if r.us.is_finite() { format!(", us: {:?}", r.us) } else { String::new() };
            let Ring { k, k1, k2, u0, .. } = r;
            ("FrictionSpring", format!("k: {k:?}, k1: {k1:?}, k2: {k2:?}, u0: {u0:?}{us}, {axis}"))
        }
        Law::Degrading(b) => {
            let all = format!(
                "k: {:?}, dy: {:?}, alpha: {:?}, n: {:?}, beta: {:?}, gamma: {:?}, a0: {:?}, \
                 delta_a: {:?}, delta_nu: {:?}, delta_eta: {:?}, {axis}",
                b.k, b.dy, b.alpha, b.n, b.beta, b.gamma, b.a0, b.delta_a, b.delta_nu, b.delta_eta
            );
            ("BoucWen", all)
        }
        Law::Branches(beside, k, time) => {
            let (k, time) = (list(k), list(time));
            let all = format!("k_inf: {beside:?}, stiffness: {k}, time: {time}, {axis}");
            ("FrequencyIndependentViscoelastic", all)
        }
        Law::Tension(t) => {
            let friction = |[slow, fast, rate]: [f64; 3], side: &str| {
                if rate == 0.0 {
                    return format!("mu{side}: {slow:?}");
                }
                format!("mu_slow{side}: {slow:?}, mu_fast{side}: {fast:?}, rate{side}: {rate:?}")
            };
            let all = format!(
                "kn: {:?}, kt: {:?}, gap_compression: {:?}, gap_tension: {:?}, damping: {:?}, ks: {:?}, \
                 radius: {:?}, {}, {}",
                t.stiff[0],
                t.stiff[1],
                t.gaps[0],
                t.gaps[1],
                t.c,
                t.ks,
                t.radius,
                friction(t.friction[0], ""),
                friction(t.friction[1], "_tension")
            );
            ("TensionCompressionFriction", all)
        }
        Law::Triple(t) => {
            let four = |x: [f64; 4]| format!("({:?}, {:?}, {:?}, {:?})", x[0], x[1], x[2], x[3]);
            let of = |i: usize| four(t.friction.map(|f| f[i]));
            let mut all = format!("kn: {:?}, ks: {:?}, radii: {}", t.kn, t.ks, four(t.radii));
            if t.capacities.iter().any(|c| *c > 0.0) {
                let rims = four(t.capacities);
                let _ = write!(all, ", capacities: {rims}, stop_stiffness: {:?}", t.stop);
            }
            if t.friction[0][2] == 0.0 {
                let _ = write!(all, ", mu: {}", of(0));
            } else {
                let _ = write!(all, ", mu_slow: {}, mu_fast: {}, rate: {}", of(0), of(1), of(2));
            }
            ("TriplePendulum", all)
        }
        Law::Rocking(r) => {
            let points: Vec<String> =
                r.points.iter().map(|[x, z]| format!("({x:?}, 0.0, {z:?})")).collect();
            let c = &r.contact;
            // It may turn over and over: the oracle knows of no end.
            let all = format!(
                "base: [{}], kn: {:?}, damping: {:?}, pull: {}, mu: {:?}, ks: {:?}, overturned: 1000",
                points.join(", "),
                c.kn,
                c.c,
                c.pull,
                c.slow,
                c.ks
            );
            ("RockingBody", all)
        }
        Law::Shear(s) => {
            if let Some(diameter) = s.lead {
                let section = std::f64::consts::PI * diameter * diameter / 4.0;
                let all = format!(
                    "kr: {:?}, lead_diameter: {diameter:?}, lead_height: 0.3, lead_strength: {:?}, \
                     yield_displacement: {:?}, heating: false, kv: {:?}",
                    s.elastic[0],
                    s.strength[0] / section,
                    s.yields[0],
                    s.axial
                );
                return ("LeadRubber", all);
            }
            // k = r k + (1 − r) f_y/y and y = f_y/k of each axis.
            let of = |i: usize| {
                let k = s.elastic[i] + s.strength[i] / s.yields[i];
                (k, k * s.yields[i], s.elastic[i] / k)
            };
            let ((k2, fy2, r2), (k3, fy3, r3)) = (of(0), of(1));
            let all = format!(
                "k2: {k2:?}, k3: {k3:?}, fy2: {fy2:?}, fy3: {fy3:?}, ratio2: {r2:?}, ratio3: {r3:?}, kv: {:?}",
                s.axial
            );
            ("RubberIsolator", all)
        }
        Law::Elastomeric(k, fy, r) => {
            ("ElastomericBearing", format!("k: {k:?}, fy: {fy:?}, ratio: {r:?}"))
        }
    }
}
