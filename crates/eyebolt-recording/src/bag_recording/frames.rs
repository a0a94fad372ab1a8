//! Frames of a bag, from their messages.

use super::scan::{FrameEntry, TopicScan};
use super::{BagRecording, clouds};
use crate::bag::Locator;
use crate::color::ColorImage;
use crate::error::RecordingError;
use crate::frame::{Frame, Range};
use crate::frame_source::FrameSource;
use crate::manifest::{CloudFrame, Unit};
use crate::message::{
    CloudMessage, CompressedImageMessage, ImageMessage, WireProblem, WireReader, types,
};
use crate::unit_check::check_unit;
use eyebolt_geometry::{Cloud, DepthImage, Mask};
use nalgebra::Point3;

/// Pictures belong to a frame that are stamped no further from it than this, nanoseconds.
const SAME_MOMENT_NS: u64 = 50_000_000;

impl BagRecording {
    /// Reads frame `index`, counted from 0 among those that take part.
    ///
    /// # Errors
    ///
    /// No such frame; a message that cannot be read, does not fit the camera or cannot be in its
    /// unit; an empty mask.
    pub(super) fn frame(&self, index: usize) -> Result<Frame, RecordingError> {
        let joints = self.read_joints(index)?;
        let entry = self.entry(index)?;
        let range = self.range(&entry)?;
        let mask = self.mask(&entry, &range)?;
        let name = self.names.get(index).cloned().unwrap_or_default();
        Ok(Frame { name, range, mask, joints })
    }

    /// Reads the colour picture of frame `index`; `None` if there is none of that moment.
    ///
    /// # Errors
    ///
    /// No such frame, or a message that cannot be read.
    pub(super) fn color(&self, index: usize) -> Result<Option<ColorImage>, RecordingError> {
        let entry = self.entry(index)?;
        let Some(number) = self.chosen.color else { return Ok(None) };
        let Some(picture) = nearest(&self.colors, entry.stamp_ns) else { return Ok(None) };
        let size = self.camera().map(|camera| (camera.width(), camera.height()));
        self.image(number, picture.locator, |image| {
            let (width, height) = (image.width, image.height);
            if let Some((w, h)) = size.filter(|size| *size != (width, height)) {
                let problem = format!("the picture is {width} x {height}, the camera {w} x {h}");
                return Err(WireProblem::new("width", problem));
            }
            Ok(image.rgb()?.map(|rgb| ColorImage { width, height, rgb }))
        })
    }

    fn entry(&self, index: usize) -> Result<FrameEntry, RecordingError> {
        let kept = self.kept(index)?;
        let entry = self.entries(self.chosen.range).get(kept.index);
        Ok(entry.expect("frames that take part are of the topic").clone())
    }

    /// Depth image or cloud of a frame, in the optical frame.
    fn range(&self, entry: &FrameEntry) -> Result<Range, RecordingError> {
        let topic = self.range_topic();
        if topic.message_type == types::CLOUD {
            let bytes = self.bag.read(entry.locator)?;
            let cloud = WireReader::new(&topic.encoding, &bytes)
                .and_then(|mut reader| CloudMessage::read(&mut reader))
                .and_then(|cloud| Ok((cloud.points()?, (cloud.width, cloud.height))));
            let (points, size) =
                cloud.map_err(|problem| self.unreadable_frame(topic, entry, &problem))?;
            return self.cloud(entry, points, size).map(Range::Cloud);
        }
        let image = self.depth_image(topic, entry)?;
        // Of most kinds the scan saw that.
        match image.depth_m().iter().any(|depth| *depth > 0.0) {
            true => Ok(Range::Depth(image)),
            false => Err(self.empty_frame(entry)),
        }
    }

    /// A depth image of a topic, whether or not it saw anything.
    pub(super) fn depth_image(
        &self,
        topic: &TopicScan,
        entry: &FrameEntry,
    ) -> Result<DepthImage, RecordingError> {
        let bytes = self.bag.read(entry.locator)?;
        let wrong = |problem: WireProblem| self.unreadable_frame(topic, entry, &problem);
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
        let unit = if in_millimetres { Unit::Millimetres } else { Unit::Metres };
        self.check_depth(topic, entry, size, &depth_m, unit)?;
        let (width, height) = size;
        DepthImage::new(width, height, depth_m)
            .map_err(|error| wrong(WireProblem::new("data", error.to_string())))
    }

    fn empty_frame(&self, entry: &FrameEntry) -> RecordingError {
        RecordingError::EmptyFrame {
            path: self.path.clone(),
            field: frame_field(self.range_topic(), entry),
        }
    }

    fn check_depth(
        &self,
        topic: &TopicScan,
        entry: &FrameEntry,
        (width, height): (u32, u32),
        depth_m: &[f32],
        unit: Unit,
    ) -> Result<(), RecordingError> {
        let field = frame_field(topic, entry);
        let camera = self.camera().filter(|c| (c.width(), c.height()) != (width, height));
        if let Some(camera) = camera {
            let (w, h) = (camera.width(), camera.height());
            let problem =
                format!("the image is {width} x {height}, but its camera info is {w} x {h}");
            let remedy = "Give the camera info of the depth with --camera-info-topic or \
                          --camera-info";
            return Err(self.invalid(&field, problem, remedy));
        }
        check_unit(&self.path, &field, unit, depth_m.iter().copied()).map_err(|error| {
            let remedy =
                "Correct the driver: 16UC1 is in millimetres and 32FC1 in metres (REP 118)";
            self.invalid(&field, error.problem(), remedy)
        })
    }

