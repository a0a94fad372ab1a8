//! Pictures of one topic, to be read again.

use super::pair::Kept;
use super::scan::{FrameEntry, TopicScan, Unfit};
use crate::bag::Encoding;

/// Pictures belong to a frame that are stamped no further from it than this, nanoseconds.
const SAME_MOMENT_NS: u64 = 50_000_000;

/// What is left of a topic when the scan is over.
#[derive(Debug)]
pub(super) struct PictureTopic {
    pub(super) name: String,
    pub(super) message_type: String,
    pub(super) encoding: Encoding,
    pub(super) frame_id: Option<String>,
    /// Whether its pictures are depth in whole millimetres.
    pub(super) in_millimetres: bool,
    pub(super) entries: Vec<FrameEntry>,
}

impl PictureTopic {
    /// The frames that take part, in their order.
    pub(super) fn kept(topic: &TopicScan, kept: &[Kept]) -> Self {
        let frames = topic.frames();
        let entry = |kept: &Kept| frames.get(kept.index).expect("frames that take part are there");
        Self::of(topic, kept.iter().map(|kept| entry(kept).clone()).collect())
    }

    /// The pictures of use, sorted by stamp.
    pub(super) fn pictures(topic: &TopicScan) -> Self {
        Self::by_stamp(topic, |entry| entry.unfit.is_none())
    }

    /// The backgrounds that can be read, sorted by stamp: those without any depth too, since a
    /// scene may well be out of the camera's range.
    pub(super) fn backgrounds(topic: &TopicScan) -> Self {
        Self::by_stamp(topic, |entry| !matches!(entry.unfit, Some(Unfit::Unreadable(_))))
    }

    fn by_stamp(topic: &TopicScan, fits: impl Fn(&FrameEntry) -> bool) -> Self {
        let mut sorted: Vec<_> = topic.frames().iter().filter(|e| fits(e)).cloned().collect();
        sorted.sort_by_key(|entry| entry.stamp_ns);
        Self::of(topic, sorted)
    }

    fn of(topic: &TopicScan, entries: Vec<FrameEntry>) -> Self {
        Self {
            name: topic.name.clone(),
            message_type: topic.message_type.clone(),
            encoding: topic.encoding.clone(),
            frame_id: topic.frame_id.clone(),
            in_millimetres: topic.is_in_millimetres(),
            entries,
        }
    }

    /// The picture of the moment `stamp_ns`, if there is one among those sorted by stamp.
    pub(super) fn nearest(&self, stamp_ns: i64) -> Option<&FrameEntry> {
        let after = self.entries.partition_point(|entry| entry.stamp_ns < stamp_ns);
        let around = self.entries.get(after.saturating_sub(1)..).unwrap_or_default();
        let nearest = around.iter().take(2).min_by_key(|e| e.stamp_ns.abs_diff(stamp_ns));
        nearest.filter(|entry| entry.stamp_ns.abs_diff(stamp_ns) <= SAME_MOMENT_NS)
    }

    /// Says which picture it is, for messages.
    pub(super) fn field(&self, entry: &FrameEntry) -> String {
        format!("{} at {:.3} s", self.name, entry.stamp_ns as f64 * 1e-9)
    }
}
