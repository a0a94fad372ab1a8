//! One pass over a bag: what every topic is, where the frames lie, and where the joints were.

mod joints;
mod pictures;
mod topic;

pub(super) use pictures::{FrameEntry, PictureKind, Unfit};
pub(super) use topic::{Content, TopicScan, is_static};

use crate::bag::{Bag, Locator, Message, Topic};
use crate::error::RecordingError;
use crate::message::StaticTransform;
use std::collections::BTreeMap;

/// What a scan found.
#[derive(Debug, Default)]
pub(super) struct Scan {
    pub(super) topics: Vec<TopicScan>,
    pub(super) static_transforms: Vec<StaticTransform>,
    /// Parts of the bag that could not be read and were passed over, if that was allowed.
    pub(super) damage: Vec<RecordingError>,
}

/// Static transforms kept.
const MOST_TRANSFORMS: usize = 10_000;

impl Scan {
    /// Reads all of `bag`. With `partial`, damaged parts are passed over and listed.
    pub(super) fn new(bag: &Bag, partial: bool) -> Result<Self, RecordingError> {
        let mut scan = Self::default();
        let mut damage = Vec::new();
        let mut numbers: BTreeMap<(u32, usize), usize> = BTreeMap::new();
        let mut topics: BTreeMap<Topic, usize> = BTreeMap::new();
        bag.scan(
            &mut |locator, message| {
                let key = (locator.file(), message.topic_index);
                // The topic may be known of another file.
                let number = *numbers.entry(key).or_insert_with(|| {
                    *topics.entry(message.topic.clone()).or_insert_with(|| {
                        scan.topics.push(TopicScan::new(message));
                        scan.topics.len() - 1
                    })
                });
                scan.add(number, locator, message);
                Ok(())
            },
            &mut |error| {
                // One damaged chunk is told like a thousand.
                if partial && damage.len() < MOST_DAMAGE {
                    damage.push(error);
                    return Ok(());
                }
                if partial { Ok(()) } else { Err(error) }
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

    fn add(&mut self, number: usize, locator: Locator, message: &Message<'_>) {
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

    fn finish(&mut self) {
        self.topics.sort_by(|a, b| a.name.cmp(&b.name));
        self.topics.iter_mut().for_each(TopicScan::finish);
    }
}

/// Damaged parts that are listed.
const MOST_DAMAGE: usize = 100;
