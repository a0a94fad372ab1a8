//! What one message tells someone who waits for an arm to rest.

use crate::bag::{Encoding, ros_type};
use crate::message::{
    Header, ImageMessage, JointStateMessage, StaticTransform, WireProblem, WireReader,
    is_depth_encoding, text, transforms, types,
};
use eyebolt_robot::JointPositions;

/// What one message tells someone who waits for an arm to rest.
#[derive(Clone, Debug, PartialEq)]
pub enum Glimpse {
    /// Where joints are, radians, metres for prismatic ones.
    Joints {
        /// Nanoseconds; 0 where nobody set it.
        stamp_ns: i64,
        /// Those that have a position.
        positions: JointPositions,
    },
    /// A depth image.
    Depth {
        /// Nanoseconds; 0 where nobody set it.
        stamp_ns: i64,
        /// Depth of some pixels, the same ones in every image of a size, in whatever unit it is stored in; 0
        /// or not a number where there is none.
        samples: Vec<f32>,
    },
    /// A picture, and none of depth.
    Picture,
    /// The text of a robot description.
    Description(String),
    /// Transforms that never change.
    Transforms(Vec<StaticTransform>),
    /// Nothing: the message is of another kind.
    Other,
}

/// Pixels that tell whether something moves.
const SAMPLES: usize = 4096;

/// Looks at a message in CDR of the type `message_type`, as in `sensor_msgs/msg/Image`.
///
/// # Errors
///
/// What is wrong with a message that is not of its type: the field, and how.
pub fn glimpse(message_type: &str, data: &[u8]) -> Result<Glimpse, String> {
    look(&ros_type(message_type), data)
        .map_err(|WireProblem { field, problem }| format!("{field}: {problem}"))
}

fn look(message_type: &str, data: &[u8]) -> Result<Glimpse, WireProblem> {
    let reader = || WireReader::new(&Encoding::Cdr, data);
    Ok(match message_type {
        types::JOINT_STATE => {
            let message = JointStateMessage::read(&mut reader()?)?;
            let told = message.names.iter().zip(&message.positions);
            let told = told.filter(|(_, position)| position.is_finite());
            let positions = told.map(|(name, position)| ((*name).to_owned(), *position)).collect();
            Glimpse::Joints { stamp_ns: message.header.stamp_ns, positions }
        }
        types::IMAGE => {
            let image = ImageMessage::read(&mut reader()?)?;
            if !is_depth_encoding(image.encoding) {
                return Ok(Glimpse::Picture);
            }
            let samples = image.depth_samples(SAMPLES)?;
            Glimpse::Depth { stamp_ns: image.header.stamp_ns, samples }
        }
        types::CLOUD | types::COMPRESSED_IMAGE => {
            // Whether something moves is not told by points without order, or before they are unpacked.
            let stamp_ns = Header::read(&mut reader()?)?.stamp_ns;
            Glimpse::Depth { stamp_ns, samples: Vec::new() }
        }
        types::STRING => Glimpse::Description(text(&mut reader()?)?.to_owned()),
        types::TRANSFORMS => Glimpse::Transforms(transforms(&mut reader()?)?),
        _ => Glimpse::Other,
    })
}
