//! What each pixel really sees: labels that nobody has to make.

use super::plan::Plan;
use eyebolt_render::IdealView;

/// What an ideal camera sees of one configuration, and of what.
#[derive(Clone, Debug, PartialEq)]
pub struct TrueView {
    /// Depth, normal and mesh of each pixel.
    pub view: IdealView,
    /// Of each pixel: [`Self::BACKGROUND`], [`Self::ARM`] or [`Self::END_EFFECTOR`], as in the
    /// paper.
    pub label: Vec<u8>,
    /// Of each pixel: index of the link in [`eyebolt_robot::Robot::links`]; `None` where none is seen.
    pub link: Vec<Option<usize>>,
}

impl TrueView {
    /// Nothing, or something that is not the robot.
    pub const BACKGROUND: u8 = 0;
    /// The robot without its end-effector.
    pub const ARM: u8 = 1;
    /// The end-effector and every link below it.
    pub const END_EFFECTOR: u8 = 2;
}

impl Plan<'_> {
    /// What the camera, before it is bumped, would see of configuration `index` if it were ideal.
    ///
    /// # Panics
    ///
    /// If there is no such configuration.
    pub fn true_view(&self, index: usize) -> TrueView {
        let arm = self.body.scene_meshes(&self.poses[index].posture);
        let scene = self.scene(&arm, &self.poses[index].joints, index);
        let view = scene.view(&self.camera, &self.base_from_camera);
        let seen = view.surface.iter().map(|surface| usize::from(*surface));
        let label = seen.clone().map(|surface| match self.body.is_end_effector.get(surface) {
            None => TrueView::BACKGROUND,
            Some(false) => TrueView::ARM,
            Some(true) => TrueView::END_EFFECTOR,
        });
        let link = seen.map(|surface| (surface < arm.len()).then(|| self.body.links[surface]));
        TrueView { label: label.collect(), link: link.collect(), view }
    }
}
