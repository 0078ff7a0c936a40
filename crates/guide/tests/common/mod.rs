//! Running the program on the examples of a page.

#![allow(dead_code, reason = "each test uses a part")]

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use trilith_guide::{Page, pages};

/// The pages.
pub fn book() -> Vec<Page> {
    pages().expect("the pages of the book")
}

/// The root of the project.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// What a command printed.
#[derive(Clone, Debug)]
pub struct Printed {
    pub status: i32,
    pub out: String,
    pub err: String,
}

/// A folder with the example models of the project and the files of a page.
pub struct Workshop {
    folder: tempfile::TempDir,
    summaries: HashMap<String, serde_json::Value>,
}

impl Workshop {
    pub fn of(page: &Page) -> Self {
        let folder = tempfile::tempdir().unwrap();
        copy(&root().join("models"), &folder.path().join("models"));
        for fence in &page.fences {
            if let Some(file) = fence.attribute("file").or(fence.attribute("study")) {
                std::fs::write(folder.path().join(file), &fence.text).unwrap();
            }
        }
        Self { folder, summaries: HashMap::new() }
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Runs `trilith …` in the folder.
    pub fn trilith(&self, line: &str) -> Printed {
        trilith_in(self.path(), &words(line))
    }

    /// The summary of one or more commands behind each other (`generate … && run …`); the same ones run once.
    pub fn summary(&mut self, commands: &str) -> &serde_json::Value {
        let folder = self.folder.path();
        self.summaries.entry(commands.to_owned()).or_insert_with(|| {
            let out = folder.join("summary");
            for command in commands.split("&&") {
                let mut arguments = words(command.trim());
                if arguments[0] == "run" {
                    arguments.extend(["--out".to_owned(), out.display().to_string()]);
                }
                let done = trilith_in(folder, &arguments);
                assert_eq!(done.status, 0, "trilith {command}\n{}", done.err);
            }
            let text = std::fs::read_to_string(out.join("summary.json")).unwrap();
            serde_json::from_str(&text).unwrap()
        })
    }
}

/// Runs the program.
pub fn trilith_in(folder: &Path, arguments: &[String]) -> Printed {
    let program = env!("CARGO_BIN_EXE_guide-trilith");
    let done = Command::new(program).current_dir(folder).args(arguments).output().unwrap();
    let text = |b: &[u8]| String::from_utf8_lossy(b).into_owned();
    Printed {
        status: done.status.code().unwrap_or(-1),
        out: text(&done.stdout),
        err: text(&done.stderr),
    }
}

/// The words of a command line; quotes hold blanks together, and in single ones double ones stand for themselves.
pub fn words(line: &str) -> Vec<String> {
    let (mut all, mut word, mut quoted) = (Vec::new(), String::new(), None);
    for c in line.chars() {
        match c {
            '"' | '\'' if quoted == Some(c) => quoted = None,
            '"' | '\'' if quoted.is_none() => quoted = Some(c),
            c if c.is_whitespace() && quoted.is_none() => {
                if !word.is_empty() {
                    all.push(std::mem::take(&mut word));
                }
            }
            c => word.push(c),
        }
    }
    assert!(quoted.is_none(), "quotes that do not end: {line}");
    if !word.is_empty() {
        all.push(word);
    }
    all
}

/// A value of a summary: `outputs.slide.max`, with `abs` for the largest magnitude of an output, `-` in front
/// for the other sign; times the factor of a unit.
pub fn value(summary: &serde_json::Value, key: &str) -> Result<f64, String> {
    let (sign, key) = key.strip_prefix('-').map_or((1.0, key), |rest| (-1.0, rest));
    let (path, unit) = key.rsplit_once(" in ").unwrap_or((key, "1"));
    let factor = match unit {
        "1" => 1.0,
        "mm" => 1e3,
        "cm" | "%" => 1e2,
        "kN" | "kJ" => 1e-3,
        "MN" => 1e-6,
        other => return Err(format!("{other} is no unit of a measured number")),
    };
    let parts: Vec<&str> = path.split('.').collect();
    let get = |parts: &[&str]| {
        parts.iter().try_fold(summary, |v, p| v.get(p)).and_then(serde_json::Value::as_f64)
    };
    let found = match parts.split_last() {
        Some((&"abs", front)) => {
            let end = |which| get(&[front, &[which]].concat());
            end("max").zip(end("min")).map(|(a, b)| a.abs().max(b.abs()))
        }
        _ => get(&parts),
    };
    found.map(|x| sign * factor * x).ok_or_else(|| format!("the summary has no number `{path}`"))
}

/// Share of a number that other widths of vectors may change: steps are chosen by comparison, a few round another way.
const ROUNDED: f64 = 1e-5;

/// True where a number as it is shown is that value, within one unit of its last digit; `≈`: within 5 %;
/// `0`: nothing but rounding.
pub fn shows(shown: &str, value: f64) -> bool {
    let shown = shown.trim().replace('−', "-");
    if let Some(about) = shown.strip_prefix('≈') {
        return about.trim().parse::<f64>().is_ok_and(|x| (x - value).abs() <= 0.05 * value.abs());
    }
    let Ok(number) = shown.parse::<f64>() else { return false };
    if shown == "0" {
        return value.abs() < 1e-6;
    }
    let (digits, power) = shown.split_once(['e', 'E']).unwrap_or((&shown, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, d)| d.len());
    let last = 10f64.powi(power.parse::<i32>().unwrap_or(0) - decimals as i32);
    // What rounding decides is far below the tolerance of a run (1e-4), but not always below the sixth digit.
    (number - value).abs() <= (last * (1.0 + 1e-9)).max(ROUNDED * value.abs())
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().map(Result::unwrap) {
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).unwrap();
        }
    }
}
