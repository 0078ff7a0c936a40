//! Runs of a share: from the store, side by side, or one by one.

use super::Shared;
use crate::finished::Finished;
use crate::store::Key;
use crate::{Record, StudyError};
use std::sync::Mutex;
use std::sync::atomic::Ordering;
use trilith::model::Model;

impl Shared<'_> {
    /// Makes runs, side by side where they fit, or takes them from the store; each is on disk as soon as it is there. None
    /// where that was interrupted.
    pub(super) fn make(&self, runs: &[usize]) -> Result<Option<Vec<Record>>, StudyError> {
        let (study, registry) = (self.study, self.registry);
        let models: Vec<Option<Model>> = if self.lanes.is_some() || self.store.is_some() {
            runs.iter().map(|run| study.try_model(registry, *run)).collect()
        } else {
            runs.iter().map(|_| None).collect()
        };
        let key = |model: &Option<Model>| Some(self.store.as_ref()?.0.key(model.as_ref()?));
        let keys: Vec<Option<Key>> = models.iter().map(key).collect();
        let mut made: Vec<Option<Record>> = Vec::with_capacity(runs.len());
        for ((run, model), key) in runs.iter().zip(&models).zip(&keys) {
            made.push(self.stored(*run, model.as_ref(), key.as_ref())?);
        }
        let reused = made.iter().flatten().count();
        self.reused.fetch_add(reused, Ordering::Relaxed);
        let mut panicked = false;
        if let Some(lanes) = &self.lanes {
            let fresh = |(i, model)| Some((i, Option::as_ref(model)?));
            let all = models.iter().enumerate().filter(|(i, _)| made[*i].is_none());
            let (at, beside): (Vec<usize>, Vec<&Model>) = all.filter_map(fresh).unzip();
            let mut failed = None;
            panicked = !study.beside(lanes, &beside, &mut |place, finished| {
                let (i, model) = (at[place], beside[place]);
                let record = study.record(runs[i], model, &finished);
                let kept = self.keep(keys[i].as_ref(), &finished);
                failed = kept.and_then(|()| self.write(&record)).err();
                self.beside.fetch_add(1, Ordering::Relaxed);
                made[i] = Some(record);
                failed.is_none() && !self.stops()
            });
            if let Some(error) = failed {
                return Err(error);
            }
            if self.stops() {
                return Ok(None);
            }
        }
        for (i, run) in runs.iter().enumerate() {
            if made[i].is_some() {
                continue;
            }
            let (record, finished) = study.run(registry, *run, self.folder, self.interrupt)?;
            if self.interrupt.load(Ordering::Relaxed) {
                // It may have been cut short.
                return Ok(None);
            }
            // What goes alone because of its neighbours is not what it would be among others.
            if let Some(finished) = finished.filter(|_| !panicked) {
                self.keep(keys[i].as_ref(), &finished)?;
            }
            self.write(&record)?;
            made[i] = Some(record);
        }
        self.new.fetch_add(runs.len() - reused, Ordering::Relaxed);
        Ok(Some(made.into_iter().flatten().collect()))
    }

    /// The row of a run that the store has. One whose histories are kept is made for their sake.
    fn stored(
        &self,
        run: usize,
        model: Option<&Model>,
        key: Option<&Key>,
    ) -> Result<Option<Record>, StudyError> {
        let (Some(model), Some(key), Some((_, store))) = (model, key, &self.store) else {
            return Ok(None);
        };
        let found = store.lock().map_or(Ok(None), |mut store| store.find(key))?;
        let Some(finished) = found else { return Ok(None) };
        let record = self.study.record(run, model, &finished);
        if self.study.keeps_histories(&record) || (self.retry_failed && !record.good) {
            return Ok(None);
        }
        self.write(&record)?;
        Ok(Some(record))
    }

    fn keep(&self, key: Option<&Key>, finished: &Finished) -> Result<(), StudyError> {
        match (key, self.store.as_ref().map(|(_, store)| store.lock())) {
            (Some(key), Some(Ok(mut store))) => store.add(key, finished),
            _ => Ok(()),
        }
    }

    /// Puts a run on disk.
    fn write(&self, record: &Record) -> Result<(), StudyError> {
        if let Some(Ok(mut journal)) = self.journal.as_ref().map(Mutex::lock) {
            journal.write(record)?;
        }
        self.count(1, !record.good);
        Ok(())
    }
}
