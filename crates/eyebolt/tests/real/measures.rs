//! The measures that the promises are made in.

use eyebolt::pipeline::Outcome;
use eyebolt_geometry::{Base, Camera, Mask, Transform};
use eyebolt_recording::Recording;
use eyebolt_registration::median;
use eyebolt_render::Raster;
use nalgebra::Matrix4;

/// `HT_left_dr` of the recording's notes, found by stereo differentiable rendering (roboreg).
pub fn reference() -> Transform<Camera, Base> {
    #[rustfmt::skip]
    let base_from_camera = Matrix4::new(
        0.507_517_158_985, 0.488_052_487_373, -0.710_092_306_137, 0.717_076_420_784,
        0.820_680_797_100, -0.022_729_594_260, 0.570_934_593_678, -0.965_935_111_046,
        0.262_506_008_148, -0.872_518_181_801, -0.412_071_019_411, 1.133_187_770_844,
        0.0, 0.0, 0.0, 1.0,
    );
    Transform::<Base, Camera>::from_matrix(&base_from_camera, 1e-6).unwrap().inverse()
}

/// Distance of the cameras in the base frame (mm) and angle between them (degrees).
pub fn apart(a: &Transform<Camera, Base>, b: &Transform<Camera, Base>) -> (f64, f64) {
    let (metres, radians) = a.inverse().distance_to(&b.inverse());
    (1e3 * metres, radians.to_degrees())
}

/// The masks of the recording's frames.
pub fn masks(recording: &Recording) -> Vec<Mask> {
    let count = recording.frame_names().len();
    (0..count).map(|index| recording.read_frame(index).unwrap().mask.unwrap()).collect()
}

/// Intersection over union of the posed arm and `masks`, all frames' pixels together.
pub fn silhouette_iou(outcome: &Outcome, masks: &[Mask], pose: &Transform<Camera, Base>) -> f64 {
    let observations = outcome.observations.as_ref().unwrap();
    let mut raster = Raster::new(&observations.camera);
    let (mut overlap, mut union) = (0, 0);
    for (posture, mask) in outcome.postures().iter().zip(masks) {
        raster.draw(&observations.camera, &posture.meshes(&observations.arm, pose));
        let both = raster.pixels().filter(|at| mask.as_slice()[*at]).count();
        overlap += both;
        union += raster.pixels().count() + mask.count() - both;
    }
    overlap as f64 / union as f64
}

/// Median distance (mm) from the posed arm of the points seen at the pixels of `masks`, these
/// eroded by 7 x 7 pixels, nearer than 2 m.
pub fn surface_distance(outcome: &Outcome, masks: &[Mask], pose: &Transform<Camera, Base>) -> f64 {
    let observations = outcome.observations.as_ref().unwrap();
    let base_from_camera = pose.inverse();
    let mut distances = Vec::new();
    let seen = observations.configurations.iter().zip(outcome.postures());
    for ((configuration, posture), mask) in seen.zip(masks) {
        let eroded = mask.eroded(3);
        let depth = configuration.depth.depth_m();
        let pixels = eroded.as_slice().iter().enumerate().filter(|(_, set)| **set);
        for (at, _) in pixels.filter(|(at, _)| depth[*at] > 0.0 && depth[*at] < 2.0) {
            let point = observations.rays.point(at, depth[at]);
            let point = base_from_camera.point(&point.cast()).cast();
            let nearest = posture.nearest(&observations.arm, &point).unwrap();
            distances.push(1e3 * f64::from(nearest.distance_m).abs());
        }
    }
    median(&mut distances).unwrap()
}
