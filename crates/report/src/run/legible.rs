//! Texts of a run as a page may show them.

use super::texts::any_to_write_out;
use super::{Frames, Numbers, RunData};
use crate::chart::legible;
use serde_json::Value;
use std::borrow::Cow;

/// The summary with the control characters of its texts and names written out.
pub(crate) fn summary(summary: &Value) -> Value {
    legible(summary.clone())
}

/// The data of a run in the same way: the names in both stay alike.
pub(crate) fn data(data: &RunData) -> Cow<'_, RunData> {
    // As a rule there is nothing to write out.
    if !any_to_write_out(data) {
        return Cow::Borrowed(data);
    }
    // Without the deformed shapes, which are long and hold no texts.
    let frames = Frames { u: Numbers { n: Vec::new(), ..data.frames.u }, ..data.frames.clone() };
    let bare = RunData { frames, ..data.clone() };
    let Ok(value) = serde_json::to_value(bare) else { return Cow::Borrowed(data) };
    let shown = legible(value);
    match serde_json::from_value::<RunData>(shown) {
        Ok(mut shown) => {
            shown.frames.u = data.frames.u.clone();
            Cow::Owned(shown)
        }
        // A number that JSON does not have: the page could not read it, either.
        Err(_) => Cow::Borrowed(data),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_written_out_and_what_needs_nothing_stays() {
        let plain = RunData { outputs: vec!["a, b".into()], ..RunData::default() };
        assert!(matches!(data(&plain), Cow::Borrowed(_)));
        let odd = RunData { outputs: vec!["a\u{1b}\u{9b}b".into()], ..RunData::default() };
        assert_eq!(data(&odd).outputs, ["a\\u{1b}\\u{9b}b"]);
        let of_run = serde_json::json!({"outputs": {"a\u{1b}": {"unit": "m", "max": 0.1}}});
        assert_eq!(summary(&of_run)["outputs"]["a\\u{1b}"]["max"], 0.1);
    }

    #[test]
    fn a_page_of_a_run_holds_no_control_characters() {
        let name = "a\u{1b}]0;x\u{7}\u{9b}31m";
        let odd = RunData { file: name.into(), notes: vec![name.into()], ..RunData::default() };
        let of_run =
            serde_json::json!({"model": {"title": name}, "case": name, "warnings": [name]});
        let page = crate::run_page(&of_run, &odd, &Value::Null);
        let obeyed = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
        assert!(!page.contains(obeyed) && page.contains("a\\u{1b}]0;x\\u{7}"), "{page}");
    }
}
