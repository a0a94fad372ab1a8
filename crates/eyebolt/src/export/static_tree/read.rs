//! Static transforms from a file.

use super::tf_message;
use super::tree::{StaticEdge, StaticTree};
use crate::export::error::ExportError;
use crate::export::file::read_text;
use eyebolt_geometry::Transform;
use eyebolt_recording::{BagOptions, is_bag, static_transforms};
use eyebolt_robot::{MAX_URDF_BYTES, PackageRoots, Robot};
use std::path::Path;

/// Largest file of transforms in YAML or JSON, bytes: a hundred frames make 40 kB.
pub const MAX_TREE_BYTES: u64 = 1 << 20;

impl StaticTree {
    /// Reads the file at `path`: `/tf_static` as `ros2 topic echo` or `rostopic echo` prints it
    /// (YAML or JSON of `tf2_msgs/TFMessage`, several documents after each other), a bag with that
    /// topic, or a robot description (URDF), of which the fixed joints count. `packages` tell where
    /// the meshes of a URDF are; compressed bags are decompressed to the folder `scratch`.
    ///
    /// # Errors
    /// A file that cannot be read, is none of these, or whose transforms make no trees: see
    /// [`StaticTree::from_edges`].
    pub fn read(path: &Path, packages: &PackageRoots, scratch: &Path) -> Result<Self, ExportError> {
        let file = path.display().to_string();
        if is_bag(path) {
            return Self::from_edges(&file, bag_edges(&file, path, scratch)?);
        }
        let text = read_text(path, MAX_URDF_BYTES)?;
        if text.trim_start_matches('\u{feff}').trim_start().starts_with('<') {
            drop(text);
            return Self::from_robot(&file, &Robot::from_urdf_file(path, packages)?);
        }
        Self::from_tf_message(&file, &text)
    }

    /// The transforms in the text of one or more `tf2_msgs/TFMessage`s; `file` is for messages.
    ///
    /// # Errors
    /// Text that is longer than [`MAX_TREE_BYTES`], is no such message, or a tree that is none.
    pub fn from_tf_message(file: &str, text: &str) -> Result<Self, ExportError> {
        if text.len() as u64 > MAX_TREE_BYTES {
            let problem = format!("larger than {} MiB", MAX_TREE_BYTES >> 20);
            return Err(ExportError::invalid(file, "the file", problem, tf_message::REMEDY));
        }
        Self::from_edges(file, tf_message::edges(file, text)?)
    }

    /// The fixed joints of `robot`, which came from `source` (for messages).
    ///
    /// # Errors
    /// See [`StaticTree::from_edges`].
    pub fn from_robot(source: &str, robot: &Robot) -> Result<Self, ExportError> {
        let fixed = robot.joints.iter().filter(|joint| joint.is_fixed());
        let edges = fixed.filter_map(|joint| {
            let name = |link: usize| Some(robot.links.get(link)?.name.clone());
            let pose = joint.parent_from_child_at_zero;
            Some(StaticEdge {
                parent: name(joint.parent)?,
                child: name(joint.child)?,
                parent_from_child: Transform::from_isometry(*pose.isometry()),
            })
        });
        let mut tree = Self::from_edges(source, edges.collect())?;
        tree.moves = robot.joints.iter().any(eyebolt_robot::Joint::moves);
        Ok(tree)
    }
}

/// The transforms on `/tf_static` of a bag.
fn bag_edges(file: &str, path: &Path, scratch: &Path) -> Result<Vec<StaticEdge>, ExportError> {
    let options = BagOptions { scratch: scratch.to_path_buf(), ..BagOptions::default() };
    let transforms = static_transforms(path, &options)?;
    if transforms.is_empty() {
        let remedy = "Record /tf_static too, or store what `ros2 topic echo` prints of it";
        return Err(ExportError::invalid(file, "/tf_static", "there are no transforms", remedy));
    }
    tf_message::of_transforms(file, transforms)
}
