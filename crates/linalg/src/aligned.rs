//! Numbers that begin at a cache line.

use std::ops::{Deref, DerefMut};

/// Numbers in a cache line: as many as the widest vector of any processor holds.
pub(crate) const LINE: usize = 8;

/// Numbers that begin at a cache line, so that no vector of them lies across two. A clone may begin anywhere.
#[derive(Clone, Debug)]
pub(crate) struct Aligned {
    start: usize,
    length: usize,
    values: Vec<f64>,
}

impl Aligned {
    /// So many zeros.
    pub fn zeros(length: usize) -> Self {
        let values = vec![0.0; length + LINE - 1];
        let start = values.as_ptr().align_offset(LINE * size_of::<f64>()).min(LINE - 1);
        Self { start, length, values }
    }
}

impl Deref for Aligned {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        &self.values[self.start..][..self.length]
    }
}

impl DerefMut for Aligned {
    #[inline]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values[self.start..][..self.length]
    }
}
