//! Combinations of cases: what extremes of several runs make together.

/// A combination.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// Name.
    pub name: String,
    /// How its terms are put together.
    pub how: CombineCases,
    /// What is combined, and with which factors; one at least.
    pub terms: Vec<(CombinationTerm, f64)>,
}

/// A term of a combination.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CombinationTerm {
    /// The case of this index.
    Case(usize),
    /// The combination of this index, which stands before.
    Combination(usize),
}

/// How the extremes of several cases are put together, each with its factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CombineCases {
    /// The largest values added, and the smallest.
    LinearAdd,
    /// The largest magnitudes added; the smallest value is the opposite.
    AbsoluteAdd,
    /// The root of the sum of the squares of the largest magnitudes; the smallest value is the opposite.
    Srss,
    /// The largest of the largest values, and the smallest of the smallest.
    Envelope,
}

impl CombineCases {
    /// All of them, in the order of the schema.
    pub const ALL: [Self; 4] = [Self::LinearAdd, Self::AbsoluteAdd, Self::Srss, Self::Envelope];

    /// As a file names it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::LinearAdd => "LinearAdd",
            Self::AbsoluteAdd => "AbsoluteAdd",
            Self::Srss => "Srss",
            Self::Envelope => "Envelope",
        }
    }

    /// Smallest and largest value of terms, each with its own and its factor; with the index of the term that the smallest and
    /// the largest come from, where they come from one.
    ///
    /// ```
    /// use trilith_model::CombineCases::{Envelope, LinearAdd, Srss};
    /// let of = [([-3.0, 1.0], 1.5), ([2.0, 2.0], -1.0)];
    /// assert_eq!(LinearAdd.of(&of), ([-6.5, -0.5], [None, None]));
    /// assert_eq!(LinearAdd.of(&[([-3.0, 1.0], -2.0)]), ([-2.0, 6.0], [None, None]));
    /// assert_eq!(Envelope.of(&of), ([-4.5, 1.5], [Some(0), Some(0)]));
    /// assert_eq!(Srss.of(&[([0.0, 3.0], 1.0), ([-4.0, 0.0], 1.0)]), ([-5.0, 5.0], [None, None]));
    /// ```
    #[must_use]
    pub fn of(self, terms: &[([f64; 2], f64)]) -> ([f64; 2], [Option<usize>; 2]) {
        let scaled = terms.iter().map(|([min, max], factor)| {
            let (a, b) = (factor * min, factor * max);
            if *factor < 0.0 { [b, a] } else { [a, b] }
        });
        let sizes = scaled.clone().map(|[a, b]| a.abs().max(b.abs()));
        let opposite = |size: f64| ([-size, size], [None, None]);
        match self {
            Self::LinearAdd => {
                (scaled.fold([0.0; 2], |sum, x| [sum[0] + x[0], sum[1] + x[1]]), [None, None])
            }
            Self::AbsoluteAdd => opposite(sizes.sum()),
            Self::Srss => opposite(sizes.map(|x| x * x).sum::<f64>().sqrt()),
            Self::Envelope => {
                let (mut found, mut by) = ([f64::INFINITY, f64::NEG_INFINITY], [None, None]);
                for (i, [min, max]) in scaled.enumerate() {
                    // The first of equals.
                    if min < found[0] {
                        (found[0], by[0]) = (min, Some(i));
                    }
                    if max > found[1] {
                        (found[1], by[1]) = (max, Some(i));
                    }
                }
                (found, by)
            }
        }
    }
}
