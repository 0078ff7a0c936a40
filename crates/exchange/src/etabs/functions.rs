//! Functions of time.

use super::text::Token;
use super::words::{File, Thing, value};

/// Reads functions of time; the others belong to cases that are named.
pub fn functions(file: &File<'_>) {
    for thing in file.things("FUNCTIONS", "FUNCTION", 1) {
        let name = thing.names[0];
        if thing.text("FUNCTYPE").is_some_and(|t| !t.eq_ignore_ascii_case("history")) {
            thing.idle();
            continue;
        }
        if let Some(path) = thing.text("FILE") {
            from_file(file, &thing, name, path);
            continue;
        }
        match thing.text("HISTTYPE") {
            Some(kind @ ("SINE" | "COSINE")) => {
                let table = match kind {
                    "SINE" => "FUNCTION - TIME HISTORY - SINE",
                    _ => "FUNCTION - TIME HISTORY - COSINE",
                };
                thing.number("STEPS");
                file.row(table, thing.span())
                    .with("Name", name)
                    .with("Period", thing.need_number("PERIOD"))
                    .with("NumCycles", thing.need_number("NCYC"))
                    .with("Amplitude", amplitude(&thing))
                    .put();
            }
            Some("RAMP") => {
                thing.number("MAXTIME");
                file.row("FUNCTION - TIME HISTORY - RAMP", thing.span())
                    .with("Name", name)
                    .with("RampTime", thing.need_number("RAMPTIME"))
                    .with("Amplitude", amplitude(&thing))
                    .put();
            }
            Some(kind) if !kind.eq_ignore_ascii_case("user") => {
                thing.idle();
                let what = format!("a function of the kind {kind} has no counterpart");
                file.lose("FUNCTIONS: HISTTYPE", &what, name);
            }
            _ => points(file, &thing, name),
        }
    }
}

fn amplitude(thing: &Thing<'_>) -> f64 {
    ["AMP", "AMPLITUDE"].iter().find_map(|key| thing.number(key)).unwrap_or(1.0)
}

fn from_file(file: &File<'_>, thing: &Thing<'_>, name: &str, path: &str) {
    let both = matches!(thing.text("DATATYPE"), Some("T&V"));
    let fixed = thing.text("FORMAT").is_some_and(|f| !f.eq_ignore_ascii_case("free"));
    let row = file.row("FUNCTION - TIME HISTORY - FROM FILE", thing.span());
    row.with("Name", name)
        .with("FileName", path)
        .with("DataType", if both { "Time and Value" } else { "Equal Interval" })
        .with("FormatType", if fixed { "Fixed" } else { "Free" })
        .maybe("Interval", thing.number("DT"))
        .maybe("HeaderLines", thing.number("HEADERLINES"))
        .maybe("PrefixChars", thing.number("PREFIXCHAR"))
        .maybe("PtsPerLine", thing.number("POINTSPERLINE"))
        .put();
}

/// Points of the file itself: times and values in turn, or values at equal steps.
fn points(file: &File<'_>, thing: &Thing<'_>, name: &str) {
    let mut numbers = Vec::new();
    for line in &thing.lines {
        let key = |t: &Token| t.is_word() && matches!(t.text.as_str(), "TIMEVAL" | "VALUE");
        let Some(at) = line.tokens.iter().position(key) else { continue };
        line.tokens[at].used.set(true);
        for token in line.tokens[at + 1..].iter().take_while(|t| !t.is_word()) {
            token.used.set(true);
            if token.quoted {
                let words = token.text.split([' ', '\t']).filter(|w| !w.is_empty());
                for word in words {
                    match super::text::number(word).filter(|x| x.is_finite()) {
                        Some(x) => numbers.push(x),
                        None => {
                            let message = format!("`{word}` is no number");
                            file.db.wrong(&token.span, &message, "times and values in turn");
                            return;
                        }
                    }
                }
            } else if let Some(x) = value(file.db, token) {
                numbers.push(x);
            }
        }
    }
    let pairs: Vec<[f64; 2]> = match (thing.text("DATATYPE"), thing.number("DT")) {
        (Some("EQUAL"), Some(dt))
            if thing.lines.iter().all(|l| l.tokens.iter().all(|t| t.text != "TIMEVAL")) =>
        {
            numbers.iter().enumerate().map(|(i, x)| [i as f64 * dt, *x]).collect()
        }
        _ => numbers.chunks_exact(2).map(|p| [p[0], p[1]]).collect(),
    };
    if pairs.is_empty() {
        let what = "a function without points";
        file.lose("FUNCTIONS", what, name);
    }
    for [t, x] in pairs {
        let row = file.row("FUNCTION - TIME HISTORY - USER", thing.span());
        row.with("Name", name).with("Time", t).with("Value", x).put();
    }
}
