//! The table of a study: a row for each run, as Parquet and as CSV.

use crate::{Cell, Row, Study, StudyError};
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::borrow::Borrow;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use trilith::record::cell;

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// What it shows.
    pub title: String,
    /// Columns of one length.
    pub columns: Vec<Data>,
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Data {
    /// Name.
    pub name: String,
    /// SI unit; empty for none.
    pub unit: String,
    /// Values.
    pub values: Values,
}

/// Values of a column; none where there is no value.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Whole numbers.
    Counts(Vec<Option<i64>>),
    /// Numbers.
    Numbers(Vec<Option<f64>>),
    /// Texts.
    Texts(Vec<Option<String>>),
    /// True or false.
    Flags(Vec<Option<bool>>),
}

impl Values {
    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Counts(v) => v.len(),
            Self::Numbers(v) => v.len(),
            Self::Texts(v) => v.len(),
            Self::Flags(v) => v.len(),
        }
    }

    /// True without rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn text(&self, row: usize) -> String {
        match self {
            Self::Counts(v) => v[row].map_or_else(String::new, |x| x.to_string()),
            Self::Numbers(v) => v[row].map_or_else(String::new, |x| format!("{x:?}")),
            Self::Texts(v) => cell(v[row].as_deref().unwrap_or_default()).into_owned(),
            Self::Flags(v) => v[row].map_or_else(String::new, |x| x.to_string()),
        }
    }
}

