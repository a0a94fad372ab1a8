//! A `recording.toml` from what lies in a folder.
//!
//! Files that differ in one number are the frames of one thing; what they are, their names and their
//! first bytes tell. What cannot be known is written down as a guess, for a person to check.

mod kind;
mod series;

use crate::camera_info::CameraInfo;
use crate::error::RecordingError;
use crate::folder::MANIFEST;
use kind::{Kind, UnitGuess};
use series::{Series, series_in};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// What a folder has, as a `recording.toml`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Described {
    /// Text of the file.
    pub toml: String,
    /// What was guessed or is missing, sentences for a person.
    pub to_check: Vec<String>,
}

/// What is in a folder, by what it is to a recording.
#[derive(Debug, Default)]
struct Found {
    depth: Option<(Series, UnitGuess)>,
    cloud: Option<(Series, UnitGuess)>,
    background: Option<Series>,
    color: Option<Series>,
    mask: Option<Series>,
    joints: Option<Series>,
    table: Option<String>,
    info: Option<(String, Option<f64>)>,
    tf_static: Option<String>,
    urdf: Option<String>,
}

/// Describes the files in `folder`. `joint_names` are those of the robot, in its order, where it is
/// known: NPY files of joints carry none.
///
/// # Errors
///
/// A folder that cannot be listed, or that has a `recording.toml` already, or neither depth nor
/// clouds.
pub fn describe_folder(
    folder: &Path,
    joint_names: &dyn Fn(&Path) -> Vec<String>,
) -> Result<Described, RecordingError> {
    let manifest = folder.join(MANIFEST);
    if manifest.exists() {
        let problem = "it is there already";
        let remedy = "Remove it first, or correct it by hand";
        return Err(RecordingError::invalid(&manifest, "the file", problem, remedy));
    }
    let found = look(folder)?;
    if found.depth.is_none() && found.cloud.is_none() {
        let problem =
            "no series of depth images (16-bit PNG, NPY) or clouds (PCD, PLY, NPY) is in it";
        let remedy = "Name the files of the frames alike but for a number, as in depth_0.png, \
                      depth_1.png";
        return Err(RecordingError::invalid(folder, "the folder", problem, remedy));
    }
    let names = match (&found.urdf, &found.joints) {
        (Some(urdf), Some(joints)) if joints.extension() == "npy" => {
            joint_names(&folder.join(urdf))
        }
        _ => Vec::new(),
    };
    Ok(text(folder, &found, &names))
}

fn look(folder: &Path) -> Result<Found, RecordingError> {
    let (series, single) = series_in(folder)?;
    let mut found = Found::default();
    for series in series {
        let kind = Kind::of(&series.first_path(folder), series.name());
        let slot = match kind {
            Some(Kind::Background) => &mut found.background,
            Some(Kind::Mask) => &mut found.mask,
            Some(Kind::Color) => &mut found.color,
            Some(Kind::Joints) => &mut found.joints,
            Some(Kind::Depth(unit)) => {
                keep_longest(&mut found.depth, (series, unit), |(series, _)| series.count());
                continue;
            }
            Some(Kind::Cloud(unit)) => {
                keep_longest(&mut found.cloud, (series, unit), |(series, _)| series.count());
                continue;
            }
            None => continue,
        };
        keep_longest(slot, series, Series::count);
    }
    for name in single {
        let path = folder.join(&name);
        match path.extension().and_then(|e| e.to_str()).unwrap_or_default() {
            "urdf" => found.urdf = found.urdf.or(Some(name)),
            "csv" if name.contains("joint") => found.table = found.table.or(Some(name)),
            "json" if name.contains("joint") => found.table = found.table.or(Some(name)),
            "yaml" | "yml" | "json" if name.contains("tf_static") => {
                found.tf_static = found.tf_static.or(Some(name));
            }
            "yaml" | "yml" | "json" if found.info.is_none() => {
                found.info = CameraInfo::read(&path).ok().map(|info| (name, info.depth_unit_m));
            }
            _ => {}
        }
    }
    Ok(found)
}

