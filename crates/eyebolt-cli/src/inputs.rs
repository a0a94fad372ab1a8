//! Flags that say what the recording and the robot are, shared by the commands.

use crate::robots::{Described, DescriptionArguments};
use anyhow::{Context, Result, bail};
use clap::builder::{PathBufValueParser, TypedValueParser};
use eyebolt::model_files::ModelFiles;
use eyebolt_markers::{Target, TargetError};
use eyebolt_recording::{
    BagOptions, CloudFile, CloudFrame, DepthUnit, JointNotes, NotedJoints, Recording, WriteRobot,
};
use eyebolt_registration::LinkCache;
use eyebolt_robot::{Arm, Robot, RobotError};
use std::path::{Path, PathBuf};

/// Which recording, and how to read it.
#[derive(Clone, Debug, clap::Args)]
pub struct RecordingArguments {
    /// Folder with a recording.toml, or a bag: MCAP, rosbag2 (file or folder) or ROS 1
    pub recording: PathBuf,
    #[command(flatten)]
    pub bag: BagArguments,
}

const BAGS: &str = "Bags";

/// How to read a bag.
#[derive(Clone, Debug, clap::Args)]
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

/// A marker as flags write it.
pub fn marker(text: &str) -> Result<Target, String> {
    text.parse().map_err(|error: TargetError| error.to_string())
}

/// A model: its folder, or the name of one that comes with the program.
pub fn model_files() -> impl TypedValueParser<Value = ModelFiles> {
    PathBufValueParser::new().map(ModelFiles::at)
}

fn depth_unit(text: &str) -> Result<DepthUnit, String> {
    let ways = "must be m, mm, or the metres of one, as in 0.0001 or 1/5000";
    DepthUnit::parse(text).ok_or_else(|| ways.to_owned())
}

impl BagArguments {
    /// The topics that are named, for those who listen to them.
    #[cfg(feature = "live")]
    pub fn topics(&self) -> eyebolt_live::TopicChoice {
        let pictures = [&self.color_topic, &self.mask_topic, &self.background_topic];
        eyebolt_live::TopicChoice {
            depth: self.depth_topic.clone(),
            camera_info: self.camera_info_topic.clone(),
            joints: self.joint_topic.clone(),
            description: self.description_topic.clone(),
            pictures: pictures.into_iter().flatten().cloned().collect(),
        }
    }

    pub fn options(&self) -> BagOptions {
        BagOptions {
            depth_topic: self.depth_topic.clone(),
            camera_info_topic: self.camera_info_topic.clone(),
            camera_info: self.camera_info.clone(),
            joint_topic: self.joint_topic.clone(),
            robot_joints: Vec::new(),
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

    /// As [`Self::options`], with the joints of `robot`, if that is named.
    pub fn options_of(&self, robot: &RobotArguments) -> BagOptions {
        BagOptions { robot_joints: robot.joint_names(), ..self.options() }
    }
}

impl RecordingArguments {
    /// Opens it, as one of `robot`, if that is named.
    pub fn open_of(&self, robot: &RobotArguments) -> Result<Recording<'static>> {
        Ok(Recording::open(&self.recording, &self.bag.options_of(robot))?)
    }

    /// As [`Self::open_of`], or one cloud in a file, for those who need no joint positions.
    pub fn open_or_cloud(&self, robot: &RobotArguments) -> Result<Recording<'static>> {
        if !CloudFile::is_named(&self.recording) {
            return self.open_of(robot);
        }
        let cloud = CloudFile::open(&self.recording, &self.bag.options_of(robot))?;
        Ok(Recording::Other(Box::new(cloud)))
    }

    /// As [`Self::open_of`], with one of several topics of depth where none is named.
    pub fn open_any_depth(&self, robot: &RobotArguments) -> Result<Recording<'static>> {
        let options = BagOptions { any_depth: true, ..self.bag.options_of(robot) };
        Ok(Recording::open(&self.recording, &options)?)
    }
}

