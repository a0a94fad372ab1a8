//! A recording that is a bag: MCAP, a ROS 2 bag in SQLite, or a ROS 1 bag.
//!
//! One pass over the bag finds the topics, the frames of depth and the path of the joints; frames
//! are read when asked for. Memory grows by some bytes a frame, not by its pixels.

mod choose;
mod clouds;
mod copying;
mod frames;
mod pair;
mod scan;
mod skew;
mod stamps;
mod track;

pub use pair::{DropReason, DroppedFrame};
pub use stamps::ClockOffset;

use crate::bag::{Bag, BagKind};
use crate::camera_info::CameraInfo;
use crate::error::RecordingError;
use crate::joints::{self, looks_like_degrees};
use crate::manifest::{CloudFrame, RobotSection};
use crate::message::{CameraInfoMessage, StaticTransform, WireReader};
use crate::write::check_names;
use choose::Chosen;
use eyebolt_geometry::PinholeCamera;
use eyebolt_robot::JointPositions;
use pair::{Kept, Paired};
use scan::{Content, FrameEntry, Scan, TopicScan};
use std::path::{Path, PathBuf};
use track::Track;

/// How to read a bag. The default finds out by itself what it can.
#[derive(Clone, Debug, Default)]
pub struct BagOptions {
    /// Topic of the depth images or clouds.
    pub depth_topic: Option<String>,
    /// Topic of their intrinsics.
    pub camera_info_topic: Option<String>,
    /// File of their intrinsics, instead of a topic.
    pub camera_info: Option<PathBuf>,
    /// Topic of the joint states.
    pub joint_topic: Option<String>,
    /// Topic of the robot's description.
    pub description_topic: Option<String>,
    /// Topic of colour pictures registered to the depth.
    pub color_topic: Option<String>,
    /// Topic of masks of the arm.
    pub mask_topic: Option<String>,
    /// Frame of the points of clouds.
    pub cloud_frame: Option<CloudFrame>,
    /// How far a joint may move while a frame is taken, radians or metres; otherwise the data tell.
    pub max_motion: Option<f64>,
    /// Use what can be read of a damaged bag.
    pub partial: bool,
    /// Folder for decompressed copies; the current one if empty.
    pub scratch: PathBuf,
}

impl BagOptions {
    fn scratch(&self) -> &Path {
        let empty = self.scratch.as_os_str().is_empty();
        if empty { Path::new(".") } else { &self.scratch }
    }
}

/// A recording in a bag. Frames are read when asked for, from as many threads as wanted.
#[derive(Debug)]
pub struct BagRecording {
    path: PathBuf,
    bag: Bag,
    scan: Scan,
    chosen: Chosen,
    camera: Option<CameraInfo>,
    robot: RobotSection,
    paired: Paired,
    names: Vec<String>,
    clock_offset: Option<ClockOffset>,
    cloud_frame: Option<CloudFrame>,
    partial: bool,
    /// The intrinsics came from a file.
    camera_given: bool,
}

/// A topic of a bag, for people.
#[derive(Clone, Debug, PartialEq)]
pub struct TopicSummary {
    /// Name.
    pub name: String,
    /// Type of its messages, as in `sensor_msgs/Image`.
    pub message_type: String,
    /// What the messages are to the recording, where that is known: `depth`, `joints`...
    pub role: Option<&'static str>,
    /// Number of messages.
    pub count: u64,
    /// Bytes of all messages.
    pub bytes: u64,
    /// Messages a second, of topics with more than one.
    pub rate_hz: Option<f64>,
    /// The frame that its messages are in.
    pub frame_id: Option<String>,
    /// What is wrong with it, in words.
    pub problems: Vec<String>,
}

impl BagRecording {
    /// Opens the bag at `path`, a file or a folder, and reads it once.
    ///
    /// # Errors
    ///
    /// A file that cannot be read or is damaged (unless `partial` is asked for), no topic or
    /// several that could be meant, a camera that cannot be read, or no frame that can be used.
    pub fn open(path: &Path, options: &BagOptions) -> Result<Self, RecordingError> {
        let bag = Bag::open(path, options.scratch())?;
        let scan = Scan::new(&bag, options.partial)?;
        let chosen = Chosen::new(path, &scan, options)?;
        let mut recording = Self {
            path: path.to_path_buf(),
            camera: None,
            robot: robot(&bag, &scan, chosen),
            paired: Paired::default(),
            names: Vec::new(),
            clock_offset: None,
            cloud_frame: options.cloud_frame.or_else(|| known_cloud_frame(&bag)),
            partial: options.partial,
            camera_given: options.camera_info.is_some(),
            bag,
            scan,
            chosen,
        };
        recording.check_topics(options.partial)?;
        recording.camera = recording.read_camera(options)?;
        recording.pair(options.max_motion)?;
        recording.check_joints()?;
        recording.find_cloud_frame()?;
        Ok(recording)
    }

