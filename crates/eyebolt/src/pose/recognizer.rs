//! Where the end-effector is, and which pixels are of it, by what each says of the other.

use super::estimator::{PoseAnswer, PoseEstimator};
use super::shape::EndEffectorShape;
use super::trust::CLEARLY;
use super::{PoseError, PoseMethod};
use crate::model_files::ModelFiles;
use crate::segment::{ARM, BACKGROUND, END_EFFECTOR, SegmentError, Segmentation, Segmenter};
use eyebolt_geometry::{Base, Camera, DepthImage, PinholeCamera, Transform};
use eyebolt_registration::Posture;
use eyebolt_render::Raster;

/// Networks that tell the end-effector's pixels, held against the shape that they should show.
///
/// A network is easily wrong about where a hand ends, and sometimes about where it is. Its shape fits only where it is: what
/// a pose explains is labelled by that pose, and if none fits, the hand is looked for elsewhere.
#[derive(Debug)]
pub struct Recognizer {
    segmenter: Segmenter,
    estimator: PoseEstimator,
    raster: Option<(PinholeCamera, Raster)>,
}

/// What a frame shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Recognized {
    /// Labels of its pixels.
    pub segmentation: Segmentation,
    /// Where the end-effector is, from these labels; `None` if too little of it is in view.
    pub answer: Option<PoseAnswer>,
}

