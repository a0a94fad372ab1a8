//! Which files a bag is.

use super::kind::magic;
use crate::error::RecordingError;
use crate::file::read_text;
use serde::Deserialize;
use std::fs::File;
use std::path::{Component, Path, PathBuf};

/// Name of the file that ROS 2 puts beside the files of a bag.
pub(super) const METADATA: &str = "metadata.yaml";

/// Whether there is a bag at `path`, by its first bytes; of a folder, whether a file in it is called
/// like one.
pub fn is_bag(path: &Path) -> bool {
    if !path.is_dir() {
        let known = File::open(path).and_then(magic);
        return known.is_ok_and(|known| known.is_some());
    }
    path.join(METADATA).is_file() || !files_in(path).is_empty()
}

/// The files of the bag that `path` is, or that lies in the folder `path`.
pub(super) fn of_bag(path: &Path) -> Result<Vec<PathBuf>, RecordingError> {
    if !path.is_dir() {
        Ok(vec![path.to_path_buf()])
    } else if path.join(METADATA).is_file() {
        listed_files(path)
    } else {
        one_file(path)
    }
}

/// The files of a folder that are bags by their names, sorted by these.
fn files_in(folder: &Path) -> Vec<PathBuf> {
    let named = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let name = name.strip_suffix(".zstd").or(name.strip_suffix(".zst")).unwrap_or(name);
        [".mcap", ".db3", ".bag"].iter().any(|ending| name.ends_with(ending))
    };
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<_> = entries.map(|entry| entry.path()).filter(named).collect();
    files.sort_by(|a, b| crate::pattern::natural_order(&a.to_string_lossy(), &b.to_string_lossy()));
    files
}

#[derive(Debug, Deserialize)]
struct Metadata {
    rosbag2_bagfile_information: Information,
}

#[derive(Debug, Deserialize)]
struct Information {
    relative_file_paths: Vec<String>,
}

/// The files that the `metadata.yaml` of `folder` lists.
fn listed_files(folder: &Path) -> Result<Vec<PathBuf>, RecordingError> {
    let path = folder.join(METADATA);
    let remedy = "Rebuild it with `ros2 bag reindex`, or give the bag's file itself";
    let invalid =
        |field: &str, problem: String| RecordingError::invalid(&path, field, problem, remedy);
    let text = read_text(&path, "the bag's description")?;
    let metadata: Metadata = serde_saphyr::from_str(&text)
        .map_err(|error| invalid("YAML", error.without_snippet().to_string()))?;
    let file = |name: &String| {
        let relative = Path::new(name);
        let inside = relative.components().all(|part| matches!(part, Component::Normal(_)));
        // Old versions wrote the folder's name before the file's.
        let short = folder.join(relative.file_name().unwrap_or_default());
        let file = if short.is_file() { short } else { folder.join(relative) };
        match inside && file.is_file() {
            true => Ok(file),
            false => {
                let problem = format!("\"{name}\" is not a file in the folder");
                Err(invalid("relative_file_paths", problem))
            }
        }
    };
    metadata.rosbag2_bagfile_information.relative_file_paths.iter().map(file).collect()
}

/// The only bag in a folder without a description.
fn one_file(folder: &Path) -> Result<Vec<PathBuf>, RecordingError> {
    let files = files_in(folder);
    if files.len() <= 1 {
        return Ok(files);
    }
    let names: Vec<_> = files.iter().map(|file| file.display().to_string()).collect();
    let problem = format!("the folder has no {METADATA} and several bags: {}", names.join(", "));
    let remedy = "Give one of them, or rebuild the description with `ros2 bag reindex`";
    Err(RecordingError::invalid(folder, "bag", problem, remedy))
}
