//! What a camera will see of a configuration, and what that will tell.

use super::camera::RoughCamera;
use super::movable::MovableArm;
use crate::simulate::{Onlooker, has_hand_in_view, shows_hand};
use eyebolt_geometry::PinholeCamera;
use eyebolt_registration::{
    ArmModel, ExpectedNoise, Posture, PredictedInformation, Start, predicted_information,
};
use eyebolt_render::{Raster, RayScene};
use nalgebra::Point3;

/// A camera that looks on, in images so coarse that thousands of configurations can be looked at.
pub(super) struct Watcher<'a> {
    pub(super) camera: &'a RoughCamera,
    at: Start,
    coarse: PinholeCamera,
    coarser: f64,
    nothing: RayScene,
    noise: ExpectedNoise,
}

/// What a camera will see of the arm in one configuration.
#[derive(Clone, Debug)]
pub(super) struct Sight {
    pub(super) information: PredictedInformation,
    /// Share of the surface of the links that move that is within the image and in range, hidden or not.
    pub(super) in_view_share: f64,
}

/// Columns of the coarse images: a link of ten centimetres is then a dozen pixels wide.
const COLUMNS: u32 = 210;
/// Of the surface of the links that move, what is not in the image may be this much.
const LEAST_IN_VIEW: f64 = 0.5;

impl<'a> Watcher<'a> {
    /// `at` is where the camera is expected, with all that is known to be off.
    pub(super) fn new(camera: &'a RoughCamera, at: Start, noise: ExpectedNoise) -> Self {
        let factor = (camera.camera.width() / COLUMNS).max(1);
        let coarse = camera.camera.scaled(factor).unwrap_or_else(|_| camera.camera.clone());
        let coarser = f64::from(camera.camera.width()) / f64::from(coarse.width());
        Self { camera, at, coarse, coarser, nothing: RayScene::new(&[]), noise }
    }

    /// Buffers to look with.
    pub(super) fn rasters(&self) -> [Raster; 2] {
        [Raster::new(&self.coarse), Raster::new(&self.coarse)]
    }

    fn onlooker(&self) -> Onlooker<'_> {
        Onlooker {
            camera: &self.coarse,
            camera_from_base: self.at.camera_from_base,
            range_m: self.camera.range_m,
            told_m: [1.0, 0.0],
            room: &self.nothing,
        }
    }

    /// Whether the end-effector's frame is in the image, which is quickly told.
    pub(super) fn may_show(&self, arm: &MovableArm, positions: &[f64]) -> bool {
        has_hand_in_view(&arm.body, &self.onlooker(), &arm.all_joints(positions))
    }

    /// What is seen of the arm in `posture`, which has its axes; `None` unless the whole end-effector is in the image, turned
    /// to the camera and not hidden, and half of the links that move.
    pub(super) fn look(
        &self,
        arm: &MovableArm,
        posture: &Posture,
        rasters: &mut [Raster; 2],
    ) -> Option<Sight> {
        let in_view_share = self.in_view_share(arm, posture);
        let shows = in_view_share >= LEAST_IN_VIEW
            && shows_hand(&arm.body, &self.onlooker(), posture, rasters);
        let [raster, _] = rasters;
        shows.then(|| Sight { information: self.information(arm, posture, raster), in_view_share })
    }

    /// What a view of the arm in `posture`, which has its axes, is expected to tell, in view or not.
    pub(super) fn information(
        &self,
        arm: &MovableArm,
        posture: &Posture,
        raster: &mut Raster,
    ) -> PredictedInformation {
        self.information_of(&arm.model, posture, |link| arm.moves(link), raster)
    }

    /// What a view of the links of `model` in `posture` that `counts` is true of is expected to tell, in view or not.
    pub(super) fn information_of(
        &self,
        model: &ArmModel,
        posture: &Posture,
        counts: impl Fn(usize) -> bool,
        raster: &mut Raster,
    ) -> PredictedInformation {
        let start = &self.at;
        let cameras = (&self.camera.camera, &self.coarse, self.coarser);
        let moved = posture.moved(model, &start.joint_offsets);
        raster.draw(&self.coarse, &moved.meshes(model, &start.camera_from_base));
        predicted_information(model, &moved, cameras, raster, start, counts, &self.noise)
    }

    fn in_view_share(&self, arm: &MovableArm, posture: &Posture) -> f64 {
        const STEP: usize = 8;
        let [near, far] = self.camera.range_m;
        let pose = self.at.camera_from_base.isometry();
        let is_seen = |point: &Point3<f32>| {
            let point = pose.transform_point(&point.cast::<f64>());
            let pixel = self.coarse.project(&point);
            (near..far).contains(&point.z)
                && pixel.is_some_and(|pixel| self.coarse.contains(&pixel))
        };
        let links = (0..arm.model.links().len()).filter(|link| arm.moves(*link));
        let (mut seen, mut all) = (0_usize, 0_u32);
        for link in links {
            for point in arm.body.link_surface(posture, link).step_by(STEP) {
                all += 1;
                seen += usize::from(is_seen(&point));
            }
        }
        seen as f64 / f64::from(all.max(1))
    }
}
