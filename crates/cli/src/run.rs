//! `trilith run`.

use crate::args::RunArguments;
use crate::progress::Progress;
use crate::{Answer, Failure, case, diagnostics, read, report};
use std::path::{Path, PathBuf};
use trilith::solvers::EndState;
use trilith::{Analysis, Registry, Run, RunOptions};

/// Deformed shapes kept for ParaView.
const FRAMES: usize = 200;

pub(crate) fn run(registry: &Registry, args: RunArguments) -> Result<Answer, Failure> {
    let model = read(registry, &args.model)?;
    let case = case(&model, args.case.as_deref())?;
    let from = args.restart.as_deref().map(checkpoint).transpose()?;
    let frames = if args.no_files { 0 } else { FRAMES };
    let run = {
        let mut bar = Progress::new(&model.cases[case].name);
        let mut show = |share| bar.show(share);
        let options = RunOptions {
            case,
            solver: args.solver,
            dt: args.dt,
            until: args.checkpoint_at,
            from,
            progress: Some(&mut show),
        };
        Analysis::new(&model)
            .map(|a| a.with_frames(frames))
            .map(|a| if args.no_files { a.without_histories() } else { a })
            .and_then(|a| a.run(options))
            .map_err(|e| Failure::of(&e, &model))?
    };
    let summary = run.summary(&model);
    for w in &summary.warnings {
        eprint!("{}", diagnostics::warning(w));
    }
    let mut text = report::text(&model, &summary);
    if !args.no_files {
        let dir = args.out.unwrap_or_else(|| default_folder(&args.model.model));
        run.write(&model, &dir).map_err(|e| Failure::of(&e, &model))?;
        text += &format!("files: {}\n", dir.display());
        if args.checkpoint_at.is_some() {
            let path = dir.join("checkpoint.json");
            write_checkpoint(&path, &run)?;
            text += &format!("checkpoint: {}\n", path.display());
        }
    }
    let status = if run.result.status.is_good() {
        0
    } else {
        eprint!("{}", diagnostics::plain(&run.result.status.text(), None));
        1
    };
    Ok(Answer { text, status })
}

/// `out/<name of the model file>`.
fn default_folder(model: &Path) -> PathBuf {
    Path::new("out").join(model.file_stem().unwrap_or("model".as_ref()))
}

fn checkpoint(path: &Path) -> Result<EndState, Failure> {
    let refuse = |why: String| {
        let message = format!("the checkpoint {} cannot be read: {why}", path.display());
        Failure::input(&message, Some("`--checkpoint-at T` writes one"))
    };
    let text = std::fs::read_to_string(path).map_err(|e| refuse(e.to_string()))?;
    serde_json::from_str(&text).map_err(|e| refuse(e.to_string()))
}

fn write_checkpoint(path: &Path, run: &Run) -> Result<(), Failure> {
    serde_json::to_string(&run.result.end)
        .map_err(std::io::Error::from)
        .and_then(|text| std::fs::write(path, text))
        .map_err(|e| Failure::input(&format!("{} cannot be written: {e}", path.display()), None))
}
