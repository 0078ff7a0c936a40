//! `trilith import`: models of other programs.

use crate::args::ImportArguments;
use crate::diagnostics;
use crate::text::shown;
use crate::{Answer, Failure};
use std::fs::{create_dir_all, write};
use std::path::Path;
use trilith::Analysis;
use trilith::solvers::LinkStiffness;
use trilith_exchange::opensees::Eigenvalues;
use trilith_exchange::{Import, Options, etabs, opensees, sap2000};

/// Exit status where something that changes results was lost.
const LOST: i32 = 1;

/// Longest file that is read, in bytes.
const LONGEST: u64 = 500_000_000;

pub(crate) fn import(args: &ImportArguments) -> Result<Answer, Failure> {
    let bytes = content(&args.file)?;
    let stem = |path: &Path| path.file_stem().map(|s| s.to_string_lossy().into_owned());
    let options = Options {
        path: args.file.clone(),
        folder: args
            .file
            .parent()
            .map(|p| if p.as_os_str().is_empty() { ".".into() } else { p.into() }),
        stem: args.out.as_deref().and_then(stem).unwrap_or_else(|| "model".into()),
        case: args.case.clone(),
        units: args.units.clone(),
        ..Options::default()
    };
    let import = read(&bytes, &options)?;
    let losses = import.report.losses();
    let status = if losses == 0 { 0 } else { LOST };
    let report = import.report.text();
    let warned = || {
        if losses > 0 {
            let message = format!("{losses} losses change results; the report names them");
            crate::output::tell(&diagnostics::warning(&message));
        }
    };
    if !import.is_model() {
        crate::output::tell(&report);
        let message = format!("{} has no element that can be written", shown(&args.file));
        return Err(Failure::input(&message, Some("the report above names what was lost")));
    }
    let Some(out) = &args.out else {
        crate::output::tell(&report);
        warned();
        return Ok(Answer { text: import.draft.to_ron(), status });
    };
    if let Some(folder) = out.parent() {
        create_dir_all(folder).map_err(|e| Failure::unwritable(folder, &e))?;
    }
    let beside = |name: &str| out.with_file_name(name);
    let mut files = vec![(out.clone(), import.draft.to_ron())];
    files.push((beside(&format!("{}.import.txt", options.stem)), report.clone()));
    files.extend(import.files.into_iter().map(|(name, text)| (beside(&name), text)));
    if let Some((path, _)) = files.iter().find(|(path, _)| same(path, &args.file)) {
        let message = format!("{} is what is read", shown(path));
        return Err(Failure::input(&message, Some("`--out FILE` names another file")));
    }
    for (path, text) in &files {
        write(path, text).map_err(|e| Failure::unwritable(path, &e))?;
    }
    warned();
    let written: String = files.iter().map(|(path, _)| format!("{}\n", shown(path))).collect();
    Ok(Answer { text: format!("{report}\n{written}"), status })
}

/// Reads a file by its ending.
fn read(bytes: &[u8], options: &Options) -> Result<Import, Failure> {
    let end = options.path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let import = match end.as_deref() {
        Some("tcl") => opensees::import(bytes, options, &Modes),
        Some("py") => {
            let message =
                format!("{} is a script in Python, which is not run", shown(&options.path));
            return Err(Failure::input(
                &message,
                Some(
                    "`python -m trilith.opensees script.py --out model.ron` runs it in the Python of the package `trilith` and records its commands; scripts in Tcl (`.tcl`) are read here",
                ),
            ));
        }
        _ if options.units.is_some() => {
            let help = "it says its own; a script of OpenSees (`.tcl`) has none";
            return Err(Failure::input(
                "`--units` of a text model of SAP2000 or ETABS",
                Some(help),
            ));
        }
        Some("e2k" | "$et") => etabs::import(bytes, options),
        _ => sap2000::import(bytes, options),
    };
    import.map_err(|e| Failure::diagnostics(&e.0))
}

/// Modes that a script asks for, with links by their tangents.
struct Modes;

impl Eigenvalues for Modes {
    fn eigenvalues(
        &self,
        model: &str,
        after: Option<&str>,
        count: usize,
    ) -> Result<Vec<f64>, String> {
        let read = trilith::read_text(model, "model.ron", &trilith::registry(), &[]);
        let model =
            read.map_err(|all| all.first().map_or_else(String::new, |e| e.message.clone()))?;
        let after = after.and_then(|name| model.case(name));
        let analysis = Analysis::new(&model).map_err(|e| e.to_string())?;
        let linear =
            analysis.linearised(&LinkStiffness::Tangent, after).map_err(|e| e.to_string())?;
        let modes = linear.modes(count).map_err(|e| e.to_string())?;
        Ok(modes.omega2)
    }
}

fn content(path: &Path) -> Result<Vec<u8>, Failure> {
    let unreadable =
        |why: &str| Failure::input(&format!("{} cannot be read: {why}", shown(path)), None);
    let size = std::fs::metadata(path).map_err(|e| unreadable(&e.to_string()))?.len();
    if size > LONGEST {
        return Err(unreadable("it is longer than 500 MB"));
    }
    std::fs::read(path).map_err(|e| unreadable(&e.to_string()))
}

/// True where two paths lead to one file.
fn same(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}
