//! Functions of time that another crate offers.

use super::{errors, model, shown, small};
use crate::{Registry, Side, TimeFunction, read_text, resolved};
use std::sync::Arc;
use trilith_element::*;

/// A decaying shock, as in `kinds`, and what an odd one may say of itself.
#[derive(Clone, Debug)]
struct Odd {
    value: f64,
    peak: f64,
    step: f64,
}

impl Waveform for Odd {
    fn at(&self, t: f64, _: Side) -> [f64; 3] {
        [if t > 0.5 { self.value } else { 1.0 }, 0.0, 0.0]
    }
    fn breaks(&self) -> Vec<f64> {
        Vec::new()
    }
    fn stretch(&self) -> Option<Stretch> {
        Some(Stretch { from: 0.0, to: f64::INFINITY, step: self.step })
    }
    fn peak_until(&self, _: f64) -> f64 {
        self.peak
    }
}

const ODD: Card = super::kinds::Decay::CARD.named("Odd").parameters(&[]);
/// A name that a built-in function has.
const SINE: Card = ODD.named("Sine");

const DECAY: &str = r#"Decay(amplitude: "2 kN", time: "0.5 s", start: "1 s")"#;

fn with(function: &str) -> String {
    small(&format!(
        "functions: {{ \"f\": {function}, \"twice\": Scaled(function: \"f\", factor: 2) }},"
    ))
}

/// 2 kN e^(−(t − 1)/0.5) with its derivatives, from 1 s on.
#[test]
fn a_foreign_function_is_read_by_name_and_has_its_values() {
    let model = model(&with(DECAY));
    let f = &model.functions[0];
    assert_eq!(f.dimension, Some(dimension::FORCE));
    let f = &f.function;
    assert_eq!((f.value(1.0, Side::Before), f.value(1.0, Side::After)), (0.0, 2000.0));
    let expected = 2000.0 * (-1.0_f64).exp();
    assert!((f.value(1.5, Side::Before) - expected).abs() < 1e-9);
    let (first, second) = f.derivatives(1.5, Side::Before);
    assert!((first + 2.0 * expected).abs() < 1e-9 && (second - 4.0 * expected).abs() < 1e-9);
    assert_eq!((f.breaks(), f.peak(), f.peak_until(0.5)), (vec![1.0], 2000.0, 0.0));
    assert_eq!(f.stretch().map(|s| s.from), Some(1.0));
    assert_eq!(model.functions[1].function, f.scaled(2.0));
    assert_ne!(model.functions[1].function, *f);
}

#[test]
fn a_foreign_function_is_written_out_and_read_again() {
    let once = model(&with(DECAY));
    let again = model(&resolved(&once));
    for (a, b) in once.functions.iter().zip(&again.functions) {
        assert!(matches!(a.function, TimeFunction::Custom(_)));
        assert_eq!((&a.function, a.dimension), (&b.function, b.dimension));
    }
}

#[test]
fn errors_of_foreign_functions_are_those_of_built_in_ones() {
    for (function, words) in [
        (DECAY.replace("Decay", "Dekay"), "there is no function `Dekay`"),
        (DECAY.replace("start", "strat"), "function `f` has no field `strat`"),
        (DECAY.replace("0.5 s", "0.5 m"), "a value in m: must be a value in s"),
        (DECAY.replace("0.5 s", "-1 s"), "`time`"),
        (DECAY.replace("time: \"0.5 s\", ", ""), "function `f` has no `time`, which Decay needs"),
        (DECAY.replace("amplitude: \"2 kN\", ", ""), "function `f` has no `amplitude`"),
        ("Slider".into(), "there is no function `Slider`"),
    ] {
        let told = errors(&with(&function));
        assert!(told.iter().any(|d| d.message.contains(words)), "{}", shown(&told));
        assert!(told.iter().all(|d| !d.span.is_empty()), "{function}");
    }
    let near = errors(&with(&DECAY.replace("Decay", "Dekay")));
    assert!(near[0].help.as_deref().is_some_and(|h| h.contains("`Decay`")), "{}", shown(&near));
    // Nor is a function a kind of elements.
    let element = small("").replace("Spring(", "Decay(");
    assert!(errors(&element)[0].message.contains("there is no kind `Decay`"));
}

#[test]
fn a_waveform_that_is_none_is_refused_where_it_is_named() {
    let good = Odd { value: 1.0, peak: 1.0, step: 0.1 };
    // A reader holds what it needs.
    let read = |odd: Odd| {
        let mut kinds = super::registry();
        kinds.add_function(&ODD, Arc::new(move |_| Ok(Box::new(odd.clone()))));
        read_text(&with("Odd(amplitude: 1)"), "odd.ron", &kinds, &[])
    };
    assert!(read(good.clone()).is_ok());
    for (odd, words) in [
        (Odd { value: f64::NAN, ..good.clone() }, "a value or a derivative is NaN at"),
        (Odd { value: 2.0, ..good.clone() }, "but `peak_until` is 1 for all times"),
        (Odd { peak: f64::INFINITY, ..good.clone() }, "`peak_until` is inf"),
        (Odd { step: 0.0, ..good.clone() }, "`stretch` is from 0 s"),
    ] {
        let told = read(odd).expect_err("no function");
        assert!(told[0].message.contains(words), "{}", shown(&told));
    }
    let mut kinds = Registry::new();
    kinds.add_function(&SINE, Arc::new(move |_| Ok(Box::new(good.clone()))));
    assert_eq!(kinds.duplicates(), ["Sine"]);
}