    /// The same frame for all clouds: that of the first one of use.
    pub(super) fn find_cloud_frame(&mut self) -> Result<(), RecordingError> {
        let topic = self.range_topic();
        if topic.message_type != types::CLOUD || self.cloud_frame.is_some() {
            return Ok(());
        }
        let Some(entry) = self.paired.kept.first().map(|kept| kept.index) else { return Ok(()) };
        let Some(entry) = self.entries(self.chosen.range).get(entry) else { return Ok(()) };
        let bytes = self.bag.read(entry.locator)?;
        let points = WireReader::new(&topic.encoding, &bytes)
            .and_then(|mut reader| CloudMessage::read(&mut reader)?.points())
            .map_err(|problem| self.unreadable_frame(topic, entry, &problem))?;
        let frame = clouds::frame_of(topic.frame_id.as_deref(), &points).map_err(|problem| {
            let remedy = "Give --cloud-frame optical (x right, y down, z forward) or body \
                          (x forward, y left, z up)";
            self.invalid(&frame_field(topic, entry), problem, remedy)
        })?;
        self.cloud_frame = Some(frame);
        Ok(())
    }

    fn cloud(
        &self,
        entry: &FrameEntry,
        points: Vec<[f32; 3]>,
        (width, height): (u32, u32),
    ) -> Result<Cloud, RecordingError> {
        let topic = self.range_topic();
        let field = frame_field(topic, entry);
        check_unit(&self.path, &field, Unit::Metres, points.iter().map(norm)).map_err(|error| {
            let remedy = "Correct the driver: points are in metres (REP 118)";
            self.invalid(&field, error.problem(), remedy)
        })?;
        // Found when the bag was opened, unless no cloud could be read.
        let frame = self.cloud_frame.unwrap_or(CloudFrame::Optical);
        let points: Vec<Point3<f32>> =
            points.into_iter().map(|xyz| crate::cloud::optical(xyz, frame)).collect();
        if height <= 1 {
            return Ok(Cloud::new(points));
        }
        let cloud = Cloud::organised(width, height, points);
        cloud.map_err(|error| self.invalid(&field, error.to_string(), "Record it again"))
    }

    fn mask(&self, entry: &FrameEntry, range: &Range) -> Result<Option<Mask>, RecordingError> {
        let Some(number) = self.chosen.mask else { return Ok(None) };
        let Some(picture) = nearest(&self.masks, entry.stamp_ns) else { return Ok(None) };
        let mask = self.image(number, picture.locator, |image| image.mask())?;
        match range.size() {
            None => {
                let problem =
                    "the cloud is a list of points, and no pixel of a mask belongs to one";
                let field = frame_field(self.range_topic(), entry);
                let remedy = "Record clouds of rows and columns, or none of masks";
                Err(self.invalid(&field, problem.to_owned(), remedy))
            }
            Some(size) if size != (mask.width(), mask.height()) => {
                let (w, h) = (mask.width(), mask.height());
                let problem = format!("the mask is {w} x {h}, the frame {} x {}", size.0, size.1);
                let field = frame_field(self.topic(number), &picture);
                Err(self.invalid(&field, problem, "Both must be of the same camera and size"))
            }
            _ => Ok(Some(mask)),
        }
    }

    /// Reads a message with a picture and makes something of it.
    fn image<T>(
        &self,
        number: usize,
        locator: Locator,
        make: impl FnOnce(&ImageMessage<'_>) -> Result<T, WireProblem>,
    ) -> Result<T, RecordingError> {
        let topic = self.topic(number);
        let bytes = self.bag.read(locator)?;
        let made = WireReader::new(&topic.encoding, &bytes)
            .and_then(|mut reader| ImageMessage::read(&mut reader))
            .and_then(|image| make(&image));
        made.map_err(|problem| self.unreadable(topic, &problem))
    }

    fn unreadable_frame(
        &self,
        topic: &TopicScan,
        entry: &FrameEntry,
        problem: &WireProblem,
    ) -> RecordingError {
        let field = format!("{}: {}", frame_field(topic, entry), problem.field);
        self.invalid(&field, problem.problem.clone(), "Record it again")
    }
}

fn frame_field(topic: &TopicScan, entry: &FrameEntry) -> String {
    format!("{} at {:.3} s", topic.name, entry.stamp_ns as f64 * 1e-9)
}

fn norm([x, y, z]: &[f32; 3]) -> f32 {
    x.hypot(*y).hypot(*z)
}

/// The picture of the moment `stamp_ns`, if there is one among those sorted by stamp.
fn nearest(sorted: &[FrameEntry], stamp_ns: i64) -> Option<FrameEntry> {
    let after = sorted.partition_point(|entry| entry.stamp_ns < stamp_ns);
    let around = sorted.get(after.saturating_sub(1)..).unwrap_or_default().iter().take(2);
    let nearest = around.min_by_key(|entry| entry.stamp_ns.abs_diff(stamp_ns));
    nearest.filter(|entry| entry.stamp_ns.abs_diff(stamp_ns) <= SAME_MOMENT_NS).cloned()
}
