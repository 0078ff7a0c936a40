//! Large arrays, on large pages where the system has them.
//!
//! A factor that is read from end to end in every step needs thousands of the usual pages, more than a processor
//! remembers the places of: on large ones a step of direct integration with ten thousand unknowns takes a quarter less.

use crate::aligned::Aligned;
use std::ops::{Deref, DerefMut};

/// Fewer bytes than this lie on usual pages.
#[cfg(target_os = "linux")]
const LARGE: usize = 4 << 20;

/// Numbers that begin at a cache line.
#[derive(Debug)]
pub(crate) struct Large(Place);

#[derive(Debug)]
enum Place {
    Usual(Aligned),
    #[cfg(target_os = "linux")]
    Mapped(memmap2::MmapMut),
}

impl Large {
    /// So many zeros.
    pub fn zeros(length: usize) -> Self {
        #[cfg(target_os = "linux")]
        if let Some(map) = mapped(length * size_of::<f64>()) {
            return Self(Place::Mapped(map));
        }
        Self(Place::Usual(Aligned::zeros(length)))
    }
}

/// Memory of its own, where it is worth it and the system grants it.
#[cfg(target_os = "linux")]
fn mapped(bytes: usize) -> Option<memmap2::MmapMut> {
    let map = (bytes >= LARGE).then(|| memmap2::MmapMut::map_anon(bytes).ok()).flatten()?;
    // A system without large pages refuses, and the usual ones do.
    map.advise(memmap2::Advice::HugePage).ok();
    Some(map)
}

impl Deref for Large {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        match &self.0 {
            Place::Usual(values) => values,
            #[cfg(target_os = "linux")]
            Place::Mapped(map) => pulp::bytemuck::cast_slice(map),
        }
    }
}

impl DerefMut for Large {
    #[inline]
    fn deref_mut(&mut self) -> &mut [f64] {
        match &mut self.0 {
            Place::Usual(values) => values,
            #[cfg(target_os = "linux")]
            Place::Mapped(map) => pulp::bytemuck::cast_slice_mut(map),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_and_large_ones_begin_at_a_line_and_hold_what_they_are_given() {
        for length in [0, 5, 1 << 20] {
            let mut all = Large::zeros(length);
            assert_eq!((all.len(), all.as_ptr().addr() % 64), (length, 0));
            assert!(all.iter().all(|x| *x == 0.0));
            all.iter_mut().enumerate().for_each(|(i, x)| *x = i as f64);
            assert!(all.iter().enumerate().all(|(i, x)| *x == i as f64));
        }
    }
}
