//! What a frame handed in has to be, as the readers of files ask of theirs.

use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::frame::Range;
use crate::joints;
use crate::unit_check::check_unit;
use eyebolt_geometry::{Mask, PinholeCamera};
use eyebolt_robot::JointPositions;
use std::path::Path;

const WHOLE: &str = "Both must be of the same camera and size";

/// Where something wrong is, for messages.
pub(super) struct Place<'a> {
    source: &'a Path,
    name: String,
}

impl<'a> Place<'a> {
    pub(super) fn frame(source: &'a str, name: &str) -> Self {
        Self { source: Path::new(source), name: format!("frame {name}") }
    }

    pub(super) fn background(source: &'a str, index: usize) -> Self {
        Self { source: Path::new(source), name: format!("background {index}") }
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

    /// Refuses lengths that cannot be in metres.
    pub(super) fn check_metres(
        &self,
        field: &str,
        lengths_m: impl ExactSizeIterator<Item = f32> + Clone,
    ) -> Result<(), RecordingError> {
        check_unit(self.source, field, DepthUnit::METRES, lengths_m)
            .map_err(|error| self.invalid(field, error.problem(), "Hand in metres"))
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
