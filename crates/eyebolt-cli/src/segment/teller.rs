//! Who tells which pixels are what.

use crate::ending::causes;
use crate::output;
use anyhow::Result;
use eyebolt::model_files::ModelFiles;
use eyebolt::pose::{EndEffectorShape, PoseError, RecognizeError, Recognizer};
use eyebolt::segment::{Segmentation, Segmenter};
use eyebolt_geometry::{DepthImage, PinholeCamera};
use eyebolt_registration::LinkCache;
use eyebolt_robot::Arm;

/// Who tells which pixels are what.
pub enum Teller {
    /// Networks alone.
    Networks(Box<Segmenter>),
    /// Networks, and the pose of the end-effector that explains what they say.
    Posed(Box<Recognizer>),
}

impl Teller {
    /// Networks alone.
    pub fn networks(model: &ModelFiles) -> Result<Self> {
        Ok(Self::Networks(Box::new(Segmenter::open(model)?)))
    }

    /// All networks of a model, if it has those for poses and the robot is known: any arm can be told from the rest without.
    pub fn posed(model: &ModelFiles, arm: Result<Arm>, cache: &LinkCache) -> Result<Self> {
        let alone = Self::networks(model)?;
        if !alone.tells_end_effector() {
            return Ok(alone);
        }
        let shape = match arm.and_then(|arm| Ok(EndEffectorShape::of(&arm, cache)?)) {
            Ok(shape) => shape,
            Err(error) => {
                output::complain(&format!(
                    "note: the labels are the networks' alone, since the end-effector's shape is not known: {}",
                    causes(&error)
                ));
                return Ok(alone);
            }
        };
        match Recognizer::open(model, shape) {
            Err(RecognizeError::Pose(PoseError::NoNetwork { .. })) => Ok(alone),
            opened => Ok(Self::Posed(Box::new(opened?))),
        }
    }

    /// Which also tells how likely each class is.
    pub fn with_probabilities(self) -> Self {
        match self {
            Self::Networks(segmenter) => Self::Networks(Box::new(segmenter.with_probabilities())),
            Self::Posed(recognizer) => Self::Posed(Box::new(recognizer.with_probabilities())),
        }
    }

    /// Whether the end-effector is told apart.
    pub fn tells_end_effector(&self) -> bool {
        match self {
            Self::Networks(segmenter) => segmenter.tells_end_effector(),
            Self::Posed(_) => true,
        }
    }

    /// Labels of a frame.
    pub fn label(&mut self, depth: &DepthImage, camera: &PinholeCamera) -> Result<Segmentation> {
        Ok(match self {
            Self::Networks(segmenter) => segmenter.segment(depth, camera)?,
            Self::Posed(recognizer) => recognizer.recognize(depth, camera, &[])?.segmentation,
        })
    }
}
