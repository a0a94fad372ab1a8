//! What a view that nobody has taken yet would say of the pose: the information of (6), with the noise that is to be
//! expected.

use super::start::Start;
use crate::arm::{ArmModel, Posture};
use crate::evidence::{KINDS, PosedArm, Spot, outline_jacobian, surface_jacobian};
use crate::unknowns::{
    EVIDENCE_KINDS, FIRST_LENGTH, FIRST_NUISANCE, OUTLINES, SURFACES, State, Unknowns,
};
use eyebolt_geometry::PinholeCamera;
use eyebolt_render::{Raster, outer_contour};
use nalgebra::{Point2, Point3, SMatrix};

/// Unknowns that predicted views tell of: shift of the pose, translation (m) and rotation (rad) as
/// [`retract`](eyebolt_geometry::Transform::retract) has them; the nuisance parameter of each kind of evidence; then the
/// offset of each joint (rad). Lengths and intrinsics are taken at their word.
pub const PREDICTED: usize = FIRST_LENGTH;

/// Information about the [`PREDICTED`] unknowns.
pub type PredictedInformation = SMatrix<f64, PREDICTED, PREDICTED>;

/// What is expected to be off, by kind of evidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedNoise {
    /// Standard deviation of single residuals as (5) has it, in the kind's unit; of surfaces, of those near by.
    pub deviations: [f64; EVIDENCE_KINDS],
    /// What is added to it by distance, of surfaces and of links by their surface: this times the squared depth in metres, as
    /// triangulation has it (1/m).
    pub by_squared_depth: f64,
    /// How far a link in a view seems to be off as a whole, along each axis, metres: errors of shape, of joints and of depth
    /// there, which the sandwich (8) finds afterwards.
    pub of_link_m: [f64; EVIDENCE_KINDS],
    /// Of a view's own nuisance parameter about that of all views: depth that is longer here than there.
    pub of_view: [f64; EVIDENCE_KINDS],
}

impl Default for ExpectedNoise {
    fn default() -> Self {
        Self {
            deviations: [0.0015, 1.2],
            by_squared_depth: 0.0008,
            of_link_m: [0.0008, 0.0007],
            of_view: [0.002, 0.3],
        }
    }
}

impl ExpectedNoise {
    /// `deviation` of a surface near by, at `depth_m`, both metres.
    fn at(&self, deviation_m: f64, depth_m: f64) -> f64 {
        deviation_m.hypot(self.by_squared_depth * depth_m * depth_m)
    }
}

/// What one link in one view says by one kind of evidence.
#[derive(Clone, Default)]
struct Patch {
    information: PredictedInformation,
    /// Sum of the depths of its samples, metres, and how many there are.
    depths: (f64, f64),
}

impl Patch {
    fn add(&mut self, jacobian: &Unknowns, weight: f64, depth_m: f64) {
        let own = jacobian.fixed_rows::<PREDICTED>(0).into_owned();
        self.information.ger(weight, &own, &own, 1.0);
        self.depths.0 += depth_m;
        self.depths.1 += 1.0;
    }

    /// Mean depth, metres.
    fn depth_m(&self) -> f64 {
        self.depths.0 / self.depths.1.max(1.0)
    }
}

/// What remains of the information of one link in one view where that is off by a shift of its own, of this standard
/// `deviation_m` along each axis, which is profiled out: a shift of the link looks like one of the pose.
fn without_own_shift(information: &PredictedInformation, deviation_m: f64) -> PredictedInformation {
    let across = information.fixed_columns::<3>(0).into_owned();
    let mut own = information.fixed_view::<3, 3>(0, 0).into_owned();
    for axis in 0..3 {
        own[(axis, axis)] += deviation_m.powi(-2);
    }
    // With a prior it is positive definite.
    own.try_inverse().map_or(*information, |own| information - across * own * across.transpose())
}

