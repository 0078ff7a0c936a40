//! Where the numbers of the links of a pack lie in a flat array.

use trilith_element::lanes::Arithmetic;

/// Lanes of every arithmetic that has several.
pub(super) const WIDTH: usize = 8;

/// Which of its links a pack has in each lane: those that are left repeat others.
pub(super) type Order = [usize; WIDTH];

/// Where the numbers of each link begin.
#[derive(Clone, Debug)]
pub(super) struct Places {
    /// In the order of the links.
    starts: Vec<usize>,
    order: Order,
    /// The lane of each link.
    lanes: Vec<usize>,
    /// Where the first begins, if the links have two numbers each that lie one link after the other: then they are
    /// read and written in whole registers.
    pairs: Option<usize>,
}

/// The order in which whole registers of pairs come apart.
pub(super) fn order_of_pairs<A: Arithmetic>(with: A, count: usize) -> Order {
    let numbers: [f64; 2 * WIDTH] = std::array::from_fn(|i| ((i / 2) % count) as f64);
    let [first, _] = with.split_pairs(&numbers);
    std::array::from_fn(|lane| with.lane(first, lane) as usize)
}

/// True for starts of pairs, one after the other, that fill registers: as many as there are lanes, or half as many.
pub(super) fn are_pairs(starts: &[usize]) -> bool {
    let fills = [WIDTH, WIDTH / 2].contains(&starts.len());
    fills && starts.windows(2).all(|two| two[0] + 2 == two[1])
}

impl Places {
    /// Of links whose numbers begin at `starts`; `paired`: whether `order` is that of pairs.
    pub fn new(starts: Vec<usize>, order: Order, paired: bool) -> Self {
        let lane = |link: usize| order.iter().position(|own| *own == link).unwrap_or(0);
        let lanes = (0..starts.len()).map(lane).collect();
        let pairs = starts.first().copied().filter(|_| paired && are_pairs(&starts));
        Self { starts, order, lanes, pairs }
    }

    /// The lane of each link.
    pub fn lanes(&self) -> &[usize] {
        &self.lanes
    }

    /// A row of lanes for each of the `N` numbers that the links have in a flat array.
    #[inline(always)]
    pub fn take<A: Arithmetic, const N: usize>(&self, with: A, from: &[f64], to: &mut [A::Real]) {
        if let (2, Some(start)) = (N, self.pairs) {
            let mut own = [0.0; 2 * WIDTH];
            if self.starts.len() == WIDTH {
                own.copy_from_slice(&from[start..start + 2 * WIDTH]);
            } else {
                let (first, second) = own.split_at_mut(WIDTH);
                first.copy_from_slice(&from[start..start + WIDTH]);
                second.copy_from_slice(&from[start..start + WIDTH]);
            }
            to[..2].copy_from_slice(&with.split_pairs(&own));
            return;
        }
        let mut own = [&[0.0; N]; WIDTH];
        for (own, link) in own.iter_mut().zip(&self.order) {
            *own = from[self.starts[*link]..].first_chunk().expect("numbers of a link");
        }
        for (i, x) in to.iter_mut().enumerate().take(N) {
            *x = with.gather(|lane| own[lane][i]);
        }
    }

    /// Puts the numbers of the links into a flat array.
    #[inline(always)]
    pub fn give<A: Arithmetic, const N: usize>(&self, with: A, from: &[A::Real], to: &mut [f64]) {
        if let (2, Some(start)) = (N, self.pairs) {
            let own = with.join_pairs([from[0], from[1]]);
            let count = 2 * self.starts.len();
            if count == 2 * WIDTH {
                to[start..start + 2 * WIDTH].copy_from_slice(&own);
            } else {
                to[start..start + WIDTH].copy_from_slice(&own[..WIDTH]);
            }
            return;
        }
        let mut rows = [[0.0; WIDTH]; N];
        for (x, row) in from.iter().zip(&mut rows) {
            with.store(*x, row);
        }
        for (lane, start) in self.lanes.iter().zip(&self.starts) {
            let own: &mut [f64; N] = to[*start..].first_chunk_mut().expect("numbers of a link");
            (0..N).for_each(|i| own[i] = rows[i][*lane]);
        }
    }
}
