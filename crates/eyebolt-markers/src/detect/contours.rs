//! Outlines of dark regions.

use super::threshold::Binary;

/// A pixel, with the frame of [`Binary`] counted.
pub(super) type Pixel = (i32, i32);

/// A pixel on a border that was followed, and one whose right neighbour is white as well: there, no
/// other border begins.
const FOLLOWED: i8 = 2;
const FOLLOWED_RIGHT: i8 = -126;

/// Steps to the eight neighbours: right, then against the clock as a picture shows it.
const STEPS: [Pixel; 8] = [(1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1)];

/// Calls `found` with every outer border of `shortest` to `longest` pixels.
///
/// Border following (Suzuki and Abe, "Topological structural analysis of digitized binary images",
/// 1985), without the hierarchy. Each pixel is visited at most once for each of its sides. Holes are only
/// followed so that none is taken for another border: they are what lies around a tag, not a tag.
pub(super) fn contours(
    mut image: Binary,
    shortest: usize,
    longest: usize,
    mut found: impl FnMut(&[Pixel]),
) {
    let stride = image.stride;
    let rows = image.values.len() / stride;
    let mut border = Vec::new();
    for v in 1..rows.saturating_sub(1) {
        let mut before = 0;
        for u in 1..stride - 1 {
            let at = v * stride + u;
            let here = value(&image, at);
            if here == before {
                continue;
            }
            let outer = before == 0 && here == 1;
            let hole = here == 0 && before >= 1;
            if outer || hole {
                let start = if hole { (u as i32 - 1, v as i32) } else { (u as i32, v as i32) };
                follow(&mut image, start, hole, longest, &mut border);
                if outer && (shortest..=longest).contains(&border.len()) {
                    found(&border);
                }
            }
            before = value(&image, at);
        }
    }
}

fn value(image: &Binary, at: usize) -> i8 {
    image.values.get(at).copied().unwrap_or_default()
}

/// Follows the border that begins at `start` and puts its pixels into `border`, of which no more than
/// `longest` and one are kept.
fn follow(image: &mut Binary, start: Pixel, hole: bool, longest: usize, border: &mut Vec<Pixel>) {
    border.clear();
    let stride = image.stride as i32;
    let index = |(u, v): Pixel| (v * stride + u) as usize;
    let step = |(u, v): Pixel, direction: usize| {
        let (du, dv) = STEPS[direction & 7];
        (u + du, v + dv)
    };
    // Clockwise from the side where the white pixel is.
    let from = if hole { 0 } else { 4 };
    let first =
        (1..=8).map(|k| (from + 8 - k) & 7).find(|s| value(image, index(step(start, *s))) != 0);
    let Some(first) = first else {
        // A pixel alone.
        if let Some(pixel) = image.values.get_mut(index(start)) {
            *pixel = FOLLOWED_RIGHT;
        }
        return;
    };
    let second = step(start, first);
    let (mut here, mut direction) = (start, first);
    loop {
        let came_from = direction;
        // Against the clock, from where the border came.
        let next =
            (1..=8).map(|k| (came_from + k) & 7).find(|s| value(image, index(step(here, *s))) != 0);
        let Some(next) = next else { return };
        let passed_right = next != 0 && next - 1 < came_from;
        if let Some(pixel) = image.values.get_mut(index(here)) {
            if passed_right {
                *pixel = FOLLOWED_RIGHT;
            } else if *pixel == 1 {
                *pixel = FOLLOWED;
            }
        }
        if border.len() <= longest {
            border.push(here);
        }
        let there = step(here, next);
        if there == start && here == second {
            return;
        }
        (here, direction) = (there, (next + 4) & 7);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn borders(rows: &[&str]) -> Vec<Vec<Pixel>> {
        let stride = rows[0].len() + 2;
        let mut values = vec![0; stride];
        for row in rows {
            values.push(0);
            values.extend(row.bytes().map(|b| i8::from(b == b'#')));
            values.push(0);
        }
        values.extend(vec![0; stride]);
        let mut all = Vec::new();
        contours(Binary { stride, values }, 0, 1000, |border| all.push(border.to_vec()));
        all
    }

    #[test]
    fn a_ring_in_a_ring_has_a_border_of_its_own() {
        let rows = ["#######", "#.....#", "#.###.#", "#.#.#.#", "#.###.#", "#.....#", "#######"];
        let lengths: Vec<usize> = borders(&rows).iter().map(Vec::len).collect();
        assert_eq!(lengths, [24, 8]);
    }

    #[test]
    fn borders_are_closed_walks_over_dark_pixels() {
        let rows = ["##..#", "#.###", "..#.#", "####.", "#...."];
        for border in borders(&rows) {
            for (a, b) in border.iter().zip(border.iter().cycle().skip(1)) {
                assert!((a.0 - b.0).abs() <= 1 && (a.1 - b.1).abs() <= 1);
                let row = rows[a.1 as usize - 1].as_bytes();
                assert_eq!(row[a.0 as usize - 1], b'#');
            }
        }
    }

    #[test]
    fn a_pixel_alone_ends() {
        assert_eq!(borders(&["...", ".#.", "..."]), [Vec::<Pixel>::new()]);
    }
}
