//! The depth image that one message has.

use crate::bag::{Encoding, ros_type};
use crate::message::{
    CompressedImageMessage, ImageMessage, WireProblem, WireReader, is_depth_encoding, types,
};
use eyebolt_geometry::DepthImage;

/// The depth image in a message in CDR of the type `message_type`, metres if it is stored as REP 118 says; `None` of
/// messages that are no pictures of depth, which clouds are not either.
///
/// # Errors
///
/// What is wrong with a message that is not of its type: the field, and how.
pub fn message_depth(message_type: &str, data: &[u8]) -> Result<Option<DepthImage>, String> {
    look(&ros_type(message_type), data)
        .map_err(|WireProblem { field, problem }| format!("{field}: {problem}"))
}

fn look(message_type: &str, data: &[u8]) -> Result<Option<DepthImage>, WireProblem> {
    let reader = || WireReader::new(&Encoding::Cdr, data);
    let (width, height, depth_m) = match message_type {
        types::IMAGE => {
            let image = ImageMessage::read(&mut reader()?)?;
            if !is_depth_encoding(image.encoding) {
                return Ok(None);
            }
            (image.width, image.height, image.depth_m()?.0)
        }
        types::COMPRESSED_IMAGE => {
            let image = CompressedImageMessage::read(&mut reader()?)?;
            if !image.is_depth() {
                return Ok(None);
            }
            let depth = image.depth()?;
            (depth.width, depth.height, depth.depth_m)
        }
        _ => return Ok(None),
    };
    let image = DepthImage::new(width, height, depth_m);
    image.map(Some).map_err(|error| WireProblem::new("data", error.to_string()))
}
