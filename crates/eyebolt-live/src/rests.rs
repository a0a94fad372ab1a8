//! What is heard while an arm rests, for those who look at each rest by itself.

use crate::incoming::Incoming;
use crate::settle::{Settle, Stillness};
use eyebolt_recording::{Glimpse, glimpse};
use std::collections::{BTreeMap, VecDeque};

/// Collects the messages around each rest of an arm: some images, the joints around them, and what was told once. Memory
/// does not grow.
#[derive(Debug, Default)]
pub struct Rests {
    settle: Settle,
    /// Intrinsics and descriptions: the last message of each topic.
    standing: BTreeMap<String, Incoming>,
    transforms: VecDeque<Incoming>,
    joints: VecDeque<Incoming>,
    images: Vec<Incoming>,
    /// When enough was heard of the present rest.
    over_ns: Option<i64>,
}

/// Images of a rest, and how far they are apart, nanoseconds.
const IMAGES: usize = 3;
const APART_NS: i64 = 200_000_000;
/// Joints are heard so long before the first image and after the last.
const AROUND_NS: i64 = 400_000_000;
/// An arm that goes on resting is looked at again after so long.
const AGAIN_NS: i64 = 10_000_000_000;
/// Messages that are kept: of joints at 1 kHz, and of static transforms.
const MOST_JOINTS: usize = 4000;
const MOST_TRANSFORMS: usize = 64;
const MOST_STANDING: usize = 100;

impl Rests {
    /// Takes in a message; all that is needed to look at the arm's present rest, in order of time, as soon as it is there.
    pub fn hear(&mut self, message: &Incoming) -> Option<Vec<Incoming>> {
        let now_ns = message.received_ns;
        match glimpse(&message.message_type, &message.data) {
            Ok(Glimpse::Joints { positions, .. }) => {
                self.settle.joints(now_ns, &positions);
                keep(&mut self.joints, message, MOST_JOINTS);
            }
            Ok(Glimpse::Depth { samples, .. }) => {
                self.settle.depth(now_ns, samples);
                self.see(message);
            }
            Ok(Glimpse::Transforms(_)) => keep(&mut self.transforms, message, MOST_TRANSFORMS),
            Ok(Glimpse::Description(_) | Glimpse::Other) => self.stand(message),
            Ok(Glimpse::Picture) | Err(_) => {}
        }
        self.judge(now_ns)
    }

    fn stand(&mut self, message: &Incoming) {
        if self.standing.contains_key(&message.topic) || self.standing.len() < MOST_STANDING {
            self.standing.insert(message.topic.clone(), message.clone());
        }
    }

    fn see(&mut self, image: &Incoming) {
        let at_rest = matches!(self.settle.at(image.received_ns), Stillness::AtRest(_));
        let later =
            |last: &Incoming| image.received_ns.saturating_sub(last.received_ns) >= APART_NS;
        let wanted = self.over_ns.is_none() && self.images.len() < IMAGES;
        if at_rest && wanted && self.images.last().is_none_or(later) {
            self.images.push(image.clone());
        }
    }

    fn judge(&mut self, now_ns: i64) -> Option<Vec<Incoming>> {
        let at_rest = matches!(self.settle.at(now_ns), Stillness::AtRest(_));
        let again = self.over_ns.is_some_and(|over| now_ns.saturating_sub(over) >= AGAIN_NS);
        if !at_rest || again {
            self.images.clear();
            self.over_ns = None;
            return None;
        }
        let last = self.images.get(IMAGES - 1)?;
        if now_ns.saturating_sub(last.received_ns) < AROUND_NS {
            return None;
        }
        self.over_ns = Some(now_ns);
        let images = std::mem::take(&mut self.images);
        let from_ns = images.first()?.received_ns.saturating_sub(AROUND_NS);
        let joints = self.joints.iter().filter(|joints| joints.received_ns >= from_ns);
        let standing = self.standing.values().chain(&self.transforms);
        let mut all: Vec<Incoming> = standing.chain(joints).cloned().chain(images).collect();
        all.sort_by_key(|message| message.received_ns);
        Some(all)
    }
}

fn keep(messages: &mut VecDeque<Incoming>, message: &Incoming, most: usize) {
    if messages.len() >= most {
        messages.pop_front();
    }
    messages.push_back(message.clone());
}
