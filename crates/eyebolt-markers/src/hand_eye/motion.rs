//! Motions between two poses: what closed-form solvers are fed.

use super::poses::PosePair;
use eyebolt_geometry::{CoordinateFrame, rotation_log};
use nalgebra::{Isometry3, Matrix3, SymmetricEigen, Vector3};

/// How the marker and the carrier moved between two poses: `camera * camera_from_root = camera_from_root *
/// root`, in the literature's words AX = XB.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub camera: Isometry3<f64>,
    pub root: Isometry3<f64>,
    /// How far it is to be trusted, at most 1.
    pub weight: f64,
}

/// Turned by more than this, it is not sure which way around: noise turns the axis about.
const LARGEST_RAD: f64 = 3.05;
/// The motions' axes have to differ: the root mean square of the rotation about all axes but the main one.
pub(super) const SPREAD_RAD: f64 = 0.02;

/// Motions whose two angles differ by this many times as much as usual count a quarter.
const INCONGRUENT: f64 = 2.0;
/// No angle is known better, radians.
const LEAST_RAD: f64 = 1e-9;

/// The motions between any two poses.
///
/// Whatever the unknown is, marker and robot turn by the same angle (the screw congruence). What differs there
/// has a pose with a large error in it, and counts less (Geman and McClure's weights): of flat markers, most poses
/// are good and some are bad.
pub(super) fn motions<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    pairs: &[PosePair<Root, Carrier>],
) -> Vec<Motion> {
    let between = |a: &PosePair<Root, Carrier>, b: &PosePair<Root, Carrier>| Motion {
        camera: b.camera_from_marker.isometry() * a.camera_from_marker.inverse().isometry(),
        root: b.root_from_carrier.isometry() * a.root_from_carrier.inverse().isometry(),
        weight: 1.0,
    };
    let each = pairs.iter().enumerate();
    let all: Vec<Motion> =
        each.flat_map(|(i, a)| pairs.iter().skip(i + 1).map(move |b| between(a, b))).collect();
    let sure = |m: &&Motion| {
        m.root.rotation.angle() <= LARGEST_RAD && m.camera.rotation.angle() <= LARGEST_RAD
    };
    let few: Vec<Motion> = all.iter().filter(sure).copied().collect();
    weighted(if spread_rad(&few) >= SPREAD_RAD { few } else { all })
}

/// `motions` with their weights.
fn weighted(mut motions: Vec<Motion>) -> Vec<Motion> {
    let off = |m: &Motion| (m.root.rotation.angle() - m.camera.rotation.angle()).abs();
    let mut sizes: Vec<f64> = motions.iter().map(off).collect();
    sizes.sort_by(f64::total_cmp);
    let middle = sizes.get(sizes.len() / 2).copied().unwrap_or_default();
    let usual = INCONGRUENT * middle.max(LEAST_RAD);
    for motion in &mut motions {
        motion.weight = (1.0 + (off(motion) / usual).powi(2)).powi(-2);
    }
    motions
}

/// Root mean square of the robot's rotation about the axes that it turned about least; with none, the
/// translation along the main axis is open.
pub(super) fn spread_rad(motions: &[Motion]) -> f64 {
    let axes = motions.iter().map(|m| rotation_log(&m.root.rotation));
    let moment: Matrix3<f64> = axes.map(|v: Vector3<f64>| v * v.transpose()).sum();
    let mean = moment / motions.len().max(1) as f64;
    let mut values: Vec<f64> = SymmetricEigen::new(mean).eigenvalues.iter().copied().collect();
    values.sort_by(f64::total_cmp);
    // Two axes are enough; the third follows.
    values.get(1).map_or(0.0, |v| v.max(0.0).sqrt())
}

/// The translation of `camera_from_root` that fits `motions` best, of the given rotation, metres.
pub(super) fn translation_m(motions: &[Motion], rotation: &Matrix3<f64>) -> Option<Vector3<f64>> {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for motion in motions {
        let rows = motion.camera.rotation.to_rotation_matrix().into_inner() - Matrix3::identity();
        let off = rotation * motion.root.translation.vector - motion.camera.translation.vector;
        normal += rows.transpose() * rows * motion.weight;
        right += rows.transpose() * off * motion.weight;
    }
    let translation = normal.cholesky()?.solve(&right);
    translation.iter().all(|v| v.is_finite()).then_some(translation)
}
