//! The numbers of a factor, supernode by supernode, on as many threads as there are.
//!
//! ```text
//!   column block of a node s:   A_s − Σ L_d D_d (L_d rows of s)ᵀ          d: nodes before it with rows in its columns
//!                               = (L_ss D_s L_ssᵀ over L_bs D_s L_ssᵀ)    dense factor, then substitution
//! ```
//!
//! A node looks to the left only, at nodes before it, and takes from them in their order: so its bits are the same
//! whoever computes them and when. Subtrees of the elimination tree have nothing in common and are each computed by one
//! thread; the nodes above them one by one, where a thread waits for what another has not finished yet. All pieces are
//! handed out in an order in which nobody waits for a piece that nobody has.
//!
//! Reference: \[Ng & Peyton 1993\].

use super::substitution::{Node, Panels};
use crate::large::Large;
use crate::threads::share;
use crate::{LinalgError, Sparse};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{
    LdltError, LdltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_unit_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par};
use std::sync::{Mutex, OnceLock, PoisonError};

/// A subtree of its own takes one in so many of all operations at most.
const SUBTREES: f64 = 8.0;

/// What a factorisation does in what order.
#[derive(Debug, Default)]
pub(super) struct Elimination {
    /// Nodes before each that it takes from, one list after the other, and where these begin.
    sources: Vec<u32>,
    first: Vec<usize>,
    /// Nodes that one thread computes one after the other, and how many values they have.
    pub(super) pieces: Vec<Piece>,
    /// Of each node its piece, and where its values begin there.
    place: Vec<(u32, usize)>,
    operations: f64,
    /// Most columns of a node.
    columns: usize,
}

/// A subtree of the elimination tree, or a node above all of them.
#[derive(Debug)]
pub(super) struct Piece {
    pub nodes: Vec<u32>,
    /// True for a node above all subtrees.
    pub is_above: bool,
    values: usize,
}

/// A node with its place in the whole matrix.
#[derive(Clone, Copy)]
struct Place<'a> {
    start: usize,
    columns: usize,
    height: usize,
    /// Rows below the block on the diagonal, counted from `base`.
    rows: &'a [u32],
    base: usize,
}

impl Place<'_> {
    /// Number of its values, what stands above the diagonal included.
    fn values(&self) -> usize {
        self.columns * self.height
    }

    /// Number of rows below the diagonal block before a row of the matrix.
    fn before(&self, row: usize) -> usize {
        self.rows.partition_point(|r| *r as usize + self.base < row)
    }
}

/// Nodes of two groups: the front, and the tail that begins at a column.
#[derive(Clone, Copy)]
pub(super) struct Groups<'a> {
    pub front: &'a Panels,
    pub tail: &'a Panels,
    pub split: usize,
}

impl<'a> Groups<'a> {
    fn len(&self) -> usize {
        self.front.nodes.len() + self.tail.nodes.len()
    }

    pub(super) fn nodes(&self) -> impl Iterator<Item = &'a Node> {
        self.front.nodes.iter().chain(&self.tail.nodes)
    }

    fn place(&self, node: usize) -> Place<'a> {
        let fronts = self.front.nodes.len();
        let (group, node, base) = match node.checked_sub(fronts) {
            None => (self.front, node, 0),
            Some(node) => (self.tail, node, self.split),
        };
        let node = &group.nodes[node];
        let (columns, height) = (node.columns as usize, node.height as usize);
        let rows = &group.rows[node.rows..node.rows + height - columns];
        Place { start: node.start as usize + base, columns, height, rows, base }
    }
}

