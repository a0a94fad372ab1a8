//! From the spelled fields to their meaning.

use super::fields::{Background, CloudFrame, JointFiles, RangeKind};
use super::raw::{RawBackground, RawFrames, RawUnit};
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::pattern::{Pattern, extension};
use std::path::Path;

/// Where the description came from, for messages and for paths relative to it.
pub(super) struct Source<'a> {
    pub(super) path: &'a Path,
    pub(super) root: &'a Path,
}

impl Source<'_> {
    fn invalid(&self, field: &str, problem: impl Into<String>, remedy: &str) -> RecordingError {
        RecordingError::invalid(self.path, field, problem, remedy)
    }

    pub(super) fn missing(&self, field: &str, what: &str) -> RecordingError {
        self.invalid(field, "the key is missing", &format!("Add it: {what}"))
    }

    pub(super) fn pattern(
        &self,
        key: &str,
        text: Option<&str>,
        extensions: &[&str],
    ) -> Result<Option<Pattern>, RecordingError> {
        self.files(&format!("frames.{key}"), text, extensions)
    }

    fn files(
        &self,
        field: &str,
        text: Option<&str>,
        extensions: &[&str],
    ) -> Result<Option<Pattern>, RecordingError> {
        text.map(|t| Pattern::parse(self.path, self.root, field, t, extensions)).transpose()
    }

    /// The backgrounds, in the unit of the frames unless they have their own.
    pub(super) fn background(
        &self,
        raw: &RawBackground,
        unit: DepthUnit,
    ) -> Result<Background, RecordingError> {
        let files = self.files("background.depth", raw.depth.as_deref(), &["npy", "png"])?;
        let what = "the files of depth images without the robot, as in \"background_{}.npy\"";
        let own = raw.depth_unit.as_ref();
        Ok(Background {
            files: files.ok_or_else(|| self.missing("background.depth", what))?,
            unit: match own {
                Some(_) => self.unit("background.depth_unit", own)?,
                None => unit,
            },
        })
    }

    pub(super) fn range(&self, frames: &RawFrames) -> Result<(RangeKind, Pattern), RecordingError> {
        let depth = self.pattern("depth", frames.depth.as_deref(), &["npy", "png"])?;
        let cloud = self.pattern("cloud", frames.cloud.as_deref(), &["npy", "pcd", "ply"])?;
        match (depth, cloud) {
            (Some(_), Some(_)) => {
                Err(self.invalid("frames", "both depth and cloud are given", "Keep one of them"))
            }
            (None, None) => Err(self.invalid(
                "frames",
                "neither depth nor cloud is given",
                "Name the files with one of them, as in depth = \"depth_{}.npy\"",
            )),
            (Some(_), None) if frames.cloud_frame.is_some() => {
                let remedy = "Remove it: depth is always in the optical frame";
                Err(self.invalid("frames.cloud_frame", "the recording has no clouds", remedy))
            }
            (Some(depth), None) => Ok((RangeKind::Depth, depth)),
            (None, Some(cloud)) => Ok((RangeKind::Cloud(self.cloud_frame(frames)?), cloud)),
        }
    }

    fn cloud_frame(&self, frames: &RawFrames) -> Result<CloudFrame, RecordingError> {
        let field = "frames.cloud_frame";
        let two = "\"optical\" (x right, y down, z forward) or \"body\" (x forward, y left, z up)";
        match frames.cloud_frame.as_deref() {
            Some(name) => CloudFrame::named(name).ok_or_else(|| {
                self.invalid(field, format!("found \"{name}\""), &format!("Write {two}"))
            }),
            None => Err(self.missing(field, two)),
        }
    }

    pub(super) fn unit(
        &self,
        field: &str,
        told: Option<&RawUnit>,
    ) -> Result<DepthUnit, RecordingError> {
        let ways = DepthUnit::WAYS;
        let (unit, found) = match told {
            Some(RawUnit::Metres(metres)) => (DepthUnit::of_metres(*metres), metres.to_string()),
            Some(RawUnit::Name(name)) => (DepthUnit::parse(name), format!("\"{name}\"")),
            None => return Err(self.missing(field, &format!("{ways}; the unit is never guessed"))),
        };
        unit.ok_or_else(|| self.invalid(field, format!("found {found}"), &format!("Write {ways}")))
    }

    pub(super) fn joints(&self, frames: &RawFrames) -> Result<JointFiles, RecordingError> {
        let text = frames.joints.as_deref();
        if let Some(text) = text.filter(|text| !text.contains("{}")) {
            let path = self.root.join(text);
            // NPY has nowhere to say which frame a position is of.
            if ["csv", "json"].contains(&extension(&path).as_str()) {
                return Ok(JointFiles::Table(path));
            }
        }
        let pattern = self.pattern("joints", text, &["npy", "csv", "json"])?;
        pattern
            .map(JointFiles::PerFrame)
            .ok_or_else(|| self.missing("frames.joints", "name the files of the joint states"))
    }

    pub(super) fn joint_names(
        &self,
        frames: &RawFrames,
        joints: &JointFiles,
    ) -> Result<Option<Vec<String>>, RecordingError> {
        let field = "frames.joint_names";
        let nameless =
            matches!(joints, JointFiles::PerFrame(pattern) if pattern.extension() == "npy");
        let Some(names) = &frames.joint_names else {
            let what = "NPY files carry no names, so list the joints in the order of the numbers";
            return if nameless { Err(self.missing(field, what)) } else { Ok(None) };
        };
        if names.is_empty() {
            return Err(self.invalid(field, "the list is empty", "List the joints of the arm"));
        }
        for (i, name) in names.iter().enumerate() {
            if names.iter().take(i).any(|earlier| earlier == name) {
                let problem = format!("\"{name}\" is listed twice");
                return Err(self.invalid(field, problem, "List every joint once"));
            }
        }
        Ok(Some(names.clone()))
    }
}
