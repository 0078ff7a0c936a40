use super::*;
use crate::Row;
use std::io::Cursor;

fn identity() -> Identity {
    Identity {
        version: "1".into(),
        build: "b".into(),
        study: "s".into(),
        model: "m".into(),
        motions: "r".into(),
        runs: 9,
    }
}

fn record(run: usize) -> Record {
    Record {
        run,
        status: "converged".into(),
        good: true,
        message: String::new(),
        warnings: vec!["a word".into()],
        overturned: false,
        initial_mode: Some("slide".into()),
        mode: None,
        parameters: vec![Cell::Number(0.1 + 0.2), Cell::Text("a.csv".into()), Cell::Nothing],
        values: vec![Some(-0.0), None, Some(1e-310), Some(std::f64::consts::PI)],
    }
}

#[test]
fn records_come_back_to_the_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("runs.journal");
    let (mut journal, kept) = Journal::open(&path, &identity()).unwrap();
    assert!(kept.records.is_empty());
    for run in [3, 1] {
        journal.write(&record(run)).unwrap();
    }
    drop(journal);
    let (_, kept) = Journal::open(&path, &identity()).unwrap();
    assert_eq!(kept.records.iter().map(Row::record).collect::<Vec<_>>(), [record(1), record(3)]);
}

#[test]
fn a_journal_cut_anywhere_loses_the_torn_line_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("runs.journal");
    let (mut journal, _) = Journal::open(&path, &identity()).unwrap();
    (0..3).for_each(|run| journal.write(&record(run)).unwrap());
    let whole = std::fs::read(&path).unwrap();
    for cut in 0..whole.len() {
        std::fs::write(&path, &whole[..cut]).unwrap();
        let lines = whole[..cut].iter().filter(|b| **b == b'\n').count();
        let (mut journal, kept) = Journal::open(&path, &identity()).unwrap();
        assert_eq!(kept.records.len(), lines.saturating_sub(1), "cut at {cut}");
        for run in kept.records.len()..3 {
            journal.write(&record(run)).unwrap();
        }
        assert_eq!(std::fs::read(&path).unwrap(), whole, "cut at {cut}");
    }
}

#[test]
fn a_line_with_a_changed_byte_is_not_believed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("runs.journal");
    let (mut journal, _) = Journal::open(&path, &identity()).unwrap();
    (0..3).for_each(|run| journal.write(&record(run)).unwrap());
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replacen("\"run\":1", "\"run\":7", 1)).unwrap();
    let (_, kept) = Journal::open(&path, &identity()).unwrap();
    assert_eq!(kept.records.iter().map(Row::run).collect::<Vec<_>>(), [0, 2]);
    assert_eq!(kept.torn, 1);
}

#[test]
fn the_journal_of_another_study_and_other_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("runs.journal");
    Journal::open(&path, &identity()).unwrap();
    let other = Identity { model: "x".into(), runs: 8, ..identity() };
    let error = Journal::open(&path, &other).unwrap_err().to_string();
    assert!(error.contains("the model"), "{error}");
    let rebuilt = Identity { build: "c".into(), ..identity() };
    let error = Journal::open(&path, &rebuilt).unwrap_err().to_string();
    assert!(error.contains("the build of the program changed"), "{error}");
    let newer = Identity { version: "2".into(), ..rebuilt };
    let error = Journal::open(&path, &newer).unwrap_err().to_string();
    assert!(error.contains("the version of the program changed"), "{error}");
    std::fs::write(&path, "a,b\n1,2\n").unwrap();
    assert!(matches!(Journal::open(&path, &identity()), Err(StudyError::NoJournal { .. })));
}

/// A disk with room for so many bytes.
struct Disk(Cursor<Vec<u8>>, usize);

impl Write for Disk {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let room = self.1.saturating_sub(self.0.position() as usize);
        if room == 0 {
            return Err(std::io::ErrorKind::StorageFull.into());
        }
        self.0.write(&bytes[..bytes.len().min(room)])
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl Seek for Disk {
    fn seek(&mut self, to: SeekFrom) -> std::io::Result<u64> {
        self.0.seek(to)
    }
}

impl Storage for Disk {
    fn cut(&mut self, length: u64) -> std::io::Result<()> {
        self.0.get_mut().truncate(length as usize);
        Ok(())
    }
    fn sync(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_leaves_whole_lines() {
    let one = line(&record(0)).unwrap().len();
    let mut journal = Journal {
        file: Disk(Cursor::default(), 2 * one + one / 2),
        path: "runs.journal".into(),
        length: 0,
        synced: Instant::now(),
    };
    journal.write(&record(0)).unwrap();
    journal.write(&record(1)).unwrap();
    let error = journal.write(&record(2)).unwrap_err();
    assert!(error.to_string().contains("runs.journal"), "{error}");
    assert_eq!(journal.file.0.get_ref().len(), 2 * one);
    // Room again.
    journal.file.1 = 10 * one;
    journal.write(&record(2)).unwrap();
    let text = String::from_utf8(journal.file.0.into_inner()).unwrap();
    assert!(text.split_inclusive('\n').all(|l| content(l).is_some()), "{text}");
}
