//! Coordinates in which the structure without its links falls apart into single equations.
//!
//! ```text
//!   u = Φ q:   mⱼ q̈ⱼ + cⱼ q̇ⱼ + kⱼ qⱼ = φⱼᵀ (p − Bᵀ f)
//! ```
//!
//! Directions with mass give natural modes, m = 1; those without give shapes that are square to the modes by
//! stiffness, m = 0, k = 1. Damping of the whole structure is one number for each of both; single dashpots
//! are taken as links. A direction that only links hold has no stiffness of its own: it gets one, which is
//! taken out again as the force of one more link. [Bathe 1996, ch. 9 to 11]

use super::super::modes::{eigen, split};
use super::super::problem::{Probe, Problem};
use super::super::spec::Damping;
use nalgebra::{Cholesky, DMatrix, DVector};

/// The coordinates and all that is said in them.
pub struct Coordinates {
    /// Directions over coordinates.
    pub shapes: DMatrix<f64>,
    /// Mass: 1 or 0.
    pub m: Vec<f64>,
    /// Damping.
    pub c: Vec<f64>,
    /// Stiffness.
    pub k: Vec<f64>,
    /// Stiffness without what is taken out again.
    pub own: Vec<f64>,
    /// Coordinates over links: those of the laws, of the dashpots, of what is taken out again.
    pub links: DMatrix<f64>,
    /// Forces constant in time.
    pub constant: Vec<f64>,
    /// Forces of the channels.
    pub channels: Vec<Vec<f64>>,
    /// Row of a probe of the motion; of a member's force two, over displacements and over rates.
    pub probes: Vec<Vec<f64>>,
}

/// What is below this, of 1, is nothing.
const NOTHING: f64 = 1e-10;

/// Shapes as columns, and the three numbers of each.
#[derive(Default)]
struct Shapes {
    columns: Vec<DVector<f64>>,
    m: Vec<f64>,
    c: Vec<f64>,
    k: Vec<f64>,
    own: Vec<f64>,
}

impl Shapes {
    fn add(&mut self, column: DVector<f64>, [m, c, k, own]: [f64; 4]) {
        self.columns.push(column);
        self.m.push(m);
        self.c.push(c);
        self.k.push(k);
        self.own.push(own);
    }
}

impl Coordinates {
    /// Of a problem.
    ///
    /// # Errors
    /// A direction that nothing holds.
    pub fn new(p: &Problem) -> Result<Self, String> {
        let a = &p.a;
        let (heavy, light) = split(&a.m);
        let of_stiffness = if let Damping::Rayleigh(_, b) = p.damping { b } else { 0.0 };
        let mut all = Shapes::default();
        let mut loose = Vec::new();
        for shape in massless(&a.k, &light) {
            match shape {
                Massless::Held(column) => all.add(column, [0.0, of_stiffness, 1.0, 1.0]),
                Massless::Loose(column) => loose.push(column),
            }
        }
        for column in held_by_links(p, &loose)? {
            all.add(column, [0.0, 0.0, 1.0, 0.0]);
        }
        modes(p, &heavy, &mut all)?;
        let n = a.k.nrows();
        let shapes = if all.columns.is_empty() {
            DMatrix::zeros(n, 0)
        } else {
            DMatrix::from_columns(&all.columns)
        };
        let count = shapes.ncols();
        let loose: Vec<usize> = (0..count).filter(|j| all.k[*j] != all.own[*j]).collect();
        let (l, dashes) = (a.b.nrows(), a.dash.len());
        let mut links = DMatrix::zeros(count, l + dashes + loose.len());
        let back = shapes.transpose();
        links.columns_mut(0, l).copy_from(&(&back * a.b.transpose()));
        links.columns_mut(l, dashes).copy_from(&(&back * a.dash_rows.transpose()));
        for (i, j) in loose.iter().enumerate() {
            links[(*j, l + dashes + i)] = 1.0;
        }
        let into = |x: &DVector<f64>| (&back * x).as_slice().to_vec();
        let probes = p.probes.iter().map(|probe| match probe {
            Probe::Displacement(row, _) | Probe::Velocity(row, _) => into(row),
            Probe::Acceleration(row, ..) => into(row),
            Probe::Member(rows) => rows.iter().flat_map(|(row, _)| into(row)).collect(),
            Probe::Force(_) | Probe::Deformation(_) => Vec::new(),
        });
        Ok(Self {
            probes: probes.collect(),
            constant: into(&p.constant),
            channels: p.channels.iter().map(|c| into(&c.force)).collect(),
            m: all.m,
            c: all.c,
            k: all.k,
            own: all.own,
            links,
            shapes,
        })
    }

