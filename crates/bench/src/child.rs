//! Measurements in processes of their own, so that each has its own peak of memory.

use serde::de::DeserializeOwned;
use std::path::Path;
use std::process::{Command, Stdio};

/// Runs a program on one thread and reads the last line of its output that is JSON.
///
/// # Errors
/// A sentence where it cannot be started, fails, or says something else.
pub fn json<T: DeserializeOwned>(program: &Path, arguments: &[String]) -> Result<T, String> {
    let name = program.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut command = Command::new(program);
    for threads in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"] {
        command.env(threads, "1");
    }
    let output = command
        .args(arguments)
        .stderr(Stdio::piped())
        .output()
        .map_err(|e| format!("{name} cannot be started: {e}"))?;
    let said = String::from_utf8_lossy(&output.stdout);
    if !output.status.success() {
        let complaint = String::from_utf8_lossy(&output.stderr);
        let last = complaint.trim().lines().last().unwrap_or("it says nothing").to_owned();
        return Err(format!("{name} {} failed: {last}", arguments.join(" ")));
    }
    said.lines()
        .rev()
        .find(|l| l.starts_with('{'))
        .ok_or_else(|| format!("{name} {} gave no result", arguments.join(" ")))
        .and_then(|l| {
            serde_json::from_str(l).map_err(|e| format!("the result of {name} cannot be read: {e}"))
        })
}
