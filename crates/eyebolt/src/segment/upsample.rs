//! From logits of a thinned image to labels of the full one.

use super::segmenter::UNKNOWN;
use super::thinned::Thinned;
use eyebolt_geometry::DepthImage;
use eyebolt_net::Matrix;
use rayon::prelude::*;

/// A bin speaks for pixels whose depth differs from its own by about this share.
const SAME_SURFACE: f32 = 0.01;
/// What is left of its weight elsewhere: where no bin has the depth, the nearest ones speak.
const ELSEWHERE: f32 = 1e-4;

/// Labels of all pixels of `depth`: the class of the largest logit between the four bins around, weighted
/// by nearness in the image and in depth (joint bilateral upsampling: Kopf et al., SIGGRAPH 2007).
/// `logits` has a row for each of `rows`, the bins of `image` that have depth.
pub fn upsample(depth: &DepthImage, image: &Thinned, rows: &[usize], logits: &Matrix) -> Vec<u8> {
    const NONE: u32 = u32::MAX;
    let mut row_of = vec![NONE; image.depth_m.len()];
    rows.iter().zip(0..).for_each(|(at, row)| row_of[*at] = row);
    let (width, step) = (depth.width() as usize, image.step as f32);
    let classes = logits.channels();
    let mut labels = vec![UNKNOWN; depth.depth_m().len()];
    let lines = labels.par_chunks_mut(width).zip(depth.depth_m().par_chunks(width)).enumerate();
    lines.for_each_init(
        || vec![0.0_f32; classes],
        |sums, (v, (labels, depths))| {
            let (v0, part_v) = place(v, step);
            for (u, (label, &z)) in
                labels.iter_mut().zip(depths).enumerate().filter(|(_, (_, z))| **z > 0.0)
            {
                let (u0, part_u) = place(u, step);
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
                *label = if total > 0.0 { largest(sums) } else { UNKNOWN };
            }
        },
    );
    labels
}

/// The bin whose middle is before pixel `at`, and how far on to the next it is.
fn place(at: usize, step: f32) -> (i64, f32) {
    let x = (at as f32 + 0.5) / step - 0.5;
    (x.floor() as i64, x - x.floor())
}

fn largest(sums: &[f32]) -> u8 {
    let best = sums.iter().zip(0_u8..).max_by(|a, b| a.0.total_cmp(b.0).then(b.1.cmp(&a.1)));
    best.map_or(UNKNOWN, |(_, class)| class)
}
