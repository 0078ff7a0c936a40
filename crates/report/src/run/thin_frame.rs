//! Large frames as small pictures: members that were cut into elements are one line again.

use std::collections::{BTreeMap, BTreeSet};

/// Lines over nodes. A node that only continues a member (two lines, nothing else) is passed over.
pub(crate) fn joined(
    lines: &[(usize, [usize; 2])],
    needed: &BTreeSet<usize>,
) -> Vec<(usize, [usize; 2])> {
    let mut at: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (i, (_, ends)) in lines.iter().enumerate() {
        ends.iter().for_each(|n| at.entry(*n).or_default().push(i));
    }
    let passes = |n: usize| !needed.contains(&n) && at.get(&n).is_some_and(|l| l.len() == 2);
    let mut seen = vec![false; lines.len()];
    let mut out = Vec::new();
    // From every joint along its lines to the next joint.
    let joints = at.keys().copied().filter(|n| !passes(*n));
    for start in joints {
        for first in &at[&start] {
            if seen[*first] {
                continue;
            }
            let (mut line, mut node) = (*first, start);
            loop {
                seen[line] = true;
                let [a, b] = lines[line].1;
                node = if a == node { b } else { a };
                let next = if passes(node) { at[&node].iter().find(|l| !seen[**l]) } else { None };
                match next {
                    Some(next) => line = *next,
                    None => break,
                }
            }
            out.push((lines[*first].0, [start, node]));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_member_cut_in_three_is_one_line_and_a_joint_stays() {
        // 0–1–2–3 is a member, 3 is a joint with 4 and 5.
        let lines = [(7, [0, 1]), (8, [2, 1]), (9, [2, 3]), (10, [3, 4]), (11, [5, 3])];
        let found = joined(&lines, &BTreeSet::new());
        assert_eq!(found.len(), 3);
        assert_eq!(found[0], (7, [0, 3]));
        let held = joined(&lines, &BTreeSet::from([1]));
        assert_eq!(held.len(), 4, "{held:?}");
    }
}
