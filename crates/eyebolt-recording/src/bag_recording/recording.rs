//! A recording in a bag, put together from what the steps of opening found.

use super::camera::read_camera;
use super::check::{check_background, check_joints, check_topics};
use super::choose::Chosen;
use super::clock::clock_offset;
use super::color_view::ColorView;
use super::copy_source::{CopyFacts, CopySource};
use super::frame_reader::FrameReader;
use super::known::Known;
use super::options::BagOptions;
use super::pair::{Kept, Paired, pair_topics};
use super::picture_topic::PictureTopic;
use super::scan::{FrameEntry, Scan};
use super::topics::summaries;
use crate::bag::{Bag, BagKind};
use crate::camera_info::CameraInfo;
use crate::color::{CameraPicture, ColorImage};
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::frame::Frame;
use crate::frame_source::{FrameSource, check_index};
use crate::manifest::{CloudFrame, RobotSection};
use crate::message::{StaticTransform, types};
use crate::provenance::{ClockOffset, DroppedFrame, Provenance, TopicSummary};
use eyebolt_geometry::{DepthImage, PinholeCamera, Transform};
use eyebolt_robot::JointPositions;
use std::io::{Read, Seek};
use std::path::{Path, PathBuf};

/// A recording in a bag. Frames are read when asked for, from as many threads as wanted.
#[derive(Debug)]
pub struct BagRecording {
    path: PathBuf,
    bag: Bag,
    camera: Option<CameraInfo>,
    robot: RobotSection,
    /// Names of the frames that take part.
    names: Vec<String>,
    /// The same frames: what the camera saw, and where the joints of these names were.
    range: PictureTopic,
    joint_names: Vec<String>,
    kept: Vec<Kept>,
    mask: Option<PictureTopic>,
    color: Option<PictureTopic>,
    /// Where the colour is of another camera.
    color_view: Option<ColorView>,
    background: Option<PictureTopic>,
    /// Of clouds.
    cloud_frame: Option<CloudFrame>,
    /// Where it is another than REP 118 says.
    depth_unit: Option<DepthUnit>,
    copy_facts: CopyFacts,
    static_transforms: Vec<StaticTransform>,
    provenance: Provenance,
}

impl BagRecording {
    /// Opens the bag at `path`, a file or a folder, and reads it once.
    ///
    /// # Errors
    ///
    /// A file that cannot be read or is damaged (unless `partial` is asked for), no topic or
    /// several that could be meant, a camera that cannot be read, or no frame that can be used.
    pub fn open(path: &Path, options: &BagOptions) -> Result<Self, RecordingError> {
        Self::of_bag(path, Bag::open(path, options.scratch())?, options)
    }

    /// Opens the bag that `reader` reads, from its first byte to its last, and reads it once: MCAP
    /// or a bag of ROS 1, in memory or wherever else. Messages call it `name`. Threads that read
    /// frames take turns at the reader.
    ///
    /// # Errors
    ///
    /// As of [`Self::open`]; a bag in SQLite, which only reads files.
    pub fn from_reader(
        name: &str,
        reader: impl Read + Seek + Send + 'static,
        options: &BagOptions,
    ) -> Result<Self, RecordingError> {
        let path = Path::new(name);
        Self::of_bag(path, Bag::from_reader(path, reader, options.scratch())?, options)
    }

    fn of_bag(path: &Path, bag: Bag, options: &BagOptions) -> Result<Self, RecordingError> {
        let scan = Scan::new(&bag, options.partial)?;
        Self::of_scan(path, bag, scan, options)
    }

