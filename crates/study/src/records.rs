//! Finished runs in memory. There may be a million: their numbers stand one behind the other, and each text once.

use crate::{Cell, Column, Record};
use std::collections::{BTreeMap, HashMap};

/// Finished runs, by their numbers.
#[derive(Clone, Debug, Default)]
pub struct Records {
    /// Where each run stands among the heads. One that was replaced stands there still.
    places: BTreeMap<usize, u32>,
    heads: Vec<Head>,
    parameters: Vec<Slot>,
    /// Not a number where there is no value.
    values: Vec<f64>,
    texts: Texts,
    /// What failed and what was warned of, by place.
    told: BTreeMap<u32, (String, Vec<String>)>,
}

/// What each run has.
#[derive(Clone, Copy, Debug)]
struct Head {
    run: usize,
    /// Where its parameters and its values end; they begin where those of the head before end.
    parameters: usize,
    values: usize,
    status: u32,
    initial_mode: Option<u32>,
    mode: Option<u32>,
    good: bool,
    overturned: bool,
}

/// A value of a parameter, texts by their number.
#[derive(Clone, Copy, Debug)]
enum Slot {
    Number(f64),
    Text(u32),
    Nothing,
}

/// Texts that many runs share, by number.
#[derive(Clone, Debug, Default)]
struct Texts {
    all: Vec<String>,
    numbers: HashMap<String, u32>,
}

impl Texts {
    fn number(&mut self, text: String) -> u32 {
        if let Some(number) = self.numbers.get(&text) {
            return *number;
        }
        let number = short(self.all.len());
        self.all.push(text.clone());
        self.numbers.insert(text, number);
        number
    }

    fn of(&self, number: u32) -> &str {
        &self.all[number as usize]
    }
}

/// A place that is told by half of the bits: four thousand million runs are more than any memory holds.
fn short(place: usize) -> u32 {
    u32::try_from(place).expect("fewer runs than memory holds")
}

impl Records {
    /// Adds a run. One of the same number is replaced.
    pub fn insert(&mut self, record: Record) {
        let Record { run, status, good, message, warnings, overturned, .. } = record;
        let place = short(self.heads.len());
        for cell in record.parameters {
            let slot = match cell {
                Cell::Number(x) => Slot::Number(x),
                Cell::Text(text) => Slot::Text(self.texts.number(text)),
                Cell::Nothing => Slot::Nothing,
            };
            self.parameters.push(slot);
        }
        self.values.extend(record.values.into_iter().map(|x| x.unwrap_or(f64::NAN)));
        if !(message.is_empty() && warnings.is_empty()) {
            self.told.insert(place, (message, warnings));
        }
        self.heads.push(Head {
            run,
            parameters: self.parameters.len(),
            values: self.values.len(),
            status: self.texts.number(status),
            initial_mode: record.initial_mode.map(|mode| self.texts.number(mode)),
            mode: record.mode.map(|mode| self.texts.number(mode)),
            good,
            overturned,
        });
        self.places.insert(run, place);
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// True without any.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// True where there is a run of this number.
    #[must_use]
    pub fn contains(&self, run: usize) -> bool {
        self.places.contains_key(&run)
    }

    /// A run by its number.
    #[must_use]
    pub fn get(&self, run: usize) -> Option<Row<'_>> {
        self.places.get(&run).map(|place| Row { all: self, place: *place })
    }

    /// All runs in the order of their numbers.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = Row<'_>> + ExactSizeIterator {
        self.places.values().map(|place| Row { all: self, place: *place })
    }

    /// The same as a list: what is made of runs needs them by their order.
    #[must_use]
    pub fn rows(&self) -> Vec<Row<'_>> {
        self.iter().collect()
    }

    /// Leaves those out for which it is false.
    pub(crate) fn retain(&mut self, mut stays: impl FnMut(Row<'_>) -> bool) {
        let mut places = std::mem::take(&mut self.places);
        places.retain(|_, place| stays(Row { all: self, place: *place }));
        self.places = places;
    }
}

impl Extend<Record> for Records {
    fn extend<T: IntoIterator<Item = Record>>(&mut self, all: T) {
        all.into_iter().for_each(|record| self.insert(record));
    }
}

impl FromIterator<Record> for Records {
    fn from_iter<T: IntoIterator<Item = Record>>(all: T) -> Self {
        let mut records = Self::default();
        records.extend(all);
        records
    }
}

/// A finished run among others.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    all: &'a Records,
    place: u32,
}

