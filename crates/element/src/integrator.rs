//! Rules for time from other crates: how the linear structure goes over one step.
//!
//! Links, their iteration, step control, energies, errors of outputs and checkpoints are the march's; a rule only says
//!
//! ```text
//! M ü + C u̇ + K u = p(t)        (u, u̇, ü) at the start, p at both ends  →  (u, u̇, ü) at the end
//! ```
//!
//! where p holds the loads and the forces of the links, which are not known at the end: the march asks how the end
//! answers to a force there, and finds them. A step must therefore be linear in the motion and in the forces. One that
//! is not, or is no finite number, is refused by the name of its kind before the first step.

use std::fmt::Debug;

/// A rule for time, with its parameters; it makes the steps of one length.
pub trait Integrator: Debug + Send + Sync {
    /// What steps a structure by `dt` (s). What is costly, such as a factor, is made here: the march keeps the steps of
    /// the lengths that it uses.
    ///
    /// # Errors
    /// Why it cannot, in a sentence: such as that of [`LinearStructure::factorise`] where a direction has no mass.
    fn step(&self, structure: &dyn LinearStructure, dt: f64)
    -> Result<Box<dyn LinearStep>, String>;

    /// True for a rule that works on the basis of the case, where M is one and K is diagonal, instead of on all
    /// degrees of freedom.
    fn on_basis(&self) -> bool {
        false
    }
}

/// The step of one length.
pub trait LinearStep {
    /// Motion at the end, from that at the start and the forces at both ends, N or N·m. Writes every entry of `to`.
    ///
    /// A direction without mass has no acceleration of its own: what stands there is 0 at the start of a motion.
    fn advance(
        &mut self,
        structure: &dyn LinearStructure,
        from: Motion<'_>,
        force: [&[f64]; 2],
        to: MotionMut<'_>,
    );
}

/// Displacement, velocity and acceleration of every coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a> {
    /// m or rad.
    pub u: &'a [f64],
    /// m/s or rad/s.
    pub v: &'a [f64],
    /// m/s² or rad/s².
    pub a: &'a [f64],
}

/// The same, to be written.
#[derive(Debug)]
pub struct MotionMut<'a> {
    /// m or rad.
    pub u: &'a mut [f64],
    /// m/s or rad/s.
    pub v: &'a mut [f64],
    /// m/s² or rad/s².
    pub a: &'a mut [f64],
}

/// Mass, damping and stiffness of the structure, all symmetric. The stiffness holds the small linear springs that stand
/// for links without contact (effective stiffnesses), if there are any; the forces of links count without these.
pub trait LinearStructure {
    /// Number of coordinates.
    fn order(&self) -> usize;
    /// `y += s M x`.
    fn mass(&self, s: f64, x: &[f64], y: &mut [f64]);
    /// `y += s C x`, Rayleigh and modal damping included.
    fn damping(&self, s: f64, x: &[f64], y: &mut [f64]);
    /// `y += s K x`.
    fn stiffness(&self, s: f64, x: &[f64], y: &mut [f64]);
    /// The factor of `m M + c C + k K`.
    ///
    /// # Errors
    /// Where it is singular, in a sentence.
    fn factorise(&self, m: f64, c: f64, k: f64) -> Result<Box<dyn Factor>, String>;
}

/// A matrix that equations can be solved with.
pub trait Factor {
    /// Turns a right-hand side into the solution.
    fn solve(&mut self, x: &mut [f64]);
}
