//! Who publishes what: connections by their number in the file.

use super::fault::Fault;
use super::header::{Header, Op};
use super::source::Source;
use crate::bag::bytes::Bytes;
use crate::bag::topic::{Encoding, Topic};
use std::collections::HashMap;

/// Most connections of a file, far above what a robot has. With [`LONGEST_NAME`] it bounds memory.
const MOST_CONNECTIONS: usize = 1 << 14;

/// Longest name of a topic or type, bytes.
const LONGEST_NAME: usize = 1 << 10;

/// Largest data of a connection, bytes: the definition of its messages, mostly.
pub(super) const LARGEST_CONNECTION: u64 = 16 << 20;

/// The connections that a scan has come by.
pub(super) struct Connections<'b> {
    bytes: &'b Bytes,
    /// Where the index begins, which repeats every connection; 0 if there is none, or it was read.
    index: u64,
    topics: Vec<Topic>,
    /// From the number of a connection to that of its topic.
    topic_of: HashMap<u32, usize>,
}

impl<'b> Connections<'b> {
    /// None so far, of the file of `bytes`.
    pub(super) fn new(bytes: &'b Bytes) -> Self {
        Self { bytes, index: 0, topics: Vec::new(), topic_of: HashMap::new() }
    }

    /// Has connections that are missing looked for at byte `index` of the file.
    pub(super) fn indexed_at(&mut self, index: u64) {
        self.index = index;
    }

    /// Takes note of a connection from its record.
    pub(super) fn add(&mut self, header: Header<'_>, data: &[u8]) -> Result<(), Fault> {
        let id = header.u32("conn")?;
        // The topic among the data is what the publisher called it before it was remapped.
        let name = header.text("topic")?;
        let message_type = Header::parse(data)?.text("type")?;
        if name.len().max(message_type.len()) > LONGEST_NAME {
            return Err("a name is too long for a topic or type".into());
        }
        let same = |topic: &Topic| topic.name == name && topic.message_type == message_type;
        if let Some(known) = self.topic_of.get(&id).and_then(|index| self.topics.get(*index)) {
            // The index tells every connection again.
            let problem = || format!("connection {id} was {} before and is {name} now", known.name);
            return if same(known) { Ok(()) } else { Err(problem().into()) };
        }
        if self.topic_of.len() >= MOST_CONNECTIONS {
            return Err("the file has too many connections".into());
        }
        let index = self.topics.iter().position(same).unwrap_or(self.topics.len());
        if index == self.topics.len() {
            let (name, message_type) = (name.to_owned(), message_type.to_owned());
            self.topics.push(Topic { name, message_type, encoding: Encoding::Ros1 });
        }
        self.topic_of.insert(id, index);
        Ok(())
    }

    /// The topic of a connection, and its number.
    pub(super) fn topic(&mut self, id: u32) -> Result<(usize, &Topic), Fault> {
        if self.index != 0 && !self.topic_of.contains_key(&id) {
            // A file tells a connection once before its index, perhaps in a chunk that is corrupt.
            // Whatever is wrong with the index, the scan will come by and say.
            let _ = self.add_from_index();
            self.index = 0;
        }
        let found = self.topic_of.get(&id).and_then(|i| Some((*i, self.topics.get(*i)?)));
        found.ok_or_else(|| format!("it belongs to connection {id}, which is not told").into())
    }

    fn add_from_index(&mut self) -> Result<(), Fault> {
        let mut source = Source::new(self.bytes);
        source.seek(self.index)?;
        let (mut header, mut data) = (Vec::new(), Vec::new());
        while source.at() < source.end() {
            let record = source.record(source.end(), &mut header)?;
            let header = Header::parse(&header)?;
            let length = u64::from(record.length);
            if header.op()? != Op::Connection || length > LARGEST_CONNECTION {
                break;
            }
            source.fill(&mut data, length)?;
            self.add(header, &data)?;
        }
        Ok(())
    }
}
