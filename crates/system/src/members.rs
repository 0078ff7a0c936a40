//! Loads along members, and the forces inside them.
//!
//! ```text
//!   forces of the nodes on a member   f = K u − P          P: what loads along it are worth at its ends
//!   inside, at x from the first node  −(f + ∫₀ˣ q ds) and its moment
//! ```
//!
//! K is that of the member without the geometric stiffness of P-Δ: shear is square to the axis as it bends. Weight is
//! spread over the length, and at the ends it is what the mass matrix makes of it. A point load counts behind its place.

use crate::System;
use crate::assemble::element_matrices;
use crate::elastic::end_force_row;
use trilith_element::{Dof, Geometry, SpanLoad, Vector3};
use trilith_model::{MemberForce, MemberLoad, Model};

/// A force inside a member as a linear combination: `Σ stiffness · u + Σ loads · factor`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MemberRow {
    /// (reduced index, N/m …), over free and prescribed DOFs.
    pub stiffness: Vec<(usize, f64)>,
    /// (index of a load pattern, or their number for the weight; N or N·m).
    pub loads: Vec<(usize, f64)>,
}

/// What a force at the first node and a load at `s` bring to a force inside at `x`, in local axes: forces and moments.
fn shares(force: MemberForce, lever: f64) -> [f64; 6] {
    let mut c = [0.0; 6];
    match force {
        MemberForce::N => c[0] = -1.0,
        MemberForce::V2 => c[1] = -1.0,
        MemberForce::V3 => c[2] = -1.0,
        MemberForce::T => c[3] = -1.0,
        MemberForce::M2 => (c[4], c[2]) = (1.0, lever),
        MemberForce::M3 => (c[5], c[1]) = (-1.0, lever),
    }
    c
}

/// What a load between the first node and `x` brings to a force inside at `x`.
fn direct(force: MemberForce, x: f64, load: &SpanLoad) -> f64 {
    let mut sum = 0.0;
    load.over([0.0, x], |s, q| {
        let c = shares(force, x - s);
        sum += c.iter().zip(q).map(|(c, q)| c * q).sum::<f64>();
    });
    sum
}

impl System {
    /// What a load along a member is worth at its nodes: (full DOF, N or N·m), those of the first node first.
    #[must_use]
    pub fn member_load(&self, model: &Model, load: &MemberLoad) -> [(usize, f64); 12] {
        let e = &model.elements[load.element];
        let ends = self.end_loads(model, load);
        std::array::from_fn(|i| {
            let (end, part, axis) = (i / 6, 3 * (i / 3), i % 3);
            let node = e.nodes.get(end).copied().unwrap_or_default();
            let force = (0..3).map(|k| e.frame.0[k][axis] * ends[part + k]).sum();
            (6 * node + i % 6, force)
        })
    }

    /// The same in local axes; zeros where the element carries no such load, which no reader lets through.
    fn end_loads(&self, model: &Model, load: &MemberLoad) -> [f64; 12] {
        let e = &model.elements[load.element];
        let nodes: Vec<Vector3> = e.nodes.iter().map(|n| model.nodes[*n].position).collect();
        let tension = self.tension.get(load.element).copied().unwrap_or_default();
        let at = Geometry::new(&nodes, e.frame).with_tension(tension);
        let member = model.member(load.element);
        member.and_then(|m| m.end_loads(&at, &load.load).ok()).unwrap_or_default()
    }

    /// A force inside a member, at a distance (m) from its first node.
    #[must_use]
    pub fn member_force(
        &self,
        model: &Model,
        element: usize,
        force: MemberForce,
        at: f64,
    ) -> MemberRow {
        let mut row = MemberRow::default();
        let e = &model.elements[element];
        let Ok(Some(m)) = element_matrices(model, e, 0.0) else { return row };
        let c = shares(force, at);
        for dof in Dof::ALL {
            let (part, axis) = (3 * (dof.index() / 3), dof.index() % 3);
            let share: f64 = (0..3).map(|k| c[part + k] * e.frame.0[k][axis]).sum();
            if share != 0.0 {
                let own = end_force_row(&m, &e.nodes, 0, dof, &self.reduction);
                row.stiffness.extend(own.stiffness.iter().map(|(j, k)| (*j, share * k)));
            }
        }
        for (i, pattern) in model.patterns.iter().enumerate() {
            let mut sum = 0.0;
            for load in pattern.members.iter().filter(|l| l.element == element) {
                let ends = self.end_loads(model, load);
                sum -= c.iter().zip(ends).map(|(c, p)| c * p).sum::<f64>();
                sum += direct(force, at, &load.load);
            }
            if sum != 0.0 {
                row.loads.push((i, sum));
            }
        }
        // Weight: at the ends as the mass matrix has it, along the span by length.
        let (mut ends, mut total) = ([0.0; 6], 0.0);
        for (i, (end, dof)) in m.dofs.iter().enumerate() {
            let up = m.dofs.iter().enumerate().filter(|(_, d)| d.1 == Dof::Uz);
            let weight = -model.gravity * up.map(|(j, _)| m.mass[(i, j)]).sum::<f64>();
            if *end == 0 {
                ends[dof.index()] += weight;
            }
            if *dof == Dof::Uz {
                total += weight;
            }
        }
        if total != 0.0 {
            let length = self.length(model, element);
            let local = |v: [f64; 6]| -> [f64; 6] {
                let (u, r) = ([v[0], v[1], v[2]], [v[3], v[4], v[5]]);
                let (u, r) = (e.frame.to_local(u), e.frame.to_local(r));
                [u[0], u[1], u[2], r[0], r[1], r[2]]
            };
            let q = local([0.0, 0.0, total / length, 0.0, 0.0, 0.0]);
            let spread = SpanLoad::Spread { from: 0.0, to: length, start: q, end: q };
            let own: f64 = c.iter().zip(local(ends)).map(|(c, p)| c * p).sum();
            row.loads.push((model.patterns.len(), direct(force, at, &spread) - own));
        }
        row
    }

    /// Distance of the first two nodes of an element, m.
    fn length(&self, model: &Model, element: usize) -> f64 {
        let e = &model.elements[element];
        let nodes: Vec<Vector3> = e.nodes.iter().map(|n| model.nodes[*n].position).collect();
        Geometry::new(&nodes, e.frame).length()
    }

    /// What loads along members bring to directions that nothing free follows, in sum weighed by `t` of the full DOFs:
    /// (index of the load pattern, sum).
    #[must_use]
    pub fn loads_past(&self, model: &Model, t: impl Fn(usize) -> f64) -> Vec<(usize, f64)> {
        let reduction = &self.reduction;
        let missed = |full: usize| {
            let order = reduction.order();
            let free = reduction.expand(full).iter().filter(|(j, _)| *j < order);
            t(full) - free.map(|(j, c)| c * t(reduction.free[*j])).sum::<f64>()
        };
        let past = |loads: &[MemberLoad]| -> f64 {
            let all = loads.iter().flat_map(|load| self.member_load(model, load));
            all.map(|(full, force)| missed(full) * force).sum()
        };
        let sums = model.patterns.iter().map(|p| past(&p.members)).enumerate();
        sums.filter(|(_, sum)| *sum != 0.0).collect()
    }
}
