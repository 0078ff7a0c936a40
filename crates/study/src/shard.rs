//! Parts of a study that run on their own, on as many machines as there are.
//!
//! Every part keeps a journal of its own in the folder of the study, which all machines see; nothing else is shared, and
//! no part waits for another one. Blocks of chains of runs go to the parts in turn: in turn, so that parts are about equally
//! long; in blocks, as runs that follow each other are alike, and alike they go side by side at the least cost.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// One of several parts of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Shard {
    /// Which one, from 1.
    index: usize,
    /// How many there are.
    of: usize,
}

/// Most parts of a study: each has a file.
const MOST: usize = 1000;
/// Chains in a block, about: two widths of the lanes of most processors.
const BLOCK: usize = 16;

impl Shard {
    /// Part `index`, from 1, of so many; none where there is no such part.
    #[must_use]
    pub fn new(index: usize, of: usize) -> Option<Self> {
        ((1..=of).contains(&index) && of <= MOST).then_some(Self { index, of })
    }

    /// Which one, from 1.
    #[must_use]
    pub fn index(self) -> usize {
        self.index
    }

    /// How many there are.
    #[must_use]
    pub fn of(self) -> usize {
        self.of
    }

    /// Its chains, of so many, in rising order.
    ///
    /// All chains are cut into blocks, of which each part has equally many; the blocks differ by one chain at most.
    pub(crate) fn chains(self, all: usize) -> Vec<usize> {
        let rounds = (all / (self.of * BLOCK)).max(1);
        let blocks = self.of * rounds;
        let own = (self.index - 1..blocks).step_by(self.of);
        own.flat_map(|b| b * all / blocks..(b + 1) * all / blocks).collect()
    }

    /// Between the parts of the names of its files.
    fn infix(self) -> String {
        format!(".{}-of-{}", self.index, self.of)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let wanted = || {
            format!("a part of several is wanted, such as `3/20`, from 1 on and of {MOST} at most")
        };
        let (index, of) = text.split_once('/').ok_or_else(wanted)?;
        let number = |text: &str| text.trim().parse().map_err(|_| wanted());
        Self::new(number(index)?, number(of)?).ok_or_else(wanted)
    }
}

/// Which runs of a study are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Part {
    /// All that are missing; then the tables are written.
    #[default]
    All,
    /// Those of a part; no tables.
    Shard(Shard),
    /// None: the tables are written of what the parts have made.
    Gather,
}

impl Part {
    fn infix(self) -> String {
        if let Self::Shard(shard) = self { shard.infix() } else { String::new() }
    }

    /// The file that another process is kept out by.
    pub(crate) fn lock(self, folder: &Path) -> PathBuf {
        folder.join(format!("lock{}", self.infix()))
    }

    /// Its journal.
    pub(crate) fn journal(self, folder: &Path) -> PathBuf {
        folder.join(format!("runs{}.journal", self.infix()))
    }

    /// Its chains, of so many, in rising order.
    pub(crate) fn chains(self, all: usize) -> Vec<usize> {
        if let Self::Shard(shard) = self { shard.chains(all) } else { (0..all).collect() }
    }
}

/// True for a folder in which a study, or a part of one, has been run.
#[must_use]
pub fn is_study_folder(folder: &Path) -> bool {
    let begun = |(_, path): &(Part, PathBuf)| path.metadata().is_ok_and(|file| file.len() > 0);
    journals(folder).is_ok_and(|all| all.iter().any(begun))
}

/// All journals in the folder of a study, that of the whole first, then those of parts, in order.
pub(crate) fn journals(folder: &Path) -> std::io::Result<Vec<(Part, PathBuf)>> {
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let part = path.file_name().and_then(|name| part_of(name.to_str()?));
        all.extend(part.map(|part| (part, path)));
    }
    all.sort_by_key(|(part, _)| match part {
        Part::Shard(shard) => Some((shard.of, shard.index)),
        Part::All | Part::Gather => None,
    });
    Ok(all)
}

/// Whose journal has this name.
fn part_of(name: &str) -> Option<Part> {
    if name == "runs.journal" {
        return Some(Part::All);
    }
    let (index, of) = name.strip_prefix("runs.")?.strip_suffix(".journal")?.split_once("-of-")?;
    let shard = Shard::new(index.parse().ok()?, of.parse().ok()?)?;
    // `runs.01-of-20.journal` is nobody's.
    (shard.infix() == format!(".{index}-of-{of}")).then_some(Part::Shard(shard))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_chain_belongs_to_one_part() {
        for all in [0, 1, 5, 20, 103, 1000] {
            for of in [1, 2, 7, 20] {
                let mut seen = vec![0; all];
                let mut most = 0;
                let mut least = all;
                for index in 1..=of {
                    let own = Shard::new(index, of).unwrap().chains(all);
                    own.iter().for_each(|i| seen[*i] += 1);
                    (most, least) = (most.max(own.len()), least.min(own.len()));
                }
                assert!(seen.iter().all(|n| *n == 1), "{all} {of}: {seen:?}");
                // About equally long: a chain more or less for each block.
                assert!(most - least <= (all / (of * BLOCK)).max(1), "{all} {of}: {least} {most}");
            }
        }
    }

    #[test]
    fn parts_have_chains_of_everywhere_in_blocks() {
        let own = Shard::new(2, 4).unwrap().chains(256);
        assert_eq!(own.len(), 64);
        let starts: Vec<usize> = own.chunks(16).map(|block| block[0]).collect();
        assert_eq!(starts, [16, 80, 144, 208]);
        assert!(own.chunks(16).all(|block| block.windows(2).all(|w| w[1] == w[0] + 1)));
    }

    #[test]
    fn parts_have_names() {
        let shard: Shard = "3/20".parse().unwrap();
        let folder = Path::new("out");
        assert_eq!(Part::Shard(shard).journal(folder), folder.join("runs.3-of-20.journal"));
        assert_eq!(Part::Gather.journal(folder), folder.join("runs.journal"));
        assert_eq!(part_of("runs.3-of-20.journal"), Some(Part::Shard(shard)));
        assert_eq!(part_of("runs.journal"), Some(Part::All));
        for other in ["runs.21-of-20.journal", "runs.03-of-20.journal", "runs.journal~", "x"] {
            assert_eq!(part_of(other), None, "{other}");
        }
        for wrong in ["0/20", "21/20", "3", "3/0", "a/b", "-1/2", "1/1001"] {
            assert!(wrong.parse::<Shard>().unwrap_err().contains("3/20"), "{wrong}");
        }
    }
}
