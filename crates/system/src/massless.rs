//! Directions without mass, and what holds them.
//!
//! ```text
//! M n = 0:      Nᵀ (K u + C u̇ + Bᵀ f − p) = 0
//! ```
//!
//! Such a direction is no oscillator. Where a spring holds it, it follows statically; where a dashpot holds it, it is
//! an unknown of first order; where only links hold it, its place is an unknown of the link equations. For the last
//! kind the linear structure has no stiffness, so these links get a dummy, which the link equations take out again
//! exactly. M may be singular in directions that are no axis: a mass at the end of a rigid arm leaves the rotation
//! about it without inertia.

use crate::System;
use crate::parts::{join, root};
use crate::sums::Sums;
use std::collections::BTreeMap;
use trilith_linalg::{Dense, LinalgError, Sparse, Triplets, symmetric_eigen, unsupported};
use trilith_model::Model;

/// An eigenvalue of a block of M, scaled to unit diagonal, below this is rounding.
const NO_MASS: f64 = 1e-12;
/// Blocks of M of more equations are those of consistent masses, which have no such directions.
const LARGEST_BLOCK: usize = 120;
/// Automatic dummies as a share of the engaged stiffness of a link.
const SHARE: f64 = 0.1;

/// A basis of the directions without mass: M n = 0.
#[derive(Clone, Debug, Default)]
pub struct Massless {
    /// The directions, over the free DOFs.
    pub directions: Sums,
    /// Directions that each free DOF has a share in: (direction, share).
    of: Sums,
}

impl Massless {
    /// Of a positive semi-definite mass matrix.
    ///
    /// # Errors
    /// Where the eigenvalues of a block are not found.
    pub fn new(mass: &Sparse) -> Result<Self, LinalgError> {
        let n = mass.rows();
        let diagonal = mass.diagonal();
        let mut block: Vec<usize> = (0..n).collect();
        for (i, j, _) in mass.entries().filter(|(i, j, m)| i != j && *m != 0.0) {
            join(&mut block, i, j);
        }
        let parts: Vec<usize> = (0..n).map(|i| root(&mut block, i)).collect();
        let mut members: Vec<usize> = (0..n).collect();
        members.sort_by_key(|i| parts[*i]);
        // A zero on the diagonal of M, which is semi-definite, is a row of zeros.
        let alone: Vec<usize> = (0..n).filter(|i| diagonal[*i] <= 0.0).collect();
        let mut others: Vec<Vec<(usize, f64)>> = Vec::new();
        for own in members.chunk_by(|i, j| parts[*i] == parts[*j]).filter(|own| own.len() > 1) {
            let heavy: Vec<usize> = own.iter().copied().filter(|i| diagonal[*i] > 0.0).collect();
            if heavy.len() > 1 && heavy.len() <= LARGEST_BLOCK {
                others.extend(of_block(mass, &heavy, &diagonal)?);
            }
        }
        if others.is_empty() {
            return Ok(Self::of(alone.into_iter().map(|i| [(i, 1.0)]).collect(), n));
        }
        others.extend(alone.into_iter().map(|i| vec![(i, 1.0)]));
        others.sort_by_key(|d| d[0].0);
        Ok(Self::of(others.into_iter().collect(), n))
    }

    fn of(directions: Sums, n: usize) -> Self {
        let of = directions.transposed(n);
        Self { directions, of }
    }

    /// Combinations of these directions that no dashpot stretches: `c` is the damping of these directions, and `rows`
    /// act on them as dashpots do.
    ///
    /// # Errors
    /// Where the eigenvalues of a block of the damping are not found.
    pub fn undamped(&self, c: &Sparse, rows: &[Vec<f64>]) -> Result<Self, LinalgError> {
        let mut held = Triplets::new(self.len(), self.len());
        c.entries().for_each(|(i, j, v)| held.add(i, j, v));
        for row in rows {
            let own = || row.iter().enumerate().filter(|(_, x)| **x != 0.0);
            own().for_each(|(i, x)| own().for_each(|(j, y)| held.add(i, j, x * y)));
        }
        // What damping leaves alone is found as what mass does.
        let free = Self::new(&held.build())?;
        let directions = free.directions.iter().map(|shares| {
            let mut sum = BTreeMap::new();
            for (k, share) in shares {
                for (i, c) in self.directions.get(*k) {
                    *sum.entry(*i).or_insert(0.0) += share * c;
                }
            }
            sum
        });
        Ok(Self::of(directions.collect(), self.of.len()))
    }

