//! Parts that hang together: each equation points at an earlier one of its part, the first at itself.

/// Two equations of one part.
pub(crate) fn join(part: &mut [usize], i: usize, j: usize) {
    let (a, b) = (root(part, i), root(part, j));
    part[a.max(b)] = a.min(b);
}

/// The first equation of the part that this one belongs to.
pub(crate) fn root(part: &mut [usize], mut i: usize) -> usize {
    while part[i] != i {
        part[i] = part[part[i]];
        i = part[i];
    }
    i
}
