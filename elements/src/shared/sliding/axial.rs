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
use trilith_element::lanes::Real;

/// Spring and dashpot of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axial<R: Real = f64> {
    /// Stiffness, N/m.
    pub(crate) kn: R,
    /// Dashpot, N·s/m.
    pub(crate) damping: R,
    /// The dashpot may pull while the contact is closed.
    pub(crate) pull: R::Mask,
}

/// What a contact does along its normal at one moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Normal<R: Real = f64> {
    pub(crate) closed: R::Mask,
    /// Force of the spring kₙ p, ≥ 0.
    pub(crate) spring: R,
    /// Force along the gap and its derivatives by the gap and its rate; pressing is negative.
    pub(crate) f: R,
    pub(crate) f_d: R,
    pub(crate) f_v: R,
    /// Normal force of the friction cone, and its derivatives by the gap and its rate.
    pub(crate) cone: R,
    pub(crate) cone_d: R,
    pub(crate) cone_v: R,
}

impl<R: Real> Axial<R> {
    /// The contact at a gap (m) that opens at `rate` (m/s).
    #[inline(always)]
    pub(crate) fn normal(&self, gap: R, rate: R) -> Normal<R> {
        let (zero, p) = (gap.of(0.0), -gap);
        let closed = !p.lt(zero);
        let (kn, dashpot) = (self.kn, self.damping * rate);
        let [share, by_gap] = hold(gap, rate);
        let (f_d, f_v) = (kn + dashpot * by_gap, self.damping * share);
        let spring = kn * p;
        let f = dashpot * share - spring;
        let acts = closed & (self.pull | !zero.lt(f));
        Normal {
            closed,
            spring: spring.only(closed),
            f: f.only(acts),
            f_d: f_d.only(acts),
            f_v: f_v.only(acts),
            cone: R::select(self.pull, spring, -f).only(acts),
            cone_d: R::select(self.pull, -kn, -f_d).only(acts),
            cone_v: R::select(self.pull, zero, -f_v).only(acts),
        }
    }
}

impl<R: Real> Normal<R> {
    /// The same contact seen from the other side: pressing is positive, the gap counts the other way.
    #[inline(always)]
    pub(crate) fn mirrored(self) -> Self {
        Self { f: -self.f, cone_d: -self.cone_d, cone_v: -self.cone_v, ..self }
    }

    #[inline(always)]
    pub(crate) fn select(mask: R::Mask, yes: &Self, no: &Self) -> Self {
        let of = |yes: R, no: R| R::select(mask, yes, no);
        Self {
            closed: (mask & yes.closed) | (!mask & no.closed),
            spring: of(yes.spring, no.spring),
            f: of(yes.f, no.f),
            f_d: of(yes.f_d, no.f_d),
            f_v: of(yes.f_v, no.f_v),
            cone: of(yes.cone, no.cone),
            cone_d: of(yes.cone_d, no.cone_d),
            cone_v: of(yes.cone_v, no.cone_v),
        }
    }
}
