//! Models against recordings whose truth is known.

use crate::ending::Ending;
use crate::front::Front;
use crate::inputs::{CacheArguments, RobotArguments};
use crate::output;
use anyhow::{Context, Result, bail};
use eyebolt::evaluate::{Calibrated, Model, Reference, Scores, Table, by_marker, session, tables};
use eyebolt::export::SavedCalibration;
use eyebolt::model_files::ModelFiles;
use eyebolt::pipeline::Request;
use eyebolt::progress::Progress;
use eyebolt::report::tables_page;
use eyebolt_markers::Target;
use eyebolt_recording::{BagOptions, Recording, read_truth};
use eyebolt_robot::Arm;
use std::path::{Path, PathBuf};

/// What is asked for.
pub struct Wanted<'a> {
    pub recordings: &'a [PathBuf],
    pub models: &'a [String],
    pub calibrations: &'a [PathBuf],
    pub marker: Option<&'a Target>,
    pub marked: &'a [PathBuf],
    pub robot: &'a RobotArguments,
    pub json: bool,
    pub csv: Option<&'a Path>,
    pub report: Option<&'a Path>,
    pub force: bool,
    pub cache: &'a CacheArguments,
}

/// Prints the tables.
pub fn run(wanted: &Wanted<'_>, front: &dyn Front) -> Result<Ending> {
    for path in wanted.csv.iter().chain(&wanted.report) {
        output::refuse_existing(path, wanted.force)?;
    }
    deliver(wanted, &found(wanted, front)?)?;
    Ok(Ending::Done)
}

/// The tables as JSON.
pub fn json(wanted: &Wanted<'_>, front: &dyn Front) -> Result<String> {
    let tables = found(wanted, front)?;
    Ok(serde_json::to_string(&tables)?)
}

/// The tables.
fn found(wanted: &Wanted<'_>, front: &dyn Front) -> Result<Vec<Table>> {
    let models: Vec<Model> = wanted.models.iter().map(|named| model(named)).collect();
    let references = references(wanted)?;
    let mut results = Vec::new();
    let stages = front.stages()?;
    for model in &models {
        let mut of_model = Vec::new();
        for (path, reference) in wanted.recordings.iter().zip(&references) {
            let scores = of_recording(wanted, path, reference, model, stages.as_ref())
                .with_context(|| path.display().to_string())?;
            of_model.push((short_name(path), scores));
        }
        results.push((model.name.as_str(), of_model));
    }
    if let Some((_, (_, scores))) =
        results.first_mut().and_then(|(name, of_model)| Some((name, of_model.first_mut()?)))
    {
        scores.calibrations.extend(tags(wanted, stages.as_ref())?);
    }
    drop(stages);
    let results: Vec<(&str, &[(String, Scores)])> =
        results.iter().map(|(name, scores)| (*name, scores.as_slice())).collect();
    Ok(tables(&results))
}

fn deliver(wanted: &Wanted<'_>, tables: &[Table]) -> Result<()> {
    let about = about(wanted);
    if let Some(path) = wanted.csv {
        let head = "table,row,column,value,deviation,paper\n".to_owned();
        let text: String = std::iter::once(head).chain(tables.iter().map(Table::csv)).collect();
        output::write_whole(path, text.as_bytes(), wanted.force)?;
    }
    if let Some(path) = wanted.report {
        output::write_whole(path, tables_page(&about, tables).as_bytes(), wanted.force)?;
    }
    if wanted.json {
        output::deliver(format!("{}\n", serde_json::to_string(tables)?).as_bytes())?;
        return Ok(());
    }
    output::say(&about);
    tables.iter().for_each(|table| output::say(&format!("\n{}", table.text().trim_end())));
    Ok(())
}

/// Against what the recordings are held.
fn about(wanted: &Wanted<'_>) -> String {
    let recordings = match wanted.recordings.len() {
        1 => "1 recording".to_owned(),
        count => format!("{count} recordings"),
    };
    match wanted.calibrations.is_empty() {
        true => format!("{recordings}, against the truth of the simulation"),
        false => format!(
            "{recordings}, against other calibrations: their errors count as those of what is evaluated"
        ),
    }
}

/// A model, with or without another name before it.
fn model(named: &str) -> Model {
    let (name, model) = match named.split_once('=') {
        Some((name, model)) => (name.to_owned(), model),
        None => (short_name(Path::new(named)), named),
    };
    Model { name, files: ModelFiles::at(model.into()) }
}

fn short_name(path: &Path) -> String {
    let name = path.file_stem().or(path.file_name());
    name.map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned())
}

fn references(wanted: &Wanted<'_>) -> Result<Vec<Reference>> {
    let Wanted { recordings, calibrations, .. } = wanted;
    if !calibrations.is_empty() && calibrations.len() != recordings.len() {
        bail!(
            "--calibration: {} for {} recordings. Name one for each, in their order",
            calibrations.len(),
            recordings.len()
        );
    }
    let of = |(index, recording): (usize, &PathBuf)| {
        let camera_from_base = match calibrations.get(index) {
            Some(path) => SavedCalibration::read(path)?.base_from_camera(false)?.inverse(),
            None => read_truth(recording)?.camera_from_base,
        };
        Ok(Reference { camera_from_base })
    };
    recordings.iter().enumerate().map(of).collect()
}

fn of_recording(
    wanted: &Wanted<'_>,
    path: &Path,
    reference: &Reference,
    model: &Model,
    progress: &dyn Progress,
) -> Result<Scores> {
    let recording = Recording::open(path, &BagOptions::default())?;
    let arm: Arm = wanted.robot.arm(path, &recording)?;
    if wanted.calibrations.is_empty() {
        check_arm(path, &arm)?;
    }
    let request = Request { cache: wanted.cache.open(), ..Request::new(recording.source(), &arm) };
    Ok(session(&request, reference, model, progress)?)
}

/// Calibrations by the marker, if there is one.
fn tags(wanted: &Wanted<'_>, progress: &dyn Progress) -> Result<Vec<Calibrated>> {
    let Some(target) = wanted.marker else { return Ok(Vec::new()) };
    let of = |path: &PathBuf| -> Result<Calibrated> {
        let camera_from_base = read_truth(path)?.camera_from_base;
        let recording = Recording::open(path, &BagOptions::default())?;
        let arm = wanted.robot.arm(path, &recording)?;
        check_arm(path, &arm)?;
        let request = Request::new(recording.source(), &arm);
        Ok(by_marker(&request, &Reference { camera_from_base }, target, progress)?)
    };
    let each =
        wanted.marked.iter().map(|path| of(path).with_context(|| path.display().to_string()));
    each.collect()
}

/// The truth is of one link as base.
fn check_arm(path: &Path, arm: &Arm) -> Result<()> {
    let truth = read_truth(path)?;
    if truth.base != arm.base_name() {
        bail!(
            "the truth is of the base {:?}, and the arm's is {:?}. Name it with --base {}",
            truth.base,
            arm.base_name(),
            truth.base
        );
    }
    Ok(())
}
