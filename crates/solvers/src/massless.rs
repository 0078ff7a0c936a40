//! Static shapes of places without mass, which no mode can hold.
//!
//! ```text
//!   M = diag(M_aa, 0):   u_b = −K_bb⁻¹ K_ba u_a + K_bb⁻¹ (p_b − B_bᵀ f)
//!   Ψ spans (0, K_bb⁻¹ p_b) of all loads and (0, K_bb⁻¹ B_bᵀ) of all link coordinates
//!   M Ψ = 0,  Ψᵀ K Ψ = 1,  Ψᵀ K Φ = 0:   q̇ᵨ Ψᵀ C Ψ + qᵨ = Ψᵀ (p − Bᵀ f)
//! ```
//!
//! Beside the modes they make the response exact at joints between springs and dampers, and under loads
//! on nodes without mass. A linear dashpot that ties such a place to the modes would couple both; its
//! shapes are left out, and the basis is reported as lacking that flexibility.

use crate::error::SolveError;
use crate::shapes::Shapes;
use crate::vector::{dot, largest};
use trilith_linalg::{Dense, Ldlt, Sparse, symmetric_eigen};
use trilith_system::System;

/// Shapes that are combinations of others up to this share are left out.
const INDEPENDENT: f64 = 1e-10;
/// A shape must satisfy its equation this well; one that does not moves freely.
const SOLVED: f64 = 1e-8;
/// Damping between shape and modes, as share of their own, that counts as none.
const UNCOUPLED: f64 = 1e-9;

/// Free DOFs with a stiffness and without mass.
pub(crate) fn places(system: &System, k: &Sparse) -> Vec<usize> {
    // A zero on the diagonal of M, which is semi-definite, is a row of zeros.
    let (stiff, heavy) = (k.diagonal(), system.mass.diagonal());
    (0..system.order()).filter(|i| stiff[*i] > 0.0 && heavy[*i] == 0.0).collect()
}

/// The shapes Ψ for a stiffness, order × number, mutually uncoupled by damping.
pub(crate) fn shapes(
    system: &System,
    k: &Sparse,
    loads: &[(String, Vec<f64>)],
) -> Result<Dense, SolveError> {
    let order = system.order();
    let places = places(system, k);
    let pushed = pushes(system, &places, loads);
    if pushed.is_empty() {
        return Ok(Dense::zeros(order, 0));
    }
    let local = k.block(&places, &places);
    let mut factor = Ldlt::with_rigid_zeros(&local)?;
    let mut found: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    for p in pushed {
        let mut x = p.clone();
        factor.solve(&mut x);
        let left = local.mul(&x).iter().zip(&p).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let work = dot(&p, &x);
        if work > 0.0 && work.is_finite() && left <= SOLVED * largest(&p) {
            let scale = work.sqrt().recip();
            let scaled = |v: Vec<f64>| v.into_iter().map(|y| scale * y).collect();
            found.push((scaled(p), scaled(x)));
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
    let mut psi = Dense::zeros(order, kept.len());
    for (column, m) in kept.iter().enumerate() {
        let scale = values[*m].sqrt().recip();
        for (share, (_, x)) in vectors.column(*m).iter().zip(&found) {
            for (place, y) in places.iter().zip(x) {
                psi[(*place, column)] += scale * share * y;
            }
        }
    }
    if kept.is_empty() {
        return Ok(psi);
    }
    // Turned so that damping does not couple them with each other.
    let (_, rotation) = symmetric_eigen(&psi.congruence(&system.damping(), psi.columns()))?;
    Ok(psi.times(&rotation))
}

/// Loads and link rows on these places, those that are not zero.
fn pushes(system: &System, places: &[usize], loads: &[(String, Vec<f64>)]) -> Vec<Vec<f64>> {
    let mut index = vec![usize::MAX; system.order()];
    places.iter().enumerate().for_each(|(local, full)| index[*full] = local);
    let of_loads = loads.iter().filter(|(_, p)| places.iter().any(|i| p[*i] != 0.0));
    let of_loads = of_loads.map(|(_, p)| places.iter().map(|i| p[*i]).collect());
    let on_places = |row: &&Vec<(usize, f64)>| row.iter().any(|(i, _)| index[*i] != usize::MAX);
    let rows = system.links.active.iter().map(|flat| &system.links.rows[*flat]);
    let of_links = rows.filter(on_places).map(|row| {
        let mut b = vec![0.0; places.len()];
        for (i, c) in row.iter().filter(|(i, _)| index[*i] != usize::MAX) {
            b[index[*i]] += c;
        }
        b
    });
    of_loads.chain(of_links).filter(|p: &Vec<f64>| largest(p) > 0.0).collect()
}

/// Takes the static shapes out of vectors: V − Ψ Ψᵀ K V. Their masses stay as they are.
pub(crate) fn without(psi: &Dense, k: &Sparse, mut vectors: Shapes) -> Shapes {
    for r in 0..psi.columns() {
        let shares = vectors.load(&k.mul(psi.column(r)));
        let own = vectors.rows().gather(psi.column(r)).into_owned();
        for (j, share) in shares.into_iter().enumerate() {
            let column = vectors.kept_mut().column_mut(j);
            column.iter_mut().zip(&own).for_each(|(v, x)| *v -= share * x);
        }
    }
    vectors
}

/// The shapes that damping does not couple with the modes.
pub(crate) fn uncoupled(psi: Dense, system: &System, modes: &Shapes) -> Dense {
    if psi.columns() == 0 {
        return psi;
    }
    let damping = system.damping();
    let own_of = |j| {
        let mode = modes.column(j);
        damping.bilinear(&mode, &mode).max(0.0)
    };
    let own: Vec<f64> = (0..modes.len()).map(own_of).collect();
    let free = |r: &usize| {
        let image = damping.mul(psi.column(*r));
        let size = dot(psi.column(*r), &image).max(0.0);
        let shares = modes.load(&image);
        shares.iter().zip(&own).all(|(s, own)| s.abs() <= UNCOUPLED * (size * own).sqrt())
    };
    let kept: Vec<usize> = (0..psi.columns()).filter(free).collect();
    let values = kept.iter().flat_map(|r| psi.column(*r).to_vec()).collect();
    Dense::from_columns(psi.rows(), kept.len(), values)
}
