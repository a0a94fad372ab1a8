//! Where things stand in a plot.

/// Width of a plot: as many units as a telephone has pixels and a bit, so that text stays readable.
pub(super) const WIDTH: f32 = 460.0;
/// Height of a row.
pub(super) const ROW: f32 = 26.0;
/// Letters of a label that have room left of a plot; the rest shows to who points at it.
pub(super) const LABEL_LETTERS: usize = 18;

/// `label` as far as there is room.
pub(super) fn short(label: &str) -> String {
    if label.chars().count() <= LABEL_LETTERS {
        return label.to_owned();
    }
    // The ends of names tell links of one arm apart.
    let skip = label.chars().count() - (LABEL_LETTERS - 1);
    std::iter::once('…').chain(label.chars().skip(skip)).collect()
}

/// Room for the longest of `labels`.
pub(super) fn gutter<'a>(labels: impl Iterator<Item = &'a str>) -> f32 {
    let letters = labels.map(|label| short(label).chars().count()).max().unwrap_or(0);
    14.0 + 7.0 * letters as f32
}
