//! What networks have to do with a calibration.

use crate::inputs::model_files;
use anyhow::{Result, bail};
use eyebolt::model_files::ModelFiles;
use eyebolt::networks::Networks;
use eyebolt::paper::{self, FrameEstimator, FrameLabels, Paper};
use eyebolt::pipeline::{self, Outcome, Request};
use eyebolt::pose::{EndEffectorShape, PoseEstimator, PoseMethod, Recognizer};
use eyebolt::progress::Progress;
use eyebolt::segment::Segmenter;
use eyebolt_recording::read_truth;
use eyebolt_registration::Start;
use std::path::Path;

/// Options of networks.
#[derive(Default, Debug, clap::Args)]
pub struct LearnedArguments {
    /// Model that eyebolt train made: its folder, or one that comes with the program (any-arm, panda, shackle). Its
    /// networks tell the arm's pixels, whatever else moves, and where its end-effector is
    #[arg(long, value_name = "MODEL", value_parser = model_files())]
    pub model: Option<ModelFiles>,
    /// How to calibrate
    #[arg(long, value_enum, default_value = "best")]
    pub method: Method,
    /// With --method paper: leave the poses as the networks have them
    #[arg(long)]
    pub no_icp: bool,
    /// With --method paper: who tells the end-effector's pixels
    #[arg(long, value_enum, default_value = "predicted")]
    pub labels: LabelsFrom,
}

/// How to calibrate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Method {
    /// With a model by what its networks tell, refined on all that is seen of the arm; else from nothing
    #[default]
    Best,
    /// From nothing, even with a model
    Nothing,
    /// As Sefercik and Akgun (CoRL 2022): the pose of the end-effector in each frame, without outliers, averaged
    Paper,
}

/// Who tells which pixels are the end-effector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum LabelsFrom {
    /// The networks
    #[default]
    Predicted,
    /// The truth of a recording that eyebolt simulate made
    True,
}

/// The model that a method needs.
fn model(arguments: &LearnedArguments) -> Result<&ModelFiles> {
    match &arguments.model {
        Some(model) => Ok(model),
        None => bail!("--method paper needs the networks of a model. Name one with --model"),
    }
}

/// Better told once than of each recording: a model that is missing.
pub fn check(arguments: &LearnedArguments) -> Result<()> {
    let model = match (arguments.method, &arguments.model) {
        (Method::Paper, _) => Some(model(arguments)?),
        (Method::Best, Some(model)) => Some(model),
        (Method::Best | Method::Nothing, _) => None,
    };
    model.map(Segmenter::open).transpose()?;
    Ok(())
}

/// Calibrates as `arguments` ask for.
pub fn calibrate(
    arguments: &LearnedArguments,
    recording: &Path,
    request: &Request<'_>,
    progress: &dyn Progress,
) -> Result<Outcome> {
    match (arguments.method, &arguments.model) {
        (Method::Paper, _) => by_paper(arguments, model(arguments)?, recording, request, progress),
        (Method::Best, Some(model)) => {
            let networks = Networks::open(model, request)?;
            Ok(pipeline::run(&networks.request(request), progress)?)
        }
        (Method::Best | Method::Nothing, _) => Ok(pipeline::run(request, progress)?),
    }
}

fn by_paper(
    arguments: &LearnedArguments,
    model: &ModelFiles,
    recording: &Path,
    request: &Request<'_>,
    progress: &dyn Progress,
) -> Result<Outcome> {
    let shape = EndEffectorShape::of(request.arm, &request.cache)?;
    let labels = match arguments.labels {
        LabelsFrom::Predicted => {
            FrameLabels::Predicted(Box::new(Recognizer::open(model, shape.clone())?))
        }
        LabelsFrom::True => {
            FrameLabels::True(Box::new(Start::from(read_truth(recording)?.camera_from_base)))
        }
    };
    let estimator = PoseEstimator::open(model, shape, PoseMethod::Fused)?;
    let estimator = FrameEstimator::new(estimator, !arguments.no_icp);
    let mut paper = Paper { labels, estimator };
    Ok(match paper::calibrate(request, &mut paper, progress) {
        Err(paper::PaperError::Failure(failure)) => return Err(failure.into()),
        outcome => outcome?,
    })
}
