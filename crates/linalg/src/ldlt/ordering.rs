//! Fill-reducing order of elimination with chosen equations at the end.
//!
//! The other equations are ordered by approximate minimum degree on their own graph. On frames on isolators
//! this mostly leaves a little less fill than an order of the whole graph with the chosen ones moved to its
//! end (measured: between 7 % less and 8 % more). Then the order is made a postorder of the elimination tree,
//! which leaves the fill alone and brings columns of equal pattern side by side.
//!
//! References: \[Amestoy, Davis, Duff 1996\]; \[Liu 1990\].

use crate::LinalgError;
use crate::ldlt::backend;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

const NONE: usize = usize::MAX;

/// The lower triangle of a symmetric pattern in compressed columns, diagonal included.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pattern {
    pub offsets: Vec<usize>,
    pub rows: Vec<usize>,
}

impl Pattern {
    pub(crate) fn order(&self) -> usize {
        self.offsets.len() - 1
    }

    fn column(&self, j: usize) -> &[usize] {
        &self.rows[self.offsets[j]..self.offsets[j + 1]]
    }

    /// Neighbours of every equation, both triangles, without the diagonal.
    fn neighbours(&self) -> Self {
        let n = self.order();
        let mut offsets = vec![0; n + 1];
        let pairs = || (0..n).flat_map(|j| self.column(j).iter().map(move |i| (*i, j)));
        for (i, j) in pairs().filter(|(i, j)| i != j) {
            offsets[i + 1] += 1;
            offsets[j + 1] += 1;
        }
        for j in 0..n {
            offsets[j + 1] += offsets[j];
        }
        let mut next = offsets.clone();
        let mut rows = vec![0; offsets[n]];
        for (i, j) in pairs().filter(|(i, j)| i != j) {
            for (a, b) in [(i, j), (j, i)] {
                rows[next[a]] = b;
                next[a] += 1;
            }
        }
        Self { offsets, rows }
    }
}

/// The order of elimination: equation of each place; `last` (sorted) take the last places.
pub(crate) fn order(pattern: &Pattern, last: &[usize]) -> Result<Vec<usize>, LinalgError> {
    let n = pattern.order();
    let mut own = vec![0; n];
    last.iter().for_each(|i| own[*i] = NONE);
    let front: Vec<usize> = (0..n).filter(|i| own[*i] != NONE).collect();
    front.iter().enumerate().for_each(|(new, old)| own[*old] = new);
    let mut part = Pattern { offsets: vec![0], rows: Vec::new() };
    for j in &front {
        part.rows.extend(pattern.column(*j).iter().map(|i| own[*i]).filter(|i| *i != NONE));
        part.offsets.push(part.rows.len());
    }
    let by_degree = minimum_degree(&part)?.into_iter().map(|i| front[i]);
    let order: Vec<usize> = by_degree.chain(last.iter().copied()).collect();
    let parent = elimination_tree(&pattern.neighbours(), &order);
    Ok(postorder(&parent, front.len()).into_iter().map(|p| order[p]).collect())
}

fn minimum_degree(pattern: &Pattern) -> Result<Vec<usize>, LinalgError> {
    let n = pattern.order();
    let (mut forward, mut inverse) = (vec![0; n], vec![0; n]);
    let scratch = amd::order_maybe_unsorted_scratch::<usize>(n, pattern.rows.len());
    let mut work = MemBuffer::try_new(scratch).map_err(backend)?;
    amd::order_maybe_unsorted(
        &mut forward,
        &mut inverse,
        SymbolicSparseColMatRef::new_checked(n, n, &pattern.offsets, None, &pattern.rows),
        amd::Control::default(),
        MemStack::new(&mut work),
    )
    .map_err(backend)?;
    Ok(forward)
}

/// Parent of each place in the elimination tree.
fn elimination_tree(neighbours: &Pattern, order: &[usize]) -> Vec<usize> {
    let n = order.len();
    let mut place = vec![0; n];
    order.iter().enumerate().for_each(|(p, i)| place[*i] = p);
    let (mut parent, mut ancestor) = (vec![NONE; n], vec![NONE; n]);
    for k in 0..n {
        for i in neighbours.column(order[k]) {
            let mut at = place[*i];
            while at < k {
                let next = ancestor[at];
                ancestor[at] = k;
                if next == NONE {
                    parent[at] = k;
                    break;
                }
                at = next;
            }
        }
    }
    parent
}

/// Depth first through the trees of the places before `split`, then through those from there on.
fn postorder(parent: &[usize], split: usize) -> Vec<usize> {
    let n = parent.len();
    let mut found = Vec::with_capacity(n);
    for (from, to) in [(0, split), (split, n)] {
        // Children as linked lists, lowest first.
        let (mut child, mut sibling) = (vec![NONE; n], vec![NONE; n]);
        let is_root = |p: usize| parent[p] == NONE || parent[p] >= to;
        for p in (from..to).rev().filter(|p| !is_root(*p)) {
            sibling[p] = child[parent[p]];
            child[parent[p]] = p;
        }
        for root in (from..to).filter(|p| is_root(*p)) {
            let mut path = vec![root];
            while let Some(top) = path.last().copied() {
                if child[top] == NONE {
                    found.push(top);
                    path.pop();
                } else {
                    path.push(child[top]);
                    child[top] = sibling[child[top]];
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A comb: teeth hang on a spine, each a chain.
    #[test]
    fn chosen_equations_come_last_and_subtrees_are_together() {
        let (teeth, length) = (20, 6);
        let n = teeth * length;
        let mut pattern = Pattern { offsets: vec![0], rows: Vec::new() };
        for j in 0..n {
            pattern.rows.push(j);
            // Along the tooth, and along the spine of the first of each.
            pattern.rows.extend((!(j + 1).is_multiple_of(length)).then_some(j + 1));
            let next = j + length;
            pattern.rows.extend((j.is_multiple_of(length) && next < n).then_some(next));
            pattern.offsets.push(pattern.rows.len());
        }
        let spine: Vec<usize> = (0..teeth).map(|t| t * length).collect();
        let order = order(&pattern, &spine).unwrap();
        assert!(order[n - teeth..].iter().all(|i| i.is_multiple_of(length)));
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..n).collect::<Vec<_>>());
        // A postorder: every subtree is a run of places that ends at its root.
        let parent = elimination_tree(&pattern.neighbours(), &order);
        let mut first: Vec<usize> = (0..n).collect();
        for p in 0..n - teeth {
            if parent[p] < n - teeth {
                first[parent[p]] = first[parent[p]].min(first[p]);
            }
        }
        for p in 0..n - teeth {
            let inside = (first[p]..p).all(|q| parent[q] <= p);
            assert!(inside, "{p}");
        }
    }
}
