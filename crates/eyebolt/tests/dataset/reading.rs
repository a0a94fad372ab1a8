//! Everything that a reader may meet is an error that says what to do, never a panic.

use crate::made::{KINECT, labelled};
use crate::stage::ARM;
use eyebolt::dataset::{
    Calibrated, Dataset, DatasetFrame, Description, RecordingEntry, Shard, Store, code,
};
use eyebolt::end_effector::EndEffector;
use eyebolt::robots::BuiltIn;
use std::path::Path;

/// Replaces `from` by `to` in a text file.
fn replace(path: &Path, from: &str, to: &str) {
    let text = std::fs::read_to_string(path).unwrap();
    assert!(text.contains(from), "no {from:?} in {text}");
    std::fs::write(path, text.replacen(from, to, 1)).unwrap();
}

#[track_caller]
fn assert_says(error: impl ToString, words: &[&str]) {
    let text = error.to_string();
    for word in words {
        assert!(text.contains(word), "no {word:?} in: {text}");
    }
}

#[test]
fn folders_that_are_no_data_set() {
    let folder = tempfile::tempdir().unwrap();
    assert_says(Dataset::open(folder.path()).unwrap_err(), &["dataset.toml", "cannot read"]);
    KINECT.label(folder.path(), Shard::new(0, 2).unwrap()).unwrap();
    assert_says(Dataset::open(folder.path()).unwrap_err(), &["index.jsonl", "merge the shards"]);
    let (folder, _) = labelled();
    std::fs::remove_file(folder.path().join("index.jsonl")).unwrap();
    assert_says(Dataset::open(folder.path()).unwrap_err(), &["no run has come to its end"]);
}

#[test]
fn other_versions_and_classes() {
    let (folder, _) = labelled();
    let path = folder.path().join("dataset.toml");
    replace(&path, "eyebolt.dataset/1", "eyebolt.dataset/7");
    assert_says(
        Dataset::open(folder.path()).unwrap_err(),
        &["dataset.toml: schema", "/7", "again"],
    );
    replace(&path, "eyebolt.dataset/7", "eyebolt.dataset/1");
    replace(&path, "end_effector = 2", "end_effector = 3");
    assert_says(Dataset::open(folder.path()).unwrap_err(), &["dataset.toml: classes", "again"]);
    std::fs::write(&path, "schema = ").unwrap();
    assert_says(Dataset::open(folder.path()).unwrap_err(), &["dataset.toml: text"]);
}

#[test]
fn another_robot() {
    let (folder, dataset) = labelled();
    let other = BuiltIn::named("davit").unwrap().arm();
    assert_says(dataset.check_robot(&other).unwrap_err(), &["robot.urdf_hash", "davit"]);
    dataset.check_robot(&ARM).unwrap();
    let hand = EndEffector::of(&other).unwrap();
    let store = Store::open(folder.path(), Description::new(&other, &hand), Shard::WHOLE);
    assert_says(store.unwrap_err(), &["another robot", "another folder"]);
}

#[test]
fn another_calibration_of_the_same_recording() {
    let (folder, _) = labelled();
    let hand = EndEffector::of(&ARM).unwrap();
    let store = Store::open(folder.path(), Description::new(&ARM, &hand), Shard::WHOLE).unwrap();
    let given = RecordingEntry { calibrated: Calibrated::Given, ..KINECT.entry() };
    let error = store.begin(&given, "{}").unwrap_err();
    assert_says(error, &["calibration.json", "another one already", "another folder"]);
    // Of machines that find slightly different ones at the same time, the first counts.
    assert_eq!(store.begin(&KINECT.entry(), "{}").unwrap(), KINECT.json);
    let masked = RecordingEntry { masks: true, ..KINECT.entry() };
    assert_says(store.begin(&masked, &KINECT.json).unwrap_err(), &["masks", "other options"]);
}

#[test]
fn an_index_that_is_damaged_or_leads_elsewhere() {
    for (from, to, word) in [
        ("{\"recording\"", "{\"recordin\"", "line 1"),
        ("\"file\":\"frames/", "\"file\":\"../frames/", "does not lie in the data set"),
        ("\"file\":\"frames/", "\"file\":\"/frames/", "does not lie in the data set"),
        ("\"number\":1", "\"number\":0", "line 2"),
    ] {
        let (folder, _) = labelled();
        replace(&folder.path().join("index.jsonl"), from, to);
        assert_says(Dataset::open(folder.path()).unwrap_err(), &["index.jsonl", word]);
    }
}

/// Reads the first frame of a data set after `spoil` has had its file.
fn spoilt(spoil: impl FnOnce(&Path)) -> Result<DatasetFrame, String> {
    let (folder, dataset) = labelled();
    spoil(&folder.path().join(&dataset.frames()[0].file.file));
    // Whoever stores other arrays does not know the hash.
    let path = folder.path().join("index.jsonl");
    let mut lines: Vec<serde_json::Value> = std::fs::read_to_string(&path)
        .unwrap()
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let file = folder.path().join(lines[0]["file"].as_str().unwrap());
    if let Ok(metadata) = std::fs::metadata(file) {
        lines[0]["bytes"] = metadata.len().into();
    }
    lines[0].as_object_mut().unwrap().remove("blake3");
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    std::fs::write(&path, text).unwrap();
    let dataset = Dataset::open(folder.path()).unwrap();
    dataset.read(&dataset.frames()[0]).map_err(|error| error.to_string())
}

