//! What the folder says of its files: `recording.toml` and `camera_info.yaml`.

use super::names::{CAMERA_INFO, JOINTS, TF_STATIC, URDF};
use crate::camera_info::camera_info_message;
use crate::frame::{Frame, Range};
use crate::message::{CameraInfoMessage, Header};
use crate::recording::Recording;
use crate::write::robot::WriteRobot;
use eyebolt_geometry::PinholeCamera;
use std::fmt::Write;

/// What the frames have that were written; masks and pictures count only if every frame has one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Found {
    pub(super) clouds: bool,
    pub(super) frames: usize,
    pub(super) masks: usize,
    pub(super) colors: usize,
    pub(super) backgrounds: usize,
}

impl Found {
    /// Counts a frame in.
    pub(super) fn add(&mut self, frame: &Frame, color: bool) {
        self.clouds = matches!(frame.range, Range::Cloud(_));
        self.frames += 1;
        self.masks += usize::from(frame.mask.is_some());
        self.colors += usize::from(color);
    }
}

/// The text of the `recording.toml`.
pub(super) fn manifest(recording: &Recording, robot: &WriteRobot, found: Found) -> String {
    let quoted = |text: &str| toml::Value::from(text).to_string();
    let mut text = String::new();
    let mut line = |line: String| {
        let _ = writeln!(text, "{line}");
    };
    let tells = !recording.static_transforms().is_empty();
    let info = recording.camera().is_some().then(|| format!("info = {}\n", quoted(CAMERA_INFO)));
    let tree = tells.then(|| format!("tf_static = {}\n", quoted(TF_STATIC)));
    if info.is_some() || tree.is_some() {
        line(format!("[camera]\n{}{}", info.unwrap_or_default(), tree.unwrap_or_default()));
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

/// The text of the `camera_info.yaml`.
pub(super) fn camera_info(camera: &PinholeCamera, frame_id: Option<&str>) -> String {
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
