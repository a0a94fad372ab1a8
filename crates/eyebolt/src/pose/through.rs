//! What a camera saw through a shape, and what is only a match that failed.

use crate::segment::Thinned;

/// Of the pixels that are `behind` a drawn shape, those where the camera saw through it: the surface seen there is at least as large outside
/// of what is `drawn`. A patch that ends within it, as those of failed matches on glossy links do, says nothing.
///
/// Neighbours are of one surface whose depths differ by less than `tolerance_m` at `distance_m`, and as the square of the distance
/// elsewhere.
pub(super) fn seen_through(
    image: &Thinned,
    (behind, drawn): (&[bool], &[bool]),
    (tolerance_m, distance_m): (f64, f64),
) -> Vec<bool> {
    let (width, height) = (image.width, image.height);
    let by_square = (tolerance_m / distance_m.powi(2)) as f32;
    let is_of_it = |at: usize| image.depth_m[at] > 0.0 && (behind[at] || !drawn[at]);
    let mut through = vec![false; behind.len()];
    let mut reached = vec![false; behind.len()];
    let mut surface = Vec::new();
    for seed in 0..behind.len() {
        if !behind[seed] || reached[seed] {
            continue;
        }
        surface.clear();
        surface.push(seed);
        reached[seed] = true;
        let mut next = 0;
        while let Some(at) = surface.get(next).copied() {
            next += 1;
            let (u, v) = (at % width, at / width);
            let beside = [
                (u > 0).then(|| at - 1),
                (u + 1 < width).then(|| at + 1),
                (v > 0).then(|| at - width),
                (v + 1 < height).then(|| at + width),
            ];
            for other in beside.into_iter().flatten() {
                let (here, there) = (image.depth_m[at], image.depth_m[other]);
                let is_near = (here - there).abs() < by_square * here * there;
                if !reached[other] && is_of_it(other) && is_near {
                    reached[other] = true;
                    surface.push(other);
                }
            }
        }
        let within = surface.iter().filter(|at| behind[**at]).count();
        if surface.len() >= 2 * within {
            surface.iter().filter(|at| behind[**at]).for_each(|at| through[*at] = true);
        }
    }
    through
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 12;

    /// A shape of 6 x 6 pixels at 1 m before a wall at 2 m, with `patch` at those columns of it.
    fn behind_at(columns: std::ops::Range<usize>, patch_m: f32) -> (usize, usize) {
        let is_drawn = |at: usize| (3..9).contains(&(at % WIDTH)) && (3..9).contains(&(at / WIDTH));
        let is_patch = |at: usize| is_drawn(at) && columns.contains(&(at % WIDTH));
        let depth = |at: usize| match () {
            () if is_patch(at) => patch_m,
            () if is_drawn(at) => 1.0,
            () => 2.0,
        };
        let all = 0..WIDTH * WIDTH;
        let image = Thinned {
            width: WIDTH,
            height: WIDTH,
            step: 1,
            corner: [0, 0],
            depth_m: all.clone().map(depth).collect(),
            rays: vec![[0.0; 2]; WIDTH * WIDTH],
        };
        let [behind, drawn]: [Vec<bool>; 2] =
            [all.clone().map(is_patch).collect(), all.map(is_drawn).collect()];
        let through = seen_through(&image, (&behind, &drawn), (0.01, 1.0));
        let count = |of: &[bool]| of.iter().filter(|it| **it).count();
        (count(&through), count(&behind))
    }

    #[test]
    fn a_wall_that_goes_on_is_seen_through_the_shape_and_a_patch_within_it_is_not() {
        assert_eq!(behind_at(5..7, 2.0), (12, 12));
        // By the square of the distance, 3 cm are of one surface at 2 m.
        assert_eq!(behind_at(5..7, 2.03), (12, 12));
        assert_eq!(behind_at(5..7, 1.6), (0, 12));
        // Nor is one that reaches the outline, if nothing of it is beyond.
        assert_eq!(behind_at(3..6, 1.6), (0, 18));
    }
}
