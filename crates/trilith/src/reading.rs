//! Models from files and texts, with values of parameters and with errors as programs want them.

use std::fmt;
use std::ops::Deref;
use std::path::Path;
use trilith_model::{Diagnostic, Model, Registry};

/// All errors of a model file: one error for `?`, and a list of [`Diagnostic`]s to look at.
///
/// ```
/// fn main_of_a_program() -> Result<(), Box<dyn std::error::Error>> {
///     let text = r#"(nodes: { "m": (0, 0, 0) }, elements: { "mass": Mas(node: "m", mass: "2 m") })"#;
///     let model = trilith::read_text(text, "wrong.ron", &trilith::registry(), &[])?;
///     println!("{}", model.title);
///     Ok(())
/// }
/// let told = main_of_a_program().unwrap_err().to_string();
/// assert!(told.contains("wrong.ron:1:") && told.contains("there is no kind `Mas`"));
/// ```
#[derive(Clone)]
pub struct Diagnostics(Vec<Diagnostic>);

impl Diagnostics {
    /// The errors, one by one.
    #[must_use]
    pub fn into_vec(self) -> Vec<Diagnostic> {
        self.0
    }
}

impl fmt::Display for Diagnostics {
    /// Every error, with its place and what would be right.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, diagnostic) in self.0.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{diagnostic}")?;
        }
        Ok(())
    }
}

impl fmt::Debug for Diagnostics {
    /// As it is displayed: this is what a `main` that returns it prints.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for Diagnostics {}

impl Deref for Diagnostics {
    type Target = [Diagnostic];
    fn deref(&self) -> &[Diagnostic] {
        &self.0
    }
}

impl From<Vec<Diagnostic>> for Diagnostics {
    fn from(all: Vec<Diagnostic>) -> Self {
        Self(all)
    }
}

impl From<Diagnostics> for Vec<Diagnostic> {
    fn from(all: Diagnostics) -> Self {
        all.0
    }
}

impl IntoIterator for Diagnostics {
    type Item = Diagnostic;
    type IntoIter = std::vec::IntoIter<Diagnostic>;
    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<'a> IntoIterator for &'a Diagnostics {
    type Item = &'a Diagnostic;
    type IntoIter = std::slice::Iter<'a, Diagnostic>;
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

/// Values of parameters in place of those of a model file.
///
/// ```
/// use trilith::Values;
///
/// let values = Values::new().with("mu", 0.2).with("kn", (2.0, "MN/m")).with("record", "motion.csv");
/// let texts: Vec<_> = values.iter().map(|(name, value)| format!("{name}={value}")).collect();
/// assert_eq!(texts, ["mu=0.2", "kn=2.0 MN/m", "record=motion.csv"]);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Values(Vec<(String, String)>);

impl Values {
    /// None yet: everything as the file says.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// With a value of a parameter, in place of one that it had here: a number, a number with its unit, or a text as `--set` takes it.
    #[must_use]
    pub fn with(mut self, name: &str, value: impl Into<Value>) -> Self {
        self.0.retain(|(other, _)| other != name);
        self.0.push((name.to_owned(), value.into().0));
        self
    }
}

impl Deref for Values {
    type Target = [(String, String)];
    fn deref(&self) -> &[(String, String)] {
        &self.0
    }
}

/// The value of a parameter: every digit of a number is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Value(String);

impl From<f64> for Value {
    /// A number without a unit.
    fn from(x: f64) -> Self {
        Self(format!("{x:?}"))
    }
}

impl From<i32> for Value {
    /// A whole number, such as how many storeys.
    fn from(x: i32) -> Self {
        Self(x.to_string())
    }
}

impl From<(f64, &str)> for Value {
    /// A number and its unit.
    fn from((x, unit): (f64, &str)) -> Self {
        Self(format!("{x:?} {unit}"))
    }
}

impl From<&str> for Value {
    /// An expression, or a text such as the name of a record.
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self(text)
    }
}

/// Reads a model file; `values` are those of parameters in place of the file's: [`Values`], or names and texts.
///
/// # Errors
/// All errors of the file at once.
pub fn read(
    path: impl AsRef<Path>,
    registry: &Registry,
    values: &[(String, String)],
) -> Result<Model, Diagnostics> {
    Ok(trilith_model::read(path, registry, values)?)
}

/// Reads a model from a text. Files it names are looked for in the folder of `path`, which is its name in errors.
///
/// # Errors
/// As [`read`].
pub fn read_text(
    text: &str,
    path: impl AsRef<Path>,
    registry: &Registry,
    values: &[(String, String)],
) -> Result<Model, Diagnostics> {
    Ok(trilith_model::read_text(text, path, registry, values)?)
}
