//! One run, several, interrupted ones and many machines: the same bytes.

use crate::made::{Calibration, KINECT, labelled, scenario};
use eyebolt::dataset::{Dataset, Shard, merge};
use eyebolt::simulate::Scenario;
use eyebolt_render::Sensor;
use std::collections::BTreeMap;
use std::path::Path;

/// All files below `folder` with their content, but for temporary ones.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let (mut files, mut left) = (BTreeMap::new(), vec![folder.to_owned()]);
    while let Some(path) = left.pop() {
        if path.is_dir() {
            left.extend(std::fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else {
            let name = path.strip_prefix(folder).unwrap().to_str().unwrap().to_owned();
            files.insert(name, std::fs::read(&path).unwrap());
        }
    }
    files
}

#[test]
fn a_second_run_labels_nothing_and_changes_nothing() {
    let (folder, _) = labelled();
    let before = content(folder.path());
    let again = KINECT.label(folder.path(), Shard::WHOLE).unwrap();
    assert_eq!(again.known, again.lines.len());
    assert_eq!(content(folder.path()), before);
}

#[test]
fn an_interrupted_run_goes_on() {
    let (folder, dataset) = labelled();
    let before = content(folder.path());
    std::fs::remove_file(folder.path().join("index.jsonl")).unwrap();
    std::fs::remove_file(folder.path().join(&dataset.frames()[1].file.file)).unwrap();
    let again = KINECT.label(folder.path(), Shard::WHOLE).unwrap();
    assert_eq!(again.known + 1, again.lines.len());
    assert_eq!(content(folder.path()), before);
}

#[test]
fn files_that_were_removed_or_cut_are_made_anew() {
    let (folder, dataset) = labelled();
    let before = content(folder.path());
    let file = |frame: usize| folder.path().join(&dataset.frames()[frame].file.file);
    std::fs::remove_file(file(0)).unwrap();
    std::fs::write(file(2), &std::fs::read(file(2)).unwrap()[..5000]).unwrap();
    let again = KINECT.label(folder.path(), Shard::WHOLE).unwrap();
    assert_eq!((again.known, again.lines.len()), (2, 4));
    assert_eq!(content(folder.path()), before);
}

#[test]
fn shards_merged_are_one_run() {
    let (whole, _) = labelled();
    let folder = tempfile::tempdir().unwrap();
    for index in [2, 0, 1] {
        KINECT.label(folder.path(), Shard::new(index, 3).unwrap()).unwrap();
    }
    let merged = merge(folder.path()).unwrap();
    assert_eq!((merged.recordings, merged.labelled, merged.left_out), (1, 4, 0));
    assert_eq!(content(folder.path()), content(whole.path()));
}

#[test]
fn threads_change_nothing() {
    let (folder, _) = labelled();
    for threads in [1, 3] {
        let other = tempfile::tempdir().unwrap();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| KINECT.label(other.path(), Shard::WHOLE)).unwrap();
        assert_eq!(content(other.path()), content(folder.path()));
    }
}

#[test]
fn incomplete_shards_are_not_merged() {
    let folder = tempfile::tempdir().unwrap();
    KINECT.label(folder.path(), Shard::new(0, 2).unwrap()).unwrap();
    let error = merge(folder.path()).unwrap_err().to_string();
    assert!(error.contains("shard 1/2 is missing"), "{error}");
    KINECT.label(folder.path(), Shard::new(1, 2).unwrap()).unwrap();
    let file = content(folder.path()).into_keys().find(|name| name.ends_with(".npz")).unwrap();
    let (path, aside) = (folder.path().join(file), folder.path().join("aside"));
    std::fs::rename(&path, &aside).unwrap();
    let error = merge(folder.path()).unwrap_err().to_string();
    assert!(error.contains("of recording made.mcap is missing"), "{error}");
    std::fs::rename(&aside, &path).unwrap();
    merge(folder.path()).unwrap();
    let error = merge(folder.path()).unwrap_err().to_string();
    assert!(error.contains("no indices of shards"), "{error}");
}

#[test]
fn recordings_of_one_robot_share_a_data_set() {
    let (folder, _) = labelled();
    let before = content(folder.path());
    let other = Calibration::of(Scenario { seed: 4, ..scenario(Sensor::KINECT_V1, 2) });
    other.label(folder.path(), Shard::WHOLE).unwrap();
    let after = content(folder.path());
    let kept = before.iter().filter(|(name, _)| *name != "index.jsonl");
    assert!(kept.clone().all(|(name, bytes)| after.get(name) == Some(bytes)));
    let dataset = Dataset::open(folder.path()).unwrap();
    assert_eq!(dataset.frames().len(), 8);
    assert_ne!(dataset.frames()[0].recording, dataset.frames()[7].recording);
}