#[test]
fn files_that_are_missing_cut_or_changed() {
    let (folder, dataset) = labelled();
    let entry = &dataset.frames()[0];
    let path = folder.path().join(&entry.file.file);
    let whole = std::fs::read(&path).unwrap();
    std::fs::write(&path, &whole[..whole.len() / 2]).unwrap();
    assert_says(dataset.read(entry).unwrap_err(), &["length", "were written", "label"]);
    let mut changed = whole.clone();
    changed[whole.len() / 2] ^= 1;
    std::fs::write(&path, changed).unwrap();
    assert_says(dataset.read(entry).unwrap_err(), &["blake3", "not what was written"]);
    std::fs::remove_file(&path).unwrap();
    assert_says(dataset.read(entry).unwrap_err(), &["cannot read"]);
    let cut = |path: &Path| std::fs::write(path, &std::fs::read(path).unwrap()[..1000]).unwrap();
    assert_says(spoilt(cut).unwrap_err(), &[".npz: archive", "no end of a ZIP", "again"]);
}

/// Overwrites the bytes of the array `name` from its number `at` on, and corrects the checksum.
fn overwrite(path: &Path, name: &str, at: usize, bytes: &[u8]) {
    let mut file = std::fs::read(path).unwrap();
    let name = format!("{name}.npy");
    let find = |from: usize| {
        let found = file[from..].windows(name.len()).position(|w| w == name.as_bytes());
        found.map(|at| from + at).unwrap()
    };
    let local = find(0);
    let data = local + name.len();
    let central = find(data);
    let length = u32::from_le_bytes(file[local - 12..local - 8].try_into().unwrap()) as usize;
    let header = 10 + usize::from(u16::from_le_bytes([file[data + 8], file[data + 9]]));
    file[data + header + at..][..bytes.len()].copy_from_slice(bytes);
    let crc = crc32fast::hash(&file[data..data + length]).to_le_bytes();
    file[local - 16..local - 12].copy_from_slice(&crc);
    file[central - 30..central - 26].copy_from_slice(&crc);
    std::fs::write(path, file).unwrap();
}

#[test]
fn numbers_that_cannot_be() {
    let nan = f32::NAN.to_le_bytes();
    let far = 7.0_f64.to_le_bytes();
    let cases: [(&str, usize, &[u8], &[&str]); 6] = [
        ("depth_m", 400, &nan, &["depth_m: NaN"]),
        ("label", 17, &[9], &["label: 9 is the number of no class"]),
        ("keypoint", 17, &[200], &["keypoint: 200", "there are 8"]),
        ("camera_from_end_effector", 8, &far, &["camera_from_end_effector", "rigid"]),
        ("joint_positions", 0, &f64::INFINITY.to_le_bytes(), &["joint_positions: inf"]),
        ("camera_matrix", 0, &(-1.0_f64).to_le_bytes(), &["camera_matrix", "fx = -1"]),
    ];
    for (array, at, bytes, words) in cases {
        let error = spoilt(|path| overwrite(path, array, at, bytes)).unwrap_err();
        assert_says(&error, words);
        assert_says(&error, &["Remove the file and label the recording again"]);
    }
    let all = spoilt(|_| {}).unwrap().joints;
    // Not a number is a joint that nobody recorded.
    let nan = f64::NAN.to_le_bytes();
    let fewer = spoilt(|path| overwrite(path, "joint_positions", 0, &nan)).unwrap().joints;
    assert_eq!(fewer.len() + 1, all.len());
}

/// Made by `fuzz/make_seeds.py` with `numpy.savez`, which numbers in its local headers another way.
#[test]
fn a_frame_that_numpy_saved() {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds/dataset");
    let folder = tempfile::tempdir().unwrap();
    for name in ["dataset.toml", "frame.npz"] {
        std::fs::copy(seeds.join(name), folder.path().join(name)).unwrap();
    }
    let bytes = std::fs::metadata(seeds.join("frame.npz")).unwrap().len();
    let pixels = r#"{"background":0,"arm":0,"end_effector":0,"ignore":0,"no_depth":0}"#;
    let line = format!(
        r#"{{"recording":"a","number":0,"frame":"0","file":"frame.npz","bytes":{bytes},"pixels":{pixels},"keypoints_seen":[]}}"#
    );
    std::fs::write(folder.path().join("index.jsonl"), line).unwrap();
    let dataset = Dataset::open(folder.path()).unwrap();
    let frame = dataset.read(&dataset.frames()[0]).unwrap();
    assert_eq!((frame.depth.width(), frame.depth.height()), (8, 6));
    assert_eq!((frame.depth.at(0, 0), frame.depth.at(7, 5)), (0.5, 1.5));
    let codes: Vec<u8> = frame.labels.iter().map(|label| code(*label)).collect();
    assert_eq!(codes[..4], [0, 1, 2, 0]);
    assert_eq!(frame.keypoints[..6], [0, 1, 2, 3, 4, 0]);
    assert_eq!(frame.camera.fx(), 9.0);
    assert_eq!(frame.joints.get("turn"), Some(0.5));
}