impl<'a> Row<'a> {
    fn head(self) -> &'a Head {
        &self.all.heads[self.place as usize]
    }

    /// The head before, where its own parameters and values begin.
    fn begin(self) -> (usize, usize) {
        let before = (self.place as usize).checked_sub(1).map(|place| self.all.heads[place]);
        before.map_or((0, 0), |head| (head.parameters, head.values))
    }

    /// Its number, from 0.
    #[must_use]
    pub fn run(self) -> usize {
        self.head().run
    }

    /// `converged`, `overturned`, or what failed.
    #[must_use]
    pub fn status(self) -> &'a str {
        self.all.texts.of(self.head().status)
    }

    /// True for a result to be trusted.
    #[must_use]
    pub fn good(self) -> bool {
        self.head().good
    }

    /// True where a body has fallen over.
    #[must_use]
    pub fn overturned(self) -> bool {
        self.head().overturned
    }

    /// Mode in which the body leaves rest.
    #[must_use]
    pub fn initial_mode(self) -> Option<&'a str> {
        self.head().initial_mode.map(|mode| self.all.texts.of(mode))
    }

    /// Mode over the whole run.
    #[must_use]
    pub fn mode(self) -> Option<&'a str> {
        self.head().mode.map(|mode| self.all.texts.of(mode))
    }

    /// What failed in a sentence; empty for a good run.
    #[must_use]
    pub fn message(self) -> &'a str {
        self.all.told.get(&self.place).map_or("", |told| told.0.as_str())
    }

    /// What the run warned of.
    #[must_use]
    pub fn warnings(self) -> &'a [String] {
        self.all.told.get(&self.place).map_or(&[], |told| told.1.as_slice())
    }

    /// What failed and what the run warned of, as a table has it.
    #[must_use]
    pub fn told(self) -> String {
        let failed = Some(self.message()).filter(|message| !message.is_empty());
        let all = failed.into_iter().chain(self.warnings().iter().map(String::as_str));
        all.collect::<Vec<_>>().join("; ")
    }

    fn slots(self) -> &'a [Slot] {
        &self.all.parameters[self.begin().0..self.head().parameters]
    }

    fn cell(self, slot: Slot) -> Cell {
        match slot {
            Slot::Number(x) => Cell::Number(x),
            Slot::Text(number) => Cell::Text(self.all.texts.of(number).to_owned()),
            Slot::Nothing => Cell::Nothing,
        }
    }

    /// Value of a varied parameter, SI.
    #[must_use]
    pub fn parameter(self, i: usize) -> Option<Cell> {
        self.slots().get(i).map(|slot| self.cell(*slot))
    }

    /// Values of the varied parameters, SI.
    pub fn parameters(self) -> impl Iterator<Item = Cell> + 'a {
        self.slots().iter().map(move |slot| self.cell(*slot))
    }

    /// Value of a column, SI.
    #[must_use]
    pub fn value(self, i: usize) -> Option<f64> {
        let own = &self.all.values[self.begin().1..self.head().values];
        own.get(i).copied().filter(|x| !x.is_nan())
    }

    /// Values of the columns, SI.
    pub fn values(self) -> impl Iterator<Item = Option<f64>> + 'a {
        let own = &self.all.values[self.begin().1..self.head().values];
        own.iter().map(|x| Some(*x).filter(|x| !x.is_nan()))
    }

    /// A number of the run: a column, or a varied parameter.
    #[must_use]
    pub fn number(self, varied: &[String], columns: &[Column], name: &str) -> Option<f64> {
        if let Some(i) = columns.iter().position(|c| c.name == name) {
            return self.value(i);
        }
        match self.slots().get(varied.iter().position(|n| n == name)?)? {
            Slot::Number(x) => Some(*x),
            _ => None,
        }
    }

    /// The run by itself.
    #[must_use]
    pub fn record(self) -> Record {
        let owned = |mode: Option<&str>| mode.map(str::to_owned);
        Record {
            run: self.run(),
            status: self.status().to_owned(),
            good: self.good(),
            message: self.message().to_owned(),
            warnings: self.warnings().to_vec(),
            overturned: self.overturned(),
            initial_mode: owned(self.initial_mode()),
            mode: owned(self.mode()),
            parameters: self.parameters().collect(),
            values: self.values().collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(run: usize) -> Record {
        Record {
            run,
            status: if run == 2 { "diverged" } else { "converged" }.into(),
            good: run != 2,
            message: if run == 2 { "no equilibrium" } else { "" }.into(),
            warnings: vec![format!("warned at {run}"); run % 3],
            overturned: run == 5,
            initial_mode: (run != 2).then(|| "slide".into()),
            mode: None,
            parameters: vec![
                Cell::Number(run as f64),
                Cell::Text(format!("{}.csv", run % 2)),
                Cell::Nothing,
            ],
            // Rows of other lengths stay apart.
            values: vec![Some(0.5 * run as f64), None, Some(f64::INFINITY)][..3 - run % 2].to_vec(),
        }
    }

    #[test]
    fn runs_come_back_in_the_order_of_their_numbers() {
        let records: Records = [5, 2, 7, 0].map(record).into_iter().collect();
        assert_eq!((records.len(), records.rows()[1].run()), (4, 2));
        assert_eq!(records.iter().map(Row::record).collect::<Vec<_>>(), [0, 2, 5, 7].map(record));
        assert_eq!(records.get(7).map(Row::record), Some(record(7)));
        assert!(records.get(1).is_none() && !records.contains(1));
        assert_eq!(records.get(2).unwrap().told(), "no equilibrium; warned at 2; warned at 2");
    }

    #[test]
    fn a_run_that_was_made_again_counts_as_it_was_made_last() {
        let mut records: Records = [3, 2, 4].map(record).into_iter().collect();
        records.insert(Record { run: 2, ..record(8) });
        let expected = [Record { run: 2, ..record(8) }, record(3), record(4)];
        assert_eq!(records.iter().map(Row::record).collect::<Vec<_>>(), expected);
        records.retain(|row| row.run() != 3);
        assert_eq!(records.iter().map(Row::run).collect::<Vec<_>>(), [2, 4]);
        // Nothing of the one before is left.
        assert_eq!((records.get(2).unwrap().message(), records.len()), ("", 2));
    }

    #[test]
    fn numbers_are_found_by_their_names() {
        let records: Records = [record(4)].into_iter().collect();
        let row = records.get(4).unwrap();
        let names = ["a", "file"].map(str::to_owned);
        assert_eq!(row.number(&names, &[], "a"), Some(4.0));
        assert_eq!((row.number(&names, &[], "file"), row.number(&names, &[], "b")), (None, None));
        assert_eq!((row.value(0), row.value(1), row.value(9)), (Some(2.0), None, None));
    }
}
