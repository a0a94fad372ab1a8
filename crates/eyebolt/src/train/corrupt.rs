//! What depth cameras get wrong, in so many ways that a real one is among them.
//!
//! Images are already thinned: noise of single pixels is what is left of it after a median over a bin,
//! and most faults are smooth over several pixels or concern whole patches.
//!
//! | fault | figures |
//! |---|---|
//! | depth's scale | 1 % (real cameras are 1 to 2 % long or short) |
//! | smooth error, growing with the square of depth | 0.3 to 15 mm at 1 m, correlated over 0.7 to 15 pixels; two octaves (Handa et al., *A benchmark for RGB-D visual odometry*, ICRA 2014, shift pixels and add noise of disparity; Mahler et al., *Dex-Net 2.0*, RSS 2017, add correlated Gaussian noise made at a fraction of the resolution) |
//! | steps of disparity | up to 20 mm at 1 m |
//! | shadows beside near things | of a baseline of 3 to 12 cm, on either side |
//! | edges eaten, fattened, smeared | up to a pixel of the thinned image |
//! | elliptic and edge dropout, patches without depth, any share up to 90 % of the pixels | as Dex-Net 2.0 and Thalhammer et al., *SyDPose* (CVPR workshops 2019) |
//! | patches of false matches, gloss on the arm | 2 to 40 cm behind or before |
//! | range | from 1.5 m on |

use crate::segment::{BACKGROUND, Thinned};
use eyebolt_render::{Field, Random};

/// Changes `image` as some camera would; `label` says where the arm is, which may gloss.
pub fn corrupt(image: &mut Thinned, label: &[u8], random: Random) {
    let mut style = random.at(0);
    // One image in ten is from a very good camera.
    if style.uniform() < 0.1 {
        return;
    }
    let chance = |random: &mut Random, share: f64| random.uniform() < share;
    if chance(&mut style, 0.6) {
        displace_edges(image, style.between(0.3, 1.3) as f32, random.at(1));
    }
    if chance(&mut style, 0.35) {
        smear(image, style.between(0.2, 1.0) as f32, random.at(2));
    }
    if chance(&mut style, 0.5) {
        shadow(image, &mut style);
    }
    if chance(&mut style, 0.3) {
        gloss(image, label, &mut style, random.at(3));
    }
    if chance(&mut style, 0.35) {
        false_matches(image, &mut style, random.at(4));
    }
    smooth_error(image, &mut style, random.at(5));
    if chance(&mut style, 0.4) {
        steps(image, 0.02 * style.uniform().powi(2) as f32);
    }
    if chance(&mut style, 0.6) {
        patches_without_depth(image, &mut style, random.at(6));
    }
    if chance(&mut style, 0.35) {
        let share = if chance(&mut style, 0.15) {
            style.between(0.3, 0.9)
        } else {
            style.between(0.0, 0.15)
        };
        drop_at_random(image, share, random.at(7));
    }
    if chance(&mut style, 0.3) {
        let far = style.between(1.5, 5.0) as f32;
        image.depth_m.iter_mut().filter(|z| **z > far).for_each(|z| *z = 0.0);
    }
}

fn field(image: &Thinned, random: Random, half_px: f32) -> Field {
    Field::new(random, [image.width, image.height], half_px)
}

/// Every pixel takes the depth of one up to a few away: contours tremble, as stereo's and structured
/// light's do.
fn displace_edges(image: &mut Thinned, sigma_px: f32, random: Random) {
    let [across, down] = [0, 1].map(|place| field(image, random.at(place), 1.5));
    let before = image.depth_m.clone();
    let (width, height) = (image.width as i64, image.height as i64);
    for (at, z) in image.depth_m.iter_mut().enumerate() {
        let (u, v) = (at % image.width, at / image.width);
        let moved = |place: usize, field: &Field, size: i64| {
            (place as i64 + (sigma_px * field.at(u, v)).round() as i64).clamp(0, size - 1)
        };
        *z = before[(moved(v, &down, height) * width + moved(u, &across, width)) as usize];
    }
}

/// Depth between near and far where the two meet: flying pixels, and networks that match smoothly.
fn smear(image: &mut Thinned, share: f32, random: Random) {
    let mix = field(image, random, 2.0);
    let before = image.depth_m.clone();
    let width = image.width;
    for v in 1..image.height - 1 {
        for u in 1..width - 1 {
            let at = v * width + u;
            let around = [at, at - 1, at + 1, at - width, at + width].map(|place| before[place]);
            if around.contains(&0.0) {
                continue;
            }
            let mean = around.iter().sum::<f32>() / 5.0;
            let weight = (share * mix.at(u, v).abs()).min(1.0);
            image.depth_m[at] += weight * (mean - before[at]);
        }
    }
}

