//! A marker on a plate that the hand holds, which changes the hand's shape as it does on a real arm.

use super::solids::Solid;
use eyebolt_geometry::{Base, EndEffector, Link, Transform};
use eyebolt_markers::{Layout, Marker, Target};
use eyebolt_render::SceneMesh;
use eyebolt_robot::{Body, Shape, TriangleMesh};
use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

/// Thickness of the plate, and the way from the hand to it, metres.
const THICK_M: f64 = 0.004;
const STANDOFF_M: f64 = 0.012;

/// A plate with a marker on it.
#[derive(Clone, Debug)]
pub struct Plate {
    pub(super) target: Target,
    pub(super) end_effector_from_marker: Transform<EndEffector, Marker>,
    /// In the end-effector's frame.
    mesh: TriangleMesh,
}

impl Plate {
    /// On the side of a hand, whose box is `low` to `high`, that `axis` and `sign` say.
    pub(super) fn on(
        target: &Target,
        (low, high): (Point3<f64>, Point3<f64>),
        axis: usize,
        sign: f64,
    ) -> Self {
        let mut outward = Vector3::zeros();
        outward[axis] = sign;
        let middle = nalgebra::center(&low, &high).coords;
        let half = 0.5 * (high - low)[axis];
        let at = middle + outward * (half + STANDOFF_M);
        // The marker's z goes into the plate.
        let mut right = Vector3::zeros();
        right[(axis + 1) % 3] = 1.0;
        let axes = Matrix3::from_columns(&[right, (-outward).cross(&right), -outward]);
        let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        let (wide, high_m) = target.size_m();
        let to_origin = match target.layout() {
            Layout::Tag { .. } => Vector3::zeros(),
            _ => Vector3::new(-0.5 * wide, -0.5 * high_m, 0.0),
        };
        let margin = 2.0 * target.margin_m();
        let size = [wide + margin, high_m + margin, THICK_M];
        let body = Body {
            link_from_body: Transform::<Link, Link>::from_parts(
                at - outward * (0.5 * THICK_M),
                turn,
            ),
            shape: Shape::Box { size },
        };
        Self {
            target: target.clone(),
            end_effector_from_marker: Transform::from_parts(at + turn * to_origin, turn),
            mesh: Solid::new("plate", &[body]).mesh,
        }
    }

    /// Where it is with the hand at a pose.
    pub(super) fn at(
        &self,
        base_from_end_effector: &Transform<Base, EndEffector>,
    ) -> SceneMesh<'_> {
        let base_from_mesh = Transform::from_isometry(*base_from_end_effector.isometry());
        SceneMesh { mesh: &self.mesh, base_from_mesh }
    }

    /// Corners of the target, end-effector frame.
    pub(super) fn corners(&self) -> [Point3<f64>; 4] {
        let (wide, high) = self.target.size_m();
        let (left, top) = match self.target.layout() {
            Layout::Tag { .. } => (-0.5 * wide, -0.5 * high),
            _ => (0.0, 0.0),
        };
        let corner = |x: f64, y: f64| {
            self.end_effector_from_marker.point(&Point3::new(left + x * wide, top + y * high, 0.0))
        };
        [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)]
    }
}
