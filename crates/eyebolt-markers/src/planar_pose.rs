//! Poses of flat things from their points in a picture.

use crate::frames::Marker;
use crate::homography::Homography;
use crate::sighting::Correspondence;
use eyebolt_geometry::{Camera, PinholeCamera, Tangent, Transform};
use nalgebra::{
    Matrix2, Matrix2x3, Matrix3, Matrix6, Point2, Point3, Rotation3, UnitQuaternion, Vector2,
    Vector3,
};

/// Points whose spread across the plane that they should lie in is larger than this share of the
/// spread along it are not flat.
const FLAT: f64 = 1e-6;
/// Steps of a refinement.
const STEPS: usize = 50;

/// A pose of a marker, and how well it fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerPose {
    /// The pose.
    pub camera_from_marker: Transform<Camera, Marker>,
    /// Root mean square distance of the points seen from where this pose has them, pixels.
    pub rms_px: f64,
}

/// The poses of a flat marker that its points allow: the best first, and the other one that a flat thing
/// seen from afar always has, if it is another. Empty if the points do not determine a pose.
///
/// Starts from both solutions of Collins and Bartoli ("Infinitesimal plane-based pose estimation",
/// International Journal of Computer Vision 2014); each is refined by Levenberg and Marquardt's method. The
/// points lie in the marker's plane z = 0.
pub fn planar_poses(points: &[Correspondence], camera: &PinholeCamera) -> Vec<MarkerPose> {
    let starts = starts(points, camera).unwrap_or_default();
    let mut poses: Vec<MarkerPose> =
        starts.into_iter().filter_map(|start| refined(start, points, camera)).collect();
    poses.sort_by(|a, b| a.rms_px.total_cmp(&b.rms_px));
    if let [first, second] = poses.as_slice() {
        let (metres, radians) = first.camera_from_marker.distance_to(&second.camera_from_marker);
        if radians < 1e-3 && metres < 1e-3 * first.camera_from_marker.translation_m().norm() {
            poses.truncate(1);
        }
    }
    poses
}

/// Both solutions from the homography of the plane.
fn starts(
    points: &[Correspondence],
    camera: &PinholeCamera,
) -> Option<Vec<Transform<Camera, Marker>>> {
    let mean =
        points.iter().map(|p| p.point_in_marker.coords).sum::<Vector3<f64>>() / points.len() as f64;
    let spread =
        points.iter().map(|p| (p.point_in_marker.coords - mean).norm()).fold(0.0, f64::max);
    let flat = points.iter().all(|p| p.point_in_marker.z.abs() <= FLAT * spread);
    if !flat {
        return None;
    }
    let pair = |p: &Correspondence| {
        let in_plane = Point2::from(p.point_in_marker.coords.xy() - mean.xy());
        Some((in_plane, Point2::from(camera.ray(&p.pixel)?.xy())))
    };
    let pairs: Vec<_> = points.iter().map(pair).collect::<Option<_>>()?;
    let h = Homography::fit(&pairs)?.0;
    let h = h / h[(2, 2)];
    let pose = |rotation: Matrix3<f64>| {
        let rotation =
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation));
        let translation_m = translation(&pairs, &rotation)?;
        let about_mean = Transform::<Camera, Marker>::from_parts(translation_m, rotation);
        let to_mean = Transform::<Marker, Marker>::from_parts(-mean, UnitQuaternion::identity());
        Some(about_mean * to_mean)
    };
    Some(rotations(&h)?.into_iter().filter_map(pose).collect())
}

