//! An arm in one configuration.

use super::model::{ArmModel, MOST_JOINTS};
use super::offsets::JointAxis;
use crate::distance_field::DistanceSample;
use eyebolt_geometry::{Base, Camera, Link, Transform};
use eyebolt_render::PosedMesh;
use nalgebra::{Matrix3, Point3, Vector3};

/// An arm in one configuration: where each link of the [`ArmModel`] is in the base frame.
#[derive(Clone, Debug)]
pub struct Posture {
    base_from_link: Vec<Transform<Base, Link>>,
    placed: Vec<Placed>,
    axes: Vec<JointAxis>,
    /// Where each joint goes when the link before it grows, metres for each metre; base frame.
    lengthenings: Vec<Vector3<f64>>,
    /// Corners of a box about the spheres of all links, base frame.
    about: (Point3<f32>, Point3<f32>),
}

/// A link's pose the other way round, in single precision, with a sphere about its field.
#[derive(Clone, Copy, Debug)]
struct Placed {
    link_from_base: Matrix3<f32>,
    offset: Vector3<f32>,
    centre_in_base: Point3<f32>,
    radius_m: f32,
}

/// Corners of a box about the spheres of all links; turned inside out without any.
fn about(placed: &[Placed]) -> (Point3<f32>, Point3<f32>) {
    let mut low = Point3::from(Vector3::repeat(f32::INFINITY));
    let mut high = Point3::from(Vector3::repeat(f32::NEG_INFINITY));
    for link in placed {
        let radius = Vector3::repeat(link.radius_m);
        low = low.inf(&(link.centre_in_base - radius));
        high = high.sup(&(link.centre_in_base + radius));
    }
    (low, high)
}

/// A joint nearer than this to the one before it is of the same housing, metres.
const LONG_M: f64 = 0.05;

fn lengthening(axes: &[JointAxis], joint: usize) -> Vector3<f64> {
    let before = joint.checked_sub(1).and_then(|before| axes.get(before));
    let pair = before.zip(axes.get(joint));
    let along = pair.map(|(before, own)| own.through_in_base - before.through_in_base);
    along.filter(|along| along.norm() > LONG_M).map_or(Vector3::zeros(), |v| v.normalize())
}

/// The surface of the arm nearest to a point.
#[derive(Clone, Copy, Debug)]
pub struct NearestSurface {
    /// Which link of the [`ArmModel`].
    pub link: usize,
    /// Signed distance to it, metres.
    pub distance_m: f32,
    /// Gradient of the distance in the base frame.
    pub gradient_in_base: Vector3<f32>,
}

impl Posture {
    /// The arm with its links at `base_from_link`, one for each link of `arm`.
    pub fn new(arm: &ArmModel, base_from_link: Vec<Transform<Base, Link>>) -> Self {
        assert_eq!(arm.links().len(), base_from_link.len(), "one pose for each link");
        let placed = arm.links().iter().zip(&base_from_link).map(|(link, pose)| {
            let inverse = pose.inverse();
            let (low, high) = link.model.field.bounds();
            let centre = nalgebra::center(&low, &high);
            Placed {
                link_from_base: inverse.rotation().to_rotation_matrix().into_inner().cast(),
                offset: inverse.translation_m().cast(),
                centre_in_base: pose.point(&centre.cast()).cast(),
                radius_m: 0.5 * (high - low).norm(),
            }
        });
        let placed: Vec<Placed> = placed.collect();
        let about = about(&placed);
        Self { placed, base_from_link, axes: Vec::new(), lengthenings: Vec::new(), about }
    }

    /// The same posture, where the arm's joints have their axes at `axes`, in the order of
    /// [`ArmModel::joints`]; those beyond the first [`MOST_JOINTS`] have no use.
    #[must_use]
    pub fn with_axes(self, mut axes: Vec<JointAxis>) -> Self {
        axes.truncate(MOST_JOINTS);
        let lengthenings = (0..axes.len()).map(|joint| lengthening(&axes, joint)).collect();
        Self { axes, lengthenings, ..self }
    }

    /// Pose of each link of the model.
    pub fn base_from_link(&self) -> &[Transform<Base, Link>] {
        &self.base_from_link
    }

    /// The axes of the joints, in the order of [`ArmModel::joints`]; none unless they were given.
    pub fn axes(&self) -> &[JointAxis] {
        &self.axes
    }

    /// Where each joint goes when the link before it grows, metres for each metre; base frame.
    pub(crate) fn lengthenings(&self) -> &[Vector3<f64>] {
        &self.lengthenings
    }

    /// Signed distance from `point_in_base` (metres) to the arm.
    pub fn nearest(&self, arm: &ArmModel, point_in_base: &Point3<f32>) -> Option<NearestSurface> {
        self.nearest_within(arm, point_in_base, f32::INFINITY, 0)
    }

    /// As [`Self::nearest`], but only what is nearer than `limit_m`, which is quickly decided where
    /// there is nothing.
    ///
    /// The link `first` is looked at first, which saves time where it is the nearest one, as for
    /// most points whose neighbour was on it; the answer does not depend on it.
    pub fn nearest_within(
        &self,
        arm: &ArmModel,
        point_in_base: &Point3<f32>,
        limit_m: f32,
        first: usize,
    ) -> Option<NearestSurface> {
        if !self.is_about(point_in_base, limit_m) {
            return None;
        }
        let mut best: Option<(usize, DistanceSample)> = None;
        let mut limit_m = limit_m;
        let links = arm.links();
        let rest = (0..links.len()).filter(|link| *link != first);
        for link in (first < links.len()).then_some(first).into_iter().chain(rest) {
            let (field, placed) = (&links[link].model.field, &self.placed[link]);
            let reach = limit_m + placed.radius_m;
            // A field never says less than the distance to its own sphere.
            let apart = (point_in_base - placed.centre_in_base).norm_squared();
            if reach < 0.0 || apart > reach * reach {
                continue;
            }
            let in_link =
                Point3::from(placed.link_from_base * point_in_base.coords + placed.offset);
            let Some(sample) = field.sample_within(&in_link, limit_m) else { continue };
            // Of links equally near it is the first of the model, whichever was looked at first.
            let before = best.is_some_and(|(other, _)| link < other);
            if sample.distance_m < limit_m || (before && sample.distance_m == limit_m) {
                limit_m = sample.distance_m;
                best = Some((link, sample));
            }
        }
        let (link, sample) = best?;
        let gradient_in_base = self.placed[link].link_from_base.tr_mul(&sample.gradient);
        Some(NearestSurface { link, distance_m: sample.distance_m, gradient_in_base })
    }

    /// Whether a point is so near to the box about all links that one of them may be within `limit_m`.
    fn is_about(&self, point_in_base: &Point3<f32>, limit_m: f32) -> bool {
        let (low, high) = &self.about;
        (0..3).all(|axis| {
            let x = point_in_base[axis];
            x >= low[axis] - limit_m && x <= high[axis] + limit_m
        })
    }

    /// The links' meshes where a camera at `camera_from_base` has them.
    pub fn meshes<'a>(
        &self,
        arm: &'a ArmModel,
        camera_from_base: &Transform<Camera, Base>,
    ) -> Vec<PosedMesh<'a>> {
        let posed = arm.links().iter().zip(&self.base_from_link).enumerate();
        posed
            .map(|(index, (link, pose))| PosedMesh {
                mesh: &link.model.mesh,
                camera_from_link: *camera_from_base * *pose,
                link: index as u8,
            })
            .collect()
    }
}
