//! Figures and pages stand whatever data they get.

use trilith_report::{Block, Color, Figure, Page, Section, Stroke};

fn figure() -> Figure {
    Figure::new("Drift of \"a\" & <b>", "time [s]", "u [m]")
}

#[test]
fn data_of_every_kind_can_be_drawn() {
    let nan = f64::NAN;
    let sets: [&[(f64, f64)]; 9] = [
        &[],
        &[(1.0, 2.0)],
        &[(0.0, 3.0), (1.0, 3.0), (2.0, 3.0)],
        &[(0.0, 0.0), (0.0, 0.0)],
        &[(0.0, 1.0), (nan, nan), (1.0, f64::INFINITY), (2.0, 5.0), (3.0, 6.0)],
        &[(-1.0, 1e-300), (1e300, -1e300)],
        &[(1e-9, 1e-12), (2e-9, 3e-12)],
        &[(0.0, -1e308), (1.0, 1e308)],
        &[(5e-324, 0.0), (1e-323, 5e-324)],
    ];
    for points in sets {
        for stroke in
            [Stroke::Line, Stroke::Dashes, Stroke::Rings, Stroke::Crosses, Stroke::Squares]
        {
            let drawn = figure().series("s", stroke, points.iter().copied());
            for f in [drawn.clone(), drawn.clone().log_log(), drawn.clone().log_x(), drawn.log_y()]
            {
                let svg = f.svg();
                assert!(
                    svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"),
                    "{points:?}"
                );
                assert!(!svg.contains("NaN") && !svg.contains("inf"), "{points:?} {stroke:?}");
            }
        }
    }
}

#[test]
fn text_is_escaped_and_the_page_is_one_file() {
    let section = Section::new("a", "x < y & z")
        .block(Block::text("<script>alert(1)</script>"))
        .block(Block::Table { head: vec!["verdict".into()], rows: vec![vec!["FAIL".into()]] })
        .block(figure().line("α < β", [(0.0, 1.0), (1.0, 2.0)]).caption("c & d"));
    let html = Page::new("T & U").section(section).html();
    for part in ["x &lt; y &amp; z", "&lt;script&gt;", "class=\"fail\"", "α &lt; β", "c &amp; d"]
    {
        assert!(html.contains(part), "{part} in\n{html}");
    }
    assert!(html.contains("&lt;b&gt;") && !html.contains("<b>"), "title of the figure");
    // Nothing is fetched: the only addresses are names of formats.
    for (at, _) in html.match_indices("http") {
        assert!(html[at..].starts_with("http://www.w3.org/"), "{}", &html[at..at + 40]);
    }
    assert!(!html.contains("<script src") && !html.contains("<img"));
    assert!(
        html.contains("<link rel=\"icon\" href=\"data:,\">") && html.matches("<link").count() == 1
    );
}

#[test]
fn a_long_history_is_thinned_and_keeps_its_peak() {
    let wave = (0..200_000).map(|i| {
        let t = f64::from(i) * 1e-4;
        (t, (t * 3.0).sin() + if i == 123_456 { 9.0 } else { 0.0 })
    });
    let svg = figure().line("wave", wave).svg();
    assert!(svg.len() < 100_000, "{}", svg.len());
    let plain = figure().line("wave", (0..200).map(|i| (0.1 * f64::from(i), 0.0))).svg();
    assert!(svg.len() > plain.len());
}

#[test]
fn references_are_dark_and_the_others_take_the_palette_in_turn() {
    let f = figure().reference("r", [(0.0, 0.0)]).line("a", [(0.0, 0.0)]).line("b", [(0.0, 0.0)]);
    let colors: Vec<Color> = f.series.iter().map(|s| s.color).collect();
    assert_eq!(colors, [Color::INK, Color::PALETTE[0], Color::PALETTE[1]]);
}

/// Keys reach what scrolls sideways where the script has looked.
#[test]
fn a_table_alone_brings_the_script_and_no_empty_heads() {
    let head = vec![String::new(), "a".to_owned()];
    let table = Block::Table { head, rows: vec![vec!["b".into(), "c".into()]] };
    let page = |block: Block| Page::new("A").section(Section::new("t", "T").block(block)).html();
    let html = page(table);
    assert!(html.contains("<script>") && html.contains("<td></td><th>a</th>"), "{html}");
    assert!(!page(Block::text("no more")).contains("<script>"));
}
