//! `trilith watch`: runs a model again whenever it, or a file that it reads, is saved; an open page follows.
//!
//! Beside the folder of the results there is a script of one line, `FOLDER.watch.js`, which says when the last run ended and
//! what was wrong with it. The page of a run that was opened as `report.html#watch` reads it several times a second, loads
//! itself again when there is something newer, and shows the error where there is one. No server, no network.

use crate::args::{RunArguments, WatchArguments};
use crate::interrupt::{self, INTERRUPTED};
use crate::text::shown;
use crate::{Answer, Failure, browser, output, path, read, run};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::Thread;
use std::time::{Duration, SystemTime, UNIX_EPOCH};
use trilith::Registry;

/// How often files are looked at.
const LOOK: Duration = Duration::from_millis(100);

/// When a file was written, and its length; none where it is not there.
type Stamp = Option<(SystemTime, u64)>;

fn stamps(files: &[PathBuf]) -> Vec<Stamp> {
    let of = |file: &PathBuf| {
        let of = std::fs::metadata(file).ok()?;
        Some((of.modified().ok()?, of.len()))
    };
    files.iter().map(of).collect()
}

pub(crate) fn watch(registry: &Registry, args: &WatchArguments) -> Result<Answer, Failure> {
    let of = &args.run;
    let file = path(&of.model);
    if !file.is_file() {
        let message = format!("{} is no file that can be watched", shown(file));
        return Err(Failure::input(&message, Some("name a model file")));
    }
    if of.no_files || of.no_report || of.restart.is_some() || of.checkpoint_at.is_some() {
        let help =
            "leave `--no-files`, `--no-report`, `--restart` and `--checkpoint-at` to `trilith run`";
        return Err(Failure::input("what is watched is a whole run with its page", Some(help)));
    }
    let folder = of.out.clone().unwrap_or_else(|| run::default_folder(of, None));
    let mut files = vec![file.to_owned()];
    let mut opened = !of.open;
    loop {
        // A file that is saved while it is read, or while the run goes on, makes another one.
        let mut before = stamps(&files);
        if let Ok(model) = read(registry, &of.model) {
            let inputs = model.inputs();
            if inputs != files {
                files = inputs;
                before = stamps(&files);
            }
        }
        let Some(failure) = unless_saved(&files, &before, |stale| once(registry, of, stale))?
        else {
            output::tell("saved while it ran: it begins again\n");
            continue;
        };
        let tick = tick(&folder, failure.as_deref())?;
        let page = folder.join("report.html");
        if !opened && page.is_file() {
            browser::open(&page, "#watch")?;
            opened = true;
        }
        output::tell(&format!(
            "{} watched (Ctrl-C ends it); {}#watch follows by {}\n",
            match &files[..] {
                [one] => format!("{} is", shown(one)),
                [one, others @ ..] =>
                    format!("{} and {} files that it reads are", shown(one), others.len()),
                [] => String::new(),
            },
            shown(&page),
            shown(&tick),
        ));
        while stamps(&files) == before {
            std::thread::sleep(LOOK);
        }
    }
}

/// Does something, for which a flag becomes true as soon as one of the files is another than before, or somebody wants an
/// end.
fn unless_saved<T>(files: &[PathBuf], before: &[Stamp], work: impl FnOnce(&AtomicBool) -> T) -> T {
    /// Ends the looking, however the work has ended.
    struct Over<'a>(&'a AtomicBool, Thread);
    impl Drop for Over<'_> {
        fn drop(&mut self) {
            self.0.store(true, Ordering::SeqCst);
            self.1.unpark();
        }
    }
    let (stale, over) = (AtomicBool::new(false), AtomicBool::new(false));
    std::thread::scope(|scope| {
        let look = scope.spawn(|| {
            while !over.load(Ordering::SeqCst) {
                if interrupt::is_wanted() || stamps(files) != before {
                    stale.store(true, Ordering::SeqCst);
                }
                std::thread::park_timeout(LOOK);
            }
        });
        let _over = Over(&over, look.thread().clone());
        work(&stale)
    })
}

/// One run, told as `trilith run` tells it, with what is wrong where something is; none where it became stale.
///
/// # Errors
/// Somebody wants an end.
fn once(
    registry: &Registry,
    of: &RunArguments,
    stale: &AtomicBool,
) -> Result<Option<Option<String>>, Failure> {
    match run::run(registry, RunArguments { open: false, ..of.clone() }, Some(stale)) {
        Ok(None) => Ok(None),
        Ok(Some(Answer { text, status })) if status == INTERRUPTED => {
            output::print(&text, status);
            Err(Failure { text: String::new(), status })
        }
        Ok(Some(Answer { text, status })) => {
            output::print(&text, status);
            Ok(Some(None))
        }
        Err(failure) if failure.status == INTERRUPTED => Err(failure),
        Err(failure) => {
            output::tell(&failure.text);
            Ok(Some(Some(failure.text)))
        }
    }
}

/// Says to open pages that a run has ended now.
fn tick(folder: &Path, failure: Option<&str>) -> Result<PathBuf, Failure> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let file = folder.with_file_name(format!("{name}.watch.js"));
    let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |d| d.as_millis());
    // `<` of a text ends no script element here, yet nothing is lost by writing it so.
    let failure = serde_json::to_string(&failure).unwrap_or_default().replace('<', "\\u003c");
    let unwritable = |e: std::io::Error| Failure::unwritable(&file, &e);
    if let Some(above) = file.parent() {
        std::fs::create_dir_all(above).map_err(unwritable)?;
    }
    std::fs::write(&file, format!("trilithWatch({now}, {failure});\n")).map_err(unwritable)?;
    Ok(file)
}
