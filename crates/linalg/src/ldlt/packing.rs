//! How the columns of a supernode lie in memory.
//!
//! ```text
//!   four columns a b c d at place j:    l_ba l_ca l_da l_cb l_db l_dc         within the block on the diagonal
//!                                       a₀ … a₇ b₀ … b₇ c₀ … c₇ d₀ … d₇       eight rows below it
//!                                       a₈ …                                  the next eight, at last those left
//!   columns left over:                  one after the other, below the diagonal
//! ```
//!
//! Four columns are used together and read as one stream: a step of direct integration takes about a tenth less than
//! with columns one after the other. What lies on and above the diagonal is left out, a quarter of a large frame's
//! factor.

use super::substitution::{Node, Panels};
use crate::large::Large;

/// Columns handled at once.
pub(super) const WIDTH: usize = 4;
/// Rows of them that lie together.
pub(super) const TILE: usize = 8;
/// Values within the block of four columns on the diagonal.
pub(super) const BLOCK: usize = WIDTH * (WIDTH - 1) / 2;

impl Node {
    /// Number of its values: all below the diagonal.
    pub(super) fn packed(&self) -> usize {
        let (columns, height) = (self.columns as usize, self.height as usize);
        columns * height - columns * (columns + 1) / 2
    }

    /// Packs its columns, of which the first begins the given values and the others are `stride` apart.
    fn pack(&self, from: &[f64], stride: usize, to: &mut [f64]) {
        let (columns, height) = (self.columns as usize, self.height as usize);
        let (mut j, mut at) = (0, 0);
        let mut put = |values: &[f64]| {
            to[at..at + values.len()].copy_from_slice(values);
            at += values.len();
        };
        while j + WIDTH <= columns {
            let column = |k: usize| &from[(j + k) * stride..][..height][j..];
            let all = [column(0), column(1), column(2), column(3)];
            for (k, l) in all.iter().enumerate() {
                put(&l[k + 1..WIDTH]);
            }
            let rows = height - j;
            for start in (WIDTH..rows).step_by(TILE) {
                all.iter().for_each(|l| put(&l[start..rows.min(start + TILE)]));
            }
            j += WIDTH;
        }
        for j in j..columns {
            put(&from[j * stride..][j + 1..height]);
        }
    }
}

/// Values of four columns, the first of which is so high.
pub(super) fn four(height: usize) -> usize {
    BLOCK + WIDTH * (height - WIDTH)
}

/// Where columns lie in a factor that is not packed: of each node in turn, the first value and the distance of
/// columns.
#[derive(Clone, Debug, Default)]
pub(super) struct Unpacked(pub Vec<(usize, u32)>);

impl Unpacked {
    /// The diagonal, of all nodes.
    pub(super) fn diagonal<'a>(
        &'a self,
        groups: [&'a Panels; 2],
        values: &'a [f64],
    ) -> impl Iterator<Item = f64> + 'a {
        let nodes = groups.into_iter().flat_map(|g| &g.nodes);
        nodes.zip(&self.0).flat_map(move |(node, (first, stride))| {
            (0..node.columns as usize).map(move |j| values[first + j * (*stride as usize + 1)])
        })
    }

    /// All nodes packed.
    pub(super) fn pack(&self, groups: [&Panels; 2], values: &[f64]) -> Large {
        let nodes = || groups.into_iter().flat_map(|g| &g.nodes);
        let mut packed = Large::zeros(nodes().map(Node::packed).sum());
        for (node, (first, stride)) in nodes().zip(&self.0) {
            node.pack(
                &values[*first..],
                *stride as usize,
                &mut packed[node.values..][..node.packed()],
            );
        }
        packed
    }
}
