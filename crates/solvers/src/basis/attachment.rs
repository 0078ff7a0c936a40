//! Shapes of massless directions, which no mode can hold.
//!
//! ```text
//!   N spans M n = 0:   Nᵀ (K u + C u̇) = Nᵀ (p − Bᵀ f),     C = R c Rᵀ of dashpots on them, + Rayleigh's
//!   Ψ spans N A⁻¹ Nᵀ (p, Bᵀ, C N, K u₀)                     A = Nᵀ (K + σ C) N
//!   Ψᵀ A Ψ = 1,  Ψᵀ K Ψ = κ,  Ψᵀ C Ψ = D (both diagonal),  Ψᵀ K Φ = 0:
//!   D q̇ᵨ + Ψᵀ C Φ q̇ + κ qᵨ = Ψᵀ (p − Bᵀ f)
//! ```
//!
//! Modes Φ follow statically in these directions. What is left there is made by loads, links and dashpots, each a
//! force in few directions of its own; A⁻¹ of these spans all of it, for any σ, so beside the modes the shapes make
//! the response exact: at joints between springs and dampers, where dashpots tie them to the modes, and under loads
//! on nodes without mass. σ is 0 where springs hold all directions; a joint that only dashpots hold needs σ > 0.
//! What links alone hold has their effective stiffnesses in K.

use super::condensation::Condensation;
use super::shapes::Shapes;
use super::{PIVOT, held};
use crate::error::SolveError;
use crate::vector::{dot, largest};
use trilith_linalg::{
    Dense, Ldlt, Product, Sparse, StagedLdlt, positive_inverse, symmetric_eigen, unsupported,
};
use trilith_system::{Massless, System};

/// Shapes that are combinations of others up to this share are left out.
const INDEPENDENT: f64 = 1e-10;
/// A push of which the structure carries no more than this moves freely.
const CARRIED: f64 = 1e-8;
/// Damping between shape and modes, as share of their own, that counts as none.
const UNCOUPLED: f64 = 1e-9;
/// Damping of a shape below this share of the largest is rounding.
const UNDAMPED: f64 = 1e-13;
/// A shape whose stiffness is below this share of what normed it is an integrator: dashpots alone hold it.
const HELD: f64 = 1e-6;

/// The shapes Ψ for a stiffness.
#[derive(Clone, Debug)]
pub(crate) struct AttachmentVectors {
    /// Order × number; those that dashpots tie to the modes come first.
    pub psi: Dense,
    /// How many these are.
    tied: usize,
    /// κ.
    pub stiffness: Vec<f64>,
    /// D.
    pub damping: Vec<f64>,
    /// What reads the coordinate of each out of a displacement: its products with these, order × number.
    pub readers: Dense,
}

impl AttachmentVectors {
    /// The shapes for a stiffness under loads on the free DOFs; couplings with modes are not known yet.
    pub(crate) fn new(
        system: &System,
        k: &Sparse,
        loads: &[(String, Vec<f64>)],
    ) -> Result<Self, SolveError> {
        let order = system.order();
        let massless = &system.massless;
        let pushed = pushes(system, loads);
        if pushed.is_empty() {
            return Ok(Self::none(order));
        }
        let mut held = massless.project(k);
        let damping = system.damping();
        let of_elements = massless.project(&system.element_damping);
        let is_damped = of_elements.entries().any(|(_, _, v)| v != 0.0);
        if is_damped && !unsupported(&held)?.is_empty() {
            // All of C: what turns it diagonal leaves Ψᵀ K Ψ = 1 − σ Ψᵀ C Ψ diagonal as well. Rayleigh's share has no
            // effective stiffnesses, so it is no multiple of K.
            let c = massless.project(&damping);
            let sum = |a: &Sparse| a.diagonal().iter().sum::<f64>();
            let (stiff, viscous) = (sum(&held), sum(&c));
            let rate = if stiff > 0.0 { stiff / viscous } else { 1.0 };
            held = Sparse::combine(&[(1.0, &held), (rate, &c)]);
        }
        let mut factor = Ldlt::with_rigid_zeros(&held)?;
        let mut found: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
        for p in pushed {
            let mut x = p.clone();
            factor.solve(&mut x);
            // Two pushes that nothing carries alone may carry each other: what is carried of each spans that too.
            let carried = held.mul(&x);
            let work = dot(&carried, &x);
            if work > 0.0 && work.is_finite() && largest(&carried) > CARRIED * largest(&p) {
                let scale = work.sqrt().recip();
                let scaled = |v: Vec<f64>| v.into_iter().map(|y| scale * y).collect();
                found.push((scaled(carried), scaled(x)));
            }
        }
        let n = found.len();
        let mut gram = Dense::zeros(n, n);
        for i in 0..n {
            for j in 0..n {
                gram[(i, j)] = dot(&found[i].0, &found[j].1);
            }
        }
        let (values, vectors) = symmetric_eigen(&gram)?;
        let kept: Vec<usize> = (0..n).filter(|m| values[*m] > INDEPENDENT * n as f64).collect();
        if kept.is_empty() {
            return Ok(Self::none(order));
        }
        let mut psi = Dense::zeros(order, kept.len());
        for (column, m) in kept.iter().enumerate() {
            let scale = values[*m].sqrt().recip();
            for (share, (_, x)) in vectors.column(*m).iter().zip(&found) {
                massless.expand(scale * share, x, psi.column_mut(column));
            }
        }
        // Turned so that damping does not couple them with each other.
        let (rates, rotation) = symmetric_eigen(&psi.congruence(&damping, psi.columns()))?;
        let psi = psi.times(&rotation);
        let stiffness = (0..kept.len()).map(|j| k.bilinear(psi.column(j), psi.column(j)));
        let stiffness: Vec<f64> = stiffness.map(|x| if x < HELD { 0.0 } else { x }).collect();
        let most = rates.iter().copied().fold(0.0, f64::max);
        let damping = rates.iter().map(|d| if *d <= UNDAMPED * most { 0.0 } else { *d });
        let readers = Dense::zeros(order, kept.len());
        Ok(Self { psi, tied: 0, damping: damping.collect(), stiffness, readers })
    }

