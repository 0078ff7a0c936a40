//! What laws of sliding contacts share: the force that presses, the friction coefficient, stick and
//! slip, the surface that is slid on, and the bearing made of them.

mod axial;
mod bearing;
mod coefficient;
mod incline;
mod law;
mod rub;
mod slip;
mod stick;
mod surface;

pub(crate) use axial::{Axial, Normal};
pub use bearing::SlidingHistory;
pub(crate) use bearing::{Bearing, Side, engaged};
pub(crate) use coefficient::{BreakAway, Coefficient, Limit};
pub(crate) use rub::{Rubbed, Rubbing, Worn};
pub(crate) use slip::{Cone, Slide, Trial};
pub(crate) use stick::{radial_return, share_before};
pub(crate) use surface::{Dish, Stop};
