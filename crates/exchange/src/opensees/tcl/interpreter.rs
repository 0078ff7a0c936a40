//! The interpreter: commands one after the other, procedures, and what keeps a script from going on for ever.

use super::value::{Place, Value};
use super::{control, files, lists, strings, variables};
use std::collections::HashMap;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use trilith_model::{Diagnostic, Source};

/// Deepest nesting of bodies, procedures and brackets.
const DEEPEST: usize = 400;
/// Longest value, in bytes.
const LONGEST: usize = 50_000_000;
/// Bytes that count as much as a command.
const BYTES: usize = 2000;

/// Why commands end before their end.
#[derive(Debug)]
pub enum Flow {
    /// An error that `catch` may catch.
    Error(Box<Diagnostic>),
    /// An error of the model, or of a script that does not end.
    Fatal(Box<Diagnostic>),
    /// `break`.
    Break,
    /// `continue`.
    Continue,
    /// `return`.
    Return(Value),
}

/// What a command gives.
pub type Outcome = Result<Value, Flow>;

/// A command with its words.
pub struct Call<'a> {
    /// Its words, the name first.
    pub words: &'a [Value],
}

/// What a host answers.
pub enum Reply {
    /// A value.
    Value(Value),
    /// Commands that are run before the host is told of their end.
    Block(Value),
    /// A message about a word (by its position), and what would be right.
    Wrong(usize, String, String),
    /// No such command.
    Unknown,
}

/// What commands that are not Tcl's go to.
pub trait Host {
    /// A command.
    fn call(&mut self, call: &Call<'_>, line: &str) -> Reply;
    /// The commands of a block have been run.
    fn closed(&mut self);
    /// Something of the script itself that is left out: command, what becomes of it, line.
    fn left_out(&mut self, command: &str, what: &str, line: &str);
    /// Names of its commands, for one that is misspelt.
    fn names(&self) -> Vec<&'static str>;
}

/// What a script may do.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Folder that files are read from.
    pub folder: Option<PathBuf>,
    /// Most commands that are run.
    pub budget: u64,
}

/// A procedure.
pub struct Procedure {
    pub parameters: Vec<(String, Option<Value>)>,
    pub body: Value,
}

/// The interpreter.
pub struct Interpreter<'h> {
    pub host: &'h mut dyn Host,
    pub settings: Settings,
    pub sources: Vec<Arc<Source>>,
    /// Files that are being read, one in the other.
    pub reading: Vec<PathBuf>,
    pub frames: Vec<variables::Frame>,
    pub procedures: HashMap<String, Rc<Procedure>>,
    /// Where the words of the command that is run stand.
    pub places: Vec<Place>,
    depth: usize,
    /// Nesting of the expressions that wait for a value.
    pub parentheses: usize,
    spent: u64,
    bytes: usize,
}

impl<'h> Interpreter<'h> {
    /// An interpreter of a script.
    pub fn new(source: Arc<Source>, settings: Settings, host: &'h mut dyn Host) -> Self {
        Self {
            host,
            settings,
            sources: vec![source],
            reading: Vec::new(),
            frames: vec![variables::Frame::default()],
            procedures: HashMap::new(),
            places: vec![Place { file: 0, span: 0..0 }],
            depth: 0,
            parentheses: 0,
            spent: 0,
            bytes: 0,
        }
    }

    /// Runs the script.
    pub fn run(&mut self) -> Result<(), Box<Diagnostic>> {
        let text = self.sources[0].text.clone();
        let script = Value { text: Rc::new(text), origin: Some((0, 0)) };
        match self.evaluate(&script) {
            Ok(_) | Err(Flow::Return(_)) => Ok(()),
            Err(Flow::Error(e) | Flow::Fatal(e)) => Err(e),
            Err(Flow::Break | Flow::Continue) => {
                match self.wrong("no loop is here that ends", "") {
                    Flow::Error(e) => Err(e),
                    _ => Ok(()),
                }
            }
        }
    }

    /// An error at the command that is run.
    pub fn wrong(&self, message: &str, help: &str) -> Flow {
        self.wrong_at(0, message, help)
    }

    /// An error at a word of the command that is run.
    pub fn wrong_at(&self, word: usize, message: &str, help: &str) -> Flow {
        let place = self.places.get(word).or(self.places.first());
        let place = place.cloned().unwrap_or(Place { file: 0, span: 0..0 });
        Flow::Error(Box::new(self.diagnostic("E1100", place, message, help)))
    }

    /// An error at a place.
    pub fn diagnostic(
        &self,
        code: &'static str,
        place: Place,
        message: &str,
        help: &str,
    ) -> Diagnostic {
        let error = Diagnostic::new(code, message, place.span, &self.sources[place.file]);
        if help.is_empty() { error } else { error.help(help) }
    }

    /// A text that is no number, and why that may be.
    pub fn no_number(&self, text: &str) -> Flow {
        let short: String = text.chars().take(40).collect();
        let help = if text.starts_with(super::super::UNKNOWN) {
            "results are not there yet when a script is imported: nothing is computed from them"
        } else {
            "a number, such as 2, 0.5 or 1e3"
        };
        self.wrong(&format!("`{short}` is no number"), help)
    }

