//! Records of MCAP: what schemas, channels and messages say.

use super::super::{Encoding, Message, Place, Topic, ros_type};
use super::MAGIC;
use crate::error::RecordingError;
use mcap::records::{Metadata, Record, op};
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// Reads the first bytes of a file, which tell that it is MCAP; returns how many these are.
pub(super) fn after_magic(path: &Path, reader: &mut impl Read) -> Result<u64, RecordingError> {
    let mut magic = [0; MAGIC.len()];
    let read = reader.read_exact(&mut magic);
    if read.is_err() || magic != MAGIC {
        let remedy = "Give the file that `ros2 bag record -s mcap` wrote";
        return Err(RecordingError::invalid(path, "magic", "the file is not MCAP", remedy));
    }
    Ok(MAGIC.len() as u64)
}

/// Why a record was not used.
pub(super) enum Stop {
    /// It is damaged, and the next one may not be.
    Damage(RecordingError),
    /// Whoever scans wants to stop.
    Wanted(RecordingError),
}

/// Asks `damage` about damaged records.
pub(super) fn or_damage(
    visited: Result<(), Stop>,
    damage: &mut dyn FnMut(RecordingError) -> Result<(), RecordingError>,
) -> Result<(), RecordingError> {
    match visited {
        Ok(()) => Ok(()),
        Err(Stop::Damage(error)) => damage(error),
        Err(Stop::Wanted(error)) => Err(error),
    }
}

/// Schemas and channels met so far.
#[derive(Default)]
pub(super) struct Topics {
    /// Message types by number.
    schemas: BTreeMap<u16, String>,
    /// Which of `topics` a channel's messages belong to.
    channels: BTreeMap<u16, usize>,
    topics: Vec<Topic>,
}

/// Bytes of a message before its data.
const MESSAGE_HEADER: u64 = 22;

impl Topics {
    /// Takes in one record; messages go to `each`. `place` tells where data lies that starts so
    /// many bytes into the body and is so long.
    pub(super) fn record(
        &mut self,
        opcode: u8,
        body: &[u8],
        place: &dyn Fn(u64, u32) -> Place,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damaged: &dyn Fn(String) -> RecordingError,
    ) -> Result<(), Stop> {
        // The others tell nothing of messages, and the library trusts some of their lengths.
        if !matches!(opcode, op::SCHEMA | op::CHANNEL | op::MESSAGE) {
            return Ok(());
        }
        let record = mcap::parse_record(opcode, body);
        let problem = |text: String| Stop::Damage(damaged(text));
        match record.map_err(|error| problem(error.to_string()))? {
            Record::Schema { header, .. } => {
                self.schemas.insert(header.id, ros_type(&header.name));
            }
            Record::Channel(channel) => self.channel(channel),
            Record::Message { header, data } => {
                let index = self.channels.get(&header.channel_id).copied();
                let Some((index, topic)) = index.and_then(|i| Some((i, self.topics.get(i)?)))
                else {
                    let id = header.channel_id;
                    return Err(problem(format!("a message of channel {id}, which is not known")));
                };
                let length = u32::try_from(data.len()).unwrap_or(u32::MAX);
                let message = Message {
                    topic,
                    topic_index: index,
                    log_time_ns: i64::try_from(header.log_time).unwrap_or(i64::MAX),
                    place: place(MESSAGE_HEADER, length),
                    data: &data,
                };
                each(&message).map_err(Stop::Wanted)?;
            }
            _ => {}
        }
        Ok(())
    }

    fn channel(&mut self, channel: mcap::records::Channel) {
        let topic = Topic {
            name: channel.topic,
            message_type: self.schemas.get(&channel.schema_id).cloned().unwrap_or_default(),
            encoding: match channel.message_encoding.as_str() {
                "cdr" => Encoding::Cdr,
                "ros1" => Encoding::Ros1,
                other => Encoding::Other(other.to_owned()),
            },
        };
        // Chunks repeat their channels, and several publishers share a topic.
        let known = self.topics.iter().position(|other| *other == topic);
        let index = known.unwrap_or_else(|| {
            self.topics.push(topic);
            self.topics.len() - 1
        });
        self.channels.insert(channel.id, index);
    }
}

/// What a metadata record says.
pub(super) fn metadata(body: &[u8]) -> Result<Metadata, String> {
    match mcap::parse_record(op::METADATA, body) {
        Ok(Record::Metadata(metadata)) => Ok(metadata),
        Ok(_) => Err("no metadata".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}
