//! `eyebolt reproduce`, from nothing and with networks that hardly learned.

use crate::desk::{Desk, text};
use crate::program::eyebolt;
use std::fs;

/// All steps, then once more after some of what they left is gone: only that is made again.
#[test]
fn from_nothing_to_the_tables_and_on_from_where_it_ended() {
    let desk = Desk::new();
    let folder = desk.file("reproduction");
    let run = || {
        let fixed = ["reproduce", "--quick", "--steps", "1", "-o", text(&folder)];
        let ended = eyebolt(&fixed);
        assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.err);
        ended.out
    };
    let first = run();
    for step in
        ["record train pose p1", "label training pose p3", "teach", "with a marker", "evaluate"]
    {
        assert!(first.contains(step), "no {step:?} in: {first}");
    }
    assert!(!first.contains("there already"), "{first}");
    let page = fs::read(folder.join("report.html")).unwrap();
    assert!(String::from_utf8_lossy(&page).contains("KPM + ICP"));
    let csv = fs::read_to_string(folder.join("tables.csv")).unwrap();
    assert!(csv.contains("\"tag\",\"recordings\",3,,"), "{csv}");

    fs::remove_file(folder.join("report.html")).unwrap();
    fs::remove_file(folder.join("recordings/test-p2.mcap")).unwrap();
    let second = run();
    assert_eq!(second.matches("there already").count(), 12, "{second}");
    assert!(fs::read(folder.join("report.html")).unwrap() == page);
}
