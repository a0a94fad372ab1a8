//! Which side of the hand a marker goes to.

use super::dress::bounds;
use super::plan::Plan;
use super::plate::Plate;
use eyebolt_geometry::{EndEffector, Transform};
use eyebolt_markers::{Marker, Target};
use nalgebra::{Point3, Vector3};

/// Half the size of a hand without a shape, metres.
const NO_SHAPE_M: f64 = 0.03;
/// Seen flatter than this, nobody decodes it: cosine of the angle off square.
const LEAST_COSINE: f64 = 0.5;
/// How far within the picture it has to be, pixels.
const WITHIN_PX: f64 = 8.0;
/// A point is seen if nothing is nearer to the camera by more than this, metres.
const SAME_M: f64 = 0.003;

impl Plan<'_> {
    /// The same with a plate on the hand that has `target` on it: on that side of it which the camera sees in
    /// most configurations. A tag of any number becomes number 0.
    #[must_use]
    pub fn with_marker(mut self, target: &Target) -> Self {
        let target = target.with_id(0);
        let arm = &self.body.arm;
        let hand = bounds(arm.robot(), arm.end_effector());
        let corner = Point3::new(NO_SHAPE_M, NO_SHAPE_M, NO_SHAPE_M);
        let hand = hand.unwrap_or((-corner, corner));
        let sides = (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]);
        let mut best: Option<(usize, Plate)> = None;
        for (axis, sign) in sides {
            let plate = Plate::on(&target, hand, axis, sign);
            let seen = (0..self.poses.len()).filter(|index| self.shows(&plate, *index)).count();
            if best.as_ref().is_none_or(|(most, _)| seen > *most) {
                best = Some((seen, plate));
            }
        }
        self.plate = best.map(|(_, plate)| plate);
        self
    }

    /// Where the marker is on the hand, if it is there.
    pub fn end_effector_from_marker(&self) -> Option<Transform<EndEffector, Marker>> {
        self.plate.as_ref().map(|plate| plate.end_effector_from_marker)
    }

    /// Whether the camera sees the whole target on `plate` in a configuration.
    fn shows(&self, plate: &Plate, index: usize) -> bool {
        let joints = &self.poses[index].joints;
        let Ok(hand) = self.body.arm.base_from_end_effector(joints) else { return false };
        let base_from_camera = self.pose_at(index);
        let eye = base_from_camera.point(&Point3::origin());
        let outward = hand.direction(&plate.end_effector_from_marker.direction(&-Vector3::z()));
        let scene = self.scene_with(joints, index);
        let is_seen = |corner: &Point3<f64>| {
            let at = hand.point(corner);
            let way = at - eye;
            let pixel = self.camera.project(&base_from_camera.inverse().point(&at));
            let inside = pixel.is_some_and(|p| {
                p.x > WITHIN_PX
                    && p.y > WITHIN_PX
                    && p.x < f64::from(self.camera.width()) - WITHIN_PX
                    && p.y < f64::from(self.camera.height()) - WITHIN_PX
            });
            let square = -way.normalize().dot(&outward) >= LEAST_COSINE;
            let hit = scene.nearest(&eye, &way);
            inside && square && hit.is_none_or(|hit| hit.distance_m >= way.norm() - SAME_M)
        };
        let corners = plate.corners();
        let middle = nalgebra::center(&corners[0], &corners[2]);
        corners.iter().chain([&middle]).all(is_seen)
    }
}
