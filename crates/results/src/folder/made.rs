//! Which files of a folder the program has made, and which command of it.

use super::OF_RUN;
use crate::{FileError, vtk};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path};

/// A line for each file: the command, a blank, its name.
const LIST: &str = ".trilith.files";
const RUN: &str = "run";

/// Files, and whose they are.
#[derive(Clone, Debug, Default)]
pub(super) struct Made(BTreeMap<String, String>);

impl Made {
    /// What a folder says of itself.
    pub fn read(dir: &Path) -> Self {
        let text = trilith_record::file::read_text(dir.join(LIST)).unwrap_or_default();
        let lines = text.lines().filter_map(|line| line.split_once(' '));
        let inside = lines.filter(|(_, name)| is_inside(name));
        let mut made = Self(inside.map(|(by, name)| (name.to_owned(), by.to_owned())).collect());
        // From before there were lists, or from a copy without hidden files.
        if !made.0.values().any(|by| by == RUN) && is_of_run(dir) {
            made.add(RUN, &of_run(dir));
        }
        made
    }

    /// Puts the list into the folder, at once; `staging`: a folder in it where nobody else looks.
    pub fn write(&self, staging: &Path) -> Result<(), FileError> {
        let text: String = self.0.iter().map(|(name, by)| format!("{by} {name}\n")).collect();
        let from = staging.join(LIST);
        let to = staging.with_file_name(LIST);
        fs::write(&from, text).and_then(|()| fs::rename(&from, &to)).map_err(FileError::at(&to))
    }

    /// The names of a command.
    pub fn of(&self, by: &str) -> impl Iterator<Item = &String> {
        self.0.iter().filter(move |(_, b)| *b == by).map(|(name, _)| name)
    }

    pub fn has(&self, by: &str, name: &str) -> bool {
        self.0.get(name).is_some_and(|b| b == by)
    }

    pub fn add(&mut self, by: &str, names: &[String]) {
        self.0.extend(names.iter().map(|name| (name.clone(), by.to_owned())));
    }

    pub fn forget(&mut self, names: &[String]) {
        self.0.retain(|name, _| !names.contains(name));
    }
}

/// True of a name that leads to nothing outside the folder, whoever wrote the list.
fn is_inside(name: &str) -> bool {
    Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}

/// True of a folder with the summary of a run.
fn is_of_run(dir: &Path) -> bool {
    #[derive(Deserialize)]
    struct Summary {
        #[serde(rename = "run_sha256")]
        _sum: String,
    }
    let text = trilith_record::file::read(dir.join(OF_RUN[0]));
    text.is_ok_and(|text| serde_json::from_slice::<Summary>(&text).is_ok())
}

/// The files there that a run with such a summary has made.
fn of_run(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> = OF_RUN.map(str::to_owned).to_vec();
    names.push("checkpoint.json".into());
    names.extend(frames(dir));
    names.retain(|name| dir.join(name).is_file());
    names
}

/// The files among those of a folder that may be frames of a run, by their names.
pub(super) fn frames(dir: &Path) -> Vec<String> {
    let all = fs::read_dir(dir.join(vtk::FRAMES)).into_iter().flatten().flatten();
    let names = all.filter_map(|entry| entry.file_name().into_string().ok());
    names.filter(|name| vtk::is_frame(name)).map(|name| format!("{}/{name}", vtk::FRAMES)).collect()
}
