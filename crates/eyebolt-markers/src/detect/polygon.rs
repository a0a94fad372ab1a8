//! Outlines that are quadrilaterals.

use super::contours::Pixel;

/// A corner may be cut, and a side bent, by this share of the outline's length (as OpenCV has it).
const TOLERANCE: f64 = 0.03;
/// The shortest side, as a share of the outline's length: slimmer ones are seen too flat to be decoded.
const SHORTEST_SIDE: f64 = 0.05;

/// The four corners of `outline` in its order, if it is a convex quadrilateral: pixels of the outline, in
/// the picture's own coordinates, clockwise as a picture shows it.
pub(super) fn quadrilateral(outline: &[Pixel]) -> Option<[[f64; 2]; 4]> {
    let corners = simplified(outline, TOLERANCE * outline.len() as f64)?;
    let corners = corners.map(|(u, v)| [f64::from(u - 1), f64::from(v - 1)]);
    let shortest = SHORTEST_SIDE * outline.len() as f64;
    let [a, b, c, d] = corners;
    let turns = [turn(a, b, c), turn(b, c, d), turn(c, d, a), turn(d, a, b)];
    let side = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let long = [side(a, b), side(b, c), side(c, d), side(d, a)].iter().all(|s| *s >= shortest);
    if !long {
        None
    } else if turns.iter().all(|t| *t > 0.0) {
        Some(corners)
    } else if turns.iter().all(|t| *t < 0.0) {
        Some([a, d, c, b])
    } else {
        None
    }
}

/// Twice the area of the triangle, positive if it is clockwise as a picture shows it.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
}

/// The four points of `outline` to which it can be simplified within `tolerance`; `None` if it takes
/// more or fewer (Douglas and Peucker 1973; starting from two points that are far apart).
fn simplified(outline: &[Pixel], tolerance: f64) -> Option<[Pixel; 4]> {
    let mut start = 0;
    let mut end = 0;
    for _ in 0..3 {
        (start, end) = (end, farthest_from(outline, end)?);
    }
    let (first, second) = (start.min(end), start.max(end));
    if first == second {
        return None;
    }
    let mut corners = Vec::with_capacity(5);
    // Segments by their place in the outline; beyond its end it begins again.
    let mut segments = vec![(second, first + outline.len()), (first, second)];
    while let Some((from, to)) = segments.pop() {
        match farthest_off(outline, from, to, tolerance) {
            Some(split) => {
                segments.push((split, to));
                segments.push((from, split));
            }
            None => corners.push(*outline.get(from % outline.len())?),
        }
        // Each segment ends as one corner at least.
        if corners.len() + segments.len() > 5 {
            return None;
        }
    }
    without_straight(corners, tolerance)
}

fn farthest_from(outline: &[Pixel], from: usize) -> Option<usize> {
    let (u, v) = *outline.get(from)?;
    let distance = |(a, b): Pixel| {
        let (du, dv) = (i64::from(a - u), i64::from(b - v));
        du * du + dv * dv
    };
    // Of equally far ones the first.
    let far = outline.iter().enumerate().rev().max_by_key(|(_, pixel)| distance(**pixel))?;
    Some(far.0)
}

/// The place between `from` and `to` that is farthest from the line between them, if that is more than
/// `tolerance`.
fn farthest_off(outline: &[Pixel], from: usize, to: usize, tolerance: f64) -> Option<usize> {
    let at = |i: usize| outline.get(i % outline.len()).copied();
    let ((u, v), (end_u, end_v)) = (at(from)?, at(to)?);
    let (du, dv) = (i64::from(end_u - u), i64::from(end_v - v));
    let mut worst = (0, from);
    for i in from + 1..to {
        let (a, b) = at(i)?;
        let off = (i64::from(b - v) * du - i64::from(a - u) * dv).abs();
        if off > worst.0 {
            worst = (off, i);
        }
    }
    let limit = tolerance * (du as f64).hypot(dv as f64);
    (worst.0 as f64 > limit).then_some(worst.1)
}

/// Of four or five corners, four: one of the two points that the outline was first cut at may lie on a
/// side.
fn without_straight(mut corners: Vec<Pixel>, tolerance: f64) -> Option<[Pixel; 4]> {
    if corners.len() == 5 {
        let off = |i: usize| {
            let at = |k: usize| corners[(i + k) % 5];
            let ((a, b), (c, d), (e, f)) = (at(4), at(0), at(1));
            let (du, dv) = (f64::from(e - a), f64::from(f - b));
            ((f64::from(d - b) * du - f64::from(c - a) * dv) / du.hypot(dv).max(1e-9)).abs()
        };
        let (off, flattest) = (0..5).map(|i| (off(i), i)).min_by(|a, b| a.0.total_cmp(&b.0))?;
        if off > tolerance {
            return None;
        }
        corners.remove(flattest);
    }
    corners.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pixels along the sides of a polygon.
    fn outline(corners: &[Pixel]) -> Vec<Pixel> {
        let mut all = Vec::new();
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let steps = (a.0 - b.0).abs().max((a.1 - b.1).abs());
            for i in 0..steps {
                all.push((a.0 + (b.0 - a.0) * i / steps, a.1 + (b.1 - a.1) * i / steps));
            }
        }
        all
    }

    #[test]
    fn any_start_and_direction_finds_the_same_corners() {
        let corners = [(11, 11), (61, 21), (56, 71), (6, 51)];
        let mut pixels = outline(&corners);
        let wanted = corners.map(|(u, v)| [f64::from(u - 1), f64::from(v - 1)]);
        for turn in 0..pixels.len() {
            pixels.rotate_left(1);
            let mut found = quadrilateral(&pixels).unwrap();
            let first = found.iter().position(|c| *c == wanted[0]).unwrap();
            found.rotate_left(first);
            assert_eq!(found, wanted, "turned by {turn}");
            let mut back = pixels.clone();
            back.reverse();
            let found = quadrilateral(&back).unwrap();
            assert!(wanted.iter().all(|corner| found.contains(corner)));
        }
    }

    #[test]
    fn other_shapes_are_none() {
        for shape in [
            &[(11, 11), (61, 11), (36, 60)][..],
            &[(11, 11), (61, 11), (80, 40), (61, 61), (11, 61)],
            &[(11, 11), (61, 11), (31, 31), (11, 61)],
            &[(5, 5), (6, 6)],
        ] {
            assert_eq!(quadrilateral(&outline(shape)), None, "{shape:?}");
        }
        assert_eq!(quadrilateral(&[]), None);
    }
}