    /// The camera, unless the frames are clouds without one.
    pub fn camera(&self) -> Option<&PinholeCamera> {
        self.camera.as_ref().map(|info| &info.camera)
    }

    /// Name of the camera's optical frame, which the frames are in; `None` where only the camera's
    /// body has a name, in which clouds were stored.
    pub fn camera_frame_id(&self) -> Option<&str> {
        let in_info = self.camera.as_ref().and_then(|info| info.frame_id.as_deref());
        let turned = self.cloud_frame == Some(CloudFrame::Body);
        let of_frames = self.range_topic().frame_id.as_deref().filter(|_| !turned);
        of_frames.or(in_info)
    }

    /// What the bag says of the robot.
    pub fn robot(&self) -> &RobotSection {
        &self.robot
    }

    /// Names of the frames: their numbers among those of the topic.
    pub fn frame_names(&self) -> &[String] {
        &self.names
    }

    /// Frames that do not take part, with the reason.
    pub fn dropped_frames(&self) -> &[DroppedFrame] {
        &self.paired.dropped
    }

    /// How far a joint may move while a frame is taken, radians or metres.
    pub fn motion_limit(&self) -> f64 {
        self.paired.motion_limit
    }

    /// How the clocks of depth and joints differ; `None` if one of them sets no stamps.
    pub fn clock_offset(&self) -> Option<ClockOffset> {
        self.clock_offset
    }

    /// Whether frames come with masks of the arm.
    pub fn has_masks(&self) -> bool {
        self.chosen.mask.is_some()
    }

    /// What wrote the bag.
    pub fn kind(&self) -> BagKind {
        self.bag.kind()
    }

    /// Damaged parts that were passed over.
    pub fn damage(&self) -> &[RecordingError] {
        &self.scan.damage
    }

    /// All topics, sorted by name.
    pub fn topics(&self) -> Vec<TopicSummary> {
        (0..self.scan.topics.len()).filter_map(|number| self.summary(number)).collect()
    }

