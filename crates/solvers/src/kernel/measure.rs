//! How far the links are from equilibrium, as shares of what is allowed.

use super::{Converged, ForceScale, Layout, LinkKernel, NoEquilibrium, ROUNDING_FROM, choose};

/// A pseudo-force counts as a force only by its rounding: with large effective stiffnesses on a sliding contact it may
/// be millions of times any force there is.
const PSEUDO_SHARE: f64 = 1e-5;
/// Two units in the last place.
pub(crate) const DIGIT: f64 = 2.0 * f64::EPSILON;

impl LinkKernel<'_> {
    /// Largest residual over its tolerance, and where.
    #[inline]
    pub(super) fn measure(&self, out: &Converged<'_>, scale: &ForceScale) -> (f64, NoEquilibrium) {
        // Mostly no force is larger than those before.
        if !self.layout.links.turns && self.sizes[0] <= self.tolerance * scale[0] {
            return (0.0, NoEquilibrium { worst: 0, residual: 0.0 });
        }
        self.compare(out, scale)
    }

    /// The same where the forces of now may count as well.
    #[inline(never)]
    fn compare(&self, out: &Converged<'_>, scale: &ForceScale) -> (f64, NoEquilibrium) {
        let links = self.layout.links;
        let pseudo = self.unknowns.pseudo();
        let (mut now, mut left) = (*scale, [0.0; 2]);
        let [of_residual, of_force, of_pseudo] = self.sizes;
        if links.turns {
            for (a, flat) in links.active.iter().enumerate() {
                let kind = usize::from(links.rotational[*flat]);
                left[kind] = self.residual[a].abs().max(left[kind]);
                now[kind] =
                    out.laws.f[*flat].abs().max(PSEUDO_SHARE * pseudo[a].abs()).max(now[kind]);
            }
        } else {
            left[0] = of_residual;
            now[0] = of_force.max(PSEUDO_SHARE * of_pseudo).max(now[0]);
        }
        let mut worst = NoEquilibrium { worst: 0, residual: 0.0 };
        if !of_residual.is_finite()
            && let Some(a) = self.residual.iter().position(|r| !r.is_finite())
        {
            worst = NoEquilibrium { worst: links.active[a], residual: self.residual[a].abs() };
            return (f64::NAN, worst);
        }
        // The residual counts as a force: before the first link is touched there is no other.
        let share = |kind: usize| left[kind] / (self.tolerance * now[kind].max(left[kind]));
        let mut most: f64 = 0.0;
        for kind in [0, 1] {
            if left[kind] > 0.0 {
                most = most.max(share(kind));
            }
        }
        if most <= 1.0 || self.iteration < ROUNDING_FROM {
            return (most, worst);
        }
        let mut size = 0.0;
        for (a, r) in self.residual.iter().enumerate() {
            let flat = links.active[a];
            let kind = usize::from(links.rotational[flat]);
            let mut allowed = self.tolerance * now[kind].max(left[kind]);
            if r.abs() > allowed {
                allowed = allowed.max(self.rounding(a, out));
            }
            let share = if *r == 0.0 { 0.0 } else { r.abs() / allowed.max(f64::MIN_POSITIVE) };
            if share > size || !share.is_finite() {
                size = share;
                worst = NoEquilibrium { worst: flat, residual: r.abs() };
            }
        }
        (size, worst)
    }

    /// The coordinate with the largest residual.
    pub(super) fn farthest(&self) -> NoEquilibrium {
        let sizes = self.residual.iter().map(|r| r.abs()).enumerate();
        let (a, residual) = sizes.max_by(|x, y| x.1.total_cmp(&y.1)).unwrap_or_default();
        let worst = self.layout.links.active.get(a).copied().unwrap_or_default();
        NoEquilibrium { worst, residual }
    }

    /// What the last digits of deformations and rates make of the force of an active coordinate: a
    /// stiff contact under a body that has gone far.
    fn rounding(&self, a: usize, out: &Converged<'_>) -> f64 {
        let Layout { links, owner, .. } = &self.layout;
        let link = &links.links[owner[a]];
        let row = (links.active[a] - link.range.start) * link.range.len();
        let block = link.block.start + row..link.block.start + row + link.range.len();
        let (k, c) = (&out.laws.tangents.k[block.clone()], &out.laws.tangents.c[block]);
        let (d, v) = (choose(self.plain, &self.unknowns, out.d), &*out.v);
        let terms = link.range.clone().zip(k.iter().zip(c));
        DIGIT * terms.map(|(flat, (k, c))| (k * d[flat]).abs() + (c * v[flat]).abs()).sum::<f64>()
    }
}
