//! Files that a parameter names.

use crate::Value;
use serde::Deserialize;
use serde::de::value::MapDeserializer;

/// A text file that a parameter of the [form](crate::Form::File) names, with what it holds. The model's reader finds it,
/// from the folder of the model file; a law sees no path and opens nothing.
///
/// A parameter becomes what its law wants by `TryFrom`:
///
/// ```
/// use trilith_element::{FileError, FileText};
///
/// #[derive(Debug, serde::Deserialize)]
/// #[serde(try_from = "FileText")]
/// struct Curve(Vec<[f64; 2]>);
///
/// impl TryFrom<FileText> for Curve {
///     type Error = FileError;
///     fn try_from(file: FileText) -> Result<Self, FileError> {
///         file.rows().map(Self)
///     }
/// }
///
/// let file = FileText { name: "pull.csv".into(), text: "d,f\n0,0\n0.01,5e3\n".into() };
/// assert_eq!(Curve::try_from(file).unwrap().0, [[0.0, 0.0], [0.01, 5e3]]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileText {
    /// Its name as the model has it.
    pub name: String,
    /// What it holds.
    pub text: String,
}

/// What is wrong with a file, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}{}: {message}", .line.map_or(String::new(), |line| format!(", line {line}")))]
pub struct FileError {
    /// Its name as the model has it.
    pub file: String,
    /// Where, counted from 1; none where it is about all of it.
    pub line: Option<usize>,
    /// What is wrong, and what would be right.
    pub message: String,
}

impl FileText {
    /// An error about a line, counted from 1.
    pub fn error(&self, line: usize, message: impl Into<String>) -> FileError {
        FileError { file: self.name.clone(), line: Some(line), message: message.into() }
    }

    /// Rows of N numbers with their lines, which count from 1. Commas, semicolons, tabs and spaces part the numbers; a first
    /// line without any is a heading, and lines that are empty or begin with `#` are left out.
    ///
    /// # Errors
    /// The first line that is no such row.
    pub fn numbered_rows<const N: usize>(&self) -> Result<Vec<(usize, [f64; N])>, FileError> {
        let mut rows = Vec::new();
        let mut heading = true;
        for (i, line) in self.text.lines().enumerate() {
            let parts = line.split([',', ';', '\t', ' ']).map(str::trim).filter(|p| !p.is_empty());
            let parts: Vec<&str> = parts.collect();
            if parts.is_empty() || line.trim_start().starts_with('#') {
                continue;
            }
            let is_heading = heading && parts.iter().all(|p| p.parse::<f64>().is_err());
            heading = false;
            if is_heading {
                continue;
            }
            let Ok(parts) = <[&str; N]>::try_from(&parts[..]) else {
                let message = format!("{} numbers are wanted here, not {}", N, parts.len());
                return Err(self.error(i + 1, message));
            };
            let mut row = [0.0; N];
            for (x, part) in row.iter_mut().zip(parts) {
                *x =
                    part.parse().ok().filter(|x: &f64| x.is_finite()).ok_or_else(|| {
                        self.error(i + 1, format!("`{part}` is no finite number"))
                    })?;
            }
            rows.push((i + 1, row));
        }
        if rows.is_empty() {
            let message = format!("there is no row of {N} numbers in it");
            return Err(FileError { file: self.name.clone(), line: None, message });
        }
        Ok(rows)
    }

    /// The same without the lines.
    ///
    /// # Errors
    /// As [`numbered_rows`](Self::numbered_rows).
    pub fn rows<const N: usize>(&self) -> Result<Vec<[f64; N]>, FileError> {
        Ok(self.numbered_rows()?.into_iter().map(|(_, row)| row).collect())
    }

    /// As a struct of two texts.
    pub(crate) fn pairs(
        &self,
    ) -> MapDeserializer<
        'static,
        std::array::IntoIter<(&'static str, Value), 2>,
        crate::ParameterError,
    > {
        let text = |t: &str| Value::Text(t.to_owned());
        MapDeserializer::new([("name", text(&self.name)), ("text", text(&self.text))].into_iter())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ParameterError, Values};
    use std::sync::Arc;

    fn file(text: &str) -> FileText {
        FileText { name: "pull.csv".into(), text: text.into() }
    }

    #[test]
    fn rows_are_read_with_their_lines() {
        let rows =
            file("d [m]; f [N]\n\n# pulled\n 0;0\r\n1e-2\t5e3 \n.02, 6000,\n").numbered_rows();
        assert_eq!(rows.unwrap(), [(4, [0.0, 0.0]), (5, [1e-2, 5e3]), (6, [0.02, 6e3])]);
        assert_eq!(file("1\n2").rows().unwrap(), [[1.0], [2.0]]);
    }

    #[test]
    fn what_is_no_row_is_told_with_its_line() {
        let told = |text: &str| file(text).rows::<2>().unwrap_err().to_string();
        assert_eq!(told("d f\n0 0\n0.01 x\n"), "pull.csv, line 3: `x` is no finite number");
        assert_eq!(told("0 0\n0.01 inf\n"), "pull.csv, line 2: `inf` is no finite number");
        assert_eq!(told("0 0\n\n0.01\n"), "pull.csv, line 3: 2 numbers are wanted here, not 1");
        assert_eq!(told("d f\nm N\n0 0"), "pull.csv, line 2: `m` is no finite number");
        assert_eq!(told("d f\n"), "pull.csv: there is no row of 2 numbers in it");
    }

    #[derive(Debug, Deserialize)]
    #[serde(try_from = "FileText")]
    struct Curve(Vec<[f64; 2]>);

    impl TryFrom<FileText> for Curve {
        type Error = FileError;
        fn try_from(file: FileText) -> Result<Self, FileError> {
            file.rows().map(Self)
        }
    }

    #[derive(Debug, Deserialize)]
    struct Law {
        curve: Curve,
        note: String,
        other: Option<FileText>,
    }

    #[test]
    fn a_law_reads_its_file_and_what_is_wrong_with_it_names_the_parameter() {
        let read = |text: &str| {
            let curve = Value::File(Arc::new(file(text)));
            let note = Value::Text("as pulled".into());
            Values(vec![("curve".into(), curve), ("note".into(), note)]).read::<Law>()
        };
        let law = read("0 0\n1 2\n").unwrap();
        assert_eq!((law.curve.0.len(), law.note.as_str(), law.other), (2, "as pulled", None));
        let error = read("0 0\n1 two\n").unwrap_err();
        assert_eq!(error.parameter(), Some("curve"));
        assert_eq!(error.to_string(), "`curve`: pull.csv, line 2: `two` is no finite number");
        assert!(matches!(error, ParameterError::File { .. }));
    }
}
