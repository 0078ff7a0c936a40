//! Conditions, loops, procedures.

use super::expr;
use super::interpreter::{Flow, Interpreter, Outcome, Procedure};
use super::strings::matches;
use super::value::Value;
use super::variables::{Frame, Slot};
use std::rc::Rc;

type Command = fn(&mut Interpreter<'_>, &[Value]) -> Outcome;

/// A command of control.
pub fn find(name: &str) -> Option<Command> {
    Some(match name {
        "expr" => calculate,
        "if" => condition,
        "for" => for_loop,
        "foreach" => foreach,
        "while" => while_loop,
        "break" => |_, _| Err(Flow::Break),
        "continue" => |_, _| Err(Flow::Continue),
        "proc" => proc,
        "return" => |_, w| {
            Err(Flow::Return(
                w.last().filter(|_| w.len() > 1).cloned().unwrap_or_else(Value::empty),
            ))
        },
        "eval" => |i, w| i.evaluate(&joined(w)),
        "switch" => switch,
        "catch" => catch,
        "error" => |i, w| {
            let said: String = w.get(1).map_or("", |v| v.str()).chars().take(200).collect();
            Err(i.wrong(&format!("the script ends with the error: {said}"), ""))
        },
        "info" => info,
        "exit" => |_, _| Err(Flow::Return(Value::empty())),
        _ => return None,
    })
}

/// Words from the second on as one text, at its place where it is a single one.
fn joined(words: &[Value]) -> Value {
    match words {
        [_, one] => one.clone(),
        _ => Value::new(words[1..].iter().map(|v| v.str()).collect::<Vec<_>>().join(" ")),
    }
}

fn calculate(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, usize::MAX, "expr {expression}")?;
    expr::evaluate(i, &joined(w))
}

fn condition(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    let mut at = 1;
    loop {
        let Some(test) = w.get(at) else {
            return Err(i.wrong("`if` without a condition", "if {condition} {body}"));
        };
        at += 1;
        at += usize::from(w.get(at).is_some_and(|v| v.str() == "then"));
        let Some(body) = w.get(at) else {
            return Err(i.wrong("`if` without a body", "if {condition} {body}"));
        };
        if expr::holds(i, test)? {
            return i.evaluate(body);
        }
        at += 1;
        match w.get(at).map(|v| v.str()) {
            None => return Ok(Value::empty()),
            Some("elseif") => at += 1,
            Some(word) => {
                at += usize::from(word == "else");
                return match w.get(at) {
                    Some(body) if at + 1 == w.len() => i.evaluate(body),
                    _ => Err(i.wrong_at(
                        at,
                        "an `else` that is not followed by one body",
                        "else {body}",
                    )),
                };
            }
        }
    }
}

/// Runs the body of a loop; false where it ends with it.
fn turn(i: &mut Interpreter<'_>, body: &Value) -> Result<bool, Flow> {
    i.spend(0)?;
    match i.evaluate(body) {
        Ok(_) | Err(Flow::Continue) => Ok(true),
        Err(Flow::Break) => Ok(false),
        Err(other) => Err(other),
    }
}

fn for_loop(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 4, 4, "for {start} {condition} {next} {body}")?;
    i.evaluate(&w[1])?;
    while expr::holds(i, &w[2])? && turn(i, &w[4])? {
        i.evaluate(&w[3])?;
    }
    Ok(Value::empty())
}

fn while_loop(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 2, 2, "while {condition} {body}")?;
    while expr::holds(i, &w[1])? && turn(i, &w[2])? {}
    Ok(Value::empty())
}

fn foreach(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    if w.len() < 4 || !w.len().is_multiple_of(2) {
        return Err(i.wrong(
            "`foreach` without pairs of names and lists, and a body",
            "foreach name {list} {body}",
        ));
    }
    let (mut sets, mut rounds) = (Vec::new(), 0);
    for at in (1..w.len() - 1).step_by(2) {
        let names = w[at].items().map_err(|e| i.wrong_at(at, &e, ""))?;
        let items = w[at + 1].items().map_err(|e| i.wrong_at(at + 1, &e, ""))?;
        if names.is_empty() {
            return Err(i.wrong_at(at, "`foreach` without a name", "foreach name {list} {body}"));
        }
        rounds = rounds.max(items.len().div_ceil(names.len()));
        sets.push((names, items));
    }
    for round in 0..rounds {
        for (names, items) in &sets {
            for (k, name) in names.iter().enumerate() {
                let item = items.get(round * names.len() + k).cloned().unwrap_or_else(Value::empty);
                i.put(name.str(), item)?;
            }
        }
        if !turn(i, &w[w.len() - 1])? {
            break;
        }
    }
    Ok(Value::empty())
}

