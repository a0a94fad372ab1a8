//! A small recording in a bag, to be changed by tests.

use super::writer::{self, Message, write_mcap};
use eyebolt_recording::{
    BagOptions, BagRecording, FrameSource, Range, RecordingError, StaticTransform,
    static_transforms,
};
use std::collections::BTreeMap;
use std::path::PathBuf;
use tempfile::TempDir;

pub const MS: i64 = 1_000_000;
/// When the recording begins, nanoseconds.
pub const START_NS: i64 = 1_700_000_000_000_000_000;
/// Size of the camera, pixels.
pub const SIZE: (u32, u32) = (4, 3);
pub const PIXELS: usize = 12;

pub const IMAGE: &str = "sensor_msgs/Image";
pub const CLOUD: &str = "sensor_msgs/PointCloud2";
pub const CAMERA_INFO: &str = "sensor_msgs/CameraInfo";
pub const JOINT_STATE: &str = "sensor_msgs/JointState";
pub const STRING: &str = "std_msgs/String";

pub const DEPTH_TOPIC: &str = "/camera/depth/image_raw";
pub const INFO_TOPIC: &str = "/camera/depth/camera_info";
pub const FRAME: &str = "camera_optical";

/// Messages of a bag, sorted by time when it is written.
#[derive(Clone, Default)]
pub struct Bag {
    pub messages: Vec<Message>,
    /// As eyebolt writes it into bags of its own.
    pub metadata: BTreeMap<String, String>,
    pub options: BagOptions,
}

/// Name of its file.
const NAME: &str = "bag.mcap";

/// A bag that was opened, and the folder that it lies in.
pub struct Opened {
    pub recording: BagRecording,
    folder: TempDir,
}

impl Opened {
    pub fn static_transforms(&self) -> Vec<StaticTransform> {
        static_transforms(&self.folder.path().join(NAME), &BagOptions::default()).unwrap()
    }
}

impl std::ops::Deref for Opened {
    type Target = BagRecording;

    fn deref(&self) -> &BagRecording {
        &self.recording
    }
}

/// Where the joints are: at rest for 1.5 s, then half a second on to the next place, three times.
pub fn position(since_start_ns: i64) -> f64 {
    let since_start_ns = since_start_ns.max(0);
    let (step, within) =
        (since_start_ns.div_euclid(2000 * MS), since_start_ns.rem_euclid(2000 * MS));
    let moved = ((within - 1500 * MS).max(0) as f64) / (500.0 * MS as f64);
    0.3 * (step as f64 + moved)
}

impl Bag {
    /// Six seconds: joints every 10 ms, depth every 100 ms (5 ms behind a joint state), intrinsics.
    pub fn sample() -> Self {
        Self::default().with_joints(&["shoulder", "elbow"]).with_depth().with_info(INFO_TOPIC)
    }

    pub fn with_joints(mut self, names: &[&str]) -> Self {
        for i in 0..600 {
            let at = position(10 * MS * i);
            let joints: Vec<_> =
                names.iter().zip([at, -at, 0.1, 0.2]).map(|(n, p)| (*n, p)).collect();
            self.joints(START_NS + 10 * MS * i, &joints);
        }
        self
    }

    pub fn with_depth(mut self) -> Self {
        for i in 0..60 {
            let depth: Vec<f32> =
                (0..PIXELS).map(|pixel| 1.0 + 0.01 * (i as f32 + pixel as f32)).collect();
            let stamp = START_NS + 100 * MS * i + 5 * MS;
            self.add(DEPTH_TOPIC, IMAGE, stamp, writer::depth(stamp, FRAME, SIZE, &depth));
        }
        self
    }

    pub fn with_info(mut self, topic: &str) -> Self {
        self.add(topic, CAMERA_INFO, START_NS, writer::camera_info(START_NS, FRAME, SIZE, 5.0));
        self
    }

    pub fn add(
        &mut self,
        topic: &str,
        message_type: &'static str,
        log_time_ns: i64,
        data: Vec<u8>,
    ) {
        let topic = topic.to_owned();
        self.messages.push(Message { topic, message_type, log_time_ns, data });
    }

