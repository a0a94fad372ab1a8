//! Databases that are no bags, damaged or made to keep a reader busy.

use super::support::{assert_says, file, fixture, open, scan, scan_whole, strict};
use proptest::prelude::*;
use rusqlite::Connection;
use std::path::PathBuf;
use tempfile::TempDir;

const TOPICS: &str =
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT \
     NULL, serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
     INSERT INTO topics VALUES (1, '/notes', 'std_msgs/msg/String', 'cdr', '');";
const MESSAGES: &str = "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, \
     timestamp INTEGER NOT NULL, data BLOB NOT NULL);";

fn database(sql: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag.db3");
    Connection::open(&path).unwrap().execute_batch(sql).unwrap();
    (folder, path)
}

#[test]
fn tables_must_be_tables() {
    let view = "CREATE VIEW messages AS WITH RECURSIVE endless(id) AS (SELECT 1 UNION ALL SELECT id \
                + 1 FROM endless) SELECT id, 1 AS topic_id, id AS timestamp, x'00' AS data FROM endless;";
    let generated = "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, \
                     data BLOB GENERATED ALWAYS AS (zeroblob(400000000)));";
    let short = "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, \
                 data BLOB AS (zeroblob(400000000)));";
    for (sql, table) in [
        ("CREATE TABLE other(id);".to_owned(), "topics"),
        (TOPICS.to_owned(), "messages"),
        (format!("{TOPICS}{view}"), "messages"),
        (format!("{TOPICS}{generated}"), "messages"),
        (format!("{TOPICS}{short}"), "messages"),
        (format!("{TOPICS}CREATE VIRTUAL TABLE messages USING fts5(data);"), "messages"),
        (format!("CREATE VIEW topics AS SELECT 1; {MESSAGES}"), "topics"),
    ] {
        let (_folder, path) = database(&sql);
        assert_says(open(&path), &["bag.db3", &format!("table {table}"), "ros2 bag record"]);
    }
    let (_folder, path) = database(&format!("CREATE TABLE topics(id INTEGER); {MESSAGES}"));
    assert_says(open(&path), &["bag.db3: database: no such column: name"]);
}

#[test]
fn rows_of_other_types_cost_themselves_only() {
    let rows = "INSERT INTO messages VALUES (1, 1, 10, x'0001');
                INSERT INTO messages VALUES (2, 1, 20, 'text');
                INSERT INTO messages VALUES (3, 1, 'never', x'00');
                INSERT INTO messages VALUES (4, 7, 40, x'00');
                INSERT INTO messages VALUES (5, 1, 50, x'28b52ffdff');
                INSERT INTO messages VALUES (9, 1, 60, x'');";
    let (_folder, path) = database(&format!("{TOPICS}{MESSAGES}{rows}"));
    let bag = open(&path).unwrap();
    let (told, problems) = scan(&bag);
    let told: Vec<_> = told.into_iter().map(|t| (t.log_time_ns, t.data)).collect();
    assert_eq!(told, [(10, vec![0, 1]), (60, vec![])]);
    assert_eq!(problems.len(), 4, "{problems:?}");
    assert!(problems[2].contains("message 4: there is no topic 7"), "{problems:?}");
    assert!(problems[3].contains("/notes of 0.000 s: it cannot be decompressed"), "{problems:?}");
    assert_says(strict(&bag), &["bag.db3"]);
}

#[test]
fn pages_that_refer_to_one_another_are_not_followed_for_ever() {
    let rows = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 60)
                INSERT INTO messages SELECT i, 1, i, randomblob(200) FROM n;";
    let (_folder, path) = database(&format!("PRAGMA page_size = 512; {TOPICS}{MESSAGES}{rows}"));
    let whole = scan_whole(&open(&path).unwrap()).len();
    let root: i64 = Connection::open(&path)
        .unwrap()
        .query_row("SELECT rootpage FROM sqlite_master WHERE name = 'messages'", [], |row| {
            row.get(0)
        })
        .unwrap();
    let mut bytes = std::fs::read(&path).unwrap();
    let page = (usize::try_from(root).unwrap() - 1) * 512;
    // An inner page of a table: its cells begin with the number of the page below.
    assert_eq!(bytes[page], 5);
    let cell = |bytes: &[u8], i: usize| {
        page + usize::from(u16::from_be_bytes([bytes[page + 12 + 2 * i], bytes[page + 13 + 2 * i]]))
    };
    let (first, second) = (cell(&bytes, 0), cell(&bytes, 1));
    bytes.copy_within(first..first + 4, second);
    std::fs::write(&path, &bytes).unwrap();
    let bag = open(&path).unwrap();
    let (told, problems) = scan(&bag);
    assert!(!told.is_empty() && told.len() < whole);
    assert!(problems[0].contains("the number of the next message is not higher"), "{problems:?}");
}

#[test]
fn a_bag_is_read_without_a_trace() {
    let folder = tempfile::tempdir().unwrap();
    // A name that a URI would take apart.
    let path = folder.path().join("a #1?mode=rwc&b%20c.db3");
    let writer = Connection::open(&path).unwrap();
    writer.pragma_update(None, "journal_mode", "wal").unwrap();
    writer
        .execute_batch(&format!("{TOPICS}{MESSAGES}INSERT INTO messages VALUES (1, 1, 10, x'01');"))
        .unwrap();
    // While the recorder has the file, the message is only in the log beside it.
    assert_eq!(scan_whole(&open(&path).unwrap()).len(), 1);
    drop(writer);
    let files = || std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(files(), 1);
    assert_eq!(scan_whole(&open(&path).unwrap()).len(), 1);
    assert_eq!(files(), 1);
}

#[test]
fn every_cut_is_told() {
    let bytes = std::fs::read(fixture("sqlite/sqlite.db3")).unwrap();
    let (_folder, path) = file("cut.db3", &bytes);
    let handle = std::fs::File::options().write(true).open(&path).unwrap();
    for length in (0..bytes.len()).rev().step_by(37) {
        handle.set_len(length as u64).unwrap();
        let Ok(bag) = open(&path) else { continue };
        scan(&bag);
        assert_says(strict(&bag), &["cut.db3: database: "]);
    }
    // Half of the last page is missing, where SQLite itself sees nothing wrong.
    handle.set_len(0).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() - 1]).unwrap();
    let cut = "the file is cut short: it has 10239 of 10240 bytes. Copy it again";
    assert_says(strict(&open(&path).unwrap()), &[cut, "`partial`"]);
}

proptest! {
    #[test]
    fn no_bytes_make_it_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
    ) {
        let mut bytes = std::fs::read(fixture("sqlite/sqlite.db3")).unwrap();
        for (at, value) in changes {
            *at.get_mut(&mut bytes) = value;
        }
        let (_folder, path) = file("changed.db3", &bytes);
        if let Ok(bag) = open(&path) {
            let (told, problems) = scan(&bag);
            for told in told {
                // Where the tree of pages is damaged, a row may not be found again.
                let read = bag.read(told.locator);
                prop_assert!(!problems.is_empty() || read.is_err() || read.unwrap() == told.data);
            }
        }
    }
}
