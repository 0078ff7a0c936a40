//! The equations of a description: matrices, loads over time, laws, outputs.

use super::assemble::{Assembled, GRAVITY, LinkAt, element};
use super::modes::{Modes, modes, split};
use super::spec::{Damping, Function, Law, Output, Spec};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// A jump of a load takes this share of the duration where there are directions without mass.
const JUMP: f64 = 1e-8;

/// A load: a vector times a function or one of its derivatives.
#[derive(Clone, Debug)]
pub struct Channel {
    /// Force on the free directions.
    pub force: DVector<f64>,
    /// Its course.
    pub function: Function,
    /// Derivative that counts: 0, 1, 2.
    pub order: usize,
}

/// Rows over displacements and over their rates: of what is free and of moved supports.
pub type Rows = [(DVector<f64>, DVector<f64>); 2];

/// A recorded quantity as a sum of rows.
#[derive(Clone, Debug)]
pub enum Probe {
    /// Row over free directions and moved supports.
    Displacement(DVector<f64>, DVector<f64>),
    /// The same over their rates.
    Velocity(DVector<f64>, DVector<f64>),
    /// A link coordinate.
    Force(usize),
    /// A link coordinate.
    Deformation(usize),
    /// The same as of a displacement over second derivatives, and what else is added.
    Acceleration(DVector<f64>, DVector<f64>, Vec<Function>),
    /// Rows over displacements and over their rates, as of a displacement.
    Member(Rows),
}

/// A problem.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Matrices.
    pub a: Assembled,
    /// Loads that are constant in time.
    pub constant: DVector<f64>,
    /// Loads.
    pub channels: Vec<Channel>,
    /// Histories of the moved supports.
    pub moved: Vec<Function>,
    /// Displacements at the start.
    pub u0: DVector<f64>,
    /// Velocities at the start.
    pub v0: DVector<f64>,
    /// Damping that goes with mass and stiffness.
    pub damping: Damping,
    /// A stiffness of the size of each link coordinate.
    pub beside: DVector<f64>,
    /// A circular frequency that is typical.
    pub omega: f64,
    /// Time of creep, s.
    pub creep: f64,
    /// Statics: no inertia, no damping, loads in proportion to time.
    pub still: bool,
    /// Times at which loads bend, from 0 to the end.
    pub breaks: Vec<f64>,
    /// Recorded quantities.
    pub probes: Vec<Probe>,
}

/// Modes of the structure with its links engaged.
#[must_use]
pub fn engaged(a: &Assembled) -> Modes {
    let mut k = a.k.clone();
    for link in &a.links {
        for (i, stiff) in link.law.stiffness(0.0).iter().enumerate() {
            let row = a.b.row(link.first + i);
            k += row.transpose() * row * *stiff;
        }
    }
    modes(&a.m, &k)
}

