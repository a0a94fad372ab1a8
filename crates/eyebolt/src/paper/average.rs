//! Means over the frames of a configuration, then over configurations.

use super::outliers::inliers;
use eyebolt_geometry::{Base, Camera, Transform, mean_transform};

/// Where the base is by one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FramePose {
    /// Number of its arm configuration.
    pub configuration: usize,
    /// Where it has the base.
    pub camera_from_base: Transform<Camera, Base>,
}

/// What became of the poses of one configuration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// How many there were.
    pub poses: usize,
    /// How many of them are outliers among themselves.
    pub outliers: usize,
    /// The mean of the rest; `None` if there were too few.
    pub camera_from_base: Option<Transform<Camera, Base>>,
    /// Whether the mean is an outlier among those of the configurations.
    pub is_outlier: bool,
}

/// A mean over configurations.
#[derive(Clone, Debug, PartialEq)]
pub struct Averaged {
    /// The mean; `None` if no configuration has one.
    pub camera_from_base: Option<Transform<Camera, Base>>,
    /// Of each configuration.
    pub groups: Vec<Group>,
}

impl Averaged {
    /// Means of the configurations that the answer is the mean of.
    pub fn means(&self) -> Vec<Transform<Camera, Base>> {
        let kept = self.groups.iter().filter(|group| !group.is_outlier);
        kept.filter_map(|group| group.camera_from_base).collect()
    }
}

/// A configuration of several frames needs this many poses (the paper's code).
const FEWEST: usize = 2;

/// The mean of `poses`, of configurations with so many frames each: of those of a configuration without outliers, then of
/// all configurations without outliers (the paper, section 3.4). Translations are averaged, and rotations by Markley's mean.
pub fn average(poses: &[FramePose], frames: &[usize]) -> Averaged {
    let group = |(configuration, frames): (usize, &usize)| {
        let own = poses.iter().filter(|pose| pose.configuration == configuration);
        let own: Vec<_> = own.map(|pose| pose.camera_from_base).collect();
        let kept = kept(&own);
        let enough = own.len() >= FEWEST.min(*frames).max(1);
        Group {
            poses: own.len(),
            outliers: own.len() - kept.len(),
            camera_from_base: mean_transform(&kept, None).ok().filter(|_| enough),
            is_outlier: false,
        }
    };
    let mut groups: Vec<Group> = frames.iter().enumerate().map(group).collect();
    let means: Vec<_> = groups.iter().filter_map(|group| group.camera_from_base).collect();
    let with_mean = groups.iter_mut().filter(|group| group.camera_from_base.is_some());
    for (group, is_inlier) in with_mean.zip(inliers(&means)) {
        group.is_outlier = !is_inlier;
    }
    let mut averaged = Averaged { camera_from_base: None, groups };
    averaged.camera_from_base = mean_transform(&averaged.means(), None).ok();
    averaged
}

fn kept(poses: &[Transform<Camera, Base>]) -> Vec<Transform<Camera, Base>> {
    let kept = poses.iter().zip(inliers(poses)).filter(|(_, is_inlier)| *is_inlier);
    kept.map(|(pose, _)| *pose).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{UnitQuaternion, Vector3, Vector6};

    fn truth() -> Transform<Camera, Base> {
        let turn = UnitQuaternion::from_euler_angles(2.0, 0.1, -0.7);
        Transform::from_parts(Vector3::new(-0.1, 0.3, 1.1), turn)
    }

    /// Poses of five configurations of ten frames whose errors cancel, of which one frame each and one whole
    /// configuration are far off.
    fn poses(stray: f64) -> Vec<FramePose> {
        let of = |configuration: usize| {
            (0..10).map(move |frame| {
                let sign = if frame % 2 == 0 { 1.0 } else { -1.0 };
                let size = 0.001 * f64::from(frame / 2 + 1) * sign;
                let wrong = if frame == 9 || configuration == 4 { stray } else { 0.0 };
                let off = Vector6::new(size + wrong, -size, 0.5 * size, size, wrong, -size);
                FramePose { configuration, camera_from_base: truth().retract(&off) }
            })
        };
        (0..5).flat_map(of).collect()
    }

    #[test]
    fn neither_stray_frames_nor_a_stray_configuration_count() {
        let found = average(&poses(0.2), &[10; 5]);
        let (metres, radians) = found.camera_from_base.unwrap().distance_to(&truth());
        assert!(metres < 1e-3 && radians < 1e-3, "{metres} {radians}");
        assert!(found.groups[4].is_outlier && !found.groups[0].is_outlier);
        assert_eq!(found.means().len(), 4);
        // Every configuration but the stray one has one stray frame.
        assert!(found.groups[..4].iter().all(|group| group.outliers >= 1));
    }

    #[test]
    fn a_configuration_needs_two_poses_if_it_has_as_many_frames() {
        let two = &poses(0.0)[..1];
        assert_eq!(average(two, &[10]).camera_from_base, None);
        assert!(average(two, &[1]).camera_from_base.is_some());
        assert_eq!(average(&[], &[1, 1]).camera_from_base, None);
    }
}
