//! Links that lean: the axial force of a link acts where its shear has carried it to (P-Δ).
//!
//! ```text
//! e₁ = d₁ − (t₂ d₃ − t₃ d₂) + c (d₂² + d₃²)/(2L)      t = sᵢ θᵢ + sⱼ θⱼ,   c = 1 − sᵢ − sⱼ
//! f = (∂e/∂d)ᵀ F(e)                                    F: the law without it, with its own axial force
//! ```
//!
//! The law works on deformations e in axes that turn with the tilt t of its ends. The moments follow by virtual work:
//! P u times its share at either end, the rest as a couple of shears over the length L between the nodes; and the end
//! that tilts pushes sideways with P θ. Forces and stiffness come from one e, so the energies of the law stay what they
//! are.
//!
//! Reference: moments of P over the shear of a link as in \[CSI Analysis Reference, ch. Link/Support: P-delta\], where
//! P θ is left out.

use crate::SystemError;
use std::borrow::Cow;
use std::sync::Arc;
use trilith_element::{
    Axis, Contact, ContactUse, Coordinates, Energy, Field, Impact, Kinematics, Link, Response,
    norm, sub,
};
use trilith_model::Model;

/// Most coordinates of a law along local axes.
const MOST: usize = 6;
/// Tilts about local axes 2 and 3, behind the coordinates of the law.
pub(crate) const TILTS: [Axis; 2] = [Axis::R2, Axis::R3];

/// A law whose axial force follows its shear.
#[derive(Debug)]
pub(crate) struct Leaning {
    law: Arc<dyn Link>,
    /// Its coordinates.
    axes: Vec<Axis>,
    /// Places of U1, U2 and U3 among them.
    axial: usize,
    shear: [Option<usize>; 2],
    /// Share of the moments that is a couple of shears, over the distance of the nodes, 1/m.
    couple: f64,
}

/// The row ∂e₁/∂d, without the one of d₁ itself, and its rate.
struct Row {
    w: [f64; MOST + 2],
    rate: [f64; MOST + 2],
}

impl Leaning {
    /// The law of an element whose axial force follows its shear.
    pub(crate) fn of(
        model: &Model,
        element: usize,
        law: &Arc<dyn Link>,
        shares: [f64; 2],
    ) -> Result<Arc<dyn Link>, SystemError> {
        let e = &model.elements[element];
        let length = match e.nodes[..] {
            [i, j] => norm(sub(model.nodes[j].position, model.nodes[i].position)),
            _ => 0.0,
        };
        let refused = |reason| {
            let (element, span) = (e.name.clone(), e.span.clone());
            SystemError::Element { element, reason, span }
        };
        let law = Self::new(Arc::clone(law), shares, length).map_err(refused)?;
        Ok(Arc::new(law))
    }

    /// Of a law between ends with these shares, over a distance (m) between its nodes.
    ///
    /// # Errors
    /// What the law or the shares lack.
    fn new(law: Arc<dyn Link>, shares: [f64; 2], length: f64) -> Result<Self, String> {
        let Coordinates::Local(axes) = law.coordinates() else {
            return Err(
                "`p_delta_at` is for laws along local axes: this one does its own kinematics"
                    .into(),
            );
        };
        let place = |axis: Axis| axes.iter().position(|a| *a == axis);
        let shear = [place(Axis::U2), place(Axis::U3)];
        let Some(axial) = place(Axis::U1).filter(|_| shear != [None; 2] && axes.len() <= MOST)
        else {
            return Err("`p_delta_at` needs a law with U1, whose force it is, and U2 or U3".into());
        };
        let rest = 1.0 - shares[0] - shares[1];
        if rest.abs() > 1e-9 && length == 0.0 {
            return Err(format!(
                "the shares of `p_delta_at` are {} in sum: between nodes at one place they must be 1, as there is no length for a couple of shears",
                shares[0] + shares[1]
            ));
        }
        let couple = if length > 0.0 { rest / length } else { 0.0 };
        Ok(Self { law, axes, axial, shear, couple })
    }

    fn order(&self) -> usize {
        self.axes.len()
    }

