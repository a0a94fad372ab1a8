//! Flags that say what the recording and the robot are, shared by the commands.

use anyhow::{Context, Result, bail};
use eyebolt_recording::{BagOptions, CloudFrame, DepthUnit, Recording, WriteRobot};
use eyebolt_registration::LinkCache;
use eyebolt_robot::{Arm, PackageRoots, Robot};
use std::path::{Path, PathBuf};

/// Which recording, and how to read it.
#[derive(Debug, clap::Args)]
pub struct RecordingArguments {
    /// Folder with a recording.toml, or a bag: MCAP, rosbag2 (file or folder) or ROS 1
    pub recording: PathBuf,
    #[command(flatten)]
    pub bag: BagArguments,
}

const BAGS: &str = "Bags";

/// How to read a bag.
#[derive(Debug, clap::Args)]
pub struct BagArguments {
    /// Depth images (16UC1, 32FC1, compressedDepth) or clouds, where several topics have them
    #[arg(long, help_heading = BAGS, value_name = "TOPIC")]
    depth_topic: Option<String>,
    /// Intrinsics of the depth, where they are not beside it
    #[arg(long, help_heading = BAGS, value_name = "TOPIC")]
    camera_info_topic: Option<String>,
    /// Intrinsics of the depth from a camera_info.yaml instead of a topic
    #[arg(long, help_heading = BAGS, value_name = "FILE", conflicts_with = "camera_info_topic")]
    camera_info: Option<PathBuf>,
    /// Joint states, where several topics have them
    #[arg(long, help_heading = BAGS, value_name = "TOPIC")]
    joint_topic: Option<String>,
    /// Robot description, where several topics have one
    #[arg(long, help_heading = BAGS, value_name = "TOPIC")]
    description_topic: Option<String>,
    /// Colour pictures registered to the depth, for the overlays
    #[arg(long, help_heading = BAGS, value_name = "TOPIC")]
    color_topic: Option<String>,
    /// Masks of the arm
    #[arg(long, help_heading = BAGS, value_name = "TOPIC")]
    mask_topic: Option<String>,
    /// Depth images of the scene without the robot
    #[arg(long, help_heading = BAGS, value_name = "TOPIC")]
    background_topic: Option<String>,
    /// What one of the numbers of depth is: m, mm, or its metres, as in 0.0001 or 1/5000 [default: mm
    /// of integers and m of floats, of a folder what its recording.toml says]
    #[arg(long, value_name = "UNIT", value_parser = depth_unit)]
    depth_unit: Option<DepthUnit>,
    /// Frame of the points of a PointCloud2, where name and points do not tell
    #[arg(long, help_heading = BAGS, value_name = "FRAME")]
    cloud_frame: Option<CloudFrameName>,
    /// How far a joint may turn while a frame is taken, degrees [default: what the frames at rest tell]
    #[arg(long, help_heading = BAGS, value_name = "DEG", value_parser = positive)]
    max_motion_deg: Option<f64>,
    /// Use what can be read of a damaged bag
    #[arg(long, help_heading = BAGS)]
    partial: bool,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum CloudFrameName {
    /// x right, y down, z forward
    Optical,
    /// x forward, y left, z up
    Body,
}

pub fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("must be a number above 0".to_owned()),
    }
}

fn depth_unit(text: &str) -> Result<DepthUnit, String> {
    let ways = "must be m, mm, or the metres of one, as in 0.0001 or 1/5000";
    DepthUnit::parse(text).ok_or_else(|| ways.to_owned())
}

impl BagArguments {
    pub fn options(&self) -> BagOptions {
        BagOptions {
            depth_topic: self.depth_topic.clone(),
            camera_info_topic: self.camera_info_topic.clone(),
            camera_info: self.camera_info.clone(),
            joint_topic: self.joint_topic.clone(),
            description_topic: self.description_topic.clone(),
            color_topic: self.color_topic.clone(),
            mask_topic: self.mask_topic.clone(),
            background_topic: self.background_topic.clone(),
            cloud_frame: self.cloud_frame.map(|frame| match frame {
                CloudFrameName::Optical => CloudFrame::Optical,
                CloudFrameName::Body => CloudFrame::Body,
            }),
            depth_unit: self.depth_unit,
            any_depth: false,
            max_motion: self.max_motion_deg.map(f64::to_radians),
            partial: self.partial,
            scratch: std::env::temp_dir(),
        }
    }
}

impl RecordingArguments {
    pub fn open(&self) -> Result<Recording> {
        Ok(Recording::open(&self.recording, &self.bag.options())?)
    }

    /// As [`Self::open`], with one of several topics of depth where none is named.
    pub fn open_any_depth(&self) -> Result<Recording> {
        let options = BagOptions { any_depth: true, ..self.bag.options() };
        Ok(Recording::open(&self.recording, &options)?)
    }
}