impl Elimination {
    pub(super) fn new(groups: Groups<'_>, order: usize) -> Self {
        let count = groups.len();
        let mut owner = vec![0_u32; order];
        for node in 0..count {
            let Place { start, columns, .. } = groups.place(node);
            owner[start..start + columns].fill(node as u32);
        }
        // The nodes that have rows of each: in order, as nodes are.
        let each_target = |node: usize, see: &mut dyn FnMut(u32)| {
            let place = groups.place(node);
            let mut last = u32::MAX;
            for row in place.rows {
                let target = owner[*row as usize + place.base];
                if target != last {
                    see(target);
                    last = target;
                }
            }
        };
        let mut first = vec![0; count + 1];
        let mut parent = vec![u32::MAX; count];
        for node in 0..count {
            each_target(node, &mut |target| {
                first[target as usize + 1] += 1;
                parent[node] = parent[node].min(target);
            });
        }
        for node in 0..count {
            first[node + 1] += first[node];
        }
        let mut next = first.clone();
        let mut sources = vec![0; first[count]];
        for node in 0..count {
            each_target(node, &mut |target| {
                sources[next[target as usize]] = node as u32;
                next[target as usize] += 1;
            });
        }
        // Work of a node for all that take from it, and of its subtree.
        let work = |node: usize| {
            let Place { columns, height, .. } = groups.place(node);
            columns as f64 * (height as f64).powi(2)
        };
        let mut below: Vec<f64> = (0..count).map(work).collect();
        let operations = below.iter().sum();
        for node in 0..count {
            if parent[node] != u32::MAX {
                below[parent[node] as usize] += below[node];
            }
        }
        let mut piece = vec![u32::MAX; count];
        let (mut pieces, mut above) = (Vec::new(), Vec::new());
        for node in (0..count).rev() {
            let over = parent[node];
            piece[node] = match over {
                _ if over != u32::MAX && piece[over as usize] != u32::MAX => piece[over as usize],
                _ if below[node] <= operations / SUBTREES => {
                    pieces.push((below[node], Vec::new()));
                    pieces.len() as u32 - 1
                }
                _ => u32::MAX,
            };
        }
        for node in 0..count {
            match piece[node] {
                u32::MAX => above.push(vec![node as u32]),
                own => pieces[own as usize].1.push(node as u32),
            }
        }
        // The longest first, so that all end together.
        pieces.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut place = vec![(0, 0); count];
        let subtrees = pieces.len();
        let pieces = pieces.into_iter().map(|(_, nodes)| nodes).chain(above).enumerate();
        let pieces = pieces.map(|(piece, nodes)| {
            let mut values = 0;
            for node in &nodes {
                place[*node as usize] = (piece as u32, values);
                values += groups.place(*node as usize).values();
            }
            Piece { nodes, is_above: piece >= subtrees, values }
        });
        let pieces = pieces.collect();
        let columns = groups.nodes().map(|n| n.columns as usize).max().unwrap_or(0);
        Self { sources, first, pieces, place, operations, columns }
    }
}

/// The columns of the nodes of a piece, one after the other, or the place of a pivot that is none.
type Made = Result<Large, Refused>;

/// The first pivot that is zero or no number, and whether numbers have overflowed.
#[derive(Clone, Copy, Debug)]
struct Refused {
    place: usize,
    overflows: bool,
}

/// The matrix: a sum, with the equation of each place and the place of each equation.
#[derive(Clone, Copy)]
pub(super) struct Summed<'a> {
    pub parts: &'a [(f64, &'a Sparse)],
    pub equations: &'a [u32],
    pub places: &'a [u32],
}

/// What one thread needs.
struct Room {
    /// Where the rows of a node are among its own.
    local: Vec<u32>,
    /// Where the rows of a node before it are there.
    targets: Vec<u32>,
    scaled: Vec<f64>,
    product: Vec<f64>,
    work: MemBuffer,
}

