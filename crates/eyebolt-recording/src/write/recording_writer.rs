//! A recording as MCAP, message by message: the one place that knows the topics of ours.

use super::definitions::TF_STATIC;
use super::error::WriteError;
use super::mcap::McapWriter;
use super::messages;
use crate::camera_info::camera_info_message;
use crate::color::ColorImage;
use crate::message::{Header, StaticTransform, text_message, types, write_transforms};
use crate::own_metadata::{self, BACKGROUND_TOPIC, SCHEMA};
use crate::truth::{self, Truth};
use eyebolt_geometry::{Cloud, DepthImage, Mask, PinholeCamera};
use eyebolt_robot::JointPositions;
use std::collections::BTreeMap;
use std::io::{Seek, Write};

const DEPTH: &str = "/camera/depth/image_raw";
const BACKGROUND: &str = "/camera/depth/background/image_raw";
const CLOUD: &str = "/camera/depth/points";
const CAMERA_INFO: &str = "/camera/depth/camera_info";
const MASK: &str = "/camera/depth/mask";
const COLOR: &str = "/camera/color/image_raw";
const JOINTS: &str = "/joint_states";
pub(super) const DESCRIPTION: &str = "/robot_description";

/// Stamps are of 32 bits of seconds, and none are negative in files.
const LAST_STAMP_NS: i64 = (i32::MAX as i64) * 1_000_000_000;

/// What is the same throughout a recording.
#[derive(Clone, Copy, Debug)]
pub struct RecordingInfo<'a> {
    /// Intrinsics of the depth.
    pub camera: &'a PinholeCamera,
    /// Name of the camera's optical frame.
    pub camera_frame_id: &'a str,
    /// Whether depth is stored in whole millimetres (`16UC1`, up to 65.534 m) or, bit by bit, in
    /// metres (`32FC1`).
    pub in_millimetres: bool,
    /// Transforms that never change, of the camera's frames and the robot's.
    pub static_transforms: &'a [StaticTransform],
    /// Text of the URDF.
    pub urdf: Option<&'a str>,
    /// Name of the base link.
    pub base: Option<&'a str>,
    /// Name of the end-effector link.
    pub end_effector: Option<&'a str>,
}

/// Writes a recording as MCAP with ROS 2 messages, one message after the other: memory holds one
/// chunk of the file, however long it becomes. The same calls write the same bytes.
///
/// Stamps are nanoseconds since 1970 (or since anything else), more than 0, which in ROS means that
/// nobody set one. Messages are written in the order of the calls, whatever their stamps; readers
/// want the stamps of each kind to rise.
pub struct RecordingWriter<W: Write + Seek> {
    writer: McapWriter<W>,
    camera: Option<PinholeCamera>,
    camera_frame_id: String,
    in_millimetres: bool,
    static_transforms: Vec<StaticTransform>,
    urdf: Option<String>,
    metadata: BTreeMap<String, String>,
    begun: bool,
}

/// As [`RecordingInfo`], for recordings that may be of clouds without a camera.
pub(super) struct Described<'a> {
    pub(super) camera: Option<&'a PinholeCamera>,
    pub(super) camera_frame_id: &'a str,
    pub(super) in_millimetres: bool,
    pub(super) static_transforms: &'a [StaticTransform],
    pub(super) urdf: Option<&'a str>,
    pub(super) metadata: BTreeMap<String, String>,
}

impl<W: Write + Seek> RecordingWriter<W> {
    /// A recording without messages.
    ///
    /// # Errors
    ///
    /// A failing `output`.
    pub fn new(output: W, info: &RecordingInfo<'_>) -> Result<Self, WriteError> {
        let schema = Some(SCHEMA);
        let known = [("schema", schema), ("base", info.base), ("end_effector", info.end_effector)];
        let known = known.into_iter().filter_map(|(key, value)| Some((key, value?)));
        Self::described(
            output,
            Described {
                camera: Some(info.camera),
                camera_frame_id: info.camera_frame_id,
                in_millimetres: info.in_millimetres,
                static_transforms: info.static_transforms,
                urdf: info.urdf,
                metadata: known.map(|(key, value)| (key.to_owned(), value.to_owned())).collect(),
            },
        )
    }

