//! `eyebolt study`.

use crate::desk::text;
use crate::program::{CACHE, Ended, eyebolt};
use serde_json::Value;

fn study(more: &[&str]) -> Ended {
    let mut arguments = vec!["study", "--cache", text(&CACHE)];
    arguments.extend(more);
    eyebolt(&arguments)
}

/// Lines without the times, which are those of the machine.
fn lines(ended: &Ended) -> Vec<Value> {
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    fn without_times(value: &mut Value) {
        let Some(object) = value.as_object_mut() else { return };
        object.retain(|name, _| !name.ends_with("_s"));
        object.values_mut().for_each(without_times);
    }
    let lines = ended.out.lines().map(|line| {
        let mut value: Value = serde_json::from_str(line).unwrap();
        assert!(value.is_object());
        without_times(&mut value);
        value
    });
    lines.collect()
}

#[test]
fn one_line_for_each_session_and_one_for_all() {
    let two = ["--sessions", "2", "--seed", "4", "--json"];
    let told = lines(&study(&[&two[..], &["--threads", "1"]].concat()));
    assert_eq!(told.len(), 3);
    for (number, line) in told[..2].iter().enumerate() {
        assert_eq!(line["session"], number);
        assert!(line["spoiled"].is_boolean() && line["trusted"].is_boolean());
        assert!(line["robot"].is_string() && line["configurations"].as_u64().unwrap() >= 3);
        assert_eq!(line["trusted"].as_bool().unwrap(), line["reasons"] == Value::Array(Vec::new()));
    }
    let summary = &told[2];
    assert_eq!((&summary["summary"], &summary["seed"]), (&true.into(), &4.into()));
    let sessions = |of: &str| summary[of]["sessions"].as_u64().unwrap();
    assert_eq!(sessions("good") + sessions("spoiled"), 2);
    assert_eq!(lines(&study(&[&two[..], &["--threads", "2"]].concat())), told);
    let last = lines(&study(&["--first", "1", "--sessions", "1", "--seed", "4", "--json"]));
    assert_eq!((&last[0], &last[1]["first"]), (&told[1], &1.into()));
}

#[test]
fn a_table_for_people() {
    let ended = study(&["--sessions", "1", "--only", "wrong-unit"]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""));
    for said in ["wrong-unit", "spoiled, all", "right", "trusted", "to calibrate a session"] {
        assert!(ended.out.contains(said), "no {said:?} in: {}", ended.out);
    }
}

#[test]
fn kinds_that_are_not_known_are_answered_with_those_that_are() {
    study(&["--only", "witchcraft"]).assert_error(2, &["witchcraft", "plain", "bump", "gloss"]);
    study(&["--sessions", "0"]).assert_error(2, &["--sessions", "0"]);
}
