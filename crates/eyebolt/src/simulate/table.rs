//! How high the table is that an arm stands on.

use super::scene::TABLE_BELOW_M;

/// Where a link reaches down to in several postures.
pub(super) struct Lows {
    /// Lowest height in each posture, base frame, metres.
    pub(super) lows: Vec<f64>,
    /// Whether the joints that postures differ in move it.
    pub(super) moved: bool,
}

/// Height of the table's top, base frame, metres: just below the base frame, or below what stands on
/// it where that reaches lower (a flange, a pedestal, wheels), and so that no moving link is always
/// nearer to it than `clearance_m`: what turns on a low base may begin at the base's foot.
pub(super) fn top(links: &[Lows], clearance_m: f64) -> f64 {
    let usual = -TABLE_BELOW_M;
    let stands = links.iter().filter(|link| !link.moved).flat_map(|link| &link.lows);
    let foot = stands.copied().fold(f64::INFINITY, f64::min);
    let under_foot = if foot < usual { foot - TABLE_BELOW_M } else { usual };
    let moving = links.iter().filter(|link| link.moved).filter_map(|link| median(&link.lows));
    moving.fold(under_foot, |top, (highest, median)| match highest < top + clearance_m {
        true => median - clearance_m - TABLE_BELOW_M,
        false => top,
    })
}

/// The highest, and the one that half of them are below.
fn median(lows: &[f64]) -> Option<(f64, f64)> {
    let mut sorted = lows.to_vec();
    sorted.sort_by(f64::total_cmp);
    Some((*sorted.last()?, *sorted.get(sorted.len() / 2)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn link(moved: bool, lows: &[f64]) -> Lows {
        Lows { lows: lows.to_vec(), moved }
    }

    #[test]
    fn the_table_is_just_below_an_ordinary_base() {
        let arm = [link(false, &[0.0; 3]), link(true, &[0.3, -0.2, 0.5])];
        assert_eq!(top(&arm, 0.012), -TABLE_BELOW_M);
    }

    #[test]
    fn wheels_and_pedestals_stand_on_it() {
        let arm = [link(false, &[0.1; 2]), link(false, &[-0.9; 2]), link(true, &[0.3, 0.4])];
        assert!((top(&arm, 0.012) + 0.9 + TABLE_BELOW_M).abs() < 1e-12);
    }

    proptest! {
        /// Nothing that stands sinks in, and half of the postures of every link are free of it.
        #[test]
        fn nothing_sinks_always(
            stands in prop::collection::vec(-1.0..0.5_f64, 1..4),
            moves in prop::collection::vec(prop::collection::vec(-1.0..1.0_f64, 5), 1..4),
        ) {
            let standing = stands.iter().map(|low| link(false, &[*low; 5]));
            let links: Vec<Lows> =
                standing.chain(moves.iter().map(|lows| link(true, lows))).collect();
            let top = top(&links, 0.012);
            prop_assert!(top <= -TABLE_BELOW_M);
            prop_assert!(stands.iter().all(|low| *low >= top || *low > -TABLE_BELOW_M));
            for lows in &moves {
                prop_assert!(lows.iter().any(|low| *low >= top + 0.012));
            }
        }
    }
}
