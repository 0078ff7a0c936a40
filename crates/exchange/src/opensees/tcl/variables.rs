//! Variables and arrays, of a procedure or of all.

use super::interpreter::{Flow, Interpreter, Outcome};
use super::value::{Number, Value};
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// A variable.
pub enum Slot {
    /// A single value.
    Single(Value),
    /// An array.
    Array(BTreeMap<String, Value>),
    /// A variable of another frame.
    Link(usize, String),
}

/// Variables of a procedure.
pub type Frame = HashMap<String, Slot>;

type Command = fn(&mut Interpreter<'_>, &[Value]) -> Outcome;

/// A command on variables.
pub fn find(name: &str) -> Option<Command> {
    Some(match name {
        "set" => set,
        "unset" => unset,
        "incr" => incr,
        "append" => append,
        "lappend" => lappend,
        "global" => global,
        "variable" => global,
        "upvar" => upvar,
        "array" => array,
        _ => return None,
    })
}

/// Name and index of `name(index)`.
fn parted(name: &str) -> (&str, Option<&str>) {
    match name.strip_suffix(')').and_then(|n| n.split_once('(')) {
        Some((array, index)) => (array, Some(index)),
        None => (name, None),
    }
}

impl Interpreter<'_> {
    /// Frame and name where a variable lives.
    fn home(&self, name: &str) -> (usize, String) {
        let mut frame = self.frames.len() - 1;
        let mut name = match name.strip_prefix("::") {
            Some(plain) => {
                frame = 0;
                plain.to_owned()
            }
            None => name.to_owned(),
        };
        // Links lead to frames below only.
        while let Some(Slot::Link(to, other)) = self.frames[frame].get(&name) {
            (frame, name) = (*to, other.clone());
        }
        (frame, name)
    }

    /// The value of a variable.
    pub fn get(&mut self, name: &str) -> Outcome {
        self.look(name).ok_or_else(|| {
            let (array, index) = parted(name);
            let (frame, home) = self.home(array);
            match (self.frames[frame].get(&home), index) {
                (Some(Slot::Array(_)), None) => self.wrong(
                    &format!("`{name}` is an array"),
                    &format!("an element of it: `${name}(index)`"),
                ),
                (Some(Slot::Array(_)), Some(index)) => {
                    self.wrong(&format!("the array `{array}` has no element `{index}`"), "")
                }
                _ => {
                    let outside = self.frames.len() > 1 && self.frames[0].contains_key(array);
                    let help = if outside {
                        format!("in a procedure `global {array}` brings it in")
                    } else {
                        String::new()
                    };
                    self.wrong(&format!("there is no variable `{name}`"), &help)
                }
            }
        })
    }

    /// The value of a variable where it has one.
    pub fn look(&self, name: &str) -> Option<Value> {
        let (array, index) = parted(name);
        let (frame, home) = self.home(array);
        match (self.frames[frame].get(&home)?, index) {
            (Slot::Single(value), None) => Some(value.clone()),
            (Slot::Array(all), Some(index)) => all.get(index).cloned(),
            _ => None,
        }
    }

    /// The value of a variable, to change; an empty one where it is new.
    fn place(&mut self, name: &str) -> Result<&mut Value, Flow> {
        let (array, index) = parted(name);
        let (frame, home) = self.home(array);
        let single = matches!(self.frames[frame].get(&home), Some(Slot::Single(_)));
        let known = self.frames[frame].contains_key(&home);
        if known && single == index.is_some() {
            let what = if single { "is no array" } else { "is an array" };
            return Err(self.wrong(&format!("`{array}` {what}"), ""));
        }
        let slot = self.frames[frame].entry(home).or_insert_with(|| match index {
            Some(_) => Slot::Array(BTreeMap::new()),
            None => Slot::Single(Value::empty()),
        });
        Ok(match (slot, index) {
            (Slot::Array(all), Some(index)) => {
                all.entry(index.to_owned()).or_insert_with(Value::empty)
            }
            (Slot::Single(value), _) => value,
            (slot, _) => {
                *slot = Slot::Single(Value::empty());
                let Slot::Single(value) = slot else { unreachable!("it was made single just now") };
                value
            }
        })
    }

    /// Gives a variable its value.
    pub fn put(&mut self, name: &str, value: Value) -> Result<(), Flow> {
        *self.place(name)? = value;
        Ok(())
    }

    /// Checks how many words a command has.
    pub fn count(
        &self,
        words: &[Value],
        least: usize,
        most: usize,
        usage: &str,
    ) -> Result<(), Flow> {
        let given = words.len() - 1;
        if given < least || given > most {
            let message = format!(
                "`{}` with {given} argument{}",
                words[0].str(),
                if given == 1 { "" } else { "s" }
            );
            return Err(self.wrong(&message, &format!("it is `{usage}`")));
        }
        Ok(())
    }

    /// A word that is a whole number.
    pub fn whole(&self, words: &[Value], word: usize) -> Result<i64, Flow> {
        match Number::read(words[word].str()) {
            Some(Number::Whole(i)) => Ok(i),
            _ => {
                let text: String = words[word].str().chars().take(40).collect();
                Err(self.wrong_at(word, &format!("`{text}` is no whole number"), ""))
            }
        }
    }
}

