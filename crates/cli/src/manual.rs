//! What a shell and `man` are told of the program.

use crate::args::Arguments;
use crate::text::shown;
use crate::{Answer, Failure};
use clap::{Command, CommandFactory};
use clap_complete::Shell;
use std::path::Path;

/// Completions for a shell, to be printed.
pub(crate) fn completions(shell: Shell) -> Result<Answer, Failure> {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "trilith", &mut text);
    Ok(String::from_utf8_lossy(&text).into_owned().into())
}

/// A man page of the program and of each command, in a folder; pages of these names are replaced.
pub(crate) fn manual(dir: &Path) -> Result<Answer, Failure> {
    std::fs::create_dir_all(dir).map_err(|e| Failure::unwritable(dir, &e))?;
    let mut program = Arguments::command().disable_help_subcommand(true);
    program.build();
    let mut text = String::new();
    for command in std::iter::once(&program).chain(program.get_subcommands()) {
        let path = dir.join(page_name(command));
        let mut page = Vec::new();
        let page_of = clap_mangen::Man::new(command.clone());
        page_of
            .render(&mut page)
            .and_then(|()| std::fs::write(&path, page))
            .map_err(|e| Failure::unwritable(&path, &e))?;
        text.push_str(&format!("file: {}\n", shown(&path)));
    }
    Ok(text.into())
}

/// `trilith.1`, `trilith-run.1`.
fn page_name(command: &Command) -> String {
    format!("{}.1", command.get_display_name().unwrap_or(command.get_name()))
}
