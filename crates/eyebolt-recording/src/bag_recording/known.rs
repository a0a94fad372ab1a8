//! What eyebolt told of a recording in a bag that it wrote.

use super::choose::Chosen;
use super::scan::{Content, Scan};
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::manifest::{CloudFrame, RobotSection};
use crate::own_metadata::{BACKGROUND_TOPIC, check_names};
use std::collections::BTreeMap;
use std::path::Path;

/// The metadata record, empty for bags of others.
#[derive(Clone, Debug, Default)]
pub(super) struct Known(BTreeMap<String, String>);

const CLOUD_FRAME: &str = "cloud_frame";
const DEPTH_UNIT: &str = "depth_unit";

impl Known {
    pub(super) fn new(metadata: Option<&BTreeMap<String, String>>) -> Self {
        Self(metadata.cloned().unwrap_or_default())
    }

    fn get(&self, key: &str) -> Option<&str> {
        self.0.get(key).map(String::as_str)
    }

    /// The topic of the backgrounds.
    pub(super) fn background(&self) -> Option<&str> {
        self.get(BACKGROUND_TOPIC)
    }

    /// The frame of clouds that a caller once said.
    pub(super) fn cloud_frame(&self) -> Option<CloudFrame> {
        CloudFrame::named(self.get(CLOUD_FRAME)?)
    }

    /// The unit of depth that a caller once said.
    pub(super) fn depth_unit(&self) -> Option<DepthUnit> {
        DepthUnit::parse(self.get(DEPTH_UNIT)?)
    }

    /// Names of all frames, where the bag was written from something that had names for them.
    pub(super) fn frame_names(&self, path: &Path) -> Result<Option<Vec<String>>, RecordingError> {
        let Some(text) = self.get("frame_names") else { return Ok(None) };
        let names: Vec<String> = serde_json::from_str(text).map_err(|error| {
            let (field, remedy) = ("metadata: frame_names", "Write the file again");
            RecordingError::invalid(path, field, error.to_string(), remedy)
        })?;
        check_names(path, &names)?;
        Ok(Some(names))
    }

    /// The robot: its description by `scan`, and the links.
    pub(super) fn robot(&self, scan: &Scan, chosen: &Chosen) -> RobotSection {
        let text = chosen.description.and_then(|number| match &scan.topic(number).content {
            Content::Text(text) => Some(text.clone()),
            _ => None,
        });
        let link = |key: &str| self.get(key).map(str::to_owned);
        RobotSection {
            urdf: None,
            description: text,
            base: link("base"),
            end_effector: link("end_effector"),
        }
    }

    /// The record of a copy of the bag, whose backgrounds are on the topic `background`.
    pub(super) fn of_copy(
        mut self,
        background: Option<&str>,
        cloud_frame: Option<CloudFrame>,
        depth_unit: Option<DepthUnit>,
    ) -> BTreeMap<String, String> {
        // Its messages may have got lost, or a caller may have named it.
        self.0.remove(BACKGROUND_TOPIC);
        let frame = cloud_frame.map(CloudFrame::name);
        let unit = depth_unit.map(|unit| unit.to_string());
        let told =
            [(BACKGROUND_TOPIC, background), (CLOUD_FRAME, frame), (DEPTH_UNIT, unit.as_deref())];
        let told = told.into_iter().filter_map(|(key, value)| Some((key, value?)));
        self.0.extend(told.map(|(key, value)| (key.to_owned(), value.to_owned())));
        self.0
    }
}