fn set(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, 2, "set name value")?;
    if w.len() == 2 {
        return i.get(w[1].str());
    }
    i.put(w[1].str(), w[2].clone())?;
    Ok(w[2].clone())
}

fn unset(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    for name in w[1..].iter().filter(|n| !n.str().starts_with("-no")) {
        let (array, index) = parted(name.str());
        let (frame, home) = i.home(array);
        match (i.frames[frame].get_mut(&home), index) {
            (Some(Slot::Array(all)), Some(index)) => _ = all.remove(index),
            _ => _ = i.frames[frame].remove(&home),
        }
    }
    Ok(Value::empty())
}

fn incr(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, 2, "incr name step")?;
    let by = if w.len() == 3 { i.whole(w, 2)? } else { 1 };
    let old = i.look(w[1].str()).unwrap_or_else(|| Value::new("0"));
    let Some(Number::Whole(old)) = Number::read(old.str()) else {
        return Err(i.wrong(
            &format!("`{}` is no whole number", old.str()),
            "`set x [expr $x + 0.5]` for others",
        ));
    };
    let new = old.checked_add(by).ok_or_else(|| i.wrong("a whole number that is too large", ""))?;
    let value = Value::new(new.to_string());
    i.put(w[1].str(), value.clone())?;
    Ok(value)
}

fn append(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, usize::MAX, "append name text …")?;
    let more: String = w[2..].iter().map(|v| v.str()).collect();
    grown(i, w[1].str(), &more, "")
}

fn lappend(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, usize::MAX, "lappend name item …")?;
    grown(
        i,
        w[1].str(),
        Value::list(&w[2..].iter().map(|v| v.str()).collect::<Vec<_>>()).str(),
        " ",
    )
}

/// Adds to the text of a variable, in place where nothing else holds it.
fn grown(i: &mut Interpreter<'_>, name: &str, more: &str, between: &str) -> Outcome {
    i.spend(more.len())?;
    let value = i.place(name)?;
    value.origin = None;
    let text = Rc::make_mut(&mut value.text);
    if !text.is_empty() && !more.is_empty() {
        text.push_str(between);
    }
    text.push_str(more);
    let long = text.len();
    let out = value.clone();
    if long > 1_000_000 {
        i.bounded(long / 100)?;
    }
    if long > 50_000_000 {
        i.bounded(long)?;
    }
    Ok(out)
}

fn global(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    let top = i.frames.len() - 1;
    if top > 0 {
        for name in &w[1..] {
            let plain = name.str().trim_start_matches("::").to_owned();
            i.frames[top].insert(plain.clone(), Slot::Link(0, plain));
        }
    }
    Ok(Value::empty())
}

fn upvar(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    let top = i.frames.len() - 1;
    let level = |text: &str| match text.strip_prefix('#') {
        Some(n) => n.parse::<usize>().ok().filter(|n| *n < top.max(1)),
        None => text.parse::<usize>().ok().filter(|n| *n >= 1).and_then(|n| top.checked_sub(n)),
    };
    let (to, rest) = match w.get(1).and_then(|v| level(v.str())) {
        Some(to) if w.len().is_multiple_of(2) => (to, &w[2..]),
        _ => (top.saturating_sub(1), &w[1..]),
    };
    if top == 0 || rest.len() % 2 != 0 || rest.is_empty() {
        return Err(i.wrong(
            "`upvar` outside of a procedure, or without pairs of names",
            "upvar theirs ours",
        ));
    }
    for pair in rest.chunks_exact(2) {
        let mut link = (to, pair[0].str().trim_start_matches("::").to_owned());
        while let Some(Slot::Link(frame, name)) = i.frames[link.0].get(&link.1) {
            link = (*frame, name.clone());
        }
        i.frames[top].insert(pair[1].str().to_owned(), Slot::Link(link.0, link.1));
    }
    Ok(Value::empty())
}

fn array(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 2, 3, "array exists|names|size|get|set name")?;
    let (frame, home) = i.home(w[2].str());
    let all = match i.frames[frame].get(&home) {
        Some(Slot::Array(all)) => Some(all),
        _ => None,
    };
    let texts: Vec<(String, String)> =
        all.into_iter().flatten().map(|(k, v)| (k.clone(), v.text.to_string())).collect();
    match w[1].str() {
        "exists" => Ok(Value::new(if all.is_some() { "1" } else { "0" })),
        "size" => Ok(Value::new(texts.len().to_string())),
        "names" => Ok(Value::list(&texts.iter().map(|t| t.0.as_str()).collect::<Vec<_>>())),
        "get" => {
            let flat: Vec<&str> = texts.iter().flat_map(|t| [t.0.as_str(), t.1.as_str()]).collect();
            Ok(Value::list(&flat))
        }
        "set" if w.len() == 4 => {
            let items = w[3].items().map_err(|e| i.wrong_at(3, &e, ""))?;
            if items.len() % 2 != 0 {
                return Err(i.wrong_at(3, "a list without pairs of index and value", ""));
            }
            for pair in items.chunks_exact(2) {
                i.put(&format!("{}({})", w[2].str(), pair[0].str()), pair[1].clone())?;
            }
            Ok(Value::empty())
        }
        other => Err(i.wrong_at(
            1,
            &format!("`array {other}` is not read"),
            "exists, names, size, get or set",
        )),
    }
}
