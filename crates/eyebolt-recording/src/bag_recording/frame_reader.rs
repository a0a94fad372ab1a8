//! Frames of a bag, from their messages.

use super::picture_topic::PictureTopic;
use super::scan::FrameEntry;
use crate::bag::Bag;
use crate::cloud::{frame_of, frame_remedy};
use crate::color::ColorImage;
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::frame::Range;
use crate::manifest::CloudFrame;
use crate::message::{
    CloudMessage, CompressedImageMessage, ImageMessage, WireProblem, WireReader, color, types,
};
use crate::unit_check::check_unit;
use eyebolt_geometry::{Cloud, DepthImage, Mask, PinholeCamera};
use eyebolt_robot::Input;
use nalgebra::Point3;
use std::path::Path;

/// Reads pictures of the bag at `path`.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameReader<'a> {
    pub(super) path: &'a Path,
    pub(super) bag: &'a Bag,
    /// The camera of all pictures, unless they are clouds without one.
    pub(super) camera: Option<&'a PinholeCamera>,
    /// The unit of depth, where it is another than REP 118 says.
    pub(super) unit: Option<DepthUnit>,
}

impl FrameReader<'_> {
    /// Depth image, or cloud whose points are in `cloud_frame`, of a frame; it saw something.
    pub(super) fn range(
        &self,
        topic: &PictureTopic,
        entry: &FrameEntry,
        cloud_frame: CloudFrame,
    ) -> Result<Range, RecordingError> {
        if topic.message_type == types::CLOUD {
            return self.cloud(topic, entry, cloud_frame).map(Range::Cloud);
        }
        let image = self.depth_image(topic, entry)?;
        // Of most kinds the scan saw that.
        match image.depth_m().iter().any(|depth| *depth > 0.0) {
            true => Ok(Range::Depth(image)),
            false => {
                let path = self.path.to_path_buf();
                Err(RecordingError::EmptyFrame { path, field: topic.field(entry) })
            }
        }
    }

    /// A depth image, whether or not it saw anything.
    pub(super) fn depth_image(
        &self,
        topic: &PictureTopic,
        entry: &FrameEntry,
    ) -> Result<DepthImage, RecordingError> {
        let bytes = self.bag.read(entry.locator)?;
        let wrong = |problem: WireProblem| self.unreadable(topic, entry, problem);
        let mut reader = WireReader::new(&topic.encoding, &bytes).map_err(wrong)?;
        let (size, depth_m, in_millimetres) = if topic.message_type == types::IMAGE {
            let image = ImageMessage::read(&mut reader).map_err(wrong)?;
            let (depth_m, in_millimetres) = image.depth_m().map_err(wrong)?;
            ((image.width, image.height), depth_m, in_millimetres)
        } else {
            let depth = CompressedImageMessage::read(&mut reader).and_then(|m| m.depth());
            let depth = depth.map_err(wrong)?;
            ((depth.width, depth.height), depth.depth_m, depth.in_millimetres)
        };
        let field = topic.field(entry);
        self.check_size(&field, size)?;
        let rep_118 = if in_millimetres { DepthUnit::MILLIMETRES } else { DepthUnit::METRES };
        let unit = self.unit.unwrap_or(rep_118);
        let depth_m = in_unit(depth_m, unit, rep_118);
        check_unit(self.path, &field, unit, depth_m.iter().copied()).map_err(|error| {
            let remedy = format!(
                "Correct the driver: 16UC1 is in millimetres and 32FC1 in metres (REP 118); or say \
                 with {} what one is",
                Input::DEPTH_UNIT
            );
            self.invalid(&field, error.problem(), &remedy)
        })?;
        let (width, height) = size;
        DepthImage::new(width, height, depth_m)
            .map_err(|error| wrong(WireProblem::new("data", error.to_string())))
    }

    fn check_size(&self, field: &str, (width, height): (u32, u32)) -> Result<(), RecordingError> {
        let camera = self.camera.filter(|c| (c.width(), c.height()) != (width, height));
        let Some(camera) = camera else { return Ok(()) };
        let (w, h) = (camera.width(), camera.height());
        let problem = format!("the image is {width} x {height}, but its camera info is {w} x {h}");
        let (topic, file) = (Input::CAMERA_INFO_TOPIC, Input::CAMERA_INFO);
        let remedy = format!("Give the camera info of the depth with {topic} or {file}");
        Err(self.invalid(field, problem, &remedy))
    }

    /// The frame that the points of a cloud lie in, which its message does not say.
    pub(super) fn cloud_frame(
        &self,
        topic: &PictureTopic,
        entry: &FrameEntry,
    ) -> Result<CloudFrame, RecordingError> {
        let (points, _) = self.points(topic, entry)?;
        let found = frame_of(topic.frame_id.as_deref(), &points);
        found.map_err(|problem| self.invalid(&topic.field(entry), problem, &frame_remedy()))
    }

    fn cloud(
        &self,
        topic: &PictureTopic,
        entry: &FrameEntry,
        frame: CloudFrame,
    ) -> Result<Cloud, RecordingError> {
        let (points, (width, height)) = self.points(topic, entry)?;
        let field = topic.field(entry);
        let unit = self.unit.unwrap_or(DepthUnit::METRES);
        let points: Vec<[f32; 3]> =
            points.into_iter().map(|point| point.map(|c| c * unit.metres() as f32)).collect();
        let lengths = points.iter().map(|[x, y, z]: &[f32; 3]| x.hypot(*y).hypot(*z));
        check_unit(self.path, &field, unit, lengths).map_err(|error| {
            let remedy = format!(
                "Correct the driver: points are in metres (REP 118); or say with {} what one is",
                Input::DEPTH_UNIT
            );
            self.invalid(&field, error.problem(), &remedy)
        })?;
        let points: Vec<Point3<f32>> =
            points.into_iter().map(|xyz| crate::cloud::optical(xyz, frame)).collect();
        if height <= 1 {
            return Ok(Cloud::new(points));
        }
        let cloud = Cloud::organised(width, height, points);
        cloud.map_err(|error| self.invalid(&field, error.to_string(), "Record it again"))
    }

    /// The points of a cloud as they are stored, metres, with its size.
    fn points(&self, topic: &PictureTopic, entry: &FrameEntry) -> Result<Points, RecordingError> {
        let bytes = self.bag.read(entry.locator)?;
        WireReader::new(&topic.encoding, &bytes)
            .and_then(|mut reader| CloudMessage::read(&mut reader))
            .and_then(|cloud| Ok((cloud.points()?, (cloud.width, cloud.height))))
            .map_err(|problem| self.unreadable(topic, entry, problem))
    }

    /// The mask `entry`, which is of the size of `range`, that of the frame which messages call
    /// `frame`.
    pub(super) fn mask(
        &self,
        topic: &PictureTopic,
        entry: &FrameEntry,
        (frame, range): (&str, &Range),
    ) -> Result<Mask, RecordingError> {
        let mask = self.image(topic, entry, |image| image.mask())?;
        match range.size() {
            None => {
                let problem =
                    "the cloud is a list of points, and no pixel of a mask belongs to one";
                let remedy = "Record clouds of rows and columns, or none of masks";
                Err(self.invalid(frame, problem, remedy))
            }
            Some(size) if size != (mask.width(), mask.height()) => {
                let (w, h) = (mask.width(), mask.height());
                let problem = format!("the mask is {w} x {h}, the frame {} x {}", size.0, size.1);
                let remedy = "Both must be of the same camera and size";
                Err(self.invalid(&topic.field(entry), problem, remedy))
            }
            _ => Ok(mask),
        }
    }

    /// The colour picture `entry`; `None` if it has no colours.
    pub(super) fn color(
        &self,
        topic: &PictureTopic,
        entry: &FrameEntry,
    ) -> Result<Option<ColorImage>, RecordingError> {
        let size = self.camera.map(|camera| (camera.width(), camera.height()));
        let check = |width, height| match size.filter(|size| *size != (width, height)) {
            None => Ok(()),
            Some((w, h)) => {
                let problem = format!("the picture is {width} x {height}, the camera {w} x {h}");
                Err(WireProblem::new("width", problem))
            }
        };
        if topic.message_type == types::COMPRESSED_IMAGE {
            let bytes = self.bag.read(entry.locator)?;
            let read = WireReader::new(&topic.encoding, &bytes)
                .and_then(|mut reader| CompressedImageMessage::read(&mut reader))
                .and_then(|message| {
                    // Before it is decoded: a few bytes may claim many pixels.
                    message.size().map_or(Ok(()), |(width, height)| check(width, height))?;
                    color(message.data)
                })
                .and_then(|color| check(color.width, color.height).map(|()| color));
            return read.map(Some).map_err(|problem| self.unreadable(topic, entry, problem));
        }
        self.image(topic, entry, |image| {
            let (width, height) = (image.width, image.height);
            check(width, height)?;
            Ok(image.rgb()?.map(|rgb| ColorImage { width, height, rgb }))
        })
    }

    /// Reads a message with a picture and makes something of it.
    fn image<T>(
        &self,
        topic: &PictureTopic,
        entry: &FrameEntry,
        make: impl FnOnce(&ImageMessage<'_>) -> Result<T, WireProblem>,
    ) -> Result<T, RecordingError> {
        let bytes = self.bag.read(entry.locator)?;
        let made = WireReader::new(&topic.encoding, &bytes)
            .and_then(|mut reader| ImageMessage::read(&mut reader))
            .and_then(|image| make(&image));
        made.map_err(|problem| self.unreadable(topic, entry, problem))
    }

    fn unreadable(
        &self,
        topic: &PictureTopic,
        entry: &FrameEntry,
        WireProblem { field, problem }: WireProblem,
    ) -> RecordingError {
        self.invalid(&format!("{}: {field}", topic.field(entry)), problem, "Record it again")
    }

    fn invalid(&self, field: &str, problem: impl Into<String>, remedy: &str) -> RecordingError {
        RecordingError::invalid(self.path, field, problem, remedy)
    }
}

/// Depth of `unit` that was taken for `read_as`.
fn in_unit(mut depth_m: Vec<f32>, unit: DepthUnit, read_as: DepthUnit) -> Vec<f32> {
    if unit != read_as {
        let factor = (unit.metres() / read_as.metres()) as f32;
        depth_m.iter_mut().for_each(|depth| *depth *= factor);
    }
    depth_m
}

/// Points, with width and height.
type Points = (Vec<[f32; 3]>, (u32, u32));
