//! Names and titles stay texts, whatever they look like.

mod common;

use common::HOSTILE;

/// Start tags in a page, but for what scripts and style hold.
fn tags(page: &str) -> Vec<String> {
    let mut all = Vec::new();
    let mut rest = page;
    while let Some(at) = rest.find('<') {
        let tag: String = rest[at + 1..].chars().take_while(|c| c.is_alphanumeric()).collect();
        rest = &rest[at + 1..];
        if tag == "script" || tag == "style" {
            // As a browser does: to the first end tag, whatever it is in.
            let end = rest.find(&format!("</{tag}")).expect("an end");
            rest = &rest[end..];
        }
        if !tag.is_empty() {
            let attributes = rest.find('>').map_or("", |end| &rest[..end]);
            all.push(format!("{tag} {attributes}"));
        }
    }
    all
}

fn harmless(page: &str) {
    for tag in tags(page) {
        let name = tag.split(' ').next().unwrap();
        assert!(name != "img", "{tag}");
        let mut attributes = tag.split_ascii_whitespace().skip(1);
        assert!(!attributes.any(|a| a.to_lowercase().starts_with("on")), "{tag}");
        assert!(!tag.contains("href=\"javascript:"), "{tag}");
    }
    let scripts = tags(page).iter().filter(|t| t.starts_with("script")).count();
    assert_eq!(page.matches("</script").count(), scripts, "a name ends a script");
    assert!(!page.contains("<script>window"), "a name begins one");
}

#[test]
fn a_page_shows_names_as_they_are() {
    let page = common::page();
    harmless(&page);
    assert!(page.contains("&lt;img src=x onerror"), "shown as a text");
    // Every drawing can be read by the script.
    let drawings: Vec<&str> = page.split("class=\"drawing\">").skip(1).collect();
    assert_eq!(drawings.len(), 2 * HOSTILE.len());
    for (i, drawing) in drawings.iter().enumerate() {
        let text = drawing.split("</script").next().unwrap();
        let value: serde_json::Value = serde_json::from_str(text).unwrap();
        assert_eq!(value["title"], HOSTILE[i / 2]);
    }
}

#[test]
fn the_page_of_a_run_shows_names_as_they_are() {
    let page = common::run();
    harmless(&page);
    for id in ["id=\"data\">", "class=\"drawing\">"] {
        let text = page.split(id).nth(1).unwrap().split("</script").next().unwrap();
        assert!(serde_json::from_str::<serde_json::Value>(text).is_ok(), "{id}");
    }
}
