//! What is at a path that is no recording, and what to give instead.

use crate::error::RecordingError;
use eyebolt_robot::Input;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Bytes of a file that tell what it is.
const ENOUGH: u64 = 4096;
/// Bags of a folder that are listed.
const MOST_LISTED: usize = 10;

/// What is wrong with `path` as a recording; `None` if that is for its reader to tell.
pub(crate) fn problem(path: &Path, is_bag: impl Fn(&Path) -> bool) -> Option<RecordingError> {
    if !path.exists() {
        return Some(RecordingError::Read {
            path: path.to_path_buf(),
            field: "the recording".to_owned(),
            remedy: "Check its name; relative paths begin in the working folder".to_owned(),
            cause: io::Error::new(io::ErrorKind::NotFound, "no such file or folder"),
        });
    }
    let (problem, remedy) = if path.is_dir() { of_folder(path, is_bag)? } else { of_file(path)? };
    Some(RecordingError::invalid(path, "the recording", problem, remedy))
}

/// Of a folder that is neither a bag nor described.
fn of_folder(folder: &Path, is_bag: impl Fn(&Path) -> bool) -> Option<(String, String)> {
    let entries = std::fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path());
    let mut paths: Vec<PathBuf> = entries.collect();
    paths.sort();
    let is_recording = |path: &&PathBuf| {
        path.is_dir() && (path.join(crate::folder::MANIFEST).exists() || is_bag(path))
    };
    let below: Vec<_> = paths.iter().filter(is_recording).collect();
    let names = |paths: &[&PathBuf]| {
        let names: Vec<_> =
            paths.iter().take(MOST_LISTED).map(|path| path.display().to_string()).collect();
        names.join(", ")
    };
    match below.as_slice() {
        [] => {}
        [one] => {
            let problem = "the recording is in a folder below".to_owned();
            return Some((problem, format!("Give {}", one.display())));
        }
        several => {
            let problem = format!("{} recordings are in it: {}", several.len(), names(several));
            return Some((problem, "Give one of them".to_owned()));
        }
    }
    if paths.is_empty() {
        let remedy = "Give a bag, or a folder with a recording.toml".to_owned();
        return Some(("the folder is empty".to_owned(), remedy));
    }
    let problem = "neither a bag nor a recording.toml is in it".to_owned();
    let remedy = "Give a bag; or say in a recording.toml which files are what: `eyebolt init` writes \
                  one from what lies there";
    Some((problem, remedy.to_owned()))
}

/// Of a file that is not a bag by its first bytes.
fn of_file(path: &Path) -> Option<(String, String)> {
    let mut head = Vec::new();
    File::open(path).ok()?.take(ENOUGH).read_to_end(&mut head).ok()?;
    let text = String::from_utf8_lossy(&head);
    let folder = path.parent().filter(|parent| *parent != Path::new("")).unwrap_or(Path::new("."));
    let found = |what: &str, remedy: String| Some((format!("this is {what}"), remedy));
    let described = || {
        "Give the folder with the recording.toml that names it; `eyebolt init` writes one"
            .to_owned()
    };
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    if name == crate::folder::MANIFEST {
        return None;
    }
    if head.is_empty() {
        return found("an empty file", "Record again, or give another file".to_owned());
    }
    if text.contains("rosbag2_bagfile_information") {
        return found("the metadata of a bag", format!("Give its folder, {}", folder.display()));
    }
    if text.contains("eyebolt.calibration") {
        let remedy = "Give the recording that it was made from".to_owned();
        return found("a calibration and no recording", remedy);
    }
    if text.trim_start().starts_with('<') && text.contains("<robot") {
        let remedy = format!("Give it with {}, and a recording beside it", Input::ROBOT);
        return found("a robot description and no recording", remedy);
    }
    if text.contains("distortion_model") || text.contains("camera_matrix") {
        let remedy = format!("Give it with {}, and a bag beside it", Input::CAMERA_INFO);
        return found("the intrinsics of a camera and no recording", remedy);
    }
    let image = head.starts_with(b"\x89PNG") || head.starts_with(b"\x93NUMPY");
    if image || head.starts_with(&[0xff, 0xd8, 0xff]) {
        return found("one image or array and no recording", described());
    }
    if ending == "pcd" || ending == "ply" {
        return found("one cloud and no recording", described());
    }
    None
}
