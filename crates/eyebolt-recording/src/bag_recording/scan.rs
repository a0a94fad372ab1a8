//! One pass over a bag: what every topic is, where the frames lie, and where the joints were.

use super::stamps::Stamps;
use super::track::Track;
use crate::bag::{Bag, Encoding, Locator, Message, Topic};
use crate::error::RecordingError;
use crate::message::{
    CameraInfoMessage, CloudMessage, CompressedImageMessage, Header, ImageMessage,
    JointStateMessage, StaticTransform, WireProblem, WireReader, is_depth_encoding, text,
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
    Pictures {
        kind: PictureKind,
        frames: Vec<FrameEntry>,
    },
    /// Positions of joints; one track for each set of names.
    Joints(BTreeMap<Vec<String>, Track>),
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

/// How pictures are stored, told by the first one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum PictureKind {
    Image {
        encoding: String,
        size: (u32, u32),
    },
    CompressedDepth,
    Cloud {
        size: (u32, u32),
    },
    /// Compressed, and no depth.
    CompressedColor,
    Unknown,
}

impl PictureKind {
    /// Whether distances can be read from it, the best kind first.
    pub(super) fn range_rank(&self) -> Option<u8> {
        match self {
            Self::Image { encoding, .. } if is_depth_encoding(encoding) => Some(0),
            Self::CompressedDepth => Some(1),
            Self::Cloud { .. } => Some(2),
            _ => None,
        }
    }
}

/// When and where a picture was recorded.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameEntry {
    pub(super) stamp_ns: i64,
    pub(super) locator: Locator,
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
/// Sets of joint names kept of one topic.
const MOST_TRACKS: usize = 64;

