mod all_else;
mod support;

use super::*;
use crate::InMemory;
use eyebolt_geometry::Distortion;
use support::robot;

fn read(recorded: &[(&str, f64)], joints: &[&str], notes: JointNotes) -> Vec<(String, f64)> {
    let camera = PinholeCamera::new(4, 3, 4.0, 4.0, 1.5, 1.0, Distortion::None).unwrap();
    let mut source = InMemory::new(camera);
    let positions = recorded.iter().map(|(name, at)| ((*name).to_owned(), *at)).collect();
    source.push("0", DepthImage::new(4, 3, vec![1.0; 12]).unwrap(), positions).unwrap();
    let noted = NotedJoints::new(Recording::Other(Box::new(source)), notes, &robot(joints));
    let read = noted.read_joints(0).unwrap();
    assert_eq!(noted.read_frame(0).unwrap().joints, read);
    read.iter().map(|(name, at)| (name.to_owned(), at)).collect()
}

fn pairs(pairs: &[(&str, f64)]) -> Vec<(String, f64)> {
    pairs.iter().map(|(name, at)| ((*name).to_owned(), *at)).collect()
}

#[test]
fn a_prefix_is_taken_off_or_put_on() {
    let notes = || JointNotes { prefix: Some("left_".to_owned()), ..JointNotes::default() };
    let recorded = [("left_a", 1.0), ("left_b", 2.0), ("right_a", 3.0)];
    let found = read(&recorded, &["a", "b"], notes());
    assert_eq!(found, pairs(&[("a", 1.0), ("b", 2.0), ("right_a", 3.0)]));
    let found = read(&[("a", 1.0), ("c", 2.0)], &["left_a", "left_b"], notes());
    assert_eq!(found, pairs(&[("c", 2.0), ("left_a", 1.0)]));
    // Whoever has the name already keeps it.
    let found = read(&[("a", 1.0), ("left_a", 2.0)], &["a", "b"], notes());
    assert_eq!(found, pairs(&[("a", 1.0)]));
}

#[test]
fn what_is_recorded_counts_more_than_what_is_stated() {
    let positions = vec![("a".to_owned(), 9.0), ("f".to_owned(), 0.04)];
    let notes = JointNotes { positions, prefix: None };
    assert_eq!(read(&[("a", 1.0)], &["a", "f"], notes), pairs(&[("a", 1.0), ("f", 0.04)]));
}
