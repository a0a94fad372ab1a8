//! One network after the other.

use super::arguments::{Arguments, Kind};
use super::folder::ModelFolder;
use crate::front::Front;
use crate::robots::packages;
use anyhow::{Result, bail};
use eyebolt::dataset::Dataset;
use eyebolt::end_effector::EndEffector;
use eyebolt::progress::Progress;
use eyebolt::robots::{BUILT_IN, BuiltIn};
use eyebolt::train::{
    Actor, Beginning, Cast, Checkpoint, EndEffectorLesson, Hand, Images, KeypointLesson, Lesson,
    RotationLesson, SegmentationLesson, pace, teach as run,
};
use eyebolt_robot::{Arm, Robot};
use std::path::PathBuf;
use std::time::Instant;

/// Teaches the network of `kind`, or goes on with it; one that is ready is left as it is.
pub fn teach(
    arguments: &Arguments,
    kind: Kind,
    front: &dyn Front,
    progress: &dyn Progress,
) -> Result<()> {
    let folder = ModelFolder::new(&arguments.output, kind, arguments.force, front)?;
    if folder.is_ready() {
        front.say(&format!(
            "{}: is there already; --force teaches it anew",
            folder.path().display()
        ));
        return Ok(());
    }
    front.say(&format!("{}:", kind.name()));
    if arguments.any_arm {
        let (cast, about) = any_arm(arguments)?;
        return segmentation(arguments, Images::simulated(cast), 2, &about, folder, progress);
    }
    let arm = arguments.robot.read(front)?.arm;
    let about = format!(
        "{}, end-effector {}, description {}",
        arm.robot().name,
        arm.end_effector_name(),
        arm.robot().urdf_hash()
    );
    match kind {
        Kind::Segmentation => {
            segmentation(arguments, images(arguments, arm)?, 3, &about, folder, progress)
        }
        Kind::EndEffector => {
            let extent_m = EndEffector::of(&arm)?.extent_m();
            let net = arguments.preset.end_effector()?;
            let images = images(arguments, arm)?;
            let mut lesson = EndEffectorLesson::new(images, extent_m, net, arguments.seed)?;
            lesson.trained_on = about;
            finish(arguments, &lesson, folder, progress)
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

/// Made-up arms, and among them those that come with the program and those that are named.
fn any_arm(arguments: &Arguments) -> Result<(Cast, String)> {
    /// Share of the images that are of a known arm.
    const SHARE_KNOWN: f64 = 0.3;
    let cache = arguments.cache.open();
    let mut arms: Vec<Arm> = BUILT_IN.iter().map(BuiltIn::arm).collect();
    for urdf in &arguments.also {
        arms.push(Robot::from_urdf_file(urdf, &packages(&[]))?.arm(None, None)?);
    }
    let names: Vec<String> = arms.iter().map(|arm| arm.robot().name.clone()).collect();
    let known = arms.into_iter().map(|arm| Actor::new(arm, &cache)).collect::<Result<_, _>>()?;
    let about = format!("arms that are made up, and {}", names.join(", "));
    Ok((Cast::Any { known, share_known: SHARE_KNOWN }, about))
}

fn segmentation(
    arguments: &Arguments,
    images: Images,
    classes: usize,
    about: &str,
    folder: ModelFolder<'_>,
    progress: &dyn Progress,
) -> Result<()> {
    let net = arguments.preset.segmentation(classes)?;
    let mut lesson = SegmentationLesson::new(images, arguments.preset.grid(), net, arguments.seed)?;
    lesson.images = arguments.preset.images();
    lesson.trained_on = about.to_owned();
    finish(arguments, &lesson, folder, progress)
}

fn hand(arguments: &Arguments, arm: Arm) -> Result<Hand> {
    let end_effector = EndEffector::of(&arm)?;
    let extent_m = end_effector.extent_m();
    let images = images(arguments, arm)?;
    Ok(Hand { images, end_effector, extent_m, seed: arguments.seed })
}

/// Images of `arm`: simulated, and of the data sets that are named.
fn images(arguments: &Arguments, arm: Arm) -> Result<Images> {
    let open = |folder: &PathBuf| {
        let dataset = Dataset::open(folder)?;
        dataset.check_robot(&arm)?;
        Ok(dataset)
    };
    let recorded = arguments.data.iter().map(open).collect::<Result<Vec<_>>>()?;
    let half = if recorded.is_empty() { 1.0 } else { 0.5 };
    let cast = Cast::Known(vec![Actor::new(arm, &arguments.cache.open())?]);
    Ok(Images::mixed(cast, recorded, arguments.simulated.unwrap_or(half))?)
}

fn finish<L: Lesson>(
    arguments: &Arguments,
    lesson: &L,
    mut folder: ModelFolder<'_>,
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
    progress.begin("train")?;
    let weights = match (&checkpoint, arguments.from(folder.kind())) {
        (None, Some(from)) => folder.weights_of(&from)?,
        _ => None,
    };
    let beginning = match (&checkpoint, &weights) {
        (Some(bytes), _) => Beginning::Checkpoint(bytes),
        (None, Some(bytes)) => Beginning::Weights(bytes),
        (None, None) => Beginning::Anew,
    };
    let model = run(lesson, &plan(steps), beginning, &mut folder, progress)?;
    folder.write(&model)
}
