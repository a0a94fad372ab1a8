//! Truth from JSON text, field by field, so that an error names the field.

use super::written::{CameraMoved, SCHEMA, Truth};
use crate::error::RecordingError;
use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::Matrix4;
use serde_json::{Map, Value};
use std::path::Path;

/// The matrices are written with all their digits.
const RIGID_TO: f64 = 1e-9;
const REMEDY: &str = "Take the truth that `eyebolt simulate` wrote with the recording";

/// Where a text came from, for messages.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) path: &'a Path,
    /// What stands before the names of fields.
    pub(super) place: &'a str,
}

impl Source<'_> {
    pub(super) fn invalid(&self, field: &str, problem: impl Into<String>) -> RecordingError {
        RecordingError::invalid(self.path, format!("{}{field}", self.place), problem, REMEDY)
    }

    /// The truth that `json` spells.
    pub(super) fn parse(&self, json: &str) -> Result<Truth, RecordingError> {
        let root: Map<String, Value> = serde_json::from_str(json).map_err(|error| {
            let place = format!("line {}, column {}", error.line(), error.column());
            self.invalid(&place, format!("{error}; JSON has numbers, no NaN and no infinity"))
        })?;
        match self.text(&root, "schema")?.as_str() {
            SCHEMA => {}
            other => return Err(self.invalid("schema", format!("{other:?} is not {SCHEMA:?}"))),
        }
        let seed = self.field(&root, "seed")?;
        let wrong = || self.invalid("seed", format!("{seed} is no whole number from 0 to 2^64"));
        let faults = match root.get("faults") {
            None => Map::new(),
            Some(Value::Object(faults)) => faults.clone(),
            Some(_) => return Err(self.invalid("faults", "it is no object")),
        };
        Ok(Truth {
            robot: self.text(&root, "robot")?,
            base: self.text(&root, "base")?,
            sensor: self.text(&root, "sensor")?,
            preset: match root.get("preset") {
                None | Some(Value::Null) => None,
                Some(_) => Some(self.text(&root, "preset")?),
            },
            seed: seed.as_u64().ok_or_else(wrong)?,
            camera_from_base: self.pose(&root, "", "camera_from_base")?,
            camera_from_base_after: self.moved(&root)?,
            faults: faults.into_iter().collect(),
        })
    }

    fn moved(&self, root: &Map<String, Value>) -> Result<Vec<CameraMoved>, RecordingError> {
        let name = "camera_from_base_after";
        let list = match root.get(name) {
            None => return Ok(Vec::new()),
            Some(Value::Array(list)) => list,
            Some(_) => return Err(self.invalid(name, "it is no list")),
        };
        let mut moved: Vec<CameraMoved> = Vec::new();
        for (index, value) in list.iter().enumerate() {
            let place = format!("{name}[{index}]");
            let Value::Object(value) = value else {
                return Err(self.invalid(&place, "it is no object"));
            };
            let camera_from_base = self.pose(value, &format!("{place}."), "camera_from_base")?;
            let stamp_ns = value.get("stamp_ns").and_then(Value::as_i64).ok_or_else(|| {
                self.invalid(&format!("{place}.stamp_ns"), "it is no whole number of nanoseconds")
            })?;
            if moved.last().is_some_and(|last| last.stamp_ns >= stamp_ns) {
                let problem = "it is not later than the one before";
                return Err(self.invalid(&format!("{place}.stamp_ns"), problem));
            }
            moved.push(CameraMoved { stamp_ns, camera_from_base });
        }
        Ok(moved)
    }

    fn pose(
        &self,
        object: &Map<String, Value>,
        place: &str,
        name: &str,
    ) -> Result<Transform<Camera, Base>, RecordingError> {
        let field = format!("{place}{name}");
        let value = object.get(name).ok_or_else(|| self.invalid(&field, "the field is missing"))?;
        let numbers = self.numbers(&field, value)?;
        let matrix = Matrix4::from_row_slice(&numbers);
        Transform::from_matrix(&matrix, RIGID_TO).ok_or_else(|| {
            let problem = "the matrix is no rigid transform: its upper left block must be a \
                           rotation and its last row 0 0 0 1";
            self.invalid(&field, problem)
        })
    }

    /// The numbers of a 4x4 matrix, row by row.
    fn numbers(&self, field: &str, value: &Value) -> Result<[f64; 16], RecordingError> {
        let four = |field: &str, value: &Value| -> Result<[Value; 4], RecordingError> {
            let list = value.as_array().map(Vec::as_slice).unwrap_or_default();
            let of_four = <[Value; 4]>::try_from(list.to_vec());
            of_four.map_err(|_| self.invalid(field, "it is no list of 4, as of a 4x4 matrix"))
        };
        let mut numbers = [0.0; 16];
        let mut slots = numbers.iter_mut();
        for (r, row) in four(field, value)?.iter().enumerate() {
            let row_field = format!("{field}[{r}]");
            for (c, value) in four(&row_field, row)?.iter().enumerate() {
                let number = value.as_f64().filter(|number| number.is_finite());
                let wrong = || self.invalid(&format!("{row_field}[{c}]"), "it is no finite number");
                let number = number.ok_or_else(wrong)?;
                slots.by_ref().take(1).for_each(|slot| *slot = number);
            }
        }
        Ok(numbers)
    }

    fn field<'v>(
        &self,
        object: &'v Map<String, Value>,
        name: &str,
    ) -> Result<&'v Value, RecordingError> {
        object.get(name).ok_or_else(|| self.invalid(name, "the field is missing"))
    }

    fn text(&self, object: &Map<String, Value>, name: &str) -> Result<String, RecordingError> {
        let text = self.field(object, name)?.as_str();
        text.map(str::to_owned).ok_or_else(|| self.invalid(name, "it is no text"))
    }
}
