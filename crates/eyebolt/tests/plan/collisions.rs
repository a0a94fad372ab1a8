//! Whether the arm has room, against an independent library: `fixtures/make.py`.

use crate::stage::movable;
use eyebolt::plan::Blocked;
use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Deserialize)]
struct Case {
    positions: BTreeMap<String, f64>,
    itself_m: f64,
    table_m: f64,
}

/// What is said to be free is nowhere nearer than this, metres: of the 12 mm that are wanted, points a centimetre apart see
/// nearly all.
const NEARER_M: f64 = 0.008;
/// What is farther from everything is free.
const FAR_M: f64 = 0.016;

fn check(robot: &str, cases: &str, least_far: usize) {
    let arm = movable(robot);
    let cases: Vec<Case> = serde_json::from_str(cases).unwrap();
    let mut far = 0;
    for case in &cases {
        let joints = case.positions.clone().into_iter().collect();
        let positions = arm.positions_of(&joints).unwrap();
        let Case { itself_m, table_m, .. } = *case;
        match arm.blocked(&positions, true) {
            None => assert!(itself_m > NEARER_M && table_m > NEARER_M, "{itself_m} {table_m}"),
            Some(Blocked::Table) => assert!(table_m < FAR_M, "table: {table_m}"),
            Some(Blocked::Itself) => assert!(itself_m < FAR_M, "itself: {itself_m}"),
            Some(other) => panic!("{other:?} without a camera"),
        }
        if table_m < NEARER_M && itself_m > FAR_M {
            assert_eq!(arm.blocked(&positions, false), None, "there is no table");
        }
        far += usize::from(itself_m.min(table_m) > FAR_M);
    }
    assert!(cases.len() == 150 && far >= least_far, "{far}");
}

#[test]
fn as_another_library_has_it() {
    check("shackle", include_str!("fixtures/shackle.json"), 30);
    check("davit", include_str!("fixtures/davit.json"), 30);
}
