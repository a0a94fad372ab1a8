//! Messages read as far as anybody reads them.

use crate::bag::Encoding;
use crate::message::{
    CameraInfoMessage, CloudMessage, CompressedImageMessage, ImageMessage, JointStateMessage,
    WireProblem, WireReader, text, transforms, types,
};

/// Reads a message of the type as far as anybody reads it, whatever it says.
pub(super) fn read(
    message_type: &str,
    encoding: &Encoding,
    bytes: &[u8],
) -> Result<(), WireProblem> {
    let mut reader = WireReader::new(encoding, bytes)?;
    let reader = &mut reader;
    match message_type {
        types::IMAGE => {
            let image = ImageMessage::read(reader)?;
            // Whatever the encoding, none of these may fall over.
            let _ = (image.has_depth(), image.rgb(), image.mask(), image.check());
            image.depth_m().map(drop)
        }
        types::COMPRESSED_IMAGE => CompressedImageMessage::read(reader)?.depth().map(drop),
        types::CLOUD => {
            let cloud = CloudMessage::read(reader)?;
            assert_eq!(cloud.has_point().is_err(), cloud.points().is_err() && !any(&cloud));
            cloud.points().map(drop)
        }
        types::CAMERA_INFO => CameraInfoMessage::read(reader).map(drop),
        types::JOINT_STATE => JointStateMessage::read(reader).map(drop),
        types::TRANSFORMS => transforms(reader).map(drop),
        _ => text(reader).map(drop),
    }
}

pub(super) fn any(cloud: &CloudMessage<'_>) -> bool {
    cloud.has_point() == Ok(true)
}
