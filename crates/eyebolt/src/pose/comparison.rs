//! Two poses against each other, pixel by pixel.

use super::judge::{Judge, pixel_cost};
use super::smooth::SmoothSurface;
use crate::segment::END_EFFECTOR;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::Posture;

/// By how much a frame speaks for one pose against another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Sum over pixels of how much less the first one costs; positive where the frame is for it.
    pub advantage: f64,
    /// Standard deviation of that sum, as the differences between patches of the image show it.
    pub deviation: f64,
    /// Pixels where either says something.
    pub pixels: usize,
}

impl Comparison {
    /// By how many standard deviations the frame is for the first one.
    pub fn significance(&self) -> f64 {
        self.advantage / self.deviation.max(f64::MIN_POSITIVE)
    }

    /// Of two poses with their fingers, by depth with this standard deviation, metres.
    pub fn between(
        judge: &mut Judge<'_>,
        first: (&Posture, &Transform<Camera, Base>),
        second: (&Posture, &Transform<Camera, Base>),
        deviation_m: f64,
    ) -> Self {
        let [first, second] =
            [first, second].map(|(posture, pose)| judge.costs(posture, pose, deviation_m));
        Self::of(judge, &first, &second)
    }

    /// Of a pose and of no end-effector at all: by those pixels alone that are labelled as one and that the pose has on the shape, since a
    /// surface says nothing of where it ends.
    pub fn with_smooth(
        judge: &mut Judge<'_>,
        (posture, pose): (&Posture, &Transform<Camera, Base>),
        smooth: &SmoothSurface,
        deviation_m: f64,
    ) -> Self {
        let posed = judge.costs(posture, pose, deviation_m);
        let drawn: Vec<bool> = (0..posed.len()).map(|at| judge.drawn_m(at).is_some()).collect();
        let observed = judge.observed();
        let costs = (0..posed.len()).map(|at| {
            let z = f64::from(observed.image.depth_m[at]);
            let says = z > 0.0 && drawn[at] && observed.label[at] == END_EFFECTOR;
            let off = (z - smooth.depth_m(observed.image.rays[at])) / (3.0 * deviation_m);
            says.then_some(pixel_cost(off as f32))
        });
        let costs: Vec<Option<f32>> = costs.collect();
        let posed =
            posed.into_iter().zip(&costs).map(|(cost, other)| cost.filter(|_| other.is_some()));
        Self::of(judge, &posed.collect::<Vec<_>>(), &costs)
    }

    fn of(judge: &Judge<'_>, first: &[Option<f32>], second: &[Option<f32>]) -> Self {
        let (width, edge) = (judge.observed().image.width, judge.observed().patch_edge());
        let across = width.div_ceil(edge).max(1);
        let down = first.len().div_ceil(width.max(1)).div_ceil(edge);
        let mut patches = vec![0.0; across * down];
        let mut pixels = 0;
        for (at, (a, b)) in first.iter().zip(second).enumerate() {
            if a.is_none() && b.is_none() {
                continue;
            }
            pixels += 1;
            let patch = at / width / edge * across + at % width / edge;
            patches[patch] += f64::from(b.unwrap_or(0.0) - a.unwrap_or(0.0));
        }
        let advantage = patches.iter().sum();
        let variance: f64 = patches.iter().map(|difference| difference * difference).sum();
        Self { advantage, deviation: variance.sqrt(), pixels }
    }
}
