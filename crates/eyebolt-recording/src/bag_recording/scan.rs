//! One pass over a bag: what every topic is, where the frames lie, and where the joints were.

mod joints;
mod pictures;
mod topic;

pub(super) use pictures::{FrameEntry, PictureKind, Unfit};
pub(super) use topic::{Content, TopicScan, is_static};

use crate::bag::{Bag, Locator, Message, Topic};
use crate::error::RecordingError;
use crate::message::StaticTransform;
use crate::own_metadata::is_session;
use std::collections::BTreeMap;

/// What a scan found.
#[derive(Debug, Default)]
pub(super) struct Scan {
    pub(super) topics: Vec<TopicScan>,
    pub(super) static_transforms: Vec<StaticTransform>,
    /// Parts of the bag that could not be read and were passed over, if that was allowed.
    pub(super) damage: Vec<RecordingError>,
}

/// Numbers of the topics, which several files may share.
#[derive(Debug, Default)]
pub(super) struct Numbers {
    /// By file and number in it.
    known: BTreeMap<(u32, usize), usize>,
    topics: BTreeMap<Topic, usize>,
}

impl Numbers {
    /// The number of the topic of `message` in `scan`, where it is added if it is new.
    pub(super) fn of(&mut self, scan: &mut Scan, locator: Locator, message: &Message<'_>) -> usize {
        let key = (locator.file(), message.topic_index);
        *self.known.entry(key).or_insert_with(|| {
            *self.topics.entry(message.topic.clone()).or_insert_with(|| {
                scan.topics.push(TopicScan::new(message));
                scan.topics.len() - 1
            })
        })
    }
}

/// Static transforms kept.
const MOST_TRANSFORMS: usize = 10_000;

impl Scan {
    /// Reads all of `bag`. With `partial`, damaged parts are passed over and listed.
    pub(super) fn new(bag: &Bag, partial: bool) -> Result<Self, RecordingError> {
        let mut scan = Self::default();
        let mut damage = Vec::new();
        let mut numbers = Numbers::default();
        // A session that was killed while it was recorded is whole up to there.
        let may_end_early = is_session(bag.metadata());
        bag.scan(
            &mut |locator, message| {
                let number = numbers.of(&mut scan, locator, message);
                scan.add(number, locator, message);
                Ok(())
            },
            &mut |error| {
                let early = matches!(error, RecordingError::CutShort { .. }) && may_end_early;
                if !partial && !early {
                    return Err(error);
                }
                // One damaged chunk is told like a thousand.
                if damage.len() < MOST_DAMAGE {
                    damage.push(error);
                }
                Ok(())
            },
        )?;
        scan.damage = damage;
        scan.finish();
        Ok(scan)
    }

    /// Topic `number`.
    ///
    /// # Panics
    ///
    /// If it is not one that was chosen among these topics.
    pub(super) fn topic(&self, number: usize) -> &TopicScan {
        self.topics.get(number).expect("chosen topics are of the scan")
    }

    pub(super) fn add(&mut self, number: usize, locator: Locator, message: &Message<'_>) {
        let Some(topic) = self.topics.get_mut(number) else { return };
        topic.count += 1;
        topic.bytes += message.data.len() as u64;
        topic.first_ns = topic.first_ns.min(message.log_time_ns);
        topic.last_ns = topic.last_ns.max(message.log_time_ns);
        match topic.add(message, locator) {
            Ok(found) => {
                found.into_iter().for_each(|transform| self.add_transform(transform));
            }
            Err(problem) => {
                topic.unreadable += 1;
                topic.first_problem.get_or_insert((message.log_time_ns, problem));
            }
        }
    }

    /// Publishers tell their transforms again and again; two parents of a frame are kept, for
    /// whoever reads them to complain about.
    fn add_transform(&mut self, transform: StaticTransform) {
        let same = |other: &&mut StaticTransform| {
            (&other.parent, &other.child) == (&transform.parent, &transform.child)
        };
        if let Some(known) = self.static_transforms.iter_mut().find(same) {
            *known = transform;
        } else if self.static_transforms.len() < MOST_TRANSFORMS {
            self.static_transforms.push(transform);
        }
    }

    pub(super) fn finish(&mut self) {
        self.topics.sort_by(|a, b| a.name.cmp(&b.name));
        self.topics.iter_mut().for_each(TopicScan::finish);
    }
}

/// Damaged parts that are listed.
const MOST_DAMAGE: usize = 100;