impl Problem {
    /// Of a description; `omega`: a circular frequency that is typical.
    ///
    /// # Errors
    /// What does not fit together.
    pub fn new(spec: &Spec, omega: f64) -> Result<Self, String> {
        let mut a = Assembled::new(spec)?;
        if let Damping::Modal(ratio) = spec.damping {
            let own = modes(&a.m, &a.k).damping(ratio);
            a.damp(&own)?;
        }
        let n = a.k.nrows();
        let mut constant = DVector::zeros(n);
        if spec.gravity {
            constant -= a.inertia.column(2) * GRAVITY;
        }
        // What has no mass jumps with its load, along a path that a law may ask for: stages see none.
        let (_, light) = split(&a.m);
        let rise = if light.ncols() > 0 { JUMP * spec.duration } else { 0.0 };
        let (mut channels, mut breaks) = (Vec::new(), vec![0.0, spec.duration]);
        let mut add = |force: DVector<f64>, function: &Function, order| {
            breaks.extend(function.breaks());
            channels.push(Channel { force, function: function.clone(), order });
        };
        for f in &spec.forces {
            let row = a.t.row(6 * f.node + f.dof).transpose();
            add(row * f.value, &f.function.without_jumps(rise), 0);
        }
        for (direction, f) in &spec.base {
            add(-a.inertia.column(*direction), &f.without_jumps(rise), 0);
        }
        for (j, (_, _, f)) in spec.moved.iter().enumerate() {
            add(-a.k_s.column(j), f, 0);
            add(-a.c_s.column(j), f, 1);
            add(-a.m_s.column(j), f, 2);
        }
        let (mut u0, mut v0) = (DVector::zeros(n), DVector::zeros(n));
        for (node, dof, u, v) in &spec.initial {
            let row = a.t.row(6 * node + dof);
            let Some(j) = (0..n).find(|j| row[*j] == 1.0 && row.amax() == 1.0) else {
                return Err("an initial value at a direction that follows others".into());
            };
            (u0[j], v0[j]) = (*u, *v);
        }
        let beside: Vec<f64> = a.links.iter().flat_map(|l| l.law.stiffness(omega)).collect();
        breaks.retain(|t| (0.0..=spec.duration).contains(t));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|b, a| (*b - *a).abs() < 1e-9 * spec.duration);
        let probes = spec.outputs.iter().map(|o| probe(spec, &a, o)).collect::<Result<_, _>>()?;
        Ok(Self {
            constant,
            channels,
            moved: spec.moved.iter().map(|m| m.2.clone()).collect(),
            u0,
            v0,
            damping: spec.damping,
            beside: beside.into(),
            omega,
            creep: 1e-9 / omega,
            still: false,
            breaks,
            probes,
            a,
        })
    }

    /// Steps end within this time of each other, s.
    pub fn cut(&mut self, longest: f64) {
        let mut cut = vec![self.breaks[0]];
        for pair in self.breaks.windows(2) {
            let parts = ((pair[1] - pair[0]) / longest).ceil().max(1.0);
            let at = |i: usize| pair[0] + (pair[1] - pair[0]) * i as f64 / parts;
            cut.extend((1..parts as usize).map(at));
            cut.push(pair[1]);
        }
        self.breaks = cut;
    }

    /// The static problem before it: constant loads from nothing to their value at time 1.
    #[must_use]
    pub fn before(&self) -> Self {
        let n = self.constant.len();
        let force = self.constant.clone();
        let mut it = self.clone();
        it.a.m = DMatrix::zeros(n, n);
        it.a.c = DMatrix::zeros(n, n);
        it.a.b_s = &self.a.b_s * 0.0;
        it.a.dash_rows = DMatrix::zeros(0, n);
        it.a.dash.clear();
        it.damping = Damping::None;
        it.constant = DVector::zeros(n);
        it.channels = vec![Channel { force, function: Function::Ramp(1.0, 0.0, 1.0), order: 0 }];
        it.u0.fill(0.0);
        it.v0.fill(0.0);
        it.breaks = vec![0.0, 1.0];
        it.creep = 1e-9;
        it.still = true;
        it
    }

    /// The static problem of joints that neither a mass nor a dashpot holds, while all others go slowly and straight
    /// to their initial displacements at time 1; the joints' directions, and the displacements of the others.
    #[must_use]
    pub fn led(&self) -> Option<(Self, DMatrix<f64>, DVector<f64>)> {
        let (_, light) = split(&self.a.m);
        if self.u0.amax() == 0.0 || light.ncols() == 0 {
            return None;
        }
        let mut rows: Vec<_> = self.a.dash_rows.row_iter().map(|r| r.into_owned()).collect();
        for link in &self.a.links {
            let viscous = match link.law {
                Law::Dashpot(..) => 1,
                Law::Linear(_, c) if c[0][0] != 0.0 || c[1][1] != 0.0 => 2,
                _ => 0,
            };
            rows.extend((0..viscous).map(|i| self.a.b.row(link.first + i).into_owned()));
        }
        let mut tied = DMatrix::zeros(rows.len(), light.ncols());
        for (mut to, row) in tied.row_iter_mut().zip(rows) {
            let own = &row * &light;
            // What is left of a row that acts on others is rounding.
            if own.norm() > 1e-9 * row.norm() {
                to.copy_from(&own.normalize());
            }
        }
        let eigen = SymmetricEigen::new(tied.tr_mul(&tied));
        let free: Vec<usize> =
            (0..light.ncols()).filter(|j| eigen.eigenvalues[*j].abs() < 1e-9).collect();
        if free.is_empty() {
            return None;
        }
        let mut q = (&light * eigen.eigenvectors.select_columns(&free)).qr().q();
        // Rounding would be a stiffness.
        q.iter_mut().filter(|x| x.abs() < 1e-12).for_each(|x| *x = 0.0);
        let others = &self.u0 - &q * q.tr_mul(&self.u0);
        let mut it = self.before();
        let ramp = Function::Ramp(1.0, 0.0, 1.0);
        let force = -q.tr_mul(&(&self.a.k * &others));
        it.a.m = DMatrix::zeros(q.ncols(), q.ncols());
        it.a.c = it.a.m.clone();
        it.a.k = q.tr_mul(&(&self.a.k * &q));
        it.a.b = &self.a.b * &q;
        it.a.b_s = DMatrix::from_columns(&[&self.a.b * &others]);
        it.a.t = &self.a.t * &q;
        it.a.dash_rows = DMatrix::zeros(0, q.ncols());
        it.moved = vec![ramp.clone()];
        it.constant = DVector::zeros(q.ncols());
        it.channels = vec![Channel { force, function: ramp, order: 0 }];
        (it.u0, it.v0) = (it.constant.clone(), it.constant.clone());
        it.probes.clear();
        Some((it, q, others))
    }

    /// Loads at a time, before any jump there.
    #[must_use]
    pub fn load(&self, t: f64) -> DVector<f64> {
        let mut p = self.constant.clone();
        for c in &self.channels {
            p.axpy(c.function.at(t, false)[c.order], &c.force, 1.0);
        }
        p
    }

    /// Displacement and velocity of the moved supports.
    #[must_use]
    pub fn supports(&self, t: f64, after: bool) -> [DVector<f64>; 2] {
        let all: Vec<[f64; 3]> = self.moved.iter().map(|f| f.at(t, after)).collect();
        [0, 1].map(|i| DVector::from_iterator(all.len(), all.iter().map(|x| x[i])))
    }

    /// Number of own unknowns of all links.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.a.links.iter().map(|l| l.law.unknowns()).sum()
    }
}

