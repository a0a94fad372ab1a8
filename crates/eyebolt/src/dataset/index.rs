//! `index.jsonl`: a line for each frame.

use super::error::DatasetError;
use super::files::{read_text, write_whole};
use super::frame::DatasetFrame;
use super::shard::Shard;
use eyebolt_registration::Label;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// A frame of a recording, by which lines are found and sorted.
#[derive(Clone, Debug, Deserialize, Eq, Ord, PartialEq, PartialOrd, Serialize)]
pub struct FrameKey {
    /// Which recording: the ID in the names of its files.
    pub recording: String,
    /// The frame's number in it, from 0.
    pub number: usize,
}

/// What became of a frame.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct IndexLine {
    /// Which frame.
    #[serde(flatten)]
    pub key: FrameKey,
    /// The frame's name in the recording.
    pub frame: String,
    /// Where it is, if it was labelled.
    #[serde(flatten)]
    pub labelled: Option<FileLine>,
    /// Why it was left out, if it was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub left_out: Option<String>,
}

/// The file of a labelled frame.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct FileLine {
    /// Path in the data set's folder, with `/`.
    pub file: String,
    /// Its length.
    pub bytes: u64,
    /// BLAKE3 hash of its content, hexadecimal; where there is none, the file may be anything.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub blake3: Option<String>,
    /// How many pixels have each label.
    pub pixels: PixelCounts,
    /// Classes of the keypoints that are seen.
    pub keypoints_seen: Vec<u8>,
}

/// How many pixels have each label.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, Serialize)]
pub struct PixelCounts {
    /// Not the robot.
    pub background: usize,
    /// The robot without its end-effector.
    pub arm: usize,
    /// The end-effector.
    pub end_effector: usize,
    /// Depth of which nobody can say what it shows.
    pub ignore: usize,
    /// No depth.
    pub no_depth: usize,
}

impl FileLine {
    /// Of `frame`, whose file is `bytes`.
    pub(super) fn new(file: String, bytes: &[u8], frame: &DatasetFrame) -> Self {
        let mut seen: Vec<u8> =
            frame.keypoints.iter().copied().filter(|class| *class > 0).collect();
        seen.sort_unstable();
        seen.dedup();
        Self {
            file,
            bytes: bytes.len() as u64,
            blake3: Some(blake3::hash(bytes).to_string()),
            pixels: PixelCounts::of(frame),
            keypoints_seen: seen,
        }
    }
}

impl PixelCounts {
    fn of(frame: &DatasetFrame) -> Self {
        let mut counts = Self::default();
        for (label, z) in frame.labels.iter().zip(frame.depth.depth_m()) {
            let count = match label {
                _ if *z <= 0.0 => &mut counts.no_depth,
                Label::Background => &mut counts.background,
                Label::Arm => &mut counts.arm,
                Label::EndEffector => &mut counts.end_effector,
                Label::Ignore => &mut counts.ignore,
            };
            *count += 1;
        }
        counts
    }
}

/// Lines by the frames that they are of.
pub(super) type Index = BTreeMap<FrameKey, IndexLine>;

/// Name of the file that the frames of `shard` are in.
pub(super) fn file_name(shard: Shard) -> String {
    match shard {
        Shard::WHOLE => "index.jsonl".to_owned(),
        shard => format!("index.{}-of-{}.jsonl", shard.index(), shard.count()),
    }
}

/// The shard whose index a file of this name is.
pub(super) fn shard_of(file_name: &str) -> Option<Shard> {
    let numbers = file_name.strip_prefix("index.")?.strip_suffix(".jsonl")?;
    let (index, count) = numbers.split_once("-of-")?;
    Shard::new(index.parse().ok()?, count.parse().ok()?)
}

/// What to do about an index that is not whole.
const REMEDY: &str = "Remove the file and label the recordings again: frames that are there stay";

/// The lines of the file at `path`.
pub(super) fn read(path: &Path) -> Result<Index, DatasetError> {
    let text = read_text(path, REMEDY)?;
    let mut index = Index::new();
    for (number, line) in (1..).zip(text.lines()) {
        let invalid = |problem: String| {
            DatasetError::invalid(path, format!("line {number}"), problem, REMEDY)
        };
        let line: IndexLine = serde_json::from_str(line).map_err(|e| invalid(e.to_string()))?;
        if line.labelled.is_some() == line.left_out.is_some() {
            return Err(invalid("neither file nor left_out, or both".to_owned()));
        }
        let key = line.key.clone();
        if index.insert(key, line).is_some() {
            return Err(invalid("this frame has a line already".to_owned()));
        }
    }
    Ok(index)
}

/// Writes `index` to `path`, whole, in the order of recordings and frames.
pub(super) fn write(path: &Path, index: &Index) -> Result<(), DatasetError> {
    let mut text = String::new();
    for line in index.values() {
        text += &serde_json::to_string(line).expect("a line is plain data");
        text.push('\n');
    }
    write_whole(path, text.as_bytes())
}