fn proc(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 3, 3, "proc name {arguments} {body}")?;
    let mut parameters = Vec::new();
    for item in w[2].items().map_err(|e| i.wrong_at(2, &e, ""))? {
        let parts = item.items().map_err(|e| i.wrong_at(2, &e, ""))?;
        match parts.as_slice() {
            [name] => parameters.push((name.text.to_string(), None)),
            [name, default] => parameters.push((name.text.to_string(), Some(default.clone()))),
            _ => {
                return Err(i.wrong_at(
                    2,
                    "an argument that is neither a name nor a name with its default",
                    "",
                ));
            }
        }
    }
    let name = w[1].str().trim_start_matches("::").to_owned();
    i.procedures.insert(name, Rc::new(Procedure { parameters, body: w[3].clone() }));
    Ok(Value::empty())
}

/// Calls a procedure.
pub fn invoke(i: &mut Interpreter<'_>, procedure: &Procedure, w: &[Value]) -> Outcome {
    let mut frame = Frame::new();
    let given = &w[1..];
    let names = &procedure.parameters;
    for (k, (name, default)) in names.iter().enumerate() {
        let value = if name == "args" && k + 1 == names.len() {
            let rest: Vec<&str> =
                given.get(k..).unwrap_or_default().iter().map(|v| v.str()).collect();
            Value::list(&rest)
        } else {
            match given.get(k).or(default.as_ref()) {
                Some(value) => value.clone(),
                None => {
                    let message = format!("`{}` without its argument `{name}`", w[0].str());
                    return Err(i.wrong(&message, ""));
                }
            }
        };
        frame.insert(name.clone(), Slot::Single(value));
    }
    if given.len() > names.len() && names.last().is_none_or(|(n, _)| n != "args") {
        let message =
            format!("`{}` takes {} arguments, not {}", w[0].str(), names.len(), given.len());
        return Err(i.wrong_at(names.len() + 1, &message, ""));
    }
    i.frames.push(frame);
    let out = i.evaluate(&procedure.body);
    i.frames.pop();
    match out {
        Err(Flow::Return(value)) => Ok(value),
        Err(Flow::Break | Flow::Continue) => {
            Err(i.wrong("`break` or `continue` outside of a loop", ""))
        }
        other => other,
    }
}

fn switch(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    let mut at = 1;
    let mut glob = false;
    while w.get(at).is_some_and(|v| v.str().starts_with('-') && w.len() - at > 2) {
        glob |= w[at].str() == "-glob";
        at += 1;
    }
    let usage = "switch value {pattern {body} …}";
    let Some(value) = w.get(at) else { return Err(i.wrong("`switch` without a value", usage)) };
    let arms = match w.len() - at {
        2 => w[at + 1].items().map_err(|e| i.wrong_at(at + 1, &e, ""))?,
        _ => w[at + 1..].to_vec(),
    };
    if arms.len() % 2 != 0 || arms.is_empty() {
        return Err(i.wrong("`switch` without pairs of pattern and body", usage));
    }
    for (k, pair) in arms.chunks_exact(2).enumerate() {
        let pattern = pair[0].str();
        let last = 2 * k + 2 == arms.len();
        let fits = if glob { matches(pattern, value.str()) } else { pattern == value.str() };
        if fits || pattern == "default" && last {
            let body = arms[2 * k + 1..].iter().step_by(2).find(|b| b.str() != "-");
            return body.map_or_else(|| Ok(Value::empty()), |b| i.evaluate(b));
        }
    }
    Ok(Value::empty())
}

fn catch(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, 3, "catch {body} message")?;
    let frames = i.frames.len();
    let (code, value) = match i.evaluate(&w[1]) {
        Ok(value) => (0, value),
        Err(Flow::Error(e)) => (1, Value::new(e.message.clone())),
        Err(Flow::Return(value)) => (2, value),
        Err(Flow::Break) => (3, Value::empty()),
        Err(Flow::Continue) => (4, Value::empty()),
        Err(fatal) => return Err(fatal),
    };
    i.frames.truncate(frames);
    if let Some(name) = w.get(2) {
        i.put(name.str(), value)?;
    }
    Ok(Value::new(code.to_string()))
}

fn info(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    let yes = |b: bool| Ok(Value::new(if b { "1" } else { "0" }));
    match (w.get(1).map(|v| v.str()), w.get(2)) {
        (Some("exists"), Some(name)) => {
            let array =
                i.frames.last().is_some_and(|f| matches!(f.get(name.str()), Some(Slot::Array(_))));
            yes(array || i.look(name.str()).is_some())
        }
        (Some("procs" | "commands"), Some(name)) => {
            Ok(Value::new(if i.procedures.contains_key(name.str()) { name.str() } else { "" }))
        }
        (Some("script"), _) => {
            let path = i.sources[i.places[0].file]
                .path
                .file_name()
                .map(|n| n.to_string_lossy().into_owned());
            Ok(Value::new(path.unwrap_or_default()))
        }
        (Some("tclversion" | "patchlevel"), _) => Ok(Value::new("8.6")),
        _ => Err(i.wrong("this question of `info` has no answer here", "info exists name")),
    }
}
