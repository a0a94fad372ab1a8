//! Files into the folder.

use super::names::JOINTS;
use crate::frame::{Frame, Range};
use crate::write::error::WriteError;
use crate::write::npy::npy;
use crate::write::png;
use eyebolt_geometry::DepthImage;
use eyebolt_robot::JointPositions;
use std::io;
use std::path::Path;

/// The folder, and what goes into several of its files or comes from several frames.
pub(super) struct Output<'a> {
    folder: &'a Path,
    in_millimetres: bool,
    /// Names of the joints and the table so far.
    joints: Option<(Vec<String>, csv::Writer<Vec<u8>>)>,
}

impl<'a> Output<'a> {
    /// Into `folder`, with depth in whole millimetres or in metres.
    pub(super) fn new(folder: &'a Path, in_millimetres: bool) -> Self {
        Self { folder, in_millimetres, joints: None }
    }

    fn failed(&self, name: &str, cause: io::Error) -> WriteError {
        WriteError::File { path: self.folder.join(name), cause }
    }

    pub(super) fn file(&self, name: &str, bytes: &[u8]) -> Result<(), WriteError> {
        std::fs::write(self.folder.join(name), bytes).map_err(|cause| self.failed(name, cause))
    }

    pub(super) fn picture(
        &self,
        name: &str,
        png: Result<Vec<u8>, ::png::EncodingError>,
    ) -> Result<(), WriteError> {
        let bytes = png.map_err(|error| self.failed(name, io::Error::other(error)))?;
        self.file(name, &bytes)
    }

    pub(super) fn depth(
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

    pub(super) fn range(&self, frame: &Frame) -> Result<(), WriteError> {
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

    /// Writes the positions of the joints `names`, which are the same for all frames.
    pub(super) fn joint_row(&mut self, frame: &Frame, names: &[String]) -> Result<(), WriteError> {
        if self.joints.is_none() {
            let names = names.to_vec();
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

    pub(super) fn finish_joints(&mut self) -> Result<(), WriteError> {
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
