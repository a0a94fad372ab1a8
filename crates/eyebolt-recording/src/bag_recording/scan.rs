//! One pass over a bag: what every topic is, where the frames lie, and where the joints were.

mod joints;
mod pictures;

pub(super) use joints::JointTracks;
pub(super) use pictures::{FrameEntry, PictureKind, Pictures, Unfit};

use super::stamps::Stamps;
use super::track::Track;
use crate::bag::{Bag, Encoding, Locator, Message, Topic};
use crate::error::RecordingError;
use crate::message::{
    CameraInfoMessage, Header, JointStateMessage, StaticTransform, WireProblem, WireReader, text,
    transforms, types,
};
use std::collections::BTreeMap;

/// What a scan found.
#[derive(Debug, Default)]
pub(super) struct Scan {
    pub(super) topics: Vec<TopicScan>,
    pub(super) static_transforms: Vec<StaticTransform>,
    /// Parts of the bag that could not be read and were passed over, if that was allowed.
    pub(super) damage: Vec<RecordingError>,
}

/// One topic.
#[derive(Debug)]
pub(super) struct TopicScan {
    pub(super) name: String,
    pub(super) message_type: String,
    pub(super) encoding: Encoding,
    pub(super) count: u64,
    pub(super) bytes: u64,
    /// When its first and last messages were written down, nanoseconds.
    pub(super) first_ns: i64,
    pub(super) last_ns: i64,
    pub(super) frame_id: Option<String>,
    pub(super) stamps: Stamps,
    /// Messages that are not of their type, and what is wrong with the first.
    pub(super) unreadable: u64,
    pub(super) first_problem: Option<(i64, WireProblem)>,
    pub(super) content: Content,
}

/// What the messages of a topic are to a recording.
#[derive(Debug)]
pub(super) enum Content {
    /// Pictures, depth or not.
    Pictures(Pictures),
    /// Positions of joints; one track for each set of names.
    Joints(JointTracks),
    /// The first intrinsics, whether later ones differ, and where the first lie.
    CameraInfo {
        first: Option<Intrinsics>,
        changed_ns: Option<i64>,
        locator: Option<Locator>,
    },
    /// The last text.
    Text(String),
    Transforms,
    Other,
}

/// Intrinsics, to be compared.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Intrinsics {
    size: (u32, u32),
    numbers: Vec<f64>,
}

impl Intrinsics {
    fn new(info: &CameraInfoMessage<'_>) -> Self {
        let numbers = info.k.iter().chain(&info.p).chain(&info.d).copied().collect();
        Self { size: (info.width, info.height), numbers }
    }

    pub(super) fn size(&self) -> (u32, u32) {
        self.size
    }
}

/// Longest robot description kept, bytes.
const LONGEST_TEXT: usize = 64 << 20;
/// Static transforms kept.
const MOST_TRANSFORMS: usize = 10_000;

impl Scan {
    /// Reads all of `bag`. With `partial`, damaged parts are passed over and listed.
    pub(super) fn new(bag: &Bag, partial: bool) -> Result<Self, RecordingError> {
        let mut scan = Self::default();
        let mut damage = Vec::new();
        let mut numbers: BTreeMap<(u32, usize), usize> = BTreeMap::new();
        let mut topics: BTreeMap<Topic, usize> = BTreeMap::new();
        bag.scan(
            &mut |locator, message| {
                let key = (locator.file(), message.topic_index);
                // The topic may be known of another file.
                let number = *numbers.entry(key).or_insert_with(|| {
                    *topics.entry(message.topic.clone()).or_insert_with(|| {
                        scan.topics.push(TopicScan::new(message));
                        scan.topics.len() - 1
                    })
                });
                scan.add(number, locator, message);
                Ok(())
            },
            &mut |error| {
                // One damaged chunk is told like a thousand.
                if partial && damage.len() < MOST_DAMAGE {
                    damage.push(error);
                    return Ok(());
                }
                if partial { Ok(()) } else { Err(error) }
            },
        )?;
        scan.damage = damage;
        scan.finish();
        Ok(scan)
    }

    fn add(&mut self, number: usize, locator: Locator, message: &Message<'_>) {
        let Some(topic) = self.topics.get_mut(number) else { return };
        topic.count += 1;
        topic.bytes += message.data.len() as u64;
        topic.first_ns = topic.first_ns.min(message.log_time_ns);
        topic.last_ns = topic.last_ns.max(message.log_time_ns);
        match topic.read(message, locator) {
            Ok(found) => {
                found.into_iter().for_each(|transform| self.add_transform(transform));
            }
            Err(problem) => {
                topic.unreadable += 1;
                topic.first_problem.get_or_insert((message.log_time_ns, problem));
            }
        }
    }

    /// Publishers tell their transforms again and again; two parents of a frame are kept, for
    /// whoever reads them to complain about.
    fn add_transform(&mut self, transform: StaticTransform) {
        let same = |other: &&mut StaticTransform| {
            (&other.parent, &other.child) == (&transform.parent, &transform.child)
        };
        if let Some(known) = self.static_transforms.iter_mut().find(same) {
            *known = transform;
        } else if self.static_transforms.len() < MOST_TRANSFORMS {
            self.static_transforms.push(transform);
        }
    }

