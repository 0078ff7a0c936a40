//! Links: local nonlinear laws.

use crate::lanes::LaneForm;
use crate::{Axis, Field, Geometry, Outline, ParameterError};
use std::borrow::Cow;
use std::fmt::Debug;

/// Which coordinates a law works on; their order is the order of every array it sees.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Coordinates {
    /// Deformations along these local axes: node j minus node i, or the node minus the ground.
    Local(Vec<Axis>),
    /// The six global displacements of each of its nodes, one node after the other. The law does its
    /// own kinematics.
    Nodal {
        /// Number of nodes.
        nodes: usize,
    },
}

impl Coordinates {
    /// Number of coordinates `n`.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Local(axes) => axes.len(),
            Self::Nodal { nodes } => 6 * nodes,
        }
    }

    /// True for a law without coordinates, which the system refuses.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The deformation that a law is asked about. All slices have `n` entries.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Kinematics<'a> {
    /// Deformation d at the end of the step, in m or rad.
    pub d: &'a [f64],
    /// Rate ḋ at the end of the step; NaN for a law that does not [use rates](Link::uses_rates).
    pub v: &'a [f64],
    /// Deformation at the start of the step (where the history was committed).
    pub d0: &'a [f64],
    /// Rate at the start of the step.
    pub v0: &'a [f64],
    /// Step in s; 0 in a static analysis and where the law is only looked at. What time it is a law counts in its
    /// history.
    pub dt: f64,
}

impl<'a> Kinematics<'a> {
    /// A step of a length (s) from a deformation and its rate to others: `[d, v]` at its end and at its start.
    #[must_use]
    pub const fn new([d, v]: [&'a [f64]; 2], [d0, v0]: [&'a [f64]; 2], dt: f64) -> Self {
        Self { d, v, d0, v0, dt }
    }

    /// No step at all, only a look at a deformation and its rate.
    #[must_use]
    pub const fn still(d: &'a [f64], v: &'a [f64]) -> Self {
        Self::new([d, v], [d, v], 0.0)
    }

    /// Work over the step of a rate-dependent force on coordinate `i` that goes from `start` to `end`
    /// (N), exact where force and rate are both linear in the step:
    /// Δt (2 g₀v₀ + g₀v₁ + g₁v₀ + 2 g₁v₁)/6. Never negative.
    #[must_use]
    pub fn viscous_work(&self, i: usize, start: f64, end: f64) -> f64 {
        let (v0, v1) = (self.v0[i], self.v[i]);
        let sum = start * (2.0 * v0 + v1) + end * (v0 + 2.0 * v1);
        let work = self.dt * sum / 6.0;
        // What is not a number stays so.
        if work > 0.0 || work.is_nan() { work } else { 0.0 }
    }
}

/// Energy of a link, in J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Energy {
    /// Recoverable energy at the end of the step (a total).
    pub stored: f64,
    /// Energy turned into heat by friction or yielding during the step (an increment). Never negative,
    /// but for an active law, which enters here what it gives without regard to rates (the circulatory
    /// work of an unsymmetric stiffness).
    pub hysteretic: f64,
    /// Energy turned into heat by rate-dependent forces during the step (an increment). Negative only
    /// where an active law gives energy by its rates.
    pub viscous: f64,
}

impl Energy {
    /// What is stored at the end of a step, and what was turned into heat in it without and by regard to rates, J.
    #[must_use]
    pub const fn new(stored: f64, hysteretic: f64, viscous: f64) -> Self {
        Self { stored, hysteretic, viscous }
    }
}

/// What a law answers. The caller owns the slices and zeroes them before the call.
#[derive(Debug)]
#[non_exhaustive]
pub struct Response<'a> {
    /// Force f conjugate to d, in N or N·m; `n` entries. Positive where it resists positive d.
    pub f: &'a mut [f64],
    /// Tangent ∂f/∂d, row by row, `n²` entries. Unsymmetric where the physics is.
    pub k: &'a mut [f64],
    /// Tangent ∂f/∂ḋ, row by row, `n²` entries.
    pub c: &'a mut [f64],
    /// Energies.
    pub energy: &'a mut Energy,
}

