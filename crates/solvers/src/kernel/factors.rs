//! The kept factors of the link equations, one for each rule of a step.

use crate::propagator::StepKey;
use serde::{Deserialize, Serialize};
use trilith_linalg::{Dense, DenseLu};
use trilith_system::{LinkSet, Tangents};

/// Row sum of (k − k_e) G + c H below which a coordinate needs no equation: what one iteration without it
/// leaves of its residual, at most.
const WEAK: f64 = 0.02;
/// Fewer coordinates than this all get an equation if they have tangents: an iteration costs more than it.
const WEAK_FROM: usize = 48;
/// Added to J's diagonal: a direction that nothing holds but its dummy, such as that of an open contact
/// under a weight, is singular in a static analysis; held by this, it goes far until something stops it.
const HOLD: f64 = 1e-12;
/// Rules whose factors are kept.
const KEPT: usize = 6;

/// A kept factor as a checkpoint holds it: the step and the tangents it was made with.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Remembered {
    pub key: StepKey,
    pub k: Vec<f64>,
    pub c: Vec<f64>,
}

/// What the equations of a factor are about.
#[derive(Clone, Copy)]
pub(super) struct Equations<'a> {
    pub links: &'a LinkSet,
    /// Active index of each flat coordinate.
    pub place: &'a [usize],
    /// Dummy stiffness of the active coordinates.
    pub dummy_k: &'a [f64],
    /// Compliances, active × active, symmetric.
    pub g: &'a Dense,
    pub h: &'a Dense,
    /// Identity of the compliances: a factor made with others is not used again.
    pub key: StepKey,
}

/// From residuals to Newton corrections.
pub(super) struct Factor {
    key: StepKey,
    pub tangents: Tangents,
    /// Active coordinates with a row of tangents that counts.
    equations: Vec<usize>,
    /// From the residual of all active coordinates to the corrections of these.
    correct: Dense,
}

/// The kept factors, the one used last at the end.
#[derive(Default)]
pub(super) struct Factors(Vec<Factor>);

impl Factors {
    /// For a checkpoint.
    pub fn memory(&self) -> Vec<Remembered> {
        let one = |f: &Factor| Remembered {
            key: f.key,
            k: f.tangents.k.clone(),
            c: f.tangents.c.clone(),
        };
        self.0.iter().map(one).collect()
    }

    /// Forgets the factor of a rule.
    pub fn forget(&mut self, key: StepKey) {
        self.0.retain(|f| f.key != key);
    }

    /// Makes a factor and keeps it.
    pub fn make(&mut self, of: Equations<'_>, tangents: Tangents) -> &Factor {
        self.forget(of.key);
        if self.0.len() >= KEPT {
            self.0.remove(0);
        }
        let at = self.0.len();
        self.0.push(Factor::new(of, tangents));
        &self.0[at]
    }

    /// The kept factor of a rule, where it is good enough; else a new one.
    pub fn take(
        &mut self,
        of: Equations<'_>,
        tangents: &Tangents,
        good: impl FnOnce(&Factor) -> bool,
    ) -> &Factor {
        let at = self.0.iter().position(|f| f.key == of.key);
        match at.filter(|at| good(&self.0[*at])) {
            Some(at) => {
                let last = self.0.len() - 1;
                self.0[at..].rotate_left(1);
                &self.0[last]
            }
            None => self.make(of, tangents.clone()),
        }
    }
}

impl Factor {
    fn new(of: Equations<'_>, tangents: Tangents) -> Self {
        let Equations { links, place, dummy_k, g, h, key } = of;
        let n = links.active.len();
        // Rows of k − k_e and c per active coordinate: (other active, stiffness, damping).
        let mut rows: Vec<Vec<(usize, f64, f64)>> = vec![Vec::new(); n];
        for link in &links.links {
            let size = link.range.len();
            for i in 0..size {
                let a = place[link.range.start + i];
                if a == usize::MAX {
                    continue;
                }
                for j in 0..size {
                    let b = place[link.range.start + j];
                    if b == usize::MAX {
                        continue;
                    }
                    let at = link.block.start + i * size + j;
                    let own = f64::from(u8::from(i == j));
                    let k = tangents.k[at] - own * dummy_k[a];
                    let c = tangents.c[at];
                    if k != 0.0 || c != 0.0 {
                        rows[a].push((b, k, c));
                    }
                }
            }
        }
        // Where a link is weak against the structure, f̃ ← law − k_e d converges as well as Newton's method.
        let weak = if n < WEAK_FROM { 0.0 } else { WEAK };
        let sum = |m: &Dense, b: usize| m.column(b).iter().map(|x| x.abs()).sum::<f64>();
        let strong = |a: &usize| {
            let terms = rows[*a].iter();
            terms.map(|(b, k, c)| k.abs() * sum(g, *b) + c.abs() * sum(h, *b)).sum::<f64>() > weak
        };
        let equations: Vec<usize> = (0..n).filter(strong).collect();
        let mut chosen = vec![usize::MAX; n];
        for (e, a) in equations.iter().enumerate() {
            chosen[*a] = e;
        }
        // J of the equations; what the others do to them goes to the right-hand side.
        let mut j = Dense::zeros(equations.len(), equations.len());
        let mut correct = Dense::zeros(equations.len(), n);
        let mut line = vec![0.0; n];
        for (e, a) in equations.iter().enumerate() {
            line.fill(0.0);
            for (b, k, c) in &rows[*a] {
                for (x, (g, h)) in line.iter_mut().zip(g.column(*b).iter().zip(h.column(*b))) {
                    *x += k * g + c * h;
                }
            }
            line[*a] += 1.0 + HOLD;
            for (b, x) in line.iter().enumerate() {
                match chosen[b] {
                    usize::MAX => correct[(e, b)] = -*x,
                    column => j[(e, column)] = *x,
                }
            }
            correct[(e, *a)] = 1.0;
        }
        DenseLu::new(&j).solve_columns(&mut correct);
        Self { key, tangents, equations, correct }
    }

    /// Replaces the residuals of the active coordinates by the corrections; those without an equation stay.
    pub fn correct(&self, residual: &mut [f64], space: &mut [f64]) {
        let x = &mut space[..self.equations.len()];
        x.fill(0.0);
        self.correct.mul_add(1.0, residual, x);
        for (a, value) in self.equations.iter().zip(x) {
            residual[*a] = *value;
        }
    }
}
