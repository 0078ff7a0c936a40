//! Vectors and matrices of a plane over [`Real`].

use trilith_element::lanes::Real;

pub(crate) type V2<R> = [R; 2];
/// Row by row.
pub(crate) type M2<R> = [[R; 2]; 2];

#[inline(always)]
pub(crate) fn add<R: Real>(a: V2<R>, b: V2<R>) -> V2<R> {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
pub(crate) fn sub<R: Real>(a: V2<R>, b: V2<R>) -> V2<R> {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline(always)]
pub(crate) fn scaled<R: Real>(a: V2<R>, s: R) -> V2<R> {
    [a[0] * s, a[1] * s]
}

#[inline(always)]
pub(crate) fn dot<R: Real>(a: V2<R>, b: V2<R>) -> R {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
pub(crate) fn norm<R: Real>(a: V2<R>) -> R {
    dot(a, a).sqrt()
}

#[inline(always)]
pub(crate) fn select<R: Real>(mask: R::Mask, yes: V2<R>, no: V2<R>) -> V2<R> {
    [R::select(mask, yes[0], no[0]), R::select(mask, yes[1], no[1])]
}

#[inline(always)]
pub(crate) fn only<R: Real>(a: V2<R>, mask: R::Mask) -> V2<R> {
    [a[0].only(mask), a[1].only(mask)]
}

/// `a bᵀ`.
#[inline(always)]
pub(crate) fn outer<R: Real>(a: V2<R>, b: V2<R>) -> M2<R> {
    [scaled(b, a[0]), scaled(b, a[1])]
}

/// `s I`.
#[inline(always)]
pub(crate) fn diagonal<R: Real>(s: R) -> M2<R> {
    let zero = s.of(0.0);
    [[s, zero], [zero, s]]
}

#[inline(always)]
pub(crate) fn times<R: Real>(m: &M2<R>, v: V2<R>) -> V2<R> {
    [dot(m[0], v), dot(m[1], v)]
}

#[inline(always)]
pub(crate) fn product<R: Real>(a: &M2<R>, b: &M2<R>) -> M2<R> {
    let columns = [[b[0][0], b[1][0]], [b[0][1], b[1][1]]];
    [times(&columns, a[0]), times(&columns, a[1])]
}

#[inline(always)]
pub(crate) fn plus<R: Real>(a: &M2<R>, b: &M2<R>) -> M2<R> {
    [add(a[0], b[0]), add(a[1], b[1])]
}

#[inline(always)]
pub(crate) fn less<R: Real>(a: &M2<R>, b: &M2<R>) -> M2<R> {
    [sub(a[0], b[0]), sub(a[1], b[1])]
}

#[inline(always)]
pub(crate) fn of<R: Real>(a: &M2<R>, s: R) -> M2<R> {
    [scaled(a[0], s), scaled(a[1], s)]
}

#[inline(always)]
pub(crate) fn select_matrix<R: Real>(mask: R::Mask, yes: &M2<R>, no: &M2<R>) -> M2<R> {
    [select(mask, yes[0], no[0]), select(mask, yes[1], no[1])]
}
