//! Where a camera stands.

use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_render::Random;
use nalgebra::{Rotation3, UnitQuaternion, Vector3};

/// Where a camera stands and where it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewpoint {
    /// One of [`PRESETS`].
    Preset(&'static Preset),
    /// Somewhere in these ranges, as the seed decides.
    Within(Ranges),
}

/// A pose of the camera with a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// What it is called on the command line.
    pub name: &'static str,
    position_m: [f64; 3],
    rotation_xyzw: [f64; 4],
}

/// The paper's three training and three test poses.
///
/// The paper prints no poses but how far apart they are, in a table; `presets.py` finds poses that
/// are as far apart, and prints these rows.
pub const PRESETS: &[Preset] = &[
    Preset {
        name: "paper-train-p1",
        position_m: [0.5747, -0.8825, 0.6379],
        rotation_xyzw: [-0.782332, -0.179420, -0.034929, 0.595437],
    },
    Preset {
        name: "paper-train-p2",
        position_m: [1.1079, -0.0714, 0.7646],
        rotation_xyzw: [-0.796297, -0.327631, 0.488463, 0.141325],
    },
    Preset {
        name: "paper-train-p3",
        position_m: [0.9247, 0.7635, 0.9653],
        rotation_xyzw: [0.047976, -0.870978, 0.462911, 0.157507],
    },
    Preset {
        name: "paper-test-p1",
        position_m: [0.5342, -0.9117, 0.6249],
        rotation_xyzw: [-0.765064, -0.091128, -0.116332, 0.626769],
    },
    Preset {
        name: "paper-test-p2",
        position_m: [1.0508, -0.0711, 0.7786],
        rotation_xyzw: [-0.775993, -0.420665, 0.403403, 0.241126],
    },
    Preset {
        name: "paper-test-p3",
        position_m: [0.9729, 0.7658, 1.0044],
        rotation_xyzw: [-0.260194, -0.883471, 0.293076, 0.256679],
    },
];

impl Preset {
    /// The preset called `name`.
    pub fn named(name: &str) -> Option<&'static Self> {
        PRESETS.iter().find(|preset| preset.name == name)
    }

    /// The pose.
    pub fn base_from_camera(&self) -> Transform<Base, Camera> {
        let pose = Transform::from_xyzw(self.position_m, self.rotation_xyzw);
        pose.expect("presets are rotations")
    }
}

/// Ranges, least and greatest, of where a camera stands about what it looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ranges {
    /// Middle of the workspace, base frame, metres: what the camera looks at.
    pub workspace_m: [f64; 3],
    /// Distance from the middle of the workspace, metres.
    pub distance_m: [f64; 2],
    /// Direction from there in the plane of the table, from the base's x toward its y, radians.
    pub azimuth: [f64; 2],
    /// How steeply it looks down, radians.
    pub elevation: [f64; 2],
    /// How far the middle of the workspace may be off the middle of the image, and how far the
    /// camera may be rolled, radians.
    pub askew: f64,
}

impl Default for Ranges {
    /// On a tripod before or beside the table, or on a shelf above it; looks at where arms of 0.85 m
    /// mostly work: before them, at the height of an elbow.
    fn default() -> Self {
        Self {
            workspace_m: [0.40, 0.0, 0.34],
            distance_m: [0.95, 1.5],
            azimuth: [-1.9, 1.9],
            elevation: [0.15, 0.85],
            askew: 0.14,
        }
    }
}

impl Ranges {
    /// The same ranges about where the end-effector of an arm goes, `in_base`, as they are about where
    /// arms of usual size do; `None` if they are about something else already.
    pub(super) fn about(&self, in_base: &EndEffectors) -> Option<Self> {
        let usual = Self::default();
        let EndEffectors { middle, far_m } = in_base;
        let scale = (far_m / USUAL_REACH_M).max(1.0);
        let distance_m = match self.distance_m == usual.distance_m {
            true => usual.distance_m.map(|metres| scale * metres),
            false => self.distance_m,
        };
        let [ahead, ..] = usual.workspace_m;
        let workspace_m = [middle.x + scale * ahead, middle.y, middle.z];
        (self.workspace_m == usual.workspace_m).then_some(Self { workspace_m, distance_m, ..*self })
    }
}

/// Where the end-effector of an arm goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct EndEffectors {
    /// Middle of these places, base frame, metres.
    pub(super) middle: Vector3<f64>,
    /// How far from there it goes in nine of ten of them, metres.
    pub(super) far_m: f64,
}

/// How far an arm of usual size goes.
const USUAL_REACH_M: f64 = 0.85;