    /// The recording that is in `bag`, of which `scan` is.
    pub(super) fn of_scan(
        path: &Path,
        bag: Bag,
        scan: Scan,
        options: &BagOptions,
    ) -> Result<Self, RecordingError> {
        let known = Known::new(bag.metadata());
        let chosen = Chosen::new(path, &scan, options, known.background())?;
        check_topics(path, &scan, &chosen, options.partial)?;
        let camera = read_camera(path, &bag, &scan, &chosen, options)?;
        check_background(path, &scan, &chosen, camera.is_some())?;

        let (depth, joints) = (scan.topic(chosen.range), scan.topic(chosen.joints));
        let tracks: Vec<_> = joints.tracks().iter().collect();
        let offset = clock_offset(depth, joints, &tracks);
        let paired = pair_topics(path, depth, &tracks, offset, options.max_motion)?;
        check_joints(path, joints, &paired)?;
        let names = frame_names(known.frame_names(path)?, depth.frames().len(), &paired);

        let color_view = ColorView::read(path, &bag, &scan, &chosen)?;
        let range = PictureTopic::kept(depth, &paired.kept);
        let depth_unit = options.depth_unit.or_else(|| known.depth_unit());
        let reader = FrameReader { path, bag: &bag, camera: None, unit: depth_unit };
        let cloud_frame = match options.cloud_frame.or_else(|| known.cloud_frame()) {
            None => first_cloud_frame(&reader, &range)?,
            told => told,
        };
        let topic = |number: Option<usize>| number.map(|number| scan.topic(number));
        let background = topic(chosen.background).map(PictureTopic::backgrounds);
        let provenance = Provenance {
            name: path.display().to_string(),
            kind: bag.kind().name(),
            files: bag.sources().map(Path::to_path_buf).collect(),
            dropped: paired.dropped,
            clock_offset: offset,
            motion_limit: Some(paired.motion_limit),
            depth_choice: chosen.depth_choice,
            untold_joints: joints
                .untold()
                .into_iter()
                .flat_map(|untold| untold.reasons(joints.count))
                .map(|(name, reason)| (name.to_owned(), reason))
                .collect(),
            damage: scan.damage.iter().map(ToString::to_string).collect(),
            topics: summaries(&scan, Some(&chosen)),
        };
        Ok(Self {
            path: path.to_path_buf(),
            camera,
            robot: known.robot(&scan, &chosen),
            names,
            joint_names: paired.names,
            kept: paired.kept,
            mask: topic(chosen.mask).map(PictureTopic::pictures),
            color: topic(chosen.color).map(PictureTopic::pictures),
            color_view,
            copy_facts: CopyFacts::new(&scan, &chosen, options, known, cloud_frame, depth_unit),
            depth_unit,
            range,
            background,
            cloud_frame,
            static_transforms: scan.static_transforms,
            provenance,
            bag,
        })
    }

    /// Frames that do not take part, with the reason.
    pub fn dropped_frames(&self) -> &[DroppedFrame] {
        &self.provenance.dropped
    }

    /// How far a joint may move while a frame is taken, radians or metres.
    pub fn motion_limit(&self) -> f64 {
        self.provenance.motion_limit.unwrap_or_default()
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

    /// What a writer of recordings asks of it.
    pub(crate) fn copy_source(&self) -> CopySource<'_> {
        CopySource {
            path: &self.path,
            bag: &self.bag,
            facts: &self.copy_facts,
            camera: self.camera(),
            camera_frame_id: self.camera_frame_id(),
            robot: &self.robot,
        }
    }

    fn is_in_rep_118(&self) -> bool {
        self.depth_unit.is_none_or(|unit| unit == DepthUnit::MILLIMETRES)
    }

    fn reader(&self) -> FrameReader<'_> {
        let (path, bag, unit) = (&self.path, &self.bag, self.depth_unit);
        FrameReader { path, bag, camera: self.camera(), unit }
    }
}

impl FrameSource for BagRecording {
    fn stamp_ns(&self, index: usize) -> Option<i64> {
        Some(self.range.entries.get(index)?.stamp_ns)
    }

    fn camera(&self) -> Option<&PinholeCamera> {
        self.camera.as_ref().map(|info| &info.camera)
    }

    /// Name of the camera's optical frame, which the frames are in; `None` where only the camera's
    /// body has a name, in which clouds were stored.
    fn camera_frame_id(&self) -> Option<&str> {
        let in_info = self.camera.as_ref().and_then(|info| info.frame_id.as_deref());
        let turned = self.cloud_frame == Some(CloudFrame::Body);
        let of_frames = self.range.frame_id.as_deref().filter(|_| !turned);
        of_frames.or(in_info)
    }

    fn static_transforms(&self) -> &[StaticTransform] {
        &self.static_transforms
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
        self.mask.is_some()
    }