/// Which robot.
#[derive(Debug, clap::Args)]
pub struct RobotArguments {
    /// Robot description (URDF); otherwise the recording's
    #[arg(long, value_name = "URDF")]
    robot: Option<PathBuf>,
    /// Base link; otherwise the recording's, or guessed
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// End-effector link; otherwise the recording's, or guessed
    #[arg(long, value_name = "LINK")]
    end_effector: Option<String>,
    /// Where package:// leads: a folder of packages, or NAME=FOLDER; may be repeated.
    /// ROS_PACKAGE_PATH and AMENT_PREFIX_PATH are searched too
    #[arg(long, value_name = "[NAME=]FOLDER")]
    package_path: Vec<String>,
    /// Let a robot description that comes from a bag name files outside the package folders
    #[arg(long)]
    allow_outside_files: bool,
}

impl RobotArguments {
    /// The arm that the flags name, else the one of the recording at `path`.
    pub fn arm(&self, path: &Path, recording: &Recording) -> Result<Arm> {
        let Some(robot) = self.robot(recording)? else {
            if !recording.provenance().topics.is_empty() {
                bail!(
                    "{}: the bag has no robot description. Record /robot_description too, or give \
                     --robot arm.urdf",
                    path.display()
                );
            }
            let file = if path.is_dir() { path.join("recording.toml") } else { path.to_owned() };
            bail!(
                "{}: robot.urdf: no robot description is named. Add [robot] urdf = \"...\" or give \
                 --robot arm.urdf",
                file.display()
            );
        };
        self.arm_of(robot, recording)
    }

    /// As [`Self::arm`]; `None` if neither flags nor recording say what the robot is.
    pub fn arm_if_known(&self, recording: &Recording) -> Result<Option<Arm>> {
        self.robot(recording)?.map(|robot| self.arm_of(robot, recording)).transpose()
    }

    fn arm_of(&self, robot: Robot, recording: &Recording) -> Result<Arm> {
        let section = recording.robot();
        // The recording's links are those of the robot it names, not of another given instead.
        let other = self.robot.is_some();
        let known = |link: &&String| !other || robot.link_index(link).is_some();
        let base = self.base.as_ref().or(section.base.as_ref().filter(known));
        let hand = self.end_effector.as_ref().or(section.end_effector.as_ref().filter(known));
        Ok(robot.arm(base.map(String::as_str), hand.map(String::as_str))?)
    }

    /// What the flags and the recording say of the robot, for those who read the recording later.
    pub fn to_write(&self, recording: &Recording) -> Result<WriteRobot> {
        let section = recording.robot();
        let urdf = match self.robot.as_ref().or(section.urdf.as_ref()) {
            Some(path) => {
                // Whoever reads it later will; better told now.
                Robot::from_urdf_file(path, &self.packages())?;
                let failed = || format!("{}: cannot read the URDF", path.display());
                Some(std::fs::read_to_string(path).with_context(failed)?)
            }
            None => section.description.clone(),
        };
        let (base, end_effector) = (self.base.clone(), self.end_effector.clone());
        Ok(WriteRobot { urdf, base, end_effector })
    }

    fn robot(&self, recording: &Recording) -> Result<Option<Robot>> {
        let section = recording.robot();
        let packages = self.packages();
        if let Some(urdf) = self.robot.as_ref().or(section.urdf.as_ref()) {
            return Ok(Some(Robot::from_urdf_file(urdf, &packages)?));
        }
        let Some(text) = &section.description else { return Ok(None) };
        Ok(Some(Robot::from_urdf_str(text, None, &packages)?))
    }

    fn packages(&self) -> PackageRoots {
        packages(&self.package_path).with_outside_files(self.allow_outside_files)
    }
}

/// The packages that flags name, then those that the environment does.
pub fn packages(flags: &[String]) -> PackageRoots {
    let variable = |name| std::env::var(name).ok();
    let (ros, ament) = (variable("ROS_PACKAGE_PATH"), variable("AMENT_PREFIX_PATH"));
    let environment = PackageRoots::from_environment(ros.as_deref(), ament.as_deref());
    let named = flags.iter().fold(PackageRoots::new(), |roots, flag| roots.with_argument(flag));
    named.then(environment)
}

/// Where shapes of links are kept between runs.
#[derive(Debug, clap::Args)]
pub struct CacheArguments {
    /// Where the shapes of links are kept between runs [default: eyebolt in the user's cache folder]
    #[arg(long, value_name = "FOLDER", conflicts_with = "no_cache")]
    cache: Option<PathBuf>,
    /// Keep nothing between runs
    #[arg(long)]
    no_cache: bool,
}

impl CacheArguments {
    pub fn open(&self) -> LinkCache {
        if self.no_cache {
            return LinkCache::disabled();
        }
        let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty());
        let user = || {
            let own = variable("XDG_CACHE_HOME").map(PathBuf::from);
            let home = || variable("HOME").map(|home| Path::new(&home).join(".cache"));
            own.or_else(home).map(|folder| folder.join("eyebolt"))
        };
        self.cache.clone().or_else(user).map_or(LinkCache::disabled(), LinkCache::new)
    }
}

/// Uses that many threads, or one for each core.
pub fn use_threads(threads: Option<u16>) -> Result<()> {
    let Some(threads) = threads else { return Ok(()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads));
    pool.build_global().context("cannot start the threads")
}
