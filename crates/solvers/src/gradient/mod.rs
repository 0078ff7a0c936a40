//! Exact derivatives of outputs by parameters of a model: direct differentiation, forward through the march.
//!
//! The run is made as always. Behind every accepted substep its equations are differentiated by every parameter θ, with the
//! steps as they were: what comes out is the derivative of the numbers that the run has computed, not an approximation of it.
//! With δ for ∂/∂θ of all that follows from θ, and ∂ for what stands in the model itself,
//!
//! ```text
//! M a₁ = (1+α) s₁ − α s₀             s = p − C v − K u − Bᵀ f             f₁, h₁ = law(d₁, ḋ₁, d₀, ḋ₀, Δt, h₀; θ)
//! M δa₁ = (1+α) δs₁ − α δs₀ − ∂M a₁  δs = ∂p − ∂C v − ∂K u − ∂Bᵀ f − C δv − K δu − Bᵀ δf
//!
//! δf₁ = k δd₁ + c δḋ₁ + g            k, c: tangents of the law where the step ended;   d = B u, δd = B δu + ∂B u
//! g   = f by (d₀, ḋ₀, h₀, θ) along (δd₀, δḋ₀, δh₀, 1), at d₁ and ḋ₁
//! δh₁ = h by all of them along all of them
//! ```
//!
//! The step of δ is the step of the run with other loads, the pseudo-loads ∂p − ∂C v − ∂K u − ∂Bᵀ f − ∂M a: it is made by the same
//! propagator with the factor that is there, one solve per parameter, and with the same compliance:
//!
//! ```text
//! (I + (k − k_e) G + c H) x = (k − k_e) d* + c v* + g − δf̃₀        δf̃₁ = δf̃₀ + x,  f̃ = f − k_e B u
//! ```
//!
//! `laws` finds g and δh₁: in dual numbers where a law has a form over lanes, exact to rounding, and by differences of the law
//! alone where it has none. `around` finds ∂M, ∂C, ∂K, ∂B, ∂p and the derivative of the start from the model at four values around θ: where they are
//! polynomials of θ up to the fourth degree, that is exact to rounding as well.
//!
//! Reduced solvers go the same way in the span of the vectors of the run. Parameters of the structure move its modes in it: see `moving`.
//!
//! Where a law is bent at a value that it takes at the end of a substep, there is no derivative, but one to each side. What is told then
//! is that of the branch that the run took, and [`Gradient::bends`] names the links. May use `run` and all rooms above it.
//!
//! Reference: direct differentiation of path-dependent response \[Kleiber et al. 1997, ch. 7; Conte, Vijalapura & Meghella 2003\].

mod around;
mod bends;
mod course;
mod influence;
mod input;
mod laws;
mod moving;
mod outputs;
mod replay;
mod sides;
mod step;
mod structure;

pub use around::{Around, OFFSETS, SMALL, Varied};
pub use bends::Bend;
pub use course::{GradientOptions, gradient, gradient_until};
pub use outputs::{Extreme, Gradient, HeatGradient, OutputGradient};
pub use replay::{Replay, replay};
