//! Contact along its normal: a spring that only presses, with a dashpot.
//!
//! ```text
//!   p = −gap                          penetration; closed where p ≥ 0 (touching is closed)
//!   f = −kₙ p + c ġ                   closed, `pull`: the dashpot may hold the contact down; N = kₙ p
//!   f = min(0, −kₙ p + c ġ)           closed, otherwise: never pulls; N = −f
//! ```
//!
//! The dashpot takes hold over the first nanometre of an approach; see [`touch`](crate::shared::touch).

use crate::shared::touch::hold;

/// Spring and dashpot of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axial {
    /// Stiffness, N/m.
    pub(crate) kn: f64,
    /// Dashpot, N·s/m.
    pub(crate) damping: f64,
    /// The dashpot may pull while the contact is closed.
    pub(crate) pull: bool,
}

/// What a contact does along its normal at one moment.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Normal {
    pub(crate) closed: bool,
    /// Force of the spring kₙ p, ≥ 0.
    pub(crate) spring: f64,
    /// Force along the gap and its derivatives by the gap and its rate; pressing is negative.
    pub(crate) f: f64,
    pub(crate) f_d: f64,
    pub(crate) f_v: f64,
    /// Normal force of the friction cone, and its derivatives by the gap and its rate.
    pub(crate) cone: f64,
    pub(crate) cone_d: f64,
    pub(crate) cone_v: f64,
}

impl Axial {
    /// The contact at a gap (m) that opens at `rate` (m/s).
    pub(crate) fn normal(&self, gap: f64, rate: f64) -> Normal {
        let p = -gap;
        if p < 0.0 {
            return Normal::default();
        }
        let (kn, dashpot) = (self.kn, self.damping * rate);
        let [share, by_gap] = hold(gap, rate);
        let (f_d, f_v) = (kn + dashpot * by_gap, self.damping * share);
        let spring = kn * p;
        let f = dashpot * share - spring;
        if self.pull {
            let (cone, cone_d) = (spring, -kn);
            return Normal { closed: true, spring, f, f_d, f_v, cone, cone_d, cone_v: 0.0 };
        }
        if f > 0.0 {
            return Normal { closed: true, spring, ..Normal::default() };
        }
        Normal { closed: true, spring, f, f_d, f_v, cone: -f, cone_d: -f_d, cone_v: -f_v }
    }
}

impl Normal {
    /// The same contact seen from the other side: pressing is positive, the gap counts the other way.
    pub(crate) fn mirrored(self) -> Self {
        Self { f: -self.f, cone_d: -self.cone_d, cone_v: -self.cone_v, ..self }
    }
}
