//! Which output times of a run are kept.

/// Picks so many output times at most, evenly spaced from the first on: what is kept is bounded whatever the length of
/// the run. Before the start of a run it picks all.
#[derive(Clone, Debug)]
pub(crate) struct Spacing {
    most: usize,
    stride: usize,
    seen: usize,
}

impl Spacing {
    /// Of so many at most, the end of the run among them; two at least.
    pub(crate) fn new(most: usize) -> Self {
        Self { most: most.max(2), stride: 1, seen: 0 }
    }

    /// A run of so many output steps starts.
    pub(crate) fn start(&mut self, steps: usize) {
        self.stride = steps.div_ceil(self.most - 1).max(1);
    }

    /// True where the next output time is one of them.
    pub(crate) fn picks(&mut self) -> bool {
        self.seen += 1;
        (self.seen - 1).is_multiple_of(self.stride)
    }

    /// Output steps from one to the next.
    pub(crate) fn stride(&self) -> usize {
        self.stride
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_never_too_many_and_the_end_has_its_place() {
        for (most, steps) in
            [(10, 1003), (10, 1000), (10, 9), (10, 10), (2, 7), (200, 4000), (3, 0)]
        {
            let mut spacing = Spacing::new(most);
            spacing.start(steps);
            let kept: Vec<usize> = (0..=steps).filter(|_| spacing.picks()).collect();
            let end = usize::from(kept.last() != Some(&steps));
            assert!(kept.len() + end <= most, "{kept:?}");
            assert!(2 * (kept.len() + end) > most.min(steps + 1), "{kept:?}");
            assert!(kept.windows(2).all(|w| w[1] - w[0] == spacing.stride()), "{kept:?}");
        }
    }
}
