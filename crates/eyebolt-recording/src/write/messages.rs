//! What a recording is made of, as messages.

use crate::color::ColorImage;
use crate::message::{CloudMessage, Header, ImageMessage, JointStateMessage, PointField};
use eyebolt_geometry::{Cloud, DepthImage, Mask};
use eyebolt_robot::JointPositions;

pub(super) fn joints(joints: &JointPositions, stamp_ns: i64) -> Vec<u8> {
    let (names, positions) = joints.iter().unzip();
    JointStateMessage { header: Header { stamp_ns, frame_id: "" }, names, positions }.write()
}

pub(super) fn depth(header: Header<'_>, depth: &DepthImage, in_millimetres: bool) -> Vec<u8> {
    let size = (depth.width(), depth.height());
    if in_millimetres {
        let values = depth.depth_m().iter().map(|z| (1e3 * z).round() as u16);
        let data: Vec<u8> = values.flat_map(u16::to_le_bytes).collect();
        return image(header, size, "16UC1", 2, &data).write();
    }
    let data: Vec<u8> = depth.depth_m().iter().flat_map(|z| z.to_le_bytes()).collect();
    image(header, size, "32FC1", 4, &data).write()
}

pub(super) fn mask(header: Header<'_>, mask: &Mask) -> Vec<u8> {
    let grey: Vec<u8> = mask.as_slice().iter().map(|set| 255 * u8::from(*set)).collect();
    image(header, (mask.width(), mask.height()), "mono8", 1, &grey).write()
}

pub(super) fn color(header: Header<'_>, color: &ColorImage) -> Vec<u8> {
    image(header, (color.width, color.height), "rgb8", 3, color.rgb.as_flattened()).write()
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

pub(super) fn cloud(header: Header<'_>, cloud: &Cloud) -> Vec<u8> {
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
