//! `dataset.toml`: what the numbers of a data set mean.

use super::classes::code;
use super::error::DatasetError;
use super::files::{read_text, write_once};
use super::symmetry::SymmetryDescription;
use crate::end_effector::EndEffector;
use eyebolt_registration::Label;
use eyebolt_robot::Arm;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Name and version of the form of a data set.
pub const SCHEMA: &str = "eyebolt.dataset/1";
pub(super) const FILE: &str = "dataset.toml";

/// What the numbers of a data set mean; the same for all of its recordings.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Description {
    /// [`SCHEMA`].
    pub schema: String,
    /// How to read the transforms.
    pub convention: String,
    /// Of all numbers whose names do not say theirs.
    pub units: String,
    /// Where source and calibration of each recording are told.
    pub recordings: String,
    /// The robot in all frames.
    pub robot: RobotDescription,
    /// Values of the array `label`.
    pub classes: Classes,
    /// The end-effector's keypoints, in the order of their classes.
    pub keypoints: Vec<KeypointDescription>,
    /// Turns of the end-effector that its shape does not show.
    pub symmetry: SymmetryDescription,
}

/// The robot in all frames.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct RobotDescription {
    /// Its name in the URDF.
    pub name: String,
    /// BLAKE3 hash of the URDF's text, hexadecimal.
    pub urdf_hash: String,
    /// The base link.
    pub base: String,
    /// The end-effector link.
    pub end_effector: String,
    /// Names of the joints, in the order of the array `joint_positions`.
    pub joints: Vec<String>,
}

/// Values of the array `label`.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Classes {
    /// Not the robot.
    pub background: u8,
    /// The robot without its end-effector.
    pub arm: u8,
    /// The end-effector and what hangs on it.
    pub end_effector: u8,
    /// Nobody can say, or no depth.
    pub ignore: u8,
}

/// A keypoint of the end-effector.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct KeypointDescription {
    /// Its value in the array `keypoint`, from 1.
    pub class: u8,
    /// The link that it is fixed to.
    pub link: String,
    /// Where on it, link frame, metres.
    pub point_in_link_m: [f64; 3],
}

impl Description {
    /// Of frames of `arm`, whose end-effector is `end_effector`.
    pub fn new(arm: &Arm, end_effector: &EndEffector) -> Self {
        let robot = arm.robot();
        let link = |index: usize| robot.links.get(index).map_or("", |link| &link.name).to_owned();
        let keypoints = (1..).zip(end_effector.fixed_keypoints());
        let joints = end_effector.joint_names().into_iter().map(str::to_owned).collect();
        Self {
            schema: SCHEMA.to_owned(),
            convention: CONVENTION.to_owned(),
            units: "metres, radians, pixels".to_owned(),
            recordings: "recordings/*.toml".to_owned(),
            robot: RobotDescription {
                name: robot.name.clone(),
                urdf_hash: robot.urdf_hash().to_owned(),
                base: arm.base_name().to_owned(),
                end_effector: arm.end_effector_name().to_owned(),
                joints,
            },
            classes: CLASSES,
            keypoints: keypoints
                .map(|(class, keypoint)| KeypointDescription {
                    class,
                    link: link(keypoint.link),
                    point_in_link_m: keypoint.point_in_link.coords.into(),
                })
                .collect(),
            symmetry: end_effector.symmetry().into(),
        }
    }

    /// Reads that of the data set in `folder`.
    pub(super) fn read(folder: &Path) -> Result<Self, DatasetError> {
        let path = folder.join(FILE);
        let text = read_text(&path, "Name the folder of a data set that `label` wrote")?;
        let remedy = "Read it with the version of eyebolt that wrote it, or label again";
        let field = |problem: toml::de::Error| {
            let text = problem.message().to_owned();
            DatasetError::invalid(&path, "text", text, remedy)
        };
        let Schema { schema } = toml::from_str(&text).map_err(field)?;
        if schema != SCHEMA {
            let problem = format!("{schema:?} is not {SCHEMA:?}");
            return Err(DatasetError::invalid(&path, "schema", problem, remedy));
        }
        let read: Self = toml::from_str(&text).map_err(field)?;
        if read.classes != CLASSES {
            let problem = format!("{:?} are not {CLASSES:?}", read.classes);
            return Err(DatasetError::invalid(&path, "classes", problem, remedy));
        }
        Ok(read)
    }

    /// Refuses a data set in `folder` that is described otherwise.
    pub(super) fn check_there(&self, folder: &Path) -> Result<(), DatasetError> {
        let path = folder.join(FILE);
        match path.exists() {
            true => self.check(&Self::read(folder)?, &path),
            false => Ok(()),
        }
    }

    /// Writes it to `folder`, unless the data set there is described so already.
    pub(super) fn write(&self, folder: &Path) -> Result<(), DatasetError> {
        let body = toml::to_string(self).expect("a description is plain data");
        write_once(&folder.join(FILE), format!("{HEAD}{body}").as_bytes())?;
        self.check_there(folder)
    }

    /// Refuses `there`, a data set of something else.
    fn check(&self, there: &Self, path: &Path) -> Result<(), DatasetError> {
        let same = [
            ("robot.urdf_hash", self.robot.urdf_hash == there.robot.urdf_hash),
            ("robot.base", self.robot.base == there.robot.base),
            ("robot.end_effector", self.robot.end_effector == there.robot.end_effector),
            ("robot.joints", self.robot.joints == there.robot.joints),
            ("keypoints", self.keypoints == there.keypoints),
            ("symmetry", self.symmetry == there.symmetry),
        ];
        let other = same.iter().find(|(_, same)| !same);
        other.map_or(Ok(()), |(field, _)| Err(self.another(path, field)))
    }

    fn another(&self, path: &Path, field: &str) -> DatasetError {
        let problem = format!("the data set is of another robot than {:?}", self.robot.name);
        DatasetError::invalid(path, field, problem, "Write to another folder: one for each robot")
    }
}

#[derive(Deserialize)]
struct Schema {
    schema: String,
}

const CLASSES: Classes = Classes {
    background: code(Label::Background),
    arm: code(Label::Arm),
    end_effector: code(Label::EndEffector),
    ignore: code(Label::Ignore),
};

const CONVENTION: &str = "a_from_b maps coordinates in b to coordinates in a; camera is the optical frame of \
                          the images: x right, y down, z forward";

/// What people need who open the files with NumPy alone.
const HEAD: &str = "\
# A data set of labelled depth frames. index.jsonl has a line for each frame; \"file\" is opened by
#
#     frame = numpy.load(file)
#
# depth_m                   float32 H x W      depth along z, metres; 0 where there is none
# label                     uint8 H x W        see [classes]
# keypoint                  uint8 H x W        class of a keypoint, from 1; 0 for none
# camera_matrix             float64 3 x 3      pixels; (0, 0) is the middle of the first pixel
# distortion                float64 8          k1 k2 p1 p2 k3 k4 k5 k6, as in OpenCV
# camera_from_end_effector  float64 4 x 4      metres
# keypoints_in_camera_m     float64 K x 3      where all keypoints are, seen or not; NaN on a finger that was not recorded
# joint_positions           float64 J          as recorded, in the order of robot.joints; radians, metres, NaN if not recorded
#
# a_from_b maps coordinates in b to coordinates in a. The camera frame is optical: x right, y down,
# z forward. Depth, camera and poses have what the calibration found to be off corrected.
# recordings/ID.toml tells of each recording, recordings/ID.calibration.json how it was calibrated.

";
