use super::*;
use trilith_element::dimension as d;

/// Parameters `width` = 2 m, `g` = 3 without unit, `alpha` = 0.5.
struct Some3;

impl Scope for Some3 {
    fn names(&self) -> Vec<&str> {
        vec!["width", "g", "alpha"]
    }
    fn has(&self, name: &str) -> bool {
        self.names().contains(&name)
    }
    fn value(&mut self, name: &str) -> Result<Quantity, Option<(&'static str, String)>> {
        Ok(match name {
            "width" => Quantity { value: 2.0, dimension: d::LENGTH, measured: true },
            "g" => Quantity::bare(3.0),
            _ => Quantity::bare(0.5),
        })
    }
}

#[track_caller]
fn is(text: &str, value: f64, dimension: Dimension) {
    let q = evaluate(text, &mut Some3).unwrap_or_else(|e| panic!("{text}: {e:?}"));
    assert!((q.value - value).abs() <= 1e-12 * value.abs(), "{text} = {}", q.value);
    assert!(q.dimension.matches(dimension), "{text} in {}", q.dimension);
}

#[track_caller]
fn refused(text: &str, code: &str, at: &str, words: &str) {
    let e = evaluate(text, &mut Some3).expect_err(text).expect("a told error");
    let told = format!("{} {}", e.message, e.help.unwrap_or_default());
    assert_eq!((e.code, &text[e.span]), (code, at), "{told}");
    assert!(told.contains(words), "{told}");
}

#[test]
fn numbers_carry_units_and_their_products() {
    is("30 kip/in", 30.0 * 4_448.221_615_260_5 / 0.0254, d::STIFFNESS);
    is("10 kN*s/m", 1e4, d::DAMPING);
    is("2.5e3 N s / m", 2500.0, d::DAMPING);
    is("5 kg*m^2", 5.0, d::INERTIA);
    is("3 kg·m²", 3.0, d::INERTIA);
    is("0.1 1/s", 0.1, d::FREQUENCY);
    is("4/s", 4.0, d::FREQUENCY);
    is("2 N/(m/s)^alpha", 2.0, d::FORCE / d::VELOCITY.powf(0.5));
    is("2 m^-1", 2.0, d::LENGTH.powf(-1.0));
    is("180 deg", std::f64::consts::PI, d::NONE);
    is("5 %", 0.05, d::NONE);
    is("120 rpm", 2.0, d::FREQUENCY);
}

#[test]
fn a_unit_stands_only_after_a_number_and_a_parameter_elsewhere() {
    is("1.5 g", 1.5 * 9.806_65, d::ACCELERATION);
    is("1.5 * g", 4.5, d::NONE);
    is("2 kN * width", 4000.0, d::MOMENT);
    is("2 kg*g", 6.0, d::MASS);
    is("4 m / 2", 2.0, d::LENGTH);
    is("1 / 2 s", 0.5, d::FREQUENCY);
    is("3 m/width", 1.5, d::NONE);
}

#[test]
fn signs_powers_and_functions_bind_as_in_mathematics() {
    is("-2^2", -4.0, d::NONE);
    is("2^-1", 0.5, d::NONE);
    is("2^3^2", 512.0, d::NONE);
    is("1 - 2 - 3", -4.0, d::NONE);
    is("6 / 3 * 2", 4.0, d::NONE);
    is("sqrt(width^2 + (3 m)^2 - 4 m^2)", 3.0, d::LENGTH);
    is("max(0, width, 1 m)", 2.0, d::LENGTH);
    is("atan2(width, 2 m)", std::f64::consts::FRAC_PI_4, d::NONE);
    is("cos(pi)", -1.0, d::NONE);
}

#[test]
fn errors_point_at_the_part_that_is_wrong() {
    refused("2 * wdth", "E0110", "wdth", "`width`");
    refused("2 * m", "E0110", "m", "directly after a number");
    refused("2 lb", "E0109", "lb", "`lbf`");
    refused("2 width", "E0108", "width", "* width");
    refused("width + 1 s", "E0111", "width + 1 s", "added");
    refused("sine(2)", "E0108", "sine", "`sin`");
    refused("(1 + 2", "E0108", "(1 + 2", "missing");
    refused("1 / 0", "E0112", "/ 0", "zero");
    refused("sqrt(-1)", "E0112", "sqrt(-1)", "not defined");
    refused("2^width", "E0111", "width", "pure number");
    refused("1e400", "E0112", "1e400", "finite");
    refused("", "E0108", "", "the end");
    refused("2 ; 3", "E0108", "; 3", "not expected");
}

#[test]
fn deep_nesting_is_an_error_and_no_crash() {
    let deep = "(".repeat(100_000);
    assert!(evaluate(&deep, &mut Some3).is_err());
    assert!(evaluate(&"-".repeat(100_000), &mut Some3).is_err());
    assert!(evaluate(&"2^".repeat(100_000), &mut Some3).is_err());
    assert!(evaluate(&"1 m^(".repeat(100_000), &mut Some3).is_err());
    assert!(evaluate(&format!("1 m{}", "/(m".repeat(100_000)), &mut Some3).is_err());
}

#[test]
fn a_quantity_of_an_argument_has_a_dimension_or_is_si() {
    use trilith_element::dimension::LENGTH;
    assert_eq!(super::quantity("5.1 in", LENGTH), Ok(5.1 * 0.0254));
    assert_eq!(super::quantity(" 0.3 ", LENGTH), Ok(0.3));
    for wrong in ["5 s", "5 inn", "width", "", "1 m +", "1/0"] {
        assert!(super::quantity(wrong, LENGTH).is_err(), "{wrong}");
    }
}
