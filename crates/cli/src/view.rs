//! `trilith view`: a page with the model and the engine in it.

use crate::args::ViewArguments;
use crate::text::shown;
use crate::{Answer, Failure, browser, case, read};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use trilith::{Model, Registry};
use trilith_live::{Live, page};

/// The engine as cargo names it, and where cargo puts it, as seen from the folder of the program.
const ENGINE: &str = "trilith_live.wasm";
const BUILT: &str = "../wasm32-unknown-unknown/live/trilith_live.wasm";
const HOW: &str = "the engine for pages is made by `rustup target add wasm32-unknown-unknown` and \
    `RUSTFLAGS=-Ctarget-feature=+simd128 cargo rustc --profile live -p trilith-live --crate-type cdylib --target \
    wasm32-unknown-unknown`; it is looked for beside the program, and named by `--engine FILE`";
/// First bytes of every WebAssembly module.
const MAGIC: &[u8] = b"\0asm";

pub(crate) fn view(registry: &Registry, args: &ViewArguments) -> Result<Answer, Failure> {
    let model = read(registry, &args.model)?;
    if let Some(name) = &args.case {
        case(&model, Some(name))?;
    }
    let engine = engine(args.engine.as_deref())?;
    let path = &model.source.path;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let title = if model.title.is_empty() { &*name } else { &model.title };
    let live = Live {
        title,
        path: &name,
        text: &model.source.text,
        files: files(&model)?,
        set: &args.model.set,
        case: args.case.as_deref(),
        engine: &engine,
    };
    let out = args.out.clone().unwrap_or_else(|| Path::new(&*name).with_extension("html"));
    let written = page(&live).and_then(|page| std::fs::write(&out, page));
    written.map_err(|e| Failure::unwritable(&out, &e))?;
    browser::show(args.open, &out);
    Ok(format!("page: {}\n", shown(&out)).into())
}

/// The other files of a model: text by path, as seen from its folder.
fn files(model: &Model) -> Result<BTreeMap<String, String>, Failure> {
    let folder = model.source.path.parent().unwrap_or(Path::new(""));
    let mut files = BTreeMap::new();
    for path in model.inputs().into_iter().skip(1) {
        let text = trilith::record::file::read_text(&path).map_err(|e| {
            let message = format!("{} cannot be read: {e}", shown(&path));
            Failure::input(&message, Some("a page carries files of text alone"))
        })?;
        let short = path.strip_prefix(folder).unwrap_or(&path);
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
