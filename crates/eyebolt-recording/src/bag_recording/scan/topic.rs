//! What one topic is to a recording.

use super::joints::{JointTracks, Untold};
use super::pictures::{FrameEntry, PictureKind, Pictures};
use crate::bag::{Encoding, Locator, Message};
use crate::bag_recording::stamps::Stamps;
use crate::bag_recording::track::Track;
use crate::message::{
    CameraInfoMessage, Header, JointStateMessage, StaticTransform, WireProblem, WireReader, text,
    transforms, types,
};

/// One topic.
#[derive(Clone, Debug)]
pub(crate) struct TopicScan {
    pub(crate) name: String,
    pub(crate) message_type: String,
    pub(crate) encoding: Encoding,
    pub(crate) count: u64,
    pub(crate) bytes: u64,
    /// When its first and last messages were written down, nanoseconds.
    pub(crate) first_ns: i64,
    pub(crate) last_ns: i64,
    pub(crate) frame_id: Option<String>,
    pub(crate) stamps: Stamps,
    /// Messages that are not of their type, and what is wrong with the first.
    pub(crate) unreadable: u64,
    pub(crate) first_problem: Option<(i64, WireProblem)>,
    pub(crate) content: Content,
}

/// What the messages of a topic are to a recording.
#[derive(Clone, Debug)]
pub(crate) enum Content {
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
pub(crate) struct Intrinsics {
    /// Of the sensor.
    size: (u32, u32),
    /// Of the pictures, which may be binned, or of a part of the sensor.
    seen: (u32, u32),
    numbers: Vec<f64>,
}

impl Intrinsics {
    fn new(info: &CameraInfoMessage<'_>) -> Self {
        let numbers = info.k.iter().chain(&info.p).chain(&info.d).copied().collect();
        let [_, _, height, width] = info.roi;
        let whole = (info.width, info.height);
        let part = if width > 0 && height > 0 { (width, height) } else { whole };
        let [across, down] = info.binning.map(|binning| binning.max(1));
        Self { size: whole, seen: (part.0 / across, part.1 / down), numbers }
    }

    /// Width and height of the sensor, and of the pictures where these are others.
    pub(crate) fn sizes(&self) -> [(u32, u32); 2] {
        [self.size, self.seen]
    }
}

/// Longest robot description kept, bytes.
const LONGEST_TEXT: usize = 64 << 20;
impl TopicScan {
    /// The topic of `message`, without any message yet.
    pub(super) fn new(message: &Message<'_>) -> Self {
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
                types::TRANSFORMS | types::OLD_TRANSFORMS if is_static(&message.topic.name) => {
                    Content::Transforms
                }
                _ => Content::Other,
            },
        }
    }

    /// Whether its pictures are depth in whole millimetres.
    pub(crate) fn is_in_millimetres(&self) -> bool {
        let Content::Pictures(pictures) = &self.content else { return false };
        matches!(&pictures.kind, PictureKind::Image { encoding, .. } if encoding != "32FC1")
    }

    /// How many stamps are before one that came earlier, and the first such pair, nanoseconds.
    pub(crate) fn backward(&self) -> (u64, Option<(i64, i64)>) {
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

    /// Its pictures, in the order of the bag; none of other topics.
    pub(crate) fn frames(&self) -> &[FrameEntry] {
        match &self.content {
            Content::Pictures(pictures) => &pictures.frames,
            _ => &[],
        }
    }

    /// Its joints; none of other topics.
    pub(crate) fn tracks(&self) -> &[Track] {
        match &self.content {
            Content::Joints(joints) => joints.tracks(),
            _ => &[],
        }
    }

    /// Joints that its messages name without a position that can be used; `None` of other topics.
    pub(crate) fn untold(&self) -> Option<&Untold> {
        match &self.content {
            Content::Joints(joints) => Some(joints.untold()),
            _ => None,
        }
    }

    /// What it has, or what is wrong with it, where nothing can be made of it.
    pub(crate) fn flaw(&self) -> Option<String> {
        let unreadable = self.first_problem.as_ref().filter(|_| self.unreadable == self.count);
        if let Some((_, WireProblem { field, problem })) = unreadable {
            return Some(format!("{field}: {problem}"));
        }
        match &self.content {
            Content::Pictures(pictures) => Some(pictures.kind.text()),
            Content::Joints(joints) if joints.tracks().is_empty() => {
                let first = joints.untold().reasons(self.count).next().map(|(_, reason)| reason);
                Some(first.unwrap_or_else(|| "its messages have no positions".to_owned()))
            }
            _ => None,
        }
    }

    /// Ends what messages go on with.
    pub(super) fn finish(&mut self) {
        match &mut self.content {
            Content::Joints(tracks) => tracks.finish(),
            Content::Pictures(pictures) => pictures.frames.shrink_to_fit(),
            _ => {}
        }
    }

    /// Takes in one message; returns the static transforms in it.
    pub(super) fn add(
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
pub(crate) fn is_static(topic: &str) -> bool {
    topic.rsplit('/').next() == Some("tf_static")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn static_transforms_are_on_one_name_in_any_namespace() {
        assert!(["/tf_static", "tf_static", "/robot/tf_static"].iter().all(|t| is_static(t)));
        assert!(["/tf", "/not_tf_static", "/tf_static/raw", ""].iter().all(|t| !is_static(t)));
    }
}