/// Nothing is seen beside near things, on the side of the second eye.
fn shadow(image: &mut Thinned, random: &mut Random) {
    let baseline = random.between(0.03, 0.12) as f32;
    let per_px = image.width as f32 / (image.rays[image.width - 1][0] - image.rays[0][0]);
    let from_left = random.uniform() < 0.5;
    for row in image.depth_m.chunks_exact_mut(image.width) {
        if from_left {
            row.reverse();
        }
        // Where the second eye sees each pixel, in pixels; what lies behind one before it is hidden.
        let mut farthest = f32::NEG_INFINITY;
        for (u, z) in row.iter_mut().enumerate() {
            if *z <= 0.0 {
                continue;
            }
            let there = u as f32 + per_px * baseline / *z;
            if there < farthest - 0.5 {
                *z = 0.0;
            } else {
                farthest = farthest.max(there);
            }
        }
        if from_left {
            row.reverse();
        }
    }
}

/// Patches of the arm without depth, or matched to what is behind.
fn gloss(image: &mut Thinned, label: &[u8], style: &mut Random, random: Random) {
    let size = style.between(1.5, 6.0) as f32;
    let level = style.between(0.2, 1.5) as f32;
    let behind = style.between(0.02, 0.4) as f32;
    let [where_, how, depth] = [0, 1, 2].map(|place| field(image, random.at(place), size));
    for at in (0..label.len()).filter(|at| label[*at] != BACKGROUND) {
        let (u, v) = (at % image.width, at / image.width);
        if image.depth_m[at] > 0.0 && where_.at(u, v) > level {
            let wrong = image.depth_m[at] + behind * depth.at(u, v).abs();
            image.depth_m[at] = if how.at(u, v) > 0.0 { 0.0 } else { wrong };
        }
    }
}

/// Whole patches at a wrong depth.
fn false_matches(image: &mut Thinned, style: &mut Random, random: Random) {
    let size = style.between(2.0, 8.0) as f32;
    let level = style.between(1.5, 2.6) as f32;
    let by = style.between(0.05, 0.6) as f32;
    let [where_, depth] = [0, 1].map(|place| field(image, random.at(place), size));
    for at in 0..image.depth_m.len() {
        let (u, v) = (at % image.width, at / image.width);
        if image.depth_m[at] > 0.0 && where_.at(u, v) > level {
            image.depth_m[at] = (image.depth_m[at] * (1.0 + by * depth.at(u, v))).max(0.2);
        }
    }
}

fn smooth_error(image: &mut Thinned, style: &mut Random, random: Random) {
    let log_between = |random: &mut Random, low: f64, high: f64| {
        (low.ln() + random.uniform() * (high / low).ln()).exp() as f32
    };
    let coarse_m = log_between(style, 0.0005, 0.015);
    let fine_m = log_between(style, 0.0003, 0.015);
    let scale = 1.0 + 0.01 * style.normal() as f32;
    let coarse = field(image, random.at(0), style.between(4.0, 15.0) as f32);
    let fine = field(image, random.at(1), style.between(0.7, 2.5) as f32);
    // Structured light is off in rings.
    let bowl = if style.uniform() < 0.2 { 0.004 * style.normal() as f32 } else { 0.0 };
    for at in 0..image.depth_m.len() {
        let z = image.depth_m[at];
        if z > 0.0 {
            let (u, v) = (at % image.width, at / image.width);
            let [x, y] = image.rays[at];
            let error =
                coarse_m * coarse.at(u, v) + fine_m * fine.at(u, v) + bowl * (x * x + y * y);
            image.depth_m[at] = (scale * z + z * z * error).max(0.1);
        }
    }
}

/// Whole steps of disparity, `at_1_m` metres each at one metre.
fn steps(image: &mut Thinned, at_1_m: f32) {
    if at_1_m > 1e-4 {
        for z in image.depth_m.iter_mut().filter(|z| **z > 0.0) {
            *z = 1.0 / ((1.0 / (*z * at_1_m)).round().max(1.0) * at_1_m);
        }
    }
}

fn patches_without_depth(image: &mut Thinned, style: &mut Random, random: Random) {
    let size = style.between(1.0, 7.0) as f32;
    let level = style.between(0.8, 2.6) as f32;
    let where_ = field(image, random.at(0), size);
    for at in 0..image.depth_m.len() {
        if where_.at(at % image.width, at / image.width) > level {
            image.depth_m[at] = 0.0;
        }
    }
    // Ellipses anywhere.
    for place in 0..style.index(6) as u64 {
        let mut random = random.at(1).at(place);
        let (u0, v0) =
            (random.between(0.0, image.width as f64), random.between(0.0, image.height as f64));
        let [a, b] = [0, 1].map(|_| random.between(1.0, 0.08 * image.width as f64));
        for at in 0..image.depth_m.len() {
            let (u, v) = ((at % image.width) as f64 - u0, (at / image.width) as f64 - v0);
            if (u / a).powi(2) + (v / b).powi(2) < 1.0 {
                image.depth_m[at] = 0.0;
            }
        }
    }
}

fn drop_at_random(image: &mut Thinned, share: f64, random: Random) {
    for (at, z) in image.depth_m.iter_mut().enumerate() {
        if random.at(at as u64).uniform() < share {
            *z = 0.0;
        }
    }
}
