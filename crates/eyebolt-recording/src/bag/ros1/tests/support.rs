//! Bags of given bytes, scanned to the end.

use crate::bag::bag_file::BagFile;
use crate::bag::bytes::Bytes;
use crate::bag::ros1::Ros1Bag;
use crate::bag::{Encoding, Location};
use crate::error::RecordingError;
use std::io::Write;
use std::path::Path;
use tempfile::NamedTempFile;

/// A message as a scan told it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Told {
    pub(super) topic: String,
    pub(super) message_type: String,
    pub(super) topic_index: usize,
    pub(super) log_time_ns: i64,
    pub(super) place: Location,
    pub(super) data: Vec<u8>,
}

/// Everything that a scan told which goes on behind damage: messages, and what was wrong.
pub(super) fn scan(bag: &Ros1Bag) -> (Vec<Told>, Vec<String>) {
    let (mut messages, mut problems) = (Vec::new(), Vec::new());
    bag.scan(
        &mut |message| {
            assert_eq!(message.topic.encoding, Encoding::Ros1);
            messages.push(Told {
                topic: message.topic.name.clone(),
                message_type: message.topic.message_type.clone(),
                topic_index: message.topic_index,
                log_time_ns: message.log_time_ns,
                place: message.place,
                data: message.data.to_vec(),
            });
            Ok(())
        },
        &mut |error| {
            problems.push(said(error));
            Ok(())
        },
    )
    .unwrap();
    (messages, problems)
}

/// All messages of a bag that must be whole.
pub(super) fn scan_whole(bag: &Ros1Bag) -> Vec<Told> {
    let (messages, problems) = scan(bag);
    assert_eq!(problems, Vec::<String>::new());
    messages
}

/// The error without the folder in which the file is.
pub(super) fn said(error: RecordingError) -> String {
    let file = error.path().file_name().unwrap().to_str().unwrap();
    error.to_string().replace(error.path().to_str().unwrap(), file)
}

/// The bag at `path`.
pub(super) fn open(path: &Path) -> Result<Ros1Bag, RecordingError> {
    Ros1Bag::new(Bytes::open(path)?)
}

/// A bag of these bytes. The file lives as long as what is returned with it.
pub(super) fn bag(bytes: &[u8]) -> (NamedTempFile, Ros1Bag) {
    let file = file(bytes);
    let bag = open(file.path()).unwrap();
    (file, bag)
}

pub(super) fn file(bytes: &[u8]) -> NamedTempFile {
    let mut file = NamedTempFile::new().unwrap();
    file.write_all(bytes).unwrap();
    file
}