    /// Shear, m, and tilt that goes with it, of each plane: e₁ = d₁ + Σ (tilt · shear + ½ couple · shear²).
    fn planes<'a>(
        &'a self,
        d: &'a [f64],
    ) -> impl Iterator<Item = (usize, usize, f64, f64, f64)> + 'a {
        let n = self.order();
        // −t₂ goes with d₃ and t₃ with d₂.
        let of = [(self.shear[0], n + 1, 1.0), (self.shear[1], n, -1.0)];
        of.into_iter().filter_map(move |(at, tilt, sign)| {
            at.map(|at| (at, tilt, sign, d[at], sign * d[tilt]))
        })
    }

    /// Deformations that the law sees.
    fn inner(&self, d: &[f64]) -> [f64; MOST] {
        let mut e = [0.0; MOST];
        e[..self.order()].copy_from_slice(&d[..self.order()]);
        for (_, _, _, shear, tilt) in self.planes(d) {
            e[self.axial] += tilt * shear + 0.5 * self.couple * shear * shear;
        }
        e
    }

    fn row(&self, d: &[f64], v: &[f64]) -> Row {
        let mut row = Row { w: [0.0; MOST + 2], rate: [0.0; MOST + 2] };
        for ((at, turn, sign, shear, tilt), (.., slip, spin)) in self.planes(d).zip(self.planes(v))
        {
            (row.w[at], row.rate[at]) = (tilt + self.couple * shear, spin + self.couple * slip);
            (row.w[turn], row.rate[turn]) = (sign * shear, sign * slip);
        }
        row
    }

    /// Rates that the law sees.
    fn inner_rate(&self, v: &[f64], row: &Row) -> [f64; MOST] {
        let mut e = [0.0; MOST];
        e[..self.order()].copy_from_slice(&v[..self.order()]);
        e[self.axial] += row.w.iter().zip(v).map(|(w, v)| w * v).sum::<f64>();
        e
    }

    /// Hands what the law sees to a function.
    fn seen<T>(&self, at: &Kinematics<'_>, then: impl FnOnce(&Kinematics<'_>) -> T) -> T {
        let n = self.order();
        let (d, d0) = (self.inner(at.d), self.inner(at.d0));
        let v = self.inner_rate(at.v, &self.row(at.d, at.v));
        let v0 = self.inner_rate(at.v0, &self.row(at.d0, at.v0));
        let [d, v, d0, v0] = [&d[..n], &v[..n], &d0[..n], &v0[..n]];
        then(&Kinematics::new([d, v], [d0, v0], at.dt))
    }
}

