//! Bags that others wrote, damaged ones, and ones that nobody should write.

mod folders;
mod limits;
mod mcap_damage;
mod mcap_records;
mod mcap_writer;
mod readers;
mod rosbags;
mod sqlite;
mod support;
