//! One view of the arm as a state has it.

use crate::arm::{ArmModel, Posture};
use crate::silhouette::Silhouette;
use crate::unknowns::{FIRST_JOINT, FIRST_LENGTH, State, Unknowns};
use eyebolt_geometry::PinholeCamera;
use eyebolt_render::Raster;
use nalgebra::{Point3, Vector3};

/// The arm as a state has it: in one of its postures, with each joint where it stands in truth.
#[derive(Clone, Copy)]
pub(crate) struct PosedArm<'a> {
    pub arm: &'a ArmModel,
    /// Moved by the offsets of `state`.
    pub posture: &'a Posture,
    pub state: &'a State,
}

/// What evidence is gathered from: the posed arm and what was seen of it.
#[derive(Clone, Copy)]
pub(crate) struct PosedView<'a> {
    pub posed: PosedArm<'a>,
    pub camera: &'a PinholeCamera,
    /// Points seen well inside the arm's outline, camera frame, metres.
    pub arm_points: &'a [Point3<f32>],
    /// How many pixels each of them stands for.
    pub pixels_per_point: f64,
    pub silhouette: &'a Silhouette,
    /// The posed arm, drawn; `None` for kinds of evidence that do without.
    pub raster: Option<&'a Raster>,
}

impl PosedArm<'_> {
    /// Sets the derivatives of `gradient . point` by the offsets of the joints that move `link`, which
    /// the point is on, and of the lengths before them; both in the base frame.
    pub fn by_joints(
        &self,
        link: usize,
        gradient: &Vector3<f64>,
        point: &Point3<f64>,
        jacobian: &mut Unknowns,
    ) {
        for (place, joint, axis) in self.posture.joints_with_axes(self.arm) {
            let turns = joint.turns(link);
            if turns != 0.0 {
                jacobian[FIRST_JOINT + place] = turns * axis.derivative(gradient, point);
            }
            if joint.carries[link] {
                jacobian[FIRST_LENGTH + place] = gradient.dot(&self.posture.lengthenings()[place]);
            }
        }
    }
}

/// Derivative of `gradient . point` when the base moves the point along with itself.
pub(crate) fn moved_by_base(
    gradient: &Vector3<f64>,
    point: &Vector3<f64>,
    origin: &Vector3<f64>,
) -> [f64; 6] {
    let turn = (point - origin).cross(gradient);
    [gradient.x, gradient.y, gradient.z, turn.x, turn.y, turn.z]
}