impl<'a> Response<'a> {
    /// Room for an answer: force, tangents by deformation and by rate, energies.
    #[must_use]
    pub fn new(
        f: &'a mut [f64],
        k: &'a mut [f64],
        c: &'a mut [f64],
        energy: &'a mut Energy,
    ) -> Self {
        Self { f, k, c, energy }
    }
}

/// What a contact does at this moment; for the response mode and for reports.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Contact {
    /// Distance between the surfaces in m; negative while pressed together.
    pub gap: f64,
    /// Normal force in N, ≥ 0.
    pub normal: f64,
    /// Tangential position of the contact in m, along U2 and U3.
    pub position: [f64; 2],
    /// True while the friction force is at its limit and slipping goes on.
    pub slipping: bool,
}

impl Contact {
    /// A contact of a gap (m) and a normal force (N), at the middle of the link, not slipping.
    #[must_use]
    pub const fn new(gap: f64, normal: f64) -> Self {
        Self { gap, normal, position: [0.0; 2], slipping: false }
    }

    /// At another place along U2 and U3, m.
    #[must_use]
    pub const fn at(mut self, position: [f64; 2]) -> Self {
        self.position = position;
        self
    }

    /// Slipping, or not.
    #[must_use]
    pub const fn slipping(mut self, slipping: bool) -> Self {
        self.slipping = slipping;
        self
    }
}

/// What a law with contacts is made for: where it stands in a model decides the rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactUse {
    /// To be stood on: it presses, and friction holds what stands there.
    #[default]
    Standing,
    /// To stop what comes near: it presses and does nothing else.
    Stop,
    /// To carry a structure and let it travel, as a friction pendulum does.
    Bearing,
}

/// What a contact says about impacts on it, so that its dashpot can be set from a coefficient of
/// restitution once the mass is known that it stops.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Impact {
    /// The coordinate that closes, as index into those of the law.
    pub coordinate: usize,
    /// Contact stiffness, N/m.
    pub stiffness: f64,
    /// Contact dashpot, N·s/m; 0 while it waits for a mass.
    pub damping: f64,
    /// The coefficient of restitution that is wanted instead of a dashpot.
    pub restitution: Option<f64>,
    /// The mass given for it, kg; none: the core works it out.
    pub mass: Option<f64>,
}

impl Impact {
    /// On a coordinate of a law, with a contact stiffness (N/m) and a dashpot (N·s/m).
    #[must_use]
    pub const fn new(coordinate: usize, stiffness: f64, damping: f64) -> Self {
        Self { coordinate, stiffness, damping, restitution: None, mass: None }
    }

    /// With a coefficient of restitution that is wanted, and the mass (kg) for it where that is given.
    #[must_use]
    pub const fn restituting(mut self, restitution: Option<f64>, mass: Option<f64>) -> Self {
        (self.restitution, self.mass) = (restitution, mass);
        self
    }
}

/// What a law unwinds with (`std::panic::resume_unwind`) where something has gone wrong that it can tell: for laws that are
/// called in another language. The run ends with these words, as it does with those of a panic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LawFailed(pub String);

/// A local nonlinear law.
///
/// # Contract
/// - [`respond`](Self::respond) is pure: equal inputs give equal outputs, bit for bit.
/// - Memory is in the history and nowhere else; the core owns it, commits it and reverts it. A law that looks at the clock
///   counts the time there, by the `dt` of its steps.
/// - `k` and `c` of the response are the derivatives of `f` for fixed `d0`, `v0`, `dt` and history.
/// - `respond` writes every history variable of the trial.
/// - With `d = d0`, `v = v0`, `dt = 0` it gives the force that acts right after the start of the step.
/// - Over a step, work = change of `stored` + `hysteretic` + `viscous`, up to the error of the step.
/// - Every answer to a question in finite numbers is finite.
///
/// A run watches this: one that meets an answer that is no finite number, energies that do not close however short the
/// steps, other answers to the same question, or a panic ends with the name of the link, what is wrong, and when.
pub trait Link: Send + Sync + Debug {
    /// Takes note of where its nodes are; asked once, before all else, of every law of a model. Laws that do their own
    /// kinematics between nodes need it.
    ///
    /// # Errors
    /// Where it cannot be in such a place.
    fn place(&mut self, _at: &Geometry<'_>) -> Result<(), ParameterError> {
        Ok(())
    }

    /// The coordinates it works on; constant.
    fn coordinates(&self) -> Coordinates;

