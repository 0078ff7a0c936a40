//! How far the parts of a study are.

use crate::journal::Kept;
use crate::shard::journals;
use crate::{Part, Records, Row, Study, StudyError};
use std::path::Path;

/// What a journal in the folder of a study holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartStatus {
    /// Whose journal it is: that of the whole, or of a part.
    pub part: Part,
    /// Runs that it has.
    pub done: usize,
    /// Runs of this part at most; a series may end before.
    pub of: usize,
    /// Runs that failed.
    pub failed: usize,
    /// Series of the part that are not at their end.
    pub open: usize,
}

/// All journals in a folder, and how many series of the whole study are not at their end, whoever has made their runs.
///
/// # Errors
/// [`StudyError`] where the folder cannot be read or holds runs of something else.
pub fn status(study: &Study, folder: &Path) -> Result<(Vec<PartStatus>, usize), StudyError> {
    let length = study.plan.chain_length();
    let chains = study.identity.runs / length;
    let mut known = Records::default();
    let mut all = Vec::new();
    for (part, path) in journals(folder).map_err(StudyError::at(folder))? {
        let own = Kept::of(&path, &study.identity)?.records;
        let failed = own.iter().filter(|row| !row.good()).count();
        let own_chains = part.chains(chains);
        all.push((
            PartStatus { part, done: own.len(), of: own_chains.len() * length, failed, open: 0 },
            own_chains,
        ));
        known.extend(own.iter().map(Row::record));
    }
    // Series are at their end with their last run, or where the limit of the study holds.
    let over = |chain: usize| {
        let runs = chain * length..(chain + 1) * length;
        runs.clone().all(|run| known.contains(run))
            || runs.map_while(|run| known.get(run)).any(|row| study.ends_with(row))
    };
    let open: Vec<bool> = (0..chains).map(|chain| !over(chain)).collect();
    let parts = all.into_iter().map(|(status, own_chains)| {
        let of_part = own_chains.iter().filter(|chain| open[**chain]).count();
        PartStatus { open: of_part, ..status }
    });
    Ok((parts.collect(), open.iter().filter(|open| **open).count()))
}