/// Why a frame cannot be looked at.
#[derive(Debug, thiserror::Error)]
pub enum RecognizeError {
    /// Of the networks that tell pixels.
    #[error(transparent)]
    Segment(#[from] SegmentError),
    /// Of those that tell poses.
    #[error(transparent)]
    Pose(#[from] PoseError),
}

/// Other places where the end-effector is looked for.
const ELSEWHERE: usize = 4;
/// By so many standard deviations it has to be the shape and no smooth surface where most of what was labelled is neither: of a hand's frames
/// one was somewhere else with 2.8, and right ones had 3.2 and more.
const SURELY: f64 = 3.0;
/// Depth this far from the posed shape is not of it, as a share of its extent: fingers may be a little more open.
const ON_SHAPE: f64 = 0.06;

impl Recognizer {
    /// By these networks.
    pub fn new(segmenter: Segmenter, estimator: PoseEstimator) -> Self {
        Self { segmenter, estimator, raster: None }
    }

    /// Which also tells how likely each class is.
    pub fn with_probabilities(self) -> Self {
        Self { segmenter: self.segmenter.with_probabilities(), ..self }
    }

    /// By all the networks of a model that `eyebolt train` made for `shape`.
    ///
    /// # Errors
    ///
    /// Files that are not there, broken, or of something else; a model that does not tell the end-effector, or not its pose.
    pub fn open(model: &ModelFiles, shape: EndEffectorShape) -> Result<Self, RecognizeError> {
        let segmenter = Segmenter::open_for_end_effector(model)?;
        Ok(Self::new(segmenter, PoseEstimator::open(model, shape, PoseMethod::Fused)?))
    }

    /// What `depth`, which `camera` saw, shows: its end-effector with its links in one of `postures`; if there is none, with
    /// its fingers at one of a few openings.
    ///
    /// # Errors
    ///
    /// Image and camera of different sizes; no memory.
    pub fn recognize(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        postures: &[Posture],
    ) -> Result<Recognized, RecognizeError> {
        let segmentation = self.segmenter.segment(depth, camera)?;
        let first = self.posed(depth, camera, segmentation, postures)?;
        let was_supported = is_supported(&first);
        let first = self.looked_at_again(depth, camera, first, postures)?;
        if was_supported && is_answered(&first) && significance(&first) > CLEARLY {
            return Ok(first);
        }
        let mut found: Vec<Recognized> = Vec::new();
        for segmentation in
            self.segmenter.alternatives(depth, camera, &first.segmentation, ELSEWHERE)?
        {
            let other = self.posed(depth, camera, segmentation, postures)?;
            found.push(self.looked_at_again(depth, camera, other, postures)?);
        }
        found.retain(is_answered);
        let best = found.into_iter().max_by(|a, b| significance(a).total_cmp(&significance(b)));
        if is_answered(&first) {
            let clearest = CLEARLY.max(significance(&first));
            return Ok(best.filter(|best| significance(best) > clearest).unwrap_or(first));
        }
        if let Some(best) = best {
            return Ok(best);
        }
        if is_supported(&first) {
            return Ok(first);
        }
        let label = &first.segmentation.label;
        let answer = self.estimator.estimate_anyhow(depth, camera, label, postures);
        match answer.filter(PoseAnswer::may_be_right) {
            Some(answer) => {
                let found = Recognized { answer: Some(answer), ..first };
                self.labelled_again(depth, camera, found, postures)
            }
            None => Ok(first),
        }
    }

    fn posed(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        segmentation: Segmentation,
        postures: &[Posture],
    ) -> Result<Recognized, RecognizeError> {
        let answer = self.estimator.estimate_at(depth, camera, &segmentation.label, postures)?;
        Ok(Recognized { segmentation, answer })
    }

    /// Once more by its own labels, if it may be right. Where half of what a network labels is something else, the pose is pulled
    /// away: what explains some of it is looked at once more, too, and taken if that is clearly the shape.
    fn looked_at_again(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        found: Recognized,
        postures: &[Posture],
    ) -> Result<Recognized, RecognizeError> {
        if is_supported(&found) {
            return self.labelled_again(depth, camera, found, postures);
        }
        if !found.answer.as_ref().is_some_and(PoseAnswer::may_be_near) {
            return Ok(found);
        }
        let again = self.labelled_again(depth, camera, found.clone(), postures)?;
        Ok(if is_answered(&again) && significance(&again) > SURELY { again } else { found })
    }

    /// With the labels that the pose says, and the pose that these say. What the second look refuses is not relied on.
    fn labelled_again(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        found: Recognized,
        postures: &[Posture],
    ) -> Result<Recognized, RecognizeError> {
        let Some(answer) = &found.answer else { return Ok(found) };
        let openings = self.estimator.openings(postures);
        let label = self.label_at(depth, camera, &found.segmentation, answer, &openings);
        let segmentation = Segmentation { label, ..found.segmentation.clone() };
        self.posed(depth, camera, segmentation, postures)
    }

    /// Labels as the posed shape has them: its pixels are the end-effector, and what else was taken for it is what the
    /// network of whole frames takes it for. Of poses that cannot be told apart, those of all: the labels of one would speak for it.
    fn label_at(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        found: &Segmentation,
        answer: &PoseAnswer,
        openings: &[Posture],
    ) -> Vec<u8> {
        let mut raster = match self.raster.take() {
            Some((of, raster)) if of == *camera => raster,
            _ => Raster::new(camera),
        };
        let shape = self.estimator.shape();
        let reach_m = (ON_SHAPE * shape.extent_m()) as f32;
        let beneath = |(label, whole): (&u8, &u8)| match *label {
            END_EFFECTOR if *whole == BACKGROUND => BACKGROUND,
            END_EFFECTOR => ARM,
            other => other,
        };
        let mut label: Vec<u8> = found.label.iter().zip(&found.whole).map(beneath).collect();
        for (pose, opening) in answer.possible() {
            let Some(posture) = openings.get(opening) else { continue };
            let pose = Transform::<Camera, Base>::from_isometry(*pose.isometry());
            raster.draw(camera, &posture.meshes(&shape.model, &pose));
            for at in raster.pixels() {
                let (seen, drawn) = (depth.depth_m()[at], raster.depth_m(at));
                if seen > 0.0 && drawn.is_some_and(|drawn| (seen - drawn).abs() < reach_m) {
                    label[at] = END_EFFECTOR;
                }
            }
        }
        self.raster = Some((camera.clone(), raster));
        label
    }
}

/// Whether the shape explains what was seen, and in one way alone.
fn is_answered(found: &Recognized) -> bool {
    found.answer.as_ref().is_some_and(|answer| answer.refusal.is_none())
}

/// How clearly the frame says that it is the shape and no smooth surface.
fn significance(found: &Recognized) -> f64 {
    found.answer.as_ref().map_or(0.0, PoseAnswer::significance)
}

/// Whether the shape explains what was seen, even if it is not known which way it is turned.
fn is_supported(found: &Recognized) -> bool {
    found.answer.as_ref().is_some_and(PoseAnswer::may_be_right)
}
