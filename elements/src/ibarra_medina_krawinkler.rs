//! IbarraMedinaKrawinkler: spring of a backbone with capping, whose strength and stiffness deteriorate with the energy it has
//! dissipated; peak-oriented or pinching.
//!
//! ```text
//!  f │      ● capping: f_c = c f_y          first loading: k, then towards the capping point,
//!    │   ●‾‾ \                              down by f_c over δ_pc, then r f_y
//!    │  /f_y  \                             u_c = f_y/k + δ_p
//!    │ /       ●_____ r f_y
//!    └──────────────── d
//!
//!  back:  down with the stiffness of unloading K, to zero force at z
//!  on:    straight to the largest deformation so far on that side (PeakOriented), or first to the break point
//!         x = (1 − κ_D)(u − f_u/K) with κ_F times the slope of that line (Pinching); through the last peak on
//!         that side where the path would else lie below it; then along the backbone
//! ```
//!
//! Each time the force crosses zero an excursion i ends. With the energy Eᵢ dissipated in it and E by then in all, four
//! things deteriorate by βⱼ = (Eᵢ/(Λⱼ f_y − E))^cⱼ, at most 1:
//!
//! | j | what                                                    | becomes              | where                |
//! |---|---------------------------------------------------------|----------------------|----------------------|
//! | S | yield strength and slope of hardening                   | (1 − β D) as large   | side that is entered |
//! | C | force where the line behind the capping point meets d = 0 | (1 − β D) as large | side that is entered |
//! | A | deformation that reloading aims at                      | (1 + β D) as large   | side that is entered |
//! | K | stiffness of unloading                                  | (1 − β) as large     | both, at any time    |
//!
//! The force is a function of the deformation alone between two crossings of zero: f = min(K (d − p), way(d)), and a step is
//! exact however long, one crossing included. No line is steeper than K, which does not fall below k/100, nor below the slope of
//! a line while it is followed.
//!
//! **Energy.** Stored is what unloading gives back, f²/2K; the rest of the work is hysteretic and is what E counts. As
//! K falls with the energy the elastic part grows at the same force, so K and E are found together, E + f²/2K(E) = work: E never falls. With
//! all capacities infinite it is the peak-oriented model with a capped backbone.
//!
//! OpenSees' `IMKPeakOriented` and `IMKPinching` have the same backbone and rules. They let K fall at reversals, and count energies
//! by the trapezoids of their steps, across corners too.
//!
//! Reference: \[Ibarra, Medina & Krawinkler 2005\]; the way through the last peak is that of \[Mahin & Bertero 1975\]; the line to the
//! break point and the share D are those of OpenSees. Deformations of failure are not part of it.

mod backbone;
mod card;
mod law;
#[cfg(test)]
mod tests;
mod way;

use law::{HISTORY, Law};
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::lanes::{LaneAt, LaneForce, LaneForm, respond};
use trilith_element::{Axis, Choices, Coordinates, Field, Kinematics, Link, Parameters, Response};

/// How an [`IbarraMedinaKrawinkler`] reloads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum Reloading {
    /// Straight to the largest deformation so far.
    PeakOriented,
    /// First to a break point, with less stiffness.
    Pinching,
}

