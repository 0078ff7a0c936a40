//! Products of the blocks of links with flat arrays.

use crate::links::LinkInstance;

/// Links of `n` coordinates each that lie one after the other in the flat arrays.
#[derive(Clone, Copy, Debug)]
struct Run {
    n: usize,
    count: usize,
    coordinate: usize,
    block: usize,
}

/// A link of one coordinate, and where its block lies.
#[derive(Clone, Copy, Debug)]
struct Single {
    coordinate: usize,
    block: usize,
}

/// A matrix of one block for each link, as in [`Tangents`](crate::Tangents).
#[derive(Clone, Debug, Default)]
pub struct LinkBlocks {
    singles: Vec<Single>,
    /// Of more coordinates.
    runs: Vec<Run>,
}

impl LinkBlocks {
    /// Of some links, in their order; the blocks of others count as zero.
    pub fn of<'a>(links: impl Iterator<Item = &'a LinkInstance>) -> Self {
        let (mut singles, mut runs): (_, Vec<Run>) = (Vec::new(), Vec::new());
        for link in links {
            let (n, coordinate, block) = (link.range.len(), link.range.start, link.block.start);
            if n == 1 {
                singles.push(Single { coordinate, block });
                continue;
            }
            let joins = |run: &&mut Run| {
                let (before, blocks) = (run.count * n, run.count * n * n);
                run.n == n && (run.coordinate + before, run.block + blocks) == (coordinate, block)
            };
            match runs.last_mut().filter(joins) {
                Some(run) => run.count += 1,
                None => runs.push(Run { n, count: 1, coordinate, block }),
            }
        }
        Self { singles, runs }
    }

    /// `y += A (x₁ − x₀)`, all flat; `blocks` are those of A.
    ///
    /// # Panics
    /// Where an array is shorter than the links that this was made of.
    pub fn add_change(&self, blocks: &[f64], [x0, x1]: [&[f64]; 2], y: &mut [f64]) {
        for Single { coordinate: i, block } in self.singles.iter().copied() {
            y[i] += blocks[block] * (x1[i] - x0[i]);
        }
        for run in &self.runs {
            let Run { n, count, coordinate, block } = *run;
            let r = coordinate..coordinate + count * n;
            let (x, y) = ([&x0[r.clone()], &x1[r.clone()]], &mut y[r]);
            let blocks = &blocks[block..block + count * n * n];
            match n {
                2 => small::<2>(blocks, x, y),
                3 => small::<3>(blocks, x, y),
                6 => small::<6>(blocks, x, y),
                _ => {
                    let [x0, x1] = x.map(|x| x.chunks_exact(n));
                    let own = x0.zip(x1).zip(y.chunks_exact_mut(n));
                    for (block, ((x0, x1), y)) in blocks.chunks_exact(n * n).zip(own) {
                        for (row, y) in block.chunks_exact(n).zip(y) {
                            let change = x0.iter().zip(x1).map(|(x0, x1)| x1 - x0);
                            row.iter().zip(change).for_each(|(a, x)| *y += a * x);
                        }
                    }
                }
            }
        }
    }
}

/// The same for blocks of a size that the compiler knows; a function each, so that none prepares for all.
#[inline(never)]
fn small<const N: usize>(blocks: &[f64], x: [&[f64]; 2], y: &mut [f64]) {
    let (rows, _) = blocks.as_chunks::<N>();
    let [x0, x1] = x.map(|x| x.as_chunks::<N>().0);
    let own = x0.iter().zip(x1).zip(y.as_chunks_mut::<N>().0);
    for (rows, ((x0, x1), y)) in rows.as_chunks::<N>().0.iter().zip(own) {
        for i in 0..N {
            for j in 0..N {
                y[i] += rows[i][j] * (x1[j] - x0[j]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn links(sizes: &[usize]) -> Vec<LinkInstance> {
        let (mut coordinate, mut block) = (0, 0);
        let link = |n: &usize| {
            let range = coordinate..coordinate + n;
            let link = LinkInstance {
                element: 0,
                range,
                block: block..block + n * n,
                history: 0..0,
                tilts: 0,
                settled: None,
            };
            (coordinate, block) = (coordinate + n, block + n * n);
            link
        };
        sizes.iter().map(link).collect()
    }

    #[test]
    fn products_are_those_of_the_blocks_one_by_one() {
        let sizes = [2, 2, 1, 3, 3, 6, 4, 4, 1, 1];
        let links = links(&sizes);
        let (n, m) = (links.last().unwrap().range.end, links.last().unwrap().block.end);
        let blocks: Vec<f64> = (0..m).map(|i| (i as f64 * 0.7).sin()).collect();
        let x: Vec<f64> = (0..n).map(|i| (i as f64 * 1.3).cos()).collect();
        let x0: Vec<f64> = (0..n).map(|i| (i as f64 * 2.1).sin()).collect();
        for some in [|_: usize| true, |i: usize| !i.is_multiple_of(3)] {
            let chosen = || links.iter().enumerate().filter(|(i, _)| some(*i)).map(|(_, l)| l);
            let mut y = vec![0.5; n];
            LinkBlocks::of(chosen()).add_change(&blocks, [&x0, &x], &mut y);
            let mut expected = vec![0.5; n];
            for link in chosen() {
                let n = link.range.len();
                for i in 0..n {
                    for j in 0..n {
                        expected[link.range.start + i] += blocks[link.block.start + i * n + j]
                            * (x[link.range.start + j] - x0[link.range.start + j]);
                    }
                }
            }
            assert_eq!(y, expected);
        }
    }
}
