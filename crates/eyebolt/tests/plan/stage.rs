//! An arm, a camera and plans for them.

use eyebolt::plan::{MovableArm, Plan, PlanRequest, RoughCamera, Speed, USUAL_RANGE_M, plan_next};
use eyebolt::robots::BuiltIn;
use eyebolt_geometry::{Base, Camera, Distortion, PinholeCamera, Transform};
use eyebolt_registration::LinkCache;
use eyebolt_robot::JointPositions;
use std::path::Path;
use std::sync::LazyLock;

pub static CACHE: LazyLock<LinkCache> =
    LazyLock::new(|| LinkCache::new(Path::new(env!("CARGO_TARGET_TMPDIR")).join("plan-links")));

pub static ARM: LazyLock<MovableArm> = LazyLock::new(|| movable("shackle"));

pub fn movable(robot: &str) -> MovableArm {
    let arm = BuiltIn::named(robot).unwrap().arm();
    MovableArm::new(&arm, &JointPositions::default(), &CACHE).unwrap()
}

/// Before the table, as on a tripod.
pub fn camera() -> RoughCamera {
    let preset = eyebolt::simulate::Preset::named("paper-test-p2").unwrap();
    let base_from_camera: Transform<Base, Camera> = preset.base_from_camera();
    let lens = Distortion::None;
    RoughCamera {
        camera: PinholeCamera::new(640, 480, 580.0, 580.0, 319.5, 239.5, lens).unwrap(),
        camera_from_base: base_from_camera.inverse(),
        range_m: USUAL_RANGE_M,
    }
}

pub fn request<'a>(cameras: &'a [RoughCamera]) -> PlanRequest<'a> {
    PlanRequest {
        arm: &ARM,
        cameras,
        recorded: None,
        calibrated: None,
        start: None,
        count: 6,
        table: true,
        seen_only: false,
        speed: Speed::new(ARM.joints(), 0.2, 0.05),
        rest_s: 3.0,
        seed: 1,
    }
}

/// What is planned for [`camera`].
pub static PLAN: LazyLock<Plan> = LazyLock::new(|| plan_next(&request(&[camera()])));
