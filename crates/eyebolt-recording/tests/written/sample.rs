//! A small recording out of `RecordingWriter`.

use eyebolt_geometry::{Base, Camera, DepthImage, Distortion, PinholeCamera, Transform};
use eyebolt_recording::{
    BagOptions, CameraMoved, Range, Recording, RecordingInfo, RecordingWriter, StaticTransform,
    Truth, WriteError, WriteRobot, write_folder, write_mcap,
};
use eyebolt_robot::JointPositions;
use nalgebra::{UnitQuaternion, Vector3};
use serde_json::json;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{BufWriter, Cursor};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

pub const SIZE: (u32, u32) = (4, 3);
pub const PIXELS: usize = 12;
pub const MS: i64 = 1_000_000;
/// Stamp of the first frame, nanoseconds.
pub const START_NS: i64 = 1_700_000_000_000_000_000;
pub const URDF: &str = "<robot name=\"two links\"/>";

pub type Writer = RecordingWriter<BufWriter<File>>;
pub type Memory<'a> = RecordingWriter<&'a mut Cursor<Vec<u8>>>;

pub fn camera((width, height): (u32, u32)) -> PinholeCamera {
    PinholeCamera::new(width, height, 5.0, 5.5, 1.5, 1.25, Distortion::None).unwrap()
}

pub fn info(camera: &PinholeCamera, in_millimetres: bool) -> RecordingInfo<'_> {
    RecordingInfo {
        camera,
        camera_frame_id: "eye_optical",
        in_millimetres,
        static_transforms: &[],
        urdf: Some(URDF),
        base: Some("base_link"),
        end_effector: Some("hand"),
    }
}

pub fn image(depth_m: &[f32]) -> DepthImage {
    DepthImage::new(SIZE.0, SIZE.1, depth_m.to_vec()).unwrap()
}

/// An image of whole millimetres, of which no two numbers give the same.
pub fn millimetres(number: u16) -> DepthImage {
    let depth = (0..PIXELS as u16).map(|pixel| f32::from(1000 + 20 * number + pixel) * 1e-3);
    image(&depth.collect::<Vec<_>>())
}

pub fn joints(position: f64) -> JointPositions {
    [("elbow".to_owned(), position), ("shoulder".to_owned(), -0.5 * position)].into_iter().collect()
}

pub fn truth() -> Truth {
    let rotation = UnitQuaternion::from_euler_angles(0.1, -0.7, 2.0);
    let pose = |x: f64| Transform::<Camera, Base>::from_parts(Vector3::new(x, -0.2, 1.5), rotation);
    Truth {
        robot: "two links".to_owned(),
        base: "ground".to_owned(),
        sensor: "structured light".to_owned(),
        preset: Some("desk".to_owned()),
        seed: u64::MAX,
        camera_from_base: pose(0.1),
        camera_from_base_after: vec![CameraMoved {
            stamp_ns: START_NS + 250 * MS,
            camera_from_base: pose(0.125),
        }],
        faults: BTreeMap::from([("clock_offset_s".to_owned(), json!(0.02))]),
    }
}

/// What is fixed to the camera.
pub fn transforms() -> Vec<StaticTransform> {
    [("eye_link", "eye_optical", 0.1), ("eye \"body\"", "eye_link", -1.0 / 3.0)]
        .map(|(parent, child, x)| StaticTransform {
            parent: parent.to_owned(),
            child: child.to_owned(),
            translation_m: [x, 0.0, 1e-9],
            rotation_xyzw: [0.5, -0.5, 0.5, -0.5],
        })
        .to_vec()
}

/// When backgrounds are written.
#[derive(Clone, Copy)]
pub enum Backgrounds {
    None,
    Before,
    After,
}

/// Five frames with the arm at rest and joints every 10 ms around them, and two backgrounds.
pub fn write<W: std::io::Write + std::io::Seek>(
    writer: &mut RecordingWriter<W>,
    backgrounds: Backgrounds,
) -> Result<(), WriteError> {
    let write_backgrounds = |writer: &mut RecordingWriter<W>, start_ns: i64| {
        writer.background(start_ns, &millimetres(100))?;
        writer.background(start_ns + MS, &millimetres(101))
    };
    if matches!(backgrounds, Backgrounds::Before) {
        write_backgrounds(writer, START_NS - 500 * MS)?;
    }
    for step in 0..60_i64 {
        let now = START_NS + 10 * MS * (step - 5);
        writer.joints(now, &joints(0.75))?;
        if step >= 5 && step % 10 == 5 && step < 55 {
            writer.depth(now, &millimetres((step / 10) as u16))?;
        }
    }
    if matches!(backgrounds, Backgrounds::After) {
        write_backgrounds(writer, START_NS + 1000 * MS)?;
    }
    Ok(())
}

/// A folder with recordings in it.
pub struct Desk(TempDir);

impl Desk {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// A recording called `name`, of the camera of [`SIZE`].
    pub fn record(
        &self,
        name: &str,
        in_millimetres: bool,
        fill: impl FnOnce(&mut Writer) -> Result<(), WriteError>,
    ) -> PathBuf {
        let path = self.file(name);
        let camera = camera(SIZE);
        let output = BufWriter::new(File::create(&path).unwrap());
        let around = transforms();
        let info = RecordingInfo { static_transforms: &around, ..info(&camera, in_millimetres) };
        let mut writer = RecordingWriter::new(output, &info).unwrap();
        fill(&mut writer).unwrap();
        writer.finish().unwrap();
        path
    }

    /// `from` as an MCAP called `name`.
    pub fn mcap(&self, from: &Path, name: &str) -> PathBuf {
        let path = self.file(name);
        let recording = open(from);
        let robot = WriteRobot { urdf: Some(URDF.to_owned()), ..WriteRobot::default() };
        let output = BufWriter::new(File::create(&path).unwrap());
        write_mcap(&recording, &robot, output, &()).unwrap();
        path
    }

    /// `from` as a folder called `name`.
    pub fn folder(&self, from: &Path, name: &str) -> PathBuf {
        let path = self.file(name);
        fs::create_dir(&path).unwrap();
        let go_on = &();
        write_folder(&open(from), &WriteRobot::default(), &path, go_on).unwrap();
        path
    }
}

#[track_caller]
pub fn open(path: &Path) -> Recording<'static> {
    let opened = Recording::open(path, &BagOptions::default());
    opened.unwrap_or_else(|error| panic!("{error}"))
}

pub fn frames(recording: &Recording) -> Vec<DepthImage> {
    let frames = (0..recording.frame_names().len()).map(|i| recording.read_frame(i).unwrap().range);
    let depth = |range| match range {
        Range::Depth(image) => image,
        Range::Cloud(_) => panic!("it is a cloud"),
    };
    frames.map(depth).collect()
}

pub fn backgrounds(recording: &Recording) -> Vec<DepthImage> {
    (0..recording.background_count()).map(|i| recording.read_background(i).unwrap()).collect()
}

/// Checks that the error's text has all `parts`.
#[track_caller]
pub fn assert_says<T, E: std::fmt::Display>(result: Result<T, E>, parts: &[&str]) {
    let Err(error) = result else { panic!("no error, expected one with {parts:?}") };
    let text = error.to_string();
    for part in parts {
        assert!(text.contains(part), "no {part:?} in: {text}");
    }
}
