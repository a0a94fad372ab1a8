//! `eyebolt plan`.

mod arguments;
mod known;
mod lines;

pub use arguments::Arguments;

use crate::ending::Ending;
use crate::front::Terminal;
use crate::inputs::use_threads;
use crate::output::{self, STDOUT};
use crate::robots::told;
use anyhow::{Result, bail};
use arguments::Form;
use eyebolt::plan::{
    CameraFile, MovableArm, PlanDocument, PlanRequest, RoughCamera, Speed, assumed_cameras, moveit,
    plan_next, trajectory,
};
use eyebolt_robot::{Arm, JointPositions};
use known::Known;
use std::path::Path;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let form = arguments.form()?;
    let to_file = Some(arguments.output.as_path()).filter(|path| *path != Path::new(STDOUT));
    if let Some(path) = to_file {
        output::refuse_existing(path, arguments.force)?;
    }
    let file = arguments.camera.as_deref();
    let file = file.map(|path| CameraFile::read(path, arguments.even_if_refused)).transpose()?;
    match &arguments.recording {
        Some(path) => {
            let recording = arguments.open(path)?;
            let arm = told(arguments.robot.arm(path, &recording)?, &Terminal);
            let recording = arguments.robot.noted(recording, &arm)?;
            let known = Known::of(arguments, path, recording.source(), &arm, file)?;
            let cameras = [known.camera.clone()];
            write(arguments, form, &arm, &known.joints, &cameras, Some(&known))
        }
        None => {
            let Some(arm) = arguments.robot.arm_alone()? else {
                bail!(
                    "neither a recording nor a robot is given. Give a RECORDING of the arm before the camera, or \
                     --robot arm.urdf, with --camera c.json if you know about where the camera is"
                );
            };
            let arm = told(arm, &Terminal);
            let joints: JointPositions = arguments.robot.stated_joints().collect();
            let known = file.map(|file| Known::of_file(&arm, file)).transpose()?;
            let cameras = match &known {
                Some(known) => vec![known.camera.clone()],
                None => assumed_cameras(reach_m(&arm), arguments.seed),
            };
            write(arguments, form, &arm, &joints, &cameras, known.as_ref())
        }
    }
}

/// How far the end-effector gets from the base, about, metres: the lengths of all links together, which no arm stretches
/// to.
fn reach_m(arm: &Arm) -> f64 {
    const STRETCHED: f64 = 0.8;
    let robot = arm.robot();
    let mut at = arm.end_effector();
    let mut length_m = 0.0;
    while let Some((parent, joint)) = robot.links[at].parent.filter(|_| at != arm.base()) {
        length_m += robot.joints[joint].parent_from_child_at_zero.translation_m().norm();
        at = parent;
    }
    STRETCHED * length_m
}

fn write(
    arguments: &Arguments,
    form: Form,
    arm: &Arm,
    joints: &JointPositions,
    cameras: &[RoughCamera],
    known: Option<&Known>,
) -> Result<Ending> {
    let movable = MovableArm::new(arm, joints, &arguments.cache.open())?;
    let speed =
        Speed::new(movable.joints(), arguments.speed_deg_s.to_radians(), arguments.speed_m_s);
    let request = PlanRequest {
        arm: &movable,
        cameras,
        recorded: known.and_then(Known::recorded),
        calibrated: known.and_then(|known| known.calibrated),
        start: movable.positions_of(joints),
        count: usize::from(arguments.configurations),
        table: !arguments.no_table,
        seen_only: arguments.seen_only,
        speed,
        rest_s: arguments.rest_s,
        seed: arguments.seed,
    };
    let plan = plan_next(&request);
    let document = PlanDocument::new(&request, &plan);
    let text = match form {
        Form::Json => document.to_json(),
        Form::Moveit => moveit(&movable, &plan),
        Form::Trajectory => trajectory(&movable, &plan),
    };
    let path = &arguments.output;
    if path == Path::new(STDOUT) {
        output::deliver(text.as_bytes())?;
        output::complain(&lines::text(&document, None));
    } else {
        output::write_whole(path, text.as_bytes(), arguments.force)?;
        output::say(&lines::text(&document, Some(path)));
    }
    Ok(if plan.configurations.len() < request.count { Ending::Refused } else { Ending::Done })
}