impl Link for Leaning {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local([&self.axes[..], &TILTS].concat())
    }

    fn history(&self) -> Cow<'static, [Field]> {
        self.law.history()
    }

    fn at_rest(&self, at: &mut [f64]) {
        self.law.at_rest(at);
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let n = self.order();
        let mut own = [0.0; MOST * MOST];
        self.law.engaged_stiffness(&mut own[..n * n]);
        for (row, own) in k.chunks_exact_mut(n + TILTS.len()).zip(own[..n * n].chunks_exact(n)) {
            row[..n].copy_from_slice(own);
        }
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let (n, a) = (self.order(), self.axial);
        let all = n + TILTS.len();
        let (mut f, mut k, mut c) = ([0.0; MOST], [0.0; MOST * MOST], [0.0; MOST * MOST]);
        self.seen(at, |inner| {
            let (f, k, c) = (&mut f[..n], &mut k[..n * n], &mut c[..n * n]);
            let energy: &mut Energy = out.energy;
            self.law.respond(inner, committed, trial, &mut Response::new(f, k, c, energy));
        });
        let Row { w, rate } = self.row(at.d, at.v);
        let own = |x: &[f64], i: usize, j: usize| if i < n && j < n { x[i * n + j] } else { 0.0 };
        // Rows of the law, columns of all: K J + C ∂ė/∂d, and C J.
        let axial = |x: &[f64], i: usize, j: usize| own(x, i, j) + own(x, i, a) * w[j];
        let of_k = |i: usize, j: usize| axial(&k, i, j) + own(&c, i, a) * rate[j];
        let of_c = |i: usize, j: usize| axial(&c, i, j);
        for i in 0..all {
            out.f[i] = if i < n { f[i] } else { 0.0 } + w[i] * f[a];
            for j in 0..all {
                out.k[i * all + j] = of_k(i, j) + w[i] * of_k(a, j);
                out.c[i * all + j] = of_c(i, j) + w[i] * of_c(a, j);
            }
        }
        // What turns with the axial force: f₁ ∂²e₁/∂d².
        for (at, turn, sign, ..) in self.planes(at.d) {
            out.k[at * all + turn] += sign * f[a];
            out.k[turn * all + at] += sign * f[a];
            out.k[at * all + at] += self.couple * f[a];
        }
    }

    fn refusal(&self, at: &Kinematics<'_>, committed: &[f64]) -> Option<String> {
        self.seen(at, |inner| self.law.refusal(inner, committed))
    }

    fn uses_rates(&self) -> bool {
        self.law.uses_rates()
    }

    fn damps(&self) -> bool {
        self.law.damps()
    }

    fn contacts(&self, at: &Kinematics<'_>, history: &[f64], f: &[f64], out: &mut Vec<Contact>) {
        let mut own = [0.0; MOST];
        own[..self.order()].copy_from_slice(&f[..self.order()]);
        // The shears of the law, without what the axial force adds.
        let w = self.row(at.d, at.v).w;
        for at in self.shear.into_iter().flatten() {
            own[at] -= w[at] * own[self.axial];
        }
        self.seen(at, |inner| self.law.contacts(inner, history, &own[..self.order()], out));
    }

    fn contact_use(&self) -> ContactUse {
        self.law.contact_use()
    }

    fn overturned(&self, at: &Kinematics<'_>, history: &[f64]) -> bool {
        self.seen(at, |inner| self.law.overturned(inner, history))
    }

    fn impact(&self) -> Option<Impact> {
        self.law.impact()
    }

    fn restituting(&self, restitution: f64, mass: f64) -> Option<Box<dyn Link>> {
        let law = Arc::from(self.law.restituting(restitution, mass)?);
        let Self { axes, axial, shear, couple, .. } = self;
        let (axes, axial, shear, couple) = (axes.clone(), *axial, *shear, *couple);
        Some(Box::new(Self { law, axes, axial, shear, couple }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_element::conformance::Kit;

    /// Springs along U1, U2 and U3 that know of each other, and a dashpot along U1.
    #[derive(Debug)]
    struct Pad;

    const K: [f64; 9] = [9e3, 50.0, -20.0, 50.0, 700.0, 30.0, -20.0, 30.0, 500.0];
    const C: f64 = 40.0;

    impl Link for Pad {
        fn coordinates(&self) -> Coordinates {
            Coordinates::Local(vec![Axis::U1, Axis::U2, Axis::U3])
        }
        fn engaged_stiffness(&self, k: &mut [f64]) {
            k.copy_from_slice(&K);
        }
        fn respond(&self, at: &Kinematics<'_>, _: &[f64], _: &mut [f64], out: &mut Response<'_>) {
            out.k.copy_from_slice(&K);
            for (f, k) in out.f.iter_mut().zip(K.chunks_exact(3)) {
                *f = k.iter().zip(at.d).map(|(k, d)| k * d).sum();
            }
            out.energy.stored = 0.5 * out.f.iter().zip(at.d).map(|(f, d)| f * d).sum::<f64>();
            out.energy.viscous = at.viscous_work(0, C * at.v0[0], C * at.v[0]);
            out.f[0] += C * at.v[0];
            out.c[0] = C;
        }
    }

    #[test]
    fn it_keeps_the_contract() {
        for (shares, length) in [([1.0, 0.0], 0.0), ([0.5, 0.5], 0.0), ([0.2, 0.3], 0.4)] {
            let law = Leaning::new(Arc::new(Pad), shares, length).unwrap();
            let report = Kit::new(&[0.02, 0.1, 0.08, 0.1, 0.15], 2.0).check(&law).unwrap();
            assert!(report.tangents > 100, "{report:?}");
        }
    }

    /// The moment at an end that tilts nothing is P u about the axis square to u, and the whole is in equilibrium.
    #[test]
    fn the_moment_is_the_force_times_the_shear() {
        let law = Leaning::new(Arc::new(Pad), [1.0, 0.0], 0.0).unwrap();
        let d = [-0.2, 0.1, -0.05, 0.0, 0.0];
        let zeros = [0.0; 5];
        let at = Kinematics::still(&d, &zeros);
        let (mut f, mut k, mut c) = ([0.0; 5], [0.0; 25], [0.0; 25]);
        let energy = &mut Energy::default();
        law.respond(&at, &[], &mut [], &mut Response::new(&mut f, &mut k, &mut c, energy));
        // Forces of the law on the upper node, and moment on the lower: r × F = −(what resists).
        let force = [-f[0], -f[1], -f[2]];
        let r = [0.0, d[1], d[2]];
        let on_lower = |i: usize, j: usize| -(r[i] * force[j] - r[j] * force[i]);
        assert!((-f[3] - on_lower(2, 0)).abs() < 1e-9, "{f:?}");
        assert!((-f[4] - on_lower(0, 1)).abs() < 1e-9, "{f:?}");
    }

    #[test]
    fn what_it_cannot_be_is_refused() {
        #[derive(Debug)]
        struct Shear;
        impl Link for Shear {
            fn coordinates(&self) -> Coordinates {
                Coordinates::Local(vec![Axis::U2])
            }
            fn engaged_stiffness(&self, _: &mut [f64]) {}
            fn respond(&self, _: &Kinematics<'_>, _: &[f64], _: &mut [f64], _: &mut Response<'_>) {}
        }
        assert!(Leaning::new(Arc::new(Shear), [1.0, 0.0], 0.0).unwrap_err().contains("U1"));
        assert!(Leaning::new(Arc::new(Pad), [0.5, 0.0], 0.0).unwrap_err().contains("0.5 in sum"));
    }
}