/// Deteriorating spring with a capped backbone.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct IbarraMedinaKrawinkler {
    /// elastic stiffness
    #[parameter("k", unit = "N/m", about = "N·m/rad", range = Positive)]
    pub k: f64,
    /// yield strength
    #[parameter("f_y", unit = "N", about = "N·m", range = Positive)]
    pub fy: f64,
    /// capping strength over `fy`
    #[parameter("c", unit = "1", range = Within(1.0, 100.0))]
    pub capping: f64,
    /// deformation from yield to capping
    #[parameter("δ_p", unit = "m", about = "rad", range = Positive)]
    pub plastic: f64,
    /// deformation from capping to zero force
    #[parameter("δ_pc", unit = "m", about = "rad", range = Positive)]
    pub post_capping: f64,
    /// residual strength over `fy`
    #[parameter("r", unit = "1", range = Within(0.0, 1.0), default = 0.0)]
    pub residual: f64,
    /// f_y for d < 0 (as for d > 0)
    #[parameter("f_y⁻", unit = "N", about = "N·m", range = Positive)]
    pub fy_negative: Option<f64>,
    /// c for d < 0, over f_y there
    #[parameter("c⁻", unit = "1", range = Within(1.0, 100.0))]
    pub capping_negative: Option<f64>,
    /// δ_p for d < 0
    #[parameter("δ_p⁻", unit = "m", about = "rad", range = Positive)]
    pub plastic_negative: Option<f64>,
    /// δ_pc for d < 0
    #[parameter("δ_pc⁻", unit = "m", about = "rad", range = Positive)]
    pub post_capping_negative: Option<f64>,
    /// r for d < 0
    #[parameter("r⁻", unit = "1", range = Within(0.0, 1.0))]
    pub residual_negative: Option<f64>,
    /// energy over `fy` that basic strength stands; none: ∞
    #[parameter("Λ_S", unit = "m", about = "rad", range = Positive)]
    pub lambda_s: Option<f64>,
    /// the same of post-capping strength
    #[parameter("Λ_C", unit = "m", about = "rad", range = Positive)]
    pub lambda_c: Option<f64>,
    /// the same of accelerated reloading
    #[parameter("Λ_A", unit = "m", about = "rad", range = Positive)]
    pub lambda_a: Option<f64>,
    /// the same of the stiffness of unloading
    #[parameter("Λ_K", unit = "m", about = "rad", range = Positive)]
    pub lambda_k: Option<f64>,
    /// exponent of basic strength
    #[parameter("c_S", unit = "1", range = Within(1.0, 2.0), default = 1.0)]
    pub c_s: f64,
    /// exponent of post-capping strength
    #[parameter("c_C", unit = "1", range = Within(1.0, 2.0), default = 1.0)]
    pub c_c: f64,
    /// exponent of accelerated reloading
    #[parameter("c_A", unit = "1", range = Within(1.0, 2.0), default = 1.0)]
    pub c_a: f64,
    /// exponent of the stiffness of unloading
    #[parameter("c_K", unit = "1", range = Within(1.0, 2.0), default = 1.0)]
    pub c_k: f64,
    /// share of β that acts for d > 0
    #[parameter("D⁺", unit = "1", range = Within(0.0, 1.0), default = 1.0)]
    pub rate_positive: f64,
    /// share of β that acts for d < 0
    #[parameter("D⁻", unit = "1", range = Within(0.0, 1.0), default = 1.0)]
    pub rate_negative: f64,
    /// reloading
    #[parameter(choices = Reloading::NAMES, default = "PeakOriented")]
    pub form: Reloading,
    /// Pinching: slope to the break point over that to the target
    #[parameter("κ_F", unit = "1", range = Within(0.0, 1.0))]
    pub kappa_f: Option<f64>,
    /// Pinching: share of the permanent deformation left at the break point
    #[parameter("κ_D", unit = "1", range = Within(0.0, 1.0))]
    pub kappa_d: Option<f64>,
    /// local axis
    #[parameter(choices = Axis::NAMES, default = "U1")]
    pub axis: Axis,
}

/// The backbone of a side as given.
#[derive(Clone, Copy)]
struct Side {
    fy: f64,
    /// Slope of hardening.
    hardening: f64,
    /// Slope behind the capping point, falling.
    softening: f64,
    residual: f64,
    /// Force where the line behind the capping point meets d = 0.
    intercept: f64,
}

impl IbarraMedinaKrawinkler {
    fn side(&self, positive: bool) -> Side {
        let own = |x: f64, negative: Option<f64>| negative.filter(|_| !positive).unwrap_or(x);
        let fy = own(self.fy, self.fy_negative);
        let capping = own(self.capping, self.capping_negative) * fy;
        let plastic = own(self.plastic, self.plastic_negative);
        let softening = capping / own(self.post_capping, self.post_capping_negative);
        Side {
            fy,
            hardening: (capping - fy) / plastic,
            softening,
            residual: own(self.residual, self.residual_negative) * fy,
            intercept: capping + softening * (fy / self.k + plastic),
        }
    }

    fn numbers(&self) -> [f64; law::PARAMETERS] {
        let [up, down] = [true, false].map(|positive| self.side(positive));
        let floor = (0.01 * self.k).max(1.01 * up.hardening.max(down.hardening));
        let capacity = |lambda: Option<f64>| lambda.map_or(f64::INFINITY, |l| l * self.fy);
        let pinching = self.form == Reloading::Pinching;
        let of = |s: Side| [s.fy, s.hardening, s.softening, s.residual, s.intercept];
        let ([a, b, c, d, e], [f, g, h, i, j]) = (of(up), of(down));
        [
            self.k,
            floor,
            a,
            b,
            c,
            d,
            e,
            f,
            g,
            h,
            i,
            j,
            capacity(self.lambda_s),
            capacity(self.lambda_c),
            capacity(self.lambda_a),
            capacity(self.lambda_k),
            self.c_s,
            self.c_c,
            self.c_a,
            self.c_k,
            self.rate_positive,
            self.rate_negative,
            f64::from(u8::from(pinching)),
            self.kappa_f.unwrap_or(1.0),
            self.kappa_d.unwrap_or(1.0),
        ]
    }
}

impl Link for IbarraMedinaKrawinkler {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        law::fields(self.axis.index() > 2).into()
    }

    fn at_rest(&self, at: &mut [f64]) {
        law::at_rest(&self.numbers(), at);
    }

    fn uses_rates(&self) -> bool {
        false
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let numbers = self.numbers();
        let asked = LaneAt::new(at, committed, &numbers);
        let mut force = LaneForce { f: out.f, k: out.k, c: out.c };
        *out.energy = respond::<Law>(&asked, &mut force, &mut trial[..HISTORY]).into();
    }

    fn lanes(&self, _: &[bool]) -> Option<LaneForm> {
        Some(LaneForm::of::<Law>(vec![0], self.numbers().to_vec()).without_rate())
    }
}
