//! Calibration while it happens.
//!
//! A [`Session`] hears messages and says when the arm rests somewhere new, what is known by now, and when
//! that is enough. It knows no clock, no file and no network: whoever feeds it writes the messages down and
//! calibrates what is written. With the feature `dds`, [`Bus`] brings the messages of a ROS 2 system, and
//! publishes what was found; with the feature `web`, [`Web`] serves a page on it.

mod assessment;
mod choice;
#[cfg(feature = "dds")]
mod dds;
mod goal;
mod incoming;
mod names;
mod noise_level;
mod offer;
mod picture;
#[cfg(any(feature = "dds", test))]
mod queue;
mod rests;
mod session;
mod settle;
#[cfg(feature = "web")]
mod web;

pub use assessment::{Assessment, IdleJoint};
pub use choice::TopicChoice;
#[cfg(feature = "dds")]
pub use dds::{Bus, BusError, BusOptions, Outgoing};
pub use goal::Goal;
pub use incoming::Incoming;
pub use names::{dds_topic, dds_type, ros_topic, ros_type};
pub use offer::Offer;
pub use picture::pose_markers;
pub use rests::Rests;
pub use session::{Event, FEWEST, Session, Status};
pub use settle::{Settle, Stillness};
#[cfg(feature = "web")]
pub use web::{
    Account, Asked, Board, Coverage, Finding, JointCoverage, LinkCoverage, Next, NextJoint, Phase,
    Quality, Web, WebAddress, WebError, study,
};
