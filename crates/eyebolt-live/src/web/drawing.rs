//! The arm as the last answer has it, drawn as the camera sees it.

use eyebolt::plan::MovableArm;
use eyebolt::report::OutlinePixels;
use eyebolt_geometry::PinholeCamera;
use eyebolt_registration::Start;
use eyebolt_render::Raster;
use eyebolt_robot::JointPositions;
use std::sync::Arc;

/// The arm as the last answer has it, drawn as the camera sees it.
#[derive(Clone)]
pub(super) struct Drawing {
    arm: Arc<MovableArm>,
    /// Of the images as they come.
    camera: PinholeCamera,
    /// Of the images as they are shown: coarser.
    shown: PinholeCamera,
    at: Start,
    ghost: Option<Arc<Silhouette>>,
}

/// What an arm covers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Silhouette {
    /// Row-major pixels of it.
    pub(super) inside: Vec<usize>,
    /// Where it ends.
    pub(super) outline: OutlinePixels,
}

/// Pictures have no more columns.
const MOST_COLUMNS: u32 = 900;

/// By how much pictures of this width are made coarser.
pub(super) fn coarser(width: u32) -> u32 {
    width.div_ceil(MOST_COLUMNS).max(1)
}

impl Drawing {
    /// Of `arm` as `camera`, where it is, sees it.
    pub(super) fn new(arm: Arc<MovableArm>, camera: &PinholeCamera, at: Start) -> Self {
        let shown = camera.scaled(coarser(camera.width())).unwrap_or_else(|_| camera.clone());
        Self { arm, camera: camera.clone(), shown, at, ghost: None }
    }

    /// With what the arm would cover with its joints at `joints`.
    pub(super) fn with_ghost(self, joints: &JointPositions) -> Self {
        let ghost = self.silhouette(joints).map(Arc::new);
        Self { ghost, ..self }
    }

    /// Whether images of this size are of its camera.
    pub(super) fn fits(&self, (width, height): (u32, u32)) -> bool {
        (self.camera.width(), self.camera.height()) == (width, height)
    }

    /// What the arm would cover in the next configuration.
    pub(super) fn ghost(&self) -> Option<&Silhouette> {
        self.ghost.as_deref()
    }

    /// What the arm covers with its joints at `joints`; `None` if one is missing.
    pub(super) fn silhouette(&self, joints: &JointPositions) -> Option<Silhouette> {
        let model = self.arm.model();
        let posture = self.arm.posture_at(joints)?.moved(model, &self.at.joint_offsets);
        let mut raster = Raster::new(&self.shown);
        raster.draw(&self.shown, &posture.meshes(model, &self.at.camera_from_base));
        let outline = OutlinePixels::of(&raster, &self.shown);
        Some(Silhouette { inside: raster.pixels().collect(), outline })
    }
}
