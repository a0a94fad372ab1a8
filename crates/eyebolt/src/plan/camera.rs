//! The camera that is to be calibrated, as far as it is known beforehand.

use crate::observations::Observations;
use crate::simulate::{Ranges, Viewpoint};
use eyebolt_geometry::{Base, Camera, PinholeCamera, Transform};
use eyebolt_render::Random;

/// A camera that stands about where it is said to stand.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughCamera {
    /// Its intrinsics.
    pub camera: PinholeCamera,
    /// Where it is, to centimetres and degrees.
    pub camera_from_base: Transform<Camera, Base>,
    /// Nearest and farthest depth that it tells, metres.
    pub range_m: [f64; 2],
}

/// Depth that most cameras tell, metres.
pub const USUAL_RANGE_M: [f64; 2] = [0.3, 5.0];

/// Nearest and farthest depth that `observations` show, but for a few pixels, and a little nearer: what their camera surely
/// tells, metres.
pub fn told_range_m(observations: &Observations) -> [f64; 2] {
    const STEP: usize = 7;
    const STRAY: usize = 500;
    const NEARER: f64 = 0.85;
    let images = observations.configurations.iter().map(|seen| seen.depth.depth_m());
    let pixels = images.flat_map(|image| image.iter().step_by(STEP));
    let mut depths: Vec<f32> = pixels.copied().filter(|z| *z > 0.0).collect();
    depths.sort_by(f32::total_cmp);
    let stray = depths.len() / STRAY;
    match (depths.get(stray), depths.get(depths.len().saturating_sub(1 + stray))) {
        (Some(near), Some(far)) if near < far => [NEARER * f64::from(*near), f64::from(*far)],
        _ => USUAL_RANGE_M,
    }
}

/// How many cameras stand for one that nobody knows.
const ASSUMED: u64 = 5;

/// Cameras as people put them, where nobody knows the camera: on a tripod before or beside the table or on a shelf above
/// it, from one side to the other; they look at where an arm of `reach_m` works. 640 by 480 pixels, 57 degrees wide.
pub fn assumed_cameras(reach_m: f64, seed: u64) -> Vec<RoughCamera> {
    let scale = reach_m / USUAL_REACH_M;
    let usual = Ranges::default();
    let [first, last] = usual.azimuth;
    let random = Random::new(seed).at(u64::MAX);
    let one = |place: u64| {
        // One in each part of the arc: chance would leave a side out.
        let from = |part: u64| first + (last - first) * part as f64 / ASSUMED as f64;
        let ranges = Ranges {
            workspace_m: usual.workspace_m.map(|metres| scale * metres),
            distance_m: usual.distance_m.map(|metres| scale * metres),
            azimuth: [from(place), from(place + 1)],
            ..usual
        };
        let pose = Viewpoint::Within(ranges).base_from_camera(&mut random.at(place));
        let lens = eyebolt_geometry::Distortion::None;
        let camera = PinholeCamera::new(640, 480, 590.0, 590.0, 319.5, 239.5, lens);
        RoughCamera {
            camera: camera.expect("these numbers make a camera"),
            camera_from_base: pose.inverse(),
            range_m: USUAL_RANGE_M,
        }
    };
    (0..ASSUMED).map(one).collect()
}

/// Reach of the arm that [`Ranges::default`] is made for, metres.
const USUAL_REACH_M: f64 = 0.85;
