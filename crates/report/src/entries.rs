//! What points of figures stand for: rows that the reader of a page can ask.

use serde_json::{Value, json};
use std::collections::HashMap;

/// Rows that points of figures stand for, such as the runs of a study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entries {
    /// What a row is called, such as `run`.
    pub name: String,
    /// How the commands that make rows begin; empty: there are none.
    pub command: String,
    /// Names and values that the commands of all rows set.
    pub common: Vec<(String, String)>,
    /// Names and units of its cells.
    pub head: Vec<(String, String)>,
    /// The rows.
    pub rows: Vec<Entry>,
}

/// A row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entry {
    /// Its cells; an empty one is not shown.
    pub cells: Vec<String>,
    /// Folders and file beneath the page that hold more of it, one name after the other; empty: none.
    pub place: Vec<String>,
    /// Names and values that the command that makes it sets beside these.
    pub set: Vec<(String, String)>,
}

impl Entries {
    pub(crate) fn data(&self) -> Value {
        let of = |what: &dyn Fn(&Entry) -> Value| -> Value { self.rows.iter().map(what).collect() };
        // What a row sets may stand in cells that have no head.
        let width = self.rows.iter().map(|r| r.cells.len()).fold(self.head.len(), usize::max);
        let cells = self.columns(width, |r, i| r.cells.get(i));
        let mut out = json!({
            "name": self.name, "head": self.head, "count": self.rows.len(), "cells": cells
        });
        if self.rows.iter().any(|r| !r.place.is_empty()) {
            out["links"] = of(&|r| json!(address(&r.place)));
        }
        if !self.command.is_empty() {
            out["command"] = json!(self.command);
            out["common"] = json!(self.common);
            // As a rule all rows set the same names: they are told once.
            let names = |r: &Entry| r.set.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
            let first = self.rows.first().map(names).unwrap_or_default();
            if self.rows.iter().all(|r| names(r) == first) {
                out["names"] = json!(first);
                // So are their values where the first cells are these.
                let cells = |r: &Entry| {
                    r.set.iter().enumerate().all(|(i, (_, value))| r.cells.get(i) == Some(value))
                };
                if !self.rows.iter().all(cells) {
                    let values =
                        self.columns(first.len(), |r, i| r.set.get(i).map(|(_, value)| value));
                    out["values"] = json!(values);
                }
            } else {
                out["sets"] = of(&|r| json!(r.set));
            }
        }
        out
    }
}

impl Entries {
    /// What all rows have at so many places, column by column: [`column`] of each.
    fn columns<'a>(
        &'a self,
        count: usize,
        of: impl Fn(&'a Entry, usize) -> Option<&'a String>,
    ) -> Vec<Value> {
        let text = |r, i| of(r, i).map_or("", String::as_str);
        (0..count).map(|i| column(self.rows.iter().map(|r| text(r, i)))).collect()
    }
}

/// Texts of all rows, each told once: `of` has them, `at` where the one of a row is. Without `at` they stand in the order of the
/// rows, or there is only one.
fn column<'a>(texts: impl Iterator<Item = &'a str>) -> Value {
    let mut places = HashMap::new();
    let (mut of, mut at) = (Vec::new(), Vec::new());
    for text in texts {
        let place = *places.entry(text).or_insert(of.len());
        if place == of.len() {
            of.push(text);
        }
        at.push(place);
    }
    if of.len() == 1 || of.len() == at.len() {
        json!({ "of": of })
    } else {
        json!({ "of": of, "at": at })
    }
}

/// Names of folders as an address relative to the page. Whatever they hold, it stays beneath it.
fn address(place: &[String]) -> String {
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"-_.~".contains(&b);
    let byte = |b: u8| if plain(b) { char::from(b).to_string() } else { format!("%{b:02X}") };
    let name = |name: &String| match name.as_str() {
        "" | "." | ".." => String::new(),
        name => name.bytes().map(byte).collect(),
    };
    place.iter().map(name).filter(|n| !n.is_empty()).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_all_rows_set_are_told_once() {
        let row = |set: &[(&str, &str)]| Entry {
            set: set.iter().map(|(n, v)| ((*n).into(), (*v).into())).collect(),
            ..Entry::default()
        };
        let of = |rows: Vec<Entry>| {
            Entries { command: "trilith run a.ron".into(), rows, ..Entries::default() }.data()
        };
        let alike = of(vec![row(&[("a", "1"), ("b", "2")]), row(&[("a", "3"), ("b", "4")])]);
        assert_eq!(alike["names"], json!(["a", "b"]));
        assert_eq!(alike["values"], json!([{ "of": ["1", "3"] }, { "of": ["2", "4"] }]));
        let shown = Entry { cells: vec!["1".into(), "0.3".into()], ..row(&[("a", "1")]) };
        let shown = of(vec![shown]);
        assert_eq!(shown.get("values"), None);
        assert_eq!(shown["cells"][0], json!({ "of": ["1"] }));
        let other = of(vec![row(&[("a", "1")]), row(&[("b", "4")])]);
        assert_eq!(other["sets"], json!([[["a", "1"]], [["b", "4"]]]));
        assert_eq!(other.get("names"), None);
    }

    #[test]
    fn texts_that_rows_have_alike_are_told_once() {
        let of = |texts: &[&str]| column(texts.iter().copied());
        assert_eq!(of(&["a", "b", "a"]), json!({ "of": ["a", "b"], "at": [0, 1, 0] }));
        assert_eq!(of(&["a", "a"]), json!({ "of": ["a"] }));
        assert_eq!(of(&["b", "a"]), json!({ "of": ["b", "a"] }));
        assert_eq!(of(&[]), json!({ "of": [] }));
        // A row that has no cell there has an empty one.
        let row = |cells: &[&str]| Entry {
            cells: cells.iter().map(|c| (*c).to_owned()).collect(),
            ..Entry::default()
        };
        let head = vec![("a".to_owned(), String::new()), ("b".to_owned(), "m".to_owned())];
        let rows = vec![row(&["1", "2"]), row(&["1"])];
        let data = Entries { head, rows, ..Entries::default() }.data();
        assert_eq!(
            (&data["count"], &data["cells"]),
            (&json!(2), &json!([{ "of": ["1"] }, { "of": ["2", ""] }]))
        );
    }

    #[test]
    fn an_address_is_a_place_beneath_the_page_whatever_its_names() {
        let of =
            |names: &[&str]| address(&names.iter().map(|n| (*n).to_owned()).collect::<Vec<_>>());
        assert_eq!(
            of(&["runs", "mu=0.2,a=1 g", "report.html"]),
            "runs/mu%3D0.2%2Ca%3D1%20g/report.html"
        );
        assert_eq!(of(&["javascript:alert(1)"]), "javascript%3Aalert%281%29");
        assert_eq!(of(&["..", "/etc", "\"><script>"]), "%2Fetc/%22%3E%3Cscript%3E");
    }
}
