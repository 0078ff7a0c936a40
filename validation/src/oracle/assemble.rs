//! Dense matrices of a description on the directions that are free.
//!
//! ```text
//!   u_full = T q + S s(t),   M q̈ + C q̇ + K q + Bᵀ f = p(t) − (M_s s̈ + C_s ṡ + K_s s)
//! ```

use super::matrices::{Matrices, beam, deformation, spring, truss};
use super::spec::{Damping, Kind, Law, Member, Spec};
use nalgebra::{DMatrix, DVector};

/// A link and where its coordinates are.
#[derive(Clone, Debug)]
pub struct LinkAt {
    /// Its member.
    pub member: usize,
    /// Its law.
    pub law: Law,
    /// First of its coordinates.
    pub first: usize,
    /// Its local axes.
    pub axes: Vec<usize>,
}

/// The structure.
#[derive(Clone, Debug)]
pub struct Assembled {
    /// All directions over free ones.
    pub t: DMatrix<f64>,
    /// All directions over moved supports.
    pub s: DMatrix<f64>,
    /// Mass.
    pub m: DMatrix<f64>,
    /// Damping without the modal one.
    pub c: DMatrix<f64>,
    /// Stiffness without links.
    pub k: DMatrix<f64>,
    /// Free over moved.
    pub m_s: DMatrix<f64>,
    /// Free over moved.
    pub c_s: DMatrix<f64>,
    /// Free over moved.
    pub k_s: DMatrix<f64>,
    /// Inertia per unit acceleration along X, Y, Z.
    pub inertia: DMatrix<f64>,
    /// Link coordinates over free directions.
    pub b: DMatrix<f64>,
    /// Link coordinates over moved supports.
    pub b_s: DMatrix<f64>,
    /// The links.
    pub links: Vec<LinkAt>,
    /// Elongations of the dashpots of spring members over free directions.
    pub dash_rows: DMatrix<f64>,
    /// Their coefficients.
    pub dash: Vec<f64>,
}

/// Acceleration of gravity.
pub const GRAVITY: f64 = 9.80665;

fn nodes(spec: &Spec, m: &Member) -> ([f64; 3], Option<[f64; 3]>) {
    (spec.nodes[m.nodes[0]], m.nodes.get(1).map(|n| spec.nodes[*n]))
}

/// The matrices of a member and whether its inertia is mass that gravity and the ground see.
pub(super) fn element(spec: &Spec, m: &Member) -> Option<(Matrices, bool)> {
    let (from, to) = nodes(spec, m);
    match (&m.kind, to) {
        (Kind::Beam(b), Some(to)) => Some((beam(b, from, to), true)),
        (Kind::Truss(e, a, rho, how), Some(to)) => {
            Some((truss((*e, *a, *rho, *how), from, to), true))
        }
        (Kind::Spring(k, c), _) => Some((spring(k, c, &deformation(from, to, m.axis1)), true)),
        (Kind::Mass(mass, inertia), _) => {
            let mut it = Matrices::none(6);
            for i in 0..3 {
                it.m[(i, i)] = *mass;
                it.m[(i + 3, i + 3)] = inertia[i];
            }
            Some((it, true))
        }
        (Kind::Inerter(b, axis), _) => {
            let row = deformation(from, to, m.axis1).row(*axis).into_owned();
            let mut it = Matrices::none(row.ncols());
            it.m = *b * row.transpose() * row;
            Some((it, false))
        }
        _ => None,
    }
}

