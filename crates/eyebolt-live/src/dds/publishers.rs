//! What is published.

use super::listeners::qos;
use super::raw::{AsBytes, Raw};
use crate::names::{dds_topic, dds_type};
use crate::offer::Offer;
use rustdds::dds::CreateResult;
use rustdds::no_key::DataWriter;
use rustdds::{DomainParticipant, Publisher, QosPolicyBuilder, TopicKind};
use std::collections::BTreeMap;

/// What is published.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outgoing {
    /// How the session stands: JSON in a `std_msgs/msg/String` on `/eyebolt/status`.
    Status,
    /// `visualization_msgs/msg/MarkerArray` on `/eyebolt/markers`.
    Markers,
    /// `tf2_msgs/msg/TFMessage` on `/tf_static`.
    StaticTransforms,
    /// What was last seen of a calibration that is watched: JSON in a `std_msgs/msg/String` on `/eyebolt/monitor`.
    Watched,
    /// `diagnostic_msgs/msg/DiagnosticArray` on `/diagnostics`.
    Diagnostics,
}

impl Outgoing {
    fn topic(self) -> (&'static str, &'static str) {
        match self {
            Self::Status => ("/eyebolt/status", "std_msgs/msg/String"),
            Self::Markers => ("/eyebolt/markers", "visualization_msgs/msg/MarkerArray"),
            Self::StaticTransforms => ("/tf_static", "tf2_msgs/msg/TFMessage"),
            Self::Watched => ("/eyebolt/monitor", "std_msgs/msg/String"),
            Self::Diagnostics => ("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"),
        }
    }
}

/// Publishers, each of which is there from its first message on.
pub(super) struct Publishers {
    participant: DomainParticipant,
    publisher: Publisher,
    writers: BTreeMap<Outgoing, DataWriter<Raw, AsBytes>>,
}

/// Whoever comes later gets the last message too.
const LATCHED: Offer = Offer { reliable: true, latched: true };

impl Publishers {
    pub(super) fn new(participant: &DomainParticipant) -> CreateResult<Self> {
        let publisher = participant.create_publisher(&QosPolicyBuilder::new().build())?;
        Ok(Self { participant: participant.clone(), publisher, writers: BTreeMap::new() })
    }

    /// Publishes a message in CDR.
    pub(super) fn publish(&mut self, what: Outgoing, data: Vec<u8>) -> CreateResult<()> {
        if !self.writers.contains_key(&what) {
            let ((topic, message_type), qos) = (what.topic(), qos(LATCHED, 1));
            let (name, kind) = (dds_topic(topic), dds_type(message_type));
            let dds = self.participant.create_topic(name, kind, &qos, TopicKind::NoKey)?;
            let writer =
                self.publisher.create_datawriter_no_key::<Raw, AsBytes>(&dds, Some(qos))?;
            self.writers.insert(what, writer);
        }
        if let Some(writer) = self.writers.get(&what) {
            // Only a full buffer fails, and then those who listen are too slow for what is not urgent.
            if writer.write(Raw(data), None).is_err() {
                tracing::debug!(?what, "not published");
            }
        }
        Ok(())
    }
}
