//! Closed-form solutions.

use super::motion::{Motion, SPREAD_RAD, motions, spread_rad, translation_m};
use super::poses::{HandEye, PosePair};
use super::{daniilidis, horaud_dornaika, park_martin, tsai_lenz};
use eyebolt_geometry::{CoordinateFrame, Transform, mean_transform};
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion};

/// A closed-form solution of hand-eye calibration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// R. Tsai and R. Lenz, IEEE Transactions on Robotics and Automation 5(3), 1989.
    TsaiLenz,
    /// F. Park and B. Martin, IEEE Transactions on Robotics and Automation 10(5), 1994.
    ParkMartin,
    /// R. Horaud and F. Dornaika, International Journal of Robotics Research 14(3), 1995: closed form.
    HoraudDornaika,
    /// K. Daniilidis, International Journal of Robotics Research 18(3), 1999: dual quaternions.
    Daniilidis,
}

impl Solver {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::TsaiLenz, Self::ParkMartin, Self::HoraudDornaika, Self::Daniilidis];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::TsaiLenz => "tsai_lenz",
            Self::ParkMartin => "park_martin",
            Self::HoraudDornaika => "horaud_dornaika",
            Self::Daniilidis => "daniilidis",
        }
    }
}

/// Why poses of robot and marker do not tell where the camera is.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum HandEyeError {
    /// Fewer than three poses.
    #[error("{poses} poses of the robot show the marker, and at least 3 are needed: record more")]
    FewPoses {
        /// How many there are.
        poses: usize,
    },
    /// The robot hardly turned, or about one axis alone.
    #[error(
        "the robot turned by {spread_deg:.1} degrees about any but one axis, which leaves the camera's place \
         open: turn the hand about two axes at least, by 20 degrees or more"
    )]
    ParallelAxes {
        /// Root mean square of the rotation about the other axes, degrees.
        spread_deg: f64,
    },
    /// The equations have no one solution.
    #[error("the poses of robot and marker do not fit any place of the camera")]
    NoSolution,
}

/// The answer of `solver`, from the motions between any two of `pairs`.
///
/// # Errors
///
/// Too few poses, or motions that leave the answer open.
pub fn solve<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    solver: Solver,
    pairs: &[PosePair<Root, Carrier>],
) -> Result<HandEye<Root, Carrier>, HandEyeError> {
    if pairs.len() < 3 {
        return Err(HandEyeError::FewPoses { poses: pairs.len() });
    }
    let motions = motions(pairs);
    let spread = spread_rad(&motions);
    if spread < SPREAD_RAD || spread.is_nan() {
        return Err(HandEyeError::ParallelAxes { spread_deg: spread.to_degrees() });
    }
    let isometry = match solver {
        Solver::Daniilidis => daniilidis::solve(&motions),
        Solver::TsaiLenz => with_translation(&motions, tsai_lenz::rotation(&motions)),
        Solver::ParkMartin => with_translation(&motions, park_martin::rotation(&motions)),
        Solver::HoraudDornaika => with_translation(&motions, horaud_dornaika::rotation(&motions)),
    };
    let isometry = isometry.filter(|found| found.to_homogeneous().iter().all(|v| v.is_finite()));
    let camera_from_root = Transform::from_isometry(isometry.ok_or(HandEyeError::NoSolution)?);
    let mounts: Vec<_> = pairs
        .iter()
        .map(|pair| (camera_from_root * pair.root_from_carrier).inverse() * pair.camera_from_marker)
        .collect();
    let carrier_from_marker =
        mean_transform(&mounts, None).map_err(|_| HandEyeError::NoSolution)?;
    Ok(HandEye { camera_from_root, carrier_from_marker })
}

fn with_translation(motions: &[Motion], rotation: Option<Matrix3<f64>>) -> Option<Isometry3<f64>> {
    let rotation = rotation?;
    let translation = Translation3::from(translation_m(motions, &rotation)?);
    let rotation =
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation));
    Some(Isometry3::from_parts(translation, rotation))
}
