//! The same recording in bags gives the same answer.

use crate::measures::apart;
use crate::recording::{Variant, shared, trusted};
use eyebolt::pipeline::{Request, run};
use eyebolt::record::RecordOptions;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_recording::{BagOptions, Recording, WriteRobot, write_folder, write_mcap};
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// The answer of the recording at `path`, without masks.
fn answer(variant: &Variant, shared: &Path, path: &Path) -> Transform<Camera, Base> {
    let recording = Recording::open(path, &BagOptions::default()).unwrap();
    let opened = variant.open(shared);
    let request = Request { source: recording.source(), ..opened.request() };
    trusted(&run(&request, &()).unwrap())
}

fn variant() -> Variant {
    Variant { masks: false, ..Variant::default() }
}

#[test]
fn bags_give_the_folders_answer() {
    let Some(shared) = shared() else { return };
    let folder = trusted(&variant().open(&shared).run());
    for bag in ["ros2_mcap_zstd", "ros2_sqlite3"] {
        let path = shared.join("data/recordings/lbr_med7_bags").join(bag);
        let (mm, degrees) = apart(&answer(&variant(), &shared, &path), &folder);
        assert!(mm <= 0.1 && degrees <= 0.01, "{bag}: {mm} mm, {degrees} degrees");
    }
}

#[test]
fn what_was_converted_gives_the_same_answer() {
    let Some(shared) = shared() else { return };
    let opened = Variant::default().open(&shared);
    let whole = trusted(&opened.run());
    let folder = tempfile::tempdir().unwrap();
    let robot = WriteRobot::default();
    let mcap = folder.path().join("a.mcap");
    let output = BufWriter::new(File::create(&mcap).unwrap());
    write_mcap(&opened.recording, &robot, output, &()).unwrap();
    // A bag of the folder, and a folder of the bag: masks and all.
    let bag = Recording::open(&mcap, &BagOptions::default()).unwrap();
    assert!(bag.has_masks());
    write_folder(&bag, &robot, folder.path(), &()).unwrap();
    for path in [mcap.as_path(), folder.path()] {
        let recording = Recording::open(path, &BagOptions::default()).unwrap();
        assert_eq!(recording.frame_names(), opened.recording.frame_names());
        let options = RecordOptions::default();
        let request = Request { source: recording.source(), options, ..opened.request() };
        assert_eq!(trusted(&run(&request, &()).unwrap()), whole, "{}", path.display());
    }
}
