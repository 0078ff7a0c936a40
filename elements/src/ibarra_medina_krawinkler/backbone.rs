//! The backbone of a side: hardening, softening behind the capping point, residual strength.

use trilith_element::lanes::Real;

/// Force over deformation, both counted outwards: max(min(hardening, softening), residual).
#[derive(Clone, Copy)]
pub(super) struct Backbone<R> {
    /// Force of the line of hardening at zero deformation, and its slope.
    pub foot: R,
    pub hardening: R,
    /// Force of the falling line at zero deformation, and how much it falls.
    pub intercept: R,
    pub softening: R,
    pub residual: R,
}

impl<R: Real> Backbone<R> {
    /// Force and slope.
    #[inline(always)]
    pub fn at(&self, x: R) -> (R, R) {
        let rising = self.hardening.mul_add(x, self.foot);
        let falling = self.intercept - self.softening * x;
        let below = rising.lt(falling);
        let line = R::select(below, rising, falling);
        let slope = R::select(below, self.hardening, -self.softening);
        (line.max(self.residual), slope.only(self.residual.lt(line)))
    }

    /// The capping point, or 0 where the falling line is lower from the start.
    #[inline(always)]
    fn cap(&self) -> R {
        ((self.intercept - self.foot) / (self.hardening + self.softening)).max(self.foot.of(0.0))
    }

    /// ∫ of the force from 0 to x ≥ 0, J.
    #[inline(always)]
    pub fn area(&self, x: R) -> R {
        let (zero, half) = (x.of(0.0), x.of(0.5));
        let cap = self.cap();
        // What lies above the residual strength: a triangle or trapezoid on each side of the capping point.
        let rising = |x: R| self.hardening.mul_add(x, self.foot) - self.residual;
        let falling = |x: R| self.intercept - self.softening * x - self.residual;
        let (end, foot) = (x.min(cap), rising(zero));
        let begin = R::select(foot.lt(zero), (-foot / self.hardening).min(end), zero);
        let before = (foot.max(zero) + rising(end).max(zero)) * (end - begin);
        let (from, last) = (falling(cap).max(zero), x.max(cap));
        let width = (last - cap).min(from / self.softening);
        let behind = (from + falling(last).max(zero)) * width;
        self.residual.mul_add(x, half * (before + behind))
    }

    /// Where a line through (x, f) below the backbone meets it; its slope is more than that of hardening.
    #[inline(always)]
    pub fn meets(&self, x: R, f: R, slope: R) -> R {
        let rising = (self.hardening.mul_add(x, self.foot) - f) / (slope - self.hardening);
        let falling = (self.intercept - self.softening * x - f) / (slope + self.softening);
        x + rising.min(falling).max((self.residual - f) / slope)
    }
}
