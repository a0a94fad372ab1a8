//! A folder of files with a `recording.toml`.

use super::npy::npy;
use super::{WriteError, WriteProgress, WriteRobot, png, tell};
use crate::camera_info::camera_info_message;
use crate::folder::MANIFEST;
use crate::frame::{Frame, Range};
use crate::message::{CameraInfoMessage, Header};
use crate::recording::Recording;
use crate::truth;
use eyebolt_geometry::{DepthImage, PinholeCamera};
use eyebolt_robot::JointPositions;
use std::fmt::Write;
use std::io;
use std::path::Path;

const CAMERA_INFO: &str = "camera_info.yaml";
const JOINTS: &str = "joints.csv";
const URDF: &str = "robot.urdf";

/// Writes the frames of `recording` that take part to the folder `folder`, which must exist:
/// depth as PNG (whole millimetres) or NPY, clouds as NPY, the positions of the joints as one CSV,
/// the backgrounds, and the truth of a simulated recording as it is.
///
/// # Errors
///
/// What cannot be read, or a file that cannot be written.
pub fn write_folder(
    recording: &Recording,
    robot: &WriteRobot,
    folder: &Path,
    progress: &mut WriteProgress<'_>,
) -> Result<(), WriteError> {
    let names = recording.frame_names();
    let backgrounds = recording.background_count();
    let total = backgrounds + names.len();
    let mut output = Output { folder, in_millimetres: recording.in_millimetres(), joints: None };
    let mut found = Found::default();
    for (index, name) in names.iter().enumerate() {
        tell(progress, index, total)?;
        let frame = match recording.read_frame(index) {
            Err(error) if recording.may_leave_out(&error) => continue,
            read => read?,
        };
        output.range(&frame)?;
        output.joint_row(&frame)?;
        if let Some(mask) = &frame.mask {
            let png = png::mask(mask.width(), mask.height(), mask.as_slice());
            output.picture(&format!("mask_{name}.png"), png)?;
        }
        let color = recording.read_color(index)?;
        if let Some(color) = &color {
            let png = png::rgb(color.width, color.height, &color.rgb);
            output.picture(&format!("color_{name}.png"), png)?;
        }
        found.add(&frame, color.is_some());
    }
    for index in 0..backgrounds {
        tell(progress, names.len() + index, total)?;
        let background = match recording.read_background(index) {
            Err(error) if recording.may_leave_out(&error) => continue,
            read => read?,
        };
        let name = format!("background_{index}");
        output.depth(&name, &background, recording.backgrounds_in_millimetres())?;
        found.backgrounds += 1;
    }
    output.finish_joints()?;
    if let Some(camera) = recording.camera() {
        let text = camera_info(camera, recording.camera_frame_id());
        output.file(CAMERA_INFO, text.as_bytes())?;
    }
    if let Some(urdf) = &robot.urdf {
        output.file(URDF, urdf.as_bytes())?;
    }
    if let Some(json) = truth::text_of(recording)? {
        output.file(truth::FILE, json.as_bytes())?;
    }
    // Last: a folder without it is no recording.
    output.file(MANIFEST, manifest(recording, robot, found).as_bytes())?;
    tell(progress, total, total)
}

/// What frames have; masks and pictures count only if every frame has one.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    clouds: bool,
    frames: usize,
    masks: usize,
    colors: usize,
    backgrounds: usize,
}

impl Found {
    fn add(&mut self, frame: &Frame, color: bool) {
        self.clouds = matches!(frame.range, Range::Cloud(_));
        self.frames += 1;
        self.masks += usize::from(frame.mask.is_some());
        self.colors += usize::from(color);
    }
}

struct Output<'a> {
    folder: &'a Path,
    in_millimetres: bool,
    /// Names of the joints and the table so far.
    joints: Option<(Vec<String>, csv::Writer<Vec<u8>>)>,
}