/// Rows of a member's stiffness and damping at one of its directions, over what moves.
fn end_force(spec: &Spec, a: &Assembled, member: usize, i: usize) -> Result<Rows, String> {
    let m = spec.members.get(member).ok_or("no such member")?;
    let (it, _) = element(spec, m).ok_or("no linear member")?;
    Ok([&it.k, &it.c].map(|of| {
        let mut full = DVector::zeros(a.t.nrows());
        for j in 0..of.ncols() {
            full[6 * m.nodes[j / 6] + j % 6] += of[(i, j)];
        }
        (a.t.transpose() * &full, a.s.transpose() * full)
    }))
}

fn probe(spec: &Spec, a: &Assembled, output: &Output) -> Result<Probe, String> {
    let rows =
        |n: usize, d: usize| (a.t.row(6 * n + d).transpose(), a.s.row(6 * n + d).transpose());
    let coordinate = |member: usize, axis: usize| {
        let at = |l: &&LinkAt| l.member == member && l.axes.contains(&axis);
        let link = a.links.iter().find(at).ok_or("no such link output")?;
        let local = link.axes.iter().position(|x| *x == axis).unwrap_or(0);
        Ok::<usize, String>(link.first + local)
    };
    Ok(match *output {
        Output::Displacement(n, d) => {
            let (t, s) = rows(n, d);
            Probe::Displacement(t, s)
        }
        Output::Velocity(n, d) => {
            let (t, s) = rows(n, d);
            Probe::Velocity(t, s)
        }
        Output::LinkForce(e, x) => Probe::Force(coordinate(e, x)?),
        Output::LinkDeformation(e, x) => Probe::Deformation(coordinate(e, x)?),
        Output::Drift(above, below, d) => {
            let ((t, s), (t0, s0)) = (rows(above, d), rows(below, d));
            Probe::Displacement(t - t0, s - s0)
        }
        Output::Acceleration(n, d) => {
            let (t, s) = rows(n, d);
            let base = spec.base.iter().filter(|(along, _)| *along == d);
            Probe::Acceleration(t, s, base.map(|(_, f)| f.clone()).collect())
        }
        Output::End(e, end, d) => Probe::Member(end_force(spec, a, e, 6 * end + d)?),
    })
}
