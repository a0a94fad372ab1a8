//! The clouds seen and the posed robot, for a page to draw in three dimensions.
//!
//! All in the base frame, metres; points and vertices are stored in 16 bits for each coordinate of
//! their box, which is finer than a millimetre.

mod cloud;
mod quantised;
mod rows;
mod shape;

use crate::answer::Answer;
use crate::observations::Observations;
use crate::pipeline::Outcome;
use crate::report::leftovers::Leftover;
use crate::report::seen::all_seen;
use nalgebra::{Point2, Point3};
use quantised::Bounds;
use rows::rows;
use serde::Serialize;

/// What the page draws.
#[derive(Debug, Serialize)]
pub(super) struct Scene {
    bounds: Bounds,
    configurations: Vec<cloud::Cloud>,
    links: Vec<shape::Shape>,
    /// Middle of the workspace, base frame.
    target: [f32; 3],
    camera: CameraDrawing,
    names: Names,
}

#[derive(Debug, Serialize)]
struct Names {
    base: String,
    camera: String,
}

/// Where the camera is and what it sees.
#[derive(Debug, Serialize)]
struct CameraDrawing {
    /// Pose of the optical frame in the base.
    base_from_camera: [f32; 12],
    /// `base_from_image`: the same but for clouds whose grid is turned in their frame.
    base_from_image: [f32; 12],
    /// `[x / z, y / z]` of the image's corners, one after the other.
    corners: [[f32; 2]; 4],
}

/// The scene of an outcome; `None` without a pose.
pub(super) fn scene(answer: &Answer, outcome: &Outcome, leftovers: &[Leftover]) -> Option<Scene> {
    let calibration = &outcome.calibration;
    let (observations, refinement) =
        (outcome.observations.as_ref()?, calibration.refinement.as_ref()?);
    let base_from_camera = calibration.camera_from_base?.inverse();
    let base_from_image = refinement.camera_from_base.inverse();
    let postures = outcome.postures();
    let clouds = all_seen(observations, &postures, refinement, leftovers);
    let bounds = Bounds::of(clouds.iter().flat_map(|cloud| &cloud.points));
    let dropped = |index: usize| {
        calibration.configurations.get(index).is_some_and(|outcome| outcome.dropped.is_some())
    };
    let configurations = observations.configurations.iter().zip(&postures).zip(&clouds).enumerate();
    Some(Scene {
        configurations: configurations
            .map(|(index, ((configuration, posture), seen))| {
                cloud::Cloud::new(configuration, posture, seen, &bounds, dropped(index))
            })
            .collect(),
        links: shape::shapes(&observations.arm),
        bounds,
        target: answer.workspace_in_base_m.unwrap_or_default().map(|m| m as f32),
        camera: CameraDrawing {
            base_from_camera: rows(&base_from_camera),
            base_from_image: rows(&base_from_image),
            corners: corners(observations),
        },
        names: Names {
            base: answer.frames.base.clone(),
            camera: answer.frames.camera.clone().unwrap_or_else(|| "camera".to_owned()),
        },
    })
}

impl Scene {
    /// As JSON that may stand in a `<script>`, which ends at the first `</script`.
    pub(super) fn to_json(&self) -> String {
        let json = serde_json::to_string(self).expect("a scene is plain data");
        json.replace('<', "\\u003c")
    }
}

/// The image's corners; those of an image without a lens where its lens has no ray there.
fn corners(observations: &Observations) -> [[f32; 2]; 4] {
    let camera = &observations.camera;
    let (right, bottom) = (f64::from(camera.width()) - 0.5, f64::from(camera.height()) - 0.5);
    let corners = [[-0.5, -0.5], [right, -0.5], [right, bottom], [-0.5, bottom]];
    corners.map(|[u, v]| {
        let ray = camera.ray(&Point2::new(u, v)).map(Point3::from);
        let plain = [(u - camera.cx()) / camera.fx(), (v - camera.cy()) / camera.fy()];
        ray.map_or(plain, |ray| [ray.x, ray.y]).map(|tangent| tangent as f32)
    })
}
