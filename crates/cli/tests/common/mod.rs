//! What tests of the program share.

use assert_cmd::Command;
use std::path::Path;

/// Exit status, stdout, stderr.
pub fn trilith(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    let output = command.current_dir(folder).args(args).output().unwrap();
    let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}
