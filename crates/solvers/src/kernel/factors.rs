//! The kept factors of the link equations, one for each rule of a step.
//!
//! ```text
//! J = I + (k − k_e) G + c H        over the active coordinates with tangents that count; the others: Δf̃ = r
//! C = J⁻¹ (1, −J_rest)             from residuals to corrections; −G C and −H C: how d and ḋ follow
//! ```

use super::affine::StepKey;
use super::compliance::ComplianceMatrix;
use super::layout::Unknowns;
use super::modal_jacobian::ModalJacobian;
use super::{Layout, add};
use serde::{Deserialize, Serialize};
use trilith_linalg::{Dense, DenseLu, Panel, Product, solve_few};
use trilith_system::Tangents;

/// Row sum of (k − k_e) G + c H below which a coordinate needs no equation: what one iteration without it
/// leaves of its residual, at most.
const WEAK: f64 = 0.02;
/// Fewer coordinates than this all get an equation if they have tangents: an iteration costs more than it.
const WEAK_FROM: usize = 48;
/// Added to J's diagonal: a direction that nothing holds but its effective stiffness, such as that of an open contact
/// under a weight, is singular in a static analysis; held by this, it goes far until something stops it.
const HOLD: f64 = 1e-12;
/// Up to this many coordinates one product gives corrections and what follows from them.
const FEW: usize = 64;
/// Up to so many equations are eliminated at once.
const ELIMINATED: usize = 16;
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
    pub layout: &'a Layout<'a>,
    /// Compliances, active × active, symmetric.
    pub g: &'a ComplianceMatrix,
    pub h: &'a ComplianceMatrix,
    /// Identity of the compliances: a factor made with others is not used again.
    pub key: &'a StepKey,
}

/// From the residual of all active coordinates to
enum Correct {
    /// the corrections of all, and how deformations and these rates follow, for few;
    All(Panel),
    /// the corrections of those that have an equation,
    Own(Product),
    /// the corrections of all by way of the modes, which move deformations and rates as well, for many.
    Modal(ModalJacobian),
}

/// From residuals to Newton corrections.
pub(super) struct Factor {
    key: StepKey,
    pub tangents: Tangents,
    /// Active coordinates with a row of tangents that counts.
    equations: Vec<usize>,
    correct: Correct,
    /// True where all of that is finite: no equations are singular.
    sound: bool,
}

/// The kept factors, the one used last at the end.
#[derive(Default)]
pub(super) struct Factors(Vec<Factor>);

impl Factors {
    /// For a checkpoint.
    pub fn memory(&self) -> Vec<Remembered> {
        let one = |f: &Factor| Remembered {
            key: f.key.clone(),
            k: f.tangents.k.clone(),
            c: f.tangents.c.clone(),
        };
        self.0.iter().map(one).collect()
    }

    /// True where there is one for a rule.
    #[inline]
    pub fn have(&self, key: &StepKey) -> bool {
        self.0.iter().rev().any(|f| f.key == *key)
    }

