//! The mass that strikes a contact, for dashpots given by a coefficient of restitution.
//!
//! Contacts struck at unit speed stop it with impulses p: A p = 1, A = B M⁻¹ Bᵀ over their closing
//! coordinates. A contact struck alone stops 1/Aᵢᵢ; contacts struck together stop pᵢ each. Where the
//! impulses are not unique (four feet under a rigid body) they are shared as the stiffnesses are, by
//! the smallest Σ pᵢ²/kᵢ: then equal damping ratios make the whole body rebound with the same e.

use crate::{LinkSet, SystemError};
use std::sync::Arc;
use trilith_element::{Impact, Link};
use trilith_linalg::{Dense, Ldlt, Sparse, symmetric_eigen};
use trilith_model::Model;

/// A contact and the masses that can strike it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactMass {
    /// Index in [`LinkSet::links`].
    pub link: usize,
    /// What its law says.
    pub impact: Impact,
    /// Mass that it stops when all contacts of its body are struck at the same speed, kg; none where
    /// they cannot be (stops on both sides), or not while each of them pushes.
    pub together: Option<f64>,
    /// Mass that it stops when it is struck alone, kg; 0 where a part without mass strikes.
    pub alone: f64,
}

impl ImpactMass {
    /// The mass that a restitution means: as given by the user, or together, or alone.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.impact.mass.or(self.together).unwrap_or(self.alone)
    }
}

/// Completes the laws that wait for a mass.
pub(crate) fn settle(links: &mut LinkSet, model: &Model, mass: &Sparse) -> Result<(), SystemError> {
    let waits = |l| links.law(model, l).and_then(|l| l.impact()?.restitution).is_some();
    if !links.links.iter().any(waits) {
        return Ok(());
    }
    for contact in masses(links, model, mass)? {
        let Some(restitution) = contact.impact.restitution else { continue };
        let settled = restituted(links, model, contact.link, restitution, contact.mass())?;
        links.links[contact.link].settled = Some(settled);
    }
    // No mass of the structure strikes a contact that supports alone lead: it needs one of its own.
    for i in 0..links.links.len() {
        let link = &links.links[i];
        let Some(impact) = links.law(model, link).and_then(|l| l.impact()) else { continue };
        let at = link.range.start + impact.coordinate;
        let led = links.rows[at].is_empty() && !links.support_rows[at].is_empty();
        let Some(restitution) = impact.restitution.filter(|_| led) else { continue };
        let settled = restituted(links, model, i, restitution, impact.mass.unwrap_or(0.0))?;
        links.links[i].settled = Some(settled);
    }
    Ok(())
}

/// The law of a link (by its index) with the dashpot that a mass (kg) makes of its restitution.
fn restituted(
    links: &LinkSet,
    model: &Model,
    link: usize,
    restitution: f64,
    mass: f64,
) -> Result<Arc<dyn Link>, SystemError> {
    let link = &links.links[link];
    let law = links.law(model, link).filter(|_| mass > 0.0);
    let Some(settled) = law.and_then(|l| l.restituting(restitution, mass)) else {
        let e = &model.elements[link.element];
        let reason = "`restitution` needs the mass that strikes, and this contact sits on a part \
                      without mass of its own: give `impact_mass`, or the dashpot itself";
        return Err(SystemError::Element {
            element: e.name.clone(),
            reason: reason.into(),
            span: e.span.clone(),
        });
    };
    Ok(Arc::from(settled))
}

