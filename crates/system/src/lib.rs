//! From a model to equations: M ü + C u̇ + K u + Bᵀ f(B u, B u̇) = p(t) on the free DOFs.
//!
//! [`System`] is passive data: matrices, link maps and names. It knows no solver.

mod assemble;
mod batch;
mod blame;
mod blocks;
mod dampers;
mod elastic;
mod error;
mod falling;
mod finite_turns;
mod impact;
mod inner;
mod leaning;
mod link_rows;
mod links;
mod loads;
mod massless;
mod members;
mod parts;
mod reduction;
mod subset;
mod sums;
mod weight;

pub use assemble::System;
pub use blame::{Panicked, blaming, catch};
pub use blocks::LinkBlocks;
pub use elastic::{EndForceRow, ReactionRow};
pub use error::SystemError;
pub use finite_turns::{SmallTurn, small_turns};
pub use impact::ImpactMass;
pub use inner::InnerRows;
pub use links::{Answers, Laws, LinkInstance, LinkSet, StepLaws, Tangents};
pub use loads::{Channel, LoadSet, StepLoads, Track};
pub use massless::Massless;
pub use members::MemberRow;
pub use reduction::Reduction;
pub use subset::Subset;
pub use sums::Sums;
pub use weight::{MassSum, RIGID};
