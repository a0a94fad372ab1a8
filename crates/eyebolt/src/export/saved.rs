//! What a calibration file says, checked.

mod corrections;
mod field;
mod pose;
mod uncertainty;

pub use corrections::Corrections;
pub use uncertainty::Uncertainty;

use super::error::ExportError;
use super::file::read_text;
use super::frame_name::FrameName;
use super::static_tree::{StaticEdge, StaticTree, static_pose};
use crate::answer::SCHEMA;
use corrections::RawCorrections;
use eyebolt_geometry::{Base, Camera, Transform};
use field::{REMEDY, missing};
use pose::RawPose;
use serde::Deserialize;
use std::path::Path;
use uncertainty::RawUncertainty;

/// Largest calibration file, bytes: a recording of thousands of frames makes a few MiB.
pub const MAX_CALIBRATION_BYTES: u64 = 16 << 20;

/// What a calibration file says that other programs need.
#[derive(Clone, Debug)]
pub struct SavedCalibration {
    /// Name of the depth optical frame, if the recording told it.
    pub camera_frame: Option<FrameName>,
    /// Name of the base link.
    pub base_frame: FrameName,
    /// Name of the end-effector link.
    pub end_effector_frame: FrameName,
    file: String,
    refused: Option<Vec<String>>,
    base_from_camera: Option<Transform<Base, Camera>>,
    corrections: Corrections,
    uncertainty: Uncertainty,
    tree: StaticTree,
    tree_problem: Option<String>,
}

#[derive(Deserialize)]
struct RawSchema {
    schema: Option<String>,
}

#[derive(Deserialize)]
struct Raw {
    verdict: Option<String>,
    #[serde(default)]
    reasons: Vec<String>,
    frames: Option<RawFrames>,
    camera_from_base: Option<RawPose>,
    base_from_camera: Option<RawPose>,
    #[serde(default)]
    static_transforms: Vec<RawFixed>,
}

#[derive(Deserialize)]
struct RawFixed {
    parent: String,
    child: String,
    translation_m: [f64; 3],
    rotation_xyzw: [f64; 4],
}

#[derive(Deserialize)]
struct RawFrames {
    camera: Option<String>,
    base: Option<String>,
    end_effector: Option<String>,
}

impl SavedCalibration {
    /// Reads the calibration file at `path`.
    ///
    /// # Errors
    /// See [`SavedCalibration::parse`]; also a file that cannot be read or is larger than
    /// [`MAX_CALIBRATION_BYTES`].
    pub fn read(path: &Path) -> Result<Self, ExportError> {
        Self::parse(&path.display().to_string(), &read_text(path, MAX_CALIBRATION_BYTES)?)
    }

    /// As [`SavedCalibration::read`], from text; `file` is for messages.
    ///
    /// # Errors
    /// Text that is no calibration of this version, frames without names, quaternions that are not
    /// of unit length, and poses whose spellings (translation and quaternion, matrix, inverse)
    /// disagree.
    pub fn parse(file: &str, text: &str) -> Result<Self, ExportError> {
        let RawSchema { schema } = json(file, text)?;
        match schema.as_deref() {
            Some(SCHEMA) => {}
            Some(other) => {
                let remedy = "Use the version of eyebolt that wrote the file, or calibrate again";
                let problem = format!("{other:?} is not {SCHEMA:?}");
                return Err(ExportError::invalid(file, "schema", problem, remedy));
            }
            None => {
                let remedy = "Name the file that `eyebolt calibrate` wrote";
                return Err(ExportError::invalid(file, "schema", "the field is missing", remedy));
            }
        }
        let raw: Raw = json(file, text)?;
        let corrections: RawCorrections = json(file, text)?;
        let uncertainty: RawUncertainty = json(file, text)?;
        let frames = raw.frames.ok_or_else(|| missing(file, "frames"))?;
        // What others publish is no reason to withhold the pose; whoever exports it is told.
        let (tree, tree_problem) = match tree(file, raw.static_transforms) {
            Ok(tree) => (tree, None),
            Err(error) => (StaticTree::empty(), Some(error.to_string())),
        };
        Ok(Self {
            tree,
            tree_problem,
            camera_frame: match frames.camera.filter(|name| !name.is_empty()) {
                Some(name) => Some(frame_name(file, "frames.camera", Some(name))?),
                None => None,
            },
            base_frame: frame_name(file, "frames.base", frames.base)?,
            end_effector_frame: frame_name(file, "frames.end_effector", frames.end_effector)?,
            refused: refused(file, raw.verdict, raw.reasons)?,
            base_from_camera: pose::agreed(file, raw.camera_from_base, raw.base_from_camera)?,
            corrections: corrections.check(file)?,
            uncertainty: uncertainty.check(file)?,
            file: file.to_owned(),
        })
    }

