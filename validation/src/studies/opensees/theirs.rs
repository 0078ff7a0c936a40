//! OpenSees, where it is installed: a Python interpreter that has it.

use serde_json::Value;
use std::io::Write as _;
use std::process::{Command, Stdio};
use std::sync::OnceLock;

/// Names the interpreter.
const VARIABLE: &str = "TRILITH_OPENSEES";
/// Leads what it reads along motions, and prints forces.
const SCRIPT: &str = include_str!("pairs.py");

/// What a task gave: a list of values for each time that is kept.
pub(super) type Values = Result<Vec<Vec<f64>>, String>;

fn interpreter() -> String {
    std::env::var(VARIABLE).ok().filter(|p| !p.is_empty()).unwrap_or_else(|| "python3".into())
}

/// Why OpenSees is not there, found out once.
pub(super) fn missing() -> Option<&'static str> {
    static FOUND: OnceLock<Option<String>> = OnceLock::new();
    let look = || {
        let python = interpreter();
        let there = Command::new(&python)
            .args(["-c", "import openseespy.opensees"])
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|status| status.success());
        let reason = format!(
            "`{python}` has no openseespy ({VARIABLE} names a Python interpreter that has it)"
        );
        (!there).then_some(reason)
    };
    FOUND.get_or_init(look).as_deref()
}

/// What OpenSees gives for each task.
pub(super) fn values(tasks: &[Value]) -> Result<Vec<Values>, String> {
    Ok(answers(SCRIPT, &Value::from(tasks))?.iter().map(read).collect())
}

/// What a script answers to each task of a list.
pub(super) fn answers(script: &str, tasks: &Value) -> Result<Vec<Value>, String> {
    let text = serde_json::to_vec(tasks).map_err(|e| e.to_string())?;
    let broken = |e: std::io::Error| format!("OpenSees: {e}");
    let mut child = Command::new(interpreter())
        .args(["-c", script])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(broken)?;
    // The script reads all before it prints, so that neither side waits for the other. Where it broke off
    // instead, its last words say more than the pipe.
    let written = child.stdin.take().map_or(Ok(()), |mut pipe| pipe.write_all(&text));
    let output = child.wait_with_output().map_err(broken)?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(format!("OpenSees broke off: {}", said.lines().last().unwrap_or_default()));
    }
    written.map_err(broken)?;
    let all: Vec<Value> = serde_json::from_slice(&output.stdout).map_err(|e| e.to_string())?;
    let asked = tasks.as_array().map_or(0, Vec::len);
    if all.len() != asked {
        return Err(format!("OpenSees answered {} of {asked} tasks", all.len()));
    }
    Ok(all)
}

fn read(answer: &Value) -> Values {
    if let Some(problem) = answer["problem"].as_str() {
        return Err(problem.to_owned());
    }
    serde_json::from_value(answer["values"].clone()).map_err(|e| e.to_string())
}
