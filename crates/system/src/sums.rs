//! Sums over DOFs, millions of them in two pieces of memory.

/// Sums, each of terms (index, factor).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sums {
    /// Where each ends.
    ends: Vec<usize>,
    pub(crate) terms: Vec<(usize, f64)>,
}

impl Sums {
    /// Room for as many, of one term each.
    pub(crate) fn with_capacity(count: usize) -> Self {
        Self { ends: Vec::with_capacity(count), terms: Vec::with_capacity(count) }
    }

    /// One more.
    pub(crate) fn push(&mut self, terms: impl IntoIterator<Item = (usize, f64)>) {
        self.terms.extend(terms);
        self.ends.push(self.terms.len());
    }

    /// Number of sums.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// True where there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// One of them.
    #[must_use]
    pub fn get(&self, i: usize) -> &[(usize, f64)] {
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        &self.terms[start..self.ends[i]]
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &[(usize, f64)]> {
        (0..self.len()).map(|i| self.get(i))
    }

    /// For each of so many indices the sums that it has a part in, with its factors there.
    pub(crate) fn transposed(&self, indices: usize) -> Self {
        let mut ends = vec![0; indices];
        self.terms.iter().for_each(|(i, _)| ends[*i] += 1);
        let mut sum = 0;
        for end in &mut ends {
            sum += *end;
            *end = sum - *end;
        }
        // Where each begins, until it is full.
        let mut terms = vec![(0, 0.0); sum];
        for (k, own) in self.iter().enumerate() {
            for (i, c) in own {
                terms[ends[*i]] = (k, *c);
                ends[*i] += 1;
            }
        }
        Self { ends, terms }
    }
}

impl<T: IntoIterator<Item = (usize, f64)>> FromIterator<T> for Sums {
    fn from_iter<I: IntoIterator<Item = T>>(all: I) -> Self {
        let mut sums = Self::default();
        all.into_iter().for_each(|own| sums.push(own));
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_transposed_twice_is_what_it_was() {
        let sums: Sums = [vec![(3, 0.5)], vec![], vec![(0, 1.0), (3, -2.0)], vec![(1, 4.0)]]
            .into_iter()
            .collect();
        assert_eq!(
            (sums.len(), sums.get(1), sums.get(2)),
            (4, &[][..], &[(0, 1.0), (3, -2.0)][..])
        );
        let other = sums.transposed(4);
        assert_eq!(other.get(3), [(0, 0.5), (2, -2.0)]);
        assert_eq!((other.len(), other.transposed(4)), (4, sums));
    }
}