    /// Positions of the joints in frame `index`, counted from 0 among those that take part.
    ///
    /// # Errors
    ///
    /// No such frame.
    pub fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        let kept = self.kept(index)?;
        let names = self.paired.names.iter().cloned();
        Ok(names.zip(kept.positions.iter().copied()).collect())
    }

    /// Stamp of frame `index` by the clock of the depth, nanoseconds.
    pub fn stamp_ns(&self, index: usize) -> Option<i64> {
        let kept = self.paired.kept.get(index)?;
        Some(self.entries(self.chosen.range).get(kept.index)?.stamp_ns)
    }

    fn kept(&self, index: usize) -> Result<&Kept, RecordingError> {
        self.paired.kept.get(index).ok_or_else(|| RecordingError::NoSuchFrame {
            path: self.path.clone(),
            index,
            count: self.names.len(),
        })
    }

    fn range_topic(&self) -> &TopicScan {
        self.topic(self.chosen.range)
    }

    fn topic(&self, number: usize) -> &TopicScan {
        self.scan.topics.get(number).expect("chosen topics are of the scan")
    }

    fn entries(&self, number: usize) -> &[FrameEntry] {
        match &self.topic(number).content {
            Content::Pictures(pictures) => &pictures.frames,
            _ => &[],
        }
    }

    fn invalid(&self, field: &str, problem: String, remedy: &str) -> RecordingError {
        RecordingError::invalid(&self.path, field, problem, remedy)
    }

    /// What is wrong with a topic that the recording needs is wrong with the recording.
    fn check_topics(&self, partial: bool) -> Result<(), RecordingError> {
        let Chosen { range, camera_info, joints, description, color, mask } = self.chosen;
        let needed = [camera_info, description, color, mask];
        for number in [range, joints].into_iter().chain(needed.into_iter().flatten()) {
            let topic = self.topic(number);
            if let Some((log_time_ns, problem)) = topic.first_problem.as_ref().filter(|_| !partial)
            {
                let field = format!("{}: {}", topic.name, problem.field);
                let text = format!("{} (message of {})", problem.problem, seconds(*log_time_ns));
                let remedy = "Record it again, or give --partial to go without such messages";
                return Err(self.invalid(&field, text, remedy));
            }
            let (backward, first) = topic.backward();
            if let Some((latest, next)) = first
                && backward > (topic.count / MOST_BACKWARD).max(1)
            {
                let problem = format!(
                    "{backward} of {} stamps run backward, first from {} to {}",
                    topic.count,
                    seconds(latest),
                    seconds(next)
                );
                let remedy =
                    "Two programs publish there, or the clock was set back: record it again";
                return Err(self.invalid(&topic.name, problem, remedy));
            }
        }
        let topic = camera_info.map(|number| self.topic(number));
        if let Some(topic) = topic
            && let Content::CameraInfo { changed_ns: Some(changed), .. } = &topic.content
        {
            let problem = format!("the intrinsics change at {}", seconds(*changed));
            let remedy = "Record with one setting of the camera, or give --camera-info with a file";
            return Err(self.invalid(&topic.name, problem, remedy));
        }
        Ok(())
    }

    fn read_camera(&self, options: &BagOptions) -> Result<Option<CameraInfo>, RecordingError> {
        if let Some(path) = &options.camera_info {
            return CameraInfo::read(path).map(Some);
        }
        let Some(topic) = self.chosen.camera_info.map(|number| self.topic(number)) else {
            return Ok(None);
        };
        let Content::CameraInfo { locator: Some(locator), .. } = &topic.content else {
            return Ok(None);
        };
        let bytes = self.bag.read(*locator)?;
        let message = WireReader::new(&topic.encoding, &bytes)
            .and_then(|mut reader| CameraInfoMessage::read(&mut reader))
            .map_err(|problem| self.unreadable(topic, &problem))?;
        // By ROS's convention, pictures called so were rectified.
        let rectified = self.range_topic().name.contains("rect");
        let info = CameraInfo::from_message(&self.path, &message, rectified);
        info.map(Some).map_err(|error| match error {
            RecordingError::Invalid { field, problem, .. } => {
                let remedy = "Give another topic with --camera-info-topic, or a file with \
                              --camera-info";
                self.invalid(&format!("{}: {field}", topic.name), problem, remedy)
            }
            other => other,
        })
    }

    fn pair(&mut self, max_motion: Option<f64>) -> Result<(), RecordingError> {
        let (range, joints) = (self.range_topic(), self.topic(self.chosen.joints));
        let Content::Joints(states) = &joints.content else { return Ok(()) };
        let tracks: Vec<_> = states.tracks().iter().collect();
        let frames = self.entries(self.chosen.range);
        let offset = clock_offset(range, joints, frames, &tracks);
        let paired = pair::pair(frames, &tracks, offset, max_motion);
        if paired.kept.is_empty() {
            let first =
                paired.dropped.first().map(|frame| format!("; of the first, {}", frame.reason));
            let problem = format!(
                "none of its {} frames can be used{}",
                frames.len(),
                first.unwrap_or_default()
            );
            let remedy = "Let the arm rest in every configuration while the camera looks on, and \
                          record joint states all the time; --max-motion-deg changes what counts \
                          as rest";
            return Err(self.invalid(&range.name, problem, remedy));
        }
        let name = match self.known_names()?.filter(|names| names.len() == frames.len()) {
            Some(names) => {
                Box::new(move |index: usize| names[index].clone()) as Box<dyn Fn(_) -> _>
            }
            None => Box::new(|index: usize| index.to_string()),
        };
        self.names = paired.kept.iter().map(|kept| name(kept.index)).collect();
        self.clock_offset = offset;
        self.paired = paired;
        Ok(())
    }

    /// Names of all frames, where the bag was written from a folder.
    fn known_names(&self) -> Result<Option<Vec<String>>, RecordingError> {
        let text = self.bag.metadata().and_then(|known| known.get("frame_names"));
        let Some(text) = text else { return Ok(None) };
        let names: Vec<String> = serde_json::from_str(text).map_err(|error| {
            self.invalid("metadata: frame_names", error.to_string(), "Write the file again")
        })?;
        check_names(&self.path, &names)?;
        Ok(Some(names))
    }

    /// Joints in degrees would put the arm anywhere.
    fn check_joints(&self) -> Result<(), RecordingError> {
        let farthest = |joint: usize| {
            let positions = self.paired.kept.iter().filter_map(|kept| kept.positions.get(joint));
            positions.copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0)
        };
        let joints = self.paired.names.iter().enumerate();
        let joints = joints.map(|(joint, name)| (name, farthest(joint)));
        let suspects: Vec<_> = joints.filter(|(_, far)| looks_like_degrees(*far)).collect();
        // Wheels, which a topic may tell of too, do turn so far; they are the lesser part.
        match suspects.first() {
            Some((name, position)) if 2 * suspects.len() >= self.paired.names.len() => {
                joints::check(&self.path, &self.topic(self.chosen.joints).name, "", name, *position)
            }
            _ => Ok(()),
        }
    }

    fn summary(&self, number: usize) -> Option<TopicSummary> {
        let topic = self.scan.topics.get(number)?;
        Some(summary(topic, self.role(number)))
    }

    /// What a topic is to the recording.
    fn role(&self, number: usize) -> Option<&'static str> {
        let Chosen { range, camera_info, joints, description, color, mask } = self.chosen;
        let roles = [
            (Some(range), "depth"),
            (camera_info, "intrinsics"),
            (Some(joints), "joints"),
            (description, "robot"),
            (color, "color"),
            (mask, "mask"),
        ];
        roles.into_iter().find(|(role, _)| *role == Some(number)).map(|(_, name)| name)
    }

    fn unreadable(
        &self,
        topic: &TopicScan,
        problem: &crate::message::WireProblem,
    ) -> RecordingError {
        let field = format!("{}: {}", topic.name, problem.field);
        self.invalid(&field, problem.problem.clone(), "Record it again")
    }
}