impl Table {
    /// The runs of a study: number, place, varied parameters, columns, status.
    #[must_use]
    pub fn of(study: &Study, runs: &[Row<'_>]) -> Self {
        let mut columns = Vec::new();
        let mut add = |name: &str, unit: &str, values| {
            columns.push(Data { name: name.to_owned(), unit: unit.to_owned(), values });
        };
        let counts = |of: &dyn Fn(Row<'_>) -> usize| {
            Values::Counts(runs.iter().map(|r| i64::try_from(of(*r)).ok()).collect())
        };
        add("run", "", counts(&|r| r.run() + 1));
        if study.plan.samples.is_some() {
            add("sample", "", counts(&|r| study.plan.place(r.run()).sample + 1));
        }
        if study.plan.ensemble.is_some() {
            add("member", "", counts(&|r| study.plan.place(r.run()).member));
        }
        for (i, name) in study.varied.iter().enumerate() {
            let cell = |r: &Row<'_>| r.parameter(i);
            let values = if study.is_text(name) {
                let text = |c| match c {
                    Some(Cell::Text(t)) => Some(t),
                    _ => None,
                };
                Values::Texts(runs.iter().map(|r| text(cell(r))).collect())
            } else {
                let number = |c| match c {
                    Some(Cell::Number(x)) => Some(x),
                    _ => None,
                };
                Values::Numbers(runs.iter().map(|r| number(cell(r))).collect())
            };
            add(name, &study.unit(name), values);
        }
        for (i, column) in study.columns.iter().enumerate() {
            let values = runs.iter().map(|r| r.value(i)).collect();
            add(&column.name, &column.unit, Values::Numbers(values));
        }
        let texts = |of: &dyn Fn(Row<'_>) -> Option<String>| {
            Values::Texts(runs.iter().map(|r| of(*r)).collect())
        };
        add("initial_mode", "", texts(&|r| r.initial_mode().map(str::to_owned)));
        add("mode", "", texts(&|r| r.mode().map(str::to_owned)));
        let fallen = |r: &Row<'_>| r.good().then_some(r.overturned());
        add("overturned", "", Values::Flags(runs.iter().map(fallen).collect()));
        add("status", "", texts(&|r| Some(r.status().to_owned())));
        let told = |r: Row<'_>| Some(r.told()).filter(|text| !text.is_empty());
        add("message", "", texts(&told));
        Self { title: study.title.clone(), columns }
    }

    fn rows(&self) -> usize {
        self.columns.first().map_or(0, |c| c.values.len())
    }

    /// Writes it as CSV, units behind the names in brackets. Numbers read back to the same bits; texts that a
    /// spreadsheet would take for a formula have an apostrophe in front.
    ///
    /// # Errors
    /// [`StudyError::File`].
    pub fn write_csv(&self, path: &Path) -> Result<(), StudyError> {
        write_csv(std::iter::once(self), path)
    }

    /// Writes it as Parquet; the metadata `units` has the unit of every column as JSON.
    ///
    /// # Errors
    /// [`StudyError::File`].
    pub fn write_parquet(&self, path: &Path) -> Result<(), StudyError> {
        write_parquet(std::iter::once(self), path)
    }

    /// What a Parquet file says before its first row.
    fn head(&self) -> Result<(Type, WriterProperties), ParquetError> {
        let field = |c: &Data| {
            let physical = match c.values {
                Values::Counts(_) => Physical::INT64,
                Values::Numbers(_) => Physical::DOUBLE,
                Values::Texts(_) => Physical::BYTE_ARRAY,
                Values::Flags(_) => Physical::BOOLEAN,
            };
            let text = matches!(c.values, Values::Texts(_)).then_some(LogicalType::String);
            let made = Type::primitive_type_builder(&c.name, physical)
                .with_repetition(Repetition::OPTIONAL)
                .with_logical_type(text);
            made.build().map(Arc::new)
        };
        let fields = self.columns.iter().map(field).collect::<Result<Vec<_>, _>>()?;
        let schema = Type::group_type_builder("study").with_fields(fields).build()?;
        let units: serde_json::Map<String, serde_json::Value> = self
            .columns
            .iter()
            .map(|c| (c.name.clone(), serde_json::Value::String(c.unit.clone())))
            .collect();
        let more = vec![
            KeyValue::new("title".to_owned(), self.title.clone()),
            KeyValue::new("units".to_owned(), serde_json::Value::Object(units).to_string()),
        ];
        let properties = WriterProperties::builder()
            .set_compression(Compression::UNCOMPRESSED)
            .set_key_value_metadata(Some(more))
            .build();
        Ok((schema, properties))
    }

    /// Its rows as a group of their own.
    fn group(
        &self,
        writer: &mut SerializedFileWriter<impl Write + Send>,
    ) -> Result<(), ParquetError> {
        let mut group = writer.next_row_group()?;
        for column in &self.columns {
            let Some(mut open) = group.next_column()? else { break };
            match (open.untyped(), &column.values) {
                (ColumnWriter::Int64ColumnWriter(w), Values::Counts(v)) => {
                    let (values, levels) = present(v, |x| *x);
                    w.write_batch(&values, Some(&levels), None)?;
                }
                (ColumnWriter::DoubleColumnWriter(w), Values::Numbers(v)) => {
                    let (values, levels) = present(v, |x| *x);
                    w.write_batch(&values, Some(&levels), None)?;
                }
                (ColumnWriter::BoolColumnWriter(w), Values::Flags(v)) => {
                    let (values, levels) = present(v, |x| *x);
                    w.write_batch(&values, Some(&levels), None)?;
                }
                (ColumnWriter::ByteArrayColumnWriter(w), Values::Texts(v)) => {
                    let (values, levels) = present(v, |x| ByteArray::from(x.as_bytes().to_vec()));
                    w.write_batch(&values, Some(&levels), None)?;
                }
                _ => {}
            }
            open.close()?;
        }
        group.close()?;
        Ok(())
    }
}

/// Runs that are made a table of at once where that is written: what they take in memory does not grow with the study.
const ROWS: usize = 1 << 16;

/// Writes the tables of a study: the same as [`Table::of`] all its runs, in parts.
pub(crate) fn write(
    study: &Study,
    runs: &[Row<'_>],
    [parquet, csv]: [&Path; 2],
) -> Result<(), StudyError> {
    let of_none = runs.is_empty().then_some(runs);
    let parts = || runs.chunks(ROWS).chain(of_none).map(|part| Table::of(study, part));
    write_parquet(parts(), parquet)?;
    write_csv(parts(), csv)
}

/// One table below the other, which have the same columns, as CSV.
fn write_csv(parts: impl Iterator<Item: Borrow<Table>>, path: &Path) -> Result<(), StudyError> {
    replaced(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        for (i, part) in parts.enumerate() {
            let table: &Table = part.borrow();
            if i == 0 {
                csv.write_record(table.columns.iter().map(|c| match c.unit.as_str() {
                    "" | "1" => cell(&c.name).into_owned(),
                    unit => cell(&format!("{} [{unit}]", c.name)).into_owned(),
                }))?;
            }
            for row in 0..table.rows() {
                csv.write_record(table.columns.iter().map(|c| c.values.text(row)))?;
            }
        }
        csv.flush()
    })
}

/// The same as Parquet, each as a group of rows.
fn write_parquet(
    mut parts: impl Iterator<Item: Borrow<Table>>,
    path: &Path,
) -> Result<(), StudyError> {
    replaced(path, |file| {
        let write = || -> Result<(), ParquetError> {
            let Some(first) = parts.next() else { return Ok(()) };
            let (schema, properties) = first.borrow().head()?;
            let mut writer =
                SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties))?;
            first.borrow().group(&mut writer)?;
            drop(first);
            for part in parts.by_ref() {
                part.borrow().group(&mut writer)?;
            }
            writer.close()?;
            Ok(())
        };
        write().map_err(std::io::Error::other)
    })
}

