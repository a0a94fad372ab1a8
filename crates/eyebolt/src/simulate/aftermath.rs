//! Errors of depth that no model of a camera has: those of glossy arms, of stereo that finds little to
//! match, and the fixed pattern of a specimen.

use super::plan::Plan;
use super::random_stream::RandomStream;
use eyebolt_geometry::{Base, Camera, DepthImage, Transform};
use eyebolt_render::{Exposure, Field, Random, RayScene};
use rayon::prelude::*;
use std::f32::consts::TAU;

/// What the camera sees of one configuration: all but the noise of the single frame.
pub(super) struct Shot {
    exposure: Exposure,
    gloss: Option<Vec<Gloss>>,
    /// Standard deviation at one metre, and the error there in its units.
    wander: Option<(f32, Field)>,
    pattern: Option<Pattern>,
}

/// What becomes of the depth of one pixel.
#[derive(Clone, Copy, PartialEq)]
enum Gloss {
    Right,
    Hole,
    /// The match is so many metres behind.
    Behind(f32),
}

/// Lag at which the error of stereo that finds little to match is half correlated, pixels.
const WANDER_PX: f32 = 40.0;
/// Size of patches that gloss, and by how much a wrong match is behind, metres.
const PATCH_PX: f32 = 8.0;
const BEHIND_M: [f32; 2] = [0.02, 0.30];

impl Plan<'_> {
    /// What the camera at a pose makes of `scene`, in which the first meshes are the arm, in a
    /// configuration; none for the background.
    pub(super) fn shoot(
        &self,
        scene: &RayScene,
        base_from_camera: &Transform<Base, Camera>,
        exposure: Exposure,
        configuration: Option<usize>,
    ) -> Shot {
        let (seed, lab) = (self.scenario.seed, &self.scenario.faults.lab);
        let size = [self.camera.width() as usize, self.camera.height() as usize];
        let place = configuration.map_or(u64::MAX, |index| index as u64);
        let stream = |stream: RandomStream| stream.of(seed).at(place);
        let glossy = lab.gloss > 0.0 && configuration.is_some();
        Shot {
            gloss: glossy.then(|| {
                let view = scene.view(&self.camera, base_from_camera);
                let links = self.body.links.len();
                let arm: Vec<bool> =
                    view.surface.iter().map(|surface| usize::from(*surface) < links).collect();
                patches(&arm, size, lab.gloss, stream(RandomStream::Gloss))
            }),
            wander: (lab.wander_m > 0.0).then(|| {
                let field = Field::new(stream(RandomStream::Wander), size, WANDER_PX);
                (lab.wander_m as f32, field)
            }),
            pattern: (lab.fixed_pattern != 0.0).then(|| {
                Pattern::new(lab.fixed_pattern as f32, size, RandomStream::FixedPattern.of(seed))
            }),
            exposure,
        }
    }
}

/// Patches of `arm`'s pixels, as many as `share` of them.
fn patches(arm: &[bool], size: [usize; 2], share: f64, random: Random) -> Vec<Gloss> {
    let [where_, how, depth] = [0, 1, 2].map(|place| Field::new(random.at(place), size, PATCH_PX));
    let at = |field: &Field, pixel: usize| field.at(pixel % size[0], pixel / size[0]);
    let mut heights: Vec<f32> =
        (0..arm.len()).filter(|pixel| arm[*pixel]).map(|pixel| at(&where_, pixel)).collect();
    heights.sort_by(f32::total_cmp);
    let right = ((1.0 - share) * heights.len() as f64) as usize;
    let Some(level) = heights.get(right).copied() else { return vec![Gloss::Right; arm.len()] };
    let pixel = |pixel: usize| match arm[pixel] && at(&where_, pixel) >= level {
        false => Gloss::Right,
        true if at(&how, pixel) > 0.0 => Gloss::Hole,
        true => {
            let [least, most] = BEHIND_M;
            Gloss::Behind((least + 0.12 * at(&depth, pixel).abs()).min(most))
        }
    };
    (0..arm.len()).map(pixel).collect()
}

impl Shot {
    /// The frame with the noise of `random`.
    pub(super) fn frame(&self, random: Random) -> DepthImage {
        let frame = self.exposure.frame(random);
        if self.gloss.is_none() && self.wander.is_none() && self.pattern.is_none() {
            return frame;
        }
        let (width, height) = (frame.width(), frame.height());
        let mut depth_m = frame.into_depth_m();
        let pixels = depth_m.par_iter_mut().enumerate().filter(|(_, z)| **z > 0.0);
        pixels.for_each(|(at, z)| *z = self.depth_m(at % width as usize, at / width as usize, *z));
        DepthImage::new(width, height, depth_m).expect("as many pixels as before")
    }