pub(crate) fn masses(
    links: &LinkSet,
    model: &Model,
    mass: &Sparse,
) -> Result<Vec<ImpactMass>, SystemError> {
    let mut found = Vec::new();
    let mut rows = Vec::new();
    for (link, instance) in links.links.iter().enumerate() {
        let Some(impact) = links.law(model, instance).and_then(|l| l.impact()) else { continue };
        let row = &links.rows[instance.range.start + impact.coordinate];
        if row.is_empty() {
            continue;
        }
        found.push(ImpactMass { link, impact, together: None, alone: 0.0 });
        rows.push(row);
    }
    if found.is_empty() {
        return Ok(found);
    }
    let n = found.len();
    let mut factor = Ldlt::with_rigid_zeros(mass)?;
    let mut a = Dense::zeros(n, n);
    let mut massive = vec![true; n];
    for (j, row) in rows.iter().enumerate() {
        let mut b = vec![0.0; mass.rows()];
        row.iter().for_each(|(i, c)| b[*i] = *c);
        let mut x = b.clone();
        factor.solve(&mut x);
        // A part without mass takes no impulse: the equation has no solution there.
        let miss = mass.mul(&x).iter().zip(&b).map(|(p, q)| (p - q).abs()).fold(0.0, f64::max);
        massive[j] = miss < 1e-9 * b.iter().map(|c: &f64| c.abs()).fold(0.0, f64::max);
        for (i, row) in rows.iter().enumerate() {
            a[(i, j)] = row.iter().map(|(k, c)| c * x[*k]).sum();
        }
    }
    for i in (0..n).filter(|i| massive[*i] && a[(*i, *i)] > 0.0) {
        found[i].alone = 1.0 / a[(i, i)];
    }
    for group in groups(&a, &massive) {
        let stiffness: Vec<f64> = group.iter().map(|i| found[*i].impact.stiffness).collect();
        if let Some(p) = impulses(&a, &group, &stiffness)? {
            group.iter().zip(p).for_each(|(i, p)| found[*i].together = Some(p));
        }
    }
    Ok(found)
}

/// Contacts that feel each other's impulses.
fn groups(a: &Dense, massive: &[bool]) -> Vec<Vec<usize>> {
    let mut left: Vec<usize> = (0..massive.len()).filter(|i| massive[*i]).collect();
    let mut all = Vec::new();
    while let Some(first) = left.pop() {
        let mut group = vec![first];
        let mut next = 0;
        while let Some(&i) = group.get(next) {
            let feels = |j: &usize| a[(i, *j)].abs() > 1e-9 * (a[(i, i)] * a[(*j, *j)]).sqrt();
            let (near, far) = left.into_iter().partition(feels);
            group.extend::<Vec<usize>>(near);
            left = far;
            next += 1;
        }
        group.sort_unstable();
        all.push(group);
    }
    all
}

/// The impulses that stop all contacts of a group; none where nothing but pulling would.
fn impulses(a: &Dense, group: &[usize], k: &[f64]) -> Result<Option<Vec<f64>>, SystemError> {
    // p = W y, W² = diag(k), and y the shortest solution of (W A W) y = W 1.
    let n = group.len();
    let w: Vec<f64> = k.iter().map(|k| k.sqrt()).collect();
    let mut scaled = Dense::zeros(n, n);
    for i in 0..n {
        for j in 0..n {
            scaled[(i, j)] = w[i] * a[(group[i], group[j])] * w[j];
        }
    }
    let (values, vectors) = symmetric_eigen(&scaled)?;
    let largest = values.iter().fold(0.0, |m: f64, v| m.max(*v));
    let mut y = vec![0.0; n];
    for (m, value) in values.iter().enumerate().filter(|(_, v)| **v > 1e-10 * largest) {
        let vector = vectors.column(m);
        let part: f64 = vector.iter().zip(&w).map(|(x, w)| x * w).sum::<f64>() / value;
        y.iter_mut().zip(vector).for_each(|(y, x)| *y += part * x);
    }
    let p: Vec<f64> = y.iter().zip(&w).map(|(y, w)| y * w).collect();
    let speed = |i: usize| -> f64 { (0..n).map(|j| a[(group[i], group[j])] * p[j]).sum() };
    let stops = (0..n).all(|i| (speed(i) - 1.0).abs() < 1e-6);
    Ok((stops && p.iter().all(|p| *p > 0.0)).then_some(p))
}