    /// Forgets the factor of a rule.
    pub fn forget(&mut self, key: &StepKey) {
        self.0.retain(|f| f.key != *key);
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
    #[inline]
    pub fn take(
        &mut self,
        of: Equations<'_>,
        tangents: &Tangents,
        good: impl FnOnce(&Factor) -> bool,
    ) -> &Factor {
        // Mostly the one used last.
        let at = self.0.iter().rposition(|f| f.key == *of.key);
        match at.filter(|at| good(&self.0[*at])) {
            Some(at) => {
                let last = self.0.len() - 1;
                if at < last {
                    self.0[at..].rotate_left(1);
                }
                &self.0[last]
            }
            None => self.make(of, tangents.clone()),
        }
    }
}

impl Factor {
    fn new(of: Equations<'_>, tangents: Tangents) -> Self {
        let Equations { layout, g, h, key } = of;
        let key = key.clone();
        let (g, h) = match (g, h) {
            (ComplianceMatrix::Modal(g), ComplianceMatrix::Modal(h)) => {
                let jacobian = ModalJacobian::new(layout, &tangents, [g, h], HOLD);
                let (sound, correct) = (jacobian.is_sound(), Correct::Modal(jacobian));
                return Self { key, tangents, equations: Vec::new(), correct, sound };
            }
            _ => (&*g.all(), &*h.all()),
        };
        let n = layout.links.active.len();
        let row = |a: usize| layout.tangents_of(a, &tangents);
        // Where a link is weak against the structure, f̃ ← law − k_e d converges as well as Newton's method.
        let weak = if n < WEAK_FROM { 0.0 } else { WEAK };
        let sum = |m: &Dense, b: usize| m.column(b).iter().map(|x| x.abs()).sum::<f64>();
        let strong = |a: &usize| {
            let terms = row(*a).map(|(b, k, c)| k.abs() * sum(g, b) + c.abs() * sum(h, b));
            terms.sum::<f64>() > weak
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
            for (b, k, c) in row(*a) {
                for (x, (g, h)) in line.iter_mut().zip(g.column(b).iter().zip(h.column(b))) {
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
        if equations.len() <= ELIMINATED {
            solve_few(&mut j, &mut correct);
        } else {
            DenseLu::new(&j).solve_columns(&mut correct);
        }
        let sound = correct.values().iter().all(|x| x.is_finite());
        let correct = if n <= FEW {
            Correct::All(with_what_follows(&equations, &correct, &layout.rate_dependent, [g, h]))
        } else {
            Correct::Own(Product::new(correct))
        };
        Self { key, tangents, equations, correct, sound }
    }

    /// False where the equations are singular.
    pub fn is_sound(&self) -> bool {
        self.sound
    }

    /// Moves a row of [`Unknowns`] by the correction of these residuals, and what follows from
    /// it; false where they are too many for that: then the residuals become the correction, and f̃ alone has moved.
    #[inline]
    pub fn go(&self, residual: &mut [f64], space: &mut Vec<f64>, unknowns: &mut Unknowns) -> bool {
        if let Correct::All(all) = &self.correct {
            all.add_times(residual, unknowns.row());
            return true;
        }
        let followed = self.correct(residual, space);
        if followed {
            unknowns.add(space);
        } else {
            add(unknowns.parts()[2], residual);
        }
        followed
    }

    /// Replaces the residuals of the active coordinates by the corrections; those without an equation stay.
    /// True where the residuals stay and the corrections stand in `space`, with the changes of deformations and of
    /// these rates, as in a row of [`Unknowns`].
    pub fn correct(&self, residual: &mut [f64], space: &mut Vec<f64>) -> bool {
        let own = match &self.correct {
            Correct::Own(own) => own,
            Correct::Modal(modal) => {
                modal.correct(residual, space);
                return true;
            }
            Correct::All(all) => {
                space.clear();
                space.resize(all.filled(), 0.0);
                all.add_times(residual, space);
                return true;
            }
        };
        space.resize(self.equations.len(), 0.0);
        own.times(residual, space);
        for (a, value) in self.equations.iter().zip(space) {
            residual[*a] = *value;
        }
        false
    }
}

/// −G C, the rows of −H C that laws depend on, and C of all coordinates, as they lie in a row of [`Unknowns`].
fn with_what_follows(
    equations: &[usize],
    correct: &Dense,
    rate_dependent: &[usize],
    [g, h]: [&Dense; 2],
) -> Panel {
    let n = correct.columns();
    let pseudo = Unknowns::place_of_pseudo(n, rate_dependent.len());
    let mut all = Panel::zeros(pseudo + n, n);
    for j in 0..n {
        let (follows, own) = all.column_mut(j).split_at_mut(pseudo);
        own[j] = 1.0;
        for (a, x) in equations.iter().zip(correct.column(j)) {
            own[*a] = *x;
        }
        let (d, v) = follows.split_at_mut(n);
        g.mul_add(-1.0, own, d);
        // The compliances are symmetric.
        v.iter_mut().zip(rate_dependent).for_each(|(v, a)| *v = -h.column_dot(*a, own));
    }
    all
}
