//! Which ROS 2 system.

use anyhow::{Result, bail};
use eyebolt_live::{Bus, BusOptions, TopicChoice};
use std::time::{SystemTime, UNIX_EPOCH};

const ROS: &str = "ROS 2";

/// Which ROS 2 system.
#[derive(Clone, Debug, clap::Args)]
pub struct DomainArguments {
    /// Domain of the ROS 2 system to listen to [default: ROS_DOMAIN_ID, or 0]
    #[arg(long, help_heading = ROS, value_name = "ID", value_parser = clap::value_parser!(u16).range(0..=232))]
    pub ros_domain: Option<u16>,
    /// Talk to this machine alone, as with ROS_LOCALHOST_ONLY=1 or ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST
    #[arg(long, help_heading = ROS)]
    localhost_only: bool,
}

/// Bytes of messages that may wait while a disk or a core is busy: some seconds of images.
const MOST_BYTES: usize = 256 << 20;

impl DomainArguments {
    /// The domain.
    pub fn domain(&self) -> Result<u16> {
        if let Some(domain) = self.ros_domain {
            return Ok(domain);
        }
        match std::env::var("ROS_DOMAIN_ID").ok().filter(|text| !text.trim().is_empty()) {
            None => Ok(0),
            Some(text) => match text.trim().parse::<u16>() {
                Ok(domain) if domain <= 232 => Ok(domain),
                _ => bail!(
                    "ROS_DOMAIN_ID: {text:?} is no domain: 0 to 232. Correct it, or give --ros-domain"
                ),
            },
        }
    }

    /// Whether only this machine is talked to.
    pub fn is_local(&self) -> bool {
        let set = |name: &str, value: &str| std::env::var(name).is_ok_and(|set| set == value);
        self.localhost_only
            || set("ROS_LOCALHOST_ONLY", "1")
            || set("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    }

    /// Takes part in it.
    pub fn join(&self, choice: TopicChoice) -> Result<Bus> {
        let options = BusOptions {
            domain: self.domain()?,
            localhost_only: self.is_local(),
            choice,
            most_bytes: MOST_BYTES,
            clock: now_ns,
        };
        Ok(Bus::new(options)?)
    }
}

/// Nanoseconds since 1970.
#[allow(clippy::disallowed_methods, reason = "recorders write down when a message came")]
pub fn now_ns() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_nanos()).unwrap_or(i64::MAX)
}