/// The values that there are, and for each row whether there is one.
fn present<T, U>(all: &[Option<T>], of: impl Fn(&T) -> U) -> (Vec<U>, Vec<i16>) {
    let values = all.iter().flatten().map(of).collect();
    (values, all.iter().map(|x| i16::from(x.is_some())).collect())
}

/// Writes a file beside the old one and puts it in its place when it is whole.
pub(crate) fn replaced(
    path: &Path,
    write: impl FnOnce(&mut std::io::BufWriter<std::fs::File>) -> std::io::Result<()>,
) -> Result<(), StudyError> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let part = path.with_file_name(name);
    let made = std::fs::File::create(&part).and_then(|file| {
        let mut file = std::io::BufWriter::new(file);
        write(&mut file)?;
        file.into_inner().map_err(std::io::IntoInnerError::into_error)?.sync_data()
    });
    let made = made.and_then(|()| std::fs::rename(&part, path));
    made.map_err(|e| {
        let _ = std::fs::remove_file(&part);
        StudyError::at(path)(e)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    #[test]
    fn a_table_is_read_back_with_its_gaps_and_units() {
        let data =
            |name: &str, unit: &str, values| Data { name: name.into(), unit: unit.into(), values };
        let table = Table {
            title: "T".into(),
            columns: vec![
                data("run", "", Values::Counts(vec![Some(1), Some(2)])),
                data("slide", "m", Values::Numbers(vec![Some(0.1 + 0.2), None])),
                data("mode", "", Values::Texts(vec![None, Some("slide, rock".into())])),
                data("overturned", "", Values::Flags(vec![Some(true), None])),
            ],
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.parquet");
        table.write_parquet(&path).unwrap();
        let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
        let more = reader.metadata().file_metadata().key_value_metadata().unwrap().clone();
        assert!(more.iter().any(|k| k.key == "units"
            && k.value.as_deref().is_some_and(|v| v.contains("\"slide\":\"m\""))));
        let rows: Vec<Vec<Field>> = reader
            .get_row_iter(None)
            .unwrap()
            .map(|r| r.unwrap().get_column_iter().map(|(_, f)| f.clone()).collect())
            .collect();
        assert_eq!(
            rows,
            [
                [Field::Long(1), Field::Double(0.1 + 0.2), Field::Null, Field::Bool(true)],
                [Field::Long(2), Field::Null, Field::Str("slide, rock".into()), Field::Null],
            ]
        );
        table.write_csv(&folder.path().join("t.csv")).unwrap();
        let text = std::fs::read_to_string(folder.path().join("t.csv")).unwrap();
        let expected =
            "run,slide [m],mode,overturned\n1,0.30000000000000004,,true\n2,,\"slide, rock\",\n";
        assert_eq!(text, expected);
    }

    /// As a study of many runs is written.
    #[test]
    fn tables_below_each_other_are_one() {
        let part = |values: [Option<f64>; 2]| {
            let values = Values::Numbers(values.to_vec());
            let columns = vec![Data { name: "slide".into(), unit: "m".into(), values }];
            Table { title: "T".into(), columns }
        };
        let parts = || [[Some(1.0), None], [None, Some(0.1)]].into_iter().map(part);
        let folder = tempfile::tempdir().unwrap();
        let [parquet, csv] = ["t.parquet", "t.csv"].map(|name| folder.path().join(name));
        write_parquet(parts(), &parquet).unwrap();
        write_csv(parts(), &csv).unwrap();
        let reader = SerializedFileReader::new(std::fs::File::open(&parquet).unwrap()).unwrap();
        assert_eq!(reader.num_row_groups(), 2);
        let field = |row: parquet::record::Row| row.get_column_iter().next().unwrap().1.clone();
        let rows: Vec<Field> =
            reader.get_row_iter(None).unwrap().map(|row| field(row.unwrap())).collect();
        assert_eq!(rows, [Field::Double(1.0), Field::Null, Field::Null, Field::Double(0.1)]);
        assert_eq!(std::fs::read_to_string(&csv).unwrap(), "slide [m]\n1.0\n\"\"\n\"\"\n0.1\n");
    }

    #[test]
    fn texts_that_look_like_formulas_are_texts_in_a_spreadsheet() {
        let data =
            |name: &str, unit: &str, values| Data { name: name.into(), unit: unit.into(), values };
        let texts = ["=1+1", "-1.5", "@a"].map(|t| Some(t.to_owned()));
        let table = Table {
            title: "T".into(),
            columns: vec![
                data("+x", "m", Values::Numbers(vec![Some(-1.5), Some(2.0), None])),
                data("=y", "", Values::Texts(texts.to_vec())),
            ],
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        table.write_csv(&path).unwrap();
        let text = std::fs::read_to_string(path).unwrap();
        assert_eq!(text, "'+x [m],'=y\n-1.5,'=1+1\n2.0,-1.5\n,'@a\n");
    }
}
