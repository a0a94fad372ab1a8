//! A recording that is a bag: MCAP, a ROS 2 bag in SQLite, or a ROS 1 bag.
//!
//! One pass over the bag finds the topics, the frames of depth and the path of the joints; frames
//! are read when asked for. Memory grows by some bytes a frame, not by its pixels.

mod check;
mod choose;
mod clouds;
mod frames;
mod pair;
mod scan;
mod stamps;
mod summary;
mod track;

pub use pair::{DropReason, DroppedFrame};
pub use stamps::ClockOffset;
pub use summary::TopicSummary;

use crate::bag::{Bag, BagKind};
use crate::camera_info::CameraInfo;
use crate::error::RecordingError;
use crate::manifest::{CloudFrame, RobotSection};
use crate::message::{CameraInfoMessage, StaticTransform, WireReader};
use choose::Chosen;
use eyebolt_geometry::PinholeCamera;
use eyebolt_robot::JointPositions;
use pair::{Kept, Paired};
use scan::{Content, FrameEntry, Scan, TopicScan};
use std::path::{Path, PathBuf};

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
}

impl BagRecording {
    /// Opens the bag at `path`, a file or a folder, and reads it once.
    ///
    /// # Errors
    ///
    /// A file that cannot be read or is damaged (unless `partial` is asked for), no topic or
    /// several that could be meant, a camera that cannot be read, or no frame that can be used.
    pub fn open(path: &Path, options: &BagOptions) -> Result<Self, RecordingError> {
        let here = Path::new(".");
        let scratch =
            if options.scratch.as_os_str().is_empty() { here } else { options.scratch.as_path() };
        let bag = Bag::open(path, scratch)?;
        let scan = Scan::new(&bag, options.partial)?;
        let chosen = Chosen::new(path, &scan, options)?;
        let mut recording = Self {
            path: path.to_path_buf(),
            camera: None,
            robot: robot(&bag, &scan, chosen),
            paired: Paired::default(),
            names: Vec::new(),
            clock_offset: None,
            cloud_frame: options.cloud_frame,
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

    /// Transforms of `/tf_static`, the last for each child.
    pub fn static_transforms(&self) -> &[StaticTransform] {
        &self.scan.static_transforms
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
        let offset = stamps::clock_offset(&range.stamps, &joints.stamps);
        let frames = self.entries(self.chosen.range);
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
        self.names = paired.kept.iter().map(|kept| kept.index.to_string()).collect();
        self.clock_offset = offset;
        self.paired = paired;
        Ok(())
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