impl Output<'_> {
    fn failed(&self, name: &str, cause: io::Error) -> WriteError {
        WriteError::File { path: self.folder.join(name), cause }
    }

    fn file(&self, name: &str, bytes: &[u8]) -> Result<(), WriteError> {
        std::fs::write(self.folder.join(name), bytes).map_err(|cause| self.failed(name, cause))
    }

    fn picture(
        &self,
        name: &str,
        png: Result<Vec<u8>, ::png::EncodingError>,
    ) -> Result<(), WriteError> {
        let bytes = png.map_err(|error| self.failed(name, io::Error::other(error)))?;
        self.file(name, &bytes)
    }

    fn depth(
        &self,
        name: &str,
        depth: &DepthImage,
        in_millimetres: bool,
    ) -> Result<(), WriteError> {
        if in_millimetres {
            let png = png::depth(depth.width(), depth.height(), depth.depth_m());
            return self.picture(&format!("{name}.png"), png);
        }
        let shape = [depth.height() as usize, depth.width() as usize];
        self.file(&format!("{name}.npy"), &npy(&shape, depth.depth_m().iter().copied()))
    }

    fn range(&self, frame: &Frame) -> Result<(), WriteError> {
        let name = &frame.name;
        match &frame.range {
            Range::Depth(depth) => self.depth(&format!("depth_{name}"), depth, self.in_millimetres),
            Range::Cloud(cloud) => {
                let grid = cloud.grid().map(|(w, h)| vec![h as usize, w as usize, 3]);
                let shape = grid.unwrap_or_else(|| vec![cloud.points().len(), 3]);
                let values = cloud.points().iter().flat_map(|p| [p.x, p.y, p.z]);
                self.file(&format!("cloud_{name}.npy"), &npy(&shape, values))
            }
        }
    }

    fn joint_row(&mut self, frame: &Frame) -> Result<(), WriteError> {
        if self.joints.is_none() {
            let names: Vec<String> = frame.joints.iter().map(|(name, _)| name.to_owned()).collect();
            let mut table = csv::Writer::from_writer(Vec::new());
            let header = std::iter::once("frame").chain(names.iter().map(String::as_str));
            table.write_record(header).map_err(|error| self.failed(JOINTS, error.into()))?;
            self.joints = Some((names, table));
        }
        let Some((names, table)) = &mut self.joints else { return Ok(()) };
        let row = row(names, &frame.joints).and_then(|positions| {
            table
                .write_record(std::iter::once(frame.name.clone()).chain(positions))
                .map_err(io::Error::from)
        });
        row.map_err(|error| self.failed(JOINTS, error))
    }

    fn finish_joints(&mut self) -> Result<(), WriteError> {
        let Some((_, table)) = self.joints.take() else { return Ok(()) };
        let bytes = table.into_inner();
        let bytes =
            bytes.map_err(|error| self.failed(JOINTS, io::Error::other(error.to_string())))?;
        self.file(JOINTS, &bytes)
    }
}

/// Positions in the order of `names`, which are those of the first frame.
fn row(names: &[String], joints: &JointPositions) -> io::Result<Vec<String>> {
    let position = |name: &String| {
        let missing = || io::Error::other(format!("a frame has no position of {name}"));
        // The shortest text that is read as the same number.
        joints.get(name).map(|position| format!("{position:?}")).ok_or_else(missing)
    };
    names.iter().map(position).collect()
}

fn camera_info(camera: &PinholeCamera, frame_id: Option<&str>) -> String {
    let header = Header { stamp_ns: 0, frame_id: frame_id.unwrap_or_default() };
    let CameraInfoMessage { height, width, distortion_model, d, k, .. } =
        camera_info_message(camera, header);
    let mut text = String::new();
    if let Some(frame_id) = frame_id {
        // JSON texts are YAML texts.
        let quoted = serde_json::Value::from(frame_id).to_string();
        let _ = writeln!(text, "header:\n  frame_id: {quoted}");
    }
    let _ = writeln!(text, "height: {height}\nwidth: {width}");
    let _ = writeln!(text, "distortion_model: {distortion_model}\nd: {d:?}\nk: {k:?}");
    text
}

fn manifest(recording: &Recording, robot: &WriteRobot, found: Found) -> String {
    let quoted = |text: &str| toml::Value::from(text).to_string();
    let mut text = String::new();
    let mut line = |line: String| {
        let _ = writeln!(text, "{line}");
    };
    if recording.camera().is_some() {
        line(format!("[camera]\ninfo = {}\n", quoted(CAMERA_INFO)));
    }
    line("[frames]".to_owned());
    match (found.clouds, recording.in_millimetres()) {
        (true, _) => line("cloud = \"cloud_{}.npy\"\ncloud_frame = \"optical\"".to_owned()),
        (false, true) => line("depth = \"depth_{}.png\"".to_owned()),
        (false, false) => line("depth = \"depth_{}.npy\"".to_owned()),
    }
    let unit = if recording.in_millimetres() && !found.clouds { "mm" } else { "m" };
    line(format!("depth_unit = {}", quoted(unit)));
    line(format!("joints = {}", quoted(JOINTS)));
    if found.masks == found.frames {
        line("mask = \"mask_{}.png\"".to_owned());
    }
    if found.colors == found.frames {
        line("color = \"color_{}.png\"".to_owned());
    }
    if found.backgrounds > 0 {
        let (ending, unit) =
            if recording.backgrounds_in_millimetres() { ("png", "mm") } else { ("npy", "m") };
        line(format!("\n[background]\ndepth = \"background_{{}}.{ending}\""));
        line(format!("depth_unit = {}", quoted(unit)));
    }
    let known = recording.robot();
    let base = robot.base.as_ref().or(known.base.as_ref());
    let hand = robot.end_effector.as_ref().or(known.end_effector.as_ref());
    line("\n[robot]".to_owned());
    if robot.urdf.is_some() {
        line(format!("urdf = {}", quoted(URDF)));
    }
    for (key, link) in [("base", base), ("end_effector", hand)] {
        if let Some(link) = link {
            line(format!("{key} = {}", quoted(link)));
        }
    }
    text
}
