//! Frames of a folder as messages.

use super::mcap::McapWriter;
use super::{WriteError, WriteProgress, WriteRobot, tell};
use crate::bag_recording::BagRecording;
use crate::camera_info::camera_info_message;
use crate::frame::{Frame, Range};
use crate::message::{
    CloudMessage, Header, ImageMessage, JointStateMessage, PointField, WireWriter, types,
};
use crate::recording::Recording;
use eyebolt_geometry::{Cloud, DepthImage};
use eyebolt_robot::JointPositions;
use std::collections::BTreeMap;
use std::io::{Seek, Write};

const DEPTH: &str = "/camera/depth/image_raw";
const CLOUD: &str = "/camera/depth/points";
const CAMERA_INFO: &str = "/camera/depth/camera_info";
const MASK: &str = "/camera/depth/mask";
const COLOR: &str = "/camera/color/image_raw";
const JOINTS: &str = "/joint_states";
pub(super) const DESCRIPTION: &str = "/robot_description";
/// The frame of recordings that name none.
const OPTICAL_FRAME: &str = "camera_depth_optical_frame";
/// From one frame to the next; the first is not at zero, which would mean "no stamp".
const STEP_NS: i64 = 1_000_000_000;

/// What eyebolt knows of a recording that no message says.
pub(super) fn metadata(recording: &Recording, robot: &WriteRobot) -> BTreeMap<String, String> {
    let mut values = recording.bag().map(BagRecording::metadata).unwrap_or_default();
    values.insert("schema".to_owned(), "eyebolt.recording/1".to_owned());
    let known = recording.robot();
    let mut add = |key: &str, value: Option<&String>| {
        if let Some(value) = value {
            values.insert(key.to_owned(), value.clone());
        }
    };
    add("base", robot.base.as_ref().or(known.base.as_ref()));
    add("end_effector", robot.end_effector.as_ref().or(known.end_effector.as_ref()));
    if let Recording::Folder(folder) = recording {
        let names = serde_json::to_string(folder.frame_names());
        add("frame_names", names.ok().as_ref());
    }
    values
}

/// Writes every frame of `recording`.
pub(super) fn write<W: Write + Seek>(
    recording: &Recording,
    robot: &WriteRobot,
    writer: &mut McapWriter<W>,
    progress: &mut WriteProgress<'_>,
) -> Result<(), WriteError> {
    let frame_id = recording.camera_frame_id().unwrap_or(OPTICAL_FRAME);
    if let Some(urdf) = &robot.urdf {
        description(writer, urdf, STEP_NS)?;
    }
    let total = recording.frame_names().len();
    for (index, stamp_ns) in (0..total).zip((1..).map(|second| second * STEP_NS)) {
        tell(progress, index, total)?;
        let header = Header { stamp_ns, frame_id };
        let frame = recording.read_frame(index)?;
        if let Some(camera) = recording.camera() {
            let data = camera_info_message(camera, header).write();
            writer.write(CAMERA_INFO, types::CAMERA_INFO, stamp_ns, &data)?;
        }
        // Joints first: whoever plays the recording poses the arm before it sees it.
        writer.write(JOINTS, types::JOINT_STATE, stamp_ns, &joints(&frame.joints, stamp_ns))?;
        range(writer, header, &frame, recording.in_millimetres())?;
        if let Some(mask) = &frame.mask {
            let grey: Vec<u8> = mask.as_slice().iter().map(|set| 255 * u8::from(*set)).collect();
            let image = image(header, (mask.width(), mask.height()), "mono8", 1, &grey);
            writer.write(MASK, types::IMAGE, stamp_ns, &image.write())?;
        }
        if let Some(color) = recording.read_color(index)? {
            let size = (color.width, color.height);
            let image = image(header, size, "rgb8", 3, color.rgb.as_flattened());
            writer.write(COLOR, types::IMAGE, stamp_ns, &image.write())?;
        }
    }
    tell(progress, total, total)
}

pub(super) fn description<W: Write + Seek>(
    writer: &mut McapWriter<W>,
    urdf: &str,
    log_time_ns: i64,
) -> Result<(), WriteError> {
    let mut message = WireWriter::new();
    message.string(urdf);
    writer.write(DESCRIPTION, types::STRING, log_time_ns, &message.finish())
}

fn joints(joints: &JointPositions, stamp_ns: i64) -> Vec<u8> {
    let (names, positions) = joints.iter().unzip();
    JointStateMessage { header: Header { stamp_ns, frame_id: "" }, names, positions }.write()
}

fn range<W: Write + Seek>(
    writer: &mut McapWriter<W>,
    header: Header<'_>,
    frame: &Frame,
    in_millimetres: bool,
) -> Result<(), WriteError> {
    match &frame.range {
        Range::Depth(depth) => {
            let data = depth_message(header, depth, in_millimetres);
            writer.write(DEPTH, types::IMAGE, header.stamp_ns, &data)
        }
        Range::Cloud(cloud) => {
            let data = cloud_message(header, cloud);
            writer.write(CLOUD, types::CLOUD, header.stamp_ns, &data)
        }
    }
}

fn depth_message(header: Header<'_>, depth: &DepthImage, in_millimetres: bool) -> Vec<u8> {
    let size = (depth.width(), depth.height());
    if in_millimetres {
        let values = depth.depth_m().iter().map(|z| (1e3 * z).round() as u16);
        let data: Vec<u8> = values.flat_map(u16::to_le_bytes).collect();
        return image(header, size, "16UC1", 2, &data).write();
    }
    let data: Vec<u8> = depth.depth_m().iter().flat_map(|z| z.to_le_bytes()).collect();
    image(header, size, "32FC1", 4, &data).write()
}

fn image<'a>(
    header: Header<'a>,
    (width, height): (u32, u32),
    encoding: &'a str,
    pixel_size: u32,
    data: &'a [u8],
) -> ImageMessage<'a> {
    let step = width.saturating_mul(pixel_size);
    ImageMessage { header, height, width, encoding, big_endian: false, step, data }
}

fn cloud_message(header: Header<'_>, cloud: &Cloud) -> Vec<u8> {
    const POINT: u32 = 12;
    let count = u32::try_from(cloud.points().len()).unwrap_or(u32::MAX);
    let (width, height) = cloud.grid().unwrap_or((count, 1));
    let field = |name, offset| PointField { name, offset, datatype: 7, count: 1 };
    let bytes = cloud.points().iter().flat_map(|p| [p.x, p.y, p.z]).flat_map(f32::to_le_bytes);
    CloudMessage {
        header,
        height,
        width,
        fields: vec![field("x", 0), field("y", 4), field("z", 8)],
        big_endian: false,
        point_step: POINT,
        row_step: width.saturating_mul(POINT),
        data: &bytes.collect::<Vec<_>>(),
        is_dense: cloud.count_valid() == cloud.points().len(),
    }
    .write()
}