    /// Where the calibration came from, for messages.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// What it found to be off in what was recorded and described.
    pub fn corrections(&self) -> &Corrections {
        &self.corrections
    }

    /// How far off it expects to be.
    pub fn uncertainty(&self) -> &Uncertainty {
        &self.uncertainty
    }

    /// The frames that do not move against the camera's or the base, as the recording told them.
    pub fn tree(&self) -> &StaticTree {
        &self.tree
    }

    /// Why what the recording told of its frames makes no tree; then [`Self::tree`] is empty.
    pub fn tree_problem(&self) -> Option<&str> {
        self.tree_problem.as_deref()
    }

    /// Why it was refused; `None` if it is trusted.
    pub fn refused(&self) -> Option<&[String]> {
        self.refused.as_deref()
    }

    /// The pose of the camera (depth optical frame) in the base.
    ///
    /// # Errors
    /// A calibration that was refused, unless `even_if_refused`, or one without a pose.
    pub fn base_from_camera(
        &self,
        even_if_refused: bool,
    ) -> Result<Transform<Base, Camera>, ExportError> {
        let file = || self.file.clone();
        match &self.refused {
            Some(reasons) if !even_if_refused => {
                Err(ExportError::Refused { file: file(), reasons: reasons.join("; ") })
            }
            _ => self.base_from_camera.ok_or_else(|| ExportError::NoPose { file: file() }),
        }
    }
}

fn tree(file: &str, told: Vec<RawFixed>) -> Result<StaticTree, ExportError> {
    let edges = told.into_iter().enumerate().map(|(index, edge)| {
        let field = format!("static_transforms[{index}]");
        let RawFixed { parent, child, translation_m, rotation_xyzw } = edge;
        let parent_from_child = static_pose(file, &field, translation_m, rotation_xyzw)?;
        Ok(StaticEdge { parent, child, parent_from_child })
    });
    StaticTree::from_edges(file, edges.collect::<Result<_, ExportError>>()?)
}

fn json<'de, T: Deserialize<'de>>(file: &str, text: &'de str) -> Result<T, ExportError> {
    serde_json::from_str(text).map_err(|error| {
        let place = format!("line {}, column {}", error.line(), error.column());
        ExportError::invalid(file, place, error.to_string(), REMEDY)
    })
}

fn frame_name(file: &str, field: &str, name: Option<String>) -> Result<FrameName, ExportError> {
    let name = name.ok_or_else(|| missing(file, field))?;
    FrameName::new(&name).map_err(|bad| ExportError::bad_name(file, field, &bad))
}

fn refused(
    file: &str,
    verdict: Option<String>,
    reasons: Vec<String>,
) -> Result<Option<Vec<String>>, ExportError> {
    match verdict.as_deref() {
        Some("trusted") => Ok(None),
        Some("refused") => Ok(Some(reasons)),
        Some(other) => {
            let problem = format!("{other:?} is neither \"trusted\" nor \"refused\"");
            Err(ExportError::invalid(file, "verdict", problem, REMEDY))
        }
        None => Err(missing(file, "verdict")),
    }
}
