//! History variables of all links: those of the start of a step, and those of its end.

/// Both histories. They change places by a flag: exchanging two vectors moves pointers in pieces of other widths than
/// they are read in, and the processor waits for each.
#[derive(Clone)]
pub(super) struct Histories<R> {
    both: [Vec<R>; 2],
    turned: bool,
}

impl<R: Copy> Histories<R> {
    pub fn new(start: Vec<R>) -> Self {
        Self { both: [start.clone(), start], turned: false }
    }

    /// History that holds, and the one to be written.
    #[inline(always)]
    pub fn split(&mut self) -> (&mut [R], &mut [R]) {
        let [a, b] = &mut self.both;
        if self.turned { (b, a) } else { (a, b) }
    }

    /// History that holds.
    #[inline(always)]
    pub fn held(&self) -> &[R] {
        &self.both[usize::from(self.turned)]
    }

    /// From now on the one that was written holds.
    #[inline(always)]
    pub fn take(&mut self) {
        self.turned = !self.turned;
    }
}
