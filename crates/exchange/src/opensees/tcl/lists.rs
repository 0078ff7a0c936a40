//! Lists.

use super::interpreter::{Flow, Interpreter, Outcome};
use super::strings::{matches, position};
use super::value::{Number, Value};

type Command = fn(&mut Interpreter<'_>, &[Value]) -> Outcome;

/// A command on lists.
pub fn find(name: &str) -> Option<Command> {
    Some(match name {
        "list" => |i, w| made(i, w[1..].to_vec()),
        "llength" => |i, w| {
            i.count(w, 1, 1, "llength list")?;
            Ok(Value::new(items(i, w, 1)?.len().to_string()))
        },
        "lindex" => lindex,
        "lrange" => lrange,
        "concat" => |i, w| {
            let all: Vec<&str> =
                w[1..].iter().map(|v| v.str().trim()).filter(|t| !t.is_empty()).collect();
            i.value(all.join(" "))
        },
        "split" => split,
        "join" => join,
        "lreverse" => |i, w| {
            i.count(w, 1, 1, "lreverse list")?;
            let mut all = items(i, w, 1)?;
            all.reverse();
            made(i, all)
        },
        "lrepeat" => lrepeat,
        "lsearch" => lsearch,
        "lsort" => lsort,
        "lassign" => lassign,
        "lset" => lset,
        "linsert" => linsert,
        "lreplace" => lreplace,
        _ => return None,
    })
}

fn items(i: &mut Interpreter<'_>, w: &[Value], word: usize) -> Result<Vec<Value>, Flow> {
    i.spend(w[word].text.len())?;
    w[word].items().map_err(|e| i.wrong_at(word, &e, ""))
}

fn made(i: &mut Interpreter<'_>, all: Vec<Value>) -> Outcome {
    let texts: Vec<&str> = all.iter().map(|v| v.str()).collect();
    let value = Value::list(&texts);
    i.bounded(value.text.len())?;
    Ok(value)
}

fn lindex(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, usize::MAX, "lindex list index")?;
    let mut value = w[1].clone();
    for at in 2..w.len() {
        for index in items(i, w, at)? {
            i.spend(value.text.len())?;
            let all = value.items().map_err(|e| i.wrong_at(1, &e, ""))?;
            let k = position(i, &index, all.len())?;
            value = usize::try_from(k)
                .ok()
                .and_then(|k| all.get(k).cloned())
                .unwrap_or_else(Value::empty);
        }
    }
    Ok(value)
}

/// A part of a list, between two positions within it.
fn bounds(
    i: &mut Interpreter<'_>,
    w: &[Value],
    first: usize,
    n: usize,
) -> Result<std::ops::Range<usize>, Flow> {
    let from = position(i, &w[first], n)?.clamp(0, n as i64) as usize;
    let to = (position(i, &w[first + 1], n)?.saturating_add(1)).clamp(0, n as i64) as usize;
    Ok(from..to.max(from))
}

fn lrange(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 3, 3, "lrange list first last")?;
    let all = items(i, w, 1)?;
    let range = bounds(i, w, 2, all.len())?;
    made(i, all[range].to_vec())
}

fn lreplace(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 3, usize::MAX, "lreplace list first last item …")?;
    let mut all = items(i, w, 1)?;
    let range = bounds(i, w, 2, all.len())?;
    all.splice(range, w[4..].iter().cloned());
    made(i, all)
}

fn linsert(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 2, usize::MAX, "linsert list index item …")?;
    let mut all = items(i, w, 1)?;
    let end = w[2].str().starts_with("end");
    let k = position(i, &w[2], all.len() + usize::from(end))?.clamp(0, all.len() as i64) as usize;
    all.splice(k..k, w[3..].iter().cloned());
    made(i, all)
}

