//! The truth of a recording, and how it is written.

use eyebolt_geometry::{Base, Camera, Transform};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// Name of the metadata record in MCAP.
pub(crate) const RECORD: &str = "eyebolt.truth";
/// Its only key.
pub(super) const KEY: &str = "json";
/// Name and version of the form of the JSON text.
pub(super) const SCHEMA: &str = "eyebolt.truth/1";

/// The truth of a simulated recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Name of the robot.
    pub robot: String,
    /// Name of its base link, whose pose this is the truth of.
    pub base: String,
    /// Name of the sensor that was simulated.
    pub sensor: String,
    /// Name of the scene or the set of faults, where it has one.
    pub preset: Option<String>,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Pose of the base in the camera's optical frame, when the recording begins.
    pub camera_from_base: Transform<Camera, Base>,
    /// Later poses, of a camera that is bumped; in order of time.
    pub camera_from_base_after: Vec<CameraMoved>,
    /// What was made worse than ideal, by name, in whatever form describes it.
    pub faults: BTreeMap<String, Value>,
}

/// Where the camera is from a moment on.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraMoved {
    /// The moment, nanoseconds by the clock of the depth when it was simulated.
    pub stamp_ns: i64,
    /// Pose of the base in the camera's optical frame from then on.
    pub camera_from_base: Transform<Camera, Base>,
}

/// In the order in which people read it.
#[derive(Serialize)]
struct Written<'a> {
    schema: &'static str,
    robot: &'a str,
    base: &'a str,
    sensor: &'a str,
    preset: Option<&'a str>,
    seed: u64,
    camera_from_base: [[f64; 4]; 4],
    camera_from_base_after: Vec<WrittenMoved>,
    faults: &'a BTreeMap<String, Value>,
}

#[derive(Serialize)]
struct WrittenMoved {
    stamp_ns: i64,
    camera_from_base: [[f64; 4]; 4],
}

impl Truth {
    /// Pose of the base in the camera's optical frame at a moment, nanoseconds by the clock of the
    /// depth when it was simulated.
    pub fn camera_from_base_at(&self, stamp_ns: i64) -> Transform<Camera, Base> {
        let moved = self.camera_from_base_after.iter().rfind(|moved| moved.stamp_ns <= stamp_ns);
        moved.map_or(self.camera_from_base, |moved| moved.camera_from_base)
    }

    /// As JSON of the schema `eyebolt.truth/1`; poses as 4x4 matrices, row by row, metres.
    pub fn to_json(&self) -> String {
        let moved = self.camera_from_base_after.iter().map(|moved| WrittenMoved {
            stamp_ns: moved.stamp_ns,
            camera_from_base: rows(&moved.camera_from_base),
        });
        let written = Written {
            schema: SCHEMA,
            robot: &self.robot,
            base: &self.base,
            sensor: &self.sensor,
            preset: self.preset.as_deref(),
            seed: self.seed,
            camera_from_base: rows(&self.camera_from_base),
            camera_from_base_after: moved.collect(),
            faults: &self.faults,
        };
        let json = serde_json::to_string_pretty(&written);
        json.expect("keys are texts, and memory does not fail to be written to") + "\n"
    }
}

fn rows(transform: &Transform<Camera, Base>) -> [[f64; 4]; 4] {
    transform.matrix().transpose().into()
}

/// The metadata record with the truth that `json` spells.
pub(crate) fn record(json: &str) -> BTreeMap<String, String> {
    BTreeMap::from([(KEY.to_owned(), json.to_owned())])
}
