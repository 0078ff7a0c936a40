//! The table of wrong laws on its page of the guide.

use crate::End;
use crate::law::Fault;
use std::fmt::Write;
use std::path::PathBuf;

const BEGIN: &str =
    "<!-- The test `wrong_laws` of validation compares this table, and writes it. -->\n";

/// Rows: what is wrong, what the kit says, what runs say.
#[derive(Default)]
pub struct Table(String);

impl Table {
    /// Adds a law: what the kit has found, and how runs by all solvers ended.
    pub fn row(&mut self, fault: Fault, kit: Option<&str>, ends: &[End; 3]) {
        let [fna, hht, full] = ends.each_ref().map(said);
        let runs = if fna == hht && hht == full {
            format!("all: {fna}")
        } else {
            format!("FNA: {fna}<br>HHT: {hht}<br>full Newton: {full}")
        };
        let kit = kit.map_or("conforms".into(), short);
        writeln!(self.0, "| {} | {kit} | {runs} |", fault.what()).expect("a String");
    }

    /// Compares it with the page, or writes it there.
    ///
    /// # Panics
    /// Where the page has another one.
    pub fn compare(&self) {
        let path =
            PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../crates/guide/src/wrong_laws.md");
        let page = std::fs::read_to_string(&path).expect("the page");
        let (head, _) = page.split_once(BEGIN).expect("the beginning of the table");
        let columns = "| what is wrong | what the kit says | how a run ends |\n|---|---|---|\n";
        let now = format!("{head}{BEGIN}\n{columns}{}", self.0);
        if std::env::var_os("TRILITH_UPDATE").is_some() {
            std::fs::write(&path, &now).expect("written");
        } else {
            assert_eq!(page, now, "TRILITH_UPDATE=1 writes the table of {}", path.display());
        }
    }
}

/// What a run says of a law, without numbers that hang on the last bits of its way.
fn said(end: &End) -> String {
    if end.good {
        return "converged, with the right numbers".into();
    }
    let text = end.text.replace("the law of \"w\" ", "");
    short(&text)
}

/// A message without times, shares, and numbers.
fn short(text: &str) -> String {
    // Where and when: up to the colon behind, or to the end.
    let cut =
        [" at t = ", " at the start of", " beyond "].iter().filter_map(|w| text.find(w)).min();
    let (head, rest) = cut.map_or((text, ""), |at| text.split_at(at));
    let mut words = match head.starts_with("accounts for ") {
        true => "does not account for its work".to_owned(),
        false => head.split(' ').map(word_of).collect::<Vec<_>>().join(" "),
    };
    if let Some((_, behind)) = rest.split_once(": ")
        && !behind.split(' ').any(is_number)
    {
        words += ": ";
        words += behind;
    }
    words.trim_end_matches(',').replace('|', "\\|")
}

fn is_number(word: &str) -> bool {
    word.trim_end_matches([',', ':', ';']).parse::<f64>().is_ok_and(f64::is_finite)
}

fn word_of(word: &str) -> &str {
    if is_number(word) { "…" } else { word }
}