fn split(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, 2, "split text characters")?;
    let at = w.get(2).map_or(" \n\t\r", |v| v.str());
    i.spend(w[1].text.len())?;
    let parts: Vec<Value> = if at.is_empty() {
        w[1].str().chars().map(|c| Value::new(c.to_string())).collect()
    } else if w[1].str().is_empty() {
        Vec::new()
    } else {
        w[1].str().split(|c| at.contains(c)).map(Value::new).collect()
    };
    made(i, parts)
}

fn join(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, 2, "join list text")?;
    let between = w.get(2).map_or(" ", |v| v.str());
    let all = items(i, w, 1)?;
    i.bounded(all.len().saturating_mul(between.len()).saturating_add(w[1].text.len()))?;
    let texts: Vec<&str> = all.iter().map(|v| v.str()).collect();
    i.value(texts.join(between))
}

fn lrepeat(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, usize::MAX, "lrepeat count item …")?;
    let n = usize::try_from(i.whole(w, 1)?).unwrap_or(0);
    let size: usize = w[2..].iter().map(|v| v.text.len() + 1).sum();
    i.bounded(n.saturating_mul(size.max(1)))?;
    made(i, std::iter::repeat_n(&w[2..], n).flatten().cloned().collect())
}

fn lsearch(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 2, 3, "lsearch -exact list value")?;
    let exact = w.len() == 4 && w[1].str() == "-exact";
    if w.len() == 4 && !matches!(w[1].str(), "-exact" | "-glob") {
        return Err(i.wrong_at(1, "this kind of `lsearch` is not read", "-exact or -glob"));
    }
    let all = items(i, w, w.len() - 2)?;
    let what = w[w.len() - 1].str();
    let found =
        all.iter().position(|v| if exact { v.str() == what } else { matches(what, v.str()) });
    Ok(Value::new(found.map_or(-1, |k| k as i64).to_string()))
}

fn lsort(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, usize::MAX, "lsort -real list")?;
    let (mut numbers, mut down, mut unique) = (false, false, false);
    for at in 1..w.len() - 1 {
        match w[at].str() {
            "-real" | "-integer" => numbers = true,
            "-decreasing" => down = true,
            "-unique" => unique = true,
            "-increasing" | "-ascii" => {}
            _ => {
                return Err(i.wrong_at(
                    at,
                    "this order of `lsort` is not read",
                    "-real, -integer, -decreasing, -unique",
                ));
            }
        }
    }
    let mut all = items(i, w, w.len() - 1)?;
    if numbers {
        if let Some(bad) = all.iter().find(|v| Number::read(v.str()).is_none()) {
            return Err(i.no_number(bad.str()));
        }
        all.sort_by(|a, b| {
            let x = |v: &Value| Number::read(v.str()).map_or(0.0, Number::real);
            x(a).total_cmp(&x(b))
        });
    } else {
        all.sort_by(|a, b| a.str().cmp(b.str()));
    }
    if unique {
        all.dedup_by(|a, b| a.str() == b.str());
    }
    if down {
        all.reverse();
    }
    made(i, all)
}

fn lassign(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, usize::MAX, "lassign list name …")?;
    let all = items(i, w, 1)?;
    for (k, name) in w[2..].iter().enumerate() {
        i.put(name.str(), all.get(k).cloned().unwrap_or_else(Value::empty))?;
    }
    made(i, all.get(w.len() - 2..).unwrap_or_default().to_vec())
}

fn lset(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 3, 3, "lset name index value")?;
    let old = i.get(w[1].str())?;
    i.spend(old.text.len())?;
    let mut all = old.items().map_err(|e| i.wrong_at(1, &e, ""))?;
    let k = position(i, &w[2], all.len())?;
    match usize::try_from(k).ok().and_then(|k| all.get_mut(k)) {
        Some(item) => *item = w[3].clone(),
        None => return Err(i.wrong_at(2, "a position that the list does not have", "")),
    }
    let value = made(i, all)?;
    i.put(w[1].str(), value.clone())?;
    Ok(value)
}
