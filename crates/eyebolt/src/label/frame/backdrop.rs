//! The scene behind the arm, pixel by pixel.

use crate::depth_noise::DepthNoise;
use crate::observations::{Configuration, Observations};
use eyebolt_geometry::PinholeCamera;
use eyebolt_registration::{Label, Labels, Margin, Start};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// Pixels this near to the drawn arm may show it, or the shadow and the mixed depth of its edge.
const CLEAR_PX: f32 = 8.0;
/// Depth beyond so many standard deviations of a pixel is something else.
const SIGMAS: f32 = 4.0;
/// The median absolute deviation of a normal distribution times this is its standard deviation.
const MAD_TO_SIGMA: f32 = 1.4826;

/// What each pixel sees where the arm is not, in true metres: from frames without the arm, and from
/// configurations in which it stood elsewhere.
#[derive(Debug)]
pub(super) struct Backdrop {
    /// Of frames without the arm; empty if there are none.
    seen_m: Vec<f32>,
    /// Median over configurations, 0 where the arm always was; and its spread.
    median_m: Vec<f32>,
    sigma_m: Vec<f32>,
}

impl Backdrop {
    /// What `observations` show beside the arm, posed as `at` has it.
    pub(super) fn learn(observations: &Observations, camera: &PinholeCamera, at: &Start) -> Self {
        let factor = at.depth_factor();
        let configurations = &observations.configurations;
        let covered: Vec<Vec<bool>> = configurations
            .par_iter()
            .map(|configuration| covered(observations, camera, at, configuration))
            .collect();
        let of_pixel = |pixel: usize| {
            let free = configurations.iter().zip(&covered).filter(|(_, covered)| !covered[pixel]);
            let depths =
                free.map(|(configuration, _)| factor * configuration.depth.depth_m()[pixel]);
            median_and_sigma(&mut depths.filter(|z| *z > 0.0).collect::<Vec<f32>>())
        };
        let (median_m, sigma_m) = (0..camera.pixel_count()).into_par_iter().map(of_pixel).unzip();
        let seen = observations.background.depth().map_or(&[][..], |depth| depth.depth_m());
        Self { seen_m: seen.iter().map(|z| factor * z).collect(), median_m, sigma_m }
    }

    /// What `pixel` is known to see without the arm: of each source that knows, depth and spread.
    fn known(&self, pixel: usize) -> impl Iterator<Item = (f32, f32)> + '_ {
        let seen = self.seen_m.get(pixel).map(|z| (*z, 0.0));
        let median = (self.median_m[pixel], self.sigma_m[pixel]);
        seen.into_iter().chain([median]).filter(|(z, _)| *z > 0.0)
    }

    /// Whether `depth_m` at `pixel` is what is there without the arm.
    pub(super) fn explains(&self, pixel: usize, depth_m: f32, noise: &DepthNoise) -> bool {
        self.known(pixel).any(|(behind_m, sigma_m)| {
            let margin_m = noise.margin_m(Margin::Refined, behind_m).max(SIGMAS * sigma_m);
            (depth_m - behind_m).abs() <= margin_m
        })
    }

    /// The nearest depth that `pixel` is known to have without the arm, metres.
    pub(super) fn nearest_m(&self, pixel: usize) -> Option<f32> {
        self.known(pixel).map(|(z, _)| z).min_by(f32::total_cmp)
    }
}

/// Whether each pixel is at the drawn arm or near it.
fn covered(
    observations: &Observations,
    camera: &PinholeCamera,
    at: &Start,
    configuration: &Configuration,
) -> Vec<bool> {
    let (arm, mut raster) = (&observations.arm, Raster::new(camera));
    let posture = configuration.posture.moved(arm, &at.joint_offsets);
    raster.draw(camera, &posture.meshes(arm, &at.camera_from_base));
    let (width, height) = (raster.width(), raster.height());
    let drawn = Labels::from_fn(0..width, 0..height, |u, v| match raster.link(v * width + u) {
        Some(_) => Label::Arm,
        None => Label::Background,
    });
    drawn.near(CLEAR_PX, Label::is_robot)
}

fn median_and_sigma(depths: &mut [f32]) -> (f32, f32) {
    let Some(median) = median(depths) else { return (0.0, 0.0) };
    for depth in depths.iter_mut() {
        *depth = (*depth - median).abs();
    }
    (median, MAD_TO_SIGMA * self::median(depths).unwrap_or(0.0))
}

fn median(values: &mut [f32]) -> Option<f32> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f32::total_cmp).1)
}
