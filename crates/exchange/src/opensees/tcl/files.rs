//! What reaches for files and programs: `source` within the folder of the script, and nothing else.

use super::interpreter::{Interpreter, Outcome};
use super::value::Value;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use trilith_model::Source;

/// Longest file that is read, in bytes.
const LONGEST: u64 = 50_000_000;

type Command = fn(&mut Interpreter<'_>, &[Value]) -> Outcome;

/// A command of files and programs.
pub fn find(name: &str) -> Option<Command> {
    Some(match name {
        "source" => source,
        "puts" | "flush" => |i, w| told(i, w, "what a script prints is left out"),
        "close" => |i, w| told(i, w, "no file is open"),
        "file" => file,
        "open" => open,
        "clock" => |i, w| {
            told(i, w, "the time of day is 0 here: the same script gives the same model")?;
            Ok(Value::new("0"))
        },
        "exec" | "socket" | "cd" | "glob" | "fconfigure" | "gets" | "read" | "seek" | "after"
        | "vwait" | "interp" | "namespace" | "package" | "uplevel" | "rename" | "trace"
        | "subst" | "regexp" | "regsub" | "scan" | "dict" | "time" | "update" | "pwd"
        | "unknown" => refused,
        _ => return None,
    })
}

fn told(i: &mut Interpreter<'_>, w: &[Value], what: &str) -> Outcome {
    let line = i.line();
    i.host.left_out(w[0].str(), what, &line);
    Ok(Value::empty())
}

fn refused(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    let name = w[0].str();
    if name == "package" || name == "update" {
        return told(i, w, "nothing is loaded");
    }
    if name == "pwd" {
        return Ok(Value::new("."));
    }
    let what = match name {
        "exec" | "socket" => "an import runs no programs and opens no connections",
        "gets" | "read" | "seek" | "fconfigure" | "glob" | "cd" => {
            "an import reads scripts by `source` and records by `timeSeries Path -filePath`, nothing else"
        }
        _ => "this command of Tcl is not among those that an import knows",
    };
    Err(i.wrong(&format!("`{name}` is not executed"), what))
}

fn open(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    if w.get(2).is_some_and(|mode| mode.str().starts_with(['w', 'a'])) {
        told(i, w, "an import writes no files of the script")?;
        return Ok(Value::new("file"));
    }
    Err(i.wrong(
        "`open` is not executed",
        "records are read by `timeSeries Path -filePath`, scripts by `source`",
    ))
}

/// A file in the folder of the script or below it.
pub fn within(folder: Option<&Path>, name: &str) -> Result<PathBuf, String> {
    let folder = folder.ok_or("there is no folder to read files from")?;
    let all = folder
        .canonicalize()
        .map_err(|e| format!("the folder of the script cannot be read: {e}"))?;
    let path = all.join(name.replace('\\', "/"));
    let path = path.canonicalize().map_err(|e| format!("`{name}` cannot be read: {e}"))?;
    if !path.starts_with(&all) {
        return Err(format!("`{name}` lies outside of the folder of the script"));
    }
    match std::fs::metadata(&path) {
        Ok(m) if m.is_file() && m.len() <= LONGEST => Ok(path),
        Ok(m) if m.is_file() => Err(format!("`{name}` is longer than 50 MB")),
        _ => Err(format!("`{name}` is no file")),
    }
}

fn source(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, 1, "source file")?;
    let path = within(i.settings.folder.as_deref(), w[1].str())
        .map_err(|e| i.wrong_at(1, &e, "a file in the folder of the script, or below it"))?;
    let own = i
        .settings
        .folder
        .as_deref()
        .map(|f| f.join(i.sources[0].path.file_name().map(PathBuf::from).unwrap_or_default()));
    let own = own.and_then(|p| p.canonicalize().ok());
    if i.reading.contains(&path) || own.as_ref() == Some(&path) {
        let message = format!("`{}` is being read already: it reads itself", w[1].str());
        return Err(i.wrong_at(1, &message, ""));
    }
    let bytes = std::fs::read(&path)
        .map_err(|e| i.wrong_at(1, &format!("`{}` cannot be read: {e}", w[1].str()), ""))?;
    let text: String = match String::from_utf8(bytes) {
        Ok(text) => text,
        Err(e) => e.into_bytes().into_iter().map(char::from).collect(),
    };
    i.bounded(text.len())?;
    let shown = PathBuf::from(w[1].str());
    i.sources.push(Arc::new(Source { path: shown, text: text.clone(), sha256: String::new() }));
    i.reading.push(path);
    let script = Value { text: Rc::new(text), origin: Some((i.sources.len() - 1, 0)) };
    let out = i.evaluate(&script);
    i.reading.pop();
    match out {
        Err(super::interpreter::Flow::Return(value)) => Ok(value),
        other => other,
    }
}

fn file(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, usize::MAX, "file join|dirname|tail|… name")?;
    let text = w.get(2).map_or("", |v| v.str());
    let path = Path::new(text);
    let part = |p: Option<&std::ffi::OsStr>| {
        p.map(|p| p.to_string_lossy().into_owned()).unwrap_or_default()
    };
    match w[1].str() {
        "join" => {
            let parts: Vec<&str> = w[2..].iter().map(|v| v.str()).collect();
            Ok(Value::new(parts.join("/")))
        }
        "dirname" => {
            let parent =
                path.parent().map(|p| p.to_string_lossy().into_owned()).unwrap_or_default();
            Ok(Value::new(if parent.is_empty() { ".".to_owned() } else { parent }))
        }
        "tail" => Ok(Value::new(part(path.file_name()))),
        "rootname" => Ok(Value::new(path.with_extension("").to_string_lossy().into_owned())),
        "extension" => {
            let end = part(path.extension());
            Ok(Value::new(if end.is_empty() { end } else { format!(".{end}") }))
        }
        "normalize" => Ok(w.get(2).cloned().unwrap_or_else(Value::empty)),
        "exists" | "isfile" | "readable" => {
            let found = within(i.settings.folder.as_deref(), text).is_ok();
            Ok(Value::new(if found { "1" } else { "0" }))
        }
        "mkdir" => told(i, w, "an import makes no folders of the script"),
        other => {
            Err(i.wrong(&format!("`file {other}` is not executed"), "an import changes no files"))
        }
    }
}
