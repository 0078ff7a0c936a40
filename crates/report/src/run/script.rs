//! The script of the page, in the order in which its parts build on each other.

const PARTS: [&str; 8] = [
    include_str!("script/base.js"),
    include_str!("script/axes.js"),
    include_str!("script/chart.js"),
    include_str!("script/plots.js"),
    include_str!("script/model.js"),
    include_str!("script/player.js"),
    include_str!("script/filter.js"),
    include_str!("script/main.js"),
];

/// One script in strict mode that leaves nothing behind in the page.
pub(crate) fn text() -> String {
    format!("(() => {{\n\"use strict\";\n{}}})();\n", PARTS.join("\n"))
}
