//! Messages of a bag into another.

use super::error::WriteError;
use super::mcap::McapWriter;
use super::recording_writer::DESCRIPTION;
use super::robot::WriteRobot;
use crate::bag::{Encoding, Message};
use crate::bag_recording::CopySource;
use crate::camera_info::camera_info_message;
use crate::error::RecordingError;
use crate::message::{
    CameraInfoMessage, CloudMessage, CompressedImageMessage, Header, ImageMessage,
    JointStateMessage, WireProblem, WireReader, text, text_message, transforms, types,
    write_transforms,
};
use crate::progress::Progress;
use std::borrow::Cow;
use std::io::{Seek, Write};

/// Copies the messages of the topics that make the recording, and of `/tf_static`. A robot
/// description of its own stays out where `robot` has another.
pub(super) fn bag<W: Write + Seek>(
    bag: CopySource<'_>,
    robot: &WriteRobot,
    writer: &mut McapWriter<W>,
    progress: &dyn Progress,
) -> Result<(), WriteError> {
    let total = bag.message_count();
    let (mut done, mut failed) = (0, None);
    let urdf = other_description(bag, robot);
    let mut extra = Extra { bag, urdf, written: false };
    let scanned = bag.scan_again(&mut |message| {
        done += 1;
        let mut copy = || {
            progress.advance(done, total)?;
            extra.before(message, writer)?;
            // Of the topics that make a recording only the description is text.
            let replaced = urdf.is_some() && message.topic.message_type == types::STRING;
            if bag.is_chosen(message.topic) && !replaced {
                one(bag, message, writer)?;
            }
            Ok(())
        };
        copy().map_err(|error: WriteError| {
            failed = Some(error);
            // Ends the scan; the error that counts is kept above.
            RecordingError::invalid(bag.path(), "", "", "")
        })
    });
    match failed {
        Some(error) => Err(error),
        None => Ok(scanned?),
    }
}

/// The description to write in the place of the bag's; `None` where they are the same, which is then
/// copied with the time that it has.
fn other_description<'a>(bag: CopySource<'_>, robot: &'a WriteRobot) -> Option<&'a str> {
    let own = bag.robot().description.as_deref();
    robot.urdf.as_deref().filter(|urdf| own != Some(*urdf))
}

/// What was given instead of what the bag has: written once, before the first message.
struct Extra<'a> {
    bag: CopySource<'a>,
    urdf: Option<&'a str>,
    written: bool,
}

impl Extra<'_> {
    fn before<W: Write + Seek>(
        &mut self,
        message: &Message<'_>,
        writer: &mut McapWriter<W>,
    ) -> Result<(), WriteError> {
        if std::mem::replace(&mut self.written, true) {
            return Ok(());
        }
        let time_ns = message.log_time_ns;
        if let Some(urdf) = self.urdf {
            writer.write(DESCRIPTION, types::STRING, time_ns, &text_message(urdf))?;
        }
        if let Some((camera, topic)) = self.bag.given_camera() {
            let frame_id = self.bag.camera_frame_id().unwrap_or_default();
            let header = Header { stamp_ns: time_ns, frame_id };
            let data = camera_info_message(camera, header).write();
            writer.write(topic, types::CAMERA_INFO, time_ns, &data)?;
        }
        Ok(())
    }
}

fn one<W: Write + Seek>(
    bag: CopySource<'_>,
    message: &Message<'_>,
    writer: &mut McapWriter<W>,
) -> Result<(), WriteError> {
    let kind = message.topic.message_type.as_str();
    let kind = if kind == types::OLD_TRANSFORMS { types::TRANSFORMS } else { kind };
    let data = in_cdr(message).map_err(|problem| {
        let field = format!("{}: {}", message.topic.name, problem.field);
        RecordingError::invalid(bag.path(), field, problem.problem, "Record it again")
    });
    match data {
        Ok(data) => {
            // A robot description has one name among ours, whatever the driver's.
            let description = kind == types::STRING;
            let topic = if description { DESCRIPTION } else { &message.topic.name };
            writer.write(topic, kind, message.log_time_ns, &data)
        }
        // Allowed to be passed over, or the bag would not have opened.
        Err(_) if bag.is_partial() => Ok(()),
        Err(error) => Err(error.into()),
    }
}

/// The message as ROS 2 writes it.
fn in_cdr<'a>(message: &Message<'a>) -> Result<Cow<'a, [u8]>, WireProblem> {
    if message.topic.encoding == Encoding::Cdr {
        return Ok(Cow::Borrowed(message.data));
    }
    let mut reader = WireReader::new(&message.topic.encoding, message.data)?;
    let reader = &mut reader;
    Ok(Cow::Owned(match message.topic.message_type.as_str() {
        types::IMAGE => ImageMessage::read(reader)?.write(),
        types::COMPRESSED_IMAGE => CompressedImageMessage::read(reader)?.write(),
        types::CLOUD => CloudMessage::read(reader)?.write(),
        types::CAMERA_INFO => CameraInfoMessage::read(reader)?.write(),
        types::JOINT_STATE => JointStateMessage::read(reader)?.write(),
        types::STRING => text_message(text(reader)?),
        _ => write_transforms(&transforms(reader)?, message.log_time_ns),
    }))
}
