//! Refinement where only poses are left of the pictures.

use super::poses::{HandEye, PosePair};
use eyebolt_geometry::{CoordinateFrame, Tangent};
use nalgebra::{Matrix3, Point3, SMatrix, SVector, Vector3};

/// Distances within this many standard deviations count nearly in full.
const ROBUST_SIGMAS: f64 = 5.0;
const LEAST_SIGMA_M: f64 = 1e-6;
/// Median of a three-dimensional normal distribution's length, in standard deviations of a coordinate.
const MEDIAN: f64 = 1.538;
const STEPS: usize = 60;
const SETTLED: f64 = 1e-10;

/// The answer near `start` with the least distance of points of the marker, `radius_m` from its origin and at
/// it, from where the poses have them, by Geman and McClure's weights.
///
/// [`refine`](super::refine) does better, since it knows in which directions a pose from a picture is exact. A
/// larger radius listens more to rotations. `None` if the poses do not determine the answer.
pub fn refine_poses<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    pairs: &[PosePair<Root, Carrier>],
    start: &HandEye<Root, Carrier>,
    radius_m: f64,
) -> Option<HandEye<Root, Carrier>> {
    let mut answer = *start;
    for _ in 0..STEPS {
        let robust_m = ROBUST_SIGMAS * sigma_m(&answer, pairs, radius_m)?;
        let (mut normal, mut gradient) =
            (SMatrix::<f64, 12, 12>::zeros(), SVector::<f64, 12>::zeros());
        for pair in pairs {
            for point in points(radius_m) {
                let (residual, jacobian) = residual(&answer, pair, &point);
                let relative = residual.norm_squared() / (robust_m * robust_m);
                let weight = (1.0 + relative).powi(-2);
                normal += jacobian.transpose() * jacobian * weight;
                gradient += jacobian.transpose() * residual * weight;
            }
        }
        let step = normal.cholesky()?.solve(&-gradient);
        let half = |row: usize| -> Tangent { step.fixed_rows::<6>(row).into_owned() };
        answer = HandEye {
            camera_from_root: answer.camera_from_root.retract(&half(0)),
            carrier_from_marker: answer.carrier_from_marker.retract(&half(6)),
        };
        if step.norm() < SETTLED {
            break;
        }
    }
    let finite = answer.camera_from_root.matrix().iter().all(|value| value.is_finite());
    finite.then_some(answer)
}

/// The origin, and points around it.
fn points(radius_m: f64) -> [Point3<f64>; 4] {
    let axes = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    axes.map(|axis| Point3::from(axis * radius_m))
}

/// How far a point is from where the picture has it, and how that changes.
fn residual<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    answer: &HandEye<Root, Carrier>,
    pair: &PosePair<Root, Carrier>,
    point: &Point3<f64>,
) -> (Vector3<f64>, SMatrix<f64, 3, 12>) {
    let camera_from_carrier = answer.camera_from_root * pair.root_from_carrier;
    let by_carrier = camera_from_carrier.rotation().to_rotation_matrix().into_inner();
    let turned = answer.carrier_from_marker.direction(&point.coords);
    let in_carrier = Point3::from(turned + answer.carrier_from_marker.translation_m());
    let in_camera = camera_from_carrier.point(&in_carrier);
    let about_root = in_camera.coords - answer.camera_from_root.translation_m();
    let mut jacobian = SMatrix::<f64, 3, 12>::zeros();
    jacobian.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity());
    jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&-about_root.cross_matrix());
    jacobian.fixed_view_mut::<3, 3>(0, 6).copy_from(&by_carrier);
    jacobian.fixed_view_mut::<3, 3>(0, 9).copy_from(&(by_carrier * -turned.cross_matrix()));
    (in_camera - pair.camera_from_marker.point(point), jacobian)
}

/// Standard deviation of a coordinate, metres; `None` without poses.
fn sigma_m<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    answer: &HandEye<Root, Carrier>,
    pairs: &[PosePair<Root, Carrier>],
    radius_m: f64,
) -> Option<f64> {
    let each = pairs
        .iter()
        .flat_map(|pair| points(radius_m).map(|point| residual(answer, pair, &point).0.norm()));
    let mut sizes: Vec<f64> = each.collect();
    sizes.sort_by(f64::total_cmp);
    Some((*sizes.get(sizes.len() / 2)? / MEDIAN).max(LEAST_SIGMA_M))
}
