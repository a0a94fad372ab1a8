//! Whether a frame shows the arm where the labels have it.

use super::classes::Judge;
use eyebolt_geometry::DepthImage;
use eyebolt_registration::Margin;
use std::fmt;

/// Pixels this far inside the outline show the arm undisturbed by its edge.
const INTERIOR_PX: f32 = 4.0;
/// Fewer pixels than this contradict nothing: an arm at the rim of the image.
const LEAST_PIXELS: usize = 100;
/// More than this share of the arm's pixels see through a good pose only if the joints are not
/// those of the frame.
const MOST_CONTRADICTED: f64 = 0.15;

/// Why the labels of a frame are not to be trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contradiction {
    /// The camera saw what is behind the arm where the arm should be.
    SeenThrough {
        /// Share of the arm's pixels where it did.
        share: f64,
    },
}

impl fmt::Display for Contradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SeenThrough { share } => write!(
                f,
                "{:.0} % of the arm's pixels show what is behind it: the joints are not those of \
                 this frame",
                100.0 * share
            ),
        }
    }
}

/// Counts of interior pixels of the drawn arm.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Consistency {
    agreeing: usize,
    contradicting: usize,
}

impl Consistency {
    pub(super) fn of(judge: &Judge<'_>, depth: &DepthImage) -> Self {
        let mut counts = Self::default();
        for (place, at) in judge.outline.pixels().enumerate() {
            let (z, drawn_m) = (depth.depth_m()[at], judge.raster.depth_m(at));
            let Some(drawn_m) = drawn_m.filter(|_| judge.outline.inside_px(place) > INTERIOR_PX)
            else {
                continue;
            };
            let beyond_m = judge.noise.margin_m(Margin::Search, drawn_m);
            if z <= 0.0 {
                continue;
            } else if judge.near.distance_m(place).abs() <= judge.surface_m(z) {
                counts.agreeing += 1;
            } else if z > drawn_m + beyond_m {
                counts.contradicting += 1;
            }
        }
        counts
    }

    pub(super) fn contradiction(&self) -> Option<Contradiction> {
        let all = self.agreeing + self.contradicting;
        let share = self.contradicting as f64 / all.max(1) as f64;
        (all >= LEAST_PIXELS && share > MOST_CONTRADICTED)
            .then_some(Contradiction::SeenThrough { share })
    }
}