    pub(super) fn described(output: W, info: Described<'_>) -> Result<Self, WriteError> {
        Ok(Self {
            writer: McapWriter::new(output)?,
            camera: info.camera.cloned(),
            camera_frame_id: info.camera_frame_id.to_owned(),
            in_millimetres: info.in_millimetres,
            static_transforms: info.static_transforms.to_vec(),
            urdf: info.urdf.map(str::to_owned),
            metadata: info.metadata,
            begun: false,
        })
    }

    /// Writes a depth image, after the intrinsics of its moment.
    ///
    /// # Errors
    ///
    /// An image that is not of the camera's size, a stamp that no file can hold, a failing output.
    pub fn depth(&mut self, stamp_ns: i64, depth: &DepthImage) -> Result<(), WriteError> {
        self.check_size("depth", stamp_ns, (depth.width(), depth.height()))?;
        self.camera_info(stamp_ns)?;
        self.depth_on(DEPTH, stamp_ns, depth, self.in_millimetres)
    }

    /// Writes depth of the scene without the robot, or with the robot out of view: before, between
    /// or after the frames, as often as there are such images.
    ///
    /// # Errors
    ///
    /// As of [`Self::depth`].
    pub fn background(&mut self, stamp_ns: i64, depth: &DepthImage) -> Result<(), WriteError> {
        self.background_in(stamp_ns, depth, self.in_millimetres)
    }

    /// As [`Self::background`], stored in another unit than the frames.
    pub(super) fn background_in(
        &mut self,
        stamp_ns: i64,
        depth: &DepthImage,
        in_millimetres: bool,
    ) -> Result<(), WriteError> {
        self.check_size("background", stamp_ns, (depth.width(), depth.height()))?;
        if !self.metadata.contains_key(BACKGROUND_TOPIC) {
            // Told only where it is true: a topic that is named must be there.
            self.metadata.insert(BACKGROUND_TOPIC.to_owned(), BACKGROUND.to_owned());
            if self.begun {
                // Of several records the last one counts.
                self.writer.metadata(own_metadata::NAME, &self.metadata)?;
            }
        }
        self.depth_on(BACKGROUND, stamp_ns, depth, in_millimetres)
    }

    /// Writes the positions of joints (radians, metres for prismatic ones) at one moment. They may
    /// come much more often than depth, as from a robot.
    ///
    /// # Errors
    ///
    /// A stamp that no file can hold, a failing output.
    pub fn joints(&mut self, stamp_ns: i64, joints: &JointPositions) -> Result<(), WriteError> {
        let data = messages::joints(joints, stamp_ns);
        self.write(JOINTS, types::JOINT_STATE, "joints", stamp_ns, &data)
    }

    /// Writes which pixels of the depth of this stamp are the arm.
    ///
    /// # Errors
    ///
    /// As of [`Self::depth`].
    pub fn mask(&mut self, stamp_ns: i64, mask: &Mask) -> Result<(), WriteError> {
        self.check_size("mask", stamp_ns, (mask.width(), mask.height()))?;
        let data = messages::mask(self.header(stamp_ns), mask);
        self.write(MASK, types::IMAGE, "mask", stamp_ns, &data)
    }

    /// Writes the colour picture of the depth of this stamp, registered to it.
    ///
    /// # Errors
    ///
    /// As of [`Self::depth`], and a picture of another number of pixels than its size says.
    pub fn color(&mut self, stamp_ns: i64, color: &ColorImage) -> Result<(), WriteError> {
        self.check_size("color", stamp_ns, (color.width, color.height))?;
        if color.rgb.len() as u64 != u64::from(color.width) * u64::from(color.height) {
            let problem = format!("{} x {} is not its number of pixels", color.width, color.height);
            return Err(WriteError::Unfit { what: "color", stamp_ns, problem });
        }
        let data = messages::color(self.header(stamp_ns), color);
        self.write(COLOR, types::IMAGE, "color", stamp_ns, &data)
    }

