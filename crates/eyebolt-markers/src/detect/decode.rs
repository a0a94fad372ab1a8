//! What a quadrilateral says, if it is a marker.

use crate::dictionary::{Dictionary, Match};
use crate::grey::GreyImage;
use crate::homography::Homography;
use nalgebra::Point2;

/// Where in a cell it is looked at: blur and a corner that is a little off spare its middle.
const PLACES: [f64; 3] = [0.3, 0.5, 0.7];
/// Least difference of brightness between white and black, of 255.
const CONTRAST: f64 = 20.0;
/// Share of the border's cells that may be white: reflexes.
const BORDER_ERRORS: f64 = 0.07;

/// The word between `corners`, clockwise from any; `None` if it is none.
pub(super) fn decode(
    image: &GreyImage,
    corners: &[Point2<f64>; 4],
    dictionary: &Dictionary,
) -> Option<Match> {
    let cells = dictionary.side() + 2;
    let values = brightness(image, &Homography::of_unit_square(corners)?, cells)?;
    let threshold = threshold(&values)?;
    let (mut bits, mut wrong) = (0, 0);
    for (place, value) in values.iter().enumerate() {
        let (row, column) = (place / cells, place % cells);
        let white = *value > threshold;
        if row == 0 || column == 0 || row == cells - 1 || column == cells - 1 {
            wrong += usize::from(white);
        } else {
            bits = bits << 1 | u64::from(white);
        }
    }
    let border = 4 * (cells - 1);
    if wrong as f64 > BORDER_ERRORS * border as f64 {
        return None;
    }
    dictionary.find(bits)
}

/// Mean brightness of each of `cells` x `cells` cells, row by row; `None` if one is off the picture.
fn brightness(image: &GreyImage, map: &Homography, cells: usize) -> Option<Vec<f64>> {
    let cell = |place: usize| {
        let (row, column) = ((place / cells) as f64, (place % cells) as f64);
        let mut sum = 0.0;
        for v in PLACES {
            for u in PLACES {
                let at = Point2::new((column + u) / cells as f64, (row + v) / cells as f64);
                let at = map.map(&at);
                sum += image.sample(at.x, at.y)?;
            }
        }
        Some(sum / 9.0)
    };
    (0..cells * cells).map(cell).collect()
}

/// Between black and white: where the variance between the two is largest (Otsu 1979). `None` if they
/// are hardly different.
fn threshold(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let total: f64 = sorted.iter().sum();
    let (mut below, mut best) = (0.0, (0.0, None));
    for (index, pair) in sorted.windows(2).enumerate() {
        let &[here, next] = pair else { continue };
        below += here;
        let (dark, light) = ((index + 1) as f64, (sorted.len() - index - 1) as f64);
        let apart = (total - below) / light - below / dark;
        let variance = dark * light * apart * apart;
        if apart >= CONTRAST && variance > best.0 {
            best = (variance, Some(0.5 * (here + next)));
        }
    }
    best.1
}
