//! ROS 2 over DDS, without ROS: one participant that listens and publishes (RustDDS).
//!
//! Messages stay bytes: what comes over the wire is what bags have, and is decoded by the same code.

mod bus;
mod gaps;
mod guard;
mod listeners;
mod publishers;
mod raw;

pub use bus::{Bus, BusError, BusOptions};
pub use publishers::Outgoing;