    pub(super) fn cloud(&mut self, stamp_ns: i64, cloud: &Cloud) -> Result<(), WriteError> {
        self.camera_info(stamp_ns)?;
        let data = messages::cloud(self.header(stamp_ns), cloud);
        self.write(CLOUD, types::CLOUD, "cloud", stamp_ns, &data)
    }

    /// Writes what a simulation knows and a recording of the world never does, apart from all that
    /// readers of recordings look at. Of several the last one counts.
    ///
    /// # Errors
    ///
    /// A failing output.
    pub fn truth(&mut self, truth: &Truth) -> Result<(), WriteError> {
        self.truth_text(&truth.to_json())
    }

    pub(super) fn truth_text(&mut self, json: &str) -> Result<(), WriteError> {
        self.writer.metadata(truth::RECORD, &truth::record(json))
    }

    /// Writes what is left, and the index.
    ///
    /// # Errors
    ///
    /// A failing output.
    pub fn finish(mut self) -> Result<(), WriteError> {
        if !self.begun {
            self.writer.metadata(own_metadata::NAME, &self.metadata)?;
        }
        self.writer.finish()
    }

    fn header(&self, stamp_ns: i64) -> Header<'_> {
        Header { stamp_ns, frame_id: &self.camera_frame_id }
    }

    fn camera_info(&mut self, stamp_ns: i64) -> Result<(), WriteError> {
        let Some(camera) = &self.camera else { return Ok(()) };
        let data = camera_info_message(camera, self.header(stamp_ns)).write();
        self.write(CAMERA_INFO, types::CAMERA_INFO, "camera info", stamp_ns, &data)
    }

    fn depth_on(
        &mut self,
        topic: &str,
        stamp_ns: i64,
        depth: &DepthImage,
        in_millimetres: bool,
    ) -> Result<(), WriteError> {
        let data = messages::depth(self.header(stamp_ns), depth, in_millimetres);
        self.write(topic, types::IMAGE, "depth", stamp_ns, &data)
    }

    fn check_size(
        &self,
        what: &'static str,
        stamp_ns: i64,
        (width, height): (u32, u32),
    ) -> Result<(), WriteError> {
        let other = |camera: &&PinholeCamera| (camera.width(), camera.height()) != (width, height);
        let Some(camera) = self.camera.as_ref().filter(other) else { return Ok(()) };
        let (w, h) = (camera.width(), camera.height());
        let problem = format!("the image is {width} x {height}, but the camera {w} x {h}");
        Err(WriteError::Unfit { what, stamp_ns, problem })
    }

    fn write(
        &mut self,
        topic: &str,
        message_type: &str,
        what: &'static str,
        stamp_ns: i64,
        data: &[u8],
    ) -> Result<(), WriteError> {
        if !(1..=LAST_STAMP_NS).contains(&stamp_ns) {
            let problem = "a stamp is more than 0 and less than 2^31 seconds".to_owned();
            return Err(WriteError::Unfit { what, stamp_ns, problem });
        }
        if !self.begun {
            self.begun = true;
            self.writer.metadata(own_metadata::NAME, &self.metadata)?;
            // At the first moment of the recording: whoever plays it need not wait for the next.
            if let Some(urdf) = &self.urdf {
                let data = text_message(urdf);
                self.writer.write(DESCRIPTION, types::STRING, stamp_ns, &data)?;
            }
            if !self.static_transforms.is_empty() {
                let data = write_transforms(&self.static_transforms, stamp_ns);
                self.writer.write(TF_STATIC, types::TRANSFORMS, stamp_ns, &data)?;
            }
        }
        self.writer.write(topic, message_type, stamp_ns, data)
    }
}
