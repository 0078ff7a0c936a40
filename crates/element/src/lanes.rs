//! Laws for many analyses, or many links of one analysis, side by side.
//!
//! A sweep runs one small model with many values of its parameters. Analyses that go in lock step share
//! instructions: a register holds one number of each of them, its *lanes*. A law takes part by being
//! written over [`Real`], a number that is one `f64` or several lanes of them: no `if` on values but
//! [`Real::select`], no memory, no allocation. The same text then serves [`Link::respond`](crate::Link)
//! with `f64`, and [`LaneForm`] hands it to the sweep. Where a model has four or more links of one such law, an
//! ordinary run asks them together as well.
//!
//! ```
//! use trilith_element::lanes::{LaneAt, LaneForce, LaneForm, LaneLaw, LaneStep, Real};
//!
//! /// f = k (d + g) where d + g < 0; parameters k, g.
//! struct Stop;
//!
//! impl LaneLaw for Stop {
//!     const COORDINATES: usize = 1;
//!     const HISTORY: usize = 0;
//!     const PARAMETERS: usize = 2;
//!
//!     fn respond<R: Real>(
//!         at: &LaneAt<'_, R>,
//!         out: &mut LaneForce<'_, R>,
//!         _: &mut [R],
//!     ) -> LaneStep<R> {
//!         let (k, stretch) = (at.parameters[0], at.d[0] + at.parameters[1]);
//!         let (zero, closed) = (k.of(0.0), stretch.lt(k.of(0.0)));
//!         out.f[0] = R::select(closed, k * stretch, zero);
//!         out.k[0] = R::select(closed, k, zero);
//!         out.c[0] = zero;
//!         LaneStep::elastic(k.of(0.5) * out.f[0] * out.f[0] / k)
//!     }
//! }
//! let form = LaneForm::of::<Stop>(vec![0], vec![2e8, 0.05]);
//! assert_eq!(form.law.coordinates, 1);
//! ```
//!
//! Functions of a law must be `#[inline(always)]` for the wide instructions to reach them.
//!
//! The same text gives the derivatives of the law by whatever moves it, exact to rounding: see [`Dual`] and
//! [`ErasedLaw::derivative`].

mod arithmetic;
mod dual;
mod each;
#[cfg(target_arch = "x86_64")]
mod functions;
mod law;
mod listed;
mod real;
#[cfg(target_arch = "x86_64")]
mod registers;
#[cfg(target_arch = "x86_64")]
mod side_by_side;
#[cfg(target_arch = "x86_64")]
mod wide;

pub use arithmetic::{Arithmetic, Portable, Task};
#[cfg(target_arch = "x86_64")]
pub use arithmetic::{Avx2Lanes, Avx512Lanes, FusedOne};
pub use dual::Dual;
pub use law::{
    DIRECTIONS, Directions, ErasedLaw, LaneAt, LaneContact, LaneForce, LaneForm, LaneLaw,
    LaneLinks, LaneStep, respond,
};
pub use real::Real;
#[cfg(target_arch = "x86_64")]
pub use wide::{Fused, Wide, WideMask};