    /// What becomes of depth `z`.
    fn depth_m(&self, u: usize, v: usize, z: f32) -> f32 {
        let [width, _] = self.exposure.size();
        let z = match self.gloss.as_ref().map_or(Gloss::Right, |gloss| gloss[v * width + u]) {
            Gloss::Right => z,
            Gloss::Hole => return 0.0,
            Gloss::Behind(by_m) => z + by_m,
        };
        let wander = self.wander.as_ref().map_or(0.0, |(sigma, field)| sigma * field.at(u, v));
        let pattern = self.pattern.as_ref().map_or(0.0, |pattern| pattern.at(u, v));
        (z + z * z * (wander + pattern)).max(0.0)
    }
}

/// The error of depth that one specimen of a camera has in every frame, metres at one metre; it grows
/// with the square of depth.
///
/// Structured light is off in rings, for the distortion of two lenses that is left, and in vertical
/// bands: Herrera, Kannala and Heikkila (*Joint depth and color camera calibration with distortion
/// correction*, PAMI 34, 2012), Teichman, Miller and Thrun (*Unsupervised intrinsic calibration of depth
/// sensors via SLAM*, RSS 2013), Darwish et al. (*A new calibration method for commercial RGB-D sensors*,
/// Sensors 17, 2017). That there are both and that they grow with depth is theirs; the sizes are the order
/// of what they show, taken for a Kinect v1 at 1.5 m: 8 mm at the corners, 2.5 mm from band to band.
struct Pattern {
    size: [f32; 2],
    centre: [f32; 2],
    bowl: f32,
    band: f32,
    bands: f32,
    phase: f32,
}

impl Pattern {
    fn new(strength: f32, size: [usize; 2], mut random: Random) -> Self {
        let at_m = 1.5 * 1.5;
        let [width, height] = size.map(|pixels| pixels as f32);
        let mut near_middle = || random.between(0.45, 0.55) as f32;
        let centre = [width * near_middle(), height * near_middle()];
        let sign = if random.uniform() < 0.5 { -1.0 } else { 1.0 };
        Self {
            size: [width, height],
            centre,
            bowl: sign * strength * 0.008 / at_m,
            band: strength * 0.0025 / at_m,
            bands: random.between(6.0, 9.0) as f32,
            phase: random.between(0.0, f64::from(TAU)) as f32,
        }
    }

    fn at(&self, u: usize, v: usize) -> f32 {
        let [width, height] = self.size;
        let (x, y) = (u as f32 - self.centre[0], v as f32 - self.centre[1]);
        let corner = 0.25 * (width * width + height * height);
        let ring = (x * x + y * y) / corner;
        // A saw: depth steps at the edge of each band.
        let along = (self.bands * u as f32 / width + self.phase / TAU).fract();
        self.bowl * ring + self.band * (along - 0.5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [usize; 2] = [320, 240];

    #[test]
    fn as_much_of_the_arm_fails_as_is_asked_for_and_nothing_else() {
        let arm: Vec<bool> = (0..320 * 240).map(|at| (80..240).contains(&(at % 320))).collect();
        for share in [0.1, 0.5] {
            let found = patches(&arm, SIZE, share, Random::new(2));
            let wrong = |at: &usize| found[*at] != Gloss::Right;
            let count = (0..arm.len()).filter(wrong).count() as f64;
            assert!((count / (160.0 * 240.0) - share).abs() < 0.01, "{count}");
            assert!((0..arm.len()).filter(wrong).all(|at| arm[at]));
            let behind = found.iter().filter(|gloss| matches!(gloss, Gloss::Behind(_))).count();
            assert!((0.2..0.8).contains(&(behind as f64 / count)), "{behind} of {count}");
        }
        assert!(
            patches(&vec![false; 320 * 240], SIZE, 0.5, Random::new(2))
                .iter()
                .all(|g| *g == Gloss::Right)
        );
    }

    #[test]
    fn a_kinect_is_off_by_millimetres_at_the_corners() {
        let pattern = Pattern::new(1.0, SIZE, Random::new(5));
        let at_m = 2.25;
        let corners = [(0, 0), (319, 0), (0, 239), (319, 239)];
        for (u, v) in corners {
            let mm = 1e3 * at_m * pattern.at(u, v).abs();
            assert!((4.0..12.0).contains(&mm), "{mm}");
        }
        let middle = 1e3 * at_m * pattern.at(160, 120).abs();
        assert!(middle < 2.0, "{middle}");
    }
}
