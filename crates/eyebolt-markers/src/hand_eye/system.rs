//! Residuals, and their sums for a Gauss-Newton step.

use super::poses::{HandEye, View};
use eyebolt_geometry::{CoordinateFrame, PinholeCamera, Tangent};
use nalgebra::{Matrix2x3, Point3, SMatrix, SVector, Vector2};

/// `camera_from_root` and `carrier_from_marker` as [`Transform::retract`] moves them, then the logarithm of
/// how many times as large as described the marker is.
///
/// [`Transform::retract`]: eyebolt_geometry::Transform::retract
pub(super) const UNKNOWNS: usize = 13;
pub(super) type Unknowns = SVector<f64, UNKNOWNS>;
pub(super) type Information = SMatrix<f64, UNKNOWNS, UNKNOWNS>;

/// Printers scale what they print to fit the page, by about a percent.
const SIZE_SIGMA: f64 = 0.01;

/// A value of the unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct State<Root: CoordinateFrame, Carrier: CoordinateFrame> {
    pub hand_eye: HandEye<Root, Carrier>,
    pub log_size: f64,
}

impl<Root: CoordinateFrame, Carrier: CoordinateFrame> State<Root, Carrier> {
    pub fn moved(&self, by: &Unknowns) -> Self {
        let tangent = |row: usize| -> Tangent { by.fixed_rows::<6>(row).into_owned() };
        Self {
            hand_eye: HandEye {
                camera_from_root: self.hand_eye.camera_from_root.retract(&tangent(0)),
                carrier_from_marker: self.hand_eye.carrier_from_marker.retract(&tangent(6)),
            },
            log_size: self.log_size + by[12],
        }
    }
}

/// How much residuals count: ARCHITECTURE.md, (1) and (5).
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Standard deviation of a coordinate, pixels.
    pub sigma_px: f64,
    /// Beyond this a point counts less and less, pixels.
    pub robust_px: f64,
}

/// What the points of a view sum up to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sums {
    pub information: Information,
    pub gradient: Unknowns,
    pub cost: f64,
}

impl Sums {
    pub fn none() -> Self {
        Self { information: Information::zeros(), gradient: Unknowns::zeros(), cost: 0.0 }
    }

    /// What is known of the marker's size before anything is seen.
    pub fn prior(log_size: f64) -> Self {
        let mut sums = Self::none();
        let weight = SIZE_SIGMA.powi(-2);
        sums.information[(12, 12)] = weight;
        sums.gradient[12] = weight * log_size;
        sums.cost = 0.5 * weight * log_size * log_size;
        sums
    }

    pub fn add(&mut self, other: &Self) {
        self.information += other.information;
        self.gradient += other.gradient;
        self.cost += other.cost;
    }
}

/// How far each point is seen from where `state` has it, pixels; `None` for one that the camera cannot see
/// there.
pub(super) fn residuals<'a, Root: CoordinateFrame, Carrier: CoordinateFrame>(
    state: &State<Root, Carrier>,
    view: &'a View<Root, Carrier>,
    camera: &'a PinholeCamera,
) -> impl Iterator<Item = Option<Vector2<f64>>> + 'a {
    let pose = state.hand_eye.camera_from_marker(&view.root_from_carrier);
    let size = state.log_size.exp();
    view.points.iter().map(move |point| {
        let in_marker = Point3::from(point.point_in_marker.coords * size);
        Some(camera.project(&pose.point(&in_marker))? - point.pixel)
    })
}

/// The sums of one view.
pub(super) fn sums<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    state: &State<Root, Carrier>,
    view: &View<Root, Carrier>,
    camera: &PinholeCamera,
    scale: &Scale,
) -> Sums {
    let HandEye { camera_from_root, carrier_from_marker } = &state.hand_eye;
    let camera_from_carrier = *camera_from_root * view.root_from_carrier;
    let by_carrier = camera_from_carrier.rotation().to_rotation_matrix().into_inner();
    let size = state.log_size.exp();
    let worth = scale.sigma_px.powi(-2);
    let most = 0.5 * worth * scale.robust_px * scale.robust_px;
    let mut sums = Sums::none();
    for point in &view.points {
        // About the marker's origin, along the carrier's axes.
        let turned = carrier_from_marker.direction(&(point.point_in_marker.coords * size));
        let in_carrier = Point3::from(turned + carrier_from_marker.translation_m());
        let in_camera = camera_from_carrier.point(&in_carrier);
        let Some((pixel, by_point)) = camera.project_with_jacobian(&in_camera) else {
            sums.cost += most;
            continue;
        };
        let about_root = in_camera.coords - camera_from_root.translation_m();
        let by_mount: Matrix2x3<f64> = by_point * by_carrier;
        let mut jacobian = SMatrix::<f64, 2, UNKNOWNS>::zeros();
        jacobian.fixed_view_mut::<2, 3>(0, 0).copy_from(&by_point);
        jacobian.fixed_view_mut::<2, 3>(0, 3).copy_from(&(by_point * -about_root.cross_matrix()));
        jacobian.fixed_view_mut::<2, 3>(0, 6).copy_from(&by_mount);
        jacobian.fixed_view_mut::<2, 3>(0, 9).copy_from(&(by_mount * -turned.cross_matrix()));
        jacobian.fixed_view_mut::<2, 1>(0, 12).copy_from(&(by_mount * turned));
        let residual = pixel - point.pixel;
        let relative = residual.norm_squared() / (scale.robust_px * scale.robust_px);
        let weight = worth / ((1.0 + relative) * (1.0 + relative));
        sums.information += jacobian.transpose() * jacobian * weight;
        sums.gradient += jacobian.transpose() * residual * weight;
        sums.cost += most * relative / (1.0 + relative);
    }
    sums
}

/// The sums of all views, and what is known before.
pub(super) fn total<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    state: &State<Root, Carrier>,
    views: &[View<Root, Carrier>],
    camera: &PinholeCamera,
    scale: &Scale,
) -> Sums {
    let mut total = Sums::prior(state.log_size);
    views.iter().for_each(|view| total.add(&sums(state, view, camera, scale)));
    total
}

/// The factors of `information` with its diagonal enlarged; `None` if something is not determined.
pub(super) fn damped(
    information: &Information,
    damping: f64,
) -> Option<nalgebra::Cholesky<f64, nalgebra::Const<13>>> {
    let mut damped = *information;
    for i in 0..damped.nrows() {
        damped[(i, i)] *= 1.0 + damping;
    }
    damped.cholesky()
}