impl Scan {
    /// Reads all of `bag`. With `partial`, damaged parts are passed over and listed.
    pub(super) fn new(bag: &Bag, partial: bool) -> Result<Self, RecordingError> {
        let mut scan = Self::default();
        let mut damage = Vec::new();
        let mut numbers: BTreeMap<(u32, usize), usize> = BTreeMap::new();
        bag.scan(
            &mut |locator, message| {
                let key = (locator.file(), message.topic_index);
                let known = numbers.get(&key).copied();
                let number = known.unwrap_or_else(|| scan.topic(message));
                if known.is_none() {
                    numbers.insert(key, number);
                }
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

    /// Number of the topic that `message` is of, here and in other files of the bag.
    fn topic(&mut self, message: &Message<'_>) -> usize {
        let same = |t: &TopicScan| {
            let Topic { name, message_type, encoding } = message.topic;
            (&t.name, &t.message_type, &t.encoding) == (name, message_type, encoding)
        };
        let known = self.topics.iter().position(same);
        known.unwrap_or_else(|| {
            self.topics.push(TopicScan::new(message));
            self.topics.len() - 1
        })
    }

    fn add(&mut self, number: usize, locator: Locator, message: &Message<'_>) {
        let Some(topic) = self.topics.get_mut(number) else { return };
        topic.count += 1;
        topic.bytes += message.data.len() as u64;
        topic.first_ns = topic.first_ns.min(message.log_time_ns);
        topic.last_ns = topic.last_ns.max(message.log_time_ns);
        let read = WireReader::new(&message.topic.encoding, message.data)
            .and_then(|mut reader| topic.read(&mut reader, locator, message.log_time_ns));
        match read {
            Ok(found) => {
                // Only what never changes tells of a camera's frames.
                let room = MOST_TRANSFORMS.saturating_sub(self.static_transforms.len());
                for transform in found.into_iter().take(room) {
                    self.static_transforms.retain(|other| other.child != transform.child);
                    self.static_transforms.push(transform);
                }
            }
            Err(problem) => {
                topic.unreadable += 1;
                topic.first_problem.get_or_insert((message.log_time_ns, problem));
            }
        }
    }

    fn finish(&mut self) {
        self.topics.sort_by(|a, b| a.name.cmp(&b.name));
        for topic in &mut self.topics {
            match &mut topic.content {
                Content::Joints(tracks) => tracks.values_mut().for_each(Track::finish),
                Content::Pictures { frames, .. } => frames.shrink_to_fit(),
                _ => {}
            }
        }
    }
}

/// Damaged parts that are listed.
const MOST_DAMAGE: usize = 100;

impl TopicScan {
    fn new(message: &Message<'_>) -> Self {
        let pictures = || Content::Pictures { kind: PictureKind::Unknown, frames: Vec::new() };
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
                types::IMAGE | types::COMPRESSED_IMAGE | types::CLOUD => pictures(),
                types::JOINT_STATE => Content::Joints(BTreeMap::new()),
                types::CAMERA_INFO => {
                    Content::CameraInfo { first: None, changed_ns: None, locator: None }
                }
                types::STRING => Content::Text(String::new()),
                types::TRANSFORMS | types::OLD_TRANSFORMS => Content::Transforms,
                _ => Content::Other,
            },
        }
    }

    /// Takes in one message; returns the static transforms in it.
    fn read(
        &mut self,
        reader: &mut WireReader<'_>,
        locator: Locator,
        log_time_ns: i64,
    ) -> Result<Vec<StaticTransform>, WireProblem> {
        match &mut self.content {
            Content::Other => return Ok(Vec::new()),
            Content::Transforms => {
                let fixed = self.name.ends_with("tf_static");
                return if fixed { transforms(reader) } else { Ok(Vec::new()) };
            }
            Content::Text(last) => {
                let text = text(reader)?;
                if text.len() <= LONGEST_TEXT {
                    text.clone_into(last);
                }
            }
            Content::Pictures { kind, frames } => {
                let header = Header::read(&mut reader.clone())?;
                if *kind == PictureKind::Unknown {
                    *kind = picture_kind(&self.message_type, reader)?;
                }
                let stamp_ns = self.stamps.add(header.stamp_ns, log_time_ns);
                note_frame(&mut self.frame_id, &header);
                frames.push(FrameEntry { stamp_ns, locator });
            }
            Content::Joints(tracks) => {
                let message = JointStateMessage::read(reader)?;
                let stamp_ns = self.stamps.add(message.header.stamp_ns, log_time_ns);
                note_frame(&mut self.frame_id, &message.header);
                add_joints(tracks, stamp_ns, &message)?;
            }
            Content::CameraInfo { first, changed_ns, locator: place } => {
                let info = CameraInfoMessage::read(reader)?;
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

fn picture_kind(kind: &str, reader: &mut WireReader<'_>) -> Result<PictureKind, WireProblem> {
    Ok(match kind {
        types::IMAGE => {
            let image = ImageMessage::read(reader)?;
            let encoding = image.encoding.to_owned();
            PictureKind::Image { encoding, size: (image.width, image.height) }
        }
        types::CLOUD => {
            let cloud = CloudMessage::read(reader)?;
            PictureKind::Cloud { size: (cloud.width, cloud.height) }
        }
        _ => match CompressedImageMessage::read(reader)?.is_depth() {
            true => PictureKind::CompressedDepth,
            false => PictureKind::CompressedColor,
        },
    })
}

fn add_joints(
    tracks: &mut BTreeMap<Vec<String>, Track>,
    stamp_ns: i64,
    message: &JointStateMessage<'_>,
) -> Result<(), WireProblem> {
    if message.positions.is_empty() {
        return Ok(());
    }
    if let Some(bad) = message.positions.iter().position(|position| !position.is_finite()) {
        let name = message.names.get(bad).unwrap_or(&"");
        let problem = format!("the position of {name} is not a number");
        return Err(WireProblem::new("position", problem));
    }
    let same = |track: &&mut Track| track.names().iter().eq(message.names.iter());
    if let Some(track) = tracks.values_mut().find(same) {
        track.push(stamp_ns, &message.positions);
        return Ok(());
    }
    let names: Vec<String> = message.names.iter().map(|name| (*name).to_owned()).collect();
    for (index, name) in names.iter().enumerate() {
        if names.iter().take(index).any(|earlier| earlier == name) {
            return Err(WireProblem::new("name", format!("{name} stands there twice")));
        }
    }
    if tracks.len() >= MOST_TRACKS {
        let problem = format!("more than {MOST_TRACKS} sets of joints");
        return Err(WireProblem::new("name", problem));
    }
    let mut track = Track::new(names.clone());
    track.push(stamp_ns, &message.positions);
    tracks.insert(names, track);
    Ok(())
}
