//! What is known before a plan: by a recording, by a file, by both.

use super::Arguments;
use crate::calibrate::named;
use crate::output;
use crate::progress::Bar;
use anyhow::{Result, bail};
use eyebolt::calibrate::Verdict;
use eyebolt::dataset::start;
use eyebolt::observations::Observations;
use eyebolt::pipeline::{self, Failure, Request};
use eyebolt::plan::{Calibrated, CameraFile, Recorded, RoughCamera, told_range_m};
use eyebolt::record::{RecordOptions, observe};
use eyebolt_recording::FrameSource;
use eyebolt_registration::Start;
use eyebolt_robot::{Arm, JointPositions};
use std::path::Path;

/// What is known before a plan.
pub struct Known {
    pub camera: RoughCamera,
    pub calibrated: Option<Calibrated>,
    /// Where the joints are now.
    pub joints: JointPositions,
    seen: Option<(Observations, Start)>,
}

impl Known {
    /// Of a recording, whose camera `file` tells, or its calibration.
    pub fn of(
        arguments: &Arguments,
        path: &Path,
        source: &dyn FrameSource,
        arm: &Arm,
        file: Option<CameraFile>,
    ) -> Result<Self> {
        let Some(last) = source.frame_names().len().checked_sub(1) else {
            bail!("{}: no frames. Record the arm in a configuration or two", path.display());
        };
        let mut joints = source.read_joints(last)?;
        joints = joints
            .iter()
            .map(|(name, at)| (name.to_owned(), at))
            .chain(arguments.robot.stated_joints())
            .collect();
        let request = Request {
            cache: arguments.cache.open(),
            options: RecordOptions { use_masks: !arguments.no_masks, ..RecordOptions::default() },
            seed: arguments.seed,
            ..Request::new(source, arm)
        };
        let (observations, at, calibrated) = match file {
            Some(file) => by_file(arguments, path, &request, file)?,
            None => by_calibration(arguments, path, &request)?,
        };
        let camera = RoughCamera {
            camera: observations.camera.clone(),
            camera_from_base: at.camera_from_base,
            range_m: told_range_m(&observations),
        };
        Ok(Self { camera, calibrated, joints, seen: Some((observations, at)) })
    }

    /// Of a file alone.
    pub fn of_file(arm: &Arm, file: CameraFile) -> Result<Self> {
        check_base(arm, &file)?;
        let CameraFile { camera, calibrated, .. } = file;
        Ok(Self { camera, calibrated, joints: JointPositions::default(), seen: None })
    }

    /// What was recorded.
    pub fn recorded(&self) -> Option<Recorded<'_>> {
        self.seen.as_ref().map(|(observations, at)| Recorded { observations, at: *at })
    }
}

type Seen = (Observations, Start, Option<Calibrated>);

fn by_file(
    arguments: &Arguments,
    path: &Path,
    request: &Request<'_>,
    file: CameraFile,
) -> Result<Seen> {
    check_base(request.arm, &file)?;
    let seen = observe(request.source, request.arm, &request.cache, &request.options);
    let observations = seen.map_err(|error| named(Failure::Record(error), path))?;
    let at = match &file.calibration {
        Some(calibration) => start(calibration, &observations, arguments.even_if_refused)?,
        None => {
            let own = observations.optical_from_camera.inverse();
            Start::from(own * file.camera.camera_from_base)
        }
    };
    Ok((observations, at, file.calibrated))
}

fn by_calibration(arguments: &Arguments, path: &Path, request: &Request<'_>) -> Result<Seen> {
    let bar = Bar::new();
    let outcome = pipeline::run(request, &bar).map_err(|error| named(error, path))?;
    bar.finish();
    let calibration = outcome.calibration;
    if let Verdict::Refused(reasons) = &calibration.verdict {
        let reasons: Vec<String> = reasons.iter().map(ToString::to_string).collect();
        let reasons = reasons.join("; ");
        if !arguments.even_if_refused {
            bail!(
                "{}: its calibration is refused, and a plan goes by it: {reasons}. Say about where the camera is with \
                 --camera, or give --even-if-refused where the reasons do not make the pose wrong",
                path.display()
            );
        }
        output::complain(&format!("note: the calibration is refused: {reasons}"));
    }
    let (Some(refinement), Some(observations)) = (calibration.refinement, outcome.observations)
    else {
        bail!(
            "{}: no pose of the camera was found. Say about where it is with --camera",
            path.display()
        );
    };
    let calibrated = calibration.error.map(|error| Calibrated {
        expected: error.expected,
        covariance: error.covariance,
        workspace_in_base: error.workspace_in_base,
    });
    Ok((observations, refinement.end(), calibrated))
}

fn check_base(arm: &Arm, file: &CameraFile) -> Result<()> {
    let Some(calibration) = &file.calibration else { return Ok(()) };
    let base = calibration.base_frame.as_str();
    if base != arm.base_name() {
        bail!(
            "{}: frames.base: the calibration is of {base}, but the arm's base is {}. Name it with --base, or give \
             another calibration",
            calibration.file(),
            arm.base_name()
        );
    }
    Ok(())
}
