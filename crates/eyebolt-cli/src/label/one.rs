//! One recording into the data set.

use super::arguments::Arguments;
use super::calibrated::{Known, from_nothing, given};
use super::told::{Labelled, Told};
use crate::calibrate;
use crate::front::Front;
use crate::output;
use crate::robots::told;
use anyhow::{Context, Result, bail};
use eyebolt::dataset::{
    Calibrated, DatasetFrame, Description, FillError, LabelRun, RecordingEntry, Shard, Store, fill,
};
use eyebolt::end_effector::EndEffector;
use eyebolt::export::SavedCalibration;
use eyebolt::pipeline::{Failure, Request};
use eyebolt::record::RecordOptions;
use eyebolt::report::labelled;
use eyebolt_recording::Recording;
use eyebolt_robot::Arm;
use std::path::{Path, PathBuf};

/// What all recordings have in common.
pub struct Labelling<'a> {
    arguments: &'a Arguments,
    folder: &'a Path,
    /// Name and text of the calibration that was given.
    calibration: Option<(String, String)>,
    front: &'a dyn Front,
}

impl<'a> Labelling<'a> {
    /// By `calibration` (name and text), or the one that `arguments` name, which is read.
    pub fn new(
        arguments: &'a Arguments,
        folder: &'a Path,
        calibration: Option<(String, String)>,
        front: &'a dyn Front,
    ) -> Result<Self> {
        let read = |path: &PathBuf| -> Result<(String, String)> {
            let name = path.display().to_string();
            // Checked before any work is done.
            SavedCalibration::read(path)?.base_from_camera(true)?;
            let failed = || format!("{name}: cannot read the calibration");
            Ok((name.clone(), std::fs::read_to_string(path).with_context(failed)?))
        };
        let calibration = match calibration {
            Some(calibration) => Some(calibration),
            None => arguments.calibration.as_ref().map(read).transpose()?,
        };
        Ok(Self { arguments, folder, calibration, front })
    }

    /// Labels the frames of the recording at `path` that are in this shard.
    pub fn label(&self, path: &Path) -> Result<Told> {
        let arguments = self.arguments;
        let recording = Recording::open(path, &arguments.bag.options_of(&arguments.robot))?;
        let arm = told(arguments.robot.arm(path, &recording)?, self.front);
        let recording = arguments.robot.noted(recording, &arm)?;
        let end_effector = EndEffector::of(&arm)?;
        let options = RecordOptions { use_masks: !arguments.no_masks, ..RecordOptions::default() };
        let (source, cache) = (recording.source(), arguments.cache.open());
        let request =
            Request { cache, options, seed: arguments.seed, ..Request::new(source, &arm) };
        let name = name_of(path);
        let calibrated = Calibrated::FromNothing;
        let mut entry = RecordingEntry::new(&name, source, &arm, options.use_masks, calibrated)?;
        let description = Description::new(&arm, &end_effector);
        let shard = arguments.shard.unwrap_or(Shard::WHOLE);

        let mut store = Store::open(self.folder, description, shard)?;
        let known = match self.known(&store, &entry, &request, path)? {
            Ok(known) => known,
            Err(reasons) => return Ok(Told::Refused(reasons)),
        };
        entry.calibrated = known.calibrated;
        let file = self.calibration.as_ref().map_or(entry.calibration.as_str(), |(name, _)| name);
        check_base(&SavedCalibration::parse(file, &known.json)?, &arm)?;
        let saved = SavedCalibration::parse(file, &store.begin(&entry, &known.json)?)?;
        let parts = (&known.observations, &options);
        let run = LabelRun::new(source, parts, (&arm, &end_effector), &saved)?;
        let look = |file: &str, frame: &DatasetFrame| {
            self.draw(file, frame, &end_effector).map_err(Into::into)
        };
        let parts = self.front.parts()?;
        let filled = fill(&mut store, &entry, source, &run, &look, parts.as_ref());
        drop(parts);
        let filled = filled.map_err(|error| named(error, path))?;
        Ok(Told::Labelled(Labelled::new(path, &filled)))
    }

    /// The calibration that is given, or that other runs found, or that is to be found.
    fn known(
        &self,
        store: &Store,
        entry: &RecordingEntry,
        request: &Request<'_>,
        path: &Path,
    ) -> Result<Result<Known, Vec<String>>> {
        let before = store.known(&entry.id)?;
        let (json, calibrated) = match (before, &self.calibration) {
            (Some((before, there)), Some((_, json))) if there == *json => {
                (there, before.calibrated)
            }
            // That it is another one is for the store to say.
            (_, Some((_, json))) => (json.clone(), Calibrated::Given),
            (Some((before, there)), None) => (there, before.calibrated),
            (None, None) => return from_nothing(request, path, self.front),
        };
        given(request, path, json, calibrated).map(Ok)
    }

    /// Draws a frame, if anybody wants that.
    fn draw(&self, file: &str, frame: &DatasetFrame, end_effector: &EndEffector) -> Result<()> {
        let Some(folder) = &self.arguments.check else { return Ok(()) };
        let name = file.replace('/', "_").replace(".npz", ".png");
        let path = folder.join(name.trim_start_matches("frames_"));
        let bytes = labelled(frame, end_effector).encode_png();
        output::write_whole(&path, &bytes, self.arguments.force)
    }
}

/// Name of the file or folder at `path`, wherever that is.
fn name_of(path: &Path) -> String {
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    whole.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// A calibration of another base has the arm elsewhere.
fn check_base(calibration: &SavedCalibration, arm: &Arm) -> Result<()> {
    let (there, own) = (calibration.base_frame.as_str(), arm.base_name());
    if there != own {
        bail!(
            "{}: frames.base: the calibration is of {there}, but the arm's base is {own}. Name it with \
             --base, or give another --calibration",
            calibration.file()
        );
    }
    Ok(())
}

/// The error, with the recording where the error names no file.
fn named(error: FillError, path: &Path) -> anyhow::Error {
    match error {
        FillError::Record(error) => calibrate::named(Failure::Record(error), path),
        FillError::Dataset(error) => error.into(),
        FillError::Look(error) => anyhow::anyhow!("{error}"),
        FillError::Cancelled(_) => anyhow::anyhow!(
            "{}: ended before all frames were labelled. Run it again to go on",
            path.display()
        ),
    }
}