/// The columns of the nodes of all pieces.
pub(super) fn factorise(
    plan: &Elimination,
    groups: Groups<'_>,
    of: Summed<'_>,
) -> Result<Vec<Large>, LinalgError> {
    let made: Vec<OnceLock<Made>> = plan.pieces.iter().map(|_| OnceLock::new()).collect();
    let rooms: Mutex<Vec<Room>> = Mutex::new(Vec::new());
    let rooms = || rooms.lock().unwrap_or_else(PoisonError::into_inner);
    let scratch = cholesky_in_place_scratch::<f64>(plan.columns, Par::Seq, Default::default());
    let new_room = || Room {
        local: vec![0; of.equations.len()],
        targets: Vec::new(),
        scaled: Vec::new(),
        product: Vec::new(),
        work: MemBuffer::new(scratch),
    };
    let all = Factorisation { plan, groups, of, made: &made };
    share(plan.operations as usize, (0..made.len()).collect(), |piece| {
        let _told = Told(&made[piece]);
        let mut room = rooms().pop().unwrap_or_else(new_room);
        let own = all.piece(piece, &mut room);
        made[piece].get_or_init(|| own);
        rooms().push(room);
    });
    let (mut values, mut refused) = (Vec::with_capacity(made.len()), None::<Refused>);
    for one in made {
        match one.into_inner() {
            Some(Ok(own)) => values.push(own),
            Some(Err(one)) if refused.is_none_or(|first| one.place < first.place) => {
                refused = Some(one);
            }
            _ => {}
        }
    }
    match refused {
        None => Ok(values),
        Some(Refused { place, overflows }) => {
            let equation = of.equations.get(place).map_or(place, |i| *i as usize);
            Err(if overflows {
                LinalgError::NotFinite { equation }
            } else {
                LinalgError::Singular { equation }
            })
        }
    }
}

/// Who waits for a piece learns that none will come, should its thread panic.
struct Told<'a>(&'a OnceLock<Made>);

impl Drop for Told<'_> {
    fn drop(&mut self) {
        self.0.get_or_init(|| Err(Refused { place: usize::MAX, overflows: false }));
    }
}

/// What all threads look at.
#[derive(Clone, Copy)]
struct Factorisation<'a> {
    plan: &'a Elimination,
    groups: Groups<'a>,
    of: Summed<'a>,
    made: &'a [OnceLock<Made>],
}

impl Factorisation<'_> {
    fn piece(&self, piece: usize, room: &mut Room) -> Made {
        let Piece { nodes, values, .. } = &self.plan.pieces[piece];
        let mut all = Large::zeros(*values);
        for node in nodes {
            let (before, own) = all.split_at_mut(self.plan.place[*node as usize].1);
            let place = self.groups.place(*node as usize);
            let own = &mut own[..place.values()];
            self.begin(place, own, room);
            let sources = &self.plan.first[*node as usize..][..2];
            for source in &self.plan.sources[sources[0]..sources[1]] {
                let (of, at) = self.plan.place[*source as usize];
                let from = match of as usize == piece {
                    true => &*before,
                    false => match self.made[of as usize].wait() {
                        Ok(values) => &**values,
                        Err(refused) => return Err(*refused),
                    },
                };
                let source = self.groups.place(*source as usize);
                take_off(source, &from[at..][..source.values()], place, own, room);
            }
            finish(place, own, &mut room.work)?;
        }
        Ok(all)
    }

    /// A_s.
    fn begin(&self, place: Place<'_>, values: &mut [f64], room: &mut Room) {
        let Place { start, columns, height, rows, base } = place;
        let Summed { parts, equations, places } = self.of;
        for (i, row) in rows.iter().enumerate() {
            room.local[*row as usize + base] = (columns + i) as u32;
        }
        for (j, column) in values.chunks_exact_mut(height.max(1)).enumerate() {
            for (factor, part) in parts {
                let (entries, numbers) = part.column(equations[start + j] as usize);
                for (i, v) in entries.iter().zip(numbers) {
                    let row = places[*i] as usize;
                    if row < start + j || *v == 0.0 {
                        continue;
                    }
                    let inside = row < start + columns;
                    let at = if inside { row - start } else { room.local[row] as usize };
                    column[at] += factor * v;
                }
            }
        }
    }
}