    /// Line of the command that is run, with its file where it is not the script itself.
    pub fn line(&self) -> String {
        let place = &self.places[0];
        let source = &self.sources[place.file];
        let (line, _) = trilith_model::line_column(&source.text, place.span.start);
        match (place.file, source.path.file_name()) {
            (0, _) | (_, None) => format!("line {line}"),
            (_, Some(name)) => format!("{} line {line}", name.to_string_lossy()),
        }
    }

    /// Counts a command, or as much work.
    pub fn spend(&mut self, bytes: usize) -> Result<(), Flow> {
        self.bytes += bytes;
        self.spent += 1 + (self.bytes / BYTES) as u64;
        self.bytes %= BYTES;
        if self.spent > self.settings.budget {
            let message =
                format!("the script does not end: {} commands were run", self.settings.budget);
            let place = self.places[0].clone();
            let error =
                self.diagnostic("E1101", place, &message, "a loop whose condition becomes false");
            return Err(Flow::Fatal(Box::new(error)));
        }
        Ok(())
    }

    /// A value of a length that is allowed.
    pub fn value(&mut self, text: String) -> Outcome {
        self.bounded(text.len())?;
        Ok(Value::new(text))
    }

    /// Counts the bytes of a value.
    pub fn bounded(&mut self, bytes: usize) -> Result<(), Flow> {
        if bytes > LONGEST {
            let place = self.places[0].clone();
            let error = self.diagnostic("E1102", place, "a value of more than 50 MB", "");
            return Err(Flow::Fatal(Box::new(error)));
        }
        self.spend(bytes)
    }

    /// Runs the commands of a text.
    pub fn evaluate(&mut self, script: &Value) -> Outcome {
        if self.depth >= DEEPEST {
            let place = self.places[0].clone();
            let message = "procedures, bodies or brackets that are nested too deeply";
            let error = self.diagnostic(
                "E1103",
                place,
                message,
                "a procedure that calls itself must come to an end",
            );
            return Err(Flow::Fatal(Box::new(error)));
        }
        self.depth += 1;
        let places = std::mem::take(&mut self.places);
        let around = places[0].clone();
        self.places = vec![around.clone()];
        let out = self.commands(script, &around);
        // Where an error was is kept for what is told of it.
        self.places = places;
        self.depth -= 1;
        out
    }

    fn commands(&mut self, script: &Value, around: &Place) -> Outcome {
        let text = Rc::clone(&script.text);
        let (mut at, mut last) = (0, Value::empty());
        while let Some(command) = self.next_command(&text, &mut at, script.origin, around)? {
            let (words, places) = command;
            self.spend(0)?;
            self.places = places;
            // A value that nothing else holds grows in place.
            drop(std::mem::replace(&mut last, Value::empty()));
            last = self.dispatch(&words)?;
        }
        Ok(last)
    }

    fn dispatch(&mut self, words: &[Value]) -> Outcome {
        let Some(first) = words.first() else { return Ok(Value::empty()) };
        let name = first.str().trim_start_matches("::");
        if let Some(procedure) = self.procedures.get(name).cloned() {
            return control::invoke(self, &procedure, words);
        }
        let own = control::find(name)
            .or_else(|| variables::find(name))
            .or_else(|| lists::find(name))
            .or_else(|| strings::find(name))
            .or_else(|| files::find(name));
        if let Some(command) = own {
            return command(self, words);
        }
        let line = self.line();
        let reply = self.host.call(&Call { words }, &line);
        match reply {
            Reply::Value(value) => Ok(value),
            Reply::Block(body) => {
                let out = self.evaluate(&body);
                self.host.closed();
                out
            }
            Reply::Wrong(word, message, help) => {
                let help = match words.get(word).map(Value::str) {
                    Some(text) if text.starts_with(super::super::UNKNOWN) => {
                        "results are not there yet when a script is imported".to_owned()
                    }
                    _ => help,
                };
                let place = self.places.get(word).or(self.places.first()).cloned();
                let place = place.unwrap_or(Place { file: 0, span: 0..0 });
                Err(Flow::Fatal(Box::new(self.diagnostic("E1104", place, &message, &help))))
            }
            Reply::Unknown => {
                let mut names = self.host.names();
                names.extend(BUILT_IN);
                let near =
                    names.into_iter().find(|n| n.eq_ignore_ascii_case(name) || near(n, name));
                let help = near.map_or_else(String::new, |n| format!("did you mean `{n}`?"));
                Err(self.wrong(&format!("there is no command `{name}`"), &help))
            }
        }
    }
}

/// Names of commands of Tcl that a misspelt one is compared with.
const BUILT_IN: [&str; 14] = [
    "set", "expr", "foreach", "while", "proc", "source", "puts", "lappend", "lindex", "format",
    "string", "global", "return", "incr",
];

/// True where one letter more, less or otherwise makes one of the other.
fn near(a: &str, b: &str) -> bool {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let front = a.iter().zip(&b).take_while(|(x, y)| x == y).count();
    let (a, b) = (&a[front..], &b[front..]);
    let back = a.iter().rev().zip(b.iter().rev()).take_while(|(x, y)| x == y).count();
    front + back >= 2 && a.len().max(b.len()) - back <= 1
}
