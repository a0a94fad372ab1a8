//! What a writer of recordings asks of a bag.

use super::choose::Chosen;
use super::known::Known;
use super::options::BagOptions;
use super::scan::{Scan, is_static};
use crate::bag::{Bag, Message, Topic};
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::manifest::{CloudFrame, RobotSection};
use eyebolt_geometry::PinholeCamera;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What is the same throughout a copy.
#[derive(Debug)]
pub(super) struct CopyFacts {
    /// Names and types of the topics that are the recording.
    topics: BTreeSet<(String, String)>,
    /// Number of messages of all topics.
    messages: usize,
    /// What is known of the recording that no message says.
    metadata: BTreeMap<String, String>,
    /// The intrinsics came from a file, and would be looked for on this topic.
    given_camera_topic: Option<String>,
    /// Damage is passed over.
    pub(super) partial: bool,
}

impl CopyFacts {
    pub(super) fn new(
        scan: &Scan,
        chosen: &Chosen,
        options: &BagOptions,
        known: Known,
        cloud_frame: Option<CloudFrame>,
        depth_unit: Option<DepthUnit>,
    ) -> Self {
        let topics = chosen.roles().map(|(number, _)| {
            let topic = scan.topic(number);
            (topic.name.clone(), topic.message_type.clone())
        });
        let messages: u64 = scan.topics.iter().map(|topic| topic.count).sum();
        let background = chosen.background.map(|number| scan.topic(number).name.as_str());
        let above = scan.topic(chosen.range).name.rsplit_once('/').map_or("", |(above, _)| above);
        let beside = || format!("{above}/camera_info");
        Self {
            topics: topics.collect(),
            messages: usize::try_from(messages).unwrap_or(usize::MAX),
            metadata: known.of_copy(background, cloud_frame, depth_unit),
            given_camera_topic: options.camera_info.is_some().then(beside),
            partial: options.partial,
        }
    }
}

/// A bag, to be copied message by message.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CopySource<'a> {
    pub(super) path: &'a Path,
    pub(super) bag: &'a Bag,
    pub(super) facts: &'a CopyFacts,
    pub(super) camera: Option<&'a PinholeCamera>,
    pub(super) camera_frame_id: Option<&'a str>,
    pub(super) robot: &'a RobotSection,
}

impl<'a> CopySource<'a> {
    /// The messages, and what else is in the files.
    pub(crate) fn messages(&self) -> &'a Bag {
        self.bag
    }

    /// Where the bag is.
    pub(crate) fn path(&self) -> &'a Path {
        self.path
    }

    /// Whether damage is passed over.
    pub(crate) fn is_partial(&self) -> bool {
        self.facts.partial
    }

    /// Number of messages of all topics.
    pub(crate) fn message_count(&self) -> usize {
        self.facts.messages
    }

    /// Hands every message of the bag to `each`, once more.
    pub(crate) fn scan_again(
        &self,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
    ) -> Result<(), RecordingError> {
        let mut damage = |error| if self.facts.partial { Ok(()) } else { Err(error) };
        self.bag.scan(&mut |_, message| each(message), &mut damage)
    }

    /// Whether the messages of `topic` are part of the recording, or static transforms.
    pub(crate) fn is_chosen(&self, topic: &Topic) -> bool {
        let is =
            |(name, kind): &(String, String)| *name == topic.name && *kind == topic.message_type;
        is_static(&topic.name) || self.facts.topics.iter().any(is)
    }

    /// What the bag says of the robot.
    pub(crate) fn robot(&self) -> &'a RobotSection {
        self.robot
    }

    /// Name of the camera's optical frame.
    pub(crate) fn camera_frame_id(&self) -> Option<&'a str> {
        self.camera_frame_id
    }

    /// The camera, if a file told it, and the topic where it would be looked for.
    pub(crate) fn given_camera(&self) -> Option<(&'a PinholeCamera, &'a str)> {
        Some((self.camera?, self.facts.given_camera_topic.as_deref()?))
    }

    /// What is known of the recording that no message says.
    pub(crate) fn metadata(&self) -> &'a BTreeMap<String, String> {
        &self.facts.metadata
    }
}
