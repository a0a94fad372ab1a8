//! What a writer of recordings asks of a bag.

use super::BagRecording;
use super::scan::is_static;
use crate::bag::{Bag, Message, Topic};
use crate::error::RecordingError;
use crate::frame_source::FrameSource;
use crate::own_metadata::BACKGROUND_TOPIC;
use eyebolt_geometry::PinholeCamera;
use std::collections::BTreeMap;
use std::path::Path;

impl BagRecording {
    /// The messages, and what else is in the files.
    pub(crate) fn messages(&self) -> &Bag {
        &self.bag
    }

    /// Where the bag is.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether damage is passed over.
    pub(crate) fn is_partial(&self) -> bool {
        self.partial
    }

    /// Number of messages of all topics.
    pub(crate) fn message_count(&self) -> usize {
        let count: u64 = self.scan.topics.iter().map(|topic| topic.count).sum();
        usize::try_from(count).unwrap_or(usize::MAX)
    }

    /// Hands every message of the bag to `each`, once more.
    pub(crate) fn scan_again(
        &self,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
    ) -> Result<(), RecordingError> {
        let mut damage = |error| if self.partial { Ok(()) } else { Err(error) };
        self.bag.scan(&mut |_, message| each(message), &mut damage)
    }

    /// Whether the messages of `topic` are part of the recording, or static transforms.
    pub(crate) fn is_chosen(&self, topic: &Topic) -> bool {
        if is_static(&topic.name) {
            return true;
        }
        self.chosen.roles().any(|(number, _)| {
            let chosen = self.topic(number);
            chosen.name == topic.name && chosen.message_type == topic.message_type
        })
    }

    /// The camera, if a file told it, and the topic where it would be looked for.
    pub(crate) fn given_camera(&self) -> Option<(&PinholeCamera, String)> {
        let camera = self.camera().filter(|_| self.camera_given)?;
        let above = self.range_topic().name.rsplit_once('/').map_or("", |(above, _)| above);
        Some((camera, format!("{above}/camera_info")))
    }

    /// What is known of the recording that no message says.
    pub(crate) fn metadata(&self) -> BTreeMap<String, String> {
        let mut known = self.bag.metadata().cloned().unwrap_or_default();
        // Its messages may have got lost, or a flag may have named it.
        known.remove(BACKGROUND_TOPIC);
        if let Some(number) = self.chosen.background {
            known.insert(BACKGROUND_TOPIC.to_owned(), self.topic(number).name.clone());
        }
        if let Some(frame) = self.cloud_frame {
            known.insert("cloud_frame".to_owned(), frame.name().to_owned());
        }
        known
    }
}
