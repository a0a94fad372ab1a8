//! What records say, in a chunk or not.

use super::connections::Connections;
use super::fault::{Fault, Taker};
use super::header::{Header, Op, split_sized};
use crate::bag::message::{Location, Message};
use crate::error::RecordingError;
use std::path::Path;

/// The records of the decompressed chunk that begins at byte `chunk` of the file.
pub(super) fn contents(
    path: &Path,
    chunk: u64,
    bytes: &[u8],
    connections: &mut Connections<'_>,
    taker: &mut Taker<'_>,
) -> Result<(), RecordingError> {
    let mut rest = bytes;
    while !rest.is_empty() {
        let at = bytes.len() - rest.len();
        let field = || format!("record at byte {at} of the chunk at byte {chunk}");
        let split = split_sized(rest).and_then(|(header, behind)| {
            let (data, behind) = split_sized(behind)?;
            Some((header, data, behind)).filter(|_| !header.is_empty())
        });
        let Some((header, data, behind)) = split else {
            return taker.decide("its chunk ends within it".into(), path, field());
        };
        rest = behind;
        // A chunk has far less than 4 GiB, or it was not decompressed.
        let start = u32::try_from(bytes.len() - rest.len() - data.len()).unwrap_or(u32::MAX);
        let length = u32::try_from(data.len()).unwrap_or(u32::MAX);
        let place = Location::InChunk { chunk, start, length };
        let taken = Header::parse(header)
            .map_err(Fault::from)
            .and_then(|header| take(header.op()?, header, data, place, connections, taker));
        if let Err(fault) = taken {
            taker.decide(fault, path, field())?;
        }
    }
    Ok(())
}

/// A record of whatever kind that has no others in it.
pub(super) fn take(
    op: Op,
    header: Header<'_>,
    data: &[u8],
    place: Location,
    connections: &mut Connections<'_>,
    taker: &mut Taker<'_>,
) -> Result<(), Fault> {
    match op {
        Op::Connection => connections.add(header, data),
        Op::Message => {
            let log_time_ns = header.time_ns("time")?;
            let (topic_index, topic) = connections.topic(header.u32("conn")?)?;
            let message = Message { topic, topic_index, log_time_ns, place, data };
            Ok((taker.each)(&message)?)
        }
        Op::Chunk => Err("it is a chunk in a chunk".into()),
        Op::BagHeader | Op::Other => Ok(()),
    }
}
