//! `trilith new`: a model to begin with, out of those that come with the program.

use crate::args::NewArguments;
use crate::text::{names_help, row, shown, table};
use crate::{Answer, Failure};
use std::io::Write;
use std::path::{Path, PathBuf};

/// A model with the records that it reads.
struct Template {
    name: &'static str,
    text: &'static str,
    /// Paths from the folder of the model, and what is in them.
    files: &'static [(&'static str, &'static str)],
}

macro_rules! template {
    ($name:literal $(, $file:literal)*) => {
        Template {
            name: $name,
            text: include_str!(concat!(env!("TRILITH_MODELS"), "/", $name, ".ron")),
            files: &[$(($file, include_str!(concat!(env!("TRILITH_MODELS"), "/", $file)))),*],
        }
    };
}

const TEMPLATES: [Template; 16] = [
    template!("rigid_block"),
    template!("rigid_block_record", "records/synthetic_040g.csv"),
    template!("rigid_block_drop"),
    template!("rigid_block_rocking"),
    template!("rocking_body"),
    template!("rolling_cask"),
    template!("storage_cask", "records/synthetic_6.csv"),
    template!("cask_row", "records/synthetic_6.csv"),
    template!("cabinet", "records/synthetic_6.csv"),
    template!("isolated_frame"),
    template!("isolated_building", "records/synthetic_1.csv"),
    template!("floor_spectra"),
    template!("damped_frame", "records/synthetic_1.csv"),
    template!("pounding_frames"),
    template!(
        "portal_frame",
        "sections/steel.ron",
        "records/synthetic_1.csv",
        "records/synthetic_2.csv",
        "records/synthetic_3.csv"
    ),
    template!(
        "rocking_wall",
        "superelements/wall_k.mtx",
        "superelements/wall_m.mtx",
        "superelements/wall_rows.csv"
    ),
];

impl Template {
    /// What the first lines of its text say that it is.
    fn summary(&self) -> String {
        let lines = self.text.lines().map_while(|line| line.strip_prefix("//").map(str::trim));
        lines.take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
    }
}

/// Writes a model and its records, or lists the models.
pub(crate) fn new(args: &NewArguments) -> Result<Answer, Failure> {
    let Some(name) = &args.template else { return Ok(list().into()) };
    let template = TEMPLATES.iter().find(|t| t.name == name).ok_or_else(|| {
        let help = names_help(name, "models", TEMPLATES.iter().map(|t| t.name));
        Failure::input(&format!("there is no model `{name}` to begin with"), Some(&help))
    })?;
    let path = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.ron")));
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut told = String::new();
    write(&path, template.text)?;
    for (file, content) in template.files {
        let path = folder.join(file);
        // Several models share a record.
        if trilith::record::file::read_text(&path).is_ok_and(|there| there == *content) {
            continue;
        }
        write(&path, content)?;
        told += &format!("record: {}\n", shown(&path));
    }
    let run = format!("trilith run {}", shown(&path));
    Ok(format!("model: {}\n{told}{}\nrun it: {run}\n", shown(&path), template.summary()).into())
}

fn list() -> String {
    let rows = TEMPLATES.iter().map(|t| row([t.name, &t.summary()]));
    let rows: Vec<_> = std::iter::once(row(["model", "what it is"])).chain(rows).collect();
    table(&rows, &[0, 1]) + "\n`trilith new MODEL` writes one into this folder.\n"
}

/// Writes a file where there is none.
fn write(path: &Path, text: &str) -> Result<(), Failure> {
    let cannot = |error: std::io::Error| {
        if error.kind() == std::io::ErrorKind::AlreadyExists {
            let help = "give the model another name or place by `--out FILE`";
            return Failure::input(&format!("{} is there already", shown(path)), Some(help));
        }
        Failure::unwritable(path, &error)
    };
    if let Some(folder) = path.parent().filter(|folder| *folder != Path::new("")) {
        std::fs::create_dir_all(folder).map_err(|e| Failure::unwritable(folder, &e))?;
    }
    let mut file = std::fs::File::create_new(path).map_err(cannot)?;
    file.write_all(text.as_bytes()).map_err(|e| Failure::unwritable(path, &e))
}
