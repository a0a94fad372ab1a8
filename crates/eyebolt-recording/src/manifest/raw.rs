//! `recording.toml` as it is spelled.

use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Raw {
    #[serde(default)]
    pub(super) camera: RawCamera,
    pub(super) frames: RawFrames,
    pub(super) background: Option<RawBackground>,
    #[serde(default)]
    pub(super) robot: RawRobot,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCamera {
    pub(super) info: Option<String>,
    pub(super) tf_static: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawFrames {
    pub(super) depth: Option<String>,
    pub(super) cloud: Option<String>,
    pub(super) depth_unit: Option<RawUnit>,
    pub(super) cloud_frame: Option<String>,
    pub(super) color: Option<String>,
    pub(super) mask: Option<String>,
    pub(super) joints: Option<String>,
    pub(super) joint_names: Option<Vec<String>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawBackground {
    pub(super) depth: Option<String>,
    pub(super) depth_unit: Option<RawUnit>,
}

/// A unit of length, by name or by its metres.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum RawUnit {
    Metres(f64),
    Name(String),
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawRobot {
    pub(super) urdf: Option<String>,
    pub(super) base: Option<String>,
    pub(super) end_effector: Option<String>,
}
