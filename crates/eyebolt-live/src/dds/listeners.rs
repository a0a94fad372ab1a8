//! Topics that are listened to.

use super::gaps::Gaps;
use super::raw::{AsBytes, Raw};
use crate::choice::TopicChoice;
use crate::incoming::Incoming;
use crate::names::{dds_topic, dds_type, ros_topic, ros_type};
use crate::offer::Offer;
use crate::queue::Queue;
use rustdds::dds::CreateResult;
use rustdds::no_key::DataReader;
use rustdds::policy::{Durability, History, Reliability};
use rustdds::{
    DomainParticipant, Duration, GUID, QosPolicies, QosPolicyBuilder, Subscriber, TopicKind,
};
use std::collections::{BTreeMap, BTreeSet};

/// Topics that are listened to, by their names in ROS.
pub(super) struct Listeners {
    participant: DomainParticipant,
    subscriber: Subscriber,
    choice: TopicChoice,
    listeners: BTreeMap<String, Listener>,
    account: Account,
}

/// What outlives a participant.
#[derive(Default)]
pub(super) struct Account {
    /// Topics that turned out not to be needed.
    closed: BTreeSet<String>,
    /// What came of each topic: publishers go on counting while nobody hears them.
    gaps: BTreeMap<String, Gaps<GUID>>,
}

struct Listener {
    message_type: String,
    asked: Offer,
    reader: DataReader<Raw, AsBytes>,
}

/// Messages that wait in the transport until they are taken. Of images it is taken some hundred times a second.
const DEPTH: i32 = 64;
/// Topics listened to at a time.
const MOST_TOPICS: usize = 200;
/// Messages taken of a topic before the others have their turn.
const AT_ONCE: usize = 64;

impl Listeners {
    pub(super) fn new(
        participant: &DomainParticipant,
        choice: TopicChoice,
        account: Account,
    ) -> CreateResult<Self> {
        let subscriber = participant.create_subscriber(&QosPolicyBuilder::new().build())?;
        let (participant, listeners) = (participant.clone(), BTreeMap::new());
        Ok(Self { participant, subscriber, choice, listeners, account })
    }

    /// What outlives the participant.
    pub(super) fn into_account(self) -> Account {
        self.account
    }

    /// Listens to `topic` no longer.
    pub(super) fn close(&mut self, topic: &str) {
        self.listeners.remove(topic);
        self.account.closed.insert(topic.to_owned());
    }

    /// Looks for publishers, and listens to those that are wanted in the way that all of them offer.
    pub(super) fn discover(&mut self) -> CreateResult<()> {
        let mut offers: BTreeMap<(String, String), Vec<Offer>> = BTreeMap::new();
        for writer in self.participant.discovered_writers() {
            let data = &writer.publication_topic_data;
            let named = ros_topic(&data.topic_name).zip(ros_type(&data.type_name));
            let Some((topic, message_type)) = named else { continue };
            if self.choice.wants(&topic, &message_type) && !self.account.closed.contains(&topic) {
                offers.entry((topic, message_type)).or_default().push(offer(&data.qos()));
            }
        }
        for ((topic, message_type), offers) in offers {
            let Some(asked) = Offer::of_all(offers) else { continue };
            let known = self.listeners.get(&topic);
            // Asking for less than before is needed to hear somebody new; asking for more is not.
            if known.is_some_and(|known| {
                known.message_type != message_type || asked.suffices(known.asked)
            }) {
                continue;
            }
            if known.is_none() && self.listeners.len() >= MOST_TOPICS {
                continue;
            }
            let listener = self.listener(&topic, message_type, asked)?;
            tracing::debug!(topic, reliable = asked.reliable, latched = asked.latched, "listening");
            self.listeners.insert(topic, listener);
        }
        Ok(())
    }

    fn listener(&self, topic: &str, message_type: String, asked: Offer) -> CreateResult<Listener> {
        let qos = qos(asked, DEPTH);
        let (name, kind) = (dds_topic(topic), dds_type(&message_type));
        let dds = self.participant.create_topic(name, kind, &qos, TopicKind::NoKey)?;
        let reader = self.subscriber.create_datareader_no_key::<Raw, AsBytes>(&dds, Some(qos))?;
        Ok(Listener { message_type, asked, reader })
    }

    /// Puts what came into `queue`, stamped by `now_ns`; whether there was anything.
    pub(super) fn take(&mut self, queue: &Queue, now_ns: impl Fn() -> i64) -> bool {
        let mut any = false;
        for (topic, listener) in &mut self.listeners {
            let gaps = self.account.gaps.entry(topic.clone()).or_default();
            for _ in 0..AT_ONCE {
                // What the transport cannot read is told by the gap that it leaves.
                let Ok(Some(sample)) = listener.reader.take_next_sample() else { break };
                any = true;
                let info = sample.sample_info();
                let number = info.sample_identity().sequence_number.into();
                let lost_before = gaps.before(info.writer_guid(), number);
                queue.push(Incoming {
                    topic: topic.clone(),
                    message_type: listener.message_type.clone(),
                    data: sample.into_value().0,
                    received_ns: now_ns(),
                    lost_before,
                });
            }
        }
        any
    }
}

/// What a publisher offers; what it does not say is the least.
fn offer(qos: &QosPolicies) -> Offer {
    let latched =
        qos.durability().is_some_and(|durability| durability >= Durability::TransientLocal);
    Offer { reliable: matches!(qos.reliability(), Some(Reliability::Reliable { .. })), latched }
}

/// The quality of service of who asks for `asked`, or offers it.
pub(super) fn qos(asked: Offer, depth: i32) -> QosPolicies {
    let reliability = match asked.reliable {
        true => Reliability::Reliable { max_blocking_time: Duration::from_millis(100) },
        false => Reliability::BestEffort,
    };
    let durability = if asked.latched { Durability::TransientLocal } else { Durability::Volatile };
    QosPolicyBuilder::new()
        .reliability(reliability)
        .durability(durability)
        .history(History::KeepLast { depth })
        .build()
}
