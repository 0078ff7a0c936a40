//! `trilith view`: a page with a model, or a study of one, and the engine in it.

use crate::args::ViewArguments;
use crate::text::shown;
use crate::{Answer, Failure, browser, case, made_by, path, read, study_folder, sweep};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use trilith::model::file::Kind;
use trilith::{Model, Registry};
use trilith_live::{Live, page};
use trilith_study::{How, Part, Study, charts};

/// The engine as cargo names it, and where cargo puts it, as seen from the folder of the program.
const ENGINE: &str = "trilith_live.wasm";
const BUILT: &str = "../wasm32-unknown-unknown/live/trilith_live.wasm";
const HOW: &str = "the engine for pages is made by `rustup target add wasm32-unknown-unknown` and \
    `RUSTFLAGS=-Ctarget-feature=+simd128 cargo rustc --profile live -p trilith-live --crate-type cdylib --target \
    wasm32-unknown-unknown`; it is looked for beside the program, and named by `--engine FILE`";
/// First bytes of every WebAssembly module.
const MAGIC: &[u8] = b"\0asm";

pub(crate) fn view(registry: &Registry, args: &ViewArguments) -> Result<Answer, Failure> {
    if is_study(path(&args.model)) {
        return study(registry, args);
    }
    if let Some(folder) = &args.runs {
        let message = format!("there are no runs of a model in {}", shown(folder));
        return Err(Failure::input(&message, Some("`--runs` goes with a study")));
    }
    let model = read(registry, &args.model)?;
    if let Some(name) = &args.case {
        case(&model, Some(name))?;
    }
    let engine = engine(args.engine.as_deref())?;
    let name = model.source.path.file_name().unwrap_or_default().to_string_lossy();
    let title = if model.title.is_empty() { &*name } else { &model.title };
    let live = Live {
        title,
        path: &name,
        text: &model.source.text,
        files: files(&model, &[])?,
        set: &args.model.set,
        case: args.case.as_deref(),
        solver: None,
        charts: None,
        engine: &engine,
    };
    write(args, &live, &name)
}

/// A study: its charts with a cursor, and the run where this is.
fn study(registry: &Registry, args: &ViewArguments) -> Result<Answer, Failure> {
    let file = path(&args.model);
    let mut study =
        Study::read(file, registry, &args.model.set).map_err(|e| Failure::diagnostics(&e))?;
    study.identity.build += &crate::laws::digest()?;
    if args.case.is_some() {
        let help = "leave `--case` out: the study says which case it runs";
        return Err(Failure::input("a study has a case of its own", Some(help)));
    }
    if study.figures.is_empty() {
        let help = "`figures: [Points(x: \"mu\", y: \"slide\")]` in the study file asks for one";
        return Err(Failure::input("the study has no figures to ask", Some(help)));
    }
    let engine = engine(args.engine.as_deref())?;
    let stem = file.file_stem().unwrap_or("study".as_ref());
    let folder = args.runs.clone().unwrap_or_else(|| Path::new("out").join(stem));
    study_folder::look(&study, &folder, &[])?;
    let inputs = made_by::Inputs::of_study(&study)?;
    let how = How { threads: sweep::cores(), part: Part::All, retry_failed: false, store: None };
    let results = sweep::executed(&study, registry, &folder, how)?;
    made_by::write_study(&folder, &inputs, &args.model.set, &study)?;
    let model = study.model_of(registry, 0).map_err(|e| Failure::diagnostics(&e))?;
    let name = model.source.path.file_name().unwrap_or_default().to_string_lossy();
    let solver = study.solver();
    let charts = charts(&study, &results.records.rows());
    let title = if study.title.is_empty() { &*name } else { &study.title };
    let live = Live {
        title,
        path: &name,
        text: &model.source.text,
        files: files(&model, &study.files)?,
        set: &study.plan.fixed,
        case: study.case_named(),
        solver: solver.map(|s| s.name()),
        charts: Some(&charts),
        engine: &engine,
    };
    write(args, &live, &file.file_name().unwrap_or_default().to_string_lossy())
}

/// True for a file that names a model to run.
fn is_study(file: &Path) -> bool {
    let Ok(text) = trilith::record::file::read_text(file) else { return false };
    let Ok((_, root)) = trilith::model::file::parse(&text, file) else { return false };
    let (Kind::Fields(_, entries) | Kind::Map(entries)) = &root.kind else { return false };
    entries.iter().any(|e| e.key == "model")
}

fn write(args: &ViewArguments, live: &Live<'_>, name: &str) -> Result<Answer, Failure> {
    let out = args.out.clone().unwrap_or_else(|| Path::new(name).with_extension("html"));
    let written = page(live).and_then(|page| std::fs::write(&out, page));
    written.map_err(|e| Failure::unwritable(&out, &e))?;
    browser::show(args.open, &out);
    Ok(format!("page: {}\n", shown(&out)).into())
}

/// The other files of a model, and more that its runs read: text by path, as seen from its folder.
fn files(model: &Model, more: &[PathBuf]) -> Result<BTreeMap<String, String>, Failure> {
    let folder = model.source.path.parent().unwrap_or(Path::new(""));
    let mut files = BTreeMap::new();
    for path in model.inputs().iter().skip(1).chain(more) {
        let text = trilith::record::file::read_text(path).map_err(|e| {
            let message = format!("{} cannot be read: {e}", shown(path));
            Failure::input(&message, Some("a page carries files of text alone"))
        })?;
        let short = path.strip_prefix(folder).unwrap_or(path);
        files.insert(short.to_string_lossy().into_owned(), text);
    }
    Ok(files)
}

fn engine(given: Option<&Path>) -> Result<Vec<u8>, Failure> {
    let beside = || {
        let program = std::env::current_exe().ok()?;
        let folder = program.parent()?;
        [ENGINE, BUILT].map(|name| folder.join(name)).into_iter().find(|path| path.is_file())
    };
    let path: PathBuf = match given {
        Some(path) => path.to_owned(),
        None => beside()
            .ok_or_else(|| Failure::input("there is no engine for pages here", Some(HOW)))?,
    };
    let engine = trilith::record::file::read(&path)
        .map_err(|e| Failure::input(&format!("{} cannot be read: {e}", shown(&path)), Some(HOW)))?;
    if !engine.starts_with(MAGIC) {
        let message = format!("{} is no WebAssembly module", shown(&path));
        return Err(Failure::input(&message, Some(HOW)));
    }
    Ok(engine)
}
