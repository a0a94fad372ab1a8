//! The 4 x 4 matrix as comma-separated values.

use super::placement::Placement;
use super::text::number;

/// Four lines of four numbers; the last line is `0, 0, 0, 1`. No header: readers of matrices expect
/// none.
pub(super) fn write(placement: &Placement) -> String {
    let matrix = placement.parent_from_child.matrix();
    let line = |row: usize| [0, 1, 2, 3].map(|column| number(matrix[(row, column)])).join(",");
    [0, 1, 2, 3].map(|row| line(row) + "\n").concat()
}