/// Takes L_d D_d (L_d)ᵀ of a node before it off the columns of a node.
fn take_off(
    before: Place<'_>,
    from: &[f64],
    place: Place<'_>,
    values: &mut [f64],
    room: &mut Room,
) {
    let Place { start, columns, height, .. } = place;
    let Room { local, targets, scaled, product, .. } = room;
    let (skipped, inside) = (before.before(start), before.before(start + columns));
    let (wide, high) = (inside - skipped, before.rows.len() - skipped);
    let panel = MatRef::from_column_major_slice(from, before.height, before.columns);
    let panel = panel.subrows(before.columns + skipped, high);
    scaled.clear();
    for j in 0..before.columns {
        let column = &from[j * before.height..][..before.height];
        let d = column[j];
        scaled.extend(column[before.columns + skipped..][..wide].iter().map(|l| d * l));
    }
    let scaled = MatRef::from_column_major_slice(scaled, wide, before.columns).transpose();
    // Where the rows are those of this node, the product is taken off at once.
    if wide == columns && high == height {
        let own = MatMut::from_column_major_slice_mut(values, height, columns);
        return add_product(own, Accum::Add, panel, scaled, -1.0);
    }
    product.resize(product.len().max(high * wide), 0.0);
    let product = &mut product[..high * wide];
    let to = MatMut::from_column_major_slice_mut(product, high, wide);
    add_product(to, Accum::Replace, panel, scaled, 1.0);
    // Where its rows are here: in the block on the diagonal, and below it.
    let rows = before.rows[skipped..].iter().map(|row| *row as usize + before.base);
    targets.clear();
    targets.extend(rows.enumerate().map(
        |(i, row)| {
            if i < wide { (row - start) as u32 } else { local[row] }
        },
    ));
    for (j, less) in product.chunks_exact(high).enumerate() {
        let own = &mut values[targets[j] as usize * height..][..height];
        for (row, x) in targets[j..].iter().zip(&less[j..]) {
            own[*row as usize] -= x;
        }
    }
}

/// `to` ± L (D Lᵀ), of which the block on the diagonal is symmetric: its lower triangle.
fn add_product(
    to: MatMut<'_, f64>,
    how: Accum,
    panel: MatRef<'_, f64>,
    scaled: MatRef<'_, f64>,
    factor: f64,
) {
    let wide = scaled.ncols();
    let (top, rest) = panel.split_at_row(wide);
    let (to_top, to_rest) = to.split_at_row_mut(wide);
    let (lower, full) = (BlockStructure::TriangularLower, BlockStructure::Rectangular);
    triangular::matmul(to_top, lower, how, top, full, scaled, full, factor, Par::Seq);
    matmul(to_rest, how, rest, scaled, factor, Par::Seq);
}

/// The factor of a node from which all before it has been taken.
fn finish(place: Place<'_>, values: &mut [f64], work: &mut MemBuffer) -> Result<(), Refused> {
    let Place { start, columns, height, .. } = place;
    let all = MatMut::from_column_major_slice_mut(values, height, columns);
    let (mut top, below) = all.split_at_row_mut(columns);
    let made = cholesky_in_place(
        top.as_mut(),
        LdltRegularization::default(),
        Par::Seq,
        MemStack::new(work),
        Default::default(),
    );
    if let Err(LdltError::ZeroPivot { index }) = made {
        // Dividing by a zero pivot comes after it is refused, so what is not finite has overflowed.
        let overflows = values.iter().any(|v| !v.is_finite());
        return Err(Refused { place: start + index, overflows });
    }
    solve_unit_lower_triangular_in_place(top.as_ref(), below.transpose_mut(), Par::Seq);
    for (j, column) in values.chunks_exact_mut(height.max(1)).enumerate() {
        let d = column[j].recip();
        column[columns..].iter_mut().for_each(|l| *l *= d);
    }
    Ok(())
}