    /// # Errors
    ///
    /// No such frame; a message that cannot be read, does not fit the camera or cannot be in its
    /// unit; an empty mask.
    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        let joints = self.read_joints(index)?;
        let entry = self.range.entries.get(index).expect("as many pictures as names");
        // Found when the bag was opened, unless no frame is a cloud.
        let cloud_frame = self.cloud_frame.unwrap_or(CloudFrame::Optical);
        let range = self.reader().range(&self.range, entry, cloud_frame)?;
        let picture = picture_of(self.mask.as_ref(), entry);
        let mask = picture.map(|(topic, mask)| {
            self.reader().mask(topic, mask, (&self.range.field(entry), &range))
        });
        let mask = mask.transpose()?;
        let name = self.names.get(index).cloned().unwrap_or_default();
        Ok(Frame { name, range, mask, joints })
    }

    /// # Errors
    ///
    /// No such frame.
    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        check_index(self, index)?;
        let kept = self.kept.get(index).expect("as many positions as names");
        let told = self.joint_names.iter().zip(kept.positions.iter().copied());
        let told = told.filter(|(_, position)| !position.is_nan());
        Ok(told.map(|(name, position)| (name.clone(), position)).collect())
    }

    /// Reads the colour picture of frame `index`; `None` if there is none of that moment.
    ///
    /// # Errors
    ///
    /// No such frame, or a message that cannot be read.
    fn read_color(&self, index: usize) -> Result<Option<ColorImage>, RecordingError> {
        check_index(self, index)?;
        let entry = self.range.entries.get(index).expect("as many pictures as names");
        let Some((topic, picture)) = picture_of(self.color.as_ref(), entry) else {
            return Ok(None);
        };
        let (Some(view), Some(camera)) = (&self.color_view, self.camera()) else {
            return self.reader().color(topic, picture);
        };
        let reader = FrameReader { camera: Some(&view.camera), ..self.reader() };
        let Some(color) = reader.color(topic, picture)? else { return Ok(None) };
        let depth = self.reader().depth_image(&self.range, entry)?;
        Ok(Some(view.seen_by(camera, &depth, &color)))
    }

    fn read_picture(&self, index: usize) -> Result<Option<CameraPicture>, RecordingError> {
        check_index(self, index)?;
        let entry = self.range.entries.get(index).expect("as many pictures as names");
        let Some((topic, picture)) = picture_of(self.color.as_ref(), entry) else {
            return Ok(None);
        };
        let view = self.color_view.as_ref();
        let Some(camera) = view.map(|view| &view.camera).or(self.camera()) else { return Ok(None) };
        let reader = FrameReader { camera: Some(camera), ..self.reader() };
        let Some(picture) = reader.color(topic, picture)? else { return Ok(None) };
        let depth_from_color = view.map_or(Transform::identity(), ColorView::depth_from_color);
        Ok(Some(CameraPicture { picture, camera: camera.clone(), depth_from_color }))
    }

    fn background_count(&self) -> usize {
        self.background.as_ref().map_or(0, |topic| topic.entries.len())
    }

    /// Reads background `index`, counted from 0 in order of time.
    ///
    /// # Errors
    ///
    /// No such background; a message that cannot be read, does not fit the camera or cannot be in
    /// its unit.
    fn read_background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        let found =
            self.background.as_ref().and_then(|topic| Some((topic, topic.entries.get(index)?)));
        let Some((topic, entry)) = found else {
            let (path, count) = (self.path.clone(), self.background_count());
            return Err(RecordingError::NoSuchBackground { path, index, count });
        };
        self.reader().depth_image(topic, entry)
    }

    /// A frame without depth may be left out, of which only the reading of compressed images tells;
    /// where damage is passed over, so may a damaged frame or background.
    fn may_leave_out(&self, error: &RecordingError) -> bool {
        let damaged = matches!(error, RecordingError::Invalid { .. });
        let empty = matches!(error, RecordingError::EmptyFrame { .. });
        empty || (self.copy_facts.partial && damaged)
    }

    fn in_millimetres(&self) -> bool {
        self.range.in_millimetres && self.is_in_rep_118()
    }

    fn integer_unit_m(&self) -> Option<f64> {
        let unit = self.depth_unit.unwrap_or(DepthUnit::MILLIMETRES);
        self.range.in_millimetres.then(|| unit.metres())
    }

    fn backgrounds_in_millimetres(&self) -> bool {
        self.background.as_ref().is_some_and(|topic| topic.in_millimetres) && self.is_in_rep_118()
    }

    fn provenance(&self) -> &Provenance {
        &self.provenance
    }
}

/// The picture of the moment of a frame, if there is such a topic and one on it.
fn picture_of<'a>(
    topic: Option<&'a PictureTopic>,
    frame: &FrameEntry,
) -> Option<(&'a PictureTopic, &'a FrameEntry)> {
    let topic = topic?;
    Some((topic, topic.nearest(frame.stamp_ns)?))
}

/// The names of the frames that take part: those that the bag has for its `count` frames, else
/// their numbers.
fn frame_names(known: Option<Vec<String>>, count: usize, paired: &Paired) -> Vec<String> {
    let known = known.filter(|names| names.len() == count).unwrap_or_default();
    let name = |kept: &Kept| known.get(kept.index).cloned().unwrap_or(kept.index.to_string());
    paired.kept.iter().map(name).collect()
}

/// The same frame for all clouds: that of the first one of use. `None` of depth images.
fn first_cloud_frame(
    reader: &FrameReader<'_>,
    range: &PictureTopic,
) -> Result<Option<CloudFrame>, RecordingError> {
    match range.entries.first().filter(|_| range.message_type == types::CLOUD) {
        Some(entry) => reader.cloud_frame(range, entry).map(Some),
        None => Ok(None),
    }
}
