use super::*;
use crate::number::Number;
use std::fs;

fn key(i: usize) -> Key {
    let mut key = [7; 32];
    key[..8].copy_from_slice(&(i as u64).to_le_bytes());
    key
}

fn run(x: f64) -> Finished {
    Finished {
        status: "converged".into(),
        good: true,
        message: String::new(),
        warnings: vec!["a word".into()],
        contact: None,
        energy: [Number(x); 11],
        peaks: vec![[Number(x), Number(-0.0), Number(f64::NAN), Number(5e-324), Number(0.1 + 0.2)]],
        integrals: vec![Number(f64::INFINITY)],
    }
}

fn bits(run: &Finished) -> Vec<u64> {
    let all = run.energy.iter().chain(run.peaks.iter().flatten()).chain(&run.integrals);
    all.map(|x| x.0.to_bits()).collect()
}

fn has(folder: &Path, runs: impl Iterator<Item = usize>) {
    let mut store = Store::open(folder).unwrap();
    for i in runs {
        let found = store.find(&key(i)).unwrap().unwrap_or_else(|| panic!("{i} is not there"));
        assert_eq!(bits(&found), bits(&run(i as f64)), "{i}");
    }
    assert!(store.find(&key(1_000_000)).unwrap().is_none());
}

fn add(folder: &Path, runs: impl Iterator<Item = usize>) {
    let mut store = Store::open(folder).unwrap();
    runs.for_each(|i| store.add(&key(i), &run(i as f64)).unwrap());
    store.close().unwrap();
}

fn names(folder: &Path) -> Vec<String> {
    let mut all: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    all.sort();
    all
}

#[test]
fn runs_come_back_to_the_bit_with_an_index_and_without() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    add(here, 0..50);
    add(here, 50..80);
    has(here, 0..80);
    assert_eq!(names(here), ["0001.index", "0001.lock", "0001.segment"]);
    fs::remove_file(here.join("0001.index")).unwrap();
    has(here, 0..80);
    // An index that is damaged, or of a segment that is not there any more, is as good as none.
    fs::write(here.join("0001.index"), "TRILIDX1 and so on, until there is enough of it").unwrap();
    has(here, 0..80);
    add(here, 80..81);
    fs::remove_file(here.join("0001.segment")).unwrap();
    add(here, 90..95);
    has(here, 90..95);
    assert!(Store::open(here).unwrap().find(&key(3)).unwrap().is_none());
}

#[test]
fn writers_at_the_same_time_have_segments_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::thread::scope(|scope| {
        for part in 0..4 {
            scope.spawn(move || {
                let mut store = Store::open(here).unwrap();
                for i in part * 100..(part + 1) * 100 {
                    store.add(&key(i), &run(i as f64)).unwrap();
                }
                // What another process sees before this one ends.
                has(here, part * 100..(part + 1) * 100);
                store.close().unwrap();
            });
        }
    });
    has(here, 0..400);
    let segments = names(here).into_iter().filter(|n| n.ends_with("segment")).count();
    assert!((1..=4).contains(&segments), "{segments}");
    // Whoever comes later goes on in them.
    add(here, 400..401);
    assert_eq!(names(here).into_iter().filter(|n| n.ends_with("segment")).count(), segments);
}

#[test]
fn a_tail_torn_anywhere_costs_the_torn_run_alone() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    add(here, 0..3);
    let path = here.join("0001.segment");
    fs::remove_file(here.join("0001.index")).unwrap();
    let whole = fs::read(&path).unwrap();
    for cut in 0..whole.len() {
        fs::write(&path, &whole[..cut]).unwrap();
        let lines = whole[..cut].iter().filter(|b| **b == b'\n').count();
        has(here, 0..lines.saturating_sub(1));
        add(here, lines.saturating_sub(1)..4);
        has(here, 0..4);
        fs::remove_file(here.join("0001.index")).unwrap();
        has(here, 0..4);
    }
}

#[test]
fn damage_is_told_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    add(here, 0..3);
    let path = here.join("0001.segment");
    let whole = fs::read(&path).unwrap();
    let starts: Vec<usize> =
        (1..whole.len()).filter(|i| whole[i - 1] == b'\n').chain([whole.len()]).collect();
    let damage = |at: usize| {
        let mut bytes = whole.clone();
        bytes[at] ^= 1;
        fs::write(&path, bytes).unwrap();
    };
    let place = format!("0001.segment is damaged: the line at byte {}", starts[1]);
    for at in [starts[1], starts[1] + 9, starts[1] + 30, starts[2] - 40] {
        damage(at);
        // With an index it is met when the run is asked for, without one at once.
        let mut store = Store::open(here).unwrap();
        store.find(&key(0)).unwrap().unwrap();
        let error = store.find(&key(1)).unwrap_err().to_string();
        assert!(error.contains(&place), "{error}");
        let index = fs::read(here.join("0001.index")).unwrap();
        fs::remove_file(here.join("0001.index")).unwrap();
        let error = Store::open(here).unwrap_err().to_string();
        assert!(error.contains(&place), "{error}");
        fs::write(here.join("0001.index"), index).unwrap();
    }
    // Shorter than its index says.
    fs::write(&path, &whole[..starts[2]]).unwrap();
    assert!(Store::open(here).unwrap_err().to_string().contains("is damaged"));
    damage(12);
    assert!(Store::open(here).unwrap_err().to_string().contains("is no segment of a store"));
}