    fn none(order: usize) -> Self {
        let empty = || Dense::zeros(order, 0);
        Self { psi: empty(), tied: 0, stiffness: Vec::new(), damping: Vec::new(), readers: empty() }
    }

    pub(crate) fn len(&self) -> usize {
        self.stiffness.len()
    }

    /// True for one that dashpots tie to the modes.
    pub(crate) fn is_tied(&self, r: usize) -> bool {
        r < self.tied
    }

    /// Takes the shapes out of vectors: V − Ψ κ⁻¹ Ψᵀ K V. Their masses stay as they are.
    pub(crate) fn out_of(&self, k: &Sparse, vectors: Shapes) -> Shapes {
        let stiff = self.stiffness.iter().enumerate().filter(|(_, k)| **k > 0.0);
        // Those of one shape are not changed by what others take: Ψᵀ K Ψ is diagonal.
        let shapes = stiff.map(|(r, stiffness)| {
            let psi = self.psi.column(r);
            let shares = vectors.load(&k.mul(psi)).into_iter().map(|share| share / stiffness);
            (vectors.rows().gather(psi).into_owned(), shares.collect())
        });
        let shapes: Vec<_> = shapes.collect();
        vectors.less(&shapes)
    }

    /// Takes them out of a displacement that a force causes, ψᵀ K u = ψᵀ p, as [`out_of`](Self::out_of) does.
    pub(crate) fn out_of_answer(&self, p: impl Fn(&[f64]) -> f64, u: &mut [f64]) {
        for (r, stiffness) in self.stiffness.iter().enumerate().filter(|(_, k)| **k > 0.0) {
            let psi = self.psi.column(r);
            let share = p(psi) / stiffness;
            u.iter_mut().zip(psi).for_each(|(u, x)| *u -= share * x);
        }
    }

    /// Puts those that damping ties to the modes first, and finds what reads the coordinates of all; `effective`: those
    /// in `k`, flat.
    pub(crate) fn beside(
        &self,
        system: &System,
        k: &Sparse,
        effective: &[f64],
        modes: &Shapes,
    ) -> Self {
        if self.len() == 0 {
            return self.clone();
        }
        let damping = system.damping();
        let own = modes.each().map(|mode| damping.bilinear(&mode, &mode).max(0.0));
        let own: Vec<f64> = own.collect();
        // Shapes without mass, square to the modes by stiffness: dashpots tie them, and the effective stiffnesses that Rayleigh's
        // share of the stiffness does not have.
        let ties = Sparse::combine(&[
            (1.0, &system.element_damping),
            (-system.rayleigh[1], &system.springs(effective)),
        ]);
        let coupling = |r: usize| modes.load(&ties.mul(self.psi.column(r)));
        let is_free = |r: &usize| {
            let size = self.damping[*r];
            let none = || {
                let shares = coupling(*r);
                let mut pairs = shares.iter().zip(&own);
                pairs.all(|(s, own)| s.abs() <= UNCOUPLED * (size * own).sqrt())
            };
            size == 0.0 || (self.stiffness[*r] > 0.0 && none())
        };
        let (free, tied): (Vec<usize>, Vec<usize>) = (0..self.len()).partition(is_free);
        let count = tied.len();
        let all: Vec<usize> = tied.into_iter().chain(free).collect();
        let pick = |of: &[f64]| all.iter().map(|r| of[*r]).collect::<Vec<f64>>();
        let order = self.psi.rows();
        let psi = all.iter().flat_map(|r| self.psi.column(*r).to_vec()).collect();
        let (psi, stiffness) = (Dense::from_columns(order, all.len(), psi), pick(&self.stiffness));
        let rates = pick(&self.damping);
        let mut readers = Dense::zeros(order, all.len());
        for r in 0..all.len() {
            let reader = readers.column_mut(r);
            if stiffness[r] > 0.0 {
                k.mul_add(stiffness[r].recip(), psi.column(r), reader);
                continue;
            }
            // Nothing but dashpots: D y = Ψᵀ C u − Ψᵀ C Φ Φᵀ M u.
            let scale = rates[r].recip();
            damping.mul_add(scale, psi.column(r), reader);
            let shares = modes.load(&damping.mul(psi.column(r)));
            system.mass.mul_add(-scale, &modes.heavy(&shares), reader);
        }
        Self { psi, tied: count, stiffness, damping: rates, readers }
    }
}