    /// Which of its nodes is a body in finite rotation that this law moves: its rotations are integrals of the angular
    /// velocity in the axes of the body, and nothing else may take them for small ones.
    fn turning_node(&self) -> Option<usize> {
        None
    }

    /// The history variables; constant. Length `h` of the history slices.
    fn history(&self) -> Cow<'static, [Field]> {
        Cow::Borrowed(&[])
    }

    /// History before anything has happened; `at` holds `h` zeros on entry.
    fn at_rest(&self, _at: &mut [f64]) {}

    /// The stiffness of the law where it is engaged (closed, sticking, elastic), as a positive
    /// semi-definite matrix, row by row, `n²` entries, zero on entry. The core makes its small
    /// linear dummies from it; it never enters a force.
    fn engaged_stiffness(&self, k: &mut [f64]);

    /// Force, tangents, trial history and energies for a deformation.
    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    );

    /// Why the law has no answer there, in words of its own, such as `torn at 12 mm`: for laws that come to a state beyond
    /// which they hold no more. Such a law answers with a force of NaN there; only then is this asked, with the same
    /// question. As iterations may ask about states that the motion never comes to, shorter steps are tried first; where
    /// none helps, the run ends with these words, the name of the link and the time.
    fn refusal(&self, _at: &Kinematics<'_>, _committed: &[f64]) -> Option<String> {
        None
    }

    /// False for a law whose answer does not look at the rates `v` and `v0`: the solvers then need not find
    /// them in every iteration, and give it NaN for them.
    fn uses_rates(&self) -> bool {
        true
    }

    /// False for a law that no rate alone can hold, though it looks at rates: they only tell loading from unloading
    /// where it stands still, or a spring lies before all that is viscous. A node without mass or damping then follows
    /// it at once. Where it is true for no need, the rates of such nodes may ring under direct integration.
    fn damps(&self) -> bool {
        self.uses_rates()
    }

    /// Adds what its contacts do, for laws that are contacts; always the same number, in the same order.
    /// `history` is the trial of `respond`, `f` its force.
    fn contacts(
        &self,
        _at: &Kinematics<'_>,
        _history: &[f64],
        _f: &[f64],
        _out: &mut Vec<Contact>,
    ) {
    }

    /// What its contacts are made for. Only asked of laws that have contacts.
    fn contact_use(&self) -> ContactUse {
        ContactUse::Standing
    }

    /// True once a body has fallen over for good; the run ends there. Only asked of laws that have
    /// contacts. `history` as for [`contacts`](Self::contacts).
    fn overturned(&self, _at: &Kinematics<'_>, _history: &[f64]) -> bool {
        false
    }

    /// What its body looks like in a picture, for laws that have one: where its points are now, in global
    /// axes from the place that its first node has without displacement. The number of points and the
    /// paths never change. `history` as for [`contacts`](Self::contacts).
    fn outline(&self, _at: &Kinematics<'_>, _history: &[f64]) -> Option<Outline> {
        None
    }

    /// What it does in an impact, for contacts with a dashpot that a restitution can set.
    fn impact(&self) -> Option<Impact> {
        None
    }

    /// The same contact with the dashpot that gives a coefficient of restitution (0 < e ≤ 1) to a
    /// mass (kg) that strikes it alone. The core runs this law where [`impact`](Self::impact) wants a
    /// restitution.
    fn restituting(&self, _restitution: f64, _mass: f64) -> Option<Box<dyn Link>> {
        None
    }

    /// The constant c of a law of one coordinate that is `f = c ḋ` at all times, N·s/m or N·m·s: the solvers then
    /// need not ask it in every iteration.
    fn damping_constant(&self) -> Option<f64> {
        None
    }

    /// False for a law that does not know what it stores and turns to heat: it enters the work that is done on it as heat,
    /// so that energies close whatever it does. A run with such a link says that its ledger proves nothing of it.
    fn accounts(&self) -> bool {
        true
    }

    /// The law in the form in which sweeps run many analyses side by side, and a run asks links of one law at
    /// once where there are several; for links that have one. It answers as [`respond`](Self::respond) does, up to
    /// rounding. `active` says which of its coordinates the structure can deform; the others stay zero.
    fn lanes(&self, _active: &[bool]) -> Option<LaneForm> {
        None
    }
}
