//! Motions that have been read or made before: a study, which reads one model with many values of its
//! parameters, costs each of them once.

use std::collections::HashMap;
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use trilith_element::{FileText, SparseMatrix};
use trilith_record::Record;

/// Most samples that are kept of each kind: 128 MB. What has not been asked for longest goes first.
const MOST: usize = 16_000_000;

/// What a model has read or made. The same key gives the same numbers, whoever asks first.
#[derive(Default)]
pub(crate) struct Motions {
    /// Accelerograms, processed or synthetic, without their factor.
    pub records: Shelf<Record>,
    /// Two columns of files: times and values as they stand there.
    pub columns: Shelf<(Vec<f64>, Vec<f64>)>,
    /// Files that parameters name.
    pub texts: Shelf<FileText>,
    /// Sparse matrices that parameters name.
    pub matrices: Shelf<SparseMatrix>,
}

impl fmt::Debug for Motions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Motions")
    }
}

/// Something with samples.
pub(crate) trait Samples {
    fn samples(&self) -> usize;
}

impl Samples for Record {
    fn samples(&self) -> usize {
        self.acceleration.len()
    }
}

impl Samples for FileText {
    fn samples(&self) -> usize {
        self.text.len() / size_of::<f64>()
    }
}

impl Samples for SparseMatrix {
    fn samples(&self) -> usize {
        // An entry has a value and two places.
        2 * self.entries.len()
    }
}

impl Samples for (Vec<f64>, Vec<f64>) {
    fn samples(&self) -> usize {
        self.0.len() + self.1.len()
    }
}

type Slot<T> = Arc<Mutex<Option<Arc<T>>>>;

struct Kept<T> {
    slot: Slot<T>,
    asked: u64,
    samples: usize,
}

struct Inside<T> {
    all: HashMap<String, Kept<T>>,
    clock: u64,
}

/// Things by the text of all that makes them.
pub(crate) struct Shelf<T>(Mutex<Inside<T>>);

impl<T> Default for Shelf<T> {
    fn default() -> Self {
        Self(Mutex::new(Inside { all: HashMap::new(), clock: 0 }))
    }
}

fn lock<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    // A maker that gave up has left nothing half done.
    of.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<T: Samples> Shelf<T> {
    /// What stands under a key, made where nothing does; who asks while another makes it waits for that.
    ///
    /// # Errors
    /// Those of `make`; nothing is kept of them.
    pub fn get<E>(&self, key: String, make: impl FnOnce() -> Result<T, E>) -> Result<Arc<T>, E> {
        let slot = {
            let mut inside = lock(&self.0);
            inside.clock += 1;
            let asked = inside.clock;
            let new = || Kept { slot: Slot::default(), asked, samples: 0 };
            let kept = inside.all.entry(key.clone()).or_insert_with(new);
            kept.asked = asked;
            Arc::clone(&kept.slot)
        };
        let mut held = lock(&slot);
        if let Some(found) = held.as_ref() {
            return Ok(Arc::clone(found));
        }
        let made = match make() {
            Ok(made) => Arc::new(made),
            Err(error) => {
                lock(&self.0).all.remove(&key);
                return Err(error);
            }
        };
        *held = Some(Arc::clone(&made));
        let mut inside = lock(&self.0);
        if let Some(kept) = inside.all.get_mut(&key) {
            kept.samples = made.samples();
        }
        inside.shrink(MOST);
        Ok(made)
    }
}

impl<T> Inside<T> {
    fn shrink(&mut self, most: usize) {
        let mut sum: usize = self.all.values().map(|k| k.samples).sum();
        while sum > most {
            let made = self.all.iter().filter(|(_, k)| k.samples > 0);
            let Some(oldest) = made.min_by_key(|(_, k)| k.asked).map(|(key, _)| key.clone()) else {
                break;
            };
            sum -= self.all.remove(&oldest).map_or(0, |k| k.samples);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    fn column(n: usize) -> (Vec<f64>, Vec<f64>) {
        (vec![0.0; n], vec![0.0; n])
    }

    #[test]
    fn the_same_is_made_once_however_many_ask_and_an_error_is_not_kept() {
        let shelf = Shelf::default();
        let made = AtomicUsize::new(0);
        let ask = |key: &str| {
            let make = || {
                std::thread::sleep(std::time::Duration::from_millis(20));
                made.fetch_add(1, Ordering::Relaxed);
                Ok::<_, ()>(column(3))
            };
            shelf.get(key.to_owned(), make).unwrap()
        };
        std::thread::scope(|s| {
            for _ in 0..4 {
                s.spawn(|| (ask("a"), ask("b")));
            }
        });
        assert_eq!(made.load(Ordering::Relaxed), 2);
        assert_eq!(shelf.get("c".to_owned(), || Err("no")).unwrap_err(), "no");
        assert!(shelf.get("c".to_owned(), || Ok::<_, ()>(column(1))).is_ok());
    }

    #[test]
    fn what_has_not_been_asked_for_longest_goes_first() {
        let shelf = Shelf::default();
        let ask = |key: &str| {
            let mut new = false;
            let make = || {
                new = true;
                Ok::<_, ()>(column(MOST / 5))
            };
            shelf.get(key.to_owned(), make).unwrap();
            new
        };
        assert!(ask("a") && ask("b"));
        // Two fifths of the room each: the third pushes out `b`, which was asked for longer ago.
        assert!(!ask("a") && ask("c") && !ask("a") && ask("b"));
    }
}
