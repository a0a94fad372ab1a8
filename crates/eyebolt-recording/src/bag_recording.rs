//! A recording that is a bag: MCAP, a ROS 2 bag in SQLite, or a ROS 1 bag.
//!
//! One pass over the bag finds the topics, the frames of depth and the path of the joints; frames
//! are read when asked for. Memory grows by some bytes a frame, not by its pixels.

mod backgrounds;
mod check;
mod choose;
mod clouds;
mod copying;
mod frames;
mod opening;
mod options;
mod pair;
mod scan;
mod skew;
mod stamps;
mod topics;
mod track;

pub use options::BagOptions;
pub use topics::{list_topics, static_transforms};

use crate::bag::{Bag, BagKind};
use crate::camera_info::CameraInfo;
use crate::color::ColorImage;
use crate::error::RecordingError;
use crate::frame::Frame;
use crate::frame_source::FrameSource;
use crate::manifest::{CloudFrame, RobotSection};
use crate::message::WireProblem;
use crate::provenance::{ClockOffset, DroppedFrame, Provenance, TopicSummary};
use choose::Chosen;
use eyebolt_geometry::{DepthImage, PinholeCamera};
use eyebolt_robot::JointPositions;
use opening::{known_background, known_cloud_frame, robot};
use pair::{Kept, Paired};
use scan::{Content, FrameEntry, Scan, TopicScan};
use std::path::{Path, PathBuf};

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
    /// Masks and colour pictures that can be read, by their stamps.
    masks: Vec<FrameEntry>,
    colors: Vec<FrameEntry>,
    /// Those that can be read, by their stamps.
    backgrounds: Vec<FrameEntry>,
    provenance: Provenance,
    cloud_frame: Option<CloudFrame>,
    partial: bool,
    /// The intrinsics came from a file.
    camera_given: bool,
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
        let chosen = Chosen::new(path, &scan, options, known_background(&bag))?;
        let mut recording = Self {
            path: path.to_path_buf(),
            camera: None,
            robot: robot(&bag, &scan, chosen),
            paired: Paired::default(),
            names: Vec::new(),
            masks: by_stamp(&scan, chosen.mask),
            colors: by_stamp(&scan, chosen.color),
            backgrounds: backgrounds::backgrounds(&scan, chosen.background),
            provenance: Provenance::default(),
            cloud_frame: options.cloud_frame.or_else(|| known_cloud_frame(&bag)),
            partial: options.partial,
            camera_given: options.camera_info.is_some(),
            bag,
            scan,
            chosen,
        };
        recording.check_topics()?;
        recording.camera = recording.read_camera(options)?;
        recording.check_background()?;
        recording.pair(options.max_motion)?;
        recording.check_joints()?;
        recording.find_cloud_frame()?;
        recording.fill_provenance();
        Ok(recording)
    }

    /// Frames that do not take part, with the reason.
    pub fn dropped_frames(&self) -> &[DroppedFrame] {
        &self.provenance.dropped
    }

    /// How far a joint may move while a frame is taken, radians or metres.
    pub fn motion_limit(&self) -> f64 {
        self.paired.motion_limit
    }

    /// How the clocks of depth and joints differ; `None` if one of them sets no stamps.
    pub fn clock_offset(&self) -> Option<ClockOffset> {
        self.provenance.clock_offset
    }

    /// What wrote the bag.
    pub fn kind(&self) -> BagKind {
        self.bag.kind()
    }

    /// Damaged parts that were passed over, in words.
    pub fn damage(&self) -> &[String] {
        &self.provenance.damage
    }

    /// All topics, sorted by name.
    pub fn topics(&self) -> Vec<TopicSummary> {
        self.provenance.topics.clone()
    }

    fn fill_provenance(&mut self) {
        let topics = (0..self.scan.topics.len()).filter_map(|number| self.summary(number));
        self.provenance = Provenance {
            name: self.path.display().to_string(),
            kind: self.bag.kind().name(),
            files: self.bag.sources().map(Path::to_path_buf).collect(),
            topics: topics.collect(),
            damage: self.scan.damage.iter().map(ToString::to_string).collect(),
            motion_limit: Some(self.paired.motion_limit),
            dropped: std::mem::take(&mut self.paired.dropped),
            clock_offset: self.provenance.clock_offset,
        };
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

    fn unreadable(&self, topic: &TopicScan, problem: &WireProblem) -> RecordingError {
        let field = format!("{}: {}", topic.name, problem.field);
        self.invalid(&field, problem.problem.clone(), "Record it again")
    }
}

impl FrameSource for BagRecording {
    fn camera(&self) -> Option<&PinholeCamera> {
        self.camera.as_ref().map(|info| &info.camera)
    }

    /// Name of the camera's optical frame, which the frames are in; `None` where only the camera's
    /// body has a name, in which clouds were stored.
    fn camera_frame_id(&self) -> Option<&str> {
        let in_info = self.camera.as_ref().and_then(|info| info.frame_id.as_deref());
        let turned = self.cloud_frame == Some(CloudFrame::Body);
        let of_frames = self.range_topic().frame_id.as_deref().filter(|_| !turned);
        of_frames.or(in_info)
    }

    fn robot(&self) -> &RobotSection {
        &self.robot
    }

    /// Names of the frames that take part: their numbers among those of the topic, unless the bag
    /// has names for them.
    fn frame_names(&self) -> &[String] {
        &self.names
    }

    fn has_masks(&self) -> bool {
        self.chosen.mask.is_some()
    }

    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        self.frame(index)
    }

    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        let kept = self.kept(index)?;
        let names = self.paired.names.iter().cloned();
        Ok(names.zip(kept.positions.iter().copied()).collect())
    }

    fn read_color(&self, index: usize) -> Result<Option<ColorImage>, RecordingError> {
        self.color(index)
    }

    fn background_count(&self) -> usize {
        self.backgrounds.len()
    }

    fn read_background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        self.background(index)
    }

    /// A frame without depth may be left out, of which only the reading of compressed images tells,
    /// and a damaged one where damage is passed over.
    fn may_leave_out(&self, error: &RecordingError) -> bool {
        let damaged = matches!(error, RecordingError::Invalid { .. });
        matches!(error, RecordingError::EmptyFrame { .. }) || (self.partial && damaged)
    }

    fn in_millimetres(&self) -> bool {
        self.range_topic().is_in_millimetres()
    }

    fn backgrounds_in_millimetres(&self) -> bool {
        self.chosen.background.is_some_and(|number| self.topic(number).is_in_millimetres())
    }

    fn provenance(&self) -> &Provenance {
        &self.provenance
    }
}

/// The pictures of a topic that can be read, sorted by stamp.
fn by_stamp(scan: &Scan, topic: Option<usize>) -> Vec<FrameEntry> {
    let content = topic.and_then(|number| Some(&scan.topics.get(number)?.content));
    let Some(Content::Pictures(pictures)) = content else { return Vec::new() };
    let fit = pictures.frames.iter().filter(|entry| entry.unfit.is_none());
    let mut sorted: Vec<_> = fit.cloned().collect();
    sorted.sort_by_key(|entry| entry.stamp_ns);
    sorted
}