impl Viewpoint {
    /// The pose.
    pub fn base_from_camera(&self, random: &mut Random) -> Transform<Base, Camera> {
        let ranges = match self {
            Self::Preset(preset) => return preset.base_from_camera(),
            Self::Within(ranges) => ranges,
        };
        let mut within = |[low, high]: [f64; 2]| random.between(low, high);
        let distance = within(ranges.distance_m);
        let (azimuth, elevation) = (within(ranges.azimuth), within(ranges.elevation));
        let level = Vector3::new(azimuth.cos(), azimuth.sin(), 0.0);
        let away = elevation.cos() * level + elevation.sin() * Vector3::z();
        let mut askew = || random.between(-ranges.askew, ranges.askew);
        let turn = UnitQuaternion::from_euler_angles(askew(), askew(), askew());
        let workspace = Vector3::from(ranges.workspace_m);
        Transform::from_parts(workspace + distance * away, looking_along(&-away) * turn)
    }
}

/// An optical frame that looks along `forward`, with its x axis level.
fn looking_along(forward: &Vector3<f64>) -> UnitQuaternion<f64> {
    let z = forward.normalize();
    // Straight up or down any direction is level.
    let across = z.cross(&Vector3::z());
    let x = across.try_normalize(1e-9).unwrap_or_else(Vector3::x);
    let axes = nalgebra::Matrix3::from_columns(&[x, z.cross(&x), z]);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn ordered(low: f64, high: f64) -> impl Strategy<Value = [f64; 2]> {
        [low..high, low..high].prop_map(|[a, b]| [a.min(b), a.max(b)])
    }

    proptest! {
        #[test]
        fn cameras_stand_where_the_ranges_say(
            seed: u64,
            distance_m in ordered(0.3, 5.0),
            azimuth in ordered(-PI, PI),
            elevation in ordered(-1.5, 1.5),
            askew in 0.0..0.3_f64,
        ) {
            let ranges = Ranges { distance_m, azimuth, elevation, askew, ..Ranges::default() };
            let looked_at = Vector3::from(ranges.workspace_m);
            let pose = Viewpoint::Within(ranges).base_from_camera(&mut Random::new(seed));
            let away = pose.translation_m() - looked_at;
            let within = |value: f64, [low, high]: [f64; 2]| {
                (low - 1e-9..=high + 1e-9).contains(&value)
            };
            prop_assert!(within(away.norm(), distance_m));
            prop_assert!(within(away.y.atan2(away.x), azimuth));
            prop_assert!(within((away.z / away.norm()).asin(), elevation));
            // Two turns of `askew` at right angles take the axis off the workspace, the third none.
            let workspace = pose.inverse().point(&Point3::from(looked_at));
            let off_axis = workspace.coords.xy().norm().atan2(workspace.z);
            prop_assert!(off_axis <= 2f64.sqrt() * askew + 1e-9, "{off_axis}");
        }

        /// With nothing askew the workspace is in the middle, and rows of the image are level, with
        /// what is up in the world up in the image.
        #[test]
        fn straight_cameras_are_level(seed: u64) {
            let ranges = Ranges { askew: 0.0, ..Ranges::default() };
            let pose = Viewpoint::Within(ranges).base_from_camera(&mut Random::new(seed));
            let workspace = pose.inverse().point(&Point3::from(ranges.workspace_m));
            prop_assert!(workspace.coords.xy().norm() < 1e-9 && workspace.z > 0.0);
            let [x, y] = [Vector3::x(), Vector3::y()].map(|axis| pose.direction(&axis));
            prop_assert!(x.z.abs() < 1e-9 && y.z < 0.0);
        }

        #[test]
        fn any_direction_makes_a_rotation(direction in proptest::array::uniform3(-1.0..1.0_f64)) {
            let forward = Vector3::from(direction);
            prop_assume!(forward.norm() > 1e-3);
            let turn = looking_along(&forward);
            prop_assert!((turn * Vector3::z() - forward.normalize()).norm() < 1e-9);
            prop_assert!((turn.norm() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn straight_down_and_up_are_directions_too() {
        for forward in [Vector3::z(), -Vector3::z()] {
            assert!((looking_along(&forward) * Vector3::z() - forward).norm() < 1e-12);
        }
        let ranges = Ranges { elevation: [FRAC_PI_2; 2], askew: 0.0, ..Ranges::default() };
        let pose = Viewpoint::Within(ranges).base_from_camera(&mut Random::new(1));
        assert!((pose.direction(&Vector3::z()) + Vector3::z()).norm() < 1e-9);
    }

    #[test]
    fn presets_need_no_random_numbers() {
        for preset in PRESETS {
            let pose = Viewpoint::Preset(preset).base_from_camera(&mut Random::new(3));
            assert_eq!(pose, preset.base_from_camera());
        }
    }
}