    fn finish(&mut self) {
        self.topics.sort_by(|a, b| a.name.cmp(&b.name));
        for topic in &mut self.topics {
            match &mut topic.content {
                Content::Joints(tracks) => tracks.finish(),
                Content::Pictures(pictures) => pictures.frames.shrink_to_fit(),
                _ => {}
            }
        }
    }
}

/// Damaged parts that are listed.
const MOST_DAMAGE: usize = 100;

impl TopicScan {
    fn new(message: &Message<'_>) -> Self {
        Self {
            name: message.topic.name.clone(),
            message_type: message.topic.message_type.clone(),
            encoding: message.topic.encoding.clone(),
            count: 0,
            bytes: 0,
            first_ns: i64::MAX,
            last_ns: i64::MIN,
            frame_id: None,
            stamps: Stamps::default(),
            unreadable: 0,
            first_problem: None,
            content: match message.topic.message_type.as_str() {
                types::IMAGE | types::COMPRESSED_IMAGE | types::CLOUD => {
                    Content::Pictures(Pictures::default())
                }
                types::JOINT_STATE => Content::Joints(JointTracks::default()),
                types::CAMERA_INFO => {
                    Content::CameraInfo { first: None, changed_ns: None, locator: None }
                }
                types::STRING => Content::Text(String::new()),
                // Only what never changes tells of a camera's frames.
                types::TRANSFORMS | types::OLD_TRANSFORMS
                    if message.topic.name.ends_with("tf_static") =>
                {
                    Content::Transforms
                }
                _ => Content::Other,
            },
        }
    }

    /// Whether its pictures are depth in whole millimetres.
    pub(super) fn is_in_millimetres(&self) -> bool {
        let Content::Pictures(pictures) = &self.content else { return false };
        matches!(&pictures.kind, PictureKind::Image { encoding, .. } if encoding != "32FC1")
    }

    /// How many stamps are before one that came earlier, and the first such pair, nanoseconds.
    pub(super) fn backward(&self) -> (u64, Option<(i64, i64)>) {
        match &self.content {
            // Several publishers need not tell of the same moments in turn.
            Content::Joints(joints) => {
                let tracks = joints.tracks().iter();
                let first = tracks.clone().find_map(Track::first_backward_ns);
                (tracks.map(Track::backward).sum(), first)
            }
            _ => (self.stamps.backward, self.stamps.first_backward_ns),
        }
    }

    /// Takes in one message; returns the static transforms in it.
    fn read(
        &mut self,
        message: &Message<'_>,
        locator: Locator,
    ) -> Result<Vec<StaticTransform>, WireProblem> {
        let log_time_ns = message.log_time_ns;
        let reader = || WireReader::new(&message.topic.encoding, message.data);
        match &mut self.content {
            Content::Other => {}
            Content::Transforms => return transforms(&mut reader()?),
            Content::Text(last) => {
                let mut reader = reader()?;
                let text = text(&mut reader)?;
                if text.len() <= LONGEST_TEXT {
                    text.clone_into(last);
                }
            }
            Content::Pictures(pictures) => {
                let header = reader().and_then(|mut reader| Header::read(&mut reader));
                let stamp = match &header {
                    Ok(header) => {
                        note_frame(&mut self.frame_id, header);
                        (self.stamps.add(header.stamp_ns, log_time_ns), header.stamp_ns == 0)
                    }
                    Err(_) => (log_time_ns, true),
                };
                pictures.add(&self.message_type, reader(), stamp, locator)?;
            }
            Content::Joints(tracks) => {
                let joints = JointStateMessage::read(&mut reader()?)?;
                let stamp_ns = self.stamps.add_unordered(joints.header.stamp_ns, log_time_ns);
                note_frame(&mut self.frame_id, &joints.header);
                tracks.add(stamp_ns, &joints)?;
            }
            Content::CameraInfo { first, changed_ns, locator: place } => {
                let mut reader = reader()?;
                let info = CameraInfoMessage::read(&mut reader)?;
                note_frame(&mut self.frame_id, &info.header);
                self.stamps.add(info.header.stamp_ns, log_time_ns);
                let intrinsics = Intrinsics::new(&info);
                match first {
                    Some(known) if *known != intrinsics => {
                        changed_ns.get_or_insert(log_time_ns);
                    }
                    Some(_) => {}
                    none => {
                        *none = Some(intrinsics);
                        *place = Some(locator);
                    }
                }
            }
        }
        Ok(Vec::new())
    }
}

fn note_frame(frame_id: &mut Option<String>, header: &Header<'_>) {
    if frame_id.is_none() && !header.frame_id.is_empty() {
        *frame_id = Some(header.frame_id.trim_start_matches('/').to_owned());
    }
}

/// Whether a topic tells transforms that never change: `/tf_static`, in any namespace.
pub(super) fn is_static(topic: &str) -> bool {
    topic.rsplit('/').next() == Some("tf_static")
}
