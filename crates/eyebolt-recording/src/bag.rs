//! Bags: files of messages with time stamps, whatever wrote them.

mod bag_file;
mod bytes;
mod cache;
mod files;
mod kind;
mod locator;
mod mcap;
mod message;
mod open;
mod remedy;
mod ros1;
mod sqlite;
mod tail;
#[cfg(test)]
mod tests;
mod topic;
mod zstd;

#[cfg(test)]
use bag_file::{BagFile, LARGEST_CHUNK};
pub use files::is_bag;
pub use kind::BagKind;
pub(crate) use locator::Locator;
pub(crate) use mcap::MAGIC as MCAP_MAGIC;
#[cfg(test)]
use message::Location;
pub(crate) use message::Message;
pub(crate) use open::Bag;
pub(crate) use tail::McapTail;
pub(crate) use topic::{Encoding, Topic, ros_type};
