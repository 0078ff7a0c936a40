//! Some of the modes.

use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Modes in a word.
const WORD: usize = u64::BITS as usize;

/// Some of the modes of a structure: a bit each, none behind the last one. Copies share them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "Vec<u64>", into = "Vec<u64>")]
pub(crate) struct ModeSet(Option<Arc<[u64]>>);

impl ModeSet {
    /// Becomes those of so many modes for which that holds, and stays what it is where it is that already; `room` is what it
    /// is made in.
    pub fn renew(&mut self, modes: usize, holds: impl Fn(usize) -> bool, room: &mut Vec<u64>) {
        room.clear();
        for mode in (0..modes).filter(|mode| holds(*mode)) {
            room.resize(mode / WORD + 1, 0);
            room[mode / WORD] |= 1 << (mode % WORD);
        }
        if self.words() != room {
            *self = Self::from(&room[..]);
        }
    }

    fn words(&self) -> &[u64] {
        self.0.as_deref().unwrap_or_default()
    }

    /// True where none is in it.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.0.is_none()
    }

    /// True for a mode that is in it.
    pub fn has(&self, mode: usize) -> bool {
        self.words().get(mode / WORD).is_some_and(|word| word >> (mode % WORD) & 1 == 1)
    }
}

impl From<&[u64]> for ModeSet {
    fn from(words: &[u64]) -> Self {
        let end = words.iter().rposition(|word| *word != 0).map_or(0, |last| last + 1);
        Self((end > 0).then(|| words[..end].into()))
    }
}

impl From<Vec<u64>> for ModeSet {
    fn from(words: Vec<u64>) -> Self {
        Self::from(&words[..])
    }
}

impl From<ModeSet> for Vec<u64> {
    fn from(set: ModeSet) -> Self {
        set.words().to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    impl ModeSet {
        fn of(modes: usize, holds: impl Fn(usize) -> bool) -> Self {
            let mut set = Self::default();
            set.renew(modes, holds, &mut Vec::new());
            set
        }
    }

    #[test]
    fn every_mode_has_a_bit_of_its_own() {
        let odd = ModeSet::of(300, |mode| mode % 2 == 1);
        assert!((0..400).all(|mode| odd.has(mode) == (mode < 300 && mode % 2 == 1)));
        assert!(ModeSet::of(300, |_| false).is_empty() && ModeSet::of(0, |_| true).is_empty());
        // The same modes are the same set, however many there might be.
        assert_eq!(ModeSet::of(70, |mode| mode == 3), ModeSet::of(4, |mode| mode == 3));
        assert_ne!(ModeSet::of(70, |mode| mode == 64), ModeSet::of(70, |mode| mode == 65));
    }

    #[test]
    fn a_set_that_is_renewed_as_it_was_is_shared_with_its_copies() {
        let (mut set, mut room) = (ModeSet::of(100, |mode| mode > 80), Vec::new());
        let copy = set.clone();
        set.renew(100, |mode| mode > 80, &mut room);
        assert!(Arc::ptr_eq(copy.0.as_ref().unwrap(), set.0.as_ref().unwrap()));
        set.renew(100, |mode| mode > 81, &mut room);
        assert!(copy.has(81) && !set.has(81) && copy != set);
    }

    #[test]
    fn a_set_is_written_and_read_again() {
        for set in [ModeSet::default(), ModeSet::of(200, |mode| mode % 7 == 0)] {
            assert_eq!(ModeSet::from(Vec::from(set.clone())), set);
        }
    }
}
