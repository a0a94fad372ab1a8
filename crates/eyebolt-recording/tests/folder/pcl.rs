//! Clouds of the Point Cloud Library, where they are at hand, as a Python script read them.

use eyebolt_recording::{Folder, FrameSource, Range};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::PathBuf;

#[derive(Deserialize)]
struct Expected {
    count: usize,
    sum: [f64; 3],
    min: [f32; 3],
    max: [f32; 3],
    points: Vec<Picked>,
}

#[derive(Deserialize)]
struct Picked {
    index: usize,
    xyz: [f32; 3],
}

#[test]
fn clouds_of_pcl() {
    let Some(shared) = std::env::var_os("EYEBOLT_SHARED") else {
        // The harness would keep back what `eprintln!` says of a test that passes.
        let text = "SKIPPED clouds_of_pcl: set EYEBOLT_SHARED to the shared data";
        return writeln!(std::io::stderr(), "{text}").unwrap();
    };
    let data = PathBuf::from(shared).join("data/clouds/pcl");
    let expected: BTreeMap<String, Expected> =
        serde_json::from_str(include_str!("../fixtures/pcl.json")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let text = format!(
        "[frames]\ncloud = '{}/{{}}.pcd'\ncloud_frame = \"optical\"\ndepth_unit = \"m\"\n\
         joints = \"joints.csv\"\n",
        data.display()
    );
    std::fs::write(folder.path().join("recording.toml"), text).unwrap();
    let joints = "frame,a\nmilk,1\nbun0,2\nbun4,3\n";
    std::fs::write(folder.path().join("joints.csv"), joints).unwrap();

    let recording = Folder::open(folder.path()).unwrap();
    assert!(recording.frame_names().iter().eq(expected.keys()));
    for (i, expected) in expected.values().enumerate() {
        let frame = recording.read_frame(i).unwrap();
        let Range::Cloud(cloud) = &frame.range else { panic!("no cloud") };
        assert_eq!((cloud.points().len(), cloud.count_valid()), (expected.count, expected.count));
        assert_eq!(cloud.grid(), None);
        for Picked { index, xyz } in &expected.points {
            assert_eq!(<[f32; 3]>::from(cloud.points()[*index].coords), *xyz);
        }
        let bounds = cloud.bounding_box().unwrap();
        assert_eq!(
            (bounds.min.coords.into(), bounds.max.coords.into()),
            (expected.min, expected.max)
        );
        let mean = cloud.centroid().unwrap();
        for (mean, sum) in mean.iter().zip(expected.sum) {
            assert!((mean - sum / expected.count as f64).abs() < 1e-9);
        }
    }
}