    /// Number of directions.
    #[must_use]
    pub fn len(&self) -> usize {
        self.directions.len()
    }

    /// True where every direction has mass.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.directions.is_empty()
    }

    /// Nᵀ A N.
    #[must_use]
    pub fn project(&self, a: &Sparse) -> Sparse {
        let mut t = Triplets::new(self.len(), self.len());
        for (i, j, v) in a.entries().filter(|(_, _, v)| *v != 0.0) {
            for (k, x) in self.of.get(i) {
                for (l, y) in self.of.get(j) {
                    t.add(*k, *l, x * v * y);
                }
            }
        }
        t.build()
    }

    /// A N.
    #[must_use]
    pub fn images(&self, a: &Sparse) -> Sparse {
        let mut t = Triplets::new(a.rows(), self.len());
        for (k, direction) in self.directions.iter().enumerate() {
            for (j, x) in direction {
                let (rows, values) = a.column(*j);
                rows.iter().zip(values).for_each(|(i, v)| t.add(*i, k, v * x));
            }
        }
        t.build()
    }

    /// Nᵀ p.
    #[must_use]
    pub fn load(&self, p: &[f64]) -> Vec<f64> {
        let of = |d: &[(usize, f64)]| d.iter().map(|(i, c)| c * p[*i]).sum();
        self.directions.iter().map(of).collect()
    }

    /// Nᵀ of a row over the free DOFs.
    #[must_use]
    pub fn row(&self, row: &[(usize, f64)]) -> Vec<f64> {
        let mut y = vec![0.0; self.len()];
        for (i, b) in row {
            self.of.get(*i).iter().for_each(|(k, c)| y[*k] += c * b);
        }
        y
    }

    /// True where a row over the free DOFs acts on such a direction.
    #[must_use]
    pub fn is_touched(&self, row: &[(usize, f64)]) -> bool {
        row.iter().any(|(i, b)| *b != 0.0 && !self.of.get(*i).is_empty())
    }

    /// `u += s · N y`.
    pub fn expand(&self, s: f64, y: &[f64], u: &mut [f64]) {
        for (direction, y) in self.directions.iter().zip(y) {
            direction.iter().for_each(|(i, c)| u[*i] += s * c * y);
        }
    }
}

/// The null space of one block of M.
fn of_block(
    mass: &Sparse,
    own: &[usize],
    diagonal: &[f64],
) -> Result<Vec<Vec<(usize, f64)>>, LinalgError> {
    let n = own.len();
    let scale: Vec<f64> = own.iter().map(|i| diagonal[*i].sqrt().recip()).collect();
    let mut m = Dense::zeros(n, n);
    for (i, j, v) in mass.block(own, own).entries() {
        m[(i, j)] = v * scale[i] * scale[j];
    }
    let (values, vectors) = symmetric_eigen(&m)?;
    let light = (0..n).filter(|k| values[*k] <= NO_MASS * n as f64);
    let direction = |k: usize| {
        let x: Vec<f64> = vectors.column(k).iter().zip(&scale).map(|(x, s)| x * s).collect();
        let size = x.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        let terms = own.iter().zip(x).filter(|(_, x)| x.abs() > 1e-13 * size);
        terms.map(|(i, x)| (*i, x / size)).collect()
    };
    Ok(light.map(direction).collect())
}

