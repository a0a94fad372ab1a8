//! ROS 2's bags in SQLite (`rosbag2_storage_sqlite3`).

mod connection;
mod fault;
mod uri;

use super::bag_file::BagFile;
use super::message::{Location, Message};
use super::topic::{Encoding, Topic, ros_type};
use crate::error::RecordingError;
use connection::{connect, cut_short};
use fault::{bad_row, damaged};
use rusqlite::{Connection, Row};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The first bytes of a file.
pub(super) const FILE_MAGIC: &[u8; 15] = b"SQLite format 3";

/// A bag in SQLite.
#[derive(Debug)]
pub(crate) struct SqliteFile {
    path: PathBuf,
    /// For reading messages again, one at a time: it has a cache and a cursor that threads cannot
    /// share. A scan has a connection of its own, so that messages can be read within it.
    connection: Mutex<Connection>,
    topics: Vec<Topic>,
    /// Which of `topics` a `topic_id` is.
    index_of: BTreeMap<i64, usize>,
}

const NOT_RISING: &str = "the number of the next message is not higher";

/// Topics of the largest bag.
const MOST_TOPICS: usize = 100_000;

impl SqliteFile {
    /// Opens the bag and lists its topics.
    pub(crate) fn open(path: &Path) -> Result<Self, RecordingError> {
        let connection = connect(path)?;
        let listed = list_topics(&connection).map_err(|error| damaged(path, &error))?;
        let mut file = Self {
            path: path.to_path_buf(),
            connection: Mutex::new(connection),
            topics: Vec::new(),
            index_of: BTreeMap::new(),
        };
        file.fill(listed);
        Ok(file)
    }

    fn fill(&mut self, listed: Vec<(i64, Topic)>) {
        for (id, topic) in listed {
            let known = self.topics.iter().position(|other| *other == topic);
            let index = known.unwrap_or_else(|| {
                self.topics.push(topic);
                self.topics.len() - 1
            });
            self.index_of.insert(id, index);
        }
    }

    fn message_at(
        &self,
        row: &Row<'_>,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damage: &mut dyn FnMut(RecordingError) -> Result<(), RecordingError>,
    ) -> Result<(), RecordingError> {
        let fields = || -> rusqlite::Result<(i64, i64, i64, &[u8])> {
            Ok((row.get(0)?, row.get(1)?, row.get(2)?, row.get_ref(3)?.as_blob()?))
        };
        let (id, topic_id, log_time_ns, data) = match fields() {
            Ok(fields) => fields,
            Err(error) => return damage(damaged(&self.path, &error)),
        };
        let index = self.index_of.get(&topic_id).copied();
        let Some((topic_index, topic)) = index.and_then(|i| Some((i, self.topics.get(i)?))) else {
            return damage(bad_row(&self.path, id, format!("there is no topic {topic_id}")));
        };
        each(&Message { topic, topic_index, log_time_ns, place: Location::Row(id), data })
    }
}

impl BagFile for SqliteFile {
    fn scan(
        &self,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damage: &mut dyn FnMut(RecordingError) -> Result<(), RecordingError>,
    ) -> Result<(), RecordingError> {
        let connection = connect(&self.path)?;
        cut_short(&self.path, &connection).map_or(Ok(()), &mut *damage)?;
        // In the order of the table, and never sorted: that could take any time and room.
        let sql = "SELECT id, topic_id, timestamp, data FROM messages NOT INDEXED";
        let failed = |error: rusqlite::Error| damaged(&self.path, &error);
        let mut statement = connection.prepare(sql).map_err(failed)?;
        let mut rows = statement.query([]).map_err(failed)?;
        let mut last = None;
        loop {
            match rows.next() {
                Ok(Some(row)) => {
                    // Pages that refer to one another would be read for ever.
                    let id: Option<i64> = row.get(0).ok();
                    if id <= last {
                        return damage(bad_row(&self.path, last.unwrap_or(0), NOT_RISING));
                    }
                    last = id;
                    self.message_at(row, each, damage)?;
                }
                Ok(None) => return Ok(()),
                // The database cannot be read on from here.
                Err(error) => return damage(damaged(&self.path, &error)),
            }
        }
    }

    fn read(&self, place: Location) -> Result<Vec<u8>, RecordingError> {
        let Location::Row(id) = place else {
            return Err(bad_row(&self.path, 0, "a byte was asked for"));
        };
        // A read that panicked has left no statement behind.
        let connection = self.connection.lock().unwrap_or_else(PoisonError::into_inner);
        let sql = "SELECT data FROM messages WHERE id = ?1";
        let data = connection.query_row(sql, [id], |row| row.get(0));
        data.map_err(|error| damaged(&self.path, &error))
    }
}

fn list_topics(connection: &Connection) -> rusqlite::Result<Vec<(i64, Topic)>> {
    let sql = "SELECT id, name, type, serialization_format FROM topics ORDER BY id LIMIT ?1";
    let mut statement = connection.prepare(sql)?;
    let topic = |row: &Row<'_>| {
        let (id, name, kind, format): (i64, String, String, String) =
            (row.get(0)?, row.get(1)?, row.get(2)?, row.get(3)?);
        let encoding = if format == "cdr" { Encoding::Cdr } else { Encoding::Other(format) };
        Ok((id, Topic { name, message_type: ros_type(&kind), encoding }))
    };
    statement.query_map([MOST_TOPICS as i64], topic)?.collect()
}
