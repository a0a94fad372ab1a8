//! Pixels of one part of the arm that are lost within the other.

use crate::connected::connected;
use eyebolt_registration::{Label, Labels};

/// Parts that touch are drawn through each other here and there: so few pixels, with nothing but the
/// other part about them, are no part of the outline between the two.
const SPECK_PX: usize = 16;

/// `drawn` with [`Label::Ignore`] where it cannot be told by the drawing which part it is.
pub(super) fn without_specks(drawn: Labels) -> Labels {
    let (columns, rows) = (drawn.columns(), drawn.rows());
    let width = columns.len().max(1);
    let place = |u: usize, v: usize| (v - rows.start) * width + (u - columns.start);
    let pixels = rows.clone().flat_map(|v| columns.clone().map(move |u| (u, v)));
    let labels: Vec<Label> = pixels.filter_map(|(u, v)| drawn.at(u, v)).collect();
    let (mut seen, mut speck) = (vec![false; labels.len()], vec![false; labels.len()]);
    let mut patch = Vec::new();
    for seed in 0..labels.len() {
        if seen[seed] || !labels[seed].is_robot() {
            continue;
        }
        seen[seed] = true;
        let mut is_inside = true;
        connected(seed, width, labels.len(), &mut patch, |at, other| {
            is_inside &= labels[other].is_robot();
            let joins = !seen[other] && labels[other] == labels[at];
            seen[other] |= joins;
            joins
        });
        if is_inside && patch.len() < SPECK_PX {
            patch.iter().for_each(|at| speck[*at] = true);
        }
    }
    drawn.mapped(|u, v, label| if speck[place(u, v)] { Label::Ignore } else { label })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hand of 20 x 20 pixels beside an arm, each with one pixel of the other in it, and a finger of
    /// three pixels before the background.
    #[test]
    fn what_is_lost_within_the_other_part_is_no_outline() {
        let drawn = Labels::from_fn(5..65, 3..33, |u, v| match (u, v) {
            (15, 15) => Label::Arm,
            (35, 15) | (50..53, 15) => Label::EndEffector,
            (5..25, 10..30) => Label::EndEffector,
            (25..45, 10..30) => Label::Arm,
            _ => Label::Background,
        });
        let cleaned = without_specks(drawn.clone());
        let changed = (3..33).flat_map(|v| (5..65).map(move |u| (u, v)));
        let changed: Vec<_> =
            changed.filter(|(u, v)| cleaned.at(*u, *v) != drawn.at(*u, *v)).collect();
        assert_eq!(changed, [(15, 15), (35, 15)]);
        assert_eq!(cleaned.at(15, 15), Some(Label::Ignore));
    }
}