    /// Number of coordinates.
    #[must_use]
    pub fn len(&self) -> usize {
        self.m.len()
    }

    /// Coordinates of displacements: by mass or, where there is none, by stiffness.
    #[must_use]
    pub fn of(&self, p: &Problem, u: &DVector<f64>) -> Vec<f64> {
        let by_mass = self.shapes.tr_mul(&(&p.a.m * u));
        let by_stiffness = self.shapes.tr_mul(&(&p.a.k * u));
        let one = |j: usize| if self.m[j] > 0.0 { by_mass[j] } else { by_stiffness[j] };
        let mut q: Vec<f64> = (0..self.len()).map(one).collect();
        // What only links hold is what is left.
        let loose: Vec<usize> = (0..self.len()).filter(|j| self.k[*j] != self.own[*j]).collect();
        if !loose.is_empty() {
            let rest = u - &self.shapes * DVector::from_column_slice(&q);
            let columns = self.shapes.select_columns(&loose);
            let fit = columns.tr_mul(&columns).lu().solve(&columns.tr_mul(&rest));
            for (i, j) in loose.iter().enumerate() {
                q[*j] = fit.as_ref().map_or(0.0, |x| x[i]);
            }
        }
        q
    }

    /// Displacements, or velocities, of coordinates.
    #[must_use]
    pub fn directions(&self, q: &[f64]) -> DVector<f64> {
        let mut u = DVector::zeros(self.shapes.nrows());
        for (column, x) in self.shapes.column_iter().zip(q).filter(|(_, x)| **x != 0.0) {
            u.axpy(*x, &column, 1.0);
        }
        u
    }
}

enum Massless {
    /// Of unit stiffness.
    Held(DVector<f64>),
    /// Without stiffness.
    Loose(DVector<f64>),
}

/// Shapes of what has no mass, square to each other by stiffness.
fn massless(k: &DMatrix<f64>, light: &DMatrix<f64>) -> Vec<Massless> {
    if light.ncols() == 0 {
        return Vec::new();
    }
    let own = light.tr_mul(&(k * light));
    let top = own.diagonal().amax();
    let size: Vec<f64> = own
        .diagonal()
        .iter()
        .map(|x| if *x > 1e-16 * top { x.sqrt().recip() } else { 1.0 })
        .collect();
    let unit = DMatrix::from_fn(own.nrows(), own.nrows(), |i, j| size[i] * own[(i, j)] * size[j]);
    let mut base = light.clone();
    for (mut column, s) in base.column_iter_mut().zip(&size) {
        column *= *s;
    }
    if let Some(factor) = Cholesky::new(unit.clone()) {
        let l = factor.unpack();
        if l.diagonal().min().powi(2) > NOTHING {
            let columns = l.solve_lower_triangular(&base.transpose()).unwrap_or_default();
            return columns.row_iter().map(|x| Massless::Held(x.transpose())).collect();
        }
    }
    let (values, vectors) = eigen(&unit);
    let shape = |(j, value): (usize, &f64)| {
        let column = &base * vectors.column(j);
        if *value > NOTHING {
            Massless::Held(column / value.sqrt())
        } else {
            Massless::Loose(column)
        }
    };
    values.iter().enumerate().map(shape).collect()
}

