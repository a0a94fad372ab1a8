//! Networks in the folder of a model.

use super::end_effector_net::EndEffectorNet;
use super::error::SegmentError;
use super::segmenter::Segmenter;
use eyebolt_net::models::Model;
use std::path::Path;

impl Segmenter {
    /// Of the folder of a model that `eyebolt train` made, with all that it has for a segmentation; or of that of
    /// one network for whole frames.
    ///
    /// # Errors
    ///
    /// Files that are not there, broken, or of something else.
    pub fn open(folder: &Path) -> Result<Self, SegmentError> {
        let whole = folder.join("segmentation");
        if !whole.is_dir() {
            return Self::new(read(folder)?).map_err(|error| error.of(folder));
        }
        let segmenter = Self::new(read(&whole)?).map_err(|error| error.of(&whole))?;
        let near = folder.join("end_effector");
        if !near.is_dir() {
            return Ok(segmenter);
        }
        let net = EndEffectorNet::new(read(&near)?).map_err(|error| error.of(&near))?;
        Ok(segmenter.with_end_effector(net))
    }

    /// As [`Self::open`], of a model that tells the end-effector.
    ///
    /// # Errors
    ///
    /// As there; a model that does not.
    pub fn open_for_end_effector(folder: &Path) -> Result<Self, SegmentError> {
        let segmenter = Self::open(folder)?;
        match segmenter.tells_end_effector() {
            true => Ok(segmenter),
            false => Err(SegmentError::NoEndEffector { folder: folder.to_owned() }),
        }
    }
}

fn read(folder: &Path) -> Result<Model, SegmentError> {
    let file = |name: &str| {
        let path = folder.join(name);
        std::fs::read(&path).map_err(|source| SegmentError::Read { path, source })
    };
    let text = String::from_utf8_lossy(&file("model.toml")?).into_owned();
    let weights = file("weights.safetensors")?;
    Model::load(&text, &weights).map_err(|error| SegmentError::from(error).of(folder))
}
