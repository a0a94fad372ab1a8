//! How the markers of a target lie.

/// How the markers of a target lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    /// One tag; of any number, where none is told.
    Tag {
        /// Its number.
        id: Option<u32>,
    },
    /// Tags in rows, from the upper left one on.
    Grid {
        /// Tags in a row.
        columns: u32,
        /// Number of rows.
        rows: u32,
        /// Between two tags, metres.
        gap_m: f64,
        /// Number of the first tag.
        first_id: u32,
    },
    /// A chessboard with tags in its white squares, the upper left square black.
    Charuco {
        /// Squares in a row.
        columns: u32,
        /// Number of rows.
        rows: u32,
        /// Side of a square, metres.
        square_m: f64,
        /// Number of the first tag.
        first_id: u32,
    },
}
