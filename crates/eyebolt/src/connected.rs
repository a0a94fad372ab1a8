//! Connected patches of pixels.

/// The pixels that hang together with `seed`, each a neighbour of one before it that it `joins`, in
/// `patch`. `joins` is asked for a pixel of the patch and its neighbour, and has to say no to pixels that
/// were taken.
pub(crate) fn connected(
    seed: usize,
    width: usize,
    count: usize,
    patch: &mut Vec<usize>,
    mut joins: impl FnMut(usize, usize) -> bool,
) {
    patch.clear();
    patch.push(seed);
    let mut next = 0;
    while let Some(&at) = patch.get(next) {
        next += 1;
        for other in neighbours(at, width, count).into_iter().flatten() {
            if joins(at, other) {
                patch.push(other);
            }
        }
    }
}

fn neighbours(at: usize, width: usize, count: usize) -> [Option<usize>; 4] {
    let column = at % width;
    [
        (column > 0).then(|| at - 1),
        (column + 1 < width).then(|| at + 1),
        at.checked_sub(width),
        (at + width < count).then(|| at + width),
    ]
}