/// Which robot.
#[derive(Clone, Debug, clap::Args)]
pub struct RobotArguments {
    /// Robot description (URDF or xacro), a robot that comes with the program, or one that is installed
    /// for ROS; otherwise the recording's
    #[arg(long, value_name = "URDF|NAME")]
    robot: Option<String>,
    /// Base link; otherwise the recording's, or guessed
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// End-effector link; otherwise the recording's, or guessed
    #[arg(long, value_name = "LINK")]
    end_effector: Option<String>,
    #[command(flatten)]
    description: DescriptionArguments,
    /// Where a joint stands that is not recorded, such as a finger: radians, metres if it slides; may be
    /// repeated. Otherwise the links that it moves take no part
    #[arg(long, value_name = "NAME=VALUE", value_parser = joint)]
    joint: Vec<(String, f64)>,
    /// What the recording's names of joints have before the URDF's, or the URDF's before the recording's
    #[arg(long, value_name = "PREFIX")]
    joint_prefix: Option<String>,
    /// Let a robot description that comes from a bag name files outside the package folders
    #[arg(long)]
    allow_outside_files: bool,
}

impl RobotArguments {
    /// What the flags say of joints that messages do not.
    pub fn notes(&self) -> JointNotes {
        JointNotes { prefix: self.joint_prefix.clone(), positions: self.joint.clone() }
    }

    /// The arm that the flags name, if they name a robot, else that of `text`, if there is one.
    #[cfg(feature = "live")]
    pub fn arm_of_text(&self, text: Option<&str>) -> Result<Option<Arm>> {
        let described = match (&self.robot, text) {
            (Some(name), _) => self.description.named(name)?,
            (None, Some(text)) => self.of_text(text)?,
            (None, None) => return Ok(None),
        };
        let Described { robot, about, .. } = described;
        let about = about.as_ref();
        let base = self.base.as_ref().or(about.map(|about| &about.base));
        let hand = self.end_effector.as_ref().or(about.map(|about| &about.end_effector));
        Ok(Some(robot.arm(base.map(String::as_str), hand.map(String::as_str))?))
    }

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
            if CloudFile::is_named(path) {
                bail!(
                    "{}: a cloud does not say of which robot. Give --robot arm.urdf",
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

    /// The arm that the flags name; `None` if they name no robot.
    pub fn arm_alone(&self) -> Result<Option<Arm>> {
        let Some(name) = &self.robot else { return Ok(None) };
        let Described { robot, about, .. } = self.description.named(name)?;
        let base = self.base.as_ref().or(about.as_ref().map(|about| &about.base));
        let hand = self.end_effector.as_ref().or(about.as_ref().map(|about| &about.end_effector));
        Ok(Some(robot.arm(base.map(String::as_str), hand.map(String::as_str))?))
    }

    /// Better told once than of each recording: a robot that is named and cannot be read.
    pub fn check_named(&self) -> Result<()> {
        self.robot.as_ref().map(|name| self.description.named(name)).transpose()?;
        Ok(())
    }

    /// `recording` with joints as the flags have them, which name joints of `arm`.
    pub fn noted<'r>(&self, recording: Recording<'r>, arm: &Arm) -> Result<Recording<'r>> {
        let notes = self.notes();
        if notes.is_empty() {
            return Ok(recording);
        }
        let robot = arm.robot();
        if let Some((name, _)) =
            self.joint.iter().find(|(name, _)| robot.joint_index(name).is_none())
        {
            let known = robot.joints.iter().filter(|joint| joint.moves());
            let known: Vec<&str> = known.map(|joint| joint.name.as_str()).collect();
            bail!("--joint {name}: the robot has no such joint. Name one of {}", known.join(", "));
        }
        Ok(Recording::Other(Box::new(NotedJoints::new(recording, notes, robot))))
    }

    /// Positions of joints that the flags state.
    pub fn stated_joints(&self) -> impl Iterator<Item = (String, f64)> {
        self.joint.iter().cloned()
    }

