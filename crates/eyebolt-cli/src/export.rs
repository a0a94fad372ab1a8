//! `eyebolt export`.

use crate::ending::Ending;
use crate::front::{Front, Terminal};
use crate::names;
use crate::output::{self, STDOUT};
use crate::robots::packages;
use anyhow::{Result, bail};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use eyebolt::export::{Format, Note, Placement, SavedCalibration, StaticTree, Wanted};
use std::path::{Path, PathBuf};

/// Which transform is exported, for people who know tf.
const FRAMES: &str = "\
Direction:
  Every format tells the pose of the child frame in the parent frame, which maps coordinates in the
  child to coordinates in the parent: base_from_camera, not camera_from_base. That is what tf means
  by a transform from frame_id (parent) to child_frame_id. Metres, radians.

Optical frame, body frame:
  The calibration is for the depth OPTICAL frame: x right, y down, z forward. The body frame that
  drivers call camera_link (x forward, y left, z up) is another: name it with --child-frame and
  give the transforms in between with --camera-tree. There is no guessing: they differ by camera.

A camera whose driver publishes camera_link -> ... -> optical frame on /tf_static:
  A frame of tf has one parent. Published as base -> optical frame, the calibration would give the
  optical frame a second one, and tf would jump between the two. So where the recording has
  /tf_static, the pose of the root of the driver's frames is exported, and all the others follow.
  Of a recording without it, store what the driver publishes and give it as --camera-tree:

    timeout -s INT 5 ros2 topic echo --full-length --qos-durability transient_local \\
        /tf_static > tf.yaml
    eyebolt export calibration.json --as ros2-launch --camera-tree tf.yaml -o camera.launch.py

  The publisher of an earlier calibration must not run meanwhile. With the robot's frames in the
  file too, --parent-frame may be any frame that does not move against the base, such as world.

Exit status: 0 exported, 1 something could not be read, exported or written, 2 wrong usage.";

/// Options of `eyebolt export`.
#[derive(Debug, clap::Args)]
#[command(after_long_help = FRAMES)]
pub struct Arguments {
    /// Calibration that `eyebolt calibrate` wrote
    #[arg(value_name = "CALIBRATION.JSON")]
    calibration: PathBuf,
    /// What to write; all tell the pose of the child (camera) in the parent (base)
    #[arg(long = "as", value_name = "FORMAT", value_parser = format())]
    format: Format,
    /// Where to write it; otherwise to standard output. The hand-eye formats take their name from it
    #[arg(short, long, value_name = "FILE", required_if_eq_any([("format", "npy"), ("format", "mcap")]))]
    output: Option<PathBuf>,
    /// Replace an existing file
    #[arg(long)]
    force: bool,
    /// Parent frame [default: the base link of the calibration]
    #[arg(long, visible_alias = "base-frame", value_name = "FRAME")]
    parent_frame: Option<String>,
    /// Child frame [default: the depth optical frame, or the root of the camera's frames where
    /// --camera-tree gives the optical frame a parent]
    #[arg(long, visible_alias = "camera-frame", value_name = "FRAME")]
    child_frame: Option<String>,
    /// Name of the depth optical frame, if the calibration has none or another
    #[arg(long, value_name = "FRAME")]
    optical_frame: Option<String>,
    /// Static transforms of the camera, the robot or both, in place of the recording's: a bag with /tf_static, that topic as
    /// `ros2 topic echo` prints it (YAML or JSON), or a URDF, of which the fixed joints count
    #[arg(long, value_name = "FILE")]
    camera_tree: Option<PathBuf>,
    /// Where package:// leads in a URDF: a folder of packages, or NAME=FOLDER; may be repeated.
    /// ROS_PACKAGE_PATH and AMENT_PREFIX_PATH are searched too
    #[arg(long, value_name = "[NAME=]FOLDER")]
    package_path: Vec<String>,
    /// Export the pose of a calibration that was refused: it is not to be trusted
    #[arg(long)]
    even_if_refused: bool,
}

