//! What a frame handed in has to be, as the readers of files ask of theirs.

use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::frame::Range;
use crate::frame_names;
use crate::joints;
use crate::unit_check::check_unit;
use eyebolt_geometry::{Mask, PinholeCamera};
use eyebolt_robot::{Input, JointPositions};
use std::collections::BTreeSet;
use std::path::Path;

/// What a source in memory is called, until it is given a name.
pub(super) const NAME: &str = "in memory";

const WHOLE: &str = "Both must be of the same camera and size";

/// Where something wrong is, for messages.
pub(super) struct Place<'a> {
    source: &'a Path,
    name: String,
    /// What depth was stored in, where a caller told.
    unit: Option<DepthUnit>,
}

impl<'a> Place<'a> {
    pub(super) fn frame(source: &'a str, name: &str) -> Self {
        Self { source: Path::new(source), name: format!("frame {name}"), unit: None }
    }

    pub(super) fn background(source: &'a str, index: usize) -> Self {
        Self { source: Path::new(source), name: format!("background {index}"), unit: None }
    }

    /// The same, of depth that a caller says was stored in `unit`.
    pub(super) fn stored_in(self, unit: DepthUnit) -> Self {
        Self { unit: Some(unit), ..self }
    }

    pub(super) fn invalid(
        &self,
        field: &str,
        problem: impl Into<String>,
        remedy: &str,
    ) -> RecordingError {
        RecordingError::invalid(self.source, self.field(field), problem, remedy)
    }

    fn field(&self, field: &str) -> String {
        format!("{}: {field}", self.name)
    }

    /// Refuses what is of another size than `camera`, if there is one.
    pub(super) fn check_size(
        &self,
        field: &str,
        (width, height): (u32, u32),
        camera: Option<&PinholeCamera>,
    ) -> Result<(), RecordingError> {
        let other = |camera: &&PinholeCamera| (camera.width(), camera.height()) != (width, height);
        let Some(camera) = camera.filter(other) else { return Ok(()) };
        let (w, h) = (camera.width(), camera.height());
        let problem = format!("it is {width} x {height}, but the camera is {w} x {h}");
        Err(self.invalid(field, problem, WHOLE))
    }

    /// Refuses a name that no file could have, or that is `known`.
    pub(super) fn check_name(
        &self,
        name: &str,
        known: &BTreeSet<String>,
    ) -> Result<(), RecordingError> {
        if !frame_names::is_fit(name) {
            let problem = "the name cannot be part of the name of a file";
            return Err(self.invalid("name", problem, "Name it by a number, or without / and \\"));
        }
        match known.contains(name) {
            true => Err(self.invalid("name", "there is a frame of this name", "Give each its own")),
            false => Ok(()),
        }
    }

    /// Refuses lengths that cannot have been in metres, or in the unit that the caller told.
    pub(super) fn check_metres(
        &self,
        field: &str,
        lengths_m: impl ExactSizeIterator<Item = f32> + Clone,
    ) -> Result<(), RecordingError> {
        let unit = self.unit.unwrap_or(DepthUnit::METRES);
        let remedy = match self.unit {
            None => "Hand in metres".to_owned(),
            Some(_) => format!("Say what one of its numbers is with {}", Input::DEPTH_UNIT),
        };
        check_unit(self.source, field, unit, lengths_m)
            .map_err(|error| self.invalid(field, error.problem(), &remedy))
    }

    /// Refuses a depth image or cloud that does not fit `camera`, saw nothing or is in another unit.
    pub(super) fn check_range(
        &self,
        range: &Range,
        camera: Option<&PinholeCamera>,
    ) -> Result<(), RecordingError> {
        let seen = match range {
            Range::Depth(depth) if camera.is_none() => {
                let size = format!("{} x {}", depth.width(), depth.height());
                let problem = format!("there is no camera for this depth image of {size}");
                return Err(self.invalid("depth", problem, "Give the camera, or clouds only"));
            }
            Range::Depth(depth) => {
                self.check_size("depth", (depth.width(), depth.height()), camera)?;
                self.check_metres("depth", depth.depth_m().iter().copied())?;
                depth.depth_m().iter().any(|depth| *depth > 0.0)
            }
            Range::Cloud(cloud) => {
                cloud.grid().map_or(Ok(()), |size| self.check_size("cloud", size, camera))?;
                let points = cloud.points().iter();
                self.check_metres("cloud", points.clone().map(|p| p.coords.norm()))?;
                points.clone().any(|point| point.x.is_finite())
            }
        };
        match seen {
            true => Ok(()),
            false => Err(RecordingError::EmptyFrame {
                path: self.source.to_path_buf(),
                field: self.name.clone(),
            }),
        }
    }

    /// Refuses clouds among depth images and depth images among clouds; `first` is of the first
    /// frame.
    pub(super) fn check_kind(
        &self,
        range: &Range,
        first: Option<&Range>,
    ) -> Result<(), RecordingError> {
        let of = |range: &Range| match range {
            Range::Depth(_) => "depth images",
            Range::Cloud(_) => "clouds",
        };
        match first.map(of) {
            Some(known) if known != of(range) => {
                let problem = format!("the frames before it are {known}");
                Err(self.invalid("range", problem, "Use a source of its own for each kind"))
            }
            _ => Ok(()),
        }
    }

    /// Refuses joints that are none, or not of an arm in radians.
    pub(super) fn check_joints(&self, joints: &JointPositions) -> Result<(), RecordingError> {
        let field = self.field("joints");
        if joints.is_empty() {
            return Err(self.invalid("joints", "there are none", "Give the joints of the arm"));
        }
        joints
            .iter()
            .try_for_each(|(name, position)| joints::check(self.source, &field, "", name, position))
    }

    /// Refuses a mask that does not fit the range, or has no pixel set.
    pub(super) fn check_mask(&self, mask: &Mask, range: &Range) -> Result<(), RecordingError> {
        let (width, height) = (mask.width(), mask.height());
        match range.size() {
            None => {
                let problem =
                    "the cloud is a list of points, and no pixel of a mask belongs to one";
                let remedy = "Hand in clouds of rows and columns, or no masks";
                Err(self.invalid("mask", problem, remedy))
            }
            Some((w, h)) if (w, h) != (width, height) => {
                let problem = format!("it is {width} x {height}, the frame {w} x {h}");
                Err(self.invalid("mask", problem, WHOLE))
            }
            Some(_) if mask.count() == 0 => {
                let remedy = "Mark the arm in it, or leave the mask out";
                Err(self.invalid("mask", "no pixel is set", remedy))
            }
            Some(_) => Ok(()),
        }
    }
}
