//! The structure as a rule of another crate sees it.

use crate::basis::LowRank;
use crate::structure::ReducedSystem;
use std::cell::Cell;
use trilith_element::{Factor, LinearStructure};
use trilith_linalg::{Dense, DenseLu, Ldlt, LinalgError, Sparse};
use trilith_model::Model;
use trilith_system::System;

/// Matrices, and the names of their directions for what is said of them.
pub(super) struct Structure<'a> {
    model: &'a Model,
    system: &'a System,
    pub space: ReducedSystem,
    factorizations: Cell<usize>,
}

impl<'a> Structure<'a> {
    pub fn new(model: &'a Model, system: &'a System, space: ReducedSystem) -> Self {
        Self { model, system, space, factorizations: Cell::new(0) }
    }

    pub fn factorizations(&self) -> usize {
        self.factorizations.get()
    }

    /// Which direction an equation is of.
    fn name(&self, equation: usize) -> String {
        let free = self.system.reduction.free.get(equation).filter(|_| self.space.shape.is_none());
        free.map_or_else(
            || format!("vector {} of the basis", equation + 1),
            |full| {
                let (place, direction) = self.system.inner.name(self.model, *full);
                format!("{direction} of \"{place}\"")
            },
        )
    }
}

impl LinearStructure for Structure<'_> {
    fn order(&self) -> usize {
        self.space.order()
    }

    fn mass(&self, s: f64, x: &[f64], y: &mut [f64]) {
        self.space.mass.mul_add(s, x, y);
    }

    fn damping(&self, s: f64, x: &[f64], y: &mut [f64]) {
        self.space.damp(s, x, y);
    }

    fn stiffness(&self, s: f64, x: &[f64], y: &mut [f64]) {
        self.space.stiffness.mul_add(s, x, y);
    }

    fn factorise(&self, m: f64, c: f64, k: f64) -> Result<Box<dyn Factor>, String> {
        let space = &self.space;
        let [of_mass, of_stiffness] = space.rayleigh;
        let parts = [
            (m + c * of_mass, &space.mass),
            (c, &space.damping),
            (k + c * of_stiffness, &space.stiffness),
        ];
        let own: Vec<(f64, &Sparse)> = parts.into_iter().filter(|(s, _)| *s != 0.0).collect();
        let singular = |equation: usize| {
            let what = format!("{m:.3e} M + {c:.3e} C + {k:.3e} K");
            format!("{what} is singular: {} has none of these", self.name(equation))
        };
        let Some(((_, first), _)) = own.split_first() else { return Err(singular(0)) };
        // An empty column is none to the factorisation.
        let empty =
            (0..first.columns()).find(|j| own.iter().all(|(_, a)| a.column(*j).0.is_empty()));
        if let Some(equation) = empty {
            return Err(singular(equation));
        }
        self.factorizations.set(self.factorizations.get() + 1);
        let mut factor = Ldlt::new(&Sparse::combine(&own)).map_err(|error| match error {
            LinalgError::Singular { equation } => singular(equation),
            other => other.to_string(),
        })?;
        let modal = space.modal.as_ref().filter(|_| c != 0.0);
        let woodbury = modal.map(|modal| Woodbury::new(&mut factor, modal, c));
        Ok(Box::new(Solved { factor, woodbury }))
    }
}

/// A factor with the low-rank term of modal damping.
struct Solved {
    factor: Ldlt,
    woodbury: Option<Woodbury>,
}

impl Factor for Solved {
    fn solve(&mut self, x: &mut [f64]) {
        self.factor.solve(x);
        if let Some(woodbury) = &self.woodbury {
            woodbury.correct(x);
        }
    }
}

/// (A₀ + c U R Uᵀ)⁻¹ r = y − X N⁻¹ Uᵀ y with y = A₀⁻¹ r, X = A₀⁻¹ U and N = R⁻¹/c + Uᵀ X (Woodbury).
struct Woodbury {
    u: Dense,
    x: Dense,
    inner: DenseLu,
}

impl Woodbury {
    fn new(factor: &mut Ldlt, modal: &LowRank, c: f64) -> Self {
        let mut x = modal.u.clone();
        factor.solve(x.values_mut());
        let mut inner = modal.u.transpose_times(&x);
        for (k, rate) in modal.rate.iter().enumerate() {
            inner[(k, k)] += 1.0 / (c * rate);
        }
        Self { u: modal.u.clone(), x, inner: DenseLu::new(&inner) }
    }

    fn correct(&self, y: &mut [f64]) {
        let mut share = vec![0.0; self.x.columns()];
        self.u.transpose_mul_add(1.0, y, &mut share);
        self.inner.solve(&mut share);
        self.x.mul_add(-1.0, &share, y);
    }
}