    pub fn joints(&mut self, stamp_ns: i64, joints: &[(&str, f64)]) {
        let data = writer::joint_state(stamp_ns, joints);
        self.add("/joint_states", JOINT_STATE, stamp_ns, data);
    }

    /// The messages of a topic, to be changed.
    pub fn on(&mut self, topic: &str) -> Vec<&mut Message> {
        self.messages.iter_mut().filter(|message| message.topic == topic).collect()
    }

    pub fn without(mut self, topic: &str) -> Self {
        self.messages.retain(|message| message.topic != topic);
        self
    }

    /// Replaces the stamps of a topic: `change` gets and gives nanoseconds.
    pub fn restamp(&mut self, topic: &str, change: impl Fn(usize, i64) -> i64) {
        let second = 1_000_000_000;
        for (index, message) in self.on(topic).into_iter().enumerate() {
            let number =
                |at: usize| u32::from_le_bytes(message.data[at..at + 4].try_into().unwrap());
            let old = i64::from(number(4)) * second + i64::from(number(8));
            let new = change(index, old);
            let seconds = i32::try_from(new.div_euclid(second)).unwrap();
            let rest = u32::try_from(new.rem_euclid(second)).unwrap();
            message.data[4..8].copy_from_slice(&seconds.to_le_bytes());
            message.data[8..12].copy_from_slice(&rest.to_le_bytes());
        }
    }

    /// Writes the bag, in order of time.
    pub fn write(&self) -> (TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(NAME);
        let mut messages = self.messages.clone();
        messages.sort_by_key(|message| message.log_time_ns);
        write_mcap(&path, &messages, &self.metadata);
        (folder, path)
    }

    pub fn try_open(&self) -> Result<Opened, RecordingError> {
        let (folder, path) = self.write();
        let recording = BagRecording::open(&path, &self.options)?;
        Ok(Opened { recording, folder })
    }

    #[track_caller]
    pub fn open(&self) -> Opened {
        self.try_open().unwrap_or_else(|error| panic!("{error}"))
    }

    #[track_caller]
    pub fn assert_says(&self, parts: &[&str]) {
        assert_says(self.try_open(), parts);
    }
}

impl Opened {
    /// The depths of a frame, metres.
    pub fn depth_m(&self, index: usize) -> Vec<f32> {
        match self.read_frame(index).unwrap().range {
            Range::Depth(image) => image.into_depth_m(),
            Range::Cloud(_) => panic!("it is a cloud"),
        }
    }

    /// The reasons for which frames were dropped, with the numbers of the frames.
    pub fn reasons(&self) -> Vec<(usize, String)> {
        let dropped = self.dropped_frames().iter();
        dropped.map(|frame| (frame.index, frame.reason.to_string())).collect()
    }

    /// What is said of a topic.
    pub fn problems(&self, topic: &str) -> Vec<String> {
        self.topics().into_iter().find(|known| known.name == topic).unwrap().problems
    }

    /// The topic with this role.
    pub fn role(&self, role: &str) -> Option<String> {
        let topic = self.topics().into_iter().find(|topic| topic.role == Some(role));
        topic.map(|topic| topic.name)
    }
}

/// Checks that the text of the error has all `parts`.
#[track_caller]
pub fn assert_says<T>(result: Result<T, RecordingError>, parts: &[&str]) {
    let Err(error) = result else { panic!("no error, expected one with {parts:?}") };
    let text = error.to_string();
    for part in parts {
        assert!(text.contains(part), "no {part:?} in: {text}");
    }
}

/// Frames and positions of shoulder and elbow are those of the sample, these to `within` radians.
#[track_caller]
pub fn assert_arm_as_in_sample(bag: &Bag, within: f64) {
    let (bag, sample) = (bag.open(), Bag::sample().open());
    assert_eq!(bag.frame_names(), sample.frame_names());
    for index in 0..bag.frame_names().len() {
        let (found, known) = (bag.read_joints(index).unwrap(), sample.read_joints(index).unwrap());
        for joint in ["shoulder", "elbow"] {
            let apart = (found.get(joint).unwrap() - known.get(joint).unwrap()).abs();
            assert!(apart < within, "{joint} is {apart} off in frame {index}");
        }
    }
}