/// What a view of the arm in `posture` is expected to say, of the links that `counts` is true of. What never moves says
/// the same in every view, and is not to be counted in each.
///
/// `raster` has the arm drawn there by `drawn`, which is `camera` in images `coarser` times as coarse, or the same.
pub fn predicted_information(
    arm: &ArmModel,
    posture: &Posture,
    (camera, drawn, coarser): (&PinholeCamera, &PinholeCamera, f64),
    raster: &Raster,
    at: &Start,
    counts: impl Fn(usize) -> bool,
    noise: &ExpectedNoise,
) -> PredictedInformation {
    let state = State::from(*at);
    let posed = PosedArm { arm, posture, state: &state };
    let mut patches = vec![<[Patch; EVIDENCE_KINDS]>::default(); arm.links().len()];
    let weight = |kind: usize, samples: f64, deviation: f64| {
        samples / KINDS[kind].correlated_samples() / deviation.powi(2)
    };
    let stride = (raster.pixels().count() / MOST_PIXELS).max(1);
    for at in raster.pixels().step_by(stride) {
        let Some((link, jacobian, z)) = surface_at(&posed, drawn, raster, at) else { continue };
        if counts(link) {
            let deviation = noise.at(noise.deviations[SURFACES], z);
            let weight = weight(SURFACES, stride as f64 * coarser * coarser, deviation);
            patches[link][SURFACES].add(&jacobian, weight, z);
        }
    }
    let of_outline = weight(OUTLINES, coarser, noise.deviations[OUTLINES]);
    for point in outer_contour(raster, drawn) {
        let link = usize::from(point.link);
        let in_camera: Point3<f64> = point.point_in_camera.cast();
        let Some((_, by_point)) = camera.project_with_jacobian(&in_camera) else { continue };
        let along = by_point.tr_mul(&point.outward.cast::<f64>());
        if counts(link) {
            let jacobian = outline_jacobian(&posed, link, &in_camera, &along);
            patches[link][OUTLINES].add(&jacobian, of_outline, in_camera.z);
        }
    }
    let mut sum = PredictedInformation::zeros();
    for kind in 0..EVIDENCE_KINDS {
        let mut of_kind = PredictedInformation::zeros();
        for link in &patches {
            let of_link_m = match kind {
                SURFACES => noise.at(noise.of_link_m[kind], link[kind].depth_m()),
                _ => noise.of_link_m[kind],
            };
            of_kind += without_own_shift(&link[kind].information, of_link_m);
        }
        sum += without_own_nuisance(of_kind, kind, noise.of_view[kind]);
    }
    sum
}

/// Pixels that are looked at of a view.
const MOST_PIXELS: usize = 400;

/// `information` of one view where its nuisance parameter is the common one and an error of its own, of this standard
/// `deviation`, that is profiled out.
fn without_own_nuisance(
    information: PredictedInformation,
    kind: usize,
    deviation: f64,
) -> PredictedInformation {
    let own = information.column(FIRST_NUISANCE + kind).into_owned();
    let weight = information[(FIRST_NUISANCE + kind, FIRST_NUISANCE + kind)] + deviation.powi(-2);
    information - own * own.transpose() / weight
}

/// The link drawn at pixel `at`, how the distance from its surface there changes, and how deep that is, metres.
fn surface_at(
    posed: &PosedArm<'_>,
    drawn: &PinholeCamera,
    raster: &Raster,
    at: usize,
) -> Option<(usize, Unknowns, f64)> {
    let (u, v) = (at % raster.width(), at / raster.width());
    let (z, link) = (raster.depth_m(at)?, usize::from(raster.link(at)?));
    let point = drawn.ray(&Point2::new(u as f64, v as f64))? * f64::from(z);
    let pose = posed.state.camera_from_base.isometry();
    let point_in_base = pose.inverse_transform_point(&Point3::from(point));
    let near =
        posed.posture.nearest_within(posed.arm, &point_in_base.cast(), f32::INFINITY, link)?;
    let normal_in_base = near.gradient_in_base.cast::<f64>();
    let normal = pose.rotation * normal_in_base;
    let spot = Spot { point, normal, point_in_base, normal_in_base };
    let jacobian = (normal.dot(&point) < 0.0).then(|| surface_jacobian(posed, near.link, &spot))?;
    Some((near.link, jacobian, f64::from(z)))
}
