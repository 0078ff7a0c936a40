//! `trilith export`: a case as a script for another program.

use crate::args::{ExportArguments, ScriptArguments};
use crate::text::shown;
use crate::{Answer, Failure, case, diagnostics, output, read};
use std::fs::{create_dir_all, write};
use std::path::Path;
use trilith::{Model, Registry};
use trilith_exchange::opensees::export::{Export, ExportError, ExportOptions, export as script};

/// Exit status where results of the script are not those of the model.
const DIFFERS: i32 = 1;

pub(crate) fn export(registry: &Registry, args: &ExportArguments) -> Result<Answer, Failure> {
    let model = read(registry, &args.model)?;
    let case = case(&model, args.case.as_deref())?;
    let stem = |path: &Path| path.file_stem().map(|s| s.to_string_lossy().into_owned());
    let stem = args.out.as_deref().and_then(stem);
    let stem = stem.or_else(|| stem_of(&model)).unwrap_or_else(|| "model".into());
    let made = scripted(&model, case, &args.script, 1, &stem)?;
    let status = if made.losses.matter() { DIFFERS } else { 0 };
    let report = report(&made);
    let Some(out) = &args.out else {
        output::tell(&report);
        return Ok(Answer { text: made.script, status });
    };
    if model.inputs().iter().any(|input| same(input, out)) {
        let message = format!("{} is what is read", shown(out));
        return Err(Failure::input(&message, Some("`--out FILE` names another file")));
    }
    if let Some(folder) = out.parent() {
        create_dir_all(folder).map_err(|e| Failure::unwritable(folder, &e))?;
    }
    write(out, &made.script).map_err(|e| Failure::unwritable(out, &e))?;
    Ok(Answer { text: format!("{report}\n{}\n", shown(out)), status })
}

fn stem_of(model: &Model) -> Option<String> {
    model.source.path.file_stem().map(|s| s.to_string_lossy().into_owned())
}

/// True where two paths lead to one file.
fn same(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// The script of a case, with so many steps in an output step unless the arguments say others.
pub(crate) fn scripted(
    model: &Model,
    case: usize,
    args: &ScriptArguments,
    substeps: usize,
    stem: &str,
) -> Result<Export, Failure> {
    let file = model.source.path.file_name().map(|n| n.to_string_lossy().into_owned());
    let options = ExportOptions {
        substeps: args.substeps.unwrap_or(substeps),
        near: args.near,
        leave_out: args.leave_out,
        file: file.unwrap_or_default(),
        stem: stem.into(),
    };
    script(model, case, &options).map_err(|error| match &error {
        ExportError::Refused(losses) => {
            output::tell(&losses.text());
            let help = "`--near` writes the nearest law where there is one, `--leave-out` leaves out what is named above";
            Failure::input(&error.to_string(), Some(help))
        }
        _ => Failure::input(&error.to_string(), None),
    })
}

/// What was written and what was not.
pub(crate) fn report(made: &Export) -> String {
    let counts: Vec<String> = made.written.iter().map(|(kind, n)| format!("{n} {kind}")).collect();
    let losses = made.losses.text();
    let space = if losses.is_empty() { "" } else { "\n" };
    format!("written: {}\n{space}{losses}", counts.join(", "))
}

/// A warning for results that are not those of the model.
pub(crate) fn warned(made: &Export) {
    for loss in made.losses.left_out.iter().map(|l| format!("left out: {}", l.line())) {
        output::tell(&diagnostics::warning(&loss));
    }
    for loss in made.losses.near.iter().map(|l| format!("near, not equal: {}", l.line())) {
        output::tell(&diagnostics::warning(&loss));
    }
}