/// One stamp of so many may run backward: networks deliver some messages out of order.
const MOST_BACKWARD: u64 = 100;

fn seconds(ns: i64) -> String {
    format!("{:.3} s", ns as f64 * 1e-9)
}

/// The topics of the bag at `path`, whether or not they make a recording.
///
/// # Errors
///
/// A file that cannot be read or is damaged (unless `partial` is asked for).
pub fn list_topics(path: &Path, options: &BagOptions) -> Result<Vec<TopicSummary>, RecordingError> {
    let bag = Bag::open(path, options.scratch())?;
    let scan = Scan::new(&bag, options.partial)?;
    Ok(scan.topics.iter().map(|topic| summary(topic, None)).collect())
}

/// The transforms on `/tf_static` of the bag at `path`, the last for each child.
///
/// # Errors
///
/// A file that cannot be read or is damaged (unless `partial` is asked for).
pub fn static_transforms(
    path: &Path,
    options: &BagOptions,
) -> Result<Vec<StaticTransform>, RecordingError> {
    let bag = Bag::open(path, options.scratch())?;
    Ok(Scan::new(&bag, options.partial)?.static_transforms)
}

fn summary(topic: &TopicScan, role: Option<&'static str>) -> TopicSummary {
    let span_s = topic.last_ns.saturating_sub(topic.first_ns) as f64 * 1e-9;
    let rate_hz = topic.count.saturating_sub(1) as f64 / span_s;
    TopicSummary {
        name: topic.name.clone(),
        message_type: topic.message_type.clone(),
        role,
        count: topic.count,
        bytes: topic.bytes,
        rate_hz: Some(rate_hz).filter(|rate| *rate > 0.0 && rate.is_finite()),
        frame_id: topic.frame_id.clone(),
        problems: problems(topic),
    }
}

fn problems(topic: &TopicScan) -> Vec<String> {
    let mut problems = Vec::new();
    if let Some((_, problem)) = &topic.first_problem {
        problems.push(format!(
            "{} messages cannot be read, the first because of {}: {}",
            topic.unreadable, problem.field, problem.problem
        ));
    }
    if topic.stamps.unset > 0 {
        problems.push(format!(
            "{} messages have no time stamp; the time of recording stands in",
            topic.stamps.unset
        ));
    }
    let (backward, _) = topic.backward();
    if backward > 0 {
        problems.push(format!("{backward} time stamps run backward"));
    }
    problems
}

/// The frame of clouds that a flag once said, where eyebolt wrote the bag.
fn known_cloud_frame(bag: &Bag) -> Option<CloudFrame> {
    match bag.metadata()?.get("cloud_frame")?.as_str() {
        "optical" => Some(CloudFrame::Optical),
        "body" => Some(CloudFrame::Body),
        _ => None,
    }
}

/// How the clocks of depth and joints differ: by the motion, else by the times of recording.
fn clock_offset(
    range: &TopicScan,
    joints: &TopicScan,
    frames: &[FrameEntry],
    tracks: &[&Track],
) -> Option<ClockOffset> {
    let offset = stamps::clock_offset(&range.stamps, &joints.stamps);
    let known = offset.filter(|offset| offset.applied).map_or(0.0, |offset| offset.seconds);
    let Some(skew) = skew::skew(frames, tracks, (known * 1e9).round() as i64) else {
        return offset;
    };
    let (seconds, uncertainty_s) = (known + skew.seconds, skew.uncertainty_s);
    Some(ClockOffset { seconds, uncertainty_s, applied: true, seen: true })
}

/// What the bag says of the robot: its description, and the links where eyebolt wrote the bag.
fn robot(bag: &Bag, scan: &Scan, chosen: Chosen) -> RobotSection {
    let description = chosen.description.and_then(|number| scan.topics.get(number));
    let text = description.and_then(|topic| match &topic.content {
        Content::Text(text) => Some(text.clone()),
        _ => None,
    });
    let known = |key: &str| bag.metadata()?.get(key).cloned();
    RobotSection {
        urdf: None,
        description: text,
        base: known("base"),
        end_effector: known("end_effector"),
    }
}
