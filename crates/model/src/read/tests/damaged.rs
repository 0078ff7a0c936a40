//! Damaged files are answered with diagnostics and never with a panic.

use super::*;

const BLOCK: &str = include_str!("block.ron");

/// All diagnostics can be shown and point into their text.
fn look(text: &str) {
    if let Err(all) = read_with(text, &[]) {
        assert!(!all.is_empty());
        for e in &all {
            assert!(!e.to_string().is_empty());
            assert!(e.source.text.get(e.span.clone()).is_some(), "{e} {:?}", e.span);
        }
    }
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    for end in (0..BLOCK.len()).step_by(7) {
        look(&BLOCK[..end]);
    }
}

#[test]
fn a_file_with_a_changed_piece_is_no_crash() {
    let pieces = [
        "", "(", ")", "\"", "{", "}", "[", "]", ":", ",", "1e999", "-", "µ", "None", "Some(", "//",
    ];
    let mut seed = 1_u64;
    for _ in 0..1500 {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let at = (seed >> 33) as usize % (BLOCK.len() - 4);
        let cut = (seed >> 20) as usize % 4;
        let piece = pieces[(seed >> 40) as usize % pieces.len()];
        look(&format!("{}{piece}{}", &BLOCK[..at], &BLOCK[at + cut..]));
    }
}

#[test]
fn extensions_that_a_file_enables_are_no_crash() {
    for name in
        ["unwrap_newtypes", "implicit_some", "unwrap_variant_newtypes", "explicit_struct_names"]
    {
        look(&format!("#![enable({name})]\n{BLOCK}"));
        look(&format!("#![enable({name})]\n(nodes: Some(a: 1), title: Some((a: (1, 2))))"));
    }
}