    /// What the recording may call the joints of the robot that the flags name; nothing where they name
    /// none, or one that cannot be read, which is told later.
    pub fn joint_names(&self) -> Vec<String> {
        let named = self.robot.as_ref().and_then(|name| self.description.named(name).ok());
        let names = named.map_or_else(Vec::new, |described| described.robot.own_joints());
        let Some(prefix) = &self.joint_prefix else { return names };
        let other = |name: &String| match name.strip_prefix(prefix.as_str()) {
            Some(bare) => bare.to_owned(),
            None => format!("{prefix}{name}"),
        };
        names.iter().map(other).collect()
    }

    /// As [`Self::arm`]; `None` if neither flags nor recording say what the robot is.
    pub fn arm_if_known(&self, recording: &Recording) -> Result<Option<Arm>> {
        self.robot(recording)?.map(|robot| self.arm_of(robot, recording)).transpose()
    }

    fn arm_of(&self, described: Described, recording: &Recording) -> Result<Arm> {
        let Described { robot, about, .. } = described;
        let section = recording.robot();
        // The recording's links are those of the robot it names, not of another given instead.
        let other = self.robot.is_some();
        let known = |link: &&String| !other || robot.link_index(link).is_some();
        let base = self.base.as_ref().or(section.base.as_ref().filter(known));
        let base = base.or(about.as_ref().map(|about| &about.base));
        let hand = self.end_effector.as_ref().or(section.end_effector.as_ref().filter(known));
        let hand = hand.or(about.as_ref().map(|about| &about.end_effector));
        Ok(robot.arm(base.map(String::as_str), hand.map(String::as_str))?)
    }

    /// What the flags and the recording say of the robot, for those who read the recording later.
    pub fn to_write(&self, recording: &Recording) -> Result<WriteRobot> {
        let section = recording.robot();
        let (mut base, mut end_effector) = (self.base.clone(), self.end_effector.clone());
        let urdf = match self.named(recording)? {
            Some(described) => {
                let text = described.text.clone();
                match self.arm_of(described, recording) {
                    // The links that the recording names may be another robot's.
                    Ok(arm) if self.robot.is_some() => {
                        let lacks = |link: &Option<String>| {
                            link.as_ref().is_some_and(|link| arm.robot().link_index(link).is_none())
                        };
                        base = base.or(lacks(&section.base).then(|| arm.base_name().to_owned()));
                        let hand = || arm.end_effector_name().to_owned();
                        end_effector = end_effector.or(lacks(&section.end_effector).then(hand));
                    }
                    Ok(_) => {}
                    // Whoever reads it later will find what is wrong; better told now. Which links are
                    // meant, they may say then.
                    Err(error) => match error.downcast_ref() {
                        Some(RobotError::Ambiguous { .. } | RobotError::NoArm { .. }) => {}
                        _ => return Err(error),
                    },
                }
                Some(text)
            }
            None => section.description.clone(),
        };
        Ok(WriteRobot { urdf, base, end_effector })
    }

    /// The robot of the flags, or of the file that the recording names.
    fn named(&self, recording: &Recording) -> Result<Option<Described>> {
        match (&self.robot, &recording.robot().urdf) {
            (Some(name), _) => self.description.named(name).map(Some),
            (None, Some(path)) => self.description.file(path).map(Some),
            (None, None) => Ok(None),
        }
    }

    fn robot(&self, recording: &Recording) -> Result<Option<Described>> {
        if let Some(described) = self.named(recording)? {
            return Ok(Some(described));
        }
        recording.robot().description.as_ref().map(|text| self.of_text(text)).transpose()
    }

    /// The robot of a description that came with the data.
    fn of_text(&self, text: &str) -> Result<Described> {
        let packages = self.description.packages().with_outside_files(self.allow_outside_files);
        let robot = Robot::from_urdf_str(text, None, &packages)?;
        Ok(Described { robot, text: text.to_owned(), about: None })
    }
}

fn joint(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').unwrap_or_default();
    match value.parse::<f64>() {
        Ok(value) if value.is_finite() && !name.is_empty() => Ok((name.to_owned(), value)),
        _ => Err("write NAME=VALUE, in radians or metres".to_owned()),
    }
}

/// Where shapes of links are kept between runs.
#[derive(Clone, Debug, clap::Args)]
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
