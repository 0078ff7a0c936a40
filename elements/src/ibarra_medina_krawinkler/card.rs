//! The card of the spring, and what it cannot say.

use super::{IbarraMedinaKrawinkler, Reloading};
use trilith_element::dimension::NONE;
use trilith_element::{
    Axis, Card, Category, Default, Described, Exercise, Form, NodeCount, Parameter, ParameterError,
    Range, Stroke,
};

const fn of_axis(
    name: &'static str,
    symbol: &'static str,
    form: Form,
    default: Default,
    meaning: &'static str,
) -> Parameter {
    Parameter::new(name, symbol, form, default, meaning).within(Range::Positive)
}

const fn given(
    name: &'static str,
    symbol: &'static str,
    form: Form,
    meaning: &'static str,
) -> Parameter {
    of_axis(name, symbol, form, Default::Required, meaning)
}

const fn maybe(
    name: &'static str,
    symbol: &'static str,
    form: Form,
    meaning: &'static str,
) -> Parameter {
    of_axis(name, symbol, form, Default::Absent, meaning)
}

const fn exponent(name: &'static str, symbol: &'static str, meaning: &'static str) -> Parameter {
    Parameter::number(name, symbol, NONE, Range::Within(1.0, 2.0), 1.0, meaning)
}

const SHARE: Range = Range::Within(0.0, 1.0);
const CAPPED: Range = Range::Within(1.0, 100.0);
const LENGTH: Form = Form::DEFORMATION_OF_AXIS;

impl Described for IbarraMedinaKrawinkler {
    const CARD: Card = Card::new(
        "IbarraMedinaKrawinkler",
        Category::Link,
        "Spring of a capped backbone whose strength and stiffness deteriorate with the energy dissipated; peak-oriented or pinching.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(&[
        given("k", "k", Form::STIFFNESS_OF_AXIS, "elastic stiffness"),
        given("fy", "f_y", Form::FORCE_OF_AXIS, "yield strength"),
        Parameter::required("capping", "c", NONE, CAPPED, "capping strength over `fy`"),
        given("plastic", "δ_p", LENGTH, "deformation from yield to capping"),
        given("post_capping", "δ_pc", LENGTH, "deformation from capping to zero force"),
        Parameter::number("residual", "r", NONE, SHARE, 0.0, "residual strength over `fy`"),
        maybe("fy_negative", "f_y⁻", Form::FORCE_OF_AXIS, "f_y for d < 0 (as for d > 0)"),
        Parameter::optional(
            "capping_negative",
            "c⁻",
            NONE,
            CAPPED,
            "c for d < 0, over f_y there",
        ),
        maybe("plastic_negative", "δ_p⁻", LENGTH, "δ_p for d < 0"),
        maybe("post_capping_negative", "δ_pc⁻", LENGTH, "δ_pc for d < 0"),
        Parameter::optional("residual_negative", "r⁻", NONE, SHARE, "r for d < 0"),
        maybe(
            "lambda_s",
            "Λ_S",
            LENGTH,
            "energy over `fy` that basic strength stands; none: ∞",
        ),
        maybe("lambda_c", "Λ_C", LENGTH, "the same of post-capping strength"),
        maybe("lambda_a", "Λ_A", LENGTH, "the same of accelerated reloading"),
        maybe("lambda_k", "Λ_K", LENGTH, "the same of the stiffness of unloading"),
        exponent("c_s", "c_S", "exponent of basic strength"),
        exponent("c_c", "c_C", "exponent of post-capping strength"),
        exponent("c_a", "c_A", "exponent of accelerated reloading"),
        exponent("c_k", "c_K", "exponent of the stiffness of unloading"),
        Parameter::number("rate_positive", "D⁺", NONE, SHARE, 1.0, "share of β for d > 0"),
        Parameter::number("rate_negative", "D⁻", NONE, SHARE, 1.0, "share of β for d < 0"),
        Parameter::choice("form", &["PeakOriented", "Pinching"], "PeakOriented", "reloading"),
        Parameter::optional(
            "kappa_f",
            "κ_F",
            NONE,
            SHARE,
            "Pinching: slope to the break point over that to the target",
        ),
        Parameter::optional(
            "kappa_d",
            "κ_D",
            NONE,
            SHARE,
            "Pinching: share of the permanent deformation left at the break point",
        ),
        Parameter::choice("axis", Axis::NAMES, "U1", "local axis"),
    ])
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
