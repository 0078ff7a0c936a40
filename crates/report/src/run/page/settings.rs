//! How the run was made.

use super::{text, value};
use crate::run::RunData;
use crate::run::units::{number, percent};
use maud::{Markup, html};
use serde_json::Value;

pub(super) fn settings(summary: &Value, data: &RunData) -> Markup {
    let w = &summary["work"];
    let count = |k: &str| w[k].as_u64().map_or("–".into(), |n| n.to_string());
    let seconds = |k: &str| format!("{} s", number(value(&w[k])));
    let mut work = vec![
        ("output steps".to_owned(), count("steps")),
        ("substeps".into(), count("substeps")),
        ("iterations of the link equations".into(), count("iterations")),
        ("steps thrown away".into(), count("rejected")),
        ("factorisations".into(), count("factorizations")),
        ("wall time".into(), seconds("wall_s")),
        ("CPU time of set-up".into(), seconds("setup_cpu_s")),
        ("CPU time of the march".into(), seconds("march_cpu_s")),
        ("largest memory".into(), format!("{} MB", number(value(&w["peak_rss_mb"])))),
    ];
    let b = &summary["basis"];
    if b.is_object() {
        let share = |v: &Value| percent(value(v));
        work.push((
            "basis: vectors".into(),
            b["vectors"].as_u64().map_or("–".into(), |n| n.to_string()),
        ));
        let [low, high] = [0, 1].map(|i| number(value(&b["frequency"][i])));
        let band = match high.as_str() {
            "0" => "0 Hz: the body moves freely".into(),
            _ => format!("{low} … {high} Hz"),
        };
        work.push(("basis: frequencies".into(), band));
        let mass: Vec<String> = (0..3).map(|i| share(&b["mass_participation"][i])).collect();
        work.push(("basis: mass X, Y, Z".into(), mass.join(", ")));
        let worst = &b["worst"];
        if worst.is_object() {
            let held = format!("{} of {}", share(&worst["share"]), text(&worst["coordinate"]));
            work.push(("basis: flexibility held, worst link coordinate".into(), held));
        }
    }
    html! {
        div.two {
            div { (pairs("solution", &data.settings)) }
            div { (pairs("work", &work)) }
        }
    }
}

/// The foot of the page: what made it, when, from which files.
pub(super) fn made(summary: &Value, data: &RunData, made: &Value) -> Markup {
    let mut all = vec![
        ("program".to_owned(), format!("trilith {}", text(&summary["version"]))),
        ("build of it".into(), text(&summary["build"])),
    ];
    let mut say = |what: &str, value: &Value| {
        all.extend(value.as_str().map(|text| (what.to_owned(), text.to_owned())));
    };
    say("date", &made["date"]);
    let words =
        |list: &Value| -> Vec<String> { list.as_array().into_iter().flatten().map(text).collect() };
    let command = words(&made["command"]).iter().map(|w| quoted(w)).collect::<Vec<_>>().join(" ");
    say("command", &Value::from(Some(command).filter(|c| !c.is_empty())));
    let machine = words(&made["machine"]).join(" ");
    say("machine", &Value::from(Some(machine).filter(|m| !m.is_empty())));
    all.push(("SHA-256 of the results".into(), text(&summary["run_sha256"])));
    let mut files: Vec<(String, String)> = Vec::new();
    for f in made["files"].as_array().into_iter().flatten() {
        files.push((format!("{} {}", text(&f["what"]), text(&f["file"])), text(&f["sha256"])));
    }
    if files.is_empty() {
        files.push((format!("model {}", data.file), text(&summary["model"]["sha256"])));
    }
    html! {
        h2 { "What made this page" }
        div.two {
            div { (pairs("made by", &all)) (pairs("SHA-256 of what was read", &files)) }
            div {
                @if !data.overrides.is_empty() { (pairs("set on the command line", &data.overrides)) }
                @if !data.parameters.is_empty() { (pairs("parameter", &data.parameters)) }
            }
        }
    }
}

/// A word of a command line as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_=./,:+%@".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

fn pairs(head: &str, all: &[(String, String)]) -> Markup {
    html! { table {
        thead { tr { th colspan="2" { (head) } } }
        tbody { @for (what, value) in all { tr { td { (what) } td.hash { (value) } } } }
    } }
}