fn format() -> impl TypedValueParser<Value = Format> {
    let named =
        |format: &Format| PossibleValue::new(format.name()).help(names::in_flags(format.summary()));
    PossibleValuesParser::new(Format::ALL.iter().map(named)).try_map(|name| {
        Format::ALL.into_iter().find(|format| format.name() == name).ok_or("not a format")
    })
}

/// Whoever reads a file later goes by how its name ends; one without an ending is left to the caller.
fn check_ending(path: &Path, format: Format) -> Result<()> {
    let Some(ending) = path.extension().map(|ending| ending.to_string_lossy().to_lowercase())
    else {
        return Ok(());
    };
    if format.endings().contains(&ending.as_str()) {
        return Ok(());
    }
    let usual = format.endings().first().copied().unwrap_or_default();
    let others = Format::ALL.into_iter().filter(|other| other.endings().contains(&ending.as_str()));
    let others: Vec<String> = others.map(|other| format!("--as {}", other.name())).collect();
    let instead = match others.is_empty() {
        true => String::new(),
        false => format!(", or give {} for .{ending}", others.join(" or ")),
    };
    bail!(
        "{}: --output: files of --as {} end in .{usual}. Give .{usual} for it{instead}",
        path.display(),
        format.name()
    );
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    let to_file = arguments.output.as_deref().filter(|path| *path != Path::new(STDOUT));
    if let Some(path) = to_file {
        output::refuse_existing(path, arguments.force)?;
        check_ending(path, arguments.format)?;
    }
    let calibration = SavedCalibration::read(&arguments.calibration)?;
    let stem = to_file.and_then(|path| path.file_stem());
    let name = stem.map_or("eyebolt".into(), |stem| stem.to_string_lossy());
    let (bytes, placement) = written(arguments, &calibration, &name)?;
    match to_file {
        None => output::deliver(&bytes)?,
        Some(path) => {
            output::write_whole(path, &bytes, arguments.force)?;
            let Placement { parent, child, .. } = &placement;
            output::say(&format!("pose of {child} in {parent}, written to {}", path.display()));
        }
    }
    notes(arguments, &placement, &Terminal);
    Ok(Ending::Done)
}

/// What is to know of `placement`.
fn notes(arguments: &Arguments, placement: &Placement, front: &dyn Front) {
    // A second parent is a matter of who publishes it.
    let published = arguments.format.is_published();
    let of_use = |note: &&Note| published || !matches!(note, Note::TreeUnknown { .. });
    for note in placement.notes.iter().filter(of_use) {
        front.note(&names::in_flags(&note.to_string()));
    }
}

/// The bytes that `arguments` ask for of `calibration`; formats with a name of their own are called `name`.
pub(crate) fn bytes(
    arguments: &Arguments,
    calibration: &SavedCalibration,
    name: &str,
    front: &dyn Front,
) -> Result<Vec<u8>> {
    let (bytes, placement) = written(arguments, calibration, name)?;
    notes(arguments, &placement, front);
    Ok(bytes)
}

fn written(
    arguments: &Arguments,
    calibration: &SavedCalibration,
    name: &str,
) -> Result<(Vec<u8>, Placement)> {
    let wanted = Wanted {
        parent: arguments.parent_frame.as_deref(),
        child: arguments.child_frame.as_deref(),
        optical: arguments.optical_frame.as_deref(),
        even_if_refused: arguments.even_if_refused,
    };
    let placement = match &arguments.camera_tree {
        Some(path) => {
            let packages = packages(&arguments.package_path);
            let tree = StaticTree::read(path, &packages, &std::env::temp_dir())?;
            Placement::find(calibration, &tree, &wanted)?
        }
        None => Placement::of_recording(calibration, &wanted)?,
    };
    Ok((arguments.format.write(&placement, name), placement))
}