/// Gives the links that alone hold a direction without mass a dummy, where the user has set none.
pub(crate) fn give_dummies(system: &mut System, model: &Model) -> Result<(), LinalgError> {
    let massless = &system.massless;
    if massless.is_empty() || system.links.active.is_empty() {
        return Ok(());
    }
    if !system.links.rows.iter().any(|row| massless.is_touched(row)) {
        return Ok(());
    }
    let k = massless.project(&system.stiffness_with(&system.links.effective));
    if is_dominated(&k) || unsupported(&k)?.is_empty() {
        return Ok(());
    }
    let c = massless.project(&system.element_damping);
    let mean = |a: &Sparse| a.diagonal().iter().sum::<f64>() / massless.len() as f64;
    let (stiff, viscous) = (mean(&k), mean(&c));
    let rate = if viscous > 0.0 && stiff > 0.0 { stiff / viscous } else { 1.0 };
    let held = Sparse::combine(&[(1.0, &k), (rate, &c)]);
    let loose = unsupported(&held)?;
    if loose.is_empty() {
        return Ok(());
    }
    // All links on the part that is loose: any of them may be what holds it.
    let mut part: Vec<usize> = (0..massless.len()).collect();
    for (i, j, v) in held.entries().filter(|(i, j, _)| i != j) {
        if v != 0.0 {
            join(&mut part, i, j);
        }
    }
    let touched: Vec<(usize, Vec<usize>)> = (system.links.active.iter())
        .map(|flat| {
            let row = massless.row(&system.links.rows[*flat]);
            (*flat, (0..row.len()).filter(|k| row[*k] != 0.0).collect())
        })
        .collect();
    for (_, directions) in &touched {
        for pair in directions.windows(2) {
            join(&mut part, pair[0], pair[1]);
        }
    }
    let loose: Vec<usize> = loose.into_iter().map(|i| root(&mut part, i)).collect();
    let engaged = system.links.engaged(model);
    // A law without stiffness, such as a dashpot, is given one of the size of the others.
    let usual = engaged.iter().copied().fold(0.0f64, f64::max);
    let usual = if usual > 0.0 { usual } else { system.usual_stiffness() };
    for (flat, directions) in touched {
        let on_loose = directions.iter().any(|k| loose.contains(&root(&mut part, *k)));
        if on_loose && system.links.effective[flat] == 0.0 {
            let own = if engaged[flat] > 0.0 { engaged[flat] } else { 1e-3 * usual };
            system.links.effective[flat] = SHARE * own;
        }
    }
    Ok(())
}

/// True for a matrix that is regular because its diagonal dominates: in every row as large as all the rest, in one row
/// of every part larger. Rotations of frames are like that, and a look costs less than a factorisation.
fn is_dominated(a: &Sparse) -> bool {
    const LARGER: f64 = 1e-6;
    let n = a.rows();
    let (mut part, mut rest): (Vec<usize>, _) = ((0..n).collect(), vec![0.0; n]);
    for (i, j, v) in a.entries().filter(|(i, j, v)| i != j && *v != 0.0) {
        rest[i] += v.abs();
        join(&mut part, i, j);
    }
    let mut strict = vec![false; n];
    for (i, d) in a.diagonal().into_iter().enumerate() {
        if d <= 0.0 || rest[i] > d * (1.0 + 1e-12) {
            return false;
        }
        if rest[i] < d * (1.0 - LARGER) {
            strict[root(&mut part, i)] = true;
        }
    }
    (0..n).all(|i| strict[root(&mut part, i)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(n: usize, entries: &[(usize, usize, f64)]) -> Sparse {
        let mut t = Triplets::new(n, n);
        entries.iter().for_each(|(i, j, v)| t.add(*i, *j, *v));
        t.build()
    }

    /// A mass of 2 kg at the end of an arm of 3 m: M = 2 [1 3; 3 9] on the shift and the rotation of its foot.
    #[test]
    fn the_rotation_about_a_mass_on_an_arm_has_no_inertia() {
        let m = matrix(3, &[(0, 0, 2.0), (0, 2, 6.0), (2, 0, 6.0), (2, 2, 18.0)]);
        let found = Massless::new(&m).unwrap();
        assert_eq!(found.len(), 2);
        for d in found.directions.iter() {
            let mut u = vec![0.0; 3];
            d.iter().for_each(|(i, c)| u[*i] = *c);
            assert!(m.mul(&u).iter().all(|x| x.abs() < 1e-12), "{d:?}");
        }
        // K = diag(5, 7, 11) on them: the rotation about the mass is (−3, 1).
        let k = found.project(&matrix(3, &[(0, 0, 5.0), (1, 1, 7.0), (2, 2, 11.0)]));
        let mut own: Vec<f64> = k.diagonal();
        own.sort_by(f64::total_cmp);
        let turn: f64 = (5.0 * 9.0 + 11.0) / 9.0;
        assert!((own[0] - turn.min(7.0)).abs() < 1e-12 && (own[1] - turn.max(7.0)).abs() < 1e-12);
        assert!(found.is_touched(&[(1, 1.0)]) && found.is_touched(&[(0, 1.0)]));
    }

    #[test]
    fn small_masses_beside_large_ones_are_masses() {
        let m = matrix(3, &[(0, 0, 1e6), (1, 1, 1e-9), (0, 1, 1e-4), (1, 0, 1e-4)]);
        let found = Massless::new(&m).unwrap();
        assert_eq!(found.directions, [[(2, 1.0)]].into_iter().collect());
    }
}
