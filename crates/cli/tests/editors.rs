//! The language server in real editors, started with the lines that the guide gives. Skipped with a message where an
//! editor is not on the PATH.

use std::path::{Path, PathBuf};
use std::process::Command;

const GUIDE: &str = include_str!("../../guide/src/editors.md");
const MODEL: &str = include_str!("../../../models/rigid_block.ron");

fn on_path(name: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(name).is_file())
}

/// The lines for an editor: the last block of its language.
fn settings(language: &str) -> &'static str {
    let (_, block) = GUIDE.rsplit_once(&format!("```{language}\n")).expect("a block of the guide");
    block.split_once("```").expect("its end").0
}

/// A folder with a model that has a wrong field, and the line where that is.
fn folder() -> (tempfile::TempDir, usize) {
    let folder = tempfile::tempdir().unwrap();
    let wrong = MODEL.replacen("NLink(kn:", "NLink(kq:", 1);
    std::fs::write(folder.path().join("model.ron"), &wrong).unwrap();
    let line = wrong.lines().position(|line| line.contains("kq:")).expect("the wrong field");
    (folder, line + 1)
}

/// What a driver tells, with the program on the path.
fn told(editor: &mut Command, folder: &Path) -> String {
    let program = PathBuf::from(env!("CARGO_BIN_EXE_trilith"));
    let own = program.parent().unwrap().to_owned();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths([own].into_iter().chain(std::env::split_paths(&path))).unwrap();
    let done = editor.current_dir(folder).env("PATH", path).output().unwrap();
    let told = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(done.status.success(), "{told}\n{}", String::from_utf8_lossy(&done.stderr));
    told
}

fn holds(told: &str, line: usize) {
    let starts = |text: &str| told.lines().any(|l| l.starts_with(text));
    let wrong = told.lines().find(|l| l.starts_with(&format!("wrong {line} ")));
    assert!(wrong.is_some_and(|l| l.contains("no field `kq`") && l.contains("`kn`")), "{told}");
    assert!(starts("hover **NLink**"), "{told}");
    for name in ["kn", "mu_slow", "axis1"] {
        assert!(told.lines().any(|l| l == format!("completion {name}")), "{name}: {told}");
    }
    // The feet use the set of properties in which the wrong field is.
    assert!(told.lines().any(|l| l == format!("definition {line}")), "{told}");
    assert!(starts("outline elements"), "{told}");
    assert!(told.lines().any(|l| l == "left 0"), "{told}");
}

#[test]
fn neovim_shows_completes_and_explains_a_model() {
    if !on_path("nvim") {
        eprintln!("skipped: no nvim on the PATH");
        return;
    }
    let (folder, line) = folder();
    let init = folder.path().join("init.lua");
    std::fs::write(&init, settings("lua")).unwrap();
    let driver = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/editors/neovim.lua");
    let mut editor = Command::new("nvim");
    editor.args(["--headless", "-u"]).arg(&init);
    // An error in the lines leaves the editor open.
    editor.args(["-c", &format!("luafile {driver}"), "-c", "cq"]);
    holds(&told(&mut editor, folder.path()), line);
}

#[test]
fn emacs_shows_completes_and_explains_a_model() {
    if !on_path("emacs") {
        eprintln!("skipped: no emacs on the PATH");
        return;
    }
    let (folder, line) = folder();
    let init = folder.path().join("init.el");
    std::fs::write(&init, settings("elisp")).unwrap();
    let driver = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/editors/emacs.el");
    let mut editor = Command::new("emacs");
    editor.args(["--batch", "-l"]).arg(&init).args(["-l", driver]);
    holds(&told(&mut editor, folder.path()), line);
}
