//! Parts of a study for machines that do not see its folder: what is known of a part goes there, and what it has made
//! comes back, both as the bytes of a journal.

use crate::execute::lock;
use crate::journal::{Journal, Kept, line, parse};
use crate::shard::journals;
use crate::{Part, Row, Shard, Study, StudyError};
use std::path::Path;

impl Study {
    /// The parts of so many that are not done in a folder, each with what is known of its runs: a journal that stands as
    /// `runs.journal` in the folder where the part is to be run. `retry_failed`: failed runs do not count as done.
    ///
    /// # Errors
    /// [`StudyError`] where the folder cannot be read or holds runs of something else.
    pub fn open_parts(
        &self,
        folder: &Path,
        of: usize,
        retry_failed: bool,
    ) -> Result<Vec<(Shard, Vec<u8>)>, StudyError> {
        let mut known = Kept::default().records;
        let there = if folder.exists() { journals(folder) } else { Ok(Vec::new()) };
        for (_, path) in there.map_err(StudyError::at(folder))? {
            for row in Kept::of(&path, &self.identity)?.records.iter() {
                // Of a run that several have made a good one counts.
                if row.good() || !(retry_failed || known.contains(row.run())) {
                    known.insert(row.record());
                }
            }
        }
        let length = self.plan.chain_length();
        let chains = self.identity.runs / length;
        let json = |e: serde_json::Error| StudyError::at(folder)(e.into());
        let mut open = Vec::new();
        for shard in (1..=of).filter_map(|index| Shard::new(index, of)) {
            let mut bytes = line(&self.identity).map_err(json)?.into_bytes();
            let mut over = true;
            for chain in shard.chains(chains) {
                let mut ended = false;
                for row in (chain * length..).take(length).map_while(|run| known.get(run)) {
                    bytes.extend(line(&row.record()).map_err(json)?.bytes());
                    ended = row.run() + 1 == (chain + 1) * length || self.ends_with(row);
                }
                over &= ended;
            }
            if !over {
                open.push((shard, bytes));
            }
        }
        Ok(open)
    }

    /// Adds what a part has made elsewhere, the bytes of its journal, to that of the part in a folder; returns how many
    /// runs that are.
    ///
    /// # Errors
    /// [`StudyError`] where the bytes are of another study, or the folder cannot be written.
    pub fn take_part(
        &self,
        folder: &Path,
        shard: Shard,
        journal: &[u8],
    ) -> Result<usize, StudyError> {
        std::fs::create_dir_all(folder).map_err(StudyError::at(folder))?;
        let part = Part::Shard(shard);
        let path = part.journal(folder);
        let made = parse(journal, &path, &self.identity)?.kept.records;
        let _lock = lock(&part.lock(folder), folder)?;
        let (mut own, kept) = Journal::open(&path, &self.identity)?;
        for record in made.iter().map(Row::record) {
            if kept.records.get(record.run).map(Row::record).as_ref() != Some(&record) {
                own.write(&record)?;
            }
        }
        own.sync()?;
        Ok(made.len())
    }
}
