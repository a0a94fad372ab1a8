//! Where frames come from, and what was found out on the way.

mod clock_offset;
mod depth_choice;
mod dropped_frame;
mod topic_summary;

pub use clock_offset::ClockOffset;
pub use depth_choice::DepthChoice;
pub use dropped_frame::{DropReason, DroppedFrame};
pub use topic_summary::TopicSummary;

use std::collections::BTreeMap;
use std::path::PathBuf;

/// Where the frames of a source come from, and what was found out on the way: plain data, for
/// people. What a source knows nothing of is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Name of the source, for messages: the path that it was opened by, if there is one.
    pub name: String,
    /// What kind of source it is, in a word or two: `folder`, `MCAP`...
    pub kind: &'static str,
    /// The files that it was read from; of a folder, the one that describes it.
    pub files: Vec<PathBuf>,
    /// Frames that do not take part, with the reason.
    pub dropped: Vec<DroppedFrame>,
    /// How the clocks of depth and joints differ; `None` if one of them sets no stamps.
    pub clock_offset: Option<ClockOffset>,
    /// How far a joint may move while a frame is taken, radians or metres.
    pub motion_limit: Option<f64>,
    /// Damaged parts that were passed over, in words.
    pub damage: Vec<String>,
    /// Why this topic of depth was taken, where several could be meant and nobody named one.
    pub depth_choice: Option<DepthChoice>,
    /// Joints that are named without a position that can be used, with what is wrong and how often.
    /// In frames of that time, they have none.
    pub untold_joints: BTreeMap<String, String>,
    /// All topics, sorted by name.
    pub topics: Vec<TopicSummary>,
}

impl Provenance {
    /// How many frames do not take part, by the name of the reason.
    #[must_use]
    pub fn dropped_by_reason(&self) -> BTreeMap<&'static str, usize> {
        let mut counts = BTreeMap::new();
        for frame in &self.dropped {
            *counts.entry(frame.reason.name()).or_default() += 1;
        }
        counts
    }
}

/// Nothing known.
pub(crate) static UNKNOWN: Provenance = Provenance {
    name: String::new(),
    kind: "",
    files: Vec::new(),
    dropped: Vec::new(),
    clock_offset: None,
    motion_limit: None,
    damage: Vec::new(),
    depth_choice: None,
    untold_joints: BTreeMap::new(),
    topics: Vec::new(),
};
