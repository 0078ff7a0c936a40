//! What a struct is refused for, and the table of one that is taken. What `PARAMETERS` holds is tested where the
//! parameters are: by the kinds of the catalogue.

use crate::{of_enum, of_struct};
use syn::{DeriveInput, parse_quote};

fn refusal(input: &DeriveInput) -> String {
    of_struct(input).unwrap_err().to_string()
}

fn field(said: &syn::Attribute, ty: &syn::Type) -> DeriveInput {
    parse_quote! {
        struct Law {
            /// a parameter
            #said
            p: #ty,
        }
    }
}

#[test]
fn every_field_says_what_it_is() {
    let input = parse_quote! { struct Law { k: f64 } };
    assert!(refusal(&input).contains("say `#[parameter(…)]`"));
    let input = parse_quote! { struct Law { #[parameter(unit = "N")] k: f64 } };
    assert!(refusal(&input).contains("document the field"));
    let input = parse_quote! { struct Law(f64); };
    assert!(refusal(&input).contains("named fields"));
}

#[test]
fn what_nobody_can_have_meant_is_refused() {
    let cases: [(syn::Attribute, syn::Type, &str); 8] = [
        (parse_quote! { #[parameter("k")] }, parse_quote! { f64 }, "a number has a unit"),
        (parse_quote! { #[parameter(unit = "kN")] }, parse_quote! { f64 }, "`kN` in the unit"),
        (
            parse_quote! { #[parameter(unit = "N")] },
            parse_quote! { bool },
            "only numbers have a unit",
        ),
        (parse_quote! { #[parameter] }, parse_quote! { Axis }, "needs `choices"),
        (parse_quote! { #[parameter(dimension = "N")] }, parse_quote! { f64 }, "known are unit"),
        (
            parse_quote! { #[parameter(unit = "N", default = 1.0)] },
            parse_quote! { Option<f64> },
            "has no `default`",
        ),
        (
            parse_quote! { #[parameter(unit = "N", per = "m/s")] },
            parse_quote! { f64 },
            "belong together",
        ),
        (
            parse_quote! { #[parameter(unit = "N", about = "N m")] },
            parse_quote! { f64 },
            "`N m` in the unit",
        ),
    ];
    for (said, ty, wanted) in cases {
        let message = refusal(&field(&said, &ty));
        assert!(message.contains(wanted), "{message}");
    }
}

#[test]
fn the_documentation_is_a_table() {
    let input = parse_quote! {
        struct Law {
            /// stiffness |at rest|
            #[parameter("k", unit = "N/m", about = "N·m/rad", range = Positive)]
            k: f64,
            /// share
            #[parameter(unit = "1", range = Within(0.0, 1.0), default = 0.5)]
            ratio: f64,
            /// local axis
            #[parameter(choices = ["U1", "U2"], default = "U1")]
            axis: Axis,
            #[serde(skip)]
            worked_out: f64,
        }
    };
    let made = of_struct(&input).unwrap().to_string();
    for row in [
        r"| `k` | k | N/m, N·m/rad | > 0 | required | stiffness \\|at rest\\| |",
        "| `ratio` |  | 1 | 0.0 … 1.0 | 0.5 | share |",
        "| `axis` |  |  | U1, U2 | U1 | local axis |",
    ] {
        assert!(made.contains(row), "{row}\n{made}");
    }
    assert!(!made.contains("worked_out"));
}

#[test]
fn choices_have_no_data() {
    let input = parse_quote! { enum Sides { Both, One(f64) } };
    assert!(of_enum(&input).unwrap_err().to_string().contains("without data"));
    let input = parse_quote! { enum Sides { Both, Tension } };
    assert!(of_enum(&input).unwrap().to_string().contains(r#""Both" , "Tension""#));
}