/// Shapes without stiffness, square to each other by the stiffness that links have and of unit one: shapes
/// that hardly differ in what deforms the links would leave nothing but rounding.
fn held_by_links(p: &Problem, loose: &[DVector<f64>]) -> Result<Vec<DVector<f64>>, String> {
    if loose.is_empty() {
        return Ok(Vec::new());
    }
    let (a, mut shapes) = (&p.a, DMatrix::from_columns(loose));
    let held = |shapes: &DMatrix<f64>| {
        let (laws, dash) = (&a.b * shapes, &a.dash_rows * shapes);
        let mut sum = laws.tr_mul(&(DMatrix::from_diagonal(&p.beside) * &laws));
        for (row, c) in dash.row_iter().zip(&a.dash) {
            sum += row.transpose() * row * (c * p.omega);
        }
        sum
    };
    let own = held(&shapes).diagonal();
    if own.iter().any(|x| *x <= 0.0) {
        return Err("a direction without mass that nothing holds".into());
    }
    for (mut column, x) in shapes.column_iter_mut().zip(own.iter()) {
        column /= x.sqrt();
    }
    let (values, vectors) = eigen(&held(&shapes));
    let one = |(j, value): (usize, &f64)| {
        let column = &shapes * vectors.column(j);
        column / value.max(f64::EPSILON).sqrt()
    };
    Ok(values.iter().enumerate().map(one).collect())
}

/// Natural modes, square to the massless shapes by stiffness.
fn modes(p: &Problem, heavy: &DMatrix<f64>, all: &mut Shapes) -> Result<(), String> {
    let (k, m) = (&p.a.k, &p.a.m);
    if heavy.ncols() == 0 {
        return Ok(());
    }
    let mass = heavy.tr_mul(&(m * heavy));
    let factor = mass.cholesky().ok_or("the mass is no mass")?.unpack();
    let mut base =
        factor.solve_lower_triangular(&heavy.transpose()).ok_or("the mass is no mass")?.transpose();
    let held: Vec<_> = (0..all.columns.len()).filter(|j| all.own[*j] > 0.0).collect();
    if !held.is_empty() {
        let columns: Vec<_> = held.iter().map(|j| all.columns[*j].clone()).collect();
        let light = DMatrix::from_columns(&columns);
        let tie = (k * &light).tr_mul(&base);
        base -= light * tie;
    }
    let inner = base.tr_mul(&(k * &base));
    let inner = (&inner + inner.transpose()) * 0.5;
    let (values, vectors) = eigen(&inner);
    let shapes = base * vectors;
    let omega: Vec<f64> = values.iter().map(|x| x.max(0.0).sqrt()).collect();
    let top = omega.iter().copied().fold(0.0, f64::max);
    for (j, w) in omega.iter().enumerate() {
        let damping = match p.damping {
            Damping::None => 0.0,
            // A body that moves without deformation has none.
            Damping::Modal(ratio) if *w > 1e-7 * top => 2.0 * ratio * w,
            Damping::Modal(_) => 0.0,
            Damping::Rayleigh(of_mass, of_stiffness) => of_mass + of_stiffness * w * w,
        };
        all.add(shapes.column(j).into_owned(), [1.0, damping, w * w, w * w]);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::super::generate::generate;
    use super::*;

    /// Mass, damping and stiffness of random structures are what the coordinates say, dashpots beside.
    #[test]
    fn the_matrices_of_a_structure_are_diagonal_in_its_coordinates() {
        for seed in 1..=60 {
            let spec = generate(seed);
            let p = Problem::new(&spec, 1.0).unwrap();
            if p.a.k.nrows() > 60 {
                continue;
            }
            let it = Coordinates::new(&p).unwrap();
            let count = p.a.dash.len();
            let dash = it.links.columns(p.a.b.nrows(), count);
            let dashes = DMatrix::from_diagonal(&DVector::from_column_slice(&p.a.dash));
            let none = DMatrix::zeros(it.len(), it.len());
            let beside = dash * dashes * dash.transpose();
            let all = [(&p.a.m, &it.m, &none), (&p.a.k, &it.own, &none), (&p.a.c, &it.c, &beside)];
            for (matrix, numbers, beside) in all {
                let got = it.shapes.tr_mul(&(matrix * &it.shapes));
                let want = DMatrix::from_diagonal(&DVector::from_column_slice(numbers)) + beside;
                let size = want.amax().max(1.0);
                assert!((got - want).amax() < 1e-7 * size, "seed {seed}");
            }
        }
    }
}