/// Puts massless directions where what has mass puts them: u − N (Nᵀ K N)⁻¹ Nᵀ K u. Products with M do not see
/// their rounding, which comes into the next vectors with the shares in these that are taken out, and grows from block
/// to block until they are far too stiff.
pub(super) struct Following<'a> {
    massless: &'a Massless,
    /// K N.
    images: Sparse,
    /// Of Nᵀ K N.
    factor: Factor,
}

/// Directions up to which products with a dense inverse are faster than sparse substitutions.
const FEW: usize = 64;

enum Factor {
    Inverse(Product),
    Sparse(StagedLdlt),
}

impl Factor {
    /// Of a symmetric matrix; none where one of its pivots is rounding.
    fn new(a: &Sparse) -> Result<Option<Self>, SolveError> {
        let n = a.rows();
        if n > FEW {
            return Ok(held(&[(1.0, a)])?.map(Self::Sparse));
        }
        let mut all = Dense::zeros(n, n);
        a.entries().for_each(|(i, j, x)| all[(i, j)] = x);
        Ok(positive_inverse(&all, PIVOT).map(|inverse| Self::Inverse(Product::new(inverse))))
    }

    fn solve(&self, mut p: Vec<f64>) -> Vec<f64> {
        match self {
            Self::Inverse(inverse) => {
                let mut y = vec![0.0; p.len()];
                inverse.times(&p, &mut y);
                y
            }
            Self::Sparse(factor) => {
                factor.solve(&mut p);
                p
            }
        }
    }
}

impl<'a> Following<'a> {
    /// For a stiffness. None where this has nothing to do: rows that are not kept follow anyhow.
    pub(crate) fn new(
        system: &'a System,
        stiffness: &Sparse,
        rows: &Condensation,
    ) -> Result<Option<Self>, SolveError> {
        let massless = &system.massless;
        if massless.len() <= rows.order() - rows.kept() {
            return Ok(None);
        }
        let factor = Factor::new(&massless.project(stiffness))?;
        let images = massless.images(stiffness);
        Ok(factor.map(|factor| Self { massless, images, factor }))
    }

    pub(crate) fn place(&self, u: &mut [f64]) {
        let mut p = vec![0.0; self.massless.len()];
        self.images.transpose_mul_add(1.0, u, &mut p);
        self.massless.expand(-1.0, &self.factor.solve(p), u);
    }
}

/// Loads, link rows and dashpots on massless directions, those that are not zero.
fn pushes(system: &System, loads: &[(String, Vec<f64>)]) -> Vec<Vec<f64>> {
    let massless = &system.massless;
    if massless.is_empty() {
        return Vec::new();
    }
    let of_loads = loads.iter().map(|(_, p)| massless.load(p));
    let rows = system.links.active.iter().map(|flat| &system.links.rows[*flat]);
    let of_links = rows.filter(|row| massless.is_touched(row)).map(|row| massless.row(row));
    let damped = massless.project(&system.element_damping);
    let column = |j: usize| {
        let mut p = vec![0.0; massless.len()];
        let (rows, values) = damped.column(j);
        rows.iter().zip(values).for_each(|(i, v)| p[*i] += v);
        p
    };
    let diagonal = damped.diagonal();
    let of_dashpots = (0..massless.len()).filter(|j| diagonal[*j] > 0.0).map(column);
    let all = of_loads.chain(of_links).chain(of_dashpots);
    all.filter(|p: &Vec<f64>| largest(p) > 0.0).collect()
}
