//! A database that is a bag, opened with care.

use super::fault::damaged;
use super::uri;
use crate::bag::bag_file::LARGEST_CHUNK;
use crate::bag::remedy::or_partial;
use crate::error::RecordingError;
use rusqlite::limits::Limit;
use rusqlite::{Connection, OpenFlags, OptionalExtension};
use std::path::Path;

/// Opens the database at `path`, if it has the tables of a bag.
pub(super) fn connect(path: &Path) -> Result<Connection, RecordingError> {
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY
        | OpenFlags::SQLITE_OPEN_NO_MUTEX
        | OpenFlags::SQLITE_OPEN_URI;
    let opened = Connection::open_with_flags(uri::untouched(path), flags).and_then(|connection| {
        // A hostile file must not make SQLite evaluate its own expressions, or large values.
        connection.pragma_update(None, "trusted_schema", false)?;
        connection.pragma_update(None, "cell_size_check", true)?;
        let limit = i32::try_from(LARGEST_CHUNK).unwrap_or(i32::MAX);
        connection.set_limit(Limit::SQLITE_LIMIT_LENGTH, limit)?;
        Ok(connection)
    });
    let connection = opened.map_err(|error| damaged(path, &error))?;
    for table in ["topics", "messages"] {
        check_table(path, &connection, table)?;
    }
    Ok(connection)
}

/// A view or virtual table in a table's place could run for ever.
fn check_table(path: &Path, connection: &Connection, table: &str) -> Result<(), RecordingError> {
    let sql = "SELECT sql FROM sqlite_master WHERE type = 'table' AND name = ?1";
    let found = connection.query_row(sql, [table], |row| row.get::<_, String>(0)).optional();
    let found = found.map_err(|error| damaged(path, &error))?;
    // A virtual table is not listed as one in the words; computed columns are hidden.
    let plain = found.is_some_and(|sql| sql.to_ascii_uppercase().starts_with("CREATE TABLE"));
    let sql = "SELECT count(*) FROM pragma_table_xinfo(?1) WHERE hidden != 0";
    let computed: Result<i64, _> = connection.query_row(sql, [table], |row| row.get(0));
    if plain && computed.map_err(|error| damaged(path, &error))? == 0 {
        return Ok(());
    }
    let problem = "the database has no such table, so it is no bag";
    let remedy = "Give the file or folder that `ros2 bag record` wrote";
    Err(RecordingError::invalid(path, format!("table {table}"), problem, remedy))
}

/// What is missing at the end of the file; SQLite reads zeros in the place of half a page.
pub(super) fn cut_short(path: &Path, connection: &Connection) -> Option<RecordingError> {
    let pragma = |name: &str| {
        let value = connection.pragma_query_value(None, name, |row| row.get::<_, i64>(0));
        u64::try_from(value.ok()?).ok()
    };
    let should_be = pragma("page_count")?.checked_mul(pragma("page_size")?)?;
    let length = std::fs::metadata(path).ok()?.len();
    if uri::has_more(path) || length >= should_be {
        return None;
    }
    let problem = format!("the file is cut short: it has {length} of {should_be} bytes");
    let remedy = or_partial("Copy it again", "to use what can be read");
    Some(RecordingError::invalid(path, "database", problem, remedy))
}
