//! What the script of the page of a run has beside that of all pages, in the order in which its parts build on each
//! other.

pub(crate) const PARTS: [&str; 17] = [
    include_str!("script/renew.js"),
    include_str!("script/model.js"),
    include_str!("script/stage.js"),
    include_str!("script/solid/shaders.js"),
    include_str!("script/solid/meshes.js"),
    include_str!("script/solid/gl.js"),
    include_str!("script/solid/sheet.js"),
    include_str!("script/solid/plain.js"),
    include_str!("script/solid/solid.js"),
    include_str!("script/turn.js"),
    include_str!("script/tints.js"),
    include_str!("script/overlap.js"),
    include_str!("script/film.js"),
    include_str!("script/player.js"),
    include_str!("script/filter.js"),
    include_str!("script/watch.js"),
    include_str!("script/main.js"),
];