/// Equations Σ c u = 0 of a constraint: terms and the direction that should go.
fn equations(spec: &Spec, m: &Member) -> Vec<(usize, Vec<(usize, f64)>)> {
    let mut all = Vec::new();
    let lead = m.nodes[0];
    for follow in &m.nodes[1..] {
        let (a, b) = (spec.nodes[lead], spec.nodes[*follow]);
        let r = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
        // u_s = u_m + θ × r.
        let turn = [[0.0, r[2], -r[1]], [-r[2], 0.0, r[0]], [r[1], -r[0], 0.0]];
        let mut rigid = |dof: usize, about: &[usize]| {
            let mut terms = vec![(6 * follow + dof, 1.0), (6 * lead + dof, -1.0)];
            if dof < 3 {
                terms.extend(about.iter().map(|x| (6 * lead + 3 + x, -turn[dof][*x])));
            }
            all.push((6 * follow + dof, terms));
        };
        match &m.kind {
            Kind::RigidLink | Kind::RigidBody => (0..6).for_each(|d| rigid(d, &[0, 1, 2])),
            Kind::Diaphragm => [0, 1, 5].iter().for_each(|d| rigid(*d, &[2])),
            Kind::EqualDof(dofs) => dofs.iter().for_each(|d| rigid(*d, &[])),
            _ => {}
        }
    }
    all
}

/// T and S: elimination by pivots, the direction that follows first.
fn reduce(spec: &Spec) -> Result<(DMatrix<f64>, DMatrix<f64>), String> {
    let count = 6 * spec.nodes.len();
    let held = |i: usize| spec.fixed[i / 6][i % 6] || (spec.plane && !matches!(i % 6, 0 | 2 | 4));
    let moved: Vec<usize> = spec.moved.iter().map(|m| 6 * m.0 + m.1).collect();
    let mut rows: Vec<(usize, DVector<f64>)> = Vec::new();
    for m in &spec.members {
        for (follow, terms) in equations(spec, m) {
            let mut row: DVector<f64> = DVector::zeros(count);
            for (i, c) in terms {
                if !held(i) || moved.contains(&i) {
                    row[i] += c;
                }
            }
            for (pivot, other) in &rows {
                let share = row[*pivot];
                row -= other * share;
            }
            let can = |i: &usize| !moved.contains(i) && row[*i].abs() > 1e-9;
            let pivot = if can(&follow) {
                Some(follow)
            } else {
                (0..count).filter(can).max_by(|a, b| row[*a].abs().total_cmp(&row[*b].abs()))
            };
            match pivot {
                Some(p) => {
                    row /= row[p];
                    for (_, other) in &mut rows {
                        let share = other[p];
                        *other -= &row * share;
                    }
                    rows.push((p, row));
                }
                None if row.amax() > 1e-9 => return Err("constraints fight supports".into()),
                None => {}
            }
        }
    }
    let gone = |i: usize| rows.iter().any(|(p, _)| *p == i);
    let free: Vec<usize> =
        (0..count).filter(|i| !held(*i) && !gone(*i) && !moved.contains(i)).collect();
    let fill = |of: &[usize]| {
        let mut a = DMatrix::zeros(count, of.len());
        for (j, i) in of.iter().enumerate() {
            a[(*i, j)] = 1.0;
            for (p, row) in &rows {
                a[(*p, j)] = -row[*i];
            }
        }
        a
    };
    Ok((fill(&free), fill(&moved)))
}

