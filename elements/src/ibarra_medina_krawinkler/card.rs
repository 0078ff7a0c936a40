//! The card of the spring, and what it cannot say.

use super::{IbarraMedinaKrawinkler, Reloading};
use trilith_element::{Card, Category, Described, Exercise, NodeCount, ParameterError, Stroke};

impl Described for IbarraMedinaKrawinkler {
    const CARD: Card = Card::new(
        "IbarraMedinaKrawinkler",
        Category::Link,
        "Spring of a capped backbone whose strength and stiffness deteriorate with the energy dissipated; peak-oriented or pinching.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("backbone: k to f_y, on to c f_y at f_y/k + δ_p, down by c f_y over δ_pc, r f_y at least\n\
          back: with K to zero force;  on: straight to the largest deformation u so far (PeakOriented), or first\n\
          with κ_F times that slope to (1 − κ_D)(u − f_u/K) (Pinching); then the backbone\n\
          at zero force, for the side entered: f_y, hardening: × (1 − β_S D), intercept of softening: × (1 − β_C D), u: × (1 + β_A D)\n\
          at any time: K = K₀ (1 − β_K);  βⱼ = (Eᵢ/(Λⱼ f_y − E))^cⱼ, Eᵢ in this excursion, E in all")
    .source("Ibarra, Medina & Krawinkler 2005; Mahin & Bertero 1975; OpenSees IMKPeakOriented and IMKPinching")
    .example(r#""hinge": IbarraMedinaKrawinkler(nodes: ("a", "b"), axis: R3, k: "60 MN*m/rad", fy: "300 kN*m", capping: 1.1, plastic: 0.02, post_capping: 0.1, residual: 0.2, lambda_s: 1, lambda_c: 1, lambda_a: 1, lambda_k: 2)"#)
    .exercise(Exercise::new(0.5, &[Stroke::about(0.0, 0.05)]));

    fn check(&self) -> Result<(), ParameterError> {
        let wrong = |name: &str, message: String| Err(ParameterError::inconsistent(name, message));
        for positive in [true, false] {
            let slope = self.side(positive).hardening;
            if slope > 0.9 * self.k {
                let name = if positive { "capping" } else { "capping_negative" };
                return wrong(
                    name,
                    format!(
                        "hardening with {:.3} of `k`: must be at most 0.9; a smaller `{name}` or a longer `plastic`",
                        slope / self.k
                    ),
                );
            }
        }
        match (self.form, self.kappa_f, self.kappa_d) {
            (Reloading::Pinching, None, _) => {
                wrong("kappa_f", "`form: Pinching` needs `kappa_f` and `kappa_d`".into())
            }
            (Reloading::Pinching, _, None) => {
                wrong("kappa_d", "`form: Pinching` needs `kappa_f` and `kappa_d`".into())
            }
            (Reloading::PeakOriented, Some(_), _) => {
                wrong("kappa_f", "`kappa_f` belongs to `form: Pinching`".into())
            }
            (Reloading::PeakOriented, _, Some(_)) => {
                wrong("kappa_d", "`kappa_d` belongs to `form: Pinching`".into())
            }
            _ => Ok(()),
        }
    }
}
