//! Which of many outputs are shown.

use std::collections::BTreeMap;

/// Up to so many outputs, all are shown.
pub(crate) const WHOLE: usize = 60;
/// Of more, so many: the first of the file, and the largest.
pub(crate) const SHOWN: usize = 40;
/// The first of the file: what its author cares for most.
pub(crate) const FIRST: usize = 8;

/// Whether each output is shown, from its unit and its largest magnitude. Of more than [`WHOLE`] these are the first
/// [`FIRST`] and the largest of each unit, the units by turns.
pub(crate) fn chosen(all: &[(&str, f64)]) -> Vec<bool> {
    if all.len() <= WHOLE {
        return vec![true; all.len()];
    }
    let mut chosen = vec![false; all.len()];
    chosen[..FIRST].fill(true);
    let mut units: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (i, (unit, _)) in all.iter().enumerate().skip(FIRST) {
        units.entry(unit).or_default().push(i);
    }
    for of_unit in units.values_mut() {
        // Stable: equal ones stay in the order of the file.
        of_unit.sort_by(|a, b| all[*b].1.total_cmp(&all[*a].1));
    }
    let longest = units.values().map(Vec::len).max().unwrap_or(0);
    let by_turns = (0..longest).flat_map(|k| units.values().filter_map(move |u| u.get(k)));
    by_turns.take(SHOWN - FIRST).for_each(|i| chosen[*i] = true);
    chosen
}
