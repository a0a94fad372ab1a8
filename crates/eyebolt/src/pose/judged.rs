//! Hypotheses that were refined, and what the frame says of them.

use super::hypotheses::PoseHypothesis;
use super::judge::{Judge, Support};
use super::shape::EndEffectorShape;
use eyebolt_registration::{Icp, IcpOptions, Posture, icp};
use nalgebra::Point3;

/// A hypothesis that was refined and judged.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    pub hypothesis: PoseHypothesis,
    pub fit: Icp,
    pub support: Support,
    /// Which of the openings of its fingers.
    pub opening: usize,
}

/// Deviation of the depth while hypotheses are told apart, as a share of it squared, and at the camera, metres.
pub const COARSE_M: f64 = 0.004;
/// Poses nearer to each other than this are the same one, metres and radians.
const SAME_M: f64 = 0.01;
const SAME_RAD: f64 = 0.1;

/// `hypothesis` refined on `points`, with its fingers in `posture`, which is the one of that number.
pub fn refined(
    judge: &mut Judge<'_>,
    shape: &EndEffectorShape,
    (posture, opening): (&Posture, usize),
    points: &[Point3<f32>],
    hypothesis: PoseHypothesis,
    options: IcpOptions,
) -> Judged {
    let fit = icp(&shape.model, posture, points, &hypothesis.pose, &options);
    let deviation_m = fit.deviation_m.clamp(COARSE_M, 2.0 * COARSE_M);
    let support = judge.support(posture, &fit.camera_from_base, deviation_m);
    Judged { hypothesis, fit, support, opening }
}

/// Best first; of those that are the same pose, the best alone; and no more than `most`.
pub fn keep_distinct(shape: &EndEffectorShape, judged: &mut Vec<Judged>, most: usize) {
    judged.sort_by(|a, b| a.support.cost.total_cmp(&b.support.cost));
    let mut kept: Vec<Judged> = Vec::new();
    for it in judged.drain(..) {
        let same = |other: &Judged| {
            let poses = [other, &it].map(|of| *of.fit.camera_from_base.isometry());
            let (metres, radians) = shape.apart(&poses[0], &poses[1]);
            metres < SAME_M && radians < SAME_RAD
        };
        if kept.len() < most && !kept.iter().any(same) {
            kept.push(it);
        }
    }
    *judged = kept;
}
