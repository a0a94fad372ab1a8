//! ROS 2's bags in SQLite (`rosbag2_storage_sqlite3`).

mod uri;

use super::{BagFile, Encoding, LARGEST_CHUNK, Message, Place, Topic, ros_type};
use crate::error::RecordingError;
use rusqlite::limits::Limit;
use rusqlite::{Connection, OpenFlags, OptionalExtension, Row};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The first bytes of a file.
pub(super) const FILE_MAGIC: &[u8; 15] = b"SQLite format 3";

/// A bag in SQLite.
#[derive(Debug)]
pub(crate) struct SqliteFile {
    path: PathBuf,
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
        let mut file =
            Self { path: path.to_path_buf(), topics: Vec::new(), index_of: BTreeMap::new() };
        let connection = file.connect()?;
        let listed = file.list_topics(&connection);
        file.fill(listed.map_err(|error| file.damaged(&error))?);
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

    fn list_topics(&self, connection: &Connection) -> rusqlite::Result<Vec<(i64, Topic)>> {
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

    fn connect(&self) -> Result<Connection, RecordingError> {
        let flags = OpenFlags::SQLITE_OPEN_READ_ONLY
            | OpenFlags::SQLITE_OPEN_NO_MUTEX
            | OpenFlags::SQLITE_OPEN_URI;
        let opened =
            Connection::open_with_flags(uri::untouched(&self.path), flags).and_then(|connection| {
                // A hostile file must not make SQLite evaluate its own expressions, or large values.
                connection.pragma_update(None, "trusted_schema", false)?;
                connection.pragma_update(None, "cell_size_check", true)?;
                let limit = i32::try_from(LARGEST_CHUNK).unwrap_or(i32::MAX);
                connection.set_limit(Limit::SQLITE_LIMIT_LENGTH, limit)?;
                Ok(connection)
            });
        let connection = opened.map_err(|error| self.damaged(&error))?;
        for table in ["topics", "messages"] {
            self.check_table(&connection, table)?;
        }
        Ok(connection)
    }

    /// A view or virtual table in a table's place could run for ever.
    fn check_table(&self, connection: &Connection, table: &str) -> Result<(), RecordingError> {
        let sql = "SELECT sql FROM sqlite_master WHERE type = 'table' AND name = ?1";
        let found = connection.query_row(sql, [table], |row| row.get::<_, String>(0)).optional();
        let found = found.map_err(|error| self.damaged(&error))?;
        // A virtual table is not listed as one in the words; computed columns are hidden.
        let plain = found.is_some_and(|sql| sql.to_ascii_uppercase().starts_with("CREATE TABLE"));
        let sql = "SELECT count(*) FROM pragma_table_xinfo(?1) WHERE hidden != 0";
        let computed: Result<i64, _> = connection.query_row(sql, [table], |row| row.get(0));
        if plain && computed.map_err(|error| self.damaged(&error))? == 0 {
            return Ok(());
        }
        let problem = "the database has no such table, so it is no bag";
        let remedy = "Give the file or folder that `ros2 bag record` wrote";
        Err(RecordingError::invalid(&self.path, format!("table {table}"), problem, remedy))
    }

    /// What is missing at the end of the file; SQLite reads zeros in the place of half a page.
    fn cut_short(&self, connection: &Connection) -> Option<RecordingError> {
        let pragma = |name: &str| {
            let value = connection.pragma_query_value(None, name, |row| row.get::<_, i64>(0));
            u64::try_from(value.ok()?).ok()
        };
        let should_be = pragma("page_count")?.checked_mul(pragma("page_size")?)?;
        let length = std::fs::metadata(&self.path).ok()?.len();
        if uri::has_more(&self.path) || length >= should_be {
            return None;
        }
        let problem = format!("the file is cut short: it has {length} of {should_be} bytes");
        let remedy = "Copy it again, or give --partial to use what can be read";
        Some(RecordingError::invalid(&self.path, "database", problem, remedy))
    }

    fn damaged(&self, error: &rusqlite::Error) -> RecordingError {
        let remedy = "The file is damaged or no bag: copy it again, or recover it with the \
                      `.recover` command of sqlite3";
        RecordingError::invalid(&self.path, "database", error.to_string(), remedy)
    }

    fn bad_row(&self, row: i64, problem: String) -> RecordingError {
        let remedy =
            "The message is damaged: copy the bag again, or give --partial to go without it";
        RecordingError::invalid(&self.path, format!("message {row}"), problem, remedy)
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
            Err(error) => return damage(self.damaged(&error)),
        };
        let index = self.index_of.get(&topic_id).copied();
        let Some((topic_index, topic)) = index.and_then(|i| Some((i, self.topics.get(i)?))) else {
            return damage(self.bad_row(id, format!("there is no topic {topic_id}")));
        };
        each(&Message { topic, topic_index, log_time_ns, place: Place::Row(id), data })
    }
}

impl BagFile for SqliteFile {
    fn scan(
        &self,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damage: &mut dyn FnMut(RecordingError) -> Result<(), RecordingError>,
    ) -> Result<(), RecordingError> {
        let connection = self.connect()?;
        self.cut_short(&connection).map_or(Ok(()), &mut *damage)?;
        // In the order of the table, and never sorted: that could take any time and room.
        let sql = "SELECT id, topic_id, timestamp, data FROM messages NOT INDEXED";
        let failed = |error: rusqlite::Error| self.damaged(&error);
        let mut statement = connection.prepare(sql).map_err(failed)?;
        let mut rows = statement.query([]).map_err(failed)?;
        let mut last = None;
        loop {
            match rows.next() {
                Ok(Some(row)) => {
                    // Pages that refer to one another would be read for ever.
                    let id: Option<i64> = row.get(0).ok();
                    if id <= last {
                        return damage(self.bad_row(last.unwrap_or(0), NOT_RISING.to_owned()));
                    }
                    last = id;
                    self.message_at(row, each, damage)?;
                }
                Ok(None) => return Ok(()),
                // The database cannot be read on from here.
                Err(error) => return damage(self.damaged(&error)),
            }
        }
    }

    fn read(&self, place: Place) -> Result<Vec<u8>, RecordingError> {
        let Place::Row(id) = place else {
            return Err(self.bad_row(0, "a byte was asked for".to_owned()));
        };
        let connection = self.connect()?;
        let sql = "SELECT data FROM messages WHERE id = ?1";
        connection.query_row(sql, [id], |row| row.get(0)).map_err(|error| self.damaged(&error))
    }
}
