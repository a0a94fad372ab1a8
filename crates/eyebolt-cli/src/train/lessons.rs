//! One network after the other.

use super::Arguments;
use super::folder::ModelFolder;
use crate::output;
use anyhow::{Result, bail};
use eyebolt::end_effector::EndEffector;
use eyebolt::progress::Progress;
use eyebolt::train::{
    Actor, Cast, Checkpoint, Hand, KeypointLesson, Lesson, RotationLesson, SegmentationLesson,
    pace, teach as run,
};
use eyebolt_robot::Arm;
use std::time::Instant;

/// What a network tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Segmentation,
    Rotation,
    Keypoints,
}

impl Kind {
    /// Its folder in that of the model.
    pub fn name(self) -> &'static str {
        match self {
            Self::Segmentation => "segmentation",
            Self::Rotation => "rotation",
            Self::Keypoints => "keypoints",
        }
    }
}

/// Teaches the network of `kind`, or goes on with it; one that is ready is left as it is.
pub fn teach(arguments: &Arguments, kind: Kind, progress: &dyn Progress) -> Result<()> {
    let folder = ModelFolder::new(&arguments.output.join(kind.name()), arguments.force)?;
    if folder.is_ready() {
        output::say(&format!(
            "{}: is there already; --force teaches it anew",
            folder.path().display()
        ));
        return Ok(());
    }
    output::say(&format!("{}:", kind.name()));
    if arguments.any_arm {
        let cast = Cast::Any { known: Vec::new(), share_known: 0.0 };
        return segmentation(arguments, cast, 2, "arms that are made up", folder, progress);
    }
    let arm = arguments.robot.read()?.arm;
    let about = format!(
        "{}, end-effector {}, description {}",
        arm.robot().name,
        arm.end_effector_name(),
        arm.robot().urdf_hash()
    );
    match kind {
        Kind::Segmentation => {
            let cast = Cast::Known(vec![Actor::new(arm, &arguments.cache.open())?]);
            segmentation(arguments, cast, 3, &about, folder, progress)
        }
        Kind::Rotation => {
            let mut lesson =
                RotationLesson::new(hand(arguments, arm)?, arguments.preset.rotation()?)?;
            lesson.trained_on = about;
            finish(arguments, &lesson, folder, progress)
        }
        Kind::Keypoints => {
            let hand = hand(arguments, arm)?;
            let mut lesson = KeypointLesson::new(hand, arguments.preset.keypoints()?)?;
            lesson.trained_on = about;
            finish(arguments, &lesson, folder, progress)
        }
    }
}

fn segmentation(
    arguments: &Arguments,
    cast: Cast,
    classes: usize,
    about: &str,
    folder: ModelFolder,
    progress: &dyn Progress,
) -> Result<()> {
    let net = arguments.preset.segmentation(classes)?;
    let mut lesson = SegmentationLesson::new(cast, arguments.preset.grid(), net, arguments.seed)?;
    lesson.trained_on = about.to_owned();
    finish(arguments, &lesson, folder, progress)
}

fn hand(arguments: &Arguments, arm: Arm) -> Result<Hand> {
    let end_effector = EndEffector::of(&arm)?;
    let extent_m = end_effector.extent_m();
    let cast = Cast::Known(vec![Actor::new(arm, &arguments.cache.open())?]);
    Ok(Hand { cast, end_effector, extent_m, seed: arguments.seed })
}

fn finish<L: Lesson>(
    arguments: &Arguments,
    lesson: &L,
    mut folder: ModelFolder,
    progress: &dyn Progress,
) -> Result<()> {
    let begun = Instant::now();
    let clock = || begun.elapsed().as_secs_f64();
    let plan = |steps: u64| arguments.preset.plan(steps, arguments.seed, 1);
    let checkpoint = folder.checkpoint()?;
    let steps = match (&checkpoint, arguments.steps) {
        (Some(bytes), wanted) => {
            let begun = Checkpoint::progressed(bytes)?;
            if wanted.is_some_and(|wanted| wanted != begun.steps) {
                bail!(
                    "{}: a run of {} steps was begun there. Go on with --steps {}, or begin anew with --force",
                    folder.path().display(),
                    begun.steps,
                    begun.steps
                );
            }
            begun.steps
        }
        (None, Some(steps)) => steps,
        (None, None) => {
            let seconds = pace(lesson, &plan(1000), &clock)?;
            ((60.0 * arguments.minutes / seconds) as u64).max(10)
        }
    };
    progress.begin(lesson_name(&folder))?;
    let model = run(lesson, &plan(steps), checkpoint.as_deref(), &mut folder, progress)?;
    folder.write(&model)
}

fn lesson_name(_: &ModelFolder) -> &'static str {
    "train"
}