/// The two rotations for a homography `h` with a last entry of 1, of a plane about its origin.
fn rotations(h: &Matrix3<f64>) -> Option<[Matrix3<f64>; 2]> {
    let v = Vector2::new(h[(0, 2)], h[(1, 2)]);
    // How the image of the origin moves with the point.
    let jacobian = Matrix2::new(
        h[(0, 0)] - h[(2, 0)] * v.x,
        h[(0, 1)] - h[(2, 1)] * v.x,
        h[(1, 0)] - h[(2, 0)] * v.y,
        h[(1, 1)] - h[(2, 1)] * v.y,
    );
    let ray = Vector3::new(v.x, v.y, 1.0);
    let to_ray = Rotation3::rotation_between(&Vector3::z(), &ray)?;
    let across = Matrix2x3::new(1.0, 0.0, -v.x, 0.0, 1.0, -v.y) * to_ray.matrix();
    let a = across.fixed_view::<2, 2>(0, 0).try_inverse()? * jacobian;
    let largest = a.svd(false, false).singular_values.max();
    let a = a / largest;
    if !a.iter().all(|v| v.is_finite()) {
        return None;
    }
    let rest = Matrix2::identity() - a.transpose() * a;
    let sign = if rest[(0, 1)] < 0.0 { -1.0 } else { 1.0 };
    let below = Vector2::new(rest[(0, 0)].max(0.0).sqrt(), sign * rest[(1, 1)].max(0.0).sqrt());
    let rotation = |below: Vector2<f64>| {
        let x = Vector3::new(a[(0, 0)], a[(1, 0)], below.x);
        let y = Vector3::new(a[(0, 1)], a[(1, 1)], below.y);
        to_ray.matrix() * Matrix3::from_columns(&[x, y, x.cross(&y)])
    };
    Some([rotation(below), rotation(-below)].map(|r| nearest_rotation(&r).unwrap_or(r)))
}

fn nearest_rotation(matrix: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let svd = matrix.svd(true, true);
    Some(svd.u? * svd.v_t?)
}

/// The translation with which points of the plane, turned by `rotation`, are seen where they are best.
fn translation(
    pairs: &[(Point2<f64>, Point2<f64>)],
    rotation: &UnitQuaternion<f64>,
) -> Option<Vector3<f64>> {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (in_plane, seen) in pairs {
        let turned = rotation * Vector3::new(in_plane.x, in_plane.y, 0.0);
        let rows = Matrix2x3::new(1.0, 0.0, -seen.x, 0.0, 1.0, -seen.y);
        let off = seen.coords * turned.z - turned.xy();
        normal += rows.transpose() * rows;
        right += rows.transpose() * off;
    }
    let translation = normal.try_inverse()? * right;
    (translation.z > 0.0).then_some(translation)
}

/// `start` moved to where the squares of the distances in the picture are least.
fn refined(
    start: Transform<Camera, Marker>,
    points: &[Correspondence],
    camera: &PinholeCamera,
) -> Option<MarkerPose> {
    let mut pose = start;
    let (mut normal, mut gradient, mut cost) = system(&pose, points, camera)?;
    let mut damping = 1e-6;
    for _ in 0..STEPS {
        let mut damped = normal;
        for i in 0..6 {
            damped[(i, i)] *= 1.0 + damping;
        }
        let step = damped.cholesky()?.solve(&-gradient);
        let next = pose.retract(&step);
        match system(&next, points, camera) {
            Some((n, g, c)) if c <= cost => {
                let settled = step.norm() < 1e-12 || cost - c <= 1e-14 * cost;
                (pose, normal, gradient, cost) = (next, n, g, c);
                damping = (0.1 * damping).max(1e-12);
                if settled {
                    break;
                }
            }
            _ => damping *= 10.0,
        }
        if damping > 1e10 {
            break;
        }
    }
    Some(MarkerPose { camera_from_marker: pose, rms_px: (cost / points.len() as f64).sqrt() })
}

/// Gauss and Newton's matrix, the gradient and the sum of squares; `None` if a point is not in view.
fn system(
    pose: &Transform<Camera, Marker>,
    points: &[Correspondence],
    camera: &PinholeCamera,
) -> Option<(Matrix6<f64>, Tangent, f64)> {
    let (mut normal, mut gradient, mut cost) = (Matrix6::zeros(), Tangent::zeros(), 0.0);
    for point in points {
        let turned = pose.direction(&point.point_in_marker.coords);
        let in_camera = Point3::from(turned + pose.translation_m());
        let (pixel, by_point) = camera.project_with_jacobian(&in_camera)?;
        let mut jacobian = nalgebra::Matrix2x6::zeros();
        jacobian.fixed_view_mut::<2, 3>(0, 0).copy_from(&by_point);
        jacobian.fixed_view_mut::<2, 3>(0, 3).copy_from(&(by_point * -turned.cross_matrix()));
        let residual = pixel - point.pixel;
        normal += jacobian.transpose() * jacobian;
        gradient += jacobian.transpose() * residual;
        cost += residual.norm_squared();
    }
    cost.is_finite().then_some((normal, gradient, cost))
}
