//! Records of MCAP: what schemas, channels and messages say.

use super::fields::Fields;
use crate::bag::message::{Location, Message};
use crate::bag::topic::{Encoding, Topic, ros_type};
use crate::error::RecordingError;
use mcap::records::op;
use std::collections::BTreeMap;

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
#[derive(Debug, Default)]
pub(super) struct Topics {
    met: Numbers,
    /// From the summary, for messages whose channel stood in a chunk that is damaged.
    summarised: Numbers,
    topics: Vec<Topic>,
    /// Where in `topics` each is.
    index_of: BTreeMap<Topic, usize>,
}

/// What numbers mean in one part of the file.
#[derive(Debug, Default)]
struct Numbers {
    /// Message types.
    schemas: BTreeMap<u16, String>,
    /// Which of the topics a channel's messages belong to.
    channels: BTreeMap<u16, usize>,
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
        place: &dyn Fn(u64, u32) -> Location,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damaged: &dyn Fn(String) -> RecordingError,
    ) -> Result<(), Stop> {
        if opcode != op::MESSAGE {
            let defined = self.define(opcode, body, false);
            return defined.map_err(|problem| Stop::Damage(damaged(problem)));
        }
        let message = self.message(body, place);
        each(&message.map_err(|problem| Stop::Damage(damaged(problem)))?).map_err(Stop::Wanted)
    }

    /// Takes in a record of the summary.
    pub(super) fn summary(&mut self, opcode: u8, body: &[u8]) {
        // Only a help: the file is read without.
        drop(self.define(opcode, body, true));
    }

    fn message<'a>(
        &'a self,
        body: &'a [u8],
        place: &dyn Fn(u64, u32) -> Location,
    ) -> Result<Message<'a>, String> {
        let mut fields = Fields::new(body);
        let channel = fields.u16()?;
        let (_sequence, log_time, _publish_time) = (fields.u32()?, fields.u64()?, fields.u64()?);
        let data = fields.rest();
        let index = self.met.channels.get(&channel).or(self.summarised.channels.get(&channel));
        let Some((index, topic)) = index.and_then(|i| Some((*i, self.topics.get(*i)?))) else {
            return Err(format!("a message of channel {channel}, which is not known"));
        };
        let length = u32::try_from(data.len()).unwrap_or(u32::MAX);
        Ok(Message {
            topic,
            topic_index: index,
            log_time_ns: i64::try_from(log_time).unwrap_or(i64::MAX),
            place: place(MESSAGE_HEADER, length),
            data,
        })
    }

    /// Takes in a schema or channel; the others tell nothing of messages.
    fn define(&mut self, opcode: u8, body: &[u8], summary: bool) -> Result<(), String> {
        let mut fields = Fields::new(body);
        let numbers = if summary { &mut self.summarised } else { &mut self.met };
        match opcode {
            op::SCHEMA => {
                let (id, name) = (fields.u16()?, ros_type(fields.text()?));
                let known = numbers.schemas.entry(id).or_insert_with(|| name.clone());
                same(*known == name, || format!("schema {id} is defined twice"))
            }
            op::CHANNEL => {
                let (id, schema) = (fields.u16()?, fields.u16()?);
                let name = fields.text()?.to_owned();
                let encoding = match fields.text()? {
                    "cdr" => Encoding::Cdr,
                    "ros1" => Encoding::Ros1,
                    other => Encoding::Other(other.to_owned()),
                };
                let summarised = || self.summarised.schemas.get(&schema);
                let message_type = match self.met.schemas.get(&schema).or_else(summarised) {
                    Some(name) => name.clone(),
                    // Zero is of messages that need none.
                    None if schema == 0 => String::new(),
                    None => return Err(format!("a channel of schema {schema}, which is unknown")),
                };
                let topic = Topic { name, message_type, encoding };
                // Chunks repeat their channels, and several publishers share a topic.
                let index = *self.index_of.entry(topic).or_insert_with_key(|topic| {
                    self.topics.push(topic.clone());
                    self.topics.len() - 1
                });
                let numbers = if summary { &mut self.summarised } else { &mut self.met };
                let known = *numbers.channels.entry(id).or_insert(index);
                same(known == index, || format!("channel {id} is defined twice"))
            }
            _ => Ok(()),
        }
    }
}

/// A number may be defined again, if it stays the same.
fn same(same: bool, problem: impl FnOnce() -> String) -> Result<(), String> {
    if same { Ok(()) } else { Err(problem()) }
}

/// What a metadata record called `name` says; `None` of one with another name.
pub(super) fn metadata(
    body: &[u8],
    name: &str,
) -> Result<Option<BTreeMap<String, String>>, String> {
    let mut fields = Fields::new(body);
    if fields.text()? != name {
        return Ok(None);
    }
    let length = u64::from(fields.u32()?);
    let mut fields = Fields::new(fields.bytes(length)?);
    let mut entries = BTreeMap::new();
    while !fields.rest().is_empty() {
        entries.insert(fields.text()?.to_owned(), fields.text()?.to_owned());
    }
    Ok(Some(entries))
}