/// Of two that could be meant, that with more frames.
fn keep_longest<T>(slot: &mut Option<T>, other: T, count: impl Fn(&T) -> usize) {
    if slot.as_ref().is_none_or(|known| count(known) < count(&other)) {
        *slot = Some(other);
    }
}

fn text(folder: &Path, found: &Found, names: &[String]) -> Described {
    let mut toml = String::new();
    let mut to_check = Vec::new();
    let quoted = |text: &str| toml::Value::from(text).to_string();
    let mut line = |line: String| {
        let _ = writeln!(toml, "{line}");
    };
    line("[camera]".to_owned());
    match &found.info {
        Some((name, _)) => line(format!("info = {}", quoted(name))),
        None => {
            line("# info = \"camera_info.yaml\"".to_owned());
            if found.depth.is_some() {
                to_check.push(
                    "no intrinsics were found: name a camera_info.yaml in camera.info".into(),
                );
            }
        }
    }
    if let Some(name) = &found.tf_static {
        line(format!("tf_static = {}", quoted(name)));
    }
    line("\n[frames]".to_owned());
    let told = found.info.as_ref().and_then(|(_, unit)| *unit);
    let (key, series, unit) = match (&found.depth, &found.cloud) {
        (Some((series, unit)), _) => ("depth", series, unit),
        (None, Some((series, unit))) => ("cloud", series, unit),
        (None, None) => return Described { toml, to_check },
    };
    line(format!("{key} = {}", quoted(&series.pattern())));
    let (value, why) = unit.text(told);
    line(format!("depth_unit = {value}"));
    to_check.extend(why);
    if key == "cloud" {
        line("cloud_frame = \"optical\"".to_owned());
        to_check.push(
            "frames.cloud_frame is a guess: \"optical\" is x right, y down, z forward, \
                       \"body\" x forward, y left, z up"
                .into(),
        );
    }
    for (key, series) in [("color", &found.color), ("mask", &found.mask)] {
        if let Some(series) = series {
            line(format!("{key} = {}", quoted(&series.pattern())));
        }
    }
    match (&found.joints, &found.table) {
        (Some(joints), _) if joints.extension() == "npy" => {
            line(format!("joints = {}", quoted(&joints.pattern())));
            let count = kind::npy_length(&joints.first_path(folder)).unwrap_or(0);
            let fits = !names.is_empty() && names.len() == count;
            let listed: Vec<_> = names.iter().map(|name| quoted(name)).collect();
            if fits {
                line(format!("joint_names = [{}]", listed.join(", ")));
                to_check.push(
                    "frames.joint_names is in the order of the robot description: check \
                               that the numbers are in that order"
                        .into(),
                );
            } else {
                line("# joint_names = [\"joint_1\", \"joint_2\"]".to_owned());
                to_check.push(format!(
                    "list the {count} joints in frames.joint_names, in the order \
                                       of the numbers: NPY carries no names"
                ));
            }
        }
        (Some(joints), None) => line(format!("joints = {}", quoted(&joints.pattern()))),
        (_, Some(table)) => line(format!("joints = {}", quoted(table))),
        (None, None) => {
            line("# joints = \"joints.csv\"".to_owned());
            to_check.push("no joint positions were found: name their file in frames.joints".into());
        }
    }
    if let Some(background) = &found.background {
        line(format!("\n[background]\ndepth = {}", quoted(&background.pattern())));
    }
    line("\n[robot]".to_owned());
    match &found.urdf {
        Some(urdf) => line(format!("urdf = {}", quoted(urdf))),
        None => {
            line("# urdf = \"arm.urdf\"".to_owned());
            to_check.push(
                "no robot description was found: name one in robot.urdf, or give it each \
                           time"
                    .into(),
            );
        }
    }
    Described { toml, to_check }
}

/// Where [`Described::toml`] belongs.
pub fn description_of(folder: &Path) -> PathBuf {
    folder.join(MANIFEST)
}
