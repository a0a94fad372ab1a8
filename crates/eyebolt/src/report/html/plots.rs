//! The plots of a page.

mod matrix;
mod panels;
mod rows;

pub(super) use matrix::matrix;
pub(super) use panels::{Panel, panels};
pub(super) use rows::{Row, rows};

/// Width of a plot: as many units as a telephone has pixels and a bit, so that text stays readable.
const WIDTH: f32 = 460.0;
/// Height of a row.
const ROW: f32 = 26.0;
/// Letters of a label that have room left of a plot; the rest shows to who points at it.
const LABEL_LETTERS: usize = 18;

/// `label` as far as there is room.
fn short(label: &str) -> String {
    if label.chars().count() <= LABEL_LETTERS {
        return label.to_owned();
    }
    // The ends of names tell links of one arm apart.
    let skip = label.chars().count() - (LABEL_LETTERS - 1);
    std::iter::once('…').chain(label.chars().skip(skip)).collect()
}

/// Room for the longest of `labels`.
fn gutter<'a>(labels: impl Iterator<Item = &'a str>) -> f32 {
    let letters = labels.map(|label| short(label).chars().count()).max().unwrap_or(0);
    14.0 + 7.0 * letters as f32
}
