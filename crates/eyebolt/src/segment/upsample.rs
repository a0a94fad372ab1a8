//! From logits of a thinned image to labels of the full one.

use super::classes::CLASSES;
use super::thinned::Thinned;
use super::told::Told;
use eyebolt_geometry::DepthImage;
use eyebolt_net::Matrix;
use rayon::prelude::*;
use std::ops::Range;

/// A bin speaks for pixels whose depth differs from its own by about this share.
const SAME_SURFACE: f32 = 0.01;
/// What is left of its weight elsewhere: where no bin has the depth, the nearest ones speak.
const ELSEWHERE: f32 = 1e-4;

/// Writes to `told`, of all pixels of `depth`, those in the columns and rows `part` and as deep as `depth_m`
/// says: the class of the largest logit between the four bins around, weighted
/// by nearness in the image and in depth (joint bilateral upsampling: Kopf et al., SIGGRAPH 2007), and what the logits
/// make of every class.
/// `logits` has a row for each of `rows`, bins of `image`; where none of the four has one, nothing is written.
pub fn upsample(
    depth: &DepthImage,
    (image, rows, logits): (&Thinned, &[usize], &Matrix),
    part: &[Range<usize>; 2],
    depth_m: &Range<f32>,
    told: &mut Told,
) {
    const NONE: u32 = u32::MAX;
    let mut row_of = vec![NONE; image.depth_m.len()];
    rows.iter().zip(0..).for_each(|(at, row)| row_of[*at] = row);
    let (width, step) = (depth.width() as usize, image.step as f32);
    let [columns, lines] = part;
    let classes = logits.channels();
    let rows_of_image: Vec<_> = told.rows(width).collect();
    let rows_of_image = rows_of_image.into_par_iter().zip(depth.depth_m().par_chunks(width));
    rows_of_image.enumerate().skip(lines.start).take(lines.len()).for_each_init(
        || vec![0.0_f32; classes],
        |sums, (v, ((labels, mut probabilities), depths))| {
            let (v0, part_v) = place(v - image.corner[1], step);
            let pixels = labels.iter_mut().zip(depths).enumerate();
            let pixels = pixels.skip(columns.start).take(columns.len());
            for (u, (label, &z)) in pixels.filter(|(_, (_, z))| **z > 0.0 && depth_m.contains(*z)) {
                let (u0, part_u) = place(u - image.corner[0], step);
                sums.fill(0.0);
                let mut total = 0.0;
                for (dv, weight_v) in [(0, 1.0 - part_v), (1, part_v)] {
                    for (du, weight_u) in [(0, 1.0 - part_u), (1, part_u)] {
                        let column = (u0 + du).clamp(0, image.width as i64 - 1) as usize;
                        let line = (v0 + dv).clamp(0, image.height as i64 - 1) as usize;
                        let at = line * image.width + column;
                        let Some(&row) = row_of.get(at).filter(|row| **row != NONE) else {
                            continue;
                        };
                        let off = (image.depth_m[at] - z) / (SAME_SURFACE * z);
                        let weight =
                            (weight_u * weight_v + 0.01) * ((1.0 + off * off).powi(-2) + ELSEWHERE);
                        total += weight;
                        let logits = logits.row(row as usize);
                        sums.iter_mut().zip(logits).for_each(|(sum, logit)| *sum += weight * logit);
                    }
                }
                if total > 0.0 {
                    *label = largest(sums, *label);
                    if let Some(probabilities) = &mut probabilities {
                        sums.iter_mut().for_each(|sum| *sum /= total);
                        probabilities[u] = softmax(sums);
                    }
                }
            }
        },
    );
}

/// The bin whose middle is before pixel `at`, and how far on to the next it is.
fn place(at: usize, step: f32) -> (i64, f32) {
    let x = (at as f32 + 0.5) / step - 0.5;
    (x.floor() as i64, x - x.floor())
}

fn softmax(logits: &[f32]) -> [f32; CLASSES.len()] {
    let most = logits.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let mut shares = [0.0; CLASSES.len()];
    shares.iter_mut().zip(logits).for_each(|(share, logit)| *share = (logit - most).exp());
    let total: f32 = shares.iter().sum();
    shares.map(|share| share / total)
}

fn largest(sums: &[f32], of_none: u8) -> u8 {
    let best = sums.iter().zip(0_u8..).max_by(|a, b| a.0.total_cmp(b.0).then(b.1.cmp(&a.1)));
    best.map_or(of_none, |(_, class)| class)
}
