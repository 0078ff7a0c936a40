//! Files that somebody has spoiled.

/// So many spoiled copies of a file: pieces of a few bytes are lost or become others, some files end in the middle. The same
/// ones each time.
pub fn spoiled_copies<'a>(
    bytes: &'a [u8],
    count: usize,
    pieces: &'a [&[u8]],
) -> impl Iterator<Item = Vec<u8>> + 'a {
    // Numbers of a linear congruential generator.
    let mut seed = 7_u64;
    let mut next = move |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below
    };
    (0..count).map(move |_| {
        let mut spoiled = bytes.to_vec();
        for _ in 0..1 + next(3) {
            let from = next(spoiled.len());
            let to = (from + next(12)).min(spoiled.len());
            spoiled.splice(from..to, pieces[next(pieces.len())].iter().copied());
        }
        if next(10) == 0 {
            spoiled.truncate(next(spoiled.len()));
        }
        spoiled
    })
}
