//! Whether a text is meant as a model at all.

/// True for a text that is meant as a model, right or wrong: in parentheses, and with `nodes` somewhere, or with
/// `include`, which may bring them; or in braces, as JSON, with nodes, elements and cases. What a file
/// that another one names holds beside is nobody's business: its lines are not shown in errors.
#[must_use]
pub fn resembles_model(text: &str) -> bool {
    let mut rest = text.trim_start_matches('\u{feff}').trim_start();
    loop {
        let after = if let Some(comment) = rest.strip_prefix("//") {
            comment.split_once('\n')
        } else if let Some(comment) = rest.strip_prefix("/*") {
            comment.split_once("*/")
        } else if let Some(attribute) = rest.strip_prefix("#![") {
            attribute.split_once(']')
        } else {
            let in_json = ["\"nodes\"", "\"elements\"", "\"cases\""];
            return rest.starts_with('(') && (rest.contains("nodes") || rest.contains("include:"))
                || rest.starts_with('{') && in_json.iter().all(|name| rest.contains(name));
        };
        let Some((_, after)) = after else { return false };
        rest = after.trim_start();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn models_are_told_from_other_texts() {
        for text in [
            "(nodes: {})",
            "(include: [\"a.ron\"])",
            "\u{feff}// a\n\n/* ( */ #![enable(unwrap_newtypes)]\n(title: \"t\", nodes: { oops",
        ] {
            assert!(resembles_model(text), "{text}");
        }
        for text in [
            "",
            "// (nodes: {})",
            "/* nodes",
            "root:x:0:0:nodes:/root:/bin/sh",
            "(secret: \"word\")",
            "{\"nodes\": 1}",
        ] {
            assert!(!resembles_model(text), "{text}");
        }
    }
}
