//! One cloud in a file, as a recording of one frame.

use crate::bag_recording::BagOptions;
use crate::cloud::{frame_of, frame_remedy, optical_cloud, read_stored};
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::frame::{Frame, Range};
use crate::frame_source::{FrameSource, check_index};
use crate::manifest::CloudFrame;
use crate::provenance::Provenance;
use eyebolt_geometry::{Cloud, PinholeCamera};
use eyebolt_robot::JointPositions;
use std::path::Path;

/// A cloud in a PCD, PLY or NPY file: a recording of one frame, of a camera that nobody knows and
/// without joint positions. Enough to tell what is in it, and not for a calibration.
#[derive(Debug)]
pub struct CloudFile {
    cloud: Cloud,
    names: Vec<String>,
    provenance: Provenance,
}

const ENDINGS: [&str; 3] = ["pcd", "ply", "npy"];

impl CloudFile {
    /// Whether a file at `path` is taken for a cloud, by its name.
    pub fn is_named(path: &Path) -> bool {
        extension(path).is_some_and(|ending| ENDINGS.contains(&ending.as_str())) && path.is_file()
    }

    /// Reads the cloud at `path`, in metres if `options` name no other unit, and in the frame that they name; otherwise
    /// where the points lie tells it.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, is damaged, or is no cloud; points whose frame nobody can tell.
    pub fn open(path: &Path, options: &BagOptions) -> Result<Self, RecordingError> {
        let unit = options.depth_unit.unwrap_or(DepthUnit::METRES);
        let stored = read_stored(path, &extension(path).unwrap_or_default())?;
        let (points, _) = stored.xyz.as_chunks::<3>();
        let frame = match options.cloud_frame {
            Some(frame) => frame,
            None => told_by_points(path, points)?,
        };
        let cloud = optical_cloud(path, stored, unit, frame)?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let provenance = Provenance {
            name: path.display().to_string(),
            kind: "cloud",
            files: vec![path.to_path_buf()],
            ..Provenance::default()
        };
        Ok(Self { cloud, names: vec![name], provenance })
    }
}

fn extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_ascii_lowercase())
}

fn told_by_points(path: &Path, points: &[[f32; 3]]) -> Result<CloudFrame, RecordingError> {
    frame_of(None, points)
        .map_err(|problem| RecordingError::invalid(path, "cloud", problem, frame_remedy()))
}

impl FrameSource for CloudFile {
    fn camera(&self) -> Option<&PinholeCamera> {
        None
    }

    fn frame_names(&self) -> &[String] {
        &self.names
    }

    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        let joints = self.read_joints(index)?;
        let range = Range::Cloud(self.cloud.clone());
        Ok(Frame { name: self.names[index].clone(), range, mask: None, joints })
    }

    /// # Errors
    ///
    /// No such frame. Of the only one, there are none.
    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        check_index(self, index)?;
        Ok(std::iter::empty::<(String, f64)>().collect())
    }

    fn provenance(&self) -> &Provenance {
        &self.provenance
    }
}