impl Assembled {
    /// Assembles.
    ///
    /// # Errors
    /// Where constraints and supports do not fit together.
    pub fn new(spec: &Spec) -> Result<Self, String> {
        let count = 6 * spec.nodes.len();
        let mut full = Matrices::none(count);
        let mut weight = DMatrix::zeros(count, count);
        let place = |m: &Member, i: usize| 6 * m.nodes[i / 6] + i % 6;
        let row = |m: &Member, d: &DMatrix<f64>, axis: usize| {
            let mut row = DVector::zeros(count);
            for j in 0..d.ncols() {
                row[place(m, j)] += d[(axis, j)];
            }
            row
        };
        let mut links = Vec::new();
        let mut rows: Vec<DVector<f64>> = Vec::new();
        let (mut dash, mut dash_rows) = (Vec::new(), Vec::new());
        for (member, m) in spec.members.iter().enumerate() {
            if let Some((it, heavy)) = element(spec, m) {
                for i in 0..it.k.nrows() {
                    for j in 0..it.k.nrows() {
                        let at = (place(m, i), place(m, j));
                        full.k[at] += it.k[(i, j)];
                        full.c[at] += it.c[(i, j)];
                        full.m[at] += it.m[(i, j)];
                        if heavy {
                            weight[at] += it.m[(i, j)];
                        }
                    }
                }
            }
            if let Kind::Spring(_, c) = &m.kind {
                let (from, to) = nodes(spec, m);
                let d = deformation(from, to, m.axis1);
                for a in (0..6).filter(|a| c[*a] != 0.0) {
                    dash.push(c[a]);
                    dash_rows.push(row(m, &d, a));
                }
            }
            if let Kind::Link(law, axis) = &m.kind {
                let (from, to) = nodes(spec, m);
                let d = deformation(from, to, m.axis1);
                let axes = law.axes(*axis);
                let first = rows.len();
                rows.extend(axes.iter().map(|a| row(m, &d, *a)));
                links.push(LinkAt { member, law: law.clone(), first, axes });
            }
        }
        let (t, s) = reduce(spec)?;
        let b = DMatrix::from_fn(rows.len(), count, |i, j| rows[i][j]);
        // Directions that nothing acts on are no unknowns.
        let image = |a: &DMatrix<f64>| a * &t;
        let (bt, kt, ct, mt) = (image(&b), image(&full.k), image(&full.c), image(&full.m));
        let used: Vec<usize> = (0..t.ncols())
            .filter(|j| [&bt, &kt, &ct, &mt].iter().any(|a| a.column(*j).amax() > 0.0))
            .collect();
        let t = t.select_columns(&used);
        let with = |a: &DMatrix<f64>, x: &DMatrix<f64>| t.transpose() * (a * x);
        let along = DMatrix::from_fn(count, 3, |i, j| f64::from(u8::from(i % 6 == j)));
        let (mut c, mut c_s) = (with(&full.c, &t), with(&full.c, &s));
        let (k, m) = (with(&full.k, &t), with(&full.m, &t));
        let (k_s, m_s) = (with(&full.k, &s), with(&full.m, &s));
        if let Damping::Rayleigh(of_mass, of_stiffness) = spec.damping {
            let own = &m * of_mass + &k * of_stiffness;
            c_s += relative(&own, &k, &k_s)?;
            c += own;
        }
        Ok(Self {
            inertia: with(&weight, &along),
            b: &b * &t,
            dash_rows: DMatrix::from_fn(dash.len(), count, |i, j| dash_rows[i][j]) * &t,
            dash,
            b_s: &b * &s,
            m,
            c,
            k,
            m_s,
            c_s,
            k_s,
            links,
            t,
            s,
        })
    }

    /// Takes in modal damping.
    ///
    /// # Errors
    /// Where the pseudo-static motion of supports is none.
    pub fn damp(&mut self, own: &DMatrix<f64>) -> Result<(), String> {
        self.c_s += relative(own, &self.k, &self.k_s)?;
        self.c += own;
        Ok(())
    }
}

/// Pivots below this share of the largest are rounding.
const SINGULAR: f64 = 1e-12;

/// C (q̇ − ι ṡ) over ṡ, ι = −K⁻¹ K_s.
fn relative(
    c: &DMatrix<f64>,
    k: &DMatrix<f64>,
    k_s: &DMatrix<f64>,
) -> Result<DMatrix<f64>, String> {
    if k_s.ncols() == 0 || c.nrows() == 0 {
        return Ok(k_s * 0.0);
    }
    let singular = "no pseudo-static motion: K of the structure is singular";
    let factor = k.clone().full_piv_lu();
    // What only links hold leaves pivots of rounding, and no load says how far it goes along.
    let pivots = factor.u().diagonal().abs();
    if pivots.min() <= SINGULAR * pivots.max() {
        return Err(singular.into());
    }
    let follow = factor.solve(k_s).filter(|x| x.iter().all(|v| v.is_finite())).ok_or(singular)?;
    if (k * &follow - k_s).amax() > 1e-6 * k_s.amax() {
        return Err(singular.into());
    }
    Ok(c * follow)
}
